// The shadow map beside the scene: how it is shown, zoom and pan, the exact value of a texel.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/panels.h"
#include "ui/setting_widgets.h"
#include "ui/theme.h"

namespace si {
namespace {

constexpr float kZoomPerStep = 1.25f, kMaxTexelPixels = 64;

void labelled(const char* label, Settings& s, const char* key, float width) {
    ImGui::SameLine();
    ImGui::TextDisabled("%s", label);
    ImGui::SameLine();
    setting_widget(s, key, width);
}

void header(EditorState& state, const FrameResult* result) {
    Settings& s = state.settings;
    const float em = ImGui::GetFontSize();
    ImGui::PushFont(theme::strong());
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Shadow map");
    ImGui::PopFont();
    ImGui::SameLine(0, em);
    setting_widget(s, "view.map", em * 5.5f);
    if (s.light_count > 1) labelled("Light", s, "view.light", em * 4);
    const int light = shown_light(s);
    const bool point = result && light >= 0 && std::size_t(light) < result->lights.size() &&
                       result->lights[std::size_t(light)].views.size() > 1;
    if (point) labelled("Face", s, "view.face", em * 4);
    const bool bands = s.view.map == int(MapView::Bands);
    const float needed = em * 13;
    if (ImGui::GetContentRegionAvail().x > 0) ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < needed) ImGui::NewLine();
    ImGui::TextDisabled(bands ? "Bands" : "Range");
    ImGui::SameLine();
    setting_widget(s, bands ? "view.band_low" : "view.map_black", em * 4.6f);
    ImGui::SameLine();
    setting_widget(s, bands ? "view.band_high" : "view.map_white", em * 4.6f);
}

/// What the map is, and what its texels mean.
std::pair<std::string, std::string> title(const Settings& s, const FrameResult& result, const FittedLight& fitted,
                                          const LightView& view) {
    std::string format = "?";
    if (const auto ref = find_setting("map.format")) format = ref->param->choices()[std::size_t(s.map.format)].label;
    const int n = result.map_resolution;
    const double near_texel = view.texel_size(view.curve.near, n), far_texel = view.texel_size(view.curve.far, n);
    const std::string texel = view.curve.perspective
                                  ? fmt::format("{} to {}", metres_text(near_texel), metres_text(far_texel))
                                  : metres_text(far_texel);
    constexpr const char* kFaces[] = {"+x", "-x", "+y", "-y", "+z", "-z"};
    const int face = shown_face(s, result);
    return {fmt::format("light {}{}   {}×{}   {}", shown_light(s),
                        fitted.views.size() > 1 ? fmt::format(" {}", kFaces[face]) : "", n, n, format),
            fmt::format("texel {}   depth {} to {}", texel, metres_text(view.curve.near), metres_text(view.curve.far))};
}

/// The square on screen that the whole map covers.
struct Square {
    ImVec2 lo;
    float side;
    glm::vec2 uv(ImVec2 p) const { return {(p.x - lo.x) / side, 1 - (p.y - lo.y) / side}; }
};

Square place(const MapWindow& window, ImVec2 origin, ImVec2 size) {
    const float side = std::min(size.x, size.y) * window.zoom;
    return {
        {origin.x + 0.5f * size.x - window.centre.x * side, origin.y + 0.5f * size.y - (1 - window.centre.y) * side},
        side};
}

void steer(MapWindow& window, ImVec2 origin, ImVec2 size, int resolution) {
    const ImGuiIO& io = ImGui::GetIO();
    const float fit = std::min(size.x, size.y);
    if (ImGui::IsItemHovered() && io.MouseWheel != 0) {
        const glm::vec2 under = place(window, origin, size).uv(io.MousePos);
        const float most = std::max(1.0f, kMaxTexelPixels * float(std::max(resolution, 1)) / fit);
        window.zoom = std::clamp(window.zoom * std::pow(kZoomPerStep, io.MouseWheel), 1.0f, most);
        const glm::vec2 now = place(window, origin, size).uv(io.MousePos);
        window.centre += under - now;
    }
    if (ImGui::IsItemActive()) {
        window.centre.x -= io.MouseDelta.x / (fit * window.zoom);
        window.centre.y += io.MouseDelta.y / (fit * window.zoom);
    }
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) window = {};
    window.centre = glm::clamp(window.centre, glm::vec2(0), glm::vec2(1));
    if (window.zoom <= 1) window.centre = glm::vec2(0.5f);
}

void outline_texel(const Square& square, glm::ivec2 texel, int n, ImU32 colour) {
    const float step = square.side / float(n), em = ImGui::GetFontSize();
    const ImVec2 lo(square.lo.x + float(texel.x) * step, square.lo.y + float(n - 1 - texel.y) * step);
    const ImVec2 hi(lo.x + step, lo.y + step);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (step < em * 0.5f) {  // too small to outline: a ring around it
        const ImVec2 c(0.5f * (lo.x + hi.x), 0.5f * (lo.y + hi.y));
        list.AddCircle(c, em * 0.45f, IM_COL32(0, 0, 0, 170), 20, em * 0.24f);
        list.AddCircle(c, em * 0.45f, colour, 20, em * 0.1f);
        return;
    }
    list.AddRect(lo, hi, IM_COL32(0, 0, 0, 170), 0, 0, em * 0.24f);
    list.AddRect(lo, hi, colour, 0, 0, em * 0.1f);
}

std::pair<std::string, std::string> readout(const EditorFrame& frame, const LightView& view, glm::ivec2 texel, int n) {
    const std::string where = fmt::format("texel {}, {}", texel.x, texel.y);
    const FloatImage* values = frame.map_values;
    if (!values || values->width != n || values->height != n) return {where, {}};
    const double stored = values->at(texel.x, n - 1 - texel.y);
    const std::string depth = fmt::format("stored {:.7f}", stored);
    if (stored == view.curve.convention.far_depth()) return {where + "   " + depth, "nothing drawn (far plane)"};
    const double z = view.curve.distance(stored);
    const double share = (z - view.curve.near) / (view.curve.far - view.curve.near);
    return {where + "   " + depth, fmt::format("linear {:.5f}   {}", share, metres_text(z))};
}

}  // namespace

std::string metres_text(double metres) {
    const double a = std::abs(metres);
    if (!std::isfinite(metres)) return "no distance";
    if (a == 0) return "0 m";
    if (a < 1e-3) return fmt::format("{:.3g} µm", metres * 1e6);
    if (a < 1) return fmt::format("{:.3g} mm", metres * 1e3);
    if (a < 1e4) return fmt::format("{:.4g} m", metres);
    return fmt::format("{:.4g} km", metres * 1e-3);
}

void draw_map_viewer(EditorState& state, const EditorFrame& frame, EditorActions& actions) {
    header(state, frame.result);
    const float em = ImGui::GetFontSize();
    const ImVec2 origin = ImGui::GetCursorScreenPos(), available = ImGui::GetContentRegionAvail();
    const float line = theme::small()->FontSize * 1.25f, caption = 2 * line + em * 0.2f;
    const ImVec2 size(std::max(available.x, 16.0f), std::max(available.y - caption, 16.0f));
    const ImVec2 end(origin.x + size.x, origin.y + size.y);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(origin, end, theme::kWell);
    actions.want_map = true;
    const int light = shown_light(state.settings);
    const auto say = [&](const std::string& text) {
        ImGui::SetCursorScreenPos({origin.x + em, origin.y + em});
        ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + size.x - 2 * em);
        ImGui::TextUnformatted(text.c_str());
        ImGui::PopTextWrapPos();
    };
    if (light < 0) return say("No light: light.count is 0.");
    if (!frame.result) return;
    const FrameResult& result = *frame.result;
    if (std::size_t(light) >= result.lights.size()) return;  // a light was added a moment ago
    const FittedLight& fitted = result.lights[std::size_t(light)];
    if (!fitted.casts || fitted.views.empty())
        return say(fmt::format("Light {} has no shadow map: {}.", light,
                               fitted.reason.empty() ? "it casts no shadow" : fitted.reason));
    if (result.map_view.texture == 0 || result.map_resolution <= 0) return say("The shadow map was not drawn.");

    const LightView& view = fitted.views[std::size_t(shown_face(state.settings, result))];
    const int n = result.map_resolution;
    ImGui::InvisibleButton("map picture", size);
    const bool hovered = ImGui::IsItemHovered();
    if (ImGui::IsItemActive()) state.dragging = true;
    steer(state.map_window, origin, size, n);
    const Square square = place(state.map_window, origin, size);
    list.PushClipRect(origin, end, true);
    list.AddImage(reinterpret_cast<ImTextureID>(std::uintptr_t(result.map_view.texture)), square.lo,
                  {square.lo.x + square.side, square.lo.y + square.side}, {0, 1}, {1, 0});  // stored bottom row first
    list.AddRect(square.lo, {square.lo.x + square.side, square.lo.y + square.side}, theme::kLine);
    if (frame.probe && frame.probe->hit)
        for (const Probe::PerLight& p : frame.probe->lights)
            if (p.casts && p.light == light && p.face == shown_face(state.settings, result) && p.where == "inside")
                outline_texel(square, p.texel, n, theme::kAccent);
    auto text = title(state.settings, result, fitted, view);
    if (hovered) {
        actions.want_map_values = true;
        const glm::vec2 uv = square.uv(ImGui::GetIO().MousePos);
        if (uv.x >= 0 && uv.x < 1 && uv.y >= 0 && uv.y < 1) {
            const glm::ivec2 texel(int(uv.x * float(n)), int(uv.y * float(n)));
            outline_texel(square, texel, n, IM_COL32_WHITE);
            text = readout(frame, view, texel, n);
        }
    }
    list.PopClipRect();
    ImFont* font = theme::small();
    list.AddText(font, font->FontSize, {origin.x, end.y + em * 0.25f}, theme::kText, text.first.c_str());
    list.AddText(font, font->FontSize, {origin.x, end.y + em * 0.25f + line}, theme::kMuted, text.second.c_str());
    if (fitted.clipped_casters > 0) {
        const std::string lost = fmt::format("{} object(s) reach in front of the near plane", fitted.clipped_casters);
        list.AddText({origin.x + em * 0.8f, origin.y + em * 0.6f}, theme::kWarning, lost.c_str());
    }
}

}  // namespace si
