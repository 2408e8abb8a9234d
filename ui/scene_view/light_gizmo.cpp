// Lights in the scene picture: frusta and marks of all lights, handles of the shown one.
#include <imgui.h>

#include <algorithm>

#include "ui/scene_view/camera_steering.h"
#include "ui/scene_view/light_marks.h"
#include "ui/scene_view/scene_marks.h"
#include "ui/state/panels.h"

namespace si {
namespace {

constexpr double kHitPixels = 10;         // radius at scale 1
constexpr double kHandleClickPixels = 3;  // a press that moves further is a drag

bool shows_lights(const EditorState& state, const EditorFrame& frame) {
    return state.settings.view.frustum && frame.result && shown_light(state.settings) >= 0;
}

/// Returns the number of lights that both the settings and the last frame have.
int light_count(const EditorState& state, const FrameResult& result) {
    return std::min(state.settings.light_count, int(result.lights.size()));
}

/// Returns true if handles are shown. The view through a light has none, because a drag would move the camera.
bool shows_handles(const EditorState& state) {
    return state.settings.camera.source != CameraSource::Light;
}

constexpr double kNearPixels = 110;  ///< distance from the mouse at which a gizmo appears, at scale 1

LightPose pose_of(const EditorState& state, const FrameResult& result, int light) {
    const int face = light == shown_light(state.settings) ? shown_face(state.settings, result) : 0;
    return light_pose(state.settings.lights[std::size_t(light)], result.lights[std::size_t(light)], face);
}

std::optional<LightHit> hit(const EditorState& state, const FrameResult& result, const PictureView& view,
                            const glm::dvec2& mouse) {
    const int shown = shown_light(state.settings), count = light_count(state, result);
    double nearest = kHitPixels * view.ui_scale;
    std::optional<LightHit> found;
    const auto take = [&](const glm::dvec2& at, const LightHit& what) {
        if (glm::distance(at, mouse) > nearest) return;
        nearest = glm::distance(at, mouse);
        found = what;
    };
    const bool handles = shown < count && shows_handles(state);
    if (handles)
        for (const PlacedHandle& p : place_handles(pose_of(state, result, shown), view))
            take(p.on_screen, {shown, p.handle});
    if (found) return found;
    if (handles)
        if (const auto at = pointer_place(pose_of(state, result, shown), view)) take(*at, {shown, {}});
    for (int i = 0; i < count; ++i)
        if (i != shown)
            if (const auto at = view.point(pose_of(state, result, i).position)) take(*at, {i, {}});
    return found;
}

void begin_drag(EditorState& state, const FrameResult& result, const PictureView& view, const LightHit& on,
                const glm::dvec2& mouse) {
    const LightPose pose = pose_of(state, result, on.light);
    HandleDrag drag;
    drag.light = on.light;
    drag.handle = *on.handle;
    drag.start = grab_light(pose, *on.handle, result.lights[std::size_t(on.light)]);
    drag.before = pose.settings;
    drag.pressed_at = mouse;
    drag.handle_at = view.point(handle_position(drag.start, drag.handle, view)).value_or(mouse);
    state.viewport.handle_drag = drag;
}

void follow(EditorState& state, const EditorFrame& frame, const PictureView& view, const glm::dvec2& mouse) {
    HandleDrag& drag = *state.viewport.handle_drag;
    LightSettings& light = state.settings.lights[std::size_t(drag.light)];
    drag.moved = drag.moved || glm::distance(mouse, drag.pressed_at) > kHandleClickPixels * view.ui_scale;
    if (drag.over || !drag.moved) return;
    const double radius = frame.scene ? frame.scene->bounds.radius() : drag.start.distance;
    const double step = ImGui::GetIO().KeyCtrl ? snap_step(radius) : 0;
    if (const auto moved = drag_light(drag.start, drag.handle, view, drag.handle_at + mouse - drag.pressed_at, step))
        light = *moved;
}

/// Returns true if the gizmo of a light is drawn: with the look "studio" only near the mouse, while a light is dragged,
/// and with the list of lights open.
bool shows_gizmo(const EditorState& state, const FrameResult& result, const PictureView& view, int light) {
    if (state.settings.view.look != Look::Studio || state.viewport.lights_listed) return true;
    if (state.viewport.handle_drag || (state.viewport.hovered_light && state.viewport.hovered_light->light == light))
        return true;
    const glm::dvec2 mouse(ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y);
    const auto near = [&](const glm::dvec2& at) { return glm::distance(at, mouse) < kNearPixels * view.ui_scale; };
    const LightPose pose = pose_of(state, result, light);
    if (const auto mark = view.point(pose.position); mark && near(*mark)) return true;
    if (light != shown_light(state.settings)) return false;
    if (const auto pointer = pointer_place(pose, view); pointer && near(*pointer)) return true;
    const auto handles = place_handles(pose, view);
    return std::ranges::any_of(handles, near, &PlacedHandle::on_screen);
}

}  // namespace

void cancel_handle_drag(EditorState& state) {
    HandleDrag& drag = *state.viewport.handle_drag;
    if (!drag.over) state.settings.lights[std::size_t(drag.light)] = drag.before;
    drag.over = true;
}

void steer_lights(EditorState& state, const EditorFrame& frame, const PictureView& view) {
    const glm::dvec2 mouse(ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y);
    if (!ImGui::IsItemActive()) state.viewport.handle_drag.reset();
    state.viewport.hovered_light.reset();
    if (!shows_lights(state, frame)) return;
    if (state.viewport.handle_drag) {
        follow(state, frame, view, mouse);
        state.viewport.dragging = true;
        state.viewport.hovered_light = LightHit{state.viewport.handle_drag->light, state.viewport.handle_drag->handle};
        return;
    }
    const bool pressed = ImGui::IsItemActivated() && ImGui::IsMouseDown(ImGuiMouseButton_Left);
    if (state.viewport.press_taken || !ImGui::IsItemHovered() || (ImGui::IsItemActive() && !pressed)) return;
    const auto on = hit(state, *frame.result, view, mouse);
    state.viewport.hovered_light = on;
    if (!on || !pressed) return;
    state.viewport.press_taken = true;
    if (on->handle)
        begin_drag(state, *frame.result, view, *on, mouse);
    else if (on->light != shown_light(state.settings))
        state.settings.view.light = on->light;
    else
        frame_light(state, frame, pose_of(state, *frame.result, on->light).position);
}

void draw_lights(const EditorState& state, const EditorFrame& frame, const PicturePainter& painter) {
    if (!shows_lights(state, frame)) return;
    const FrameResult& result = *frame.result;
    const int shown = shown_light(state.settings), count = light_count(state, result);
    const auto& hovered = state.viewport.hovered_light;
    for (int i = 0; i < count; ++i)
        if (i != shown && shows_gizmo(state, result, painter.view(), i))
            draw_other_light(painter, pose_of(state, result, i), result.lights[std::size_t(i)],
                             hovered && hovered->light == i);
    if (shown >= count) return;  // a light was just added
    if (!shows_gizmo(state, result, painter.view(), shown)) return;
    const LightPose pose = pose_of(state, result, shown);
    const bool busy = hovered && hovered->light == shown;
    draw_shown_light(painter, pose, busy, busy && !hovered->handle);
    if (shows_handles(state)) draw_handles(painter, pose, hovered ? hovered->handle : std::nullopt);
    if (state.viewport.handle_drag && state.viewport.handle_drag->moved)
        draw_numbers(painter, pose, state.viewport.handle_drag->handle, result.map_size);
    else if (hovered && hovered->handle)
        handle_tooltip(pose, *hovered->handle);
    else if (hovered && hovered->light == shown)
        ImGui::SetTooltip("Light %d stands outside the picture: click to bring it in", shown);
    else if (hovered)
        ImGui::SetTooltip("Light %d: click to show its map and handles", hovered->light);
}

}  // namespace si
