// Comparison of the picture with another one of the same frame: swipe, side by side, or difference.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/advise/tuning.h"
#include "renderer/measure/axes.h"
#include "ui/scene_view/picture_marks.h"
#include "ui/scene_view/picture_painter.h"
#include "ui/state/panels.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/combo.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr ComboItem kViews[] = {{0, "off"}, {1, "swipe"}, {2, "side by side"}, {3, "difference"}};

bool is_pinned(const EditorState& state) {
    return !state.comparison.reference && state.compare.kind == CompareKind::Pinned;
}

/// Name of the shown settings' side. It is B in every comparison, because pinned settings are A.
constexpr const char* kVisibleSide = "B: shown settings";

std::string other_label(const EditorState& state, const EditorFrame& frame) {
    return state.comparison.reference ? "ray-traced reference" : shown_label(state.compare, frame.presets);
}

std::string other_side(const EditorState& state, const EditorFrame& frame) {
    return is_pinned(state) ? "A: pinned settings" : "A: " + other_label(state, frame);
}

void label(ImVec2 corner, float room, const std::string& text, bool right) {
    const float em = ImGui::GetFontSize(), width = ImGui::CalcTextSize(text.c_str()).x;
    if (width + em * 1.6f > room) return;
    draw_text_on_picture({right ? corner.x - width - em * 0.8f : corner.x + em * 0.8f, corner.y}, text);
}

}  // namespace

void show_tried(EditorState& state, const Settings& settings) {
    if (state.flicker) return;
    if (state.tried)
        static_cast<PinnedSettings&>(*state.tried) = {settings, state.scene_name};
    else
        state.tried = {{settings, state.scene_name}, state.comparison, state.compare, {}};
    state.tried->shown_beside = state.settings;
    state.compare = {CompareKind::Tried, {}};
    state.comparison.reference = false;
    state.comparison.view = ComparisonView::Swipe;
}

void hide_tried(EditorState& state) {
    const auto tried = std::exchange(state.tried, std::nullopt);
    if (!tried || state.compare.kind != CompareKind::Tried) return;
    state.compare = tried->compare_before;
    state.comparison = tried->comparison_before;
}

void follow_tried(EditorState& state) {
    if (!state.tried) return;
    Settings present = measured_settings(state.settings);
    const bool same = present == measured_settings(state.tried->shown_beside);
    const Settings tried = measured_settings(state.tried->settings);
    apply_tuning(present, tried);
    if ((!same && present != tried) || state.tried->scene != state.scene_name ||
        state.compare.kind != CompareKind::Tried || state.comparison.view == ComparisonView::Off)
        hide_tried(state);
}

ComparisonView chosen_comparison(const EditorState& state) {
    return (state.flicker ? state.flicker->picture_comparison : state.comparison).view;
}

void comparison_view_widget(EditorState& state, float width) {
    PictureComparison& a = state.comparison;
    ImGui::SetNextItemWidth(width);
    if (state.flicker || a.view == ComparisonView::Alone) {  // while a key shows A alone
        ImGui::BeginDisabled();
        ImGui::Button("A alone", {width, 0});
        ImGui::EndDisabled();
        return;
    }
    int view = int(a.view);
    if (item_combo("##against view", kViews, view)) a.view = ComparisonView(view);
    plain_tooltip(
        fmt::format("{}. {} pins the present settings as A;\nwhile {} is held the picture shows them alone",
                    with_key("Compare the picture with another one of the same frame", Command::NextComparison),
                    key_text(Command::PinSettings), key_text(Command::ShowPinned)));
}

void comparison_other_widget(EditorState& state, const EditorFrame& frame, float width) {
    PictureComparison& a = state.comparison;
    ImGui::SetNextItemWidth(width);
    ImGui::BeginDisabled(state.flicker.has_value());
    if (begin_combo("##against what", other_label(state, frame))) {
        bool picked = false;
        if (ImGui::Selectable("ray-traced reference", a.reference)) a.reference = picked = true;
        const auto other = [&](const char* text, const CompareWith& with) {
            if (!ImGui::Selectable(text, !a.reference && state.compare == with)) return;
            a.reference = false;
            picked = true;
            state.compare = with;
        };
        other("the scene's own settings", {CompareKind::Scene, {}});
        other("the program's defaults", {CompareKind::Defaults, {}});
        if (state.pinned) other("pinned A", {CompareKind::Pinned, {}});
        for (const std::string& path : frame.recent_presets)
            other((scene_label(path) + "##" + path).c_str(), {CompareKind::Preset, path});
        for (const PresetEntry& p : frame.presets)
            other(((p.title.empty() ? p.key : p.title) + "##" + p.key).c_str(), {CompareKind::Preset, p.key});
        if (picked && a.view == ComparisonView::Off) a.view = ComparisonView::Swipe;
        ImGui::EndCombo();
    }
    ImGui::EndDisabled();
    plain_tooltip(
        "The other side: light, maps, bias, filter and shading of a preset, or the traced reference of the\n"
        "shown light, under the same camera. Choosing one begins to compare");
}

bool steer_swipe(EditorState& state, const PictureView& view) {
    PictureComparison& a = state.comparison;
    if (a.view != ComparisonView::Swipe) return a.held = false;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const float line = float(view.origin.x) + a.at * float(view.size.x), near = ImGui::GetFontSize() * 0.5f;
    const bool over = std::abs(mouse.x - line) <= near && mouse.y >= float(view.origin.y) &&
                      mouse.y < float(view.origin.y) + float(view.size.y);
    if (ImGui::IsItemActivated() && ImGui::IsMouseClicked(ImGuiMouseButton_Left) && over) a.held = true;
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left) && !ImGui::IsMouseReleased(ImGuiMouseButton_Left)) a.held = false;
    if (a.held) a.at = std::clamp((mouse.x - float(view.origin.x)) / std::max(float(view.size.x), 1.0f), 0.0f, 1.0f);
    if (a.held || (over && ImGui::IsItemHovered())) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    return a.held;
}

void draw_comparison(const EditorState& state, const EditorFrame& frame, glm::vec2 lo, glm::vec2 size,
                     bool right_half) {
    const PictureComparison& a = state.comparison;
    if (a.view == ComparisonView::Off) return;
    const float em = ImGui::GetFontSize(), top = lo.y + em * 0.6f;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 p(lo.x, lo.y), q(lo.x + size.x, lo.y + size.y);
    const bool there = frame.picture_comparison && frame.picture_comparison->picture.texture != 0;
    const std::string other = other_side(state, frame), shown = kVisibleSide;
    if (right_half && !there) list.AddRectFilled(p, q, theme::well());
    if (!there) {
        std::string text = frame.picture_comparison && !frame.picture_comparison->problem.empty()
                               ? frame.picture_comparison->problem
                           : a.reference && frame.reference ? reference_status(frame)
                                                            : "Drawing the other side …";
        if (a.view != ComparisonView::SideBySide || right_half)
            draw_text_on_picture({p.x + em * 0.8f, q.y - em * 2.2f}, text);
        return;
    }
    const PictureComparisonFacts& facts = *frame.picture_comparison;
    switch (a.view) {
        case ComparisonView::Swipe: {
            const float line = std::round(lo.x + a.at * size.x);
            list.PushClipRect({line, p.y}, q, true);
            list.AddImage(texture_id(facts.picture.texture), p, q, {0, 1}, {1, 0});
            list.PopClipRect();
            list.AddLine({line, p.y}, {line, q.y}, theme::kOnPicture, std::max(1.0f, em / 10));
            const float middle = 0.5f * (p.y + q.y), r = em * 0.45f;
            list.AddCircleFilled({line, middle}, r * 1.5f, theme::kVeil);
            list.AddTriangleFilled({line - r * 1.1f, middle}, {line - r * 0.3f, middle - r * 0.6f},
                                   {line - r * 0.3f, middle + r * 0.6f}, theme::kOnPicture);
            list.AddTriangleFilled({line + r * 1.1f, middle}, {line + r * 0.3f, middle + r * 0.6f},
                                   {line + r * 0.3f, middle - r * 0.6f}, theme::kOnPicture);
            label({line, top}, line - p.x, shown, true);
            label({line, top}, q.x - line, other, false);
            break;
        }
        case ComparisonView::SideBySide:
            if (right_half) list.AddImage(texture_id(facts.picture.texture), p, q, {0, 1}, {1, 0});
            label({p.x, top}, size.x, right_half ? other : shown, false);
            break;
        case ComparisonView::Difference:
            if (!facts.difference.texture) break;
            list.AddImage(texture_id(facts.difference.texture), p, q, {0, 1}, {1, 0});
            label({p.x, top}, size.x, fmt::format("Difference ×2, {}   mean |A - B| {:.5f}", other, facts.mae), false);
            break;
        case ComparisonView::Alone:
            list.AddImage(texture_id(facts.picture.texture), p, q, {0, 1}, {1, 0});
            label({p.x, top}, size.x, other, false);
            break;
        case ComparisonView::Off:
            break;
    }
}

void pin_settings(EditorState& state) {
    if (state.flicker) return;
    if (state.pinned && state.pinned->settings == state.settings) {
        state.pinned.reset();
        if (state.compare.kind == CompareKind::Pinned) {
            state.compare = {};
            state.comparison.view = ComparisonView::Off;
        }
        state.log.add(LogKind::Info, "Pin A is taken off");
        return;
    }
    state.pinned = PinnedSettings{state.settings, state.scene_name};
    if (state.comparison.view == ComparisonView::Off) {  // the next comparison is with A
        state.compare = {CompareKind::Pinned, {}};
        state.comparison.reference = false;
    }
    state.log.add(
        LogKind::Info,
        fmt::format("Pinned the present settings as A: hold {} to see them, {} compares with them, {} takes "
                    "the pin off",
                    key_text(Command::ShowPinned), key_text(Command::NextComparison), key_text(Command::PinSettings)));
}

void begin_flicker(EditorState& state) {
    if (state.flicker) return;
    if (!state.pinned) {
        state.log.add(LogKind::Info, fmt::format("Nothing is pinned: {} pins the present settings as A",
                                                 key_text(Command::PinSettings)));
        return;
    }
    state.flicker = Flicker{state.comparison, state.compare};
    state.comparison.view = ComparisonView::Alone;
    state.comparison.reference = false;
    state.comparison.held = false;
    state.compare = {CompareKind::Pinned, {}};
}

void end_flicker(EditorState& state) {
    if (!state.flicker) return;
    state.comparison = state.flicker->picture_comparison;
    state.compare = state.flicker->compare;
    state.flicker.reset();
}

}  // namespace si
