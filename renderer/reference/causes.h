// Why a pixel of a shadow map's picture is wrong: it is tested again with one thing changed, and the first change that
// puts it right names the cause. The GPU makes the trials (shaders/lib/evidence.glsl) and decides for whole frames
// (shaders/lib/cause.glsl); this is the same decision in C++, for a probed pixel and for the tests of the GPU's.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "shaders/shared/classified.h"

namespace si {

enum class Artefact : std::uint8_t {
    None,          ///< right, or not counted
    Acne,          ///< dark though lit: the surface shadows itself, and more bias puts it right
    PeterPanning,  ///< lit though dark: less depth bias puts it right
    Leak,          ///< lit though dark: the nearest texel, unfiltered and at its own least bias, is right
    EdgeAliasing,  ///< no change of bias, offset or filter puts it right: the map's texels decide
    OutsideMap,    ///< wrong where the map holds nothing, or where taps reach beyond its sides
    LostCaster,    ///< lit though dark: culling, the near plane or a mask's mip left out of the map what casts here
    PeterPanningOffset,  ///< lit though dark: without the normal offset it is right
    OffsetShadow,        ///< dark though lit: without the normal offset it is right
    Filter,              ///< dark though lit: the nearest texel, unfiltered and at its own least bias, is right
    Undersampled,        ///< as EdgeAliasing, where the shadow or the light between shadows is narrower than a texel
    Penumbra,            ///< right for a light without size
    // From here on never in Cause::also, for which a judgement has no bits to spare.
    NoMap,               ///< wrong, and the light has no map to try anything on: its source (light.source) says so
    PeterPanningRaster,  ///< lit though dark: without polygon offset it is right
    Contact,             ///< dark though lit: without contact shadows it is right; the GPU alone tells
};
inline constexpr std::size_t kArtefacts = 15;

/// What trials of one pixel gave. Order and meaning as written by shaders/passes/evidence.frag.glsl, four to an image.
struct CauseEvidence {
    static constexpr float kInside = shared::PLACE_INSIDE, kOutside = shared::PLACE_OUTSIDE,
                           kLedOutside = shared::PLACE_LED_OUTSIDE;
    float place = kInside;  ///< whether the map holds the surface; led outside: only the normal offset leaves the map
    float visibility = 1, beyond_lit = 1, beyond_dark = 1;
    float least = 0, least_nearest = 0, worth = 0, applied = 0;  ///< depth-buffer units, as all depths here
    float slack = 0, own = 0, offset = 0, texel_m = 0;
    float bent = 0, far = 0, strip_bias_m = 0, strip_offset_m = 0;
    float least_kept = 1, least_bare = 1, own_bare = 1, far_bare = 1;
    float raised = 1, bent_raised = 1, nearest_kept = 1, nearest_bare = 1;
    float nearest_own_bare = 1, unfiltered = 1, curing = 0, unused = 0;
    float gap_drawn = 0, gap_all = 0, run_m = 0, edge_m = 0;
};
inline constexpr int kEvidenceImages = 8;
static_assert(sizeof(CauseEvidence) == kEvidenceImages * 4 * sizeof(float));

/// What the renderer's settings make possible; the defines of the GPU's decision.
struct CauseContext {
    bool has_map = true;             ///< the light's source is a map
    double edge_reach_texels = 0.5;  ///< of the kernel
    bool raster_bias = false;        ///< bias.raster_*
    bool mask_levels = false;        ///< masks of casters may be read from a coarser mip level in the map
    bool depth_blur = false;         ///< map.blur_texels
    bool unfiltered_differs() const { return raster_bias || mask_levels || depth_blur; }
};

/// What the truth knows of the pixel besides what is in the evidence.
struct TruePixel {
    double visibility = 1, noise = 0;  ///< noise: standard error of the visibility
    bool hard_lit = true;              ///< by the light without its size
};

struct Cause {
    Artefact artefact = Artefact::None;
    std::uint32_t also = 0;  ///< bits 1 << Artefact: what else has to be put right, or would do as well
    bool seam = false;       ///< OutsideMap, as taps reach beyond the map's sides while the look-up lies inside
    bool faint = false;      ///< not wrong, but acne darkens it
};

/// Wrong: visibility and truth lie on different sides of one half, further apart than three times the truth's noise.
bool is_wrong(double visibility, const TruePixel& reference);

/// The cause of a pixel that counts.
Cause cause_of(const CauseEvidence& evidence, const TruePixel& reference, const CauseContext& context);

/// A wholly lit pixel counts as darkened below 1 less this.
inline constexpr double kRightVisibility = 1e-3;

}  // namespace si
