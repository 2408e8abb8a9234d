// A cross-section as lines, areas and words with roles, for whatever paints them: the editor, an SVG file.
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

/// What a mark of the drawing stands for; its colour follows.
enum class Ink {
    Paper,
    Text,
    Muted,    ///< less important words, leaders, frames
    Grid,     ///< sides of texels
    Shade,    ///< what the map holds for shadow
    Step,     ///< the stored depth
    Surface,  ///< what the light sees in truth
    Plane,    ///< of the probed surface
    Ray,      ///< of the light
    Lit,
    Dark,
    Self,          ///< dark by the surface itself
    ComparedLit,   ///< the depth that a texel is compared with
    ComparedDark,  ///< likewise, in shadow
    Offset,        ///< along the normal
    Bias,
    Window,    ///< of biases that are right
    NoWindow,  ///< between what is needed and what stands in the way, where no bias is right
    Occluder,
    Moments,  ///< mean and spread of depths
};
inline constexpr std::size_t kInks = std::size_t(Ink::Moments) + 1;

/// sRGB on a light and on a dark ground.
struct InkColour {
    std::string_view key;  ///< lower case, for class names
    std::array<std::uint8_t, 3> on_light, on_dark;
};
const InkColour& ink_colour(Ink ink);

struct Mark {
    enum class Kind { Line, Area, Dot, Text };
    enum class Anchor { Start, Middle, End };
    Kind kind = Kind::Line;
    Ink ink = Ink::Text;
    std::vector<glm::dvec2> points;  ///< x to the right, y down; of a text its baseline
    double width = 1;                ///< of a line; of a dot its radius
    double opacity = 1;
    bool dashed = false, arrow = false;  ///< of lines; the arrow at the last point
    bool strong = false;                 ///< of texts
    Anchor anchor = Anchor::Start;
    std::string text;
};

/// What marks of one kind and ink mean.
struct LegendRow {
    Mark::Kind kind = Mark::Kind::Line;
    Ink ink = Ink::Text;
    bool dashed = false;
    std::string_view text;  ///< static
    bool explains(const Mark& mark) const { return mark.kind == kind && mark.ink == ink; }
};
inline constexpr double kSwatchEms = 1.6;  ///< width of a row's swatch, in heights of its text

/// Lengths are those of the picture: pixels.
struct SectionPage {
    double width = 960, height = 600;
    double em = 15;        ///< height of text
    bool captions = true;  ///< with the verdict in words and the legend; else the drawing alone
    std::function<double(std::string_view)> text_width;  ///< none: by a mean width of letters
};

struct SectionDrawing {
    double width = 0, height = 0;
    std::vector<Mark> marks;        ///< from back to front
    std::vector<LegendRow> legend;  ///< of the marks that there are and no label names; with captions or without
    double across = 1;              ///< pixels a metre across the light's ray
    double along = 1;               ///< and along it
    double zero_x = 0, zero_y = 0;  ///< where Section's origin lies
    bool broken = false;            ///< what is far nearer to the light stands in a strip of its own above
};

/// A caption's height is found by its words: the drawing may be higher than the page.
SectionDrawing draw_section(const Section& section, const SectionPage& page);

/// @param left the middle of its left side, in pixels @param em height of the text beside it, in pixels
Mark legend_swatch(const LegendRow& row, const glm::dvec2& left, double em);

/// Of a place in the drawing, in pixels: the row of the nearest line or dot within `reach`, else of the foremost area
/// there. Null: nothing is there, or it has no row.
const LegendRow* legend_row_at(const SectionDrawing& drawing, const glm::dvec2& at, double reach);

}  // namespace si
