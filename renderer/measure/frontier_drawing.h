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

/// Number of colours for families of filter kernels in the frontier plot (error over cost). Colour-blind people can
/// tell these colours apart.
inline constexpr int kPlotFamilies = 8;

/// Measured case of a sweep in the frontier plot (error over cost): names, family of kernels, cost and error.
struct PlotCase {
    std::size_t of = 0;  ///< index of the case in the caller's list
    std::string line;    ///< line that the case belongs to: "PCF 3×3"
    std::string place;   ///< place on the line: "2048²"; empty: the line has one case
    double along = 0;    ///< sort key of the case on its line
    int family = 0;      ///< colour and shape, below kPlotFamilies
    Dot dot;             ///< cost and error; the cost is an upper bound if `bound`
    bool bound = false;  ///< the cost does not differ from 0 by more than its noise
    bool tied = false;   ///< a better case exists, but within noise
    std::string name() const { return place.empty() ? line : line + ", " + place; }
};

/// Settings that the frontier plot (error over cost) marks although they are no case of its sweep, such as the present
/// settings.
struct PlotSpot {
    /// Kind of settings that a spot marks: the present settings, pinned or earlier settings, an engine's profile.
    enum class Kind { Present, Pinned, Engine };
    Kind kind = Kind::Present;
    std::string label;
    Dot dot;
};

/// Data of a frontier plot: error over cost of measured cases, with their Pareto front.
struct FrontierPlot {
    std::vector<PlotCase> cases;
    std::vector<PlotSpot> spots;
    std::vector<Dot> forced;  ///< cases with all optimisations off; their front is a faint line; empty: none
    std::string cost_title, error_title;
    std::string cost_unit;            ///< "ms of processor"; empty: none
    bool bytes = false;               ///< costs are bytes
    std::optional<double> base_cost;  ///< cost of the base case, unit of multiples; nullopt: unknown or within noise
    std::string base_name;            ///< name of the base case: "Hard (nearest), 1024²"
    bool whole = false;               ///< true: the axes span all cases; false: they end some way beyond the front
};

/// Role of a mark in a frontier plot (error over cost), such as grid or text; the mark's colour follows from the role.
enum class PlotInk { Paper, Text, Muted, Grid, Beaten, Front, Spot, Family0 };
inline constexpr std::size_t kPlotInks = std::size_t(PlotInk::Family0) + kPlotFamilies;

/// Returns the role, and so the colour, of marks for a family of filter kernels in the frontier plot (error over cost).
/// @param family below kPlotFamilies
PlotInk family_ink(int family);

/// Colour of all marks with the same role (PlotInk: grid, Pareto front and others) in the frontier plot (error over
/// cost). Has one sRGB colour for a light background and one for a dark one.
struct PlotColour {
    std::array<std::uint8_t, 3> on_light, on_dark;
};
/// Returns the colour of the lines, areas and texts that have the role `ink` in the frontier plot (error over cost).
const PlotColour& plot_colour(PlotInk ink);

/// Line, shape or text in a frontier plot (error over cost), in pixels.
struct PlotMark {
    /// Shape of a mark in a frontier plot. Area: a filled polygon.
    enum class Kind { Line, Area, Text };
    /// Alignment of a text in a frontier plot to its point.
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

/// Height of small text in a frontier plot (error over cost), as a share of PlotPage::em.
inline constexpr double kSmallText = 0.85;

/// Page of a frontier plot (error over cost): size and text metrics in pixels, and the parts to draw.
struct PlotPage {
    double width = 640, height = 360;  ///< width of the page; height of the box with the axes
    double em = 13;                    ///< height of text; small text is smaller
    bool sentence = true;              ///< writes knee_sentence() above the plot
    bool table = true;                 ///< writes the table of best_rows() below the plot
    bool titles = true;                ///< writes the titles of the axes
    std::function<double(std::string_view, double size, bool strong)> text_width = {};  ///< none: estimated
};

/// Pixel position of a case, or of other marked settings, in a drawn frontier plot (error over cost). A whisker shows
/// the noise of the cost.
struct PlotPlace {
    std::size_t of = 0;  ///< PlotCase::of, or index into FrontierPlot::spots
    glm::dvec2 at{0};
    double left = 0, right = 0;  ///< x of the whisker's ends: cost minus and plus its noise
};

/// Drawing of a frontier plot (error over cost): lines, areas and texts from back to front, and the positions of cases
/// for the mouse.
struct FrontierDrawing {
    double width = 0, height = 0;
    std::vector<PlotMark> marks;
    std::vector<PlotPlace> cases, spots;
};

/// Draws a frontier plot (error over cost): one line for each kernel, and the Pareto front as bold stairs with a label
/// for each step. Lines without a case on the front are thin and grey. Settings outside the sweep are diamonds. Where
/// the noise of neighbours on the front overlaps, whiskers show the noise.
FrontierDrawing frontier_drawing(const FrontierPlot& plot, const PlotPage& page);

/// Returns a sentence on the knee of the Pareto front (knee_of()): the case beyond which more cost gains little. Up to
/// twice the knee's cost, no case has an error lower by a quarter. Example: "PCF 3×3, 2048²: 0.021 for 6 ms; nothing
/// within 2 × is a quarter better."
std::string knee_sentence(const FrontierPlot& plot);
/// Formats the cost of a case in the frontier plot (error over cost) with its unit, such as "6.1 ms of processor" for
/// processor time.
/// @param bound true: the cost is only an upper bound, "< 0.4 ms"
std::string plot_cost_text(const FrontierPlot& plot, double cost, bool bound);

/// Row of the table below a frontier plot (error over cost): the case with the least error within a cost limit. The
/// limit is a multiple of the cost of the base case (hard kernel, 1024 texels).
struct BestRow {
    double multiple = 1;
    std::optional<std::size_t> best;  ///< index into FrontierPlot::cases; nullopt: every case costs more
};
/// Lists the cases with the least error within four cost limits, for the table below a frontier plot (error over cost).
/// The limits are 1, 2, 4 and 8 times the cost of the base case (hard kernel, 1024 texels). Empty when the base's cost
/// is unknown.
std::vector<BestRow> best_rows(const FrontierPlot& plot);
/// Returns cost and error of all cases of a frontier plot, in their order.
std::vector<Dot> dots_of(const FrontierPlot& plot);

}  // namespace si
