// Frame block, lights and views.
#include "shared/units.h"
#include "shared/frame.h"
layout(std140, row_major, binding = BLOCK_FRAME) uniform FrameUniforms { FrameBlock frame; };

// LIGHT_* are constant arrays of facts about the lights. Loops over them unroll, and code that no light needs is removed.
const int LIGHT_DIRECTIONAL = 0, LIGHT_SPOT = 1, LIGHT_POINT = 2;

// Access of fragments to the frame block. Drivers on the CPU read each uniform again for every few pixels. The four numbers
// of an image's texel take a third of the time of one uniform.
#if BLOCKS_AS_IMAGES
layout(rgba32ui, binding = IMAGE_FRAME_BLOCK) restrict readonly uniform uimageBuffer frame_texels;
vec4 frame_texel(int at) { return uintBitsToFloat(imageLoad(frame_texels, at)); }

LightBlock light_of(int index) {
    int at = FRAME_LIGHTS_AT + index * LIGHT_TEXELS;
    return LightBlock(frame_texel(at), frame_texel(at + 1), frame_texel(at + 2), frame_texel(at + 3));
}

ViewBlock view_of(int layer) {
    int at = FRAME_VIEWS_AT + layer * VIEW_TEXELS;
    return ViewBlock(transpose(mat4(frame_texel(at), frame_texel(at + 1), frame_texel(at + 2), frame_texel(at + 3))),
                     frame_texel(at + 4), frame_texel(at + 5), frame_texel(at + 6));
}

vec4 frame_eye() { return frame_texel(FRAME_EYE_AT); }
vec4 frame_pixel() { return frame_texel(FRAME_PIXEL_AT); }
vec4 frame_ambient() { return frame_texel(FRAME_AMBIENT_AT); }
vec4 frame_ambient_rise() { return frame_texel(FRAME_AMBIENT_AT + 1); }
vec4 frame_sky_zenith() { return frame_texel(FRAME_AMBIENT_AT + 2); }
vec4 frame_sky_horizon() { return frame_texel(FRAME_AMBIENT_AT + 3); }
vec4 frame_sky_below() { return frame_texel(FRAME_AMBIENT_AT + 4); }
vec4 frame_sky_sun() { return frame_texel(FRAME_AMBIENT_AT + 5); }
vec4 frame_ground() { return frame_texel(FRAME_AMBIENT_AT + 6); }
#else
LightBlock light_of(int index) { return frame.lights[index]; }
ViewBlock view_of(int layer) { return frame.views[layer]; }
vec4 frame_eye() { return frame.eye; }
vec4 frame_pixel() { return frame.pixel; }
vec4 frame_ambient() { return frame.ambient; }
vec4 frame_ambient_rise() { return frame.ambient_rise; }
vec4 frame_sky_zenith() { return frame.sky_zenith; }
vec4 frame_sky_horizon() { return frame.sky_horizon; }
vec4 frame_sky_below() { return frame.sky_below; }
vec4 frame_sky_sun() { return frame.sky_sun; }
vec4 frame_ground() { return frame.ground; }
#endif

/// Returns true when the view's rays come from one point, so that depth is not linear along them. The w of a warped view
/// changes across its parallel rays and does not count.
bool is_perspective(ViewBlock view) {
    mat4 m = view.uvd_from_relative;
    return any(notEqual(vec3(m[0][3], m[1][3], m[2][3]), vec3(0.0))) && all(equal(view.warp, vec4(0.0)));
}

/// Returns the change of a plane's depth over a texel along both axes of the map, times `factor`.
/// @param gradient of the depth, by map coordinates
float rise_per_texel(vec2 gradient, float factor) {
    vec2 rise = abs(gradient) / MAP_SHAPE;
    return factor * (rise.x + rise.y) / float(map_resolution);
}
