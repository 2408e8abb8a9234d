#include "ui/panels/section_view.h"

#include <algorithm>
#include <cmath>

#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

class SectionPainter {
public:
    SectionPainter(ImDrawList& list, ImVec2 at) : list_(list), at_(at) {
        const ImVec4 ground = ImGui::GetStyleColorVec4(ImGuiCol_ChildBg);
        on_dark_ = 0.2126f * ground.x + 0.7152f * ground.y + 0.0722f * ground.z < 0.5f;
    }

    void paint(const Mark& m) const {
        const ImU32 colour = of(m.ink, m.opacity);
        switch (m.kind) {
            case Mark::Kind::Line:
                return line(m, colour);
            case Mark::Kind::Area: {
                std::vector<ImVec2> points;
                for (const glm::dvec2& p : m.points) points.push_back(screen(p));
                return list_.AddConvexPolyFilled(points.data(), int(points.size()), colour);
            }
            case Mark::Kind::Dot:
                return list_.AddCircleFilled(screen(m.points[0]), float(m.width), colour, 16);
            case Mark::Kind::Text: {
                ImFont* const font = m.strong ? theme::strong() : theme::small();
                ImVec2 at = screen(m.points[0]);
                const float width = text_width(m.text, font);
                at.x -= m.anchor == Mark::Anchor::End ? width : m.anchor == Mark::Anchor::Middle ? 0.5f * width : 0;
                at.y -= font->Ascent;
                return list_.AddText(font, font->FontSize, {std::round(at.x), std::round(at.y)}, colour,
                                     m.text.c_str());
            }
        }
    }

private:
    ImDrawList& list_;
    ImVec2 at_;
    bool on_dark_ = true;

    ImVec2 screen(const glm::dvec2& p) const { return {at_.x + float(p.x), at_.y + float(p.y)}; }
    ImU32 of(Ink ink, double opacity) const {
        const InkColour& c = ink_colour(ink);
        const auto& rgb = on_dark_ ? c.on_dark : c.on_light;
        return IM_COL32(rgb[0], rgb[1], rgb[2], int(std::lround(255 * opacity)));
    }

    void line(const Mark& m, ImU32 colour) const {
        const float width = float(m.width);
        if (!m.dashed) {
            std::vector<ImVec2> points;
            for (const glm::dvec2& p : m.points) points.push_back(screen(p));
            list_.AddPolyline(points.data(), int(points.size()), colour, ImDrawFlags_None, width);
        } else {
            for (std::size_t i = 0; i + 1 < m.points.size(); ++i) dashes(m.points[i], m.points[i + 1], colour, width);
        }
        if (m.arrow && m.points.size() > 1) head(m, colour);
    }
    void dashes(const glm::dvec2& a, const glm::dvec2& b, ImU32 colour, float width) const {
        const double length = glm::length(b - a), dash = 6, gap = 4;
        const glm::dvec2 along = length > 0 ? (b - a) / length : glm::dvec2(0);
        for (double from = 0; from < length; from += dash + gap)
            list_.AddLine(screen(a + along * from), screen(a + along * std::min(from + dash, length)), colour, width);
    }
    void head(const Mark& m, ImU32 colour) const {
        const glm::dvec2 tip = m.points.back(), from = m.points[m.points.size() - 2];
        const double length = glm::length(tip - from), size = std::min(4.5 * m.width, length);
        if (!(length > 0)) return;
        const glm::dvec2 along = (tip - from) / length * size, aside(-0.45 * along.y, 0.45 * along.x);
        list_.AddTriangleFilled(screen(tip), screen(tip - along + aside), screen(tip - along - aside), colour);
    }
};

const SectionDrawing& drawing_of(SectionViews& views, const Sections& sections, std::size_t light, ImVec2 size) {
    ImFont* const font = theme::small();
    if (views.of != sections) {
        views.of = sections;
        views.views.clear();
    }
    const double width = size.x, height = size.y, em = font->FontSize;
    std::erase_if(views.views, [&](const SectionViews::View& v) {
        return v.light == light && (v.width != width || v.height != height || v.em != em);
    });
    for (const SectionViews::View& v : views.views)
        if (v.light == light) return v.drawing;
    ++views.drawn;
    const auto width_of = [font](std::string_view text) { return double(text_width(text, font)); };
    views.views.push_back(
        {light, width, height, em,
         draw_section((*sections)[light],
                      {.width = width, .height = height, .em = em, .captions = false, .text_width = width_of})});
    return views.views.back().drawing;
}

/// Position and number of columns of the legend's window.
struct LegendPlace {
    ImVec2 at;
    std::size_t columns = 1;
    float column_width = 0;
};

constexpr float kBetweenColumns = 1.5f;  ///< ems

/// Places the legend next to the last item, so that a screenshot of the item stays free, and not above its top, where
/// tabs and texts are. A legend too high for the screen gets more columns.
LegendPlace place_of(const std::vector<LegendRow>& legend) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float em = ImGui::GetFontSize(), gap = em * kTooltipGap;
    const ImVec2 screen = ImGui::GetIO().DisplaySize, lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
    const float top = std::max(lo.y, ImGui::GetWindowPos().y), bottom = std::min(hi.y, screen.y);
    LegendPlace place;
    for (const LegendRow& row : legend)
        place.column_width = std::max(place.column_width, text_width(row.text, theme::strong()));
    place.column_width += (float(kSwatchEms) + 0.6f) * em;
    const auto height = [&] {
        const std::size_t rows = (legend.size() + place.columns - 1) / place.columns;
        return float(rows) * ImGui::GetTextLineHeightWithSpacing() + 2 * style.WindowPadding.y;
    };
    while (place.columns < 3 && height() > screen.y - top) ++place.columns;
    const float width = float(place.columns) * (place.column_width + kBetweenColumns * em) - kBetweenColumns * em +
                        2 * style.WindowPadding.x;
    place.at.x = hi.x + gap + width <= screen.x ? hi.x + gap
                 : lo.x - gap - width >= 0      ? lo.x - gap - width
                                                : std::max(screen.x - width, 0.0f);
    place.at.y = std::max(std::min(std::max(top, bottom - height()), screen.y - height()), 0.0f);
    return place;
}

/// Draws the meaning of the marks of the last item's drawing. The mark under the mouse is strong.
void legend_tooltip(const SectionDrawing& drawing) {
    if (drawing.legend.empty() || !ImGui::IsItemHovered()) return;
    const ImVec2 mouse = ImGui::GetMousePos(), at = ImGui::GetItemRectMin();
    const LegendRow* const meant =
        legend_row_at(drawing, {mouse.x - at.x, mouse.y - at.y}, 0.5 * theme::small()->FontSize);
    const float em = ImGui::GetFontSize();
    const LegendPlace place = place_of(drawing.legend);
    const std::size_t rows = (drawing.legend.size() + place.columns - 1) / place.columns;
    ImGui::SetNextWindowPos(place.at);
    ImGui::BeginTooltip();
    const float left = ImGui::GetCursorPosX();
    for (std::size_t column = 0; column * rows < drawing.legend.size(); ++column) {
        if (column > 0) ImGui::SameLine(left + float(column) * (place.column_width + kBetweenColumns * em));
        ImGui::BeginGroup();
        for (std::size_t i = column * rows; i < std::min((column + 1) * rows, drawing.legend.size()); ++i) {
            const LegendRow& row = drawing.legend[i];
            SectionPainter(*ImGui::GetWindowDrawList(), ImGui::GetCursorScreenPos())
                .paint(legend_swatch(row, {0, 0.5 * em}, em));
            ImGui::Dummy({float(kSwatchEms) * em, em});
            ImGui::SameLine(0, 0.6f * em);
            ImGui::PushFont(&row == meant ? theme::strong() : ImGui::GetFont());
            ImGui::TextUnformatted(row.text.data(), row.text.data() + row.text.size());
            ImGui::PopFont();
        }
        ImGui::EndGroup();
    }
    ImGui::EndTooltip();
}

}  // namespace

void draw_section_view(SectionViews& views, const Sections& sections, std::size_t light, ImVec2 size) {
    if (!sections || light >= sections->size() || !(*sections)[light].shadowed) return;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy(size);
    if (!ImGui::IsItemVisible()) return;
    const SectionPainter painter(*ImGui::GetWindowDrawList(), at);
    const SectionDrawing& drawing = drawing_of(views, sections, light, size);
    ImGui::GetWindowDrawList()->PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
    for (const Mark& mark : drawing.marks) painter.paint(mark);
    ImGui::GetWindowDrawList()->PopClipRect();
    legend_tooltip(drawing);
}

SectionSheet section_sheet(const Section& section) {
    ImFont* const font = theme::small();
    const SectionPage as_svg;
    const double em = font->FontSize, scale = em / as_svg.em;
    // The bold font is the widest: lines are broken for it, so that none is longer than the page.
    const auto width_of = [](std::string_view text) {
        return std::max(double(text_width(text, theme::small())), double(text_width(text, theme::strong())));
    };
    const SectionDrawing drawing = draw_section(
        section, {.width = scale * as_svg.width, .height = scale * as_svg.height, .em = em, .text_width = width_of});
    SectionSheet sheet;
    sheet.width = int(std::ceil(drawing.width));
    sheet.height = int(std::ceil(drawing.height));
    sheet.list = std::make_unique<ImDrawList>(ImGui::GetDrawListSharedData());
    sheet.list->_ResetForNewFrame();
    sheet.list->PushTextureID(ImGui::GetIO().Fonts->TexID);
    sheet.list->PushClipRect({0, 0}, {float(sheet.width), float(sheet.height)});
    sheet.list->AddRectFilled({0, 0}, {float(sheet.width), float(sheet.height)}, theme::panel());
    const SectionPainter painter(*sheet.list, {0, 0});
    for (const Mark& mark : drawing.marks) painter.paint(mark);
    return sheet;
}

}  // namespace si
