#include "renderer/frame/causes.h"

#include <cmath>

#include "renderer/settings/filters.h"
#include "renderer/settings/map_storage.h"
#include "renderer/view/lights/kernel_reach.h"

namespace si {
namespace {

constexpr std::uint32_t bit(Artefact a) {
    return 1u << int(a);
}

bool dark(float v) {
    return v < 0.5f;
}

Cause false_light(const CauseEvidence& e, const CauseContext& c) {
    if (e.place == CauseEvidence::kOutside) return {Artefact::OutsideMap};
    // Without taps beyond the map's sides both visibilities are equal.
    if (e.place == CauseEvidence::kInside && dark(e.beyond_dark) && !dark(e.beyond_lit))
        return {.artefact = Artefact::OutsideMap, .seam = true};
    // A surface that is not in the map needs no bias: only a map without any caster over it then lost one.
    if (e.gap_all > 0 && e.gap_all >= e.least && (e.least > e.gap_drawn || e.gap_drawn == 0))
        return {Artefact::LostCaster, e.gap_all < e.applied ? bit(Artefact::PeterPanning) : 0};
    // The caster must be nearer than the bias. Otherwise a receiver that shadows itself would count as the caster.
    const bool near = e.gap_drawn < e.applied + e.slack, stands = dark(e.far_bare) || e.gap_drawn < e.far;
    const bool by_bias = dark(e.least_kept) && near, by_offset = dark(e.own_bare) && stands;
    const bool by_both = dark(e.least_bare) && (near || stands);
    // The caster in the reference is nearer to the light and would have tolerated more bias.
    const std::uint32_t lost = e.gap_all > e.gap_drawn ? bit(Artefact::LostCaster) : 0;
    if (by_bias && c.raster_bias && dark(e.unfiltered))
        return {Artefact::PeterPanningRaster, lost | (e.own > e.least ? bit(Artefact::PeterPanning) : 0)};
    if (by_bias && !by_offset) return {Artefact::PeterPanning, lost};
    if (by_offset && !by_bias) return {Artefact::PeterPanningOffset, lost};
    if (by_both || by_bias) {
        if (e.strip_offset_m > e.strip_bias_m)
            return {Artefact::PeterPanningOffset, bit(Artefact::PeterPanning) | lost};
        return {Artefact::PeterPanning, bit(Artefact::PeterPanningOffset) | lost};
    }
    // The unfiltered map has single depths instead of moments, so it tells no cause apart from the kernel.
    if (c.moments && dark(e.nearest_kept))
        return {Artefact::LightBleeding, c.mask_levels ? bit(Artefact::LostCaster) : 0};
    if (c.unfiltered_differs() && dark(e.unfiltered)) {
        if (c.raster_bias) return {Artefact::PeterPanningRaster, c.mask_levels ? bit(Artefact::LostCaster) : 0};
        if (c.mask_levels) return {Artefact::LostCaster, c.depth_blur ? bit(Artefact::Leak) : 0};
        return {Artefact::Leak};
    }
    if (dark(e.nearest_kept)) return {Artefact::Leak};
    if (dark(e.nearest_bare)) {
        if (dark(e.nearest_own_bare)) return {Artefact::PeterPanningOffset, bit(Artefact::Leak)};
        return {Artefact::PeterPanning, bit(Artefact::PeterPanningOffset) | bit(Artefact::Leak)};
    }
    if (e.place != CauseEvidence::kInside) return {Artefact::OutsideMap};
    const bool closed = e.gap_all < e.least_nearest;
    return {e.run_m < e.texel_m || closed ? Artefact::Undersampled : Artefact::EdgeAliasing};
}

bool is_acne(const CauseEvidence& e, const CauseContext& c, float enough) {
    if (e.equivalent_bias < e.least && e.raised >= enough) return true;
    return e.equivalent_bias < e.bent && e.bent_raised >= enough &&
           e.edge_m > (float(c.edge_reach_texels) + 1.f) * e.texel_m;
}

Cause false_shadow(const CauseEvidence& e, const CauseContext& c) {
    if (e.place == CauseEvidence::kOutside) return {Artefact::OutsideMap};
    if (e.place == CauseEvidence::kInside && !dark(e.beyond_lit) && dark(e.beyond_dark))
        return {.artefact = Artefact::OutsideMap, .seam = true};
    if (is_acne(e, c, 0.5f)) return {Artefact::Acne};
    if (!dark(e.least_bare)) return {Artefact::OffsetShadow, e.equivalent_bias < e.least ? bit(Artefact::Acne) : 0};
    if (!dark(e.unfiltered) || !dark(e.nearest_kept)) return {Artefact::Filter};
    if (!dark(e.nearest_bare)) return {Artefact::OffsetShadow, bit(Artefact::Filter)};
    if (e.place != CauseEvidence::kInside) return {Artefact::OutsideMap};
    return {e.run_m < e.texel_m ? Artefact::Undersampled : Artefact::EdgeAliasing};
}

}  // namespace

bool is_wrong(double visibility, const ReferencePixel& reference) {
    return (visibility < 0.5) != (reference.visibility < 0.5) &&
           std::abs(visibility - reference.visibility) > 3 * reference.noise;
}

Cause cause_of(const CauseEvidence& e, const ReferencePixel& reference, const CauseContext& context) {
    const float v = std::isnan(e.visibility) ? 0.f : e.visibility;  // NaN is drawn as no light
    if (is_wrong(v, reference)) {
        if (reference.hard_lit != dark(v)) return {Artefact::Penumbra};
        if (!context.has_map) return {Artefact::NoMap};
        if (!dark(v)) return false_light(e, context);
        if (context.has_contact && !dark(e.map_visibility)) return {Artefact::Contact};
        return false_shadow(e, context);
    }
    if (!context.has_map) return {};
    const bool darkened = reference.visibility == 1 && !dark(v) && v < float(1 - kRightVisibility);
    return {.faint = darkened && e.place == CauseEvidence::kInside && is_acne(e, context, float(1 - kRightVisibility))};
}

CauseContext cause_context(const Settings& settings, const FittedLight& light, int number, MapSize map_size,
                           bool mask_levels) {
    return {.has_map = light.casts,
            .has_contact = light.shadowed && settings.lights[std::size_t(number)].contact > 0,
            .edge_reach_texels = kernel_reach_in_light(settings, light, map_size).edge,
            .raster_bias = offsets_polygons(settings),
            .mask_levels = mask_levels,
            .depth_blur = settings.map.blur_texels > 0,
            .moments = filter_of(settings).samples() == Samples::Moments};
}

}  // namespace si
