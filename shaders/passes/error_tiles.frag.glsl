// What is wrong within each tile of TILE x TILE pixels of the truth, counted and summed; the CPU adds the tiles.
#include "lib/truth.glsl"
layout(location = 0) out vec4 wrong_out;     // false shadow, false light, outside of the map, any acne
layout(location = 1) out vec4 inside_out;    // acne, leak, false shadow and false light near edges
layout(location = 2) out vec4 outside_out;   // false shadow, false light; undecided, of them wrong
layout(location = 3) out vec4 sums_out;      // |d|, d^2, d; in shadow both by map and truth
layout(location = 4) out vec4 causes_out;    // in shadow by either; peter-panning, lost caster, other leak

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * TILE, end = min(first + TILE, textureSize(truth_map, 0));
    wrong_out = inside_out = outside_out = sums_out = causes_out = vec4(0.0);
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            vec4 judged = texelFetch(judged_map, ivec2(x * TRUTH_STEP, TRUTH_ROWS - 1 - y * TRUTH_STEP), 0);
            int bits = int(judged.z), artefact = int(judged.x);
            float counts = float(bits / COUNTS & 1), fs = float(bits & FALSE_SHADOW), fl = float(bits / FALSE_LIGHT & 1);
            float outside = float(bits / OUTSIDE & 1), edge = float(bits / NEAR_EDGE & 1);
            float undecided = float(bits / UNDECIDED & 1), inside = 1.0 - outside;
            float interior = inside * (1.0 - edge) * (1.0 - undecided);
            float d = judged.y, v_dark = counts * float(judged.w < 0.5);
            float r_dark = counts * float(true_visibility(texelFetch(truth_map, ivec2(x, y), 0)) < 0.5);
            wrong_out += vec4(fs, fl, outside, bits / ANY_ACNE & 1);
            inside_out += vec4(interior * fs, interior * fl, inside * edge * fs, inside * edge * fl);
            outside_out += vec4(outside * fs, outside * fl, undecided, undecided * (fs + fl));
            sums_out += vec4(abs(d), d * d, d, v_dark * r_dark);
            causes_out += vec4(max(v_dark, r_dark), artefact == ARTEFACT_PETER_PANNING, artefact == ARTEFACT_LOST_CASTER,
                               artefact == ARTEFACT_LEAK);
        }
}
