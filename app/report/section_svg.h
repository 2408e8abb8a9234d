// Cross-section of a shadow test as an SVG picture.
#pragma once

#include <string>

#include "renderer/inspect/section_drawing.h"

namespace si {

/// Formats the drawing of a shadow test's cross-section (cut along the light ray) as self-contained SVG 1.1 without
/// external fonts, scripts or files. Equal drawings give equal bytes. The picture has its own background and follows
/// the reader's preference for dark or light pages.
/// @param title text for readers who cannot see the picture
std::string section_svg(const SectionDrawing& drawing, const std::string& title);
/// Draws the cross-section of a shadow test (cut along the light ray) at its natural size as SVG. The title contains
/// the verdict on the pixel.
std::string section_svg(const Section& section);

}  // namespace si
