#include "ui/widgets/search_field.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>

namespace si {
namespace {

bool contains(std::string_view in, std::string_view word) {
    const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    return std::search(in.begin(), in.end(), word.begin(), word.end(), same) != in.end();
}

}  // namespace

void search_field(const char* id, const char* hint, std::string& text, float leave) {
    const float width = std::max(ImGui::GetContentRegionAvail().x - leave, ImGui::GetFontSize() * 3);
    const float side = ImGui::GetFrameHeight();
    const bool clears = !text.empty();
    ImGui::PushID(id);
    ImGui::SetNextItemWidth(clears ? width - side : width);
    ImGui::InputTextWithHint("##text", hint, &text);
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive())
        ImGui::SetTooltip("All words have to be there, in any order; other engines' names count too");
    if (clears) {
        ImGui::SameLine(0, 0);
        if (ImGui::Button("×", {side, side})) text.clear();
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("Clears the search");
    }
    ImGui::PopID();
}

bool words_match(std::string_view text, std::initializer_list<std::string_view> places) {
    while (true) {
        const auto begin = std::ranges::find_if_not(text, [](unsigned char c) { return std::isspace(c); });
        text.remove_prefix(std::size_t(begin - text.begin()));
        if (text.empty()) return true;
        const auto end = std::ranges::find_if(text, [](unsigned char c) { return std::isspace(c); });
        const std::string_view word = text.substr(0, std::size_t(end - text.begin()));
        if (std::ranges::none_of(places, [&](std::string_view place) { return contains(place, word); })) return false;
        text.remove_prefix(word.size());
    }
}

}  // namespace si
