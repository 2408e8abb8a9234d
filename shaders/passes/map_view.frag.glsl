// Depth image of the map viewer: as stored, linear in metres, or in bands.
#include "lib/depth.glsl"
#include "lib/shown_depth.glsl"
#include "shared/colours.h"
#include "lib/map_colours.glsl"
uniform int mode;    // 0 raw, 1 linear, 2 bands
uniform vec4 range;  // black, white, lower and upper band threshold
uniform int bare;    // 1: empty texels have alpha 0, and the viewer hatches them
uniform int colours; // 0 grey, 1 Turbo, 2 Viridis
in vec2 picture_uv;
layout(location = 0) out vec4 colour_out;

void main() {
    float stored = shown_depth(ivec2(picture_uv * vec2(shown_size())));
    if (isnan(stored)) {  // a page that was not requested
        colour_out = vec4(PAGE_NOT_THERE, 1.0);
        return;
    }
    float near = curve.x, far = curve.y;
    bool reversed = curve.w > 0.5;
    float value = stored;
#ifndef FROM_CHANNEL
    if (mode == 1)  // black at the near plane, white at the far plane
        value = (shown_metres(stored, picture_uv.y) - near) / (far - near);
#endif
    if (mode == 2) {
        // Thresholds count in standard depth, 0 near and 1 far.
        if (reversed) stored = 1.0 - stored;
        colour_out = vec4(stored < range.z ? BAND_NEAR * (0.35 + 0.65 * stored / max(range.z, 1e-6))
                          : stored < range.w ? BAND_MIDDLE
                                             : BAND_FAR, 1.0);
        return;
    }
#ifndef FROM_CHANNEL
    if (stored == (reversed ? 0.0 : 1.0)) {  // nothing was drawn here
        float across = fract((gl_FragCoord.x + gl_FragCoord.y) / HATCH_PIXELS);
        colour_out = vec4(across < 0.25 && bare == 0 ? HATCH_LINE : HATCH_BETWEEN, bare != 0 ? 0.0 : 1.0);
        return;
    }
#endif
    colour_out = vec4(map_colour(colours, clamp((value - range.x) / max(range.y - range.x, 1e-9), 0.0, 1.0)), 1.0);
}
