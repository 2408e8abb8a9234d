#include "app/report/frontier_svg.h"

#include <fmt/format.h>

#include <cmath>

#include "app/report/xml_text.h"
#include "renderer/base/lengths_text.h"

namespace si {
namespace {

/// Formats a coordinate in hundredths of a pixel.
std::string decimal(double v) {
    std::string text = fmt::format("{:.2f}", v);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string point_list(const std::vector<glm::dvec2>& at) {
    std::string out;
    for (const glm::dvec2& p : at) out += fmt::format("{}{},{}", out.empty() ? "" : " ", decimal(p.x), decimal(p.y));
    return out;
}

std::string ink_class(PlotInk ink) {
    return fmt::format("i{}", int(ink));
}

std::string svg_mark(const PlotMark& m) {
    const std::string ink = ink_class(m.ink),
                      opacity = m.opacity < 1 ? fmt::format(" opacity=\"{}\"", decimal(m.opacity)) : "";
    switch (m.kind) {
        case PlotMark::Kind::Line:
            return fmt::format("<{} class=\"l {}\" stroke-width=\"{}\"{}{} points=\"{}\"/>\n",
                               m.closed ? "polygon" : "polyline", ink, decimal(m.width),
                               m.dashed ? " stroke-dasharray=\"5 4\"" : "", opacity, point_list(m.points));
        case PlotMark::Kind::Area:
            return fmt::format("<polygon class=\"{}\"{} points=\"{}\"/>\n", ink, opacity, point_list(m.points));
        case PlotMark::Kind::Text: {
            constexpr const char* kAnchors[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
            return fmt::format("<text class=\"{}{}\" x=\"{}\" y=\"{}\" font-size=\"{}\"{}{}>{}</text>\n",
                               m.halo ? "h " : "", ink, decimal(m.points[0].x), decimal(m.points[0].y), decimal(m.size),
                               kAnchors[std::size_t(m.anchor)], m.strong ? " font-weight=\"bold\"" : "",
                               xml_text(m.text));
        }
    }
    return {};
}

std::string ink_rules(bool dark) {
    const auto hex = [](const std::array<std::uint8_t, 3>& c) {
        return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
    };
    const auto colour = [&](PlotInk ink) { return hex(dark ? plot_colour(ink).on_dark : plot_colour(ink).on_light); };
    std::string out;
    for (std::size_t i = 0; i < kPlotInks; ++i) {
        const std::string ink = ink_class(PlotInk(i)), c = colour(PlotInk(i));
        out += fmt::format("#frontier-picture .{}{{fill:{}}}#frontier-picture .l.{}{{fill:none;stroke:{}}}", ink, c,
                           ink, c);
    }
    return out + fmt::format("#frontier-picture .h{{stroke:{}}}", colour(PlotInk::Paper));
}

/// Formats what stands under the mouse at a case: its whisker, and its name with numbers as a tooltip.
std::string hover_of(const PlotPlace& place, const PlotCase& c, const FrontierPlot& plot, std::size_t number) {
    const std::string text =
        fmt::format("{}: {} at {}{}", c.name(), digits_text(c.dot.error), plot_cost_text(plot, c.dot.cost, c.bound),
                    c.dot.cost_noise > 0 && !c.bound ? fmt::format(" (\u00b1 {})", digits_text(c.dot.cost_noise)) : "");
    return fmt::format(
        "<g class=\"case\" data-case=\"{}\"><line class=\"w l {}\" x1=\"{}\" x2=\"{}\" y1=\"{}\" y2=\"{}\"/>"
        "<circle cx=\"{}\" cy=\"{}\" r=\"8\" fill-opacity=\"0\"/><title>{}</title></g>\n",
        number, ink_class(PlotInk::Text), decimal(place.left), decimal(place.right), decimal(place.at.y),
        decimal(place.at.y), decimal(place.at.x), decimal(place.at.y), xml_text(text));
}

}  // namespace

std::string frontier_svg_style(bool in_page) {
    return fmt::format(
        "{}#frontier-picture .h{{paint-order:stroke;stroke-width:3;stroke-linejoin:round}}"
        "#frontier-picture .w{{visibility:hidden}}#frontier-picture .case:hover .w{{visibility:visible}}"
        "{}@media screen and (prefers-color-scheme:dark){{{}}}",
        ink_rules(false), in_page ? "" : "#frontier-picture text{cursor:default}", ink_rules(true));
}

std::string frontier_svg(const FrontierDrawing& d, const FrontierPlot& plot, const FrontierSvgOptions& options) {
    const std::string size = options.in_page ? ""
                                             : fmt::format(
                                                   "xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" "
                                                   "width=\"{}\" height=\"{}\" ",
                                                   decimal(std::ceil(d.width)), decimal(std::ceil(d.height)));
    std::string out = fmt::format(
        "<svg id=\"frontier-picture\" {}viewBox=\"0 0 {} {}\" font-family=\"Helvetica, Arial, 'Liberation Sans', "
        "sans-serif\" "
        "role=\"img\">\n<title>{}</title>\n<style>{}</style>\n",
        size, decimal(std::ceil(d.width)), decimal(std::ceil(d.height)), xml_text(knee_sentence(plot)),
        frontier_svg_style(options.in_page));
    if (!options.in_page)
        out += fmt::format("<rect class=\"{}\" width=\"100%\" height=\"100%\"/>\n", ink_class(PlotInk::Paper));
    for (const PlotMark& m : d.marks) out += svg_mark(m);
    for (const PlotPlace& place : d.cases)
        for (const PlotCase& c : plot.cases)
            if (c.of == place.of) out += hover_of(place, c, plot, options.number ? options.number(c.of) : 0);
    return out + "</svg>\n";
}

std::string frontier_svg(const FrontierPlot& plot, const FrontierSvgOptions& options) {
    return frontier_svg(frontier_drawing(plot, {}), plot, options);
}

}  // namespace si
