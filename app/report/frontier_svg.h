// Frontier plot as an SVG picture.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "renderer/measure/frontier_drawing.h"

namespace si {

/// Options for writing a frontier plot (error against cost) as SVG.
struct FrontierSvgOptions {
    bool in_page = false;  ///< makes an SVG element for an HTML page; false: a whole SVG file
    /// Converts the index of a case in the caller's list (PlotCase::of) to the case's number for scripts of the page.
    /// Empty: all cases have the number 0.
    std::function<std::size_t(std::size_t)> number = {};
};

/// Returns the text of the style element in the SVG of a frontier plot (error against cost). It is equal for all plots,
/// so that a page can allow it by hash in its Content-Security-Policy. @param in_page FrontierSvgOptions::in_page
std::string frontier_svg_style(bool in_page);
/// Formats the drawing of a frontier plot (error against cost) as self-contained SVG without external fonts, scripts or
/// files. Equal drawings give equal bytes. A case under the mouse shows its name and its whisker (noise of the cost).
/// @param plot plot that was drawn
std::string frontier_svg(const FrontierDrawing& drawing, const FrontierPlot& plot,
                         const FrontierSvgOptions& options = {});
/// Draws a frontier plot (error against cost) as SVG, 640 pixels wide. Adds a sentence on the knee, after which more
/// cost gains little, and a table of the best cases.
std::string frontier_svg(const FrontierPlot& plot, const FrontierSvgOptions& options = {});

}  // namespace si
