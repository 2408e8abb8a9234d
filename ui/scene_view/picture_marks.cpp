#include "ui/scene_view/picture_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/settings/overlays.h"
#include "ui/scene_view/picture_painter.h"
#include "ui/state/panels.h"
#include "ui/widgets/theme.h"

namespace si {

void draw_probe_mark(const EditorState& state, const FrameResult& result, ImVec2 origin, ImVec2 size) {
    if (!state.probe_pixel || result.colour.width <= 0) return;
    const float em = ImGui::GetFontSize();
    const ImVec2 p(origin.x + (float(state.probe_pixel->x) + 0.5f) * size.x / float(result.colour.width),
                   origin.y + (float(state.probe_pixel->y) + 0.5f) * size.y / float(result.colour.height));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const auto& [colour, thick] : {std::pair{theme::kShade, em * 0.25f}, {theme::kProbed, em * 0.1f}}) {
        list.AddCircle(p, em * 0.5f, colour, 24, thick);
        for (const ImVec2 d : {ImVec2(1, 0), ImVec2(-1, 0), ImVec2(0, 1), ImVec2(0, -1)})
            list.AddLine({p.x + d.x * em * 0.5f, p.y + d.y * em * 0.5f}, {p.x + d.x * em, p.y + d.y * em}, colour,
                         thick);
    }
}

void draw_readers(const EditorState& state, const EditorFrame& frame, ImVec2 origin, ImVec2 size) {
    if (!state.hovered_texel || !frame.texel_usage) return;
    const FloatImage* c = frame.map_coordinates;
    const int n = frame.texel_usage->resolution();
    if (!c || state.hovered_texel->x >= n || state.hovered_texel->y >= n) return;
    const ImVec2 step(size.x / float(c->width), size.y / float(c->height));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const glm::ivec2 p : frame.texel_usage->readers(*state.hovered_texel)) {
        const ImVec2 lo(origin.x + float(p.x) * step.x, origin.y + float(p.y) * step.y);
        list.AddRectFilled(lo, {lo.x + step.x, lo.y + step.y}, faded(theme::kLinked, 200));
    }
}

void veiled_text(ImVec2 at, const std::string& text) {
    const float em = ImGui::GetFontSize();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({at.x - em * 0.4f, at.y - em * 0.2f}, {at.x + size.x + em * 0.4f, at.y + size.y + em * 0.2f},
                       theme::kVeil, em * 0.2f);
    list.AddText(at, theme::kOnPicture, text.c_str());
}

void hover_readout(const EditorFrame& frame, const Pane& pane, ImVec2 origin, glm::ivec2 pixel) {
    std::string text = fmt::format("{}, {}", pixel.x, pixel.y);
    const int overlay = pane.overlay;
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

}  // namespace si
