// Classification of wrong pixels by cause. The shadow test of a pixel is repeated with one change at a time; the first
// change that makes the pixel right names the cause. The GPU runs these trials (shaders/lib/evidence.glsl) and
// classifies whole frames (shaders/lib/cause.glsl). This header declares the same decision in C++, for a probed pixel
// and for tests of the GPU.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "renderer/projection/map_size.h"
#include "shaders/shared/classified.h"

namespace si {

struct FittedLight;
struct Settings;

/// Shadow artefact: the cause of one wrong pixel. False shadow is dark in the picture and lit in the reference; false
/// light is the opposite.
enum class Artefact : std::uint8_t {
    None,                ///< right, or not counted
    Acne,                ///< false shadow: the surface shadows itself; more bias makes it right
    PeterPanning,        ///< false light: less depth bias makes it right
    Leak,                ///< false light: right with the nearest texel alone, unfiltered, at its least bias
    EdgeAliasing,        ///< no change of bias, offset or filter makes it right: the map's resolution is the cause
    OutsideMap,          ///< wrong outside the map, or where taps reach beyond its sides
    LostCaster,          ///< false light: culling, the near plane or a mask's mip level removed the caster from the map
    PeterPanningOffset,  ///< false light: right without the normal offset
    OffsetShadow,        ///< false shadow: right without the normal offset
    Filter,              ///< false shadow: right with the nearest texel alone, unfiltered, at its least bias
    Undersampled,        ///< EdgeAliasing where the shadow or the lit gap is narrower than a texel
    Penumbra,            ///< right for a light without size
    // From here on never in Cause::also, whose bits are full.
    NoMap,               ///< wrong, and the light has no shadow map (light.source), so that no trial is possible
    PeterPanningRaster,  ///< false light: right without polygon offset
    Contact,             ///< false shadow: right without contact shadows
    LightBleeding,       ///< Leak under a kernel by moments, whose bound of visibility is too high
};
/// Number of Artefact values.
inline constexpr std::size_t kArtefacts = 16;

/// Results of the trials of one pixel. A trial repeats the pixel's shadow test with one change, such as no normal
/// offset, to find the cause of an error. Members are in the order of shaders/passes/evidence.frag.glsl, four to an
/// image. Depths are in depth-buffer units; visibilities are 1 (lit) to 0. "Bare": without the normal offset.
struct CauseEvidence {
    static constexpr float kInside = shared::PLACE_INSIDE, kOutside = shared::PLACE_OUTSIDE,
                           kLedOutside = shared::PLACE_OFFSET_OUTSIDE;
    float place = kInside;  ///< position relative to the map; kLedOutside: outside only by the normal offset
    float visibility = 1;   ///< drawn visibility
    float beyond_lit = 1, beyond_dark = 1;  ///< visibility with taps beyond the map's sides taken as lit, as dark
    float least = 0, least_nearest = 0;     ///< least depth bias without acne: of the kernel, of one nearest tap
    float equivalent_bias = 0;              ///< all kinds of bias, as a depth bias with equal effect on acne
    float applied = 0;                      ///< shift of the compared depth towards the light
    float slack = 0;                        ///< change of the receiver plane's depth over the kernel's reach
    float own = 0, offset = 0;              ///< constant or slope bias; equivalent depth bias of the normal offset
    float texel_m = 0;                      ///< texel size at the pixel, metres
    float bent = 0, far = 0;  ///< bias of two trials: for surfaces that rise next to the plane, for distant casters
    float strip_bias_m = 0, strip_offset_m = 0;  ///< widths of the lit strips left by bias, by normal offset
    float least_kept = 1, least_bare = 1;        ///< visibility at the least bias, with and without normal offset
    float own_bare = 1, far_bare = 1;            ///< visibility without normal offset, by bias `own` and `far`
    float raised = 1, bent_raised = 1;           ///< visibility with all bias raised to `least`, to `bent`
    float nearest_kept = 1, nearest_bare = 1;  ///< nearest unfiltered texel at its least bias, with and without offset
    float nearest_own_bare = 1;                ///< visibility by the nearest unfiltered texel, bias `own`, no offset
    float unfiltered = 1;                      ///< visibility by the kernel on the unfiltered map
    float curing = 0;                          ///< least equivalent depth bias at which the pixel is lit
    float map_visibility = 1;                  ///< visibility by the map alone, without contact shadows
    float gap_drawn = 0, gap_all = 0;  ///< depth to the surface nearest the light: as drawn, of all casters; 0: none
    float run_m = 0, edge_m = 0;       ///< ShadowRuns, metres
};
/// Number of RGBA32F images that hold the CauseEvidence of all pixels.
inline constexpr int kEvidenceImages = 8;
static_assert(sizeof(CauseEvidence) == kEvidenceImages * 4 * sizeof(float));

/// Renderer settings that decide which causes of a wrong pixel are possible. Shaders that classify pixels get them as
/// defines.
struct CauseContext {
    bool has_map = true;             ///< light.source is a shadow map
    bool has_contact = false;        ///< contact shadows darken the light (light.contact)
    double edge_reach_texels = 0.5;  ///< reach of the filter kernel
    bool raster_bias = false;        ///< polygon offset is on (bias.raster_*)
    bool mask_levels = false;        ///< the map may sample alpha masks at a coarser mip level
    bool depth_blur = false;         ///< map.blur_texels blurs stored depths
    bool moments = false;            ///< the kernel reads moments (Samples::Moments)
    /// Returns true when the unfiltered map may differ from the sampled shadow map. The former is drawn without polygon
    /// offset and depth blur, and with alpha masks at their finest mip level.
    bool unfiltered_differs() const { return raster_bias || mask_levels || depth_blur; }
};

/// Ray-traced reference values of one pixel, for comparison with the drawn picture.
struct ReferencePixel {
    double visibility = 1, noise = 0;  ///< noise: standard error of the visibility
    bool hard_lit = true;              ///< true: a light without size would light the pixel
};

/// Classification of one pixel by the cause of its shadow error: the artefact, and further causes that apply.
struct Cause {
    Artefact artefact = Artefact::None;
    std::uint32_t also = 0;  ///< bits 1 << Artefact: causes that also have to be fixed, or whose fix would do as well
    bool seam = false;       ///< OutsideMap because taps reach beyond the map's sides; the look-up itself is inside
    bool faint = false;      ///< not wrong, but darkened by acne
};

/// Returns true when the drawn visibility of a pixel contradicts its ray-traced reference. The two visibilities then
/// lie on different sides of 0.5 and differ by more than three times the reference's noise.
/// @param visibility drawn visibility: 1 lit, 0 in shadow
bool is_wrong(double visibility, const ReferencePixel& reference);

/// Classifies one pixel with a shadow error by its cause, from the results of its shadow-test trials. Also recognises
/// lit pixels that acne darkens without making them wrong (Cause::faint).
/// @param evidence trials of the pixel
/// @param context settings that decide which causes are possible
Cause cause_of(const CauseEvidence& evidence, const ReferencePixel& reference, const CauseContext& context);

/// Tolerance of visibility: a pixel that is fully lit in the reference counts as darkened below 1 minus this number.
inline constexpr double kRightVisibility = 1e-3;

/// Collects the settings that decide which causes of a light's shadow errors are possible, as input of cause_of().
/// @param number index of the light in the settings light.*
/// @param map_size texels of the light's maps
/// @param mask_levels true: alpha masks of casters have mip levels
CauseContext cause_context(const Settings& settings, const FittedLight& light, int number, MapSize map_size,
                           bool mask_levels);

}  // namespace si
