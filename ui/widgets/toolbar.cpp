#include "ui/widgets/toolbar.h"

#include <imgui.h>

#include <utility>

#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr const char* kMore = "»";

}  // namespace

Toolbar::Toolbar(const char* id, float free_right)
    : id_(id), right_(ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x - free_right) {}

bool Toolbar::fits(float width) {
    if (!waiting_.empty()) return false;
    if (!first_) ImGui::SameLine(0, std::exchange(space_, -1));
    if (ImGui::GetCursorScreenPos().x + width + ImGui::GetStyle().ItemSpacing.x + button_width(kMore) > right_)
        return false;
    first_ = false;
    return true;
}

void Toolbar::title(const char* text) {
    ImGui::PushFont(theme::strong());
    if (fits(ImGui::CalcTextSize(text).x)) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(text);
    }
    ImGui::PopFont();
}

void Toolbar::item(const char* label, float width, std::function<void(float)> draw) {
    const float before = *label ? ImGui::CalcTextSize(label).x + ImGui::GetStyle().ItemSpacing.x : 0;
    if (!fits(before + width)) {
        waiting_.push_back({label, width, std::move(draw)});
        return;
    }
    if (*label) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextDisabled("%s", label);
        ImGui::SameLine();
    }
    draw(width);
}

void Toolbar::end() {
    if (waiting_.empty()) return;
    if (!first_) ImGui::SameLine();
    const std::string popup = std::string("more of ") + id_;
    const float em = ImGui::GetFontSize();
    ImGui::PushID(id_);
    menu_button(kMore, popup.c_str(), "What has no room here", em * 16);
    if (ImGui::BeginPopup(popup.c_str())) {
        for (const Waiting& w : waiting_) {
            if (*w.label) {
                ImGui::AlignTextToFramePadding();
                ImGui::TextUnformatted(w.label);
                ImGui::SameLine(em * 6);
            }
            w.draw(w.width);
        }
        ImGui::EndPopup();
    }
    ImGui::PopID();
}

}  // namespace si
