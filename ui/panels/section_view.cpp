#include "ui/panels/section_view.h"

#include <algorithm>
#include <cmath>

#include "ui/widgets/theme.h"
#include "ui/widgets/tooltip.h"

namespace si {
namespace {

class SectionPainter {
public:
    explicit SectionPainter(ImVec2 at) : at_(at) {
        const ImVec4 ground = ImGui::GetStyleColorVec4(ImGuiCol_ChildBg);
        on_dark_ = 0.2126f * ground.x + 0.7152f * ground.y + 0.0722f * ground.z < 0.5f;
    }

    void paint(const Mark& m) const {
        const ImU32 colour = of(m.ink, m.opacity);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        switch (m.kind) {
            case Mark::Kind::Line:
                return line(m, colour);
            case Mark::Kind::Area: {
                std::vector<ImVec2> points;
                for (const glm::dvec2& p : m.points) points.push_back(screen(p));
                return list.AddConvexPolyFilled(points.data(), int(points.size()), colour);
            }
            case Mark::Kind::Dot:
                return list.AddCircleFilled(screen(m.points[0]), float(m.width), colour, 16);
            case Mark::Kind::Text: {
                ImFont* const font = theme::small();
                ImVec2 at = screen(m.points[0]);
                const float width = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, m.text.c_str()).x;
                at.x -= m.anchor == Mark::Anchor::End ? width : m.anchor == Mark::Anchor::Middle ? 0.5f * width : 0;
                at.y -= font->Ascent;
                return list.AddText(font, font->FontSize, {std::round(at.x), std::round(at.y)}, colour, m.text.c_str());
            }
        }
    }

private:
    ImVec2 at_;
    bool on_dark_ = true;

    ImVec2 screen(const glm::dvec2& p) const { return {at_.x + float(p.x), at_.y + float(p.y)}; }
    ImU32 of(Ink ink, double opacity) const {
        const InkColour& c = ink_colour(ink);
        const auto& rgb = on_dark_ ? c.on_dark : c.on_light;
        return IM_COL32(rgb[0], rgb[1], rgb[2], int(std::lround(255 * opacity)));
    }

    void line(const Mark& m, ImU32 colour) const {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const float width = float(m.width);
        if (!m.dashed) {
            std::vector<ImVec2> points;
            for (const glm::dvec2& p : m.points) points.push_back(screen(p));
            list.AddPolyline(points.data(), int(points.size()), colour, ImDrawFlags_None, width);
        } else {
            for (std::size_t i = 0; i + 1 < m.points.size(); ++i) dashes(m.points[i], m.points[i + 1], colour, width);
        }
        if (m.arrow && m.points.size() > 1) head(m, colour);
    }
    void dashes(const glm::dvec2& a, const glm::dvec2& b, ImU32 colour, float width) const {
        const double length = glm::length(b - a), dash = 6, gap = 4;
        const glm::dvec2 along = length > 0 ? (b - a) / length : glm::dvec2(0);
        for (double from = 0; from < length; from += dash + gap)
            ImGui::GetWindowDrawList()->AddLine(screen(a + along * from),
                                                screen(a + along * std::min(from + dash, length)), colour, width);
    }
    void head(const Mark& m, ImU32 colour) const {
        const glm::dvec2 tip = m.points.back(), from = m.points[m.points.size() - 2];
        const double length = glm::length(tip - from), size = std::min(4.5 * m.width, length);
        if (!(length > 0)) return;
        const glm::dvec2 along = (tip - from) / length * size, aside(-0.45 * along.y, 0.45 * along.x);
        ImGui::GetWindowDrawList()->AddTriangleFilled(screen(tip), screen(tip - along + aside),
                                                      screen(tip - along - aside), colour);
    }
};

const SectionDrawing& drawing_of(SectionViews& views, const Sections& sections, std::size_t light, ImVec2 size) {
    ImFont* const font = theme::small();
    if (views.of != sections) views.of = sections, views.views.clear();
    const double width = size.x, height = size.y, em = font->FontSize;
    std::erase_if(views.views, [&](const SectionViews::View& v) {
        return v.light == light && (v.width != width || v.height != height || v.em != em);
    });
    for (const SectionViews::View& v : views.views)
        if (v.light == light) return v.drawing;
    ++views.drawn;
    const auto text_width = [&](std::string_view text) {
        return double(font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, text.data(), text.data() + text.size()).x);
    };
    views.views.push_back(
        {light, width, height, em,
         draw_section((*sections)[light],
                      {.width = width, .height = height, .em = em, .captions = false, .text_width = text_width})});
    return views.views.back().drawing;
}

/// Outside of the last item, which may be saved as it is seen. @param height of the tooltip, in pixels
void place_legend(float height) {
    const float gap = ImGui::GetFontSize() * kTooltipGap, wide = ImGui::GetFontSize() * kTooltipWidth;
    const ImVec2 screen = ImGui::GetIO().DisplaySize, lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
    // place_tooltip() takes the larger of these two.
    if (height + gap <= std::max(lo.y, screen.y - hi.y))
        place_tooltip();
    else if (hi.x + gap + wide <= screen.x)
        ImGui::SetNextWindowPos({hi.x + gap, std::clamp(lo.y, 0.0f, std::max(screen.y - height, 0.0f))});
}

/// What the marks of the drawing mean that is the last item; strong: what is under the mouse.
void legend_tooltip(const SectionDrawing& drawing) {
    if (drawing.legend.empty() || !ImGui::IsItemHovered()) return;
    const ImVec2 mouse = ImGui::GetMousePos(), at = ImGui::GetItemRectMin();
    const LegendRow* const meant =
        legend_row_at(drawing, {mouse.x - at.x, mouse.y - at.y}, 0.5 * theme::small()->FontSize);
    const float em = ImGui::GetFontSize();
    place_legend(float(drawing.legend.size()) * ImGui::GetTextLineHeightWithSpacing() +
                 2 * ImGui::GetStyle().WindowPadding.y);
    ImGui::BeginTooltip();
    for (const LegendRow& row : drawing.legend) {
        SectionPainter(ImGui::GetCursorScreenPos()).paint(legend_swatch(row, {0, 0.5 * em}, em));
        ImGui::Dummy({float(kSwatchEms) * em, em});
        ImGui::SameLine(0, 0.6f * em);
        ImGui::PushFont(&row == meant ? theme::strong() : ImGui::GetFont());
        ImGui::TextUnformatted(row.text.data(), row.text.data() + row.text.size());
        ImGui::PopFont();
    }
    ImGui::EndTooltip();
}

}  // namespace

void draw_section_view(SectionViews& views, const Sections& sections, std::size_t light, ImVec2 size) {
    if (!sections || light >= sections->size() || !(*sections)[light].shadowed) return;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy(size);
    if (!ImGui::IsItemVisible()) return;
    const SectionPainter painter(at);
    const SectionDrawing& drawing = drawing_of(views, sections, light, size);
    ImGui::GetWindowDrawList()->PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
    for (const Mark& mark : drawing.marks) painter.paint(mark);
    ImGui::GetWindowDrawList()->PopClipRect();
    legend_tooltip(drawing);
}

}  // namespace si
