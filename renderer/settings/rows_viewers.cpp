// Rows of display settings: map viewer, panes with overlays, texel quads.
#include <algorithm>

#include "renderer/settings/filters.h"
#include "renderer/settings/overlays.h"
#include "renderer/settings/paging.h"
#include "renderer/settings/rows.h"

namespace si {
namespace {

using namespace rows;

constexpr Choice kMapSources[] = {
    {"light", "the light's map", "The shadow map of view.light, face or cascade view.face."},
    {"camera", "the camera's depth",
     "The depth buffer of the picture itself. It is stored reversed: 1 at the camera's near plane, 0 at its far plane "
     "and where nothing was drawn."},
};
constexpr Choice kMapViews[] = {
    {"raw", "raw", "The depth as stored, 0 black to 1 white."},
    {"linear", "linear", "Distance along the axis of the light or camera, near black to far white."},
    {"bands", "bands",
     "Depth bands: red below view.band_low, green from there, blue above view.band_high. Most of a "
     "perspective map's depth is spent close to the near plane (the 90/10 rule)."},
};
constexpr Choice kMapColours[] = {
    {"grey", "grey", "From black to white."},
    {"turbo", "Turbo", "A rainbow of even lightness steps: shows small differences (Mikhailov, 2019)."},
    {"viridis", "Viridis", "From dark violet to yellow, ordered by lightness too (van der Walt and Smith, 2015)."},
};
constexpr Choice kMapContrasts[] = {
    {"auto", "fitted in the editor",
     "From the smallest to the largest drawn depth, as with view.map_fit, while view.map_black is 0 and view.map_white "
     "is 1. `render` without --look shows the whole range."},
    {"whole", "whole range", "From view.map_black to view.map_white, unless view.map_fit is on."},
};
constexpr Choice kMapChannels[] = {
    {"depth", "depth", "The depth that the map stores."},
    {"moment-1", "moment 1", "The first number that the kernel reads in place of depths."},
    {"moment-2", "moment 2", "The second one."},
    {"moment-3", "moment 3", "The third one."},
    {"moment-4", "moment 4", "The fourth one."},
};
constexpr Choice kPanes[] = {
    {"one", "one", "The picture with view.overlay over it."},
    {"two", "two", "view.overlay on the left, view.overlay_2 on the right."},
    {"four", "four", "view.overlay and view.overlay_2 above, view.overlay_3 and view.overlay_4 below."},
};
constexpr Choice kRanges[] = {
    {"declared", "its own", "The range that each overlay declares (`list overlays`)."},
    {"fitted", "fitted",
     "From the 1st to the 99th percentile of the values in each pane's picture; symmetric for scales centred on zero."},
    {"manual", "by hand",
     "From view.overlay_min to view.overlay_max wherever view.overlay is shown; other overlays, which have other "
     "units, keep the range they declare."},
};
constexpr Choice kOverlayBlends[] = {
    {"tint", "tint",
     "The overlay's colours, as the legend shows them on lit surfaces, darkened where the picture is dark: shadows and "
     "shapes show through. Causes of wrong pixels lie on a grey picture instead."},
    {"flat", "flat", "The overlay's colours as they are. The numbers behind them are the same."},
};
constexpr Choice kLooks[] = {
    {"plain", "plain", "Light, shadow and sky only, as `render` draws them."},
    {"studio", "studio",
     "An endless ground with a 1 m grid and a horizon under models that lie on an added ground, and contact darkening "
     "in creases, which is not a shadow."},
};
constexpr Choice kSlabs[] = {
    {"none", "none", "No quads."},
    {"stored", "as stored", "Each texel at the depth that it stores (blue)."},
    {"biased", "with bias",
     "Each texel at the depth of a fragment that compares equal (orange): the quad is moved away from the light by "
     "bias.constant. Slope bias and normal offset depend on the surface and are left out."},
    {"both", "both", "As stored (blue) and with bias (orange)."},
};

bool is_bands(const Settings& s) {
    return s.view.map == MapView::Bands;
}
constexpr std::string_view kBandColours = "without effect: the band view has colours of its own";

std::string_view channel_idle(const Settings& s, int) {
    if (s.view.map_source == MapSource::Camera) return "without effect: view.map_source is camera";
    const Filter& row = filter_of(s);
    if (row.samples() != Samples::Moments) return "without effect: filter.kernel stores no moments";
    return s.view.map_channel > int(row.moments.names.size()) ? "without effect: filter.kernel stores fewer moments"
                                                              : "";
}

std::string_view mip_idle(const Settings& s, int i) {
    if (const std::string_view reason = channel_idle(s, i); !reason.empty()) return reason;
    if (s.view.map_channel == 0) return "without effect: view.map_channel is depth, which has no mip levels";
    if (filter_of(s).moments.summed) return "without effect: a table of sums has no mip levels";
    return keeps_mips(s) ? "" : "without effect: filter.mips is off";
}

std::string_view grey_idle(const Settings& s, int) {
    if (is_bands(s)) return kBandColours;
    return s.view.map_fit ? "without effect: view.map_fit is on" : "";
}

std::string_view contrast_idle(const Settings& s, int i) {
    if (const std::string_view reason = grey_idle(s, i); !reason.empty()) return reason;
    const bool whole = s.view.map_black == 0 && s.view.map_white == 1;
    return whole ? "" : "without effect: view.map_black or view.map_white is set";
}

bool no_overlay_shown(const Settings& s) {
    return std::ranges::all_of(pane_overlays(s.view), [](int overlay) { return overlay == 0; });
}
constexpr std::string_view kNoOverlay = "without effect: no overlay is shown";

std::string_view range_idle(const Settings& s, int) {
    if (s.view.overlay == 0) return "without effect: view.overlay is none";
    return s.view.overlay_range != OverlayRange::Manual ? "without effect: set view.overlay_range to manual" : "";
}

const LightSettings& shown_light(const Settings& s) {
    return s.lights[std::size_t(s.view.light_index())];
}

std::string_view face_idle(const Settings& s, int) {
    const LightSettings& shown = shown_light(s);
    // 1.5 rad is half the widest cone that the fits draw into one map.
    const bool faces =
        shown.type == LightType::Point || (shown.type == LightType::Spot && shown.cone > 2 * 1.5 * 57.29577951308232);
    const bool cascades = shown.type == LightType::Directional && shown.cascades > 1 && shown.fit != LightFit::Manual &&
                          shown.projection != LightProjection::Perspective;
    return faces || cascades || has_clip_levels(s, s.view.light_index())
               ? ""
               : "without effect: the light shown has a single map";
}

std::string_view slabs_idle(const Settings& s, int) {
    return s.light_count > 0 && shown_light(s).cast ? "" : "without effect: the light shown has no shadow map";
}
std::string_view slabs_region_idle(const Settings& s, int i) {
    return s.view.slabs == Slabs::None ? "without effect: view.slabs is none" : slabs_idle(s, i);
}

constexpr auto kView = std::to_array<Param>({
    {SI_FIELD(view.map_source), .label = "Map viewer shows", SI_CHOICES(kMapSources),
     .help = "The depth image in the map viewer.", .read_by = ReadBy::MapRange | ReadBy::MapView},
    {SI_FIELD(view.map), .label = "Map view", SI_CHOICES(kMapViews), .help = "The display of depth in the map viewer.",
     .read_by = ReadBy::MapView},
    {SI_FIELD(view.map_channel), .label = "Channel", SI_CHOICES(kMapChannels), .idle = channel_idle,
     .help = "Channel of the light's map that is shown: depth, or one of the moments that filter.kernel reads. With "
             "view.map raw, grey is the number itself, from 0 black to 1 white. Moments of exponential kernels (ESM, "
             "EVSM) reach beyond this range: turn on view.map_fit for them. With view.map linear, grey shows a depth: "
             "the one whose moment equals the stored number.",
     .read_by = ReadBy::MapRange | ReadBy::MapView},
    {SI_FIELD(view.map_mip), .label = "Mip level", .min = 0, .max = 15, .idle = mip_idle,
     .help = "Mip level of the channel that is shown. 0 is the map's own resolution, and each further level has half "
             "as many texels across. A number past the coarsest level means that level. A saved float image holds this "
             "level: with view.map raw the stored numbers of one moment, else depths as shares of the depth range.",
     .read_by = ReadBy::MapRange | ReadBy::MapView},
    {SI_FIELD(view.map_fit), .label = "Fit greys to drawn depths", SI_IDLE(is_bands(s), kBandColours),
     .help = "Black and white lie at the smallest and the largest depth that was drawn, the empty background left out, "
             "instead of at view.map_black and view.map_white.",
     .read_by = ReadBy::MapView},
    {SI_FIELD(view.map_contrast), .label = "Contrast", SI_CHOICES(kMapContrasts), .idle = contrast_idle,
     .help = "The contrast of the map viewer in the editor, and in `render --look`."},
    {SI_FIELD(view.map_black), .label = "Black at", .min = -1, .max = 2, .idle = grey_idle,
     .help = "The value that the map viewer shows black, as a share of its range.", .read_by = ReadBy::MapView},
    {SI_FIELD(view.map_white), .label = "White at", .min = -1, .max = 2, .idle = grey_idle,
     .help = "The value that the map viewer shows white, as a share of its range.", .read_by = ReadBy::MapView},
    {SI_FIELD(view.map_colours), .label = "Map colours", SI_CHOICES(kMapColours), SI_IDLE(is_bands(s), kBandColours),
     .help = "The colour ramp of the map viewer, in place of greys. Empty texels (at the far plane) are hatched dark "
             "under each ramp.",
     .read_by = ReadBy::MapView},
    {SI_FIELD(view.map_region), .label = "Outline of the view frustum",
     .help = "Outline of the camera's view frustum in the map viewer."},
    {SI_FIELD(view.band_low), .label = "Lower band", .unit = "depth", .min = 0, .max = 1,
     SI_IDLE(!is_bands(s), "without effect: view.map is not bands"),
     .help = "Depths below this are red in the band view. Counted from the near plane, under reversed depth too.",
     .read_by = ReadBy::MapView},
    {SI_FIELD(view.band_high), .label = "Upper band", .unit = "depth", .min = 0, .max = 1,
     SI_IDLE(!is_bands(s), "without effect: view.map is not bands"),
     .help = "Depths above this are blue in the band view. Counted from the near plane, under reversed depth too.",
     .read_by = ReadBy::MapView},
    {SI_FIELD(view.light), .label = "Light shown", .min = 0, .max = kMaxLights - 1,
     SI_IDLE(s.light_count < 2 && s.view.light == 0, "without effect: there is one light"),
     .help = "The light whose shadow map, visibility, overlays and quads are shown; 0 is the first.",
     .read_by = ReadBy::OneLight},
    {SI_FIELD(view.face), .label = "Face or cascade shown", .min = 0, .max = kMaxClipLevels - 1, .idle = face_idle,
     .help = "Map of the light that is shown. For a point light, 0 to 5 are the faces +x, -x, +y, -y, +z and -z. For "
             "a directional light, 0 is the cascade nearest to the camera. A number past the last cascade means the "
             "last one."},
    {SI_FIELD(view.panes), .label = "Panes", SI_CHOICES(kPanes),
     .help = "Number of pictures beside each other, all from the same camera, each with an overlay of its own."},
    {SI_FIELD(view.overlay), .label = "Overlay", .cost = Cost::Program, .choices = overlay_choices,
     .help = "A quantity of the shadow test drawn over the scene."},
    {SI_FIELD(view.overlay_2), .label = "Overlay of pane 2", .cost = Cost::Program, .choices = overlay_choices,
     SI_IDLE(s.view.panes < Panes::Two, "without effect: view.panes is one"),
     .help = "The overlay of the second pane; none is the shaded picture."},
    {SI_FIELD(view.overlay_3), .label = "Overlay of pane 3", .cost = Cost::Program, .choices = overlay_choices,
     SI_IDLE(s.view.panes < Panes::Four, "without effect: view.panes is not four"),
     .help = "The overlay of the third pane; none is the shaded picture."},
    {SI_FIELD(view.overlay_4), .label = "Overlay of pane 4", .cost = Cost::Program, .choices = overlay_choices,
     SI_IDLE(s.view.panes < Panes::Four, "without effect: view.panes is not four"),
     .help = "The overlay of the fourth pane; none is the shaded picture."},
    {SI_FIELD(view.overlay_opacity), .label = "Opacity", .min = 0, .max = 1, SI_IDLE(no_overlay_shown(s), kNoOverlay),
     .help = "Opacity of the overlay over the picture: 0 nothing, 1 all.", .read_by = ReadBy::Compose},
    {SI_FIELD(view.overlay_blend), .label = "Blend", SI_CHOICES(kOverlayBlends),
     SI_IDLE(no_overlay_shown(s), kNoOverlay),
     .help = "Blend of overlays with the picture in the editor, and in `render --look`. Other pictures have flat "
             "overlays."},
    {SI_FIELD(view.overlay_range), .label = "Scale", SI_CHOICES(kRanges), SI_IDLE(no_overlay_shown(s), kNoOverlay),
     .help = "The range of the overlay's colour scale.", .read_by = ReadBy::Compose},
    {SI_FIELD(view.overlay_min), .label = "Scale from", .unit = "overlay's", .min = -1e8, .max = 1e8,
     .idle = range_idle, .help = "The value at the low end of the colour scale, in the overlay's unit.",
     .read_by = ReadBy::Compose},
    {SI_FIELD(view.overlay_max), .label = "Scale to", .unit = "overlay's", .min = -1e8, .max = 1e8, .idle = range_idle,
     .help = "The value at the high end of the colour scale, in the overlay's unit.", .read_by = ReadBy::Compose},
    {SI_FIELD(view.frustum), .label = "Light frustum",
     .help = "Draw the lights' frusta and the handles of the shown one in the editor's view.",
     .also = "CameraHelper, light gizmo, shadow frustum"},
    {SI_FIELD(view.bounds), .label = "Caster bounds",
     .help = "Draw the box of each object that casts in the editor's view, as the light fit sees it; at most 2000."},
    {SI_FIELD(view.axes), .label = "Axes",
     .help = "Draw the world's axes in a corner of the editor's view; a click on an end looks along it."},
    {SI_FIELD(view.smooth), .label = "Smooth when static",
     .help = "While nothing moves, the editor shows the mean of up to 8 pictures, each of a camera turned by part of "
             "a pixel. Edges and colours are averaged. The visibility of lights on opaque surfaces comes from a "
             "single picture, as do numbers, overlays and probes. Off: pixels are not averaged.",
     .also = "anti-aliasing, antialiasing, MSAA, TAA, FXAA, supersampling"},
    {SI_FIELD(view.look), .label = "Look", SI_CHOICES(kLooks),
     .help = "Style of the picture in the editor, and in `render --look`. Numbers, masks, comparisons, FLIP, bundles "
             "and all other pictures are drawn plain.",
     .also = "grid, floor, horizon, ambient occlusion, SSAO, AO"},
    {SI_FIELD(view.slabs), .label = "Stored-depth quads", SI_CHOICES(kSlabs), .idle = slabs_idle,
     .help = "Draws texels of the shown light's map into the scene, each as a flat quad at its stored depth. A "
             "surface is in shadow where it lies behind the quad of its texel, so the quads show how acne arises. "
             "Empty texels, at the far plane, are left out.",
     .also = "texel slabs, depth quads", .read_by = ReadBy::Slabs},
    {SI_FIELD(view.slabs_u), .label = "Quads around u", .min = 0, .max = 1, .idle = slabs_region_idle,
     .help = "Centre of the square of texels that are drawn as quads, as a share of the map's width.",
     .read_by = ReadBy::Slabs},
    {SI_FIELD(view.slabs_v), .label = "Quads around v", .min = 0, .max = 1, .idle = slabs_region_idle,
     .help = "Centre of the square of texels that are drawn as quads, as a share of the map's height, upwards.",
     .read_by = ReadBy::Slabs},
    {SI_FIELD(view.slabs_texels), .label = "Quads across", .unit = "texels", .min = 1, .max = 256, .logarithmic = true,
     .idle = slabs_region_idle, .help = "Side of the square of texels that are drawn as quads.",
     .read_by = ReadBy::Slabs},
});
static_assert(kView.size() == member_count<ViewSettings>(), "a member of ViewSettings has no row");

}  // namespace

std::vector<Param> view_rows() {
    return joined(kView);
}

}  // namespace si
