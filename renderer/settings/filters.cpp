#include "renderer/settings/filters.h"

#include <algorithm>
#include <vector>

#include "renderer/settings/biases.h"
#include "renderer/settings/choices_of.h"

namespace si {
namespace {

constexpr std::string_view kPoissonSettings[] = {"filter.taps", "filter.radius", "filter.rotate"};
constexpr std::string_view kPcssSettings[] = {"filter.taps", "filter.rotate", "filter.blocker_taps",
                                              "filter.max_radius"};
constexpr std::string_view kVsmSettings[] = {"filter.blur", "filter.bleed", "filter.min_variance"};

/// Texels by which the plane is compared are those that are read, and move edges as far.
constexpr Reach everywhere(double texels) {
    return {texels, texels, texels};
}

constexpr Filter kFilters[] = {
    {.key = "hard",
     .label = "Hard (nearest)",
     .help = "One comparison with the nearest texel: blocky edges, least cost.",
     .paper = "Williams: Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978",
     .file = "filters/hard.glsl",
     .size = 1},
    {.key = "hw2x2",
     .label = "2x2 bilinear",
     .help = "One bilinear comparison over 2x2 texels, as a shadow sampler with linear filtering gives.",
     .paper = "Reeves, Salesin, Cook: Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987",
     .file = "filters/pcf.glsl",
     .size = 1,
     .bilinear = true},
    {.key = "pcf3_nearest",
     .label = "PCF 3x3 by hand",
     .help = "The mean of 3x3 nearest comparisons, as the lectures write it: ten grey levels.",
     .paper = "Reeves, Salesin, Cook: Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987",
     .file = "filters/pcf_nearest.glsl",
     .size = 3},
    {.key = "tent3",
     .label = "Tent 3x3",
     .help = "3x3 nearest comparisons that weigh 1, 2 and 4 sixteenths: softer at its ends than the plain mean.",
     .paper = "Jaehne: Digital Image Processing, on binomial filters",
     .file = "filters/tent3.glsl",
     .size = 3},
    {.key = "pcf3",
     .label = "PCF 3x3",
     .help = "The mean of 3x3 bilinear comparisons.",
     .paper = "Reeves, Salesin, Cook: Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987",
     .file = "filters/pcf.glsl",
     .size = 3,
     .bilinear = true},
    {.key = "pcf5_nearest",
     .label = "PCF 5x5 by hand",
     .help = "The mean of 5x5 nearest comparisons.",
     .paper = "Reeves, Salesin, Cook: Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987",
     .file = "filters/pcf_nearest.glsl",
     .size = 5},
    {.key = "pcf5",
     .label = "PCF 5x5",
     .help = "The mean of 5x5 bilinear comparisons.",
     .paper = "Reeves, Salesin, Cook: Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987",
     .file = "filters/pcf.glsl",
     .size = 5,
     .bilinear = true},
    {.key = "pcf7",
     .label = "PCF 7x7",
     .help = "The mean of 7x7 bilinear comparisons.",
     .paper = "Reeves, Salesin, Cook: Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987",
     .file = "filters/pcf.glsl",
     .size = 7,
     .bilinear = true},
    {.key = "pcf9",
     .label = "PCF 9x9",
     .help = "The mean of 9x9 bilinear comparisons: wide, and its bias need is wide too.",
     .paper = "Reeves, Salesin, Cook: Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987",
     .file = "filters/pcf.glsl",
     .size = 9,
     .bilinear = true},
    {.key = "poisson",
     .label = "Poisson disk",
     .help = "Nearest comparisons at places spread over a disk, which each pixel turns by an angle of its own: noise "
             "in place of steps.",
     .paper = "Uralsky: Efficient Soft-Edged Shadows Using Pixel Shader Branching, GPU Gems 2, 2005",
     .file = "filters/poisson.glsl",
     .square = false,
     .settings = kPoissonSettings,
     .reach = [](const Filter&, const Settings& s, double) { return everywhere(s.filter.radius + 0.5); },
     .cost =
         [](const Filter&, const Settings& s) {
             return FilterCost{0, s.filter.taps, s.filter.taps};
         }},
    {.key = "pcss",
     .label = "PCSS",
     .help = "Percentage-closer soft shadows: searches what stands before the surface, and makes the penumbra as wide "
             "as its distance and light.size ask for.",
     .paper = "Fernando: Percentage-Closer Soft Shadows, SIGGRAPH 2005",
     .file = "filters/pcss.glsl",
     .square = false,
     .searches_blockers = true,
     .reads_light_size = true,
     .settings = kPcssSettings,
     .reach =
         [](const Filter&, const Settings& s, double penumbra_texels) {
             return everywhere(std::clamp(penumbra_texels, 0.5, std::max(s.filter.max_radius, 0.5)) + 0.5);
         },
     .cost =
         [](const Filter&, const Settings& s) {
             const int taps = s.filter.blocker_taps + s.filter.taps;
             return FilterCost{0, taps, taps};
         }},
    {.key = "vsm",
     .label = "VSM",
     .help = "Variance shadow map: one look-up of the mean and variance of the depths about each texel, blurred "
             "beforehand, bounds how much of them lies before the surface. Light bleeds where shadows overlap.",
     .paper = "Donnelly, Lauritzen: Variance Shadow Maps, I3D 2006",
     .file = "filters/vsm.glsl",
     .square = false,
     .linear = false,
     .samples = Samples::Moments,
     .settings = kVsmSettings,
     // A plane's own depths vary about their mean, which bounds it as lit, whatever its slope: half a texel for the
     // blend's centre is left.
     .reach =
         [](const Filter&, const Settings& s, double) {
             const double reach = s.filter.blur + 1;
             return Reach{0.5, reach, reach};
         },
     .cost =
         [](const Filter&, const Settings&) {
             return FilterCost{0, 1, 4};
         },
     .tolerance = {.lit = 1e-5,
                   .dark = 0.02,
                   .why = "the least variance lets this much in behind an occluder 7 thousandths of the range away"}},
};

std::vector<Filter>& filter_table() {
    static std::vector<Filter> table(std::begin(kFilters), std::end(kFilters));
    return table;
}

}  // namespace

Reach Filter::square_reach(const Filter& row, const Settings&, double) {
    const double reach = 0.5 * (row.size + (row.bilinear ? 1 : 0));
    return {reach, reach, reach};
}

FilterCost Filter::square_cost(const Filter& row, const Settings& settings) {
    const int per_axis = (row.size + 1) / 2, taps = row.size * row.size;
    const int gathers = row.bilinear ? per_axis * per_axis : 0;
    const bool by_gathers = gathers > 0 && !uses_sampler(settings);
    return {gathers, taps, by_gathers ? 4 * gathers : (row.bilinear ? 4 : 1) * taps};
}

bool compares_per_texel(const Settings& settings) {
    return bias_of(settings).per_texel && filter_of(settings).samples == Samples::Depth;
}

bool uses_sampler(const Settings& settings) {
    if (settings.filter.method != int(FilterMethod::Sampler) || settings.map.format == int(MapFormat::Colour))
        return false;
    return !(compares_per_texel(settings) && filter_of(settings).bilinear);
}

int default_filter() {
    static const int row = int(std::ranges::find(kFilters, "pcf3", &Filter::key) - std::begin(kFilters));
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

Reach reach_of(const Settings& settings, double penumbra_texels) {
    const Filter& row = filter_of(settings);
    return row.reach(row, settings, penumbra_texels);
}

FilterCost cost_of(const Settings& settings) {
    const Filter& row = filter_of(settings);
    return row.cost(row, settings);
}

int prefilter_bytes_per_texel(const Settings& settings) {
    return filter_of(settings).samples == Samples::Moments ? 8 : 0;
}

std::span<const Choice> filter_choices() {
    static const std::vector<Choice> choices = choices_of(filters());
    return choices;
}

}  // namespace si
