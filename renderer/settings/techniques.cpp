#include "renderer/settings/techniques.h"

#include <algorithm>
#include <array>
#include <vector>

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

constexpr Overlay kOverlays[] = {
    {.key = "visibility",
     .label = "Visibility",
     .unit = "",
     .help = "What the kernel found: 1 lit, 0 in shadow.",
     .file = "overlays/visibility.glsl",
     .reads_visibility = true},
    {.key = "stored-depth",
     .label = "Stored depth",
     .unit = "depth",
     .help = "The depth in the texel that each fragment falls into, as stored.",
     .file = "overlays/stored_depth.glsl"},
    {.key = "own-depth",
     .label = "Own depth",
     .unit = "depth",
     .help = "Each fragment's own depth seen from the light, before any bias.",
     .file = "overlays/own_depth.glsl"},
    {.key = "depth-difference",
     .label = "Depth difference",
     .unit = "m",
     .help = "Own minus stored distance along the light's ray: above zero an occluder lies before the fragment, around "
             "zero acne lives.",
     .file = "overlays/depth_difference.glsl",
     .min = -0.5,
     .max = 0.5,
     .diverging = true},
    {.key = "bias-applied",
     .label = "Bias applied",
     .unit = "texels",
     .help = "All bias that each fragment receives, in shadow texels at its place.",
     .file = "overlays/bias_applied.glsl",
     .min = 0,
     .max = 5},
    {.key = "n-dot-l",
     .label = "N.L",
     .unit = "",
     .help = "Cosine between the triangle's normal and the direction to the light; near zero the bias need grows "
             "without bound.",
     .file = "overlays/n_dot_l.glsl",
     .min = -1,
     .max = 1,
     .diverging = true},
    {.key = "light-uv",
     .label = "Light UV and texels",
     .unit = "",
     .help = "Map coordinates as red and green, the map's texels as a checkerboard.",
     .file = "overlays/light_uv.glsl",
     .scalar = false},
    {.key = "outside-map",
     .label = "Outside the map",
     .unit = "",
     .help = "Fragments that the map does not hold: beyond its sides (orange), beyond its far plane (blue), behind the "
             "light (magenta).",
     .file = "overlays/outside_map.glsl",
     .scalar = false},
    {.key = "texels-per-pixel",
     .label = "Texels per pixel",
     .unit = "texels",
     .help = "Shadow texels that a pixel spans along its widest direction; below 1 the map's texels show.",
     .file = "overlays/texels_per_pixel.glsl",
     .min = 0,
     .max = 4},
    {.key = "artefacts",
     .label = "Artefacts",
     .unit = "",
     .help = "Which pixels are wrong by the ray-traced truth, coloured by what puts them right: more bias (acne), less "
             "(peter-panning), no normal offset, what the map lacks (lost caster, outside the map), no filter (leak, "
             "filter), smaller texels (edge aliasing, undersampled), a light with size (penumbra).",
     .file = "overlays/artefacts.glsl",
     .scalar = false,
     .reads_truth = true},
    {.key = "truth",
     .label = "Truth",
     .unit = "",
     .help = "The ray-traced visibility of view.light: 1 lit, 0 in shadow.",
     .file = "overlays/truth.glsl",
     .reads_truth = true},
    {.key = "truth-difference",
     .label = "Visibility minus truth",
     .unit = "",
     .help = "The map's visibility minus the ray-traced one: above zero too light, below too dark.",
     .file = "overlays/truth_difference.glsl",
     .min = -1,
     .max = 1,
     .diverging = true,
     .reads_truth = true},
    {.key = "normals",
     .label = "Normals",
     .unit = "",
     .help = "Shading normals, each axis from -1..1 to 0..1.",
     .file = "overlays/normals.glsl",
     .scalar = false},
    {.key = "non-finite",
     .label = "NaN and Inf",
     .unit = "",
     .help = "Fragments whose shadow test meets a NaN or an infinite value (magenta).",
     .file = "overlays/non_finite.glsl",
     .scalar = false},
    {.key = "wireframe",
     .label = "Wireframe",
     .unit = "",
     .help = "The edges of the triangles that the camera sees.",
     .file = "overlays/wireframe.glsl",
     .scalar = false,
     .draw = OverlayDraw::Edges},
    {.key = "overdraw",
     .label = "Overdraw",
     .unit = "fragments",
     .help = "Fragments that the triangles at each pixel make, hidden ones included: what shading costs before the "
             "depth test helps.",
     .file = "overlays/overdraw.glsl",
     .min = 0,
     .max = 8,
     .draw = OverlayDraw::Count},
    {.key = "least-bias",
     .label = "Least bias needed",
     .unit = "texels",
     .help = "The bias below which each triangle's plane shadows itself, by the kernel's reach, the plane's slope in "
             "the map and the depth format.",
     .file = "overlays/least_bias.glsl",
     .min = 0,
     .max = 8},
    {.key = "bias-slack",
     .label = "Bias slack",
     .unit = "texels",
     .help = "What bias and normal offset are worth beyond the least bias needed: below zero (blue) acne is due, far "
             "above it shadows come off needlessly.",
     .file = "overlays/bias_slack.glsl",
     .min = -3,
     .max = 3,
     .diverging = true},
    {.key = "bias-window",
     .label = "Bias window",
     .unit = "texels",
     .help = "Room for bias in shadow, by the ray-traced truth: how far before the fragment the map stores the surface "
             "nearest the light, less the bias that its plane needs. Below zero no depth bias can be right.",
     .file = "overlays/bias_window.glsl",
     .min = -5,
     .max = 5,
     .diverging = true,
     .reads_truth = true},
    {.key = "pixels-per-texel",
     .label = "Pixels per texel",
     .unit = "pixels",
     .help =
         "Pixels that a shadow texel spans along its longest direction in the picture; above 1 the map's texels show.",
     .file = "overlays/pixels_per_texel.glsl",
     .min = 0,
     .max = 4},
    {.key = "sampling-bands",
     .label = "Sampling bands",
     .unit = "log2 of texels per pixel",
     .help = "Texels per pixel along the sparsest direction, in whole powers of two: blue is under-sampled (texels "
             "show), orange over-sampled (the map is finer than the picture everywhere).",
     .file = "overlays/sampling_bands.glsl",
     .min = -4,
     .max = 4,
     .diverging = true},
};

template <typename Row, std::size_t N>
std::vector<Choice> choices_of(const Row (&rows)[N]) {
    std::vector<Choice> out;
    for (const Row& row : rows) out.push_back({row.key, row.label, row.help});
    return out;
}

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
std::span<const Overlay> overlays() {
    return kOverlays;
}

std::span<const Choice> filter_choices() {
    static const std::vector<Choice> choices = choices_of(kFilters);
    return choices;
}

std::span<const Choice> overlay_choices() {
    static const std::vector<Choice> choices = [] {
        std::vector<Choice> out = choices_of(kOverlays);
        out.insert(out.begin(), Choice{"none", "None", "The shaded picture as it is."});
        return out;
    }();
    return choices;
}

}  // namespace si
