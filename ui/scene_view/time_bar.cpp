// Controls of the animation below the pictures: choice, time, play and speed.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "ui/state/panels.h"
#include "ui/state/playback.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/combo.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/slider.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr char kSteady[] = "Steady map";
constexpr double kSpeeds[] = {0.1, 0.25, 0.5, 1, 2, 4};

/// Draws the play button: a triangle to play, two bars to pause.
bool play_button(bool playing, bool enabled) {
    const float size = ImGui::GetFrameHeight();
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button("##play", {size * 1.4f, size});
    const ImU32 colour = ImGui::GetColorU32(ImGuiCol_Text);
    ImGui::EndDisabled();
    const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
    const ImVec2 c((lo.x + hi.x) * 0.5f, (lo.y + hi.y) * 0.5f);
    const float r = size * 0.24f;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (playing) {
        list.AddRectFilled({c.x - r, c.y - r}, {c.x - r * 0.3f, c.y + r}, colour);
        list.AddRectFilled({c.x + r * 0.3f, c.y - r}, {c.x + r, c.y + r}, colour);
    } else {
        list.AddTriangleFilled({c.x - r * 0.8f, c.y - r}, {c.x - r * 0.8f, c.y + r}, {c.x + r, c.y}, colour);
    }
    plain_tooltip(enabled ? with_key(playing ? "Pause" : "Play", Command::TogglePlay)
                          : "Choose an animation that lasts some time",
                  ImGuiHoveredFlags_AllowWhenDisabled);
    return pressed;
}

void speed_combo(Playback& playback, float width) {
    ImGui::SetNextItemWidth(width);
    if (begin_combo("##speed", fmt::format("{}×", playback.speed))) {
        for (const double speed : kSpeeds)
            if (ImGui::Selectable(fmt::format("{}×", speed).c_str(), speed == playback.speed)) playback.speed = speed;
        ImGui::EndCombo();
    } else {
        plain_tooltip("Seconds of the animation in a second of playing");
    }
}

}  // namespace

float time_bar_height(const EditorFrame& frame) {
    const bool moves = frame.scene && frame.scene->rig && !frame.scene->rig->animations.empty();
    return moves ? ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().WindowPadding.y : 0;
}

void draw_time_bar(EditorState& state, const EditorFrame& frame) {
    const float em = ImGui::GetFontSize(), gap = ImGui::GetStyle().ItemSpacing.x;
    SceneSettings& scene = state.settings.scene;
    const Animation* animation = chosen_animation(frame, scene);
    const double end = animation ? animation->duration_s : 0;
    // A small window has no room for speed and loop; the loop switch is also among the settings.
    const float room = ImGui::GetContentRegionAvail().x;
    const bool has_steady = room > em * 36, has_speed = room > em * 28;
    if (play_button(state.playback.playing, end > 0)) toggle_play(state, frame);
    ImGui::SameLine();
    setting_widget(state.settings, *find_setting("scene.animation"), std::min(em * 10, room * 0.3f),
                   scene_choices(frame.scene, "scene.animation"));
    ImGui::SameLine();
    const auto box_width = [&](const char* label) {
        return ImGui::CalcTextSize(label).x + ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x + gap;
    };
    const float speed = em * 5;
    const float after = box_width("Loop") + (has_speed ? speed + gap : 0) + (has_steady ? box_width(kSteady) : 0);
    ImGui::SetNextItemWidth(std::max(em * 5, ImGui::GetContentRegionAvail().x - after));
    if (!(end > 0)) ImGui::BeginDisabled();
    const double start = 0, last = std::max(end, 1e-3);
    const std::string format = fmt::format("%.2f of {:.2f} s", end);
    if (slider("##time", ImGuiDataType_Double, &scene.time, &start, &last, format.c_str(),
               ImGuiSliderFlags_AlwaysClamp))
        state.playback.playing = false;  // the drag itself becomes the step of undo
    if (!(end > 0)) ImGui::EndDisabled();
    if (!ImGui::IsItemActive()) plain_tooltip("The time that is shown (scene.time); Ctrl+click to type it");
    ImGui::SameLine();
    if (has_speed) {
        speed_combo(state.playback, speed);
        ImGui::SameLine();
    }
    ImGui::Checkbox("Loop", &state.playback.loop);
    plain_tooltip("Begin again after the last key; else stop there");
    if (!has_steady) return;
    ImGui::SameLine();
    if (!(end > 0)) ImGui::BeginDisabled();
    ImGui::Checkbox(kSteady, &scene.fit_animation);
    if (!(end > 0)) ImGui::EndDisabled();
    setting_menu(state.settings, *find_setting("scene.fit_animation"));
}

}  // namespace si
