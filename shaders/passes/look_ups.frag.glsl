// Map coordinates and depth of each pixel's surface in the shown light's map, before bias and offset.
#include "lib/surface.glsl"
layout(location = 0) out vec4 look_up_out;  // u, v, depth, 1 + the layer among the light's views; 0: none

void main() {
    discard_masked();
    Receiver r = make_receiver(make_surface(), LIGHT_INDEX);
    look_up_out = r.where >= BEHIND ? vec4(0.0) : vec4(r.uvd, 1.0 + float(r.layer - LIGHT_FIRST_VIEW[LIGHT_INDEX]));
}
