#include "shared/units.h"
#include "shared/frame.h"
layout(std140, row_major, binding = BLOCK_FRAME) uniform FrameUniforms { FrameBlock frame; };

// What is known of the lights when the program is made (LIGHT_* are constant arrays), so that loops over them unroll
// and whatever no light of the scene needs costs nothing.
const int LIGHT_DIRECTIONAL = 0, LIGHT_SPOT = 1, LIGHT_POINT = 2;


// What fragments read of the block. Drivers that draw on the CPU read each number of a uniform block anew for every few
// pixels, and four of an image's texel for a third of the time of one.
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

/// Whether rays run from one point: only then does depth crowd along them. A warped view's w changes across its rays.
bool is_perspective(ViewBlock view) {
    mat4 m = view.uvd_from_relative;
    return any(notEqual(vec3(m[0][3], m[1][3], m[2][3]), vec3(0.0))) && all(equal(view.warp, vec4(0.0)));
}
