#include "renderer/settings/overlays.h"

#include <vector>

#include "renderer/settings/choices_of.h"

namespace si {
namespace {

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

}  // namespace

std::span<const Overlay> overlays() {
    return kOverlays;
}

std::span<const Choice> overlay_choices() {
    static const std::vector<Choice> choices = [] {
        std::vector<Choice> out = choices_of(overlays());
        out.insert(out.begin(), Choice{"none", "None", "The shaded picture as it is."});
        return out;
    }();
    return choices;
}

}  // namespace si
