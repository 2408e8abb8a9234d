#include "ui/panels/frontier_plot.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "renderer/measure/frontier_drawing.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

/// Height of the plot, in ems, from which the table of best cases stands below it.
constexpr float kTableFrom = 26;

ImVec2 at(ImVec2 corner, const glm::dvec2& p) {
    return {corner.x + float(p.x), corner.y + float(p.y)};
}

ImU32 colour_of(PlotInk ink, double opacity = 1) {
    if (ink == PlotInk::Paper) return theme::well();
    if (ink == PlotInk::Text) return theme::text();
    if (ink == PlotInk::Muted) return theme::muted();
    if (ink == PlotInk::Grid) return theme::line();
    if (ink == PlotInk::Spot) return theme::accent();
    const bool dark = (theme::well() & 0xff) < 128;
    const auto& c = dark ? plot_colour(ink).on_dark : plot_colour(ink).on_light;
    return IM_COL32(c[0], c[1], c[2], int(255 * opacity));
}

/// Paints a dashed line as pieces.
void paint_dashes(ImDrawList& list, const std::vector<ImVec2>& points, ImU32 colour, float width) {
    constexpr float kDash = 5, kGap = 4;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const ImVec2 a = points[i - 1], b = points[i];
        const float length = std::hypot(b.x - a.x, b.y - a.y);
        for (float from = 0; from < length; from += kDash + kGap) {
            const float to = std::min(from + kDash, length);
            list.AddLine({a.x + (b.x - a.x) * from / length, a.y + (b.y - a.y) * from / length},
                         {a.x + (b.x - a.x) * to / length, a.y + (b.y - a.y) * to / length}, colour, width);
        }
    }
}

void paint_mark(ImDrawList& list, const PlotMark& m, ImVec2 corner) {
    const ImU32 colour = colour_of(m.ink, m.opacity);
    std::vector<ImVec2> points;
    for (const glm::dvec2& p : m.points) points.push_back(at(corner, p));
    switch (m.kind) {
        case PlotMark::Kind::Line:
            if (m.closed && m.dashed) points.push_back(points.front());
            if (m.dashed)
                paint_dashes(list, points, colour, float(m.width));
            else
                list.AddPolyline(points.data(), int(points.size()), colour, m.closed ? ImDrawFlags_Closed : 0,
                                 float(m.width));
            break;
        case PlotMark::Kind::Area: {
            // A star is no convex polygon: it is a fan around its middle.
            ImVec2 middle(0, 0);
            for (const ImVec2& p : points)
                middle = {middle.x + p.x / float(points.size()), middle.y + p.y / float(points.size())};
            bool convex = true;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const ImVec2 a = points[i], b = points[(i + 1) % points.size()], c = points[(i + 2) % points.size()];
                convex = convex && (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x) >= 0;
            }
            if (convex)
                list.AddConvexPolyFilled(points.data(), int(points.size()), colour);
            else
                for (std::size_t i = 0; i < points.size(); ++i)
                    list.AddTriangleFilled(middle, points[i], points[(i + 1) % points.size()], colour);
            break;
        }
        case PlotMark::Kind::Text: {
            const ImFont* font = theme::small();
            const float w = text_width(m.text, font), share = float(m.anchor) * 0.5f;
            const ImVec2 lo(points[0].x - share * w, points[0].y - font->FontSize * 0.8f);
            if (m.halo) list.AddRectFilled(lo, {lo.x + w, lo.y + font->FontSize}, theme::well());
            small_text(lo, m.text, colour);
            break;
        }
    }
}

}  // namespace

FrontierPlotResult draw_frontier_plot(const SweepFacts& facts, std::optional<int> chosen, ImVec2 size) {
    FrontierPlotResult out;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("plot", size);
    const bool hovered = ImGui::IsItemHovered(), clicked = ImGui::IsItemClicked();
    const float line = theme::small()->FontSize;
    const FrontierPlot& plot = facts.view.plot;
    PlotPage page{.width = size.x, .em = line / kSmallText, .sentence = false, .titles = false};
    page.text_width = [](std::string_view text, double, bool) { return double(text_width(text, theme::small())); };
    page.table = plot.base_cost && size.y > kTableFrom * line;
    page.height = size.y - line * (page.table ? 12.5f : 1.9f);
    if (size.x < line * 6 || page.height < line * 2) return out;
    const FrontierDrawing drawing = frontier_drawing(plot, page);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(corner, {corner.x + size.x, corner.y + size.y}, true);
    list.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, theme::well());
    for (const PlotMark& m : drawing.marks) paint_mark(list, m, corner);
    for (const PlotPlace& place : drawing.cases)
        if (chosen == facts.cases[place.of].number)
            list.AddCircle(at(corner, place.at), line * 0.6f, theme::text(), 20, line * 0.1f);
    const auto find = [&](const std::vector<PlotPlace>& places, float& least) {
        const PlotPlace* found = nullptr;
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        for (const PlotPlace& place : places) {
            const ImVec2 p = at(corner, place.at);
            const float d = (p.x - mouse.x) * (p.x - mouse.x) + (p.y - mouse.y) * (p.y - mouse.y);
            if (d >= least) continue;
            least = d;
            found = &place;
        }
        return found;
    };
    float least = line * line * 1.6f;
    const PlotPlace* found = hovered ? find(drawing.cases, least) : nullptr;
    if (hovered)
        if (const PlotPlace* spot = find(drawing.spots, least)) {
            out.hovered_spot = plot.spots[spot->of].kind;
            found = nullptr;
        }
    if (found) {
        out.hovered = found->of;
        list.AddLine({corner.x + float(found->left), corner.y + float(found->at.y)},
                     {corner.x + float(found->right), corner.y + float(found->at.y)}, theme::text(), 1);
        ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
        if (clicked) out.clicked = out.hovered;
    }
    list.PopClipRect();
    return out;
}

}  // namespace si
