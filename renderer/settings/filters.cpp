#include "renderer/settings/filters.h"

#include <algorithm>

#include "renderer/settings/choices_of.h"

namespace si {
namespace {

constexpr Filter kFilters[] = {
    {.key = "hard",
     .label = "Hard (nearest)",
     .help = "One comparison with the nearest texel: blocky edges, least cost.",
     .file = "filters/hard.glsl",
     .size = 1,
     .reach_texels = 0.5,
     .gathers = 0,
     .sampler_taps = 1},
    {.key = "hw2x2",
     .label = "2x2 bilinear",
     .help = "One bilinear comparison over 2x2 texels, as a shadow sampler with linear filtering gives.",
     .file = "filters/pcf.glsl",
     .size = 1,
     .bilinear = true,
     .reach_texels = 1,
     .gathers = 1,
     .sampler_taps = 1},
    {.key = "pcf3_nearest",
     .label = "PCF 3x3 by hand",
     .help = "The mean of 3x3 nearest comparisons, as the lectures write it: ten grey levels.",
     .file = "filters/pcf_nearest.glsl",
     .size = 3,
     .reach_texels = 1.5,
     .gathers = 0,
     .sampler_taps = 9},
    {.key = "tent3",
     .label = "Tent 3x3",
     .help = "3x3 nearest comparisons that weigh 1, 2 and 4 sixteenths: softer at its ends than the plain mean.",
     .file = "filters/tent3.glsl",
     .size = 3,
     .reach_texels = 1.5,
     .gathers = 0,
     .sampler_taps = 9},
    {.key = "pcf3",
     .label = "PCF 3x3",
     .help = "The mean of 3x3 bilinear comparisons.",
     .file = "filters/pcf.glsl",
     .size = 3,
     .bilinear = true,
     .reach_texels = 2,
     .gathers = 4,
     .sampler_taps = 9},
    {.key = "pcf5_nearest",
     .label = "PCF 5x5 by hand",
     .help = "The mean of 5x5 nearest comparisons.",
     .file = "filters/pcf_nearest.glsl",
     .size = 5,
     .reach_texels = 2.5,
     .gathers = 0,
     .sampler_taps = 25},
    {.key = "pcf5",
     .label = "PCF 5x5",
     .help = "The mean of 5x5 bilinear comparisons.",
     .file = "filters/pcf.glsl",
     .size = 5,
     .bilinear = true,
     .reach_texels = 3,
     .gathers = 9,
     .sampler_taps = 25},
    {.key = "pcf7",
     .label = "PCF 7x7",
     .help = "The mean of 7x7 bilinear comparisons.",
     .file = "filters/pcf.glsl",
     .size = 7,
     .bilinear = true,
     .reach_texels = 4,
     .gathers = 16,
     .sampler_taps = 49},
    {.key = "pcf9",
     .label = "PCF 9x9",
     .help = "The mean of 9x9 bilinear comparisons: wide, and its bias need is wide too.",
     .file = "filters/pcf.glsl",
     .size = 9,
     .bilinear = true,
     .reach_texels = 5,
     .gathers = 25,
     .sampler_taps = 81},
};

}  // namespace

bool uses_sampler(const Settings& settings) {
    return settings.filter.method == int(FilterMethod::Sampler) && settings.map.format != int(MapFormat::Colour);
}

int default_filter() {
    static const int row = int(std::ranges::find(kFilters, "pcf3", &Filter::key) - std::begin(kFilters));
    return row;
}

std::span<const Filter> filters() {
    return kFilters;
}

std::span<const Choice> filter_choices() {
    static const std::vector<Choice> choices = choices_of(filters());
    return choices;
}

}  // namespace si
