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

/// Reach of a shadow kernel: the largest distances from the look-up to its texels, in texels along each axis. There is
/// one distance for the needed bias, one for the widening of shadow edges, and one for all texels that are read.
struct Reach {
    double bias = 0.5;  ///< centres of texels compared with the receiver's own plane (kappa of the bias formula)
    double edge = 0.5;  ///< displacement or widening of a shadow edge
    double read = 0.5;  ///< centres of texels that are read
    bool operator==(const Reach&) const = default;
};

/// Data that a shadow kernel reads from the map: depths, or moments computed from depths.
enum class Samples {
    Depth,    ///< stored depths, for comparisons
    Moments,  ///< averaged functions of depths (lib/moments.glsl, Filter::moments)
};

/// Rule by which a kernel that reads moments (VSM, ESM, EVSM, MSM) computes the upper bound of visibility. In the rules
/// c is filter.exponent, d is filter.negative_exponent, and x is depth scaled to -1 to 1.
enum class BoundRule {
    Chebyshev,            ///< Chebyshev's inequality for depths: lib/variance.glsl
    Exponential,          ///< mean of e^(c x): filters/esm.glsl
    WarpedChebyshev,      ///< Chebyshev's inequality for e^(c x): filters/evsm2.glsl
    TwoWarpedChebyshevs,  ///< the lower of the bounds for e^(c x) and for -e^(-d x): filters/evsm4.glsl
    FourMoments,          ///< bound from four moments: lib/moment_problem.glsl
};

/// Moments of depth that a kernel such as VSM or MSM reads in place of depths. The kernel's GLSL function moments_of()
/// computes them from one depth. The moments pass averages them around each texel.
struct StoredMoments {
    std::span<const std::string_view> names = {};  ///< names of the 1, 2 or 4 channels
    int power = 0;                                 ///< highest stored power of the exponential; 0: none
    bool quantised = false;        ///< with 16 bits: integers of a transform of the moments (shared/moments.h)
    bool summed = false;           ///< stored as a summed-area table (lib/summed_area.glsl)
    bool reduces_bleeding = true;  ///< filter.bleed applies
    BoundRule rule = BoundRule::Chebyshev;
    std::string_view bound = {};  ///< text: upper bound of visibility, by mean m, variance v and own depth z
};

/// Work of a shadow kernel for one light and one lit pixel, in texture calls and fetched texels.
struct FilterCost {
    int gathers = 0;       ///< textureGather calls with method gather; 0: the kernel does not gather
    int sampler_taps = 1;  ///< texture calls with the other methods
    int texels = 1;        ///< texels fetched by a sampler; kernel_cost() gives those of the method in use
};

/// Largest error of visibility against the reference that tests allow a kernel, and the reason. The limit holds at
/// pixels with no shadow edge within the kernel's reach.
struct Tolerance {
    double lit = 1e-5;   ///< missing visibility on lit surfaces: rounded weights sum to a little less or more than 1
    double dark = 1e-5;  ///< remaining visibility in full shadow
    std::string_view why = "rounding of the weights";
};

/// Expected fall of a kernel's sampling noise with more samples: the slope of log RMSE over the logarithm of their
/// number. The error is against the kernel's own result with 4096 samples. Random samples have the slope -1/2, evenly
/// spread ones a steeper slope.
struct Noise {
    std::string_view taps;    ///< key of the setting with the number of samples; empty: the kernel does not sample
    double slope = 0;         ///< slope of log RMSE over the log of the number of samples
    double tolerance = 0.15;  ///< largest difference from `slope` that a test allows
};

/// Row of the table of shadow filter kernels, such as PCF, PCSS or VSM. The GLSL file that a row names defines `float
/// filter_visibility(Receiver r)`.
struct Filter {
    std::string_view key, label, help;
    std::string_view paper;          ///< source
    std::string_view file;           ///< GLSL file below shaders/
    int size = 1;                    ///< texels or bilinear taps per axis of a square kernel; 0: filter.size
    bool bilinear = false;           ///< each tap blends 2x2 texels, except with filter.point; rows that list
                                     ///< filter.bilinear ignore this member
    bool linear = true;              ///< result is a weighted sum of comparisons, so that each tap has a weight
    StoredMoments moments = {};      ///< without names: the kernel compares depths
    bool searches_blockers = false;  ///< first searches for casters; if there is none, returns 1 without comparisons
    bool reads_light_size = false;
    bool uses_disk_table = false;  ///< samples the kDiskTable points of the Poisson disk, unless filter.disk is spiral
    std::span<const std::string_view> settings = {};  ///< keys of settings that a row reads only if it lists them
    /// Returns the kernel's reach in texels.
    /// @param widest_texels largest radius of the kernel under the light: that of the widest penumbra for rows that
    /// read the light's size, else filter.radius converted from metres. Infinite if no light is known
    Reach (*reach)(const Filter&, const Settings&, double widest_texels) = square_reach;
    /// Returns the kernel's texture calls and fetched texels for one light and one lit pixel.
    FilterCost (*cost)(const Filter&, const Settings&) = square_cost;

    Tolerance tolerance = {};
    Noise noise = {};
    /// Names of this row's variants for sweeps over all kernels and for searches, as in --set filter.kernel; empty: the
    /// row's key.
    std::span<const std::string_view> swept = {};

    /// Returns true when the kernel has size x size taps at fixed places around the look-up.
    bool square() const { return reach == square_reach; }
    /// Returns the data that the kernel reads from the map: depths or moments.
    Samples samples() const { return moments.names.empty() ? Samples::Depth : Samples::Moments; }
    /// Returns the reach of a kernel that is a fixed square of taps, in texels. Function to which the member
    /// Filter::reach of such a kernel points.
    /// @param widest_texels not used
    static Reach square_reach(const Filter& row, const Settings&, double widest_texels);
    /// Returns the texture calls and fetched texels of a kernel that is a fixed square of taps. Function to which the
    /// member Filter::cost of such a kernel points.
    static FilterCost square_cost(const Filter& row, const Settings& settings);
};

/// Returns true when the kernel row lists the setting `key` in Filter::settings. Only kernels that list such a setting
/// read it.
bool owns_setting(const Filter& row, std::string_view key);

/// Returns the number of taps along one side of a square kernel: the fixed size in the filter's table row, else
/// filter.size. Shaders get this number as the define KERNEL_SIZE.
int taps_across(const Filter& row, const Settings& settings);
/// Returns true when each tap of the kernel blends 2x2 texels.
bool is_bilinear(const Filter& row, const Settings& settings);
/// Returns the chosen kernel's label for display, with its size if the size is a setting: "PCF 5×5".
std::string kernel_label(const Settings& settings);
/// Returns the number of points on a disk that a kernel such as Poisson or PCSS samples, for cost estimates.
/// disk_points() returns the points themselves.
/// @param places the requested number of points; kernels with a fixed table use at most the points in the table
int disk_point_count(const Filter& row, const Settings& settings, int places);
/// Returns the points of the unit disk that a kernel samples, from the Poisson table or along the spiral of golden
/// angles.
/// @param places the requested number of points
std::vector<glm::vec2> disk_points(const Filter& row, const Settings& settings, int places);

/// Memory for the data that is computed from the depths before a kernel runs (moments, mip levels, tables), in bytes.
struct PrefilterBytes {
    double kept = 0;     ///< bytes per texel of the maps, mip levels included
    double scratch = 0;  ///< bytes per texel of one map, while the data is computed
};
/// Returns the memory for the data that the chosen kernel needs besides depths (moments, mip levels, tables), in bytes
/// per texel. It is 0 for kernels that compare depths.
PrefilterBytes prefilter_bytes(const Settings& settings);
/// Returns the memory of a shadow map with all data that is kept for it, in bytes per texel. Depth counts 4 bytes in
/// any format, blurred depth (map.blur_texels) 4 more. Prefiltered moments are included, temporary images are not.
double stored_texel_bytes(const Settings& settings);

/// Returns the number of the depth moment (channel of the kernel's moment map) that the map viewer shows, counted from
/// 1: view.map_channel. Returns 0 when the viewer shows depth: the kernel has no moment of this number, or the image is
/// the camera's depth.
int shown_channel(const Settings& settings);
/// Returns true when the chosen kernel's moments are stored with mip levels: filter.mips is on, and the kernel reads
/// moments, but not from a summed-area table.
bool keeps_mips(const Settings& settings);
/// Returns the mip level at which the map viewer shows a depth moment (view.map_mip). It may exceed the coarsest level
/// of the map. Returns 0 for depth and for moments without mip levels.
int requested_mip(const Settings& settings);

/// Returns the highest exponent (filter.exponent) for which the stored exponentials and their powers neither overflow
/// nor flush to zero in the moment format (filter.moment_format). Infinite if the kernel stores no exponential.
double safe_exponent(const Settings& settings);

/// Returns all rows of the table of shadow filter kernels.
std::span<const Filter> filters();
/// Appends a kernel that is not built in to the table of kernels. Call it before the first use of the settings table.
/// The row's GLSL text comes from gl::add_shader_text().
void add_filter(const Filter& row);
/// Returns the names that sweeps and searches over all kernels try as values of filter.kernel. A kernel with a size
/// appears at a few sizes: "hard", "pcf3", "pcf5", ...
std::span<const std::string_view> sweep_kernels();

/// Returns the kernel row that the setting filter.kernel chooses.
const Filter& filter_of(const Settings& settings);
/// Returns the reach of the chosen kernel in texels. These are its largest distances from the look-up to texels that
/// need bias, that soften an edge, and that are read. For a given light use kernel_reach_in_light().
/// @param widest_texels largest radius of the kernel under the light, texels; infinite if no light is known
Reach reach_of(const Settings& settings, double widest_texels = std::numeric_limits<double>::infinity());

}  // namespace si
