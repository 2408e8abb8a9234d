// What is wrong within each tile of TILE x TILE pixels of the truth, counted and summed; the CPU adds the tiles.
#include "lib/truth.glsl"
layout(location = 0) out vec4 wrong_out;      // false shadow, false light, outside of the map, any acne
layout(location = 1) out vec4 shadow_out;     // within noise; of false shadow: acne, offset, filter
layout(location = 2) out vec4 light_out;      // of false light: peter-panning by bias, by offset, lost caster, leak
layout(location = 3) out vec4 sampling_out;   // false shadow, false light: edge aliasing; undersampled
layout(location = 4) out vec4 elsewhere_out;  // false shadow, false light: penumbra; outside of the map
layout(location = 5) out vec4 sums_out;       // |d|, d^2, d; in shadow both by map and truth
layout(location = 6) out vec4 either_out;     // in shadow by either; false shadow, false light: no map

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * TILE, end = min(first + TILE, textureSize(truth_map, 0));
    wrong_out = shadow_out = light_out = sampling_out = elsewhere_out = sums_out = either_out = vec4(0.0);
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            vec4 judged = texelFetch(judged_map, ivec2(x * TRUTH_STEP, TRUTH_ROWS - 1 - y * TRUTH_STEP), 0);
            int bits = judged_bits(judged), artefact = judged_artefact(judged);
            float v = judged_visibility(judged), r = true_visibility(texelFetch(truth_map, ivec2(x, y), 0));
            float counts = float(bits / COUNTS & 1), fs = float(bits & FALSE_SHADOW), fl = float(bits / FALSE_LIGHT & 1);
            float d = counts * (v - r), v_dark = counts * float(v < 0.5), r_dark = counts * float(r < 0.5);
            wrong_out += vec4(fs, fl, bits / OUTSIDE & 1, bits / ANY_ACNE & 1);
            shadow_out += vec4(bits / WITHIN_NOISE & 1, artefact == ARTEFACT_ACNE, artefact == ARTEFACT_OFFSET_SHADOW,
                               artefact == ARTEFACT_FILTER);
            light_out += vec4(artefact == ARTEFACT_PETER_PANNING, artefact == ARTEFACT_PETER_PANNING_OFFSET,
                              artefact == ARTEFACT_LOST_CASTER, artefact == ARTEFACT_LEAK);
            sampling_out += vec4(fs, fl, 0.0, 0.0) * float(artefact == ARTEFACT_EDGE_ALIASING) +
                            vec4(0.0, 0.0, fs, fl) * float(artefact == ARTEFACT_UNDERSAMPLED);
            elsewhere_out += vec4(fs, fl, 0.0, 0.0) * float(artefact == ARTEFACT_PENUMBRA) +
                             vec4(0.0, 0.0, fs, fl) * float(artefact == ARTEFACT_OUTSIDE_MAP);
            sums_out += vec4(abs(d), d * d, d, v_dark * r_dark);
            either_out += vec4(max(v_dark, r_dark), vec2(fs, fl) * float(artefact == ARTEFACT_NO_MAP), 0.0);
        }
}
