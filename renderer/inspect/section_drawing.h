// Drawing of a cross-section as lines, areas, dots and texts, to be painted by the editor or as SVG. Each of them has a
// role: the thing that it shows, which decides its colour.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/inspect/section.h"

namespace si {

/// Role of a line, area, dot or text in the drawing of a cross-section: the thing that it shows, such as stored depths.
/// Its colour follows from the role.
enum class Ink {
    Paper,
    Text,
    Muted,    ///< less important words, leaders, frames
    Grid,     ///< sides of texels
    Shade,    ///< region in shadow by the map
    Step,     ///< stored depth
    Surface,  ///< first surface from the light, by rays
    Plane,    ///< plane of the probed surface
    Ray,      ///< light ray
    Lit,
    Dark,
    Self,          ///< self-shadowed tap
    ComparedLit,   ///< compared depth, lit
    ComparedDark,  ///< compared depth, in shadow
    Offset,        ///< normal offset
    Bias,
    Window,    ///< range of right biases
    NoWindow,  ///< gap between needed bias and occluder, where no bias is right
    Occluder,
    Moments,  ///< mean and spread of depths
};
inline constexpr std::size_t kInks = std::size_t(Ink::Moments) + 1;

/// Colour of a role in the drawing of a cross-section: sRGB on a light and on a dark background.
struct InkColour {
    std::string_view key;  ///< lower case, for class names
    std::array<std::uint8_t, 3> on_light, on_dark;
};
/// Returns the colour of a role of lines, areas and texts in the drawing of a cross-section.
const InkColour& ink_colour(Ink ink);

/// Line, area, dot or text in the drawing of a cross-section, in pixels.
struct Mark {
    /// Shape of a mark in the drawing of a cross-section.
    enum class Kind { Line, Area, Dot, Text };
    /// Alignment of a text in the drawing of a cross-section to its point.
    enum class Anchor { Start, Middle, End };
    Kind kind = Kind::Line;
    Ink ink = Ink::Text;
    std::vector<glm::dvec2> points;  ///< x to the right, y down; for texts the start of the baseline
    double width = 1;                ///< width of a line, or radius of a dot
    double opacity = 1;
    bool dashed = false, arrow = false;  ///< for lines; the arrow is at the last point
    bool strong = false;                 ///< bold text
    Anchor anchor = Anchor::Start;
    std::string text;
};

/// Legend entry in the drawing of a cross-section. It explains all marks of one shape (Mark::Kind) that show the same
/// thing (Ink), such as stored depths.
struct LegendRow {
    Mark::Kind kind = Mark::Kind::Line;
    Ink ink = Ink::Text;
    bool dashed = false;
    std::string_view text;  ///< static string
    /// Returns true when the legend entry explains a mark, which has the same shape and role.
    bool explains(const Mark& mark) const { return mark.kind == kind && mark.ink == ink; }
};
inline constexpr double kSwatchEms = 1.6;  ///< width of a legend swatch, in text heights

/// Page on which a cross-section is drawn: size and text metrics in pixels, and whether to write captions.
struct SectionPage {
    double width = 960, height = 600;
    double em = 15;                                      ///< height of text
    bool captions = true;                                ///< draws the verdict and the legend
    std::function<double(std::string_view)> text_width;  ///< width of a text in pixels; none: estimated
};

/// Drawing of a cross-section as marks (lines, areas, dots and texts) in pixels, with legend and scale. The editor
/// paints it, or a file stores it as SVG.
struct SectionDrawing {
    double width = 0, height = 0;
    std::vector<Mark> marks;        ///< from back to front
    std::vector<LegendRow> legend;  ///< entries that explain a mark of the drawing, also when no legend is drawn
    double across = 1;              ///< pixels per metre across the light's ray
    double along = 1;               ///< pixels per metre along the light's ray
    double zero_x = 0, zero_y = 0;  ///< pixel of the origin of Section
    bool broken = false;            ///< true: distant occluders are drawn in a separate strip at the top
};

/// Lays out a cross-section as lines, areas, dots and texts on a page. Without captions the drawing has the page's
/// height. With captions the height follows from the content, and a long verdict may exceed the page.
SectionDrawing draw_section(const Section& section, const SectionPage& page);

/// Makes the sample of line or area that a legend entry shows beside its text.
/// @param row the entry @param left the middle of the sample's left side, pixels @param em height of the entry's text,
/// pixels
Mark legend_swatch(const LegendRow& row, const glm::dvec2& left, double em);

/// Finds the legend entry for a position in the drawing of a cross-section, such as the mouse pointer. Takes the
/// nearest line or dot within `reach`, else the topmost area. Null when no mark with a legend entry is there.
/// @param at the position, pixels @param reach pixels
const LegendRow* legend_row_at(const SectionDrawing& drawing, const glm::dvec2& at, double reach);

}  // namespace si
