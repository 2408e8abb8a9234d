// Rows of the table of overlays.
#include "renderer/settings/overlays.h"

#include <algorithm>
#include <vector>

namespace si {
namespace {

constexpr int ViewSettings::*kOfPanes[] = {&ViewSettings::overlay, &ViewSettings::overlay_2, &ViewSettings::overlay_3,
                                           &ViewSettings::overlay_4};

constexpr Overlay kOverlays[] = {
    {.key = "visibility",
     .label = "Visibility",
     .help = "Result of the kernel: 1 lit, 0 in shadow.",
     .group = OverlayGroup::Wrong,
     .paper = "Williams: Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978",
     .reads_visibility = true,
     .first_pane = 1},
    {.key = "stored-depth",
     .label = "Stored depth",
     .unit = "depth",
     .help = "The depth in the texel that each fragment falls into, as stored.",
     .group = OverlayGroup::Depth,
     .paper = "Williams: Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978"},
    {.key = "own-depth",
     .label = "Own depth",
     .unit = "depth",
     .help = "Each fragment's own depth seen from the light, before any bias.",
     .group = OverlayGroup::Depth},
    {.key = "depth-difference",
     .label = "Depth difference",
     .unit = "m",
     .help = "Own minus stored distance along the light's ray: above zero a caster lies before the fragment, and "
             "around zero there may be acne.",
     .group = OverlayGroup::Depth,
     .min = -0.5,
     .max = 0.5,
     .diverging = true},
    {.key = "bias-applied",
     .label = "Bias applied",
     .unit = "texels",
     .help = "All bias that each fragment receives, in shadow texels at its place.",
     .group = OverlayGroup::Bias,
     .min = 0,
     .max = 5,
     .first_pane = 2},
    {.key = "n-dot-l",
     .label = "N·L",
     .help = "Cosine between the triangle's normal and the direction to the light; near zero the bias need grows "
             "without bound.",
     .group = OverlayGroup::Bias,
     .min = -1,
     .max = 1,
     .diverging = true},
    {.key = "light-uv",
     .label = "Light UV and texels",
     .help = "Map coordinates as red and green, the map's texels as a checkerboard.",
     .group = OverlayGroup::Resolution,
     .scalar = false},
    {.key = "outside-map",
     .label = "Outside the map",
     .help = "Fragments outside the map: beyond its sides (orange), beyond its far plane (blue), behind the light "
             "(magenta).",
     .group = OverlayGroup::Wrong,
     .scalar = false},
    {.key = "page-level",
     .label = "Virtual level",
     .help = "With map.virtual, the clip level that each fragment is looked up in, by colour from the finest on, with "
             "its pages as a checkerboard.",
     .group = OverlayGroup::Resolution,
     .paper = "Sakmary, Ryan, Hall, Lustri: Virtual Shadow Maps, GPU Zen 3, 2024",
     .scalar = false},
    {.key = "page-state",
     .label = "Pages drawn and cached",
     .help = "With map.virtual, the state of the page of each fragment: drawn in the last update (orange), cached "
             "(green), replaced by a coarser one since the pool is full (purple). Nothing where no page is requested.",
     .group = OverlayGroup::Resolution,
     .paper = "Sakmary, Ryan, Hall, Lustri: Virtual Shadow Maps, GPU Zen 3, 2024",
     .scalar = false},
    {.key = "texels-per-pixel",
     .label = "Texels per pixel",
     .unit = "texels",
     .help = "Shadow texels that a pixel spans along its widest direction; below 1 the map's texels show.",
     .group = OverlayGroup::Resolution,
     .paper = "Stamminger, Drettakis: Perspective Shadow Maps, SIGGRAPH 2002",
     .min = 0,
     .max = 4,
     .first_pane = 3},
    {.key = "artefacts",
     .label = "Artefacts",
     .help = "Pixels that are wrong by the ray-traced reference, coloured by cause. More bias cures acne, less bias "
             "cures peter-panning, a finer map cures edge aliasing and undersampling. The legend names all causes.",
     .group = OverlayGroup::Wrong,
     .scalar = false,
     .names_causes = true,
     .reads_reference = true},
    {.key = "truth",
     .label = "Reference",
     .help = "The ray-traced visibility of view.light: 1 lit, 0 in shadow.",
     .group = OverlayGroup::Wrong,
     .reads_reference = true},
    {.key = "truth-difference",
     .label = "Visibility minus reference",
     .help = "The map's visibility minus the ray-traced one: above zero too light, below too dark.",
     .group = OverlayGroup::Wrong,
     .min = -1,
     .max = 1,
     .diverging = true,
     .reads_reference = true},
    {.key = "normals", .label = "Normals", .help = "Shading normals, each axis from -1..1 to 0..1.", .scalar = false},
    {.key = "non-finite",
     .label = "NaN and Inf",
     .help = "Fragments whose shadow test meets a NaN or an infinite value (magenta).",
     .group = OverlayGroup::Wrong,
     .scalar = false},
    {.key = "wireframe",
     .label = "Wireframe",
     .help = "The edges of the triangles that the camera sees.",
     .scalar = false,
     .draw = OverlayDraw::Edges},
    {.key = "overdraw",
     .label = "Overdraw",
     .unit = "fragments",
     .help = "Number of fragments at each pixel, hidden ones included: the cost of shading without a depth test.",
     .min = 0,
     .max = 8,
     .draw = OverlayDraw::Count},
    {.key = "least-bias",
     .label = "Bias needed",
     .unit = "texels",
     .help = "The bias below which each triangle's plane shadows itself, by the kernel's reach, the plane's slope in "
             "the map and the depth format.",
     .group = OverlayGroup::Bias,
     .min = 0,
     .max = 8},
    {.key = "bias-slack",
     .label = "Bias headroom",
     .unit = "texels",
     .help = "Equivalent depth bias of bias and normal offset minus the needed bias. Below zero (blue) there is acne, "
             "and far above it shadows detach needlessly.",
     .group = OverlayGroup::Bias,
     .min = -3,
     .max = 3,
     .diverging = true},
    {.key = "transform-difference",
     .label = "Texture matrix difference",
     .unit = "texels",
     .help = "Difference in texels between the places in the map by map.transform world and eye.",
     .group = OverlayGroup::Resolution,
     .paper = "Everitt, Rege, Cebenoyan: Hardware Shadow Mapping, 2001",
     .min = 0,
     .max = 0.01},
    {.key = "precision-texels",
     .label = "Precision: place in the map",
     .unit = "texels",
     .help = "Distance in the map between the look-up of each surface and its place by double precision. It contains "
             "the rasteriser's own steps, parts of a pixel. It grows far from the world's origin (map.origin).",
     .group = OverlayGroup::Resolution,
     .min = 0,
     .max = 0.1,
     .reads_precision = true},
    {.key = "precision-ulps",
     .label = "Precision: depth",
     .unit = "ULP",
     .help = "Distance of the compared depth, before any bias, from the surface's plane in double precision, in steps "
             "of a 32-bit float at that depth.",
     .group = OverlayGroup::Resolution,
     .min = 0,
     .max = 16,
     .reads_precision = true},
    {.key = "contact-gap",
     .label = "Gap at contact",
     .unit = "m",
     .help = "Largest width of the lit strip that bias and normal offset leave on this surface beside a caster that "
             "touches it: their equivalent depth bias along the light's ray, times the sine of the angle from the "
             "normal. Beside an upright caster a normal offset leaves no strip, but shortens the shadow by as much.",
     .group = OverlayGroup::Depth,
     .min = 0,
     .max = 0.2},
    {.key = "bias-window",
     .label = "Bias window",
     .unit = "texels",
     .help = "Room for bias in shadow, by the ray-traced reference: the distance from the fragment to the caster "
             "nearest the light, minus the needed bias. Below zero no depth bias is right.",
     .group = OverlayGroup::Wrong,
     .min = -5,
     .max = 5,
     .diverging = true,
     .reads_reference = true},
    {.key = "pixels-per-texel",
     .label = "Pixels per texel",
     .unit = "pixels",
     .help =
         "Pixels that a shadow texel spans along its longest direction in the picture; above 1 the map's texels show.",
     .group = OverlayGroup::Resolution,
     .paper = "Stamminger, Drettakis: Perspective Shadow Maps, SIGGRAPH 2002",
     .min = 0,
     .max = 4},
    {.key = "sampling-bands",
     .label = "Undersampling bands",
     .unit = "log2 of texels per pixel",
     .help = "Texels per pixel along the sparsest direction, in whole powers of two: blue is under-sampled (texels "
             "show), orange over-sampled (the map is finer than the picture everywhere).",
     .group = OverlayGroup::Resolution,
     .paper = "Stamminger, Drettakis: Perspective Shadow Maps, SIGGRAPH 2002",
     .min = -4,
     .max = 4,
     .diverging = true},
    {.key = "taps",
     .label = "Texels fetched",
     .unit = "texels",
     .help = "Texels of the map that are fetched for each fragment. There are none where no light arrives or where map "
             "bounds answer, and few where a blocker search finds nothing.",
     .min = 0,
     .max = 64,
     .keeps_optimisations = true},
    {.key = "blocker-gap",
     .label = "Blocker distance",
     .unit = "m",
     .help = "Mean distance of casters before each fragment by the blocker search (PCSS), along the light's axis. "
             "Nothing where it found none, or under other kernels.",
     .group = OverlayGroup::Depth,
     .min = 0,
     .max = 5},
    {.key = "penumbra-width",
     .label = "Penumbra width",
     .unit = "texels",
     .help = "Width of the penumbra that the kernel made (PCSS), from the caster's distance and the light's size.",
     .group = OverlayGroup::Depth,
     .min = 0,
     .max = 32},
    {.key = "depth-variance",
     .label = "Depth variance",
     .unit = "range^2",
     .help = "The variance of depths about each fragment under kernels that read moments (VSM), in squares of the "
             "map's depth range. Below zero it is rounding error.",
     .group = OverlayGroup::Depth,
     .min = -0.001,
     .max = 0.001,
     .diverging = true},
    {.key = "invalid-moments",
     .label = "Invalid moments",
     .help = "Invalid moments, under kernels that read them: a variance or a determinant below zero by rounding (red), "
             "or an exponential that is no number (magenta).",
     .group = OverlayGroup::Wrong,
     .paper = "Peters, Klein: Moment Shadow Mapping, I3D 2015",
     .scalar = false},
    {.key = "cascade",
     .label = "Cascade or face",
     .help = "The light's map in which each fragment is looked up: blue, green, yellow and red from the cascade "
             "nearest to the camera on, then violet, grey, cyan and pink, mixed where two are blended; of a point "
             "light its faces +x -x +y -y +z -z.",
     .group = OverlayGroup::Resolution,
     .scalar = false,
     .names_views = true},
    {.key = "shadow-terminator",
     .label = "Shadow terminator",
     .help = "Fragments whose triangle faces away from the light while their smooth normal faces it (magenta). They "
             "are dark facets on lit bodies, which look like acne. No bias cures them; smaller triangles do.",
     .group = OverlayGroup::Wrong,
     .scalar = false},
    {.key = "faint-light",
     .label = "Faint light",
     .help = "Visibility above 0.02 where the ray-traced reference is 0 and its next edge that the camera sees lies "
             "beyond the kernel's reach. `measure` and the probe trace rays at 8 points around instead (any_leak).",
     .group = OverlayGroup::Wrong,
     .max = 0.5,
     .reads_reference = true},
    {.key = "flip-difference",
     .label = "FLIP",
     .help = "Difference to the picture with the reference's shadows, as a person sees it who alternates between both: "
             "0 none, 1 the largest. At 67 pixels per degree.",
     .group = OverlayGroup::Wrong,
     .paper = "Andersson et al.: FLIP: A Difference Evaluator for Alternating Images, HPG 2020",
     .reads_reference = true,
     .reads_flip = true},
};

}  // namespace

std::string Overlay::file() const {
    std::string name(key);
    std::ranges::replace(name, '-', '_');
    return "overlays/" + name + ".glsl";
}

std::span<const Overlay> overlays() {
    return kOverlays;
}

std::span<const Choice> overlay_choices() {
    static const std::vector<Choice> choices = [] {
        const auto rows = choices_of<overlays>();
        std::vector<Choice> out{{"none", "None", "The shaded picture as it is."}};
        out.insert(out.end(), rows.begin(), rows.end());
        return out;
    }();
    return choices;
}

int& overlay_of_pane(ViewSettings& view, std::size_t pane) {
    return view.*kOfPanes[pane];
}

std::vector<int> pane_overlays(const ViewSettings& view) {
    const std::size_t count = view.panes == Panes::Four ? 4 : view.panes == Panes::Two ? 2 : 1;
    std::vector<int> shown;
    for (std::size_t pane = 0; pane < count; ++pane) shown.push_back(view.*kOfPanes[pane]);
    return shown;
}

bool any_pane_shows(const ViewSettings& view, bool Overlay::*what) {
    return std::ranges::any_of(pane_overlays(view),
                               [&](int n) { return n > 0 && overlays()[std::size_t(n - 1)].*what; });
}

}  // namespace si
