#include "app/report/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/report/xml_text.h"

namespace si {
namespace {

constexpr double kWidth = 720, kHeight = 300, kLeft = 76, kRight = 18, kTop = 14, kBottom = 46;

/// Linear axis from values to places in the picture.
struct Axis {
    double from = 0, to = 1, begin = 0, end = 1;
    double place(double v) const { return begin + (v - from) / (to - from) * (end - begin); }
};

Axis axis_over(double least, double most, double begin, double end) {
    if (!(most > least)) most = least + (least != 0 ? std::abs(least) : 1);
    return {least, most, begin, end};
}

bool is_shown(const PlotPoint& p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
}

}  // namespace

std::vector<double> axis_ticks(double from, double to, int count) {
    std::vector<double> out;
    if (!(to > from) || count < 1) return out;
    const double raw = (to - from) / count, power = std::pow(10, std::floor(std::log10(raw)));
    double step = 10 * power;
    for (const double factor : {5.0, 2.0, 1.0})
        if (factor * power >= raw * (1 - 1e-9)) step = factor * power;
    for (double i = std::ceil(from / step - 1e-9) + 0.0; i * step <= to + step * 1e-9; ++i) out.push_back(i * step);
    return out;
}

std::string plot_svg(const Plot& plot) {
    double x0 = plot.x_from_zero ? 0 : INFINITY, x1 = -INFINITY, y1 = 0;
    for (const PlotPoint& p : plot.points) {
        if (!is_shown(p)) continue;
        x0 = std::min(x0, p.x);
        x1 = std::max(x1, p.x);
        y1 = std::max(y1, p.y);
    }
    if (!(x1 >= x0)) return "<p>Nothing was measured.</p>\n";
    const Axis x = axis_over(x0, x1, kLeft, kWidth - kRight);
    const Axis y = axis_over(0, y1 * 1.08, kHeight - kBottom, kTop);
    std::string svg = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", kWidth, kHeight,
                                  xml_text(plot.title));
    for (const double tick : axis_ticks(x.from, x.to, plot.x_whole ? std::min(8, int(x.to - x.from)) : 8))
        svg += fmt::format(
            "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/><text class=\"tick middle\" "
            "x=\"{0:.1f}\" y=\"{3}\">{4:.4g}</text>\n",
            x.place(tick), kTop, kHeight - kBottom, kHeight - kBottom + 16, tick);
    for (const double tick : axis_ticks(y.from, y.to, 5))
        svg += fmt::format(
            "<line class=\"grid\" x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/><text class=\"tick end\" "
            "x=\"{3}\" y=\"{4:.1f}\">{5:.4g}</text>\n",
            kLeft, kWidth - kRight, y.place(tick), kLeft - 6, y.place(tick) + 4, tick);
    svg += fmt::format("<rect class=\"frame\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", kLeft, kTop,
                       kWidth - kRight - kLeft, kHeight - kBottom - kTop);
    svg += fmt::format("<text class=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", 0.5 * (kLeft + kWidth - kRight),
                       kHeight - 8, xml_text(plot.x_label));
    svg += fmt::format("<text class=\"middle\" transform=\"translate(16 {:.1f}) rotate(-90)\">{}</text>\n",
                       0.5 * (kTop + kHeight - kBottom), xml_text(plot.y_label));
    std::string line, dots;
    for (std::size_t i = 0; i < plot.points.size(); ++i) {
        const PlotPoint& p = plot.points[i];
        if (!is_shown(p)) continue;
        const double px = x.place(p.x), py = y.place(p.y);
        line += fmt::format("{}{:.1f},{:.1f}", line.empty() ? "" : " ", px, py);
        const bool marked = plot.mark == i;
        dots += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>\n", marked ? "worst" : "point",
                            px, py, marked ? 6 : 2.5);
    }
    return svg + "<polyline class=\"curve\" points=\"" + line + "\"/>\n" + dots + "</svg>\n";
}

}  // namespace si
