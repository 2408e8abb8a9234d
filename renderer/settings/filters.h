// The table of filter kernels: a new one is one row here and one GLSL file.
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

/// How far from the receiver a kernel's parts lie at most, per axis, in texels.
struct Reach {
    double bias = 0.5;  ///< kappa of the bias formula: centres of texels by which the receiver's own plane is compared
    double edge = 0.5;  ///< by how much an edge of the shadow is displaced or widened
    double read = 0.5;  ///< centres of texels that are read
};

/// What of the map a kernel reads.
enum class Samples {
    Depth,    ///< stored depths, which it compares
    Moments,  ///< functions of depths, averaged (lib/moments.glsl): Filter::moments
};

/// What the moments pass keeps for a kernel in place of depths: `vec4 moments_of(float share)` of its file, averaged
/// about each texel.
struct StoredMoments {
    std::span<const std::string_view> names = {};  ///< of its 1, 2 or 4 channels
    int power = 0;                                 ///< highest power of e to the exponents that is stored; 0: none is
    bool quantised = false;        ///< 16 bits are integers of a transform of the moments (shared/moments.h)
    bool summed = false;           ///< as a table of sums (lib/summed_area.glsl)
    bool reduces_bleeding = true;  ///< by filter.bleed
    std::string_view bound = {};   ///< in words: what share can be lit at most, by mean m, variance v and own depth z
};

/// What a kernel does for each light and lit pixel.
struct FilterCost {
    int gathers = 0;       ///< textureGather calls with method gather; 0: one call fetches one texel
    int sampler_taps = 1;  ///< texture calls otherwise
    int texels = 1;        ///< fetched by the sampler; in cost_of() by the method in use
};

/// How far a kernel may be from the truth where no edge is in its reach, and why.
struct Tolerance {
    double lit = 1e-5;   ///< visibility lacking on lit surfaces: weights round to a little less or more than one
    double dark = 1e-5;  ///< visibility left in full shadow
    std::string_view why = "rounding of the weights";
};

/// How the noise of a kernel that samples falls towards its own limit, 4096 places: with the square root of their
/// number where they lie at random, faster the more evenly they are spread.
struct Noise {
    std::string_view taps;  ///< key of the setting that says how many places are sampled; empty: nothing is
    double slope = 0;       ///< of the logarithm of the RMSE over that of their number
    double tolerance = 0.15;
};

/// A shadow filter kernel. Its file defines `float filter_visibility(Receiver r)`.
struct Filter {
    std::string_view key, label, help;
    std::string_view paper;  ///< where it comes from
    std::string_view file;   ///< below shaders/
    int size = 1;            ///< texels or bilinear taps per axis of square kernels; 0: filter.size says it
    bool bilinear = false;   ///< each tap weighs 2x2 texels, but under filter.point where that is its own
    bool square = true;      ///< size x size taps about the look-up, whatever lies there
    bool linear = true;      ///< a weighted sum of comparisons, so that each tap's weight can be told
    Samples samples = Samples::Depth;
    StoredMoments moments = {};
    bool searches_blockers = false;  ///< and where it finds none, says lit and compares nothing
    bool reads_light_size = false;
    bool takes_table = false;  ///< of kDiskTable places, unless filter.disk is its own and says otherwise
    std::span<const std::string_view> settings = {};  ///< keys that only it and other rows that list them read
    /// @param widest_texels radius of the widest area that it spreads over under the light: of the penumbra for rows
    /// that read its size, else of a filter.radius in metres; infinite where no light is known
    Reach (*reach)(const Filter&, const Settings&, double widest_texels) = square_reach;
    FilterCost (*cost)(const Filter&, const Settings&) = square_cost;

    Tolerance tolerance = {};
    Noise noise = {};
    /// What sweeps over all kernels and searches take of it, as --set filter.kernel takes it; empty: the row as it is.
    std::span<const std::string_view> swept = {};

    static Reach square_reach(const Filter& row, const Settings&, double widest_texels);
    static FilterCost square_cost(const Filter& row, const Settings& settings);
};

/// Whether a setting is one of the row's own.
bool owns(const Filter& row, std::string_view key);

/// Taps per axis of a square kernel, the define KERNEL_SIZE.
int taps_across(const Filter& row, const Settings& settings);
/// Whether each tap weighs 2x2 texels.
bool is_bilinear(const Filter& row, const Settings& settings);
/// The kernel's label, with its size where that is a setting: "PCF 5×5".
std::string kernel_label(const Settings& settings);
/// How many of so many places a kernel samples: its table may end before.
int disk_places(const Filter& row, const Settings& settings, int places);
/// Those places, in the unit disk.
std::vector<glm::vec2> disk_of(const Filter& row, const Settings& settings, int places);

/// What a kernel wants prepared besides the depths, in bytes.
struct PrefilterBytes {
    double kept = 0;     ///< for each texel of the maps, mip levels included
    double scratch = 0;  ///< for each texel of one map, while it is made
};
PrefilterBytes prefilter_bytes(const Settings& settings);
/// Of a map's texel, with its blurred depth and what kernels read in its place; taken for 4 bytes in any format.
double kept_texel_bytes(const Settings& settings);

/// Which of its moments the map viewer shows, counted from 1; 0: depth, as view.map_channel asks for none that there
/// is.
int shown_channel(const Settings& settings);
/// Whether mip levels of the moments are made.
bool keeps_mips(const Settings& settings);
/// Which mip level of the shown moment is asked for, past the coarsest too; 0 where there are none.
int asked_mip(const Settings& settings);

/// The highest of the kernel's exponents whose warped depths, and their powers that are stored, are numbers of the
/// format: neither too large nor so small that a 32-bit float is flushed to zero. Infinite where none is stored.
double safe_exponent(const Settings& settings);

std::span<const Filter> filters();
/// Adds a row after the others, for kernels that are not built in; before anything else looks at the settings' table.
/// Its GLSL comes by gl::add_shader_text().
void add_filter(const Filter& row);
std::span<const Choice> filter_choices();
/// Every row at its own short list of sizes, as --set filter.kernel takes them: pcf3, pcf5, ...
std::span<const std::string_view> swept_kernels();

/// The row that the settings choose, and its reach under them. Under a given light: kernel_reach_in_light().
const Filter& filter_of(const Settings& settings);
Reach reach_of(const Settings& settings, double widest_texels = std::numeric_limits<double>::infinity());

}  // namespace si
