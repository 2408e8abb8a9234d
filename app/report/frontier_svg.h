// Frontier plot as an SVG picture.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "renderer/measure/frontier_drawing.h"

namespace si {

/// Options for writing a frontier plot (error against cost) as SVG.
struct FrontierSvgOptions {
    bool in_page = false;  ///< part of an HTML page, whose preference for dark or light it follows; else a file
    /// Returns the number of a case by PlotCase::of, for scripts of the page; none: 0.
    std::function<std::size_t(std::size_t)> number = {};
};

/// Returns the text of the style element in the SVG of a frontier plot, for the hash in a page's security policy. All
/// plots have the same text. @param in_page FrontierSvgOptions::in_page
std::string frontier_svg_style(bool in_page);
/// Formats a drawing of the frontier as self-contained SVG without external fonts, scripts or files. Equal drawings
/// give equal bytes. Whiskers and names of cases show under the mouse.
std::string frontier_svg(const FrontierDrawing& drawing, const FrontierPlot& plot,
                         const FrontierSvgOptions& options = {});
/// Draws a frontier plot as SVG on a page of 640 pixels, with its sentence and its table.
std::string frontier_svg(const FrontierPlot& plot, const FrontierSvgOptions& options = {});

}  // namespace si
