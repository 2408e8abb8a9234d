// Drawing of the frontier plot as lines, shapes and texts with roles, to be painted by the editor or as SVG.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/measure/front_steps.h"

namespace si {

/// Number of colours for families of kernels, which colour-blind people tell apart.
inline constexpr int kPlotFamilies = 8;

/// Case of a sweep in the frontier plot.
struct PlotCase {
    std::size_t of = 0;  ///< index of the case among the caller's
    std::string line;    ///< line that the case belongs to: "PCF 3×3"
    std::string place;   ///< place on the line: "2048²"; empty: the line has one case
    double along = 0;    ///< order on the line
    int family = 0;      ///< colour and shape, below kPlotFamilies
    Dot dot;             ///< cost and error; the cost is an upper bound if `bound`
    bool bound = false;  ///< the cost does not differ from 0 by more than its noise
    bool tied = false;   ///< a better case exists, but within noise
    std::string name() const { return place.empty() ? line : line + ", " + place; }
};

/// Settings in the frontier plot that are no case of the sweep.
struct PlotSpot {
    /// Kind of a spot: the present settings, the pinned or earlier ones, an engine's profile.
    enum class Kind { Present, Pinned, Engine };
    Kind kind = Kind::Present;
    std::string label;
    Dot dot;
};

/// Data of a frontier plot: error against cost of measured cases, with their Pareto front.
struct FrontierPlot {
    std::vector<PlotCase> cases;
    std::vector<PlotSpot> spots;
    std::vector<Dot> forced;  ///< front of frames with all optimisations off, a faint line; empty: none
    std::string cost_title, error_title;
    std::string cost_unit;            ///< "ms of processor"; empty: none
    bool bytes = false;               ///< costs are bytes
    std::optional<double> base_cost;  ///< cost of the base of multiples; nullopt: unknown or within noise
    std::string base_name;            ///< "Hard (nearest), 1024²"
    bool whole = false;               ///< the axes hold all cases; else they end some way beyond the front
};

/// Role of a mark in a frontier plot; the mark's colour follows from the role.
enum class PlotInk { Paper, Text, Muted, Grid, Beaten, Front, Spot, Family0 };
inline constexpr std::size_t kPlotInks = std::size_t(PlotInk::Family0) + kPlotFamilies;

/// Returns the role of a family's marks. @param family below kPlotFamilies
PlotInk family_ink(int family);

/// Colour of a mark's role: sRGB on a light and on a dark background.
struct PlotColour {
    std::array<std::uint8_t, 3> on_light, on_dark;
};
/// Returns the colour of a mark's role.
const PlotColour& plot_colour(PlotInk ink);

/// Line, shape or text in a frontier plot, in pixels.
struct PlotMark {
    /// Shape of a mark. Area: a filled polygon.
    enum class Kind { Line, Area, Text };
    /// Alignment of a text to its point.
    enum class Anchor { Start, Middle, End };
    Kind kind = Kind::Line;
    PlotInk ink = PlotInk::Text;
    std::vector<glm::dvec2> points = {};  ///< x to the right, y down; for texts the start of the baseline
    double width = 1;                     ///< width of a line
    double opacity = 1;
    bool dashed = false, closed = false;  ///< for lines
    bool strong = false;                  ///< bold text
    double size = 0;                      ///< height of a text
    Anchor anchor = Anchor::Start;
    std::string text = {};
    bool halo = false;  ///< for texts: an edge in the colour of the paper
};

/// Height of small text, share of the em.
inline constexpr double kSmallText = 0.85;

/// Page of a frontier plot: size and text metrics in pixels.
struct PlotPage {
    double width = 640, height = 360;  ///< width of the page; height of the box with the axes
    double em = 13;                    ///< height of text; small text is smaller
    bool sentence = true;              ///< writes what the knee is above the plot
    bool table = true;                 ///< writes the best cases for multiples of the base's cost below the plot
    bool titles = true;                ///< writes the titles of the axes
    std::function<double(std::string_view, double size, bool strong)> text_width = {};  ///< none: estimated
};

/// Place of a case or spot in a drawing, with the ends of its whisker, pixels.
struct PlotPlace {
    std::size_t of = 0;  ///< PlotCase::of, or the index of the spot
    glm::dvec2 at{0};
    double left = 0, right = 0;  ///< cost minus and plus its noise
};

/// Drawing of a frontier plot: marks from back to front, and the places that a mouse can find.
struct FrontierDrawing {
    double width = 0, height = 0;
    std::vector<PlotMark> marks;
    std::vector<PlotPlace> cases, spots;
};

/// Draws a frontier plot: a line a kernel, the Pareto front as a bold stair with a label a step, spots as diamonds.
/// Lines without a case on the front are thin and grey. Whiskers stand where the noise of neighbours on the front
/// overlaps.
FrontierDrawing frontier_drawing(const FrontierPlot& plot, const PlotPage& page);

/// Returns the sentence on the knee: "PCF 3×3, 2048²: 0.021 for 6 ms; nothing within 2 × is a quarter better."
std::string knee_sentence(const FrontierPlot& plot);
/// Formats a cost of a case with its unit: "6.1 ms of processor", "< 0.4 ms" for a bound.
std::string plot_cost_text(const FrontierPlot& plot, double cost, bool bound);

/// Row of the table of best cases within a multiple of the base's cost.
struct BestRow {
    double multiple = 1;
    std::optional<std::size_t> best;  ///< index in FrontierPlot::cases; nullopt: none costs so little
};
/// Lists the best cases within 1, 2, 4 and 8 times the base's cost; empty without a base.
std::vector<BestRow> best_rows(const FrontierPlot& plot);
/// Returns the dots of a plot's cases.
std::vector<Dot> dots_of(const FrontierPlot& plot);

}  // namespace si
