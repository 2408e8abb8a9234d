// Visible surface of each pixel, stored for lib/seen_surface.glsl.
#include "lib/surface.glsl"
layout(location = 0) out vec4 position_out;
layout(location = 1) out vec4 geometric_out;
#if bias_normal_source != bias_normal_source_geometric
layout(location = 2) out vec4 bias_normal_out;
#endif
#if BIAS_BY_DERIVATIVES
layout(location = 3) out vec4 step_x_out;
layout(location = 4) out vec4 step_y_out;
#endif

void main() {
    discard_masked();
    Surface s = make_surface();
    position_out = vec4(s.position, float(s.receives));
    geometric_out = vec4(s.geometric, float(s.in_map));
#if bias_normal_source != bias_normal_source_geometric
    bias_normal_out = vec4(bias_normal_of(s), 0.0);
#endif
#if BIAS_BY_DERIVATIVES
    step_x_out = vec4(s.step_x, 0.0), step_y_out = vec4(s.step_y, 0.0);
#endif
}
