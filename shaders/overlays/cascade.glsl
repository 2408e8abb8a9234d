// View of the light in which a fragment is looked up, with mixed colours where two views are blended.
#include "shared/colours.h"

vec4 overlay(Receiver r) {
    if (LIGHT_CASTS[r.light] == 0) return vec4(0.0);
    if (LIGHT_VIEWS[r.light] < 2) return vec4(view_colour(0), 1.0);
    int first = LIGHT_FIRST_VIEW[r.light];
    return vec4(mix(view_colour(r.layer - first), view_colour(r.other_layer - first), r.blend), 1.0);
}
