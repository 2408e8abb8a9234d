// A cross-section as a picture for pages and slides.
#pragma once

#include <string>

#include "renderer/inspect/section_drawing.h"

namespace si {

/// SVG 1.1, by itself: no fonts, scripts or files from elsewhere. The same drawing gives the same bytes. Where the
/// reader asks for dark pages its colours are those for a dark ground; it brings its own ground.
/// @param title for readers who cannot see it
std::string section_svg(const SectionDrawing& drawing, const std::string& title);
/// Of a section in the drawing's own size, with its verdict as the title.
std::string section_svg(const Section& section);

}  // namespace si
