// Rows of the table of filter kernels: help, cost, reach.
#include "renderer/settings/filters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "renderer/base/poisson_disk.h"
#include "renderer/settings/map_storage.h"

namespace si {
namespace {

constexpr std::string_view kPcfSettings[] = {"filter.size", "filter.point"};
constexpr std::string_view kPcfSwept[] = {"pcf2", "pcf3", "pcf3_nearest", "pcf5", "pcf7", "pcf9"};
constexpr std::string_view kSizedSettings[] = {"filter.size"};
constexpr std::string_view kTentSwept[] = {"tent5", "tent7"};
constexpr std::string_view kGaussSwept[] = {"gauss5", "gauss7"};
constexpr std::string_view kBilinearSettings[] = {"filter.bilinear"};
constexpr std::string_view kDiskSettings[] = {"filter.taps",       "filter.radius", "filter.radius_unit",
                                              "filter.max_radius", "filter.rotate", "filter.bilinear"};
constexpr std::string_view kPcssSettings[] = {"filter.taps",         "filter.rotate",     "filter.disk",
                                              "filter.blocker_taps", "filter.max_radius", "filter.bilinear"};
constexpr std::string_view kDpcfSettings[] = {"filter.taps", "filter.rotate", "filter.disk", "filter.max_radius"};
constexpr std::string_view kSmrtSettings[] = {"filter.rays", "filter.steps", "filter.thickness", "filter.rotate",
                                              "filter.max_radius"};
#define SI_PREFILTER \
    "map.samples", "filter.blur", "filter.blur_shape", "filter.mips", "filter.anisotropy", "filter.moment_format"
constexpr std::string_view kVsmSettings[] = {SI_PREFILTER, "filter.bleed", "filter.min_variance"};
constexpr std::string_view kSavsmSettings[] = {"map.samples",      "filter.sums",  "filter.window",
                                               "filter.footprint", "filter.bleed", "filter.min_variance"};
constexpr std::string_view kEsmSettings[] = {SI_PREFILTER, "filter.exponent"};
constexpr std::string_view kEvsm2Settings[] = {SI_PREFILTER, "filter.exponent", "filter.bleed", "filter.min_variance"};
constexpr std::string_view kEvsm4Settings[] = {SI_PREFILTER, "filter.exponent", "filter.negative_exponent",
                                               "filter.bleed", "filter.min_variance"};
constexpr std::string_view kMsmSettings[] = {SI_PREFILTER, "filter.bleed", "filter.moment_bias"};
#undef SI_PREFILTER

constexpr std::string_view kDepthMoments[] = {"z", "z^2"};
constexpr std::string_view kChebyshev = "v / (v + (z - m)^2) where z > m, else 1";
constexpr std::string_view kFourMoments[] = {"z", "z^2", "z^3", "z^4"};
constexpr std::string_view kWarpedMean[] = {"e^(c x)"};
constexpr std::string_view kRisenMoments[] = {"e^(c x)", "e^(2 c x)"};
constexpr std::string_view kTwiceWarpedMoments[] = {"e^(c x)", "e^(2 c x)", "-e^(-d x)", "e^(-2 d x)"};

/// Returns a reach that is equal for bias, edges and reads.
constexpr Reach uniform_reach(double texels) {
    return {texels, texels, texels};
}

/// Returns the largest distance from a comparison's place to the texels that it takes, per axis, in texels.
double tap_reach(const Filter& row, const Settings& s) {
    return is_bilinear(row, s) ? 1 : 0.5;
}

/// Returns the reach of a kernel that samples a disk of filter.radius.
Reach disk_reach(const Filter& row, const Settings& s, double widest_texels) {
    const bool metres = s.filter.radius_unit == RadiusUnit::Metres;
    const double radius = metres ? std::min(widest_texels, s.filter.max_radius) : s.filter.radius;
    return uniform_reach(radius + tap_reach(row, s));
}

/// Returns the reach of a kernel whose radius follows the penumbra.
Reach penumbra_reach(const Filter& row, const Settings& s, double widest_texels) {
    const double radius = std::clamp(widest_texels, 0.5, std::max(s.filter.max_radius, 0.5));
    return uniform_reach(radius + tap_reach(row, s));
}

/// Returns the cost of a kernel with one tap for each point of the disk.
FilterCost disk_cost(const Filter& row, const Settings& s) {
    const int taps = disk_point_count(row, s, s.filter.taps);
    return is_bilinear(row, s) ? FilterCost{taps, taps, 4 * taps} : FilterCost{0, taps, taps};
}

/// Returns the cost of a blocker search and of a disk of comparisons.
FilterCost pcss_cost(const Filter& row, const Settings& s) {
    const int searched = disk_point_count(row, s, s.filter.blocker_taps);
    const FilterCost compared = disk_cost(row, s);
    return {compared.gathers > 0 ? searched + compared.gathers : 0, searched + compared.sampler_taps,
            searched + compared.texels};
}

/// Returns the cost of a kernel whose comparisons each cover two texels along both axes.
FilterCost paired_cost(const Filter& row, const Settings& s) {
    const int per_axis = taps_across(row, s) / 2 + 1, taps = per_axis * per_axis;
    return {taps, taps, 4 * taps};
}

/// Returns the cost of single comparisons, or of paired ones with filter.bilinear.
FilterCost paired_or_single_cost(const Filter& row, const Settings& s) {
    return is_bilinear(row, s) ? paired_cost(row, s) : Filter::square_cost(row, s);
}

/// Returns the reach of kernels that bound visibility by mean and variance. The variance of a sloped plane's own depths
/// keeps the plane lit, so the bias covers only half a texel for the centre of the blend.
Reach bounded_reach(const Filter&, const Settings& s, double) {
    const double reach = s.filter.blur + 1;
    return {0.5, reach, reach};
}

/// Returns the reach of kernels that separate a plane's nearer depths from its farther ones (four moments).
Reach moment_reach(const Filter&, const Settings& s, double) {
    return uniform_reach(s.filter.blur + 1);
}

/// Returns the cost of one bilinear fetch.
FilterCost one_blend(const Filter&, const Settings&) {
    return {0, 1, 4};
}

constexpr Tolerance kVarianceTolerance = {
    .lit = 1e-5,
    .dark = 0.02,
    .why = "the minimum variance leaks this much light behind a caster 7 thousandths of the range away"};
constexpr Tolerance kMsmTolerance = {.lit = 0.01, .dark = 0.03, .why = "the moment bias leaks some light"};

constexpr Filter kFilters[] = {
    {.key = "hard",
     .label = "Hard (nearest)",
     .help = "One comparison with the nearest texel: blocky edges, least cost.",
     .paper = "Williams: Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978",
     .file = "filters/hard.glsl",
     .size = 1},
    {.key = "hw2x2",
     .label = "2×2 bilinear",
     .help = "One bilinear comparison over 2x2 texels, as a shadow sampler with linear filtering gives.",
     .paper = "Reeves, Salesin, Cook: Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987",
     .file = "filters/pcf.glsl",
     .size = 1,
     .bilinear = true},
    {.key = "pcf",
     .label = "PCF",
     .help = "The mean of filter.size^2 comparisons one texel apart, bilinear or of single texels. A wider kernel is "
             "softer and needs more bias. An even size is centred between texels.",
     .paper = "Reeves, Salesin, Cook: Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987",
     .file = "filters/pcf.glsl",
     .size = 0,
     .bilinear = true,
     .settings = kPcfSettings,
     .swept = kPcfSwept},
    {.key = "tent3",
     .label = "Tent 3×3",
     .help = "3x3 nearest comparisons with weights of 1, 2 and 4 sixteenths: softer at its ends than the plain mean. "
             "With filter.bilinear 4 comparisons of 2x2 texels give a tent 4 texels across.",
     .paper = "Jaehne: Digital Image Processing, on binomial filters; bilinear: Castano: Shadow Mapping Summary, 2013",
     .file = "filters/tent3.glsl",
     .size = 3,
     .settings = kBilinearSettings,
     .cost = paired_or_single_cost},
    {.key = "tent",
     .label = "Tent",
     .help = "Weights that fall linearly from the middle to 0, filter.size texels across, by (size / 2 + 1)^2 bilinear "
             "comparisons. Each is placed so that its 2x2 texels get these weights exactly. Smoother than PCF of that "
             "size at about a third of its comparisons.",
     .paper = "Castano: Shadow Mapping Summary, on the shadows of The Witness, 2013",
     .file = "filters/tent.glsl",
     .size = 0,
     .bilinear = true,
     .settings = kSizedSettings,
     .cost = paired_cost,
     .swept = kTentSwept},
    {.key = "castano5",
     .label = "Castaño 5×5",
     .help =
         "Bilinear comparisons with weights of 1, 3, 4, 3 and 1 twelfths along each axis, in nine fetches: the wide "
         "PCF of Babylon.js and PlayCanvas.",
     .paper = "Castano: Shadow Mapping Summary, on the shadows of The Witness, 2013",
     .file = "filters/castano5.glsl",
     .size = 5,
     .bilinear = true,
     .cost = paired_cost},
    {.key = "gauss",
     .label = "Gauss",
     .help = "Gaussian weights that reach 0 at the ends of filter.size texels, by (size / 2 + 1)^2 bilinear "
             "comparisons: rounder than the tent, with no corners in its edges.",
     .paper = "Pettineo: A Sampling of Shadow Techniques, 2013",
     .file = "filters/gauss.glsl",
     .size = 0,
     .bilinear = true,
     .settings = kSizedSettings,
     .cost = paired_cost,
     .swept = kGaussSwept},
    {.key = "poisson",
     .label = "Poisson disk",
     .help = "Comparisons at places spread over a disk, which each pixel rotates by its own angle: noise in place of "
             "steps. Its table has 64 places.",
     .paper = "Uralsky: Efficient Soft-Edged Shadows Using Pixel Shader Branching, GPU Gems 2, 2005",
     .file = "filters/poisson.glsl",
     .uses_disk_table = true,
     .settings = kDiskSettings,
     .reach = disk_reach,
     .cost = disk_cost,
     .noise = {.taps = "filter.taps", .slope = -0.6}},
    {.key = "vogel",
     .label = "Vogel disk",
     .help = "Comparisons along a spiral of golden angles, evenly spread for any number of taps up to 4096. "
             "Each pixel rotates the spiral by interleaved gradient noise.",
     .paper = "Vogel: A Better Way to Construct the Sunflower Head, Mathematical Biosciences 44, 1979; noise: Jimenez: "
              "Next Generation Post Processing in Call of Duty, SIGGRAPH 2014",
     .file = "filters/vogel.glsl",
     .settings = kDiskSettings,
     .reach = disk_reach,
     .cost = disk_cost,
     .noise = {.taps = "filter.taps", .slope = -0.75}},
    {.key = "pcss",
     .label = "PCSS",
     .help = "Percentage-closer soft shadows: searches for casters before the surface, and makes the penumbra as wide "
             "as their distance and light.size require.",
     .paper = "Fernando: Percentage-Closer Soft Shadows, SIGGRAPH 2005",
     .file = "filters/pcss.glsl",
     .searches_blockers = true,
     .reads_light_size = true,
     .uses_disk_table = true,
     .settings = kPcssSettings,
     .reach = penumbra_reach,
     .cost = pcss_cost,
     .noise = {.taps = "filter.taps", .slope = -0.75}},
    {.key = "dpcf",
     .label = "DPCF",
     .help = "Contact-hardening shadows without a search: the same taps give the shadowed share of the widest penumbra "
             "and the distance of the caster. The contrast of that share is raised until the edge has its right width. "
             "Of one straight edge, place and slope in the middle are right. Where two casters overlap, it is wrong.",
     .paper = "Myers: Shadow of Cold War, A Scalable Approach to Shadowing, as cited by Filament for its DPCF",
     .file = "filters/dpcf.glsl",
     .linear = false,
     .searches_blockers = true,
     .reads_light_size = true,
     .uses_disk_table = true,
     .settings = kDpcfSettings,
     .reach = penumbra_reach,
     .cost = disk_cost,
     .noise = {.taps = "filter.taps", .slope = -0.75}},
    {.key = "smrt",
     .label = "Shadow-map rays",
     .help = "Rays from the surface to places of the light, each followed through the map in steps. A surface less "
             "than filter.thickness before the ray blocks it. Penumbrae of overlapping casters are right. Geometry "
             "behind the map's nearest surfaces is assumed.",
     .paper = "Epic Games: Shadow Map Ray Tracing, in Virtual Shadow Maps, Unreal Engine 5, 2021",
     .file = "filters/smrt.glsl",
     .linear = false,
     .reads_light_size = true,
     .settings = kSmrtSettings,
     // A ray rises faster than its plane, so the bias covers only half a texel for the nearest texel's centre.
     .reach =
         [](const Filter& row, const Settings& s, double widest_texels) {
             const double reach = penumbra_reach(row, s, widest_texels).edge;
             return Reach{0.5, reach, reach};
         },
     .cost =
         [](const Filter&, const Settings& s) {
             const int taps = 1 + s.filter.rays * s.filter.steps;
             return FilterCost{0, taps, taps};
         },
     .noise = {.taps = "filter.rays", .slope = -0.65}},
    {.key = "vsm",
     .label = "VSM",
     .help = "Variance shadow map: depth and its square are blurred beforehand. Their means give mean and variance, by "
             "which one look-up bounds the share of depths before the surface. Light bleeds where shadows overlap.",
     .paper = "Donnelly, Lauritzen: Variance Shadow Maps, I3D 2006",
     .file = "filters/vsm.glsl",
     .linear = false,
     .moments = {.names = kDepthMoments, .bound = kChebyshev},
     .settings = kVsmSettings,
     .reach = bounded_reach,
     .cost = one_blend,
     .tolerance = kVarianceTolerance},
    {.key = "savsm",
     .label = "SAVSM",
     .help = "Summed-area variance shadow map: each look-up chooses its window, by sixteen fetches of a summed-area "
             "table at any width. The table costs more time than a blur, and precision.",
     .paper = "Lauritzen: Summed-Area Variance Shadow Maps, GPU Gems 3, chapter 8, 2007",
     .file = "filters/savsm.glsl",
     .linear = false,
     .moments = {.names = kDepthMoments, .summed = true, .bound = kChebyshev},
     .settings = kSavsmSettings,
     .reach =
         [](const Filter&, const Settings& s, double) {
             const double reach = 0.5 * s.filter.window + 0.5;
             return Reach{0.5, reach, reach};
         },
     .cost =
         [](const Filter&, const Settings&) {
             return FilterCost{0, 16, 16};
         },
     .tolerance = kVarianceTolerance},
    {.key = "esm",
     .label = "ESM",
     .help = "Exponential shadow map: one number a texel, the mean of e^(c x) with depth x from -1 to 1, gives the lit "
             "share if lit depths lie far behind all casters. Light leaks near contacts, more so with a lower c.",
     .paper = "Annen, Mertens, Seidel, Flerackers, Kautz: Exponential Shadow Maps, Graphics Interface 2008",
     .file = "filters/esm.glsl",
     .linear = false,
     .moments = {.names = kWarpedMean,
                 .power = 1,
                 .reduces_bleeding = false,
                 .rule = BoundRule::Exponential,
                 .bound = "mean of e^(c x) / e^(c own), 1 at most"},
     .settings = kEsmSettings,
     .reach = bounded_reach,
     .cost = one_blend,
     .tolerance = {.lit = 1e-5, .dark = 0.05, .why = "a caster this near leaks e^(c (x - own))"}},
    {.key = "evsm2",
     .label = "EVSM2",
     .help = "Exponential variance shadow map, one warp: Chebyshev's bound of e^(c x), in which casters near the light "
             "hardly count. Little light bleeds.",
     .paper = "Lauritzen, McCool: Layered Variance Shadow Maps, Graphics Interface 2008",
     .file = "filters/evsm2.glsl",
     .linear = false,
     .moments = {.names = kRisenMoments,
                 .power = 2,
                 .rule = BoundRule::WarpedChebyshev,
                 .bound = "Chebyshev's v / (v + (w - m)^2) of w = e^(c x)"},
     .settings = kEvsm2Settings,
     .reach = bounded_reach,
     .cost = one_blend,
     .tolerance = {.lit = 1e-5, .dark = 0.02, .why = "the minimum variance leaks this much light"}},
    {.key = "evsm4",
     .label = "EVSM4",
     .help = "Exponential variance shadow map, two warps: the lower of the bounds by e^(c x) and by -e^(-d x), each "
             "tight where the other is not. Twice the memory of evsm2.",
     .paper = "Lauritzen, McCool: Layered Variance Shadow Maps, Graphics Interface 2008",
     .file = "filters/evsm4.glsl",
     .linear = false,
     .moments = {.names = kTwiceWarpedMoments,
                 .power = 2,
                 .rule = BoundRule::TwoWarpedChebyshevs,
                 .bound = "the lower of Chebyshev's bounds of e^(c x) and -e^(-d x)"},
     .settings = kEvsm4Settings,
     .reach = bounded_reach,
     .cost = one_blend,
     .tolerance = {.lit = 0.05, .dark = 0.02, .why = "a slope's mean of -e^(-d x) lies before its middle"}},
    {.key = "msm_hamburger",
     .label = "MSM (Hamburger)",
     .help = "Moment shadow map: among all depth distributions with the four stored moments, the one with the least "
             "share before the surface. Sharper than variance. A slope needs bias as wide as the blur.",
     .paper = "Peters, Klein: Moment Shadow Mapping, I3D 2015",
     .file = "filters/msm_hamburger.glsl",
     .linear = false,
     .moments = {.names = kFourMoments,
                 .quantised = true,
                 .rule = BoundRule::FourMoments,
                 .bound = "1 - share before z of the three depths with these moments"},
     .settings = kMsmSettings,
     .reach = moment_reach,
     .cost = one_blend,
     .tolerance = kMsmTolerance},
    {.key = "msm_hausdorff",
     .label = "MSM (Hausdorff)",
     .help = "As msm_hamburger, with depths known to lie between near and far, which reduces bleeding at both ends of "
             "the range.",
     .paper = "Peters, Klein: Moment Shadow Mapping, I3D 2015",
     .file = "filters/msm_hausdorff.glsl",
     .linear = false,
     .moments = {.names = kFourMoments,
                 .quantised = true,
                 .rule = BoundRule::FourMoments,
                 .bound = "1 - share before z of three depths, or four from near to far, with these moments"},
     .settings = kMsmSettings,
     .reach = moment_reach,
     .cost = one_blend,
     .tolerance = kMsmTolerance},
};

std::vector<Filter>& filter_table() {
    static std::vector<Filter> table(std::begin(kFilters), std::end(kFilters));
    return table;
}

bool uses_disk_table(const Filter& row, const Settings& settings) {
    const bool spiral = owns_setting(row, "filter.disk") && settings.filter.disk == Disk::Spiral;
    return row.uses_disk_table && !spiral;
}

}  // namespace

Reach Filter::square_reach(const Filter& row, const Settings& s, double) {
    const int across = taps_across(row, s);
    const bool bilinear = is_bilinear(row, s);
    const double reach = 0.5 * (across + (bilinear ? 1 : 0));
    // Gathers fetch pairs of texels. With an odd number of texels the last pair has one of weight 0.
    return {reach, reach, bilinear && across % 2 == 0 ? reach + 1 : reach};
}

FilterCost Filter::square_cost(const Filter& row, const Settings& settings) {
    const int across = taps_across(row, settings), per_axis = across / 2 + 1, taps = across * across;
    const bool bilinear = is_bilinear(row, settings);
    const int gathers = bilinear ? per_axis * per_axis : 0;
    return {gathers, taps, (bilinear ? 4 : 1) * taps};
}

bool owns_setting(const Filter& row, std::string_view key) {
    return std::ranges::find(row.settings, key) != row.settings.end();
}

int disk_point_count(const Filter& row, const Settings& settings, int places) {
    return uses_disk_table(row, settings) ? std::min(places, kDiskTable) : places;
}

std::vector<glm::vec2> disk_points(const Filter& row, const Settings& settings, int places) {
    return uses_disk_table(row, settings) ? poisson_places(places) : spiral_places(places);
}

int taps_across(const Filter& row, const Settings& settings) {
    return row.size > 0 ? row.size : settings.filter.size;
}

bool is_bilinear(const Filter& row, const Settings& settings) {
    if (owns_setting(row, "filter.bilinear")) return settings.filter.bilinear;
    return row.bilinear && !(owns_setting(row, "filter.point") && settings.filter.point);
}

std::string kernel_label(const Settings& settings) {
    const Filter& row = filter_of(settings);
    const int across = taps_across(row, settings);
    if (owns_setting(row, "filter.bilinear") && is_bilinear(row, settings))
        return std::string(row.label) + ", bilinear";
    if (row.size > 0) return std::string(row.label);
    return fmt::format("{} {}×{}{}", row.label, across, across,
                       row.bilinear && !is_bilinear(row, settings) ? " of points" : "");
}

int default_filter() {
    static const int row = int(std::ranges::find(kFilters, "pcf", &Filter::key) - std::begin(kFilters));
    return row;
}

std::span<const Filter> filters() {
    return filter_table();
}

void add_filter(const Filter& row) {
    filter_table().push_back(row);
}

const Filter& filter_of(const Settings& settings) {
    return filters()[std::size_t(std::clamp(settings.filter.kernel, 0, int(filters().size()) - 1))];
}

Reach reach_of(const Settings& settings, double widest_texels) {
    const Filter& row = filter_of(settings);
    return row.reach(row, settings, widest_texels);
}

PrefilterBytes prefilter_bytes(const Settings& settings) {
    const Filter& row = filter_of(settings);
    if (row.samples() != Samples::Moments) return {};
    const double channels = double(row.moments.names.size());
    const bool wide = row.moments.summed || settings.filter.moment_format == MomentFormat::Bits32;
    const double levels = keeps_mips(settings) ? 4 / 3.0 : 1;
    PrefilterBytes bytes{channels * (wide ? 4 : 2) * levels, 0};
    if (row.moments.summed)
        bytes.scratch = 2 * 4 * channels;
    else if (settings.filter.blur > 0)
        bytes.scratch = 4 * channels;
    if (settings.map.samples > 1 && settings.map.blur_texels == 0)
        bytes.scratch +=
            4 * settings.map.samples + (settings.filter.blur > 0 && !row.moments.summed ? 4 * channels : 0);
    return bytes;
}

double stored_texel_bytes(const Settings& settings) {
    return (settings.map.blur_texels > 0 ? 8.0 : 4.0) + prefilter_bytes(settings).kept;
}

int shown_channel(const Settings& settings) {
    const Filter& row = filter_of(settings);
    if (row.samples() != Samples::Moments || settings.view.map_source == MapSource::Camera) return 0;
    return settings.view.map_channel <= int(row.moments.names.size()) ? settings.view.map_channel : 0;
}

bool keeps_mips(const Settings& settings) {
    const Filter& row = filter_of(settings);
    return row.samples() == Samples::Moments && settings.filter.mips && !row.moments.summed;
}

int requested_mip(const Settings& settings) {
    return shown_channel(settings) > 0 && keeps_mips(settings) ? settings.view.map_mip : 0;
}

double safe_exponent(const Settings& settings) {
    const int power = filter_of(settings).moments.power;
    if (power == 0) return std::numeric_limits<double>::infinity();
    // The smallest 16-bit float is a denormal, which survives. Denormal 32-bit floats are flushed to zero.
    const bool wide = settings.filter.moment_format == MomentFormat::Bits32;
    const double largest = wide ? double(std::numeric_limits<float>::max()) : 65504.0;
    // An average sums weighted texels in 32 bits. The outermost weight of a Gaussian is e^-2 of the middle one.
    const FilterSettings& s = settings.filter;
    const double shares = (2 * s.blur + 1) * (s.blur_shape == BlurShape::Gaussian ? std::exp(2.0) : 1) *
                          std::max(settings.map.samples, 1);
    const double least = wide ? double(std::numeric_limits<float>::min()) * shares : std::exp2(-24);
    return std::floor(100 * std::min(std::log(largest), -std::log(least)) / power) / 100;
}

std::span<const std::string_view> sweep_kernels() {
    static const std::vector<std::string_view> swept = [] {
        std::vector<std::string_view> all;
        for (const Filter& row : filters()) {
            if (row.swept.empty()) all.push_back(row.key);
            all.insert(all.end(), row.swept.begin(), row.swept.end());
        }
        return all;
    }();
    return swept;
}

}  // namespace si
