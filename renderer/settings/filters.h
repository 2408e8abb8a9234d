// Table of filter kernels. A new kernel is one row of this table and one GLSL file.
#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/settings/param.h"
#include "renderer/settings/settings.h"

namespace si {

/// Largest distances from the receiver to the texels of a kernel, per axis, in texels: for the needed bias, for the
/// widening of shadow edges, and for the texels that are read.
struct Reach {
    double bias = 0.5;  ///< centres of texels compared with the receiver's own plane (kappa of the bias formula)
    double edge = 0.5;  ///< displacement or widening of a shadow edge
    double read = 0.5;  ///< centres of texels that are read
};

/// Data of the map that a kernel reads.
enum class Samples {
    Depth,    ///< stored depths, for comparisons
    Moments,  ///< averaged functions of depths (lib/moments.glsl, Filter::moments)
};

/// Rule by which a kernel bounds the lit share from its moments.
enum class BoundRule {
    Chebyshev,            ///< of depths: lib/variance.glsl
    Exponential,          ///< mean of e^(c x): filters/esm.glsl
    WarpedChebyshev,      ///< of e^(c x): filters/evsm2.glsl
    TwoWarpedChebyshevs,  ///< the lower one of e^(c x) and of -e^(-d x): filters/evsm4.glsl
    FourMoments,          ///< lib/moment_problem.glsl
};

/// Moments that the moments pass stores for a kernel in place of depths. `vec4 moments_of(float share)` of the kernel's
/// file gives them for one depth; the pass averages them around each texel.
struct StoredMoments {
    std::span<const std::string_view> names = {};  ///< names of the 1, 2 or 4 channels
    int power = 0;                                 ///< highest stored power of the exponential; 0: none
    bool quantised = false;        ///< with 16 bits: integers of a transform of the moments (shared/moments.h)
    bool summed = false;           ///< stored as a summed-area table (lib/summed_area.glsl)
    bool reduces_bleeding = true;  ///< filter.bleed applies
    BoundRule rule = BoundRule::Chebyshev;
    std::string_view bound = {};  ///< text: upper bound of the lit share, by mean m, variance v and own depth z
};

/// Work of a kernel for each light and lit pixel, in texture calls and fetched texels.
struct FilterCost {
    int gathers = 0;       ///< textureGather calls with method gather; 0: one call fetches one texel
    int sampler_taps = 1;  ///< texture calls with the other methods
    int texels = 1;        ///< texels fetched by the sampler; from cost_of(): by the method in use
};

/// Largest allowed error of a kernel against the reference at pixels without an edge in reach, and the reason.
struct Tolerance {
    double lit = 1e-5;   ///< missing visibility on lit surfaces: rounded weights sum to a little less or more than 1
    double dark = 1e-5;  ///< remaining visibility in full shadow
    std::string_view why = "rounding of the weights";
};

/// Convergence of a sampling kernel to its own result with 4096 samples. Random samples converge with the square root
/// of their number, evenly spread samples faster.
struct Noise {
    std::string_view taps;  ///< key of the setting with the number of samples; empty: the kernel does not sample
    double slope = 0;       ///< slope of log RMSE over log number
    double tolerance = 0.15;
};

/// Row of the table of shadow filter kernels. The GLSL file that a row names defines `float filter_visibility(Receiver
/// r)`.
struct Filter {
    std::string_view key, label, help;
    std::string_view paper;          ///< source
    std::string_view file;           ///< GLSL file below shaders/
    int size = 1;                    ///< texels or bilinear taps per axis of a square kernel; 0: filter.size
    bool bilinear = false;           ///< each tap blends 2x2 texels, except with filter.point; rows that list
                                     ///< filter.bilinear ignore it
    bool linear = true;              ///< result is a weighted sum of comparisons, so that each tap has a weight
    StoredMoments moments = {};      ///< without names: the kernel compares depths
    bool searches_blockers = false;  ///< first searches casters; without one it returns lit and compares nothing
    bool reads_light_size = false;
    bool uses_disk_table = false;  ///< samples the kDiskTable points of the Poisson disk, unless filter.disk is spiral
    std::span<const std::string_view> settings = {};  ///< setting keys that only rows listing them read
    /// Returns the kernel's reach.
    /// @param widest_texels radius of its widest area under the light: the penumbra for rows that read the light's
    /// size, else a filter.radius in metres; infinite if no light is known
    Reach (*reach)(const Filter&, const Settings&, double widest_texels) = square_reach;
    /// Returns the kernel's cost.
    FilterCost (*cost)(const Filter&, const Settings&) = square_cost;

    Tolerance tolerance = {};
    Noise noise = {};
    /// Names of this row's variants for sweeps over all kernels and for searches, as in --set filter.kernel; empty: the
    /// row's key.
    std::span<const std::string_view> swept = {};

    /// Returns true for size x size taps at fixed places around the look-up.
    bool square() const { return reach == square_reach; }
    /// Returns the values that the kernel samples.
    Samples samples() const { return moments.names.empty() ? Samples::Depth : Samples::Moments; }
    /// Returns the reach of a square kernel, in texels.
    static Reach square_reach(const Filter& row, const Settings&, double widest_texels);
    /// Returns the cost of a square kernel in texture fetches.
    static FilterCost square_cost(const Filter& row, const Settings& settings);
};

/// Returns true when the kernel row lists the setting `key` among its own settings.
bool owns_setting(const Filter& row, std::string_view key);

/// Returns the taps per axis of a square kernel, the GLSL define KERNEL_SIZE.
int taps_across(const Filter& row, const Settings& settings);
/// Returns true when each tap of the kernel blends 2x2 texels.
bool is_bilinear(const Filter& row, const Settings& settings);
/// Returns the chosen kernel's label for display, with its size if the size is a setting: "PCF 5×5".
std::string kernel_label(const Settings& settings);
/// Returns the number of disk points that a kernel samples, for cost estimates; disk_points() returns the points.
/// @param places the requested number of points, which the size of the table limits
int disk_point_count(const Filter& row, const Settings& settings, int places);
/// Returns the `places` points in the unit disk that a kernel samples, from the Poisson table or the spiral.
std::vector<glm::vec2> disk_points(const Filter& row, const Settings& settings, int places);

/// Memory for data that a kernel needs prepared besides the depths, in bytes.
struct PrefilterBytes {
    double kept = 0;     ///< bytes per texel of the maps, mip levels included
    double scratch = 0;  ///< bytes per texel of one map, during the preparation
};
/// Returns the memory for prepared data (moments, mip levels, tables) of the chosen kernel, in bytes per texel.
PrefilterBytes prefilter_bytes(const Settings& settings);
/// Returns the bytes per texel of a map and of the data that is stored for it: 4 for depth in any format, 4 more for
/// the blurred depth (map.blur_texels), and those of the prefiltered moments. Temporary images do not count.
double stored_texel_bytes(const Settings& settings);

/// Returns the moment that the map viewer shows, counted from 1. Returns 0 for depth, or if view.map_channel names no
/// moment of the kernel.
int shown_channel(const Settings& settings);
/// Returns true when the moments have mip levels: filter.mips is on and the kernel reads moments, but not from a
/// summed-area table.
bool keeps_mips(const Settings& settings);
/// Returns the requested mip level of the shown moment, which may exceed the coarsest; 0 without mip levels.
int requested_mip(const Settings& settings);

/// Returns the highest exponent (filter.exponent) for which the stored exponentials and their powers neither overflow
/// nor flush to zero in the moment format. Infinite if the kernel stores no exponential.
double safe_exponent(const Settings& settings);

/// Returns all rows of the kernel table.
std::span<const Filter> filters();
/// Appends a kernel row that is not built in. Call it before the first use of the settings table. The row's GLSL text
/// comes from gl::add_shader_text().
void add_filter(const Filter& row);
/// Returns the kernels of a sweep over all kernels, each at its short list of sizes: "hard", "pcf3", "pcf5", ...
std::span<const std::string_view> sweep_kernels();

/// Returns the kernel row that the setting filter.kernel chooses.
const Filter& filter_of(const Settings& settings);
/// Returns the distances that the chosen kernel reaches from the look-up, in texels: to the texels that need bias, that
/// soften an edge, and that are read at all. For a given light use kernel_reach_in_light().
/// @param widest_texels radius of the kernel's widest area; infinite if no light is known
Reach reach_of(const Settings& settings, double widest_texels = std::numeric_limits<double>::infinity());

}  // namespace si
