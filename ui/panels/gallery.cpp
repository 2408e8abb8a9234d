// Gallery of guided presets and hard cases: small pictures and sentences by topic, with search.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "renderer/base/words_match.h"
#include "renderer/scenes/hard_cases.h"
#include "ui/panels/presets.h"
#include "ui/scene_view/picture_painter.h"
#include "ui/widgets/combo.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr float kPictureWidth = 8, kPictureHeight = 5;  ///< ems
constexpr float kPadding = 0.4f;                        ///< ems, around picture and text of a card

/// Card of one preset, or of a hard case and its fix.
struct Card {
    const PresetEntry* first = nullptr;
    const PresetEntry* fixed = nullptr;  ///< fix of `first`; null: none
};

std::string title_of(const PresetEntry& preset) {
    return preset.title.empty() ? preset.key : preset.title;
}

bool is_found(const PresetEntry& preset, const GalleryPanel& panel) {
    return matches_all_words(panel.search, {title_of(preset), preset.about, preset.topic, preset.key});
}

/// Returns the cards that the panel lists, in the order of the presets. A pair is listed if either of it is found.
std::vector<Card> listed_cards(std::span<const PresetEntry> presets, const GalleryPanel& panel) {
    std::vector<Card> cards;
    for (const PresetEntry& preset : presets) {
        if (!panel.topic.empty() && preset.topic != panel.topic) continue;
        const bool fixes_last =
            !cards.empty() && preset.key == cards.back().first->key + std::string(kFixedSuffix) && !cards.back().fixed;
        if (fixes_last)
            cards.back().fixed = &preset;
        else
            cards.push_back({&preset});
    }
    std::erase_if(cards, [&](const Card& card) {
        return !is_found(*card.first, panel) && !(card.fixed && is_found(*card.fixed, panel));
    });
    return cards;
}

float text_width_in(float width) {
    const float em = ImGui::GetFontSize();
    return std::max(width - em * (kPictureWidth + 3 * kPadding), em * 6);
}

float height_of(const PresetEntry& preset, float width) {
    const float em = ImGui::GetFontSize();
    const float wrap = text_width_in(width);
    const ImVec2 title = theme::strong()->CalcTextSizeA(em, FLT_MAX, wrap, title_of(preset).c_str());
    const ImVec2 about = ImGui::CalcTextSize(preset.about.c_str(), nullptr, false, wrap);
    return std::max(em * kPictureHeight, title.y + about.y + em * 0.2f) + 2 * em * kPadding;
}

/// Draws picture, title and sentence as one item. Returns true if it was clicked.
bool draw_entry(const PresetEntry& preset, bool current, ImVec2 size, PresetRequests& requests) {
    const float em = ImGui::GetFontSize(), pad = em * kPadding;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushID(preset.key.c_str());
    const bool chosen = ImGui::Selectable("##entry", current, ImGuiSelectableFlags_None, size);
    ImGui::PopID();
    if (!ImGui::IsItemVisible()) return chosen;
    if (current && ImGui::IsWindowAppearing()) ImGui::SetScrollHereY(0.4f);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 lo(at.x + pad, at.y + pad), hi(lo.x + em * kPictureWidth, lo.y + em * kPictureHeight);
    if (preset.picture != 0)
        draw.AddImage(texture_id(preset.picture), lo, hi, {0, 1}, {1, 0});  // stored bottom row first
    else
        draw.AddRectFilled(lo, hi, theme::well());
    draw.AddRect(lo, hi, theme::line());
    if (preset.picture == 0) requests.want_pictures.push_back(preset.key);
    const float left = hi.x + pad, wrap = text_width_in(size.x);
    const std::string title = title_of(preset);
    draw.AddText(theme::strong(), em, {left, lo.y}, theme::text(), title.c_str(), nullptr, wrap);
    const ImVec2 above = theme::strong()->CalcTextSizeA(em, FLT_MAX, wrap, title.c_str());
    draw.AddText(ImGui::GetFont(), em, {left, lo.y + above.y + em * 0.1f}, theme::muted(), preset.about.c_str(),
                 nullptr, wrap);
    return chosen;
}

void topic_combo(GalleryPanel& panel, std::span<const PresetEntry> presets, float width) {
    ImGui::SetNextItemWidth(width);
    if (!begin_combo("##topic", panel.topic.empty() ? "all topics" : panel.topic)) return;
    if (ImGui::Selectable("all topics", panel.topic.empty())) panel.topic.clear();
    std::string last;
    for (const PresetEntry& preset : presets)
        if (std::exchange(last, preset.topic) != preset.topic)
            if (ImGui::Selectable(preset.topic.c_str(), preset.topic == panel.topic)) panel.topic = preset.topic;
    ImGui::EndCombo();
}

/// Draws the cards. Returns the key of the clicked preset; empty: none.
std::string draw_cards(std::span<const Card> cards, const std::string& open, PresetRequests& requests) {
    const float em = ImGui::GetFontSize(), width = ImGui::GetContentRegionAvail().x;
    const bool pairs = std::ranges::any_of(cards, [](const Card& card) { return card.fixed != nullptr; });
    const float gap = ImGui::GetStyle().ItemSpacing.x, half = pairs ? (width - gap) / 2 : width;
    std::string topic, chosen;
    for (const Card& card : cards) {
        if (card.first->topic != topic) {
            if (!topic.empty()) ImGui::Dummy({0, em * 0.3f});
            topic = card.first->topic;
            ImGui::TextDisabled("%s%s", topic.c_str(), pairs ? ": broken" : "");
            if (pairs) {
                ImGui::SameLine(half + gap);
                ImGui::TextDisabled("fixed");
            }
            ImGui::Separator();
        }
        const float height = std::max(height_of(*card.first, half), card.fixed ? height_of(*card.fixed, half) : 0);
        // A case that no setting breaks has its fix alone, in the column of fixes.
        const bool fix_alone = pairs && !card.fixed && card.first->key.ends_with(kFixedSuffix);
        const float left = ImGui::GetCursorPosX();
        if (fix_alone) ImGui::SetCursorPosX(left + half + gap);
        if (draw_entry(*card.first, card.first->key == open, {half, height}, requests)) chosen = card.first->key;
        if (!card.fixed) continue;
        ImGui::SameLine(0, gap);
        if (draw_entry(*card.fixed, card.fixed->key == open, {half, height}, requests)) chosen = card.fixed->key;
    }
    return chosen;
}

}  // namespace

float gallery_width() {
    const float em = ImGui::GetFontSize();
    return std::min(em * 62, ImGui::GetIO().DisplaySize.x - 4 * em);
}

void draw_gallery(const char* id, GalleryPanel& panel, std::span<const PresetEntry> presets, const std::string& open,
                  PresetRequests& requests) {
    const float em = ImGui::GetFontSize();
    const float height = std::min(em * 48, ImGui::GetIO().DisplaySize.y - ImGui::GetFrameHeight() * 2.5f);
    ImGui::SetNextWindowSize({gallery_width(), height});
    if (!ImGui::BeginPopup(id, ImGuiWindowFlags_NoMove)) return;
    const bool begins = ImGui::IsWindowAppearing();
    if (begins) panel = {};
    if (presets.empty()) ImGui::TextDisabled("No presets ship with this build.");
    if (begins) ImGui::SetKeyboardFocusHere();
    const float topics = em * 13, gap = ImGui::GetStyle().ItemSpacing.x;
    search_field("search", "Search titles and sentences", panel.search, topics + gap);
    ImGui::SameLine();
    topic_combo(panel, presets, topics);
    const std::vector<Card> cards = listed_cards(presets, panel);
    const bool entered = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
    ImGui::BeginChild("list", {0, 0}, false);
    std::string chosen = draw_cards(cards, open, requests);
    if (cards.empty()) ImGui::TextDisabled("Nothing has all these words.");
    ImGui::EndChild();
    if (chosen.empty() && entered && !panel.search.empty() && !cards.empty()) chosen = cards.front().first->key;
    if (!chosen.empty()) {
        requests.load_preset = chosen;
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

}  // namespace si
