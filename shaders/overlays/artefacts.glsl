// Cause of each wrong pixel, as a colour.
#include "lib/truth.glsl"
const vec3 COLOURS[] = ARTEFACT_COLOURS;
vec4 overlay(Receiver r) {
    int artefact = classified_artefact(classified_here());
    return artefact == ARTEFACT_NONE ? vec4(0.0) : vec4(COLOURS[artefact - 1], 1.0);
}
