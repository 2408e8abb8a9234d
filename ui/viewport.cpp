// The scene picture: camera by mouse, the light's outline, the probed pixel, the overlay's scale.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "renderer/techniques.h"
#include "ui/camera_steering.h"
#include "ui/light_gizmo.h"
#include "ui/panels.h"
#include "ui/picture_painter.h"
#include "ui/setting_widgets.h"
#include "ui/theme.h"

namespace si {
namespace {

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

/// The pixels whose kernels read the texel under the mouse in the map viewer.
void draw_readers(const EditorState& state, const EditorFrame& frame, ImVec2 origin, ImVec2 size) {
    if (!state.hovered_texel || !frame.texel_usage) return;
    const FloatImage* c = frame.map_coordinates;
    const int n = frame.texel_usage->resolution();
    if (!c || state.hovered_texel->x >= n || state.hovered_texel->y >= n) return;
    const ImVec2 step(size.x / float(c->width), size.y / float(c->height));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const glm::ivec2 p : frame.texel_usage->readers(*state.hovered_texel)) {
        const ImVec2 lo(origin.x + float(p.x) * step.x, origin.y + float(p.y) * step.y);
        list.AddRectFilled(lo, {lo.x + step.x, lo.y + step.y}, IM_COL32(120, 200, 255, 200));
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

void draw_viewport(EditorState& state, const EditorFrame& frame, EditorActions& actions) {
    state.hovered_pixel.reset();
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
    const PictureView view{result.camera, {origin.x, origin.y}, {size.x, size.y}, ImGui::GetFontSize() / 15.0};
    state.scene_view = view;
    if (ImGui::IsItemActivated()) state.press_moved = state.press_taken = false;
    steer_lights(state, frame, view);
    if (!state.press_taken) steer_camera(state, frame, view);
    if (released && hovered && !state.press_moved && !state.press_taken) {
        state.probe_pixel = pixel;
        state.open_tab = BottomTab::Probe;
    }
    list.PushClipRect(origin, end, true);
    const PicturePainter painter(view, list);
    draw_lights(state, frame, painter);
    draw_probe_mark(state, result, origin, size);
    if (hovered) {
        hover_readout(state, frame, origin, pixel);
        state.hovered_pixel = pixel;
        actions.want_links = !state.dragging;
    }
    draw_readers(state, frame, origin, size);
    draw_legend(state.settings, result, origin.x, end.y);
    if (!frame.shader_log.empty())
        veiled_text({origin.x + ImGui::GetFontSize() * 0.8f, origin.y + ImGui::GetFontSize() * 2.2f},
                    "A shader does not compile; the last good one is in use (see Log)");
    list.PopClipRect();
    draw_loading(frame, actions, origin.x, origin.y, size.x);
}

}  // namespace si
