#include "app/report/section_svg.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "app/report/xml_text.h"

namespace si {
namespace {

/// Formats a coordinate in hundredths of a pixel, so that rounding of sums does not show.
std::string number(double v) {
    std::string text = fmt::format("{:.2f}", v);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string hex(const std::array<std::uint8_t, 3>& c) {
    return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

std::string points(const std::vector<glm::dvec2>& at) {
    std::string out;
    for (const glm::dvec2& p : at) out += fmt::format("{}{},{}", out.empty() ? "" : " ", number(p.x), number(p.y));
    return out;
}

/// Formats an open arrow head at the last point.
std::string arrow_head(const Mark& m) {
    const glm::dvec2 tip = m.points.back(), from = m.points[m.points.size() - 2];
    const double length = glm::length(tip - from), size = std::min(4.5 * m.width, length);
    if (!(length > 0)) return {};
    const glm::dvec2 along = (tip - from) / length * size, aside(-0.45 * along.y, 0.45 * along.x);
    return points({tip, tip - along + aside, tip - along - aside});
}

std::string mark(const Mark& m) {
    const std::string_view key = ink_colour(m.ink).key;
    const std::string opacity = m.opacity < 1 ? fmt::format(" opacity=\"{}\"", number(m.opacity)) : "";
    switch (m.kind) {
        case Mark::Kind::Line: {
            std::string out =
                fmt::format("<polyline class=\"line {}\" stroke-width=\"{}\"{} points=\"{}\"/>\n", key, number(m.width),
                            m.dashed ? " stroke-dasharray=\"6 4\"" : "", points(m.points));
            if (const std::string head = m.arrow ? arrow_head(m) : ""; !head.empty())
                out += fmt::format("<polygon class=\"{}\" points=\"{}\"/>\n", key, head);
            return out;
        }
        case Mark::Kind::Area:
            return fmt::format("<polygon class=\"{}\"{} points=\"{}\"/>\n", key, opacity, points(m.points));
        case Mark::Kind::Dot:
            return fmt::format("<circle class=\"{}\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", key, number(m.points[0].x),
                               number(m.points[0].y), number(m.width));
        case Mark::Kind::Text: {
            constexpr std::string_view kAnchors[] = {"start", "middle", "end"};
            return fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\"{}{}>{}</text>\n", key, number(m.points[0].x),
                               number(m.points[0].y),
                               m.anchor == Mark::Anchor::Start
                                   ? ""
                                   : fmt::format(" text-anchor=\"{}\"", kAnchors[std::size_t(m.anchor)]),
                               m.strong ? " font-weight=\"bold\"" : "", xml_text(m.text));
        }
    }
    return {};
}

std::string colours(bool dark) {
    std::string out;
    for (std::size_t i = 0; i < kInks; ++i) {
        const InkColour& c = ink_colour(Ink(i));
        const std::string value = hex(dark ? c.on_dark : c.on_light);
        out += fmt::format(".{}{{fill:{}}}.line.{}{{fill:none;stroke:{}}}", c.key, value, c.key, value);
    }
    return out;
}

}  // namespace

std::string section_svg(const SectionDrawing& d, const std::string& title) {
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
        "{1}\" "
        "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"15\">\n<title>{2}</title>\n"
        "<style>{3}\n@media (prefers-color-scheme:dark){{{4}}}</style>\n",
        number(std::ceil(d.width)), number(std::ceil(d.height)), xml_text(title), colours(false), colours(true));
    for (const Mark& m : d.marks) out += mark(m);
    return out + "</svg>\n";
}

std::string section_svg(const Section& section) {
    return section_svg(draw_section(section, {}), fmt::format("Shadow test of a pixel: {}", section.verdict));
}

}  // namespace si
