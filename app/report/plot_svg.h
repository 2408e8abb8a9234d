// Small plots for pages without scripts: a line over two linear axes, as inline SVG.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace si {

/// Point of a line plot. A point with a value that is not finite is left out.
struct PlotPoint {
    double x = 0, y = 0;
};

/// Data of a line plot: points, labels of both axes, and a marked point.
struct Plot {
    std::string title;                ///< text for readers who cannot see the picture
    std::string x_label, y_label;     ///< names of the axes with their units
    std::vector<PlotPoint> points;    ///< in order of x
    bool x_whole = false;             ///< values across are whole numbers, such as steps
    bool x_from_zero = true;          ///< the axis across begins at 0; else at the least x
    std::optional<std::size_t> mark;  ///< index of the point that stands out
};

/// Returns round values within [from, to] at which an axis of a plot has ticks; empty unless `from` is below `to`.
/// @param count approximate largest number of ticks
std::vector<double> axis_ticks(double from, double to, int count);

/// Formats a line plot as inline SVG for an HTML page, with the style classes of assets/report/still.css. All texts are
/// escaped.
std::string plot_svg(const Plot& plot);

}  // namespace si
