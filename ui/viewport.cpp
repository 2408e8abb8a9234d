// The scene picture: camera by mouse, the light's outline, the probed pixel, the overlay's scale.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "renderer/techniques.h"
#include "ui/camera_gesture.h"
#include "ui/light_lines.h"
#include "ui/panels.h"
#include "ui/setting_widgets.h"
#include "ui/theme.h"

namespace si {
namespace {

constexpr float kClickPixels = 3;      ///< a press that moves further is a drag
constexpr double kWheelSeconds = 0.4;  ///< turns of the wheel closer than this are one step of undo

ImTextureID texture_id(unsigned texture) {
    return reinterpret_cast<ImTextureID>(std::uintptr_t(texture));
}

void header(EditorState& state) {
    Settings& s = state.settings;
    const float em = ImGui::GetFontSize();
    ImGui::PushFont(theme::strong());
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Scene");
    ImGui::PopFont();
    ImGui::SameLine(0, em);
    ImGui::TextDisabled("Overlay");
    ImGui::SameLine();
    setting_widget(s, "view.overlay", em * 10.5f);
    if (s.view.overlay > 0) {
        ImGui::SameLine();
        ImGui::TextDisabled("Opacity");
        ImGui::SameLine();
        setting_widget(s, "view.overlay_opacity", em * 5.5f);
    }
    ImGui::SameLine();
    ImGui::TextDisabled("Frustum");
    ImGui::SameLine();
    setting_widget(s, "view.frustum");
}

void take_camera(EditorState& state, const EditorFrame& frame) {
    if (frame.scene && frame.result)
        state.settings.camera = manual_camera(*frame.scene, state.settings, frame.result->camera.aspect);
}

void steer(EditorState& state, const EditorFrame& frame, float height) {
    const ImGuiIO& io = ImGui::GetIO();
    const ImVec2 d = io.MouseDelta;
    const bool left = ImGui::IsMouseDown(ImGuiMouseButton_Left);
    const bool moved = ImGui::IsMouseDragging(ImGuiMouseButton_Left, kClickPixels) ||
                       ImGui::IsMouseDragging(ImGuiMouseButton_Right, kClickPixels) ||
                       ImGui::IsMouseDragging(ImGuiMouseButton_Middle, kClickPixels);
    if (ImGui::IsItemActivated()) state.press_moved = false;
    if (ImGui::IsItemActive() && moved) {
        state.press_moved = true;
        state.dragging = true;
        const int light = shown_light(state.settings);
        if (left && io.KeyCtrl && light >= 0) {
            turn_light(state.settings.lights[std::size_t(light)], frame.result->camera, d.x, d.y);
        } else {
            take_camera(state, frame);
            CameraSettings& camera = state.settings.camera;
            if (left && !io.KeyShift)
                orbit(camera, d.x, d.y);
            else
                pan(camera, frame.result->camera, d.x, d.y, int(height));
        }
    }
    if (ImGui::IsItemHovered() && io.MouseWheel != 0 && !io.KeyCtrl) {
        take_camera(state, frame);
        zoom(state.settings.camera, io.MouseWheel);
        state.wheel_until = ImGui::GetTime() + kWheelSeconds;
    }
}

/// Lines of the shown light's frustum and a mark where the light stands.
void draw_light(const EditorState& state, const FrameResult& result, ImVec2 origin, ImVec2 size) {
    const int light = shown_light(state.settings);
    if (light < 0 || std::size_t(light) >= result.lights.size()) return;
    const FittedLight& fitted = result.lights[std::size_t(light)];
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float em = ImGui::GetFontSize();
    const int w = int(size.x), h = int(size.y);
    const auto line = [&](const glm::dvec3& a, const glm::dvec3& b, ImU32 colour) {
        if (const auto on = project_segment(result.camera, a, b, w, h)) {
            const ImVec2 p(origin.x + float(on->first.x + 0.5), origin.y + float(on->first.y + 0.5));
            const ImVec2 q(origin.x + float(on->second.x + 0.5), origin.y + float(on->second.y + 0.5));
            list.AddLine(p, q, IM_COL32(0, 0, 0, 110), em * 0.2f);
            list.AddLine(p, q, colour, em * 0.09f);
        }
    };
    const ImU32 near_colour = theme::kAccent, far_colour = IM_COL32(196, 158, 84, 170);
    for (std::size_t face = 0; face < fitted.views.size(); ++face) {
        const bool shown = fitted.views.size() == 1 || int(face) == shown_face(state.settings, result);
        for (const Segment& s : frustum_edges(fitted.views[face]))
            if (shown) line(s.from, s.to, s.far ? far_colour : near_colour);
    }
    if (fitted.views.empty()) return;
    const LightView& view = fitted.views[0];
    const glm::dvec3 eye = fitted.type == LightType::Directional ? view.eye : fitted.position;
    if (const auto on = project_segment(result.camera, eye, eye, w, h)) {
        const ImVec2 p(origin.x + float(on->first.x + 0.5), origin.y + float(on->first.y + 0.5));
        list.AddCircleFilled(p, em * 0.32f, IM_COL32(0, 0, 0, 150), 20);
        list.AddCircleFilled(p, em * 0.22f, theme::kAccent, 20);
    }
    if (fitted.type != LightType::Point) {
        const glm::dvec3 towards =
            view.eye - view.axes[2] * (0.12 * (view.curve.far - view.curve.near) + view.curve.near);
        line(eye, towards, theme::kAccent);
    }
}

void draw_probe_mark(const EditorState& state, const FrameResult& result, ImVec2 origin, ImVec2 size) {
    if (!state.probe_pixel || result.colour.width <= 0) return;
    const float em = ImGui::GetFontSize();
    const ImVec2 p(origin.x + (float(state.probe_pixel->x) + 0.5f) * size.x / float(result.colour.width),
                   origin.y + (float(state.probe_pixel->y) + 0.5f) * size.y / float(result.colour.height));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const auto& [colour, thick] : {std::pair{IM_COL32(0, 0, 0, 160), em * 0.25f}, {IM_COL32_WHITE, em * 0.1f}}) {
        list.AddCircle(p, em * 0.5f, colour, 24, thick);
        for (const ImVec2 d : {ImVec2(1, 0), ImVec2(-1, 0), ImVec2(0, 1), ImVec2(0, -1)})
            list.AddLine({p.x + d.x * em * 0.5f, p.y + d.y * em * 0.5f}, {p.x + d.x * em, p.y + d.y * em}, colour,
                         thick);
    }
}

void veiled_text(ImVec2 at, const std::string& text) {
    const float em = ImGui::GetFontSize();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({at.x - em * 0.4f, at.y - em * 0.2f}, {at.x + size.x + em * 0.4f, at.y + size.y + em * 0.2f},
                       theme::kVeil, em * 0.2f);
    list.AddText(at, theme::kText, text.c_str());
}

void hover_readout(const EditorState& state, const EditorFrame& frame, ImVec2 origin, glm::ivec2 pixel) {
    std::string text = fmt::format("{}, {}", pixel.x, pixel.y);
    const int overlay = state.settings.view.overlay;
    const FloatImage* values = frame.overlay_values;
    if (values && overlay > 0 && std::size_t(overlay) <= overlays().size() && pixel.x < values->width &&
        pixel.y < values->height) {
        const Overlay& row = overlays()[std::size_t(overlay - 1)];
        const float value = values->at(pixel.x, pixel.y, 0);
        if (values->at(pixel.x, pixel.y, 3) <= 0)
            text += "   background";
        else if (row.scalar && std::isnan(value))
            text += fmt::format("   {}: no value here", row.label);
        else if (row.scalar)
            text += fmt::format("   {} {:.5g} {}", row.label, value, row.unit);
        else
            text += fmt::format("   {} {:.3f} {:.3f} {:.3f}", row.label, value, values->at(pixel.x, pixel.y, 1),
                                values->at(pixel.x, pixel.y, 2));
    }
    const float em = ImGui::GetFontSize();
    veiled_text({origin.x + em * 0.8f, origin.y + em * 0.6f}, text);
}

}  // namespace

int shown_light(const Settings& settings) {
    const int count = std::clamp(settings.light_count, 0, kMaxLights);
    return count == 0 ? -1 : std::clamp(settings.view.light, 0, count - 1);
}

int shown_face(const Settings& settings, const FrameResult& result) {
    const int light = shown_light(settings);
    if (light < 0 || std::size_t(light) >= result.lights.size()) return 0;
    return std::clamp(settings.view.face, 0, std::max(0, int(result.lights[std::size_t(light)].views.size()) - 1));
}

void frame_scene(EditorState& state, const EditorFrame& frame) {
    if (!frame.scene) return;
    const double aspect = frame.result ? frame.result->camera.aspect : 1.5;
    state.settings.camera = manual_camera(*frame.scene, state.settings, aspect);
    look_at_bounds(state.settings.camera, frame.scene->bounds, aspect);
}

void draw_viewport(EditorState& state, const EditorFrame& frame, EditorActions& actions) {
    header(state);
    const ImVec2 origin = ImGui::GetCursorScreenPos(), available = ImGui::GetContentRegionAvail();
    const ImVec2 size(std::floor(std::max(available.x, 16.0f)), std::floor(std::max(available.y, 16.0f)));
    const ImVec2 end(origin.x + size.x, origin.y + size.y);
    const float pixels = ImGui::GetIO().DisplayFramebufferScale.x;
    actions.scene_width = int(size.x * pixels);
    actions.scene_height = int(size.y * pixels);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(origin, end, theme::kWell);
    if (!frame.result || frame.result->colour.texture == 0) {
        const std::string text = frame.problem.empty() ? "No picture yet" : std::string(frame.problem);
        ImGui::SetCursorScreenPos({origin.x + ImGui::GetFontSize(), origin.y + ImGui::GetFontSize()});
        ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + size.x - 2 * ImGui::GetFontSize());
        ImGui::TextUnformatted(text.c_str());
        ImGui::PopTextWrapPos();
        draw_loading(frame, actions, origin.x, origin.y, size.x);
        return;
    }
    const FrameResult& result = *frame.result;
    list.AddImage(texture_id(result.colour.texture), origin, end, {0, 1}, {1, 0});  // stored bottom row first
    ImGui::InvisibleButton(
        "scene picture", size,
        ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
    const bool hovered = ImGui::IsItemHovered();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const glm::ivec2 pixel(std::clamp(int((mouse.x - origin.x) / size.x * float(result.colour.width)), 0,
                                      std::max(0, result.colour.width - 1)),
                           std::clamp(int((mouse.y - origin.y) / size.y * float(result.colour.height)), 0,
                                      std::max(0, result.colour.height - 1)));
    const bool released = ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left);
    steer(state, frame, size.y);
    if (released && hovered && !state.press_moved) {
        state.probe_pixel = pixel;
        state.open_tab = BottomTab::Probe;
    }
    list.PushClipRect(origin, end, true);
    if (state.settings.view.frustum) draw_light(state, result, origin, size);
    draw_probe_mark(state, result, origin, size);
    if (hovered) hover_readout(state, frame, origin, pixel);
    draw_legend(state.settings, result, origin.x, end.y);
    if (!frame.shader_log.empty())
        veiled_text({origin.x + ImGui::GetFontSize() * 0.8f, origin.y + ImGui::GetFontSize() * 2.2f},
                    "A shader does not compile; the last good one is in use (see Log)");
    list.PopClipRect();
    draw_loading(frame, actions, origin.x, origin.y, size.x);
}

}  // namespace si
