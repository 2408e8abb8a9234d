// Counts and sums of wrong pixels in each tile of TILE x TILE reference pixels. The CPU adds the tiles.
#include "lib/truth.glsl"
layout(location = TILE_DARK) out vec4 dark_out[ARTEFACT_LAYERS];      // false shadow: a count for each artefact
layout(location = TILE_BRIGHT) out vec4 bright_out[ARTEFACT_LAYERS];  // false light; for OFFSET_SHADOW, never light: visible acne
layout(location = TILE_NOTED) out vec4 noted_out;  // counts: outside the map, any acne, within noise, in shadow by either
layout(location = TILE_SUMS) out vec4 sums_out;    // sums of |d|, d^2, d; count in shadow by both map and reference

/// Returns the channel that counts an artefact. Two artefacts share a channel if one is always false light and the other
/// false shadow.
int tile_number(int artefact) {
    return artefact == ARTEFACT_NO_MAP ? ARTEFACT_NONE
           : artefact == ARTEFACT_PETER_PANNING_RASTER ? ARTEFACT_ACNE
           : artefact == ARTEFACT_CONTACT        ? ARTEFACT_LEAK
           : artefact == ARTEFACT_LIGHT_BLEEDING ? ARTEFACT_FILTER
                                                 : artefact;
}

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * TILE, end = min(first + TILE, textureSize(reference_map, 0));
    vec4 dark[ARTEFACT_LAYERS], bright[ARTEFACT_LAYERS], noted = vec4(0.0), sums = vec4(0.0);
    for (int i = 0; i < ARTEFACT_LAYERS; ++i) dark[i] = bright[i] = vec4(0.0);
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            vec4 classified = texelFetch(classified_map, ivec2(x * REFERENCE_STEP, REFERENCE_ROWS - 1 - y * REFERENCE_STEP), 0);
            int bits = classified_bits(classified), artefact = classified_artefact(classified);
            float v = classified_visibility(classified), r = true_visibility(texelFetch(reference_map, ivec2(x, y), 0));
            float counts = float(bits / COUNTS & 1), fs = float(bits & FALSE_SHADOW), fl = float(bits / FALSE_LIGHT & 1);
            float d = counts * (v - r), v_dark = counts * float(v < 0.5), r_dark = counts * float(r < 0.5);
            for (int i = 0; i < ARTEFACT_LAYERS; ++i) {
                int number = tile_number(artefact);
                vec4 of = vec4(equal(ivec4(number - 4 * i), ivec4(0, 1, 2, 3)));
                dark[i] += fs * of;
                bright[i] += fl * of;
            }
            float visible_acne = float(bits / ANY_ACNE & 1) * float(v < 1.0 - VISIBLE_ERROR);
            bright[ARTEFACT_OFFSET_SHADOW / 4][ARTEFACT_OFFSET_SHADOW % 4] += visible_acne;
            noted += vec4(bits / OUTSIDE & 1, bits / ANY_ACNE & 1, bits / WITHIN_NOISE & 1, max(v_dark, r_dark));
            sums += vec4(abs(d), d * d, d, v_dark * r_dark);
        }
    for (int i = 0; i < ARTEFACT_LAYERS; ++i) {
        dark_out[i] = dark[i];
        bright_out[i] = bright[i];
    }
    noted_out = noted;
    sums_out = sums;
}
