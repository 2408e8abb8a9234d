// Cause of a wrong pixel: the first trial that makes it right. GLSL version of renderer/frame/causes.cpp; tests compare
// both.
#include "lib/evidence.glsl"

/// Cause of a wrong pixel.
struct Cause {
    int artefact;
    int also;   // bits 1 << artefact: further causes to fix, or alternatives
    bool seam;  // OUTSIDE_MAP: the look-up is inside the map, and taps are outside
};

Cause cause(int artefact, int also) { return Cause(artefact, also, false); }

Cause cause_of_false_light(Evidence e, int place) {
    if (place == PLACE_OUTSIDE) return cause(ARTEFACT_OUTSIDE_MAP, 0);
    // If no tap is outside the map, both trials give the same result.
    if (place == PLACE_INSIDE && e.beyond_dark < 0.5 && e.beyond_lit >= 0.5) return Cause(ARTEFACT_OUTSIDE_MAP, 0, true);
    const int bias = 1 << ARTEFACT_PETER_PANNING, offset = 1 << ARTEFACT_PETER_PANNING_OFFSET, leak = 1 << ARTEFACT_LEAK;
    // A surface that is not in the map needs no bias: only a map without any caster over it then lost one.
    if (e.gap_all > 0.0 && e.gap_all >= e.least && (e.least > e.gap_drawn || e.gap_drawn == 0.0))
        return cause(ARTEFACT_LOST_CASTER, e.gap_all < e.applied ? bias : 0);
    // Without the slack self-shadowing would be taken for the caster.
    bool near = e.gap_drawn < e.applied + e.slack, stands = e.far_bare < 0.5 || e.gap_drawn < e.far;
    bool by_bias = e.least_kept < 0.5 && near, by_offset = e.own_bare < 0.5 && stands;
    bool by_both = e.least_bare < 0.5 && (near || stands);
    bool offset_larger = e.strip_offset_m > e.strip_bias_m;
    // A caster missing from the map, nearer to the light, would have allowed more bias.
    int lost = e.gap_all > e.gap_drawn ? 1 << ARTEFACT_LOST_CASTER : 0;
#if RASTER_BIAS
    if (by_bias && e.unfiltered < 0.5)
        return cause(ARTEFACT_PETER_PANNING_RASTER, lost | (e.own > e.least ? bias : 0));
#endif
    if (by_bias && !by_offset) return cause(ARTEFACT_PETER_PANNING, lost);
    if (by_offset && !by_bias) return cause(ARTEFACT_PETER_PANNING_OFFSET, lost);
    if (by_both || by_bias)
        return offset_larger ? cause(ARTEFACT_PETER_PANNING_OFFSET, bias | lost)
                             : cause(ARTEFACT_PETER_PANNING, offset | lost);
#if READS_MOMENTS
    // The unfiltered map has single depths instead of moments, so it tells no cause apart from the kernel.
    if (e.nearest_kept < 0.5)
        return cause(ARTEFACT_LIGHT_BLEEDING, MASK_LEVELS != 0 ? 1 << ARTEFACT_LOST_CASTER : 0);
#endif
#if UNFILTERED_DIFFERS
    if (e.unfiltered < 0.5)
#if RASTER_BIAS
        return cause(ARTEFACT_PETER_PANNING_RASTER, MASK_LEVELS != 0 ? 1 << ARTEFACT_LOST_CASTER : 0);
#elif MASK_LEVELS
        return cause(ARTEFACT_LOST_CASTER, DEPTH_BLUR != 0 ? leak : 0);
#else
        return cause(ARTEFACT_LEAK, 0);
#endif
#endif
    if (e.nearest_kept < 0.5) return cause(ARTEFACT_LEAK, 0);
    if (e.nearest_bare < 0.5)
        return e.nearest_own_bare < 0.5 ? cause(ARTEFACT_PETER_PANNING_OFFSET, leak)
                                        : cause(ARTEFACT_PETER_PANNING, offset | leak);
    if (place != PLACE_INSIDE) return cause(ARTEFACT_OUTSIDE_MAP, 0);
    bool closed = e.gap_all < e.least_nearest;
    return cause(e.run_m < e.texel_m || closed ? ARTEFACT_UNDERSAMPLED : ARTEFACT_EDGE_ALIASING, 0);
}

/// Returns true when more bias makes the pixel at least `enough` lit, without a true shadow edge as the reason.
bool is_acne(Evidence e, float enough) {
    return e.equivalent_bias < e.most && e.most_raised >= enough;
}

Cause cause_of_false_shadow(Evidence e, int place) {
    if (place == PLACE_OUTSIDE) return cause(ARTEFACT_OUTSIDE_MAP, 0);
    if (place == PLACE_INSIDE && e.beyond_lit >= 0.5 && e.beyond_dark < 0.5) return Cause(ARTEFACT_OUTSIDE_MAP, 0, true);
    const int acne = 1 << ARTEFACT_ACNE, filtered = 1 << ARTEFACT_FILTER;
    if (is_acne(e, 0.5)) return cause(ARTEFACT_ACNE, 0);
    if (e.least_bare >= 0.5) return cause(ARTEFACT_OFFSET_SHADOW, e.equivalent_bias < e.least ? acne : 0);
    if (e.unfiltered >= 0.5 || e.nearest_kept >= 0.5) return cause(ARTEFACT_FILTER, 0);
    if (e.nearest_bare >= 0.5) return cause(ARTEFACT_OFFSET_SHADOW, filtered);
    if (place != PLACE_INSIDE) return cause(ARTEFACT_OUTSIDE_MAP, 0);
    return cause(e.run_m < e.texel_m ? ARTEFACT_UNDERSAMPLED : ARTEFACT_EDGE_ALIASING, 0);
}
