// The overlay's colour scale: the same stops as shaders/lib/colour_scale.glsl.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>

#include "renderer/techniques.h"
#include "ui/panels.h"
#include "ui/theme.h"

namespace si {
namespace {

ImU32 colour(float r, float g, float b) {
    return ImGui::ColorConvertFloat4ToU32({r, g, b, 1});
}

struct Stops {
    ImU32 low, middle, high;
};

Stops stops_of(const Overlay& overlay) {
    if (overlay.diverging) return {colour(0.02f, 0.28f, 0.60f), colour(0.96f, 0.96f, 0.96f), colour(0.80f, 0.33f, 0)};
    return {colour(0, 0.13f, 0.30f), colour(0.48f, 0.48f, 0.47f), colour(0.99f, 0.91f, 0.27f)};
}

}  // namespace

void draw_legend(const Pane& pane, float left, float bottom, float room) {
    const int index = pane.overlay - 1;
    if (index < 0 || std::size_t(index) >= overlays().size()) return;
    const Overlay& overlay = overlays()[std::size_t(index)];
    const float em = ImGui::GetFontSize();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const std::string title =
        overlay.unit.empty() ? std::string(overlay.label) : fmt::format("{} ({})", overlay.label, overlay.unit);
    const float width = std::clamp(room - em * 2.4f, em * 5, em * 15), pad = em * 0.6f, bar = em * 0.7f;
    const float text_width = ImGui::CalcTextSize(title.c_str()).x;
    const float box_width = overlay.scalar ? std::max(width, text_width) : text_width;
    const float box_height = overlay.scalar ? em * 3.4f : em * 1.2f;
    const ImVec2 lo(left + em * 0.6f, bottom - em * 0.6f - box_height - pad),
        hi(lo.x + box_width + 2 * pad, bottom - em * 0.6f);
    list.AddRectFilled(lo, hi, theme::kVeil, em * 0.25f);
    list.AddText({lo.x + pad, lo.y + pad * 0.6f}, theme::kText, title.c_str());
    if (!overlay.scalar) return;
    const Stops stops = stops_of(overlay);
    const float x0 = lo.x + pad, x2 = x0 + width, x1 = 0.5f * (x0 + x2), y0 = lo.y + pad * 0.6f + em * 1.35f,
                y1 = y0 + bar;
    list.AddRectFilledMultiColor({x0, y0}, {x1, y1}, stops.low, stops.middle, stops.middle, stops.low);
    list.AddRectFilledMultiColor({x1, y0}, {x2, y1}, stops.middle, stops.high, stops.high, stops.middle);
    const float low = pane.overlay_min, high = pane.overlay_max;
    const int steps = width < em * 11 ? 2 : 4;
    for (int i = 0; i <= steps; ++i) {
        const float t = float(i) / float(steps), x = x0 + t * (x2 - x0);
        list.AddLine({x, y1}, {x, y1 + em * 0.2f}, theme::kText);
        const std::string number = fmt::format("{:.3g}", low + t * (high - low));
        const float w = ImGui::CalcTextSize(number.c_str()).x;
        const float at = i == 0 ? x : i == steps ? x - w : x - 0.5f * w;
        list.AddText({at, y1 + em * 0.2f}, theme::kText, number.c_str());
    }
}

}  // namespace si
