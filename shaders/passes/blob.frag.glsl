// Visibility of the visible surface under one caster's blob.
#include "lib/seen_surface.glsl"
#include "lib/blob.glsl"

flat in vec4 disc;
uniform vec4 blob;  // softness, opacity, reach (radii, 0: endless)

layout(location = 0) out float lit_out;

const float BEGINS_RADII = 0.25;  // start below the caster's middle, so that the caster's lit side stays lit

void main() {
    Surface s = seen_surface();
    if (!s.receives) discard;
    vec3 below_middle = s.position - disc.xyz;
    Sweep sweep = sweep_of(disc.xyz);
    float along = dot(below_middle, sweep.axis);
    float off_axis = length(below_middle - sweep.axis * along) / (disc.w * spread_at(sweep, along));  // in radii there
    float radii = along / disc.w;
    float below = clamp(radii / BEGINS_RADII, 0.0, 1.0) * (blob.z > 0.0 ? clamp(1.0 - radii / blob.z, 0.0, 1.0) : 1.0);
    float inside = 1.0 - clamp((off_axis - (1.0 - blob.x)) / max(blob.x, 1e-4), 0.0, 1.0);
    lit_out = 1.0 - blob.y * below * inside;
}
