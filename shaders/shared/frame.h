// Uniform block of the frame (std140), shared by C++ and GLSL. Positions are relative to the frame's origin.
#ifndef SI_SHARED_FRAME_H
#define SI_SHARED_FRAME_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace si::shared {
using glm::mat4;
using glm::vec4;
#endif

#define SI_MAX_LIGHTS 16
#define SI_MAX_VIEWS 128

/// One light.
struct LightBlock {
    vec4 position;  // xyz; spot and point. w: range in metres where LIGHT_RANGED
    vec4 to_light;  // xyz unit; directional: to the light, spot: against the axis. w: cos of the outer cone, or red
    vec4 radiance;  // rgb; w: cos of the inner cone
    vec4 kernel;    // x: tangent of a directional light's angular radius, else its radius in metres; yzw: how far the
                    // kernel reaches in texels, for the bias, for edges, for reads
};

/// One view (shadow map) of a light.
struct ViewBlock {
    mat4 uvd_from_relative;  // homogeneous map coordinates and depth, all in [0,w]; row-major
    vec4 curve;  // near, far, half of the longer side (orthographic: metres, perspective: tangent), 1 / map resolution
    vec4 warp;   // for LIGHT_WARPED: DepthWarp, middle_m, near_m, far_m and rise
    vec4 span;   // xy: where it ends, where the next is blended in (lib/view_choice.glsl); of one x: curve.w
                 // zw: of rays that are parallel, in a map that is not warped: a texel's size in metres, and
                 // the depth of a metre along the rays. Perspective: shortest side of a texel over its width and height
};

/// Data of one frame: camera, picture, sky, lights and views.
struct FrameBlock {
    mat4 clip_from_relative;
    mat4 eye_from_relative;  // x right, y up, z against the viewing direction
    mat4 relative_from_eye;
    vec4 lens;     // half width and height of the picture: tangents, or metres where eye.w is 1; z, w: see camera_z()
    vec4 eye;      // xyz relative; w: 1 orthographic
    vec4 forward;  // unit viewing direction
    vec4 divided_eye;      // xyz: eye of the camera whose depth is divided among views; usually the frame's
    vec4 divided_forward;  // unit viewing direction of that camera
    vec4 map_origin;       // xyz: origin of positions in shaders that draw the maps
    vec4 pixel;            // xy: pixel of the picture at (0, 0) of the target; z: texels that the kernel fetches; w: 0
    vec4 picture;          // xy: width and height in pixels
    vec4 offset;           // PolygonOffset of the map format: unit_depth, unit_steps, slope_gain; w: 1 slope_is_length
    vec4 ambient;          // rgb: ambient light of a surface across the axis; w: exposure factor
    vec4 ambient_rise;     // xyz: axis of ambient light; length: relative gain of a surface facing along it
    vec4 sky_zenith, sky_horizon, sky_below;  // rgb: sky colours at the zenith, at and below the horizon
    vec4 sky_sun;                             // xyz: unit vector to the sun; w: brightness of its glow
    vec4 ground;                              // xyz relative: centre of the ground under a model; w: 1 / its radius
    LightBlock lights[SI_MAX_LIGHTS];
    ViewBlock views[SI_MAX_VIEWS];
};

// Offsets and sizes of members in vec4, for shaders that read the block as an image.
const int FRAME_EYE_AT = 13, FRAME_PIXEL_AT = 18, FRAME_AMBIENT_AT = 21, FRAME_LIGHTS_AT = 28, FRAME_VIEWS_AT = 92;
const int LIGHT_TEXELS = 4, VIEW_TEXELS = 7;

#ifdef __cplusplus
}  // namespace si::shared
static_assert(offsetof(si::shared::FrameBlock, eye) == 16 * si::shared::FRAME_EYE_AT);
static_assert(offsetof(si::shared::FrameBlock, pixel) == 16 * si::shared::FRAME_PIXEL_AT);
static_assert(offsetof(si::shared::FrameBlock, ambient) == 16 * si::shared::FRAME_AMBIENT_AT);
static_assert(offsetof(si::shared::FrameBlock, lights) == 16 * si::shared::FRAME_LIGHTS_AT);
static_assert(offsetof(si::shared::FrameBlock, views) == 16 * si::shared::FRAME_VIEWS_AT);
static_assert(sizeof(si::shared::LightBlock) == 16 * si::shared::LIGHT_TEXELS);
static_assert(sizeof(si::shared::ViewBlock) == 16 * si::shared::VIEW_TEXELS);
static_assert(sizeof(si::shared::FrameBlock) <= 16384);  // minimum guaranteed by OpenGL
#endif
#endif
