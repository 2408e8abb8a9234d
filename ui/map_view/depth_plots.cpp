#include "ui/map_view/depth_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "shaders/shared/colours.h"
#include "ui/state/panels.h"
#include "ui/widgets/quantity_text.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

const ImU32 kNearBand = theme::colour(shared::BAND_NEAR), kMiddleBand = theme::colour(shared::BAND_MIDDLE),
            kFarBand = theme::colour(shared::BAND_FAR);
constexpr float kMarker = 0.36f;  ///< half a marker's width, ems

/// Draws a plot's frame and title. Returns the area inside, for the curve. @param below height between plot and
/// numbers, pixels
std::pair<ImVec2, ImVec2> frame_of_plot(ImVec2 size, const std::string& title, float below = 0) {
    const ImVec2 lo = ImGui::GetCursorScreenPos(), hi(lo.x + size.x, lo.y + size.y);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(lo, hi, theme::well());
    ImFont* font = theme::small();
    const float em = ImGui::GetFontSize();
    list.PushClipRect(lo, hi, true);
    small_text({lo.x + em * 0.4f, lo.y + em * 0.15f}, title, theme::muted());
    list.PopClipRect();
    const float head = font->FontSize * 1.35f, foot = font->FontSize * 1.2f + below;
    return {{lo.x + em * 0.5f, lo.y + head}, {hi.x - em * 0.5f, hi.y - foot}};
}

ImU32 band_colour(const ViewSettings& v, double share) {
    return share < v.band_low ? kNearBand : share < v.band_high ? kMiddleBand : kFarBand;
}

/// Draws a marker under the plot that the mouse drags sideways. Returns true if it has moved.
bool marker(const char* id, ImVec2 lo, ImVec2 hi, const DepthHistogram& h, double& value, ImU32 colour,
            const char* about, EditorState& state) {
    const float em = ImGui::GetFontSize(), width = hi.x - lo.x;
    const double span = h.hi - h.lo;
    const float x = lo.x + float(std::clamp((value - h.lo) / span, 0.0, 1.0)) * width;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine({x, lo.y}, {x, hi.y}, colour, em * 0.08f);
    const float half = em * kMarker;
    list.AddTriangleFilled({x, hi.y}, {x + half, hi.y + half * 1.5f}, {x - half, hi.y + half * 1.5f}, colour);
    list.AddTriangle({x, hi.y}, {x + half, hi.y + half * 1.5f}, {x - half, hi.y + half * 1.5f}, theme::muted());
    const ImVec2 back = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({x - em * 0.5f, lo.y});
    ImGui::InvisibleButton(id, {em, hi.y - lo.y + half * 1.5f});
    ImGui::SetCursorScreenPos(back);
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive())
        ImGui::SetTooltip("%s: %s\nDrag to move", about, stored_text(value, 4).c_str());
    if (!ImGui::IsItemActive()) return false;
    state.viewport.dragging = true;
    if (ImGui::GetIO().MouseDelta.x == 0) return false;
    value = std::clamp(h.lo + span * double((ImGui::GetIO().MousePos.x - lo.x) / width), h.lo, h.hi);
    return true;
}

void drag_ends(EditorState& state, const FrameResult& result, const DepthHistogram& h, ImVec2 lo, ImVec2 hi) {
    ViewSettings& v = state.settings.view;
    if (v.map == MapView::Bands) {
        if (marker("low", lo, hi, h, v.band_low, kMiddleBand, "Lower band", state))
            v.band_high = std::max(v.band_high, v.band_low);
        if (marker("high", lo, hi, h, v.band_high, kFarBand, "Upper band", state))
            v.band_low = std::min(v.band_low, v.band_high);
        return;
    }
    double black = result.map_black, white = result.map_white;
    const bool moved_black = marker("black", lo, hi, h, black, IM_COL32(20, 20, 20, 255), "Black at", state);
    const bool moved_white = marker("white", lo, hi, h, white, IM_COL32(240, 240, 240, 255), "White at", state);
    if (!moved_black && !moved_white) return;
    constexpr double kMinGap = 1e-6;  // apart
    v.map_fit = false;
    v.map_black = moved_black ? std::min(black, white - kMinGap) : black;
    v.map_white = moved_white ? std::max(white, black + kMinGap) : white;
}

}  // namespace

double distance_at_share(const DepthCurve& curve, double share) {
    return curve.distance(curve.convention.reversed ? 1 - share : share);
}

void draw_histogram(EditorState& state, const EditorFrame& frame, ImVec2 size) {
    const ViewSettings& v = state.settings.view;
    const bool bands = v.map == MapView::Bands;
    const char* unit = v.map == MapView::Linear ? "linear depth" : bands ? "depth from near" : "stored depth";
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float markers = ImGui::GetFontSize() * kMarker * 1.5f;
    const auto [lo, hi] = frame_of_plot(size, fmt::format("Histogram of {}", unit), markers);
    if (frame.result && frame.result->shown_map.channel > 0)
        small_text({0.5f * (lo.x + hi.x), 0.5f * (lo.y + hi.y)}, "of depths only: set the channel to depth",
                   theme::muted(), 0.5f);
    if (frame.result && frame.map_facts && hi.x > lo.x + 8 && hi.y > lo.y + 8) {
        const DepthHistogram& h = frame.map_facts->histogram;
        std::uint64_t most = 1;
        for (const std::uint64_t n : h.counts) most = std::max(most, n);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const float step = (hi.x - lo.x) / float(h.counts.size());
        const double full = std::log1p(double(most));
        for (std::size_t i = 0; i < h.counts.size(); ++i) {
            if (h.counts[i] == 0) continue;
            const float tall = float(std::log1p(double(h.counts[i])) / full) * (hi.y - lo.y);
            const double middle = h.lo + (h.hi - h.lo) * (double(i) + 0.5) / double(h.counts.size());
            const float x = lo.x + float(i) * step;
            list.AddRectFilled({x, hi.y - tall}, {x + std::max(step, 1.0f), hi.y},
                               bands ? band_colour(v, middle) : theme::colours().bar);
        }
        list.AddLine({lo.x, hi.y}, {hi.x, hi.y}, theme::line());
        if (frame.map_facts->statistics.drawn == 0)
            small_text({0.5f * (lo.x + hi.x), 0.5f * (lo.y + hi.y)}, "nothing drawn", theme::muted(), 0.5f);
        drag_ends(state, *frame.result, h, lo, hi);
        small_text({lo.x, hi.y + markers}, digits_text(h.lo), theme::muted(), 0);
        small_text({hi.x, hi.y + markers}, digits_text(h.hi), theme::muted(), 1);
    }
    ImGui::SetCursorScreenPos(corner);
    ImGui::Dummy(size);
}

void draw_depth_curve(const EditorState& state, const FrameResult& result, std::optional<double> marked_m,
                      ImVec2 size) {
    // Rows of a warped map differ in their range only; the plot shows the curve of the middle row.
    const DepthCurve curve = result.map_view_curve.curve_at_row(0.5);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    // Under perspective, half of the depth values cover a small part of the distance; the plot marks that place.
    const double half_m = distance_at_share(curve, 0.5);
    const double half_share = (half_m - curve.near) / (curve.far - curve.near);
    const auto [lo, hi] = frame_of_plot(size, fmt::format("Depth 0.5 at {} of range", percent_text(half_share)));
    if (hi.x > lo.x + 8 && hi.y > lo.y + 8) {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const auto at = [lo = lo, hi = hi, &curve](double metres) {
            const double share = (metres - curve.near) / (curve.far - curve.near);
            return ImVec2(lo.x + float(share) * (hi.x - lo.x), hi.y - float(curve.depth(metres)) * (hi.y - lo.y));
        };
        list.AddLine({lo.x, hi.y}, {hi.x, hi.y}, theme::line());
        list.AddLine(lo, {lo.x, hi.y}, theme::line());
        const ViewSettings& v = state.settings.view;
        for (const auto& [share, colour] : {std::pair{v.band_low, kMiddleBand}, {v.band_high, kFarBand}}) {
            const ImVec2 p = at(distance_at_share(curve, share));
            list.AddLine({lo.x, p.y}, p, (colour & 0x00ffffff) | 0x90000000);
            list.AddLine(p, {p.x, hi.y}, (colour & 0x00ffffff) | 0x90000000);
        }
        // Samples are denser towards the near plane, where a perspective curve bends.
        constexpr int kSteps = 96;
        ImVec2 last = at(curve.near);
        for (int i = 1; i <= kSteps; ++i) {
            const double t = double(i) / kSteps;
            const ImVec2 p = at(curve.near + (curve.far - curve.near) * t * t);
            list.AddLine(last, p, theme::text(), ImGui::GetFontSize() * 0.1f);
            last = p;
        }
        if (marked_m && *marked_m >= curve.near && *marked_m <= curve.far) {
            const ImVec2 p = at(*marked_m);
            list.AddCircleFilled(p, ImGui::GetFontSize() * 0.22f, theme::accent(), 16);
            list.AddCircle(p, ImGui::GetFontSize() * 0.22f, IM_COL32(0, 0, 0, 180), 16);
        }
        small_text({lo.x, hi.y + 1}, metres_text(curve.near), theme::muted(), 0);
        small_text({hi.x, hi.y + 1}, metres_text(curve.far), theme::muted(), 1);
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        if (ImGui::IsMouseHoveringRect(lo, hi)) {
            const double metres = curve.near + (curve.far - curve.near) * double((mouse.x - lo.x) / (hi.x - lo.x));
            const double step_m = std::exp2(-24) / std::max(curve.slope(metres), 1e-300);
            ImGui::SetTooltip("%s: depth %.6f\n24 bits resolve %s here", metres_text(metres).c_str(),
                              curve.depth(metres), metres_text(step_m).c_str());
        }
    }
    ImGui::SetCursorScreenPos(corner);
    ImGui::Dummy(size);
}

}  // namespace si
