#include "ui/scene_view/camera_steering.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "renderer/settings/param.h"
#include "renderer/view/cameras/make_camera.h"
#include "ui/scene_view/camera_gesture.h"
#include "ui/state/panels.h"
#include "ui/state/selection.h"
#include "ui/state/shortcuts.h"

namespace si {
namespace {

constexpr double kWheelSeconds = 0.4;    ///< turns of the wheel closer than this are one step of undo
constexpr double kRadiiPerSecond = 0.4;  ///< flying speed at factor 1, in radii of the scene per second
constexpr double kFast = 4;              ///< factor of the speed with Shift
constexpr double kSpeedPerStep = 1.25;   ///< factor of the speed per step of the wheel
constexpr double kLongestStep = 0.5;     ///< s; limits the step of a frame that took longer

/// Returns the direction of the held keys: right, up, forward.
glm::dvec3 wanted_way() {
    const auto held = [](Command command) { return is_held(command) ? 1.0 : 0.0; };
    return {held(Command::FlyRight) - held(Command::FlyLeft), held(Command::FlyUp) - held(Command::FlyDown),
            held(Command::FlyForwards) - held(Command::FlyBackwards)};
}

void fly_camera(EditorState& state, const EditorFrame& frame) {
    Flight& flight = state.viewport.flight;
    const ImGuiIO& io = ImGui::GetIO();
    if (io.MouseWheel != 0)
        flight.speed = std::clamp(flight.speed * std::pow(kSpeedPerStep, double(io.MouseWheel)), 1e-3, 1e3);
    const glm::dvec3 way = wanted_way();
    const bool moving = way != glm::dvec3(0);
    if (io.MouseDelta.x != 0 || io.MouseDelta.y != 0 || moving) take_camera(state, frame);
    state.viewport.camera_flew |=
        moving || io.MouseWheel != 0 || std::ranges::any_of(io.KeysDown, [](bool down) { return down; });
    turn_camera(state.settings.camera, io.MouseDelta.x, io.MouseDelta.y);
    // The time before a key's press does not count; else an editor that slept would jump.
    if (moving && flight.moving) {
        const double radius = frame.scene ? std::max(frame.scene->bounds.radius(), 1e-6) : 1;
        const double seconds = std::min(double(io.DeltaTime), kLongestStep);
        const double metres = radius * kRadiiPerSecond * flight.speed * (io.KeyShift ? kFast : 1) * seconds;
        move_camera(state.settings.camera, glm::normalize(way) * metres);
    }
    flight.moving = moving;
}

void frame_bounds(EditorState& state, const EditorFrame& frame, const Bounds& bounds) {
    take_camera(state, frame);
    fill_picture_with(state.settings.camera, bounds, frame.result ? frame.result->camera.aspect : 1.5);
}

}  // namespace

void take_camera(EditorState& state, const EditorFrame& frame) {
    const double aspect = frame.result ? frame.result->camera.aspect : 1.5;
    if (frame.scene) state.settings.camera = manual_camera(*frame.scene, state.settings, aspect);
}

void steer_camera(EditorState& state, const EditorFrame& frame, const PictureView& view) {
    const ImGuiIO& io = ImGui::GetIO();
    const ImVec2 d = io.MouseDelta;
    const bool left = ImGui::IsMouseDown(ImGuiMouseButton_Left);
    const bool moved = ImGui::IsMouseDragging(ImGuiMouseButton_Left, kClickPixels) ||
                       ImGui::IsMouseDragging(ImGuiMouseButton_Middle, kClickPixels);
    state.viewport.flight.on = ImGui::IsItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Right);
    if (ImGui::IsItemActivated()) state.viewport.camera_flew = false;
    if (state.viewport.flight.on) {
        state.viewport.dragging = state.viewport.press_moved = true;
        return fly_camera(state, frame);
    }
    state.viewport.flight.moving = false;
    if (ImGui::IsItemActive() && moved) {
        state.viewport.dragging = state.viewport.press_moved = true;
        const int light = shown_light(state.settings);
        if (left && io.KeyCtrl && light >= 0) {
            turn_light(state.settings.lights[std::size_t(light)], view.camera, d.x, d.y);
        } else {
            take_camera(state, frame);
            if (left && !io.KeyShift)
                orbit_camera(state.settings.camera, d.x, d.y);
            else
                pan_camera(state.settings.camera, view.camera, d.x, d.y, int(view.size.y));
        }
    }
    if (ImGui::IsItemHovered() && io.MouseWheel != 0 && !io.KeyCtrl) {
        take_camera(state, frame);
        zoom_camera(state.settings.camera, view.camera, view.ray({io.MousePos.x, io.MousePos.y}), io.MouseWheel);
        state.viewport.wheel_until = ImGui::GetTime() + kWheelSeconds;
    }
}

void frame_selection(EditorState& state, const EditorFrame& frame) {
    if (!frame.scene) return;
    const Bounds selected = bounds_of(*frame.scene, selected_objects(state));
    frame_bounds(state, frame, selected.empty() ? frame.scene->bounds : selected);
}

void frame_light(EditorState& state, const EditorFrame& frame, const glm::dvec3& position) {
    if (!frame.scene) return;
    Bounds both = frame.scene->bounds;
    both.add(position);
    frame_bounds(state, frame, both);
}

void reset_camera(EditorState& state, const EditorFrame& frame) {
    state.settings.camera = CameraSettings{.index = state.settings.camera.index};
    if (!frame.scene) return;
    for (const auto& [key, value] : frame.scene->suggested)
        if (key.starts_with("camera.")) set_setting(state.settings, key, value);
}

void toggle_light_camera(EditorState& state) {
    CameraSettings& camera = state.settings.camera;
    if (camera.source != CameraSource::Light) {
        if (shown_light(state.settings) < 0) return;
        state.viewport.camera_before_light = camera;
        camera.source = CameraSource::Light;
        return;
    }
    camera = state.viewport.camera_before_light.value_or(CameraSettings{});
    if (camera.source == CameraSource::Light) camera.source = CameraSource::Automatic;
    state.viewport.camera_before_light.reset();
}

FrozenCamera frozen_camera_of(const FrameResult& result, const CameraSettings& settings) {
    const bool manual = settings.source == CameraSource::Manual;
    return {.camera = result.camera,
            .settings = manual ? settings : camera_settings(result.camera),
            .pixels = {result.colour.width, result.colour.height},
            .seen_m = result.seen_m};
}

void toggle_frozen_camera(EditorState& state, const EditorFrame& frame) {
    if (state.frozen)
        state.frozen.reset();
    else if (frame.result)
        state.frozen = frozen_camera_of(*frame.result, state.settings.camera);
}

}  // namespace si
