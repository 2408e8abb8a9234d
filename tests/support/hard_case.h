// Draws and compares pictures for the tests of the hard cases, on one shared renderer.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "renderer/bias/account.h"
#include "renderer/render/renderer.h"
#include "tests/support/ray_reference.h"

namespace si::test {

/// Returns the renderer that all hard cases of the process share. The first call creates the renderer and its headless
/// context.
Renderer& hard_renderer();

/// Read-back results of one drawn frame: visibility and shadow maps of view.light.
struct Shot {
    FrameResult frame;
    FloatImage visibility;         ///< visibility of view.light, 0 to 1, without NaN (checked)
    std::vector<FloatImage> maps;  ///< depths of view.light, one map per face; empty for lights without shadow
    int width = 0;                 ///< pixels
    int height = 0;                ///< pixels
    /// Returns a light as fitted for the frame. @throws std::out_of_range
    const FittedLight& light(std::size_t i = 0) const { return frame.lights.at(i); }
    /// Returns a view (face or cascade) of the first light. @throws std::out_of_range
    const LightView& view(std::size_t i = 0) const { return frame.lights.at(0).views.at(i); }
};

/// Draws a scene and fails the test where a result is not sound. Checked are: finite matrices, maps and visibility;
/// visibility and depth within [0,1]; an empty NaN overlay; no message of the driver.
/// @param width, height pixels
Shot draw_shot(const Scene& scene, const Settings& settings, int width = 160, int height = 120);

/// Returns the rays of all pixels of a drawn frame.
inline std::vector<PixelRay> pixel_rays(const Shot& shot) {
    return pixel_rays(shot.frame.camera, shot.width, shot.height);
}

/// Returns the pixels of a drawn frame whose rays meet the scene, with their first hits.
inline std::vector<PixelHit> pixel_hits(const RayReference& scene, const Shot& shot) {
    return pixel_hits(scene, shot.frame.camera, shot.width, shot.height);
}

/// Traces the reference of a drawn frame's first light for every pixel.
/// @param reach_texels distance of Boundary pixels from a shadow edge, map texels
inline ReferenceImage trace_reference(const RayReference& scene, const Shot& shot, double reach_texels) {
    return trace_reference(scene, shot.frame.camera, shot.light(), shot.width, shot.height, shot.frame.map_resolution,
                           reach_texels);
}

/// Returns the bias of a drawn frame's first light at a point of a surface.
/// @param driver traits of the driver that drew the frame
/// @param normal unit normal of the surface, world
BiasBreakdown breakdown_at(const FrameResult& frame, const Settings& settings, const RasterTraits& driver,
                           const glm::dvec3& point_ws, const glm::dvec3& normal = {0, 1, 0});

/// Returns the share of pixels whose visibility differs by more than `tolerance`, among the pixels with geometry in
/// `a`.
double differing_share(const Shot& a, const Shot& b, double tolerance = 0.02);

/// Returns the share of pixels with visibility below one half.
double shadow_share(const Shot& shot);

/// Pixel counts of a comparison with the ray-traced reference, over pixels whose surface faces the light.
struct ReferenceErrors {
    int domain = 0;        ///< compared pixels
    int shadow = 0;        ///< pixels in shadow in the reference
    int boundary = 0;      ///< pixels near a shadow edge of the reference
    int false_shadow = 0;  ///< drawn-dark pixels, lit in the reference, away from edges
    int false_light = 0;   ///< drawn-lit pixels, in shadow in the reference, away from edges
    int any_acne = 0;      ///< pixels fully lit in the reference, with visibility below 1 - 1e-3
    int any_leak = 0;      ///< pixels fully in shadow in the reference, with visibility above 1e-3
};
/// Compares a drawn frame's visibility with reference rays of its first light.
/// @param reach_texels distance from a shadow edge within which a pixel counts as boundary, map texels
ReferenceErrors compare_with_reference(const Shot& shot, const Scene& scene, double reach_texels);

/// Returns the index of a filter kernel in filters(). Fails the test if there is no such key.
int kernel_row(std::string_view key);

/// Makes a scene of a square floor at y = 0 with a box above its middle.
/// @param size side of the floor, metres
/// @param box sides of the box, metres
/// @param gap height of the box's bottom above the floor, metres
Scene floor_and_box(double size = 10, const glm::dvec3& box = {1.5, 1, 2}, double gap = 0);

/// Makes a scene of a floor of 10 x 10 m with a parallel sheet of 3 x 3 m above its middle.
Scene sheet_over_floor(double height_m);

/// All types of light, for loops over them.
inline constexpr LightType kLightTypes[] = {LightType::Directional, LightType::Spot, LightType::Point};

/// Returns the name of a type of light as in the setting light.type: "spot".
std::string light_name(LightType type);

/// Returns a name for parameterised tests: a key with '_' in place of '-'.
std::string identifier(std::string_view key);

/// Returns the name of a map format as in the setting map.format: "d16".
std::string format_name(MapFormat format);

/// Returns settings with a directional light (azimuth 30, elevation 40 degrees), a map of 512 x 512 texels and a manual
/// camera above the floor.
Settings hard_settings();

/// Returns hard_settings() with a map over the whole scene and a constant bias in texels as the only bias.
/// @param filter key of the filter kernel
/// @param resolution texels per side of the map
/// @param constant_texels constant bias, texel sizes
Settings texel_settings(std::string_view filter, int resolution, double constant_texels);

/// Makes a scene of a wall 2 m high on a plane of 20 x 20 m.
Scene wall_on_plane();

/// Returns texel_settings() with a sun 15 degrees high behind the wall of wall_on_plane().
Settings low_sun_settings(std::string_view filter, int resolution, double constant_texels);

/// Moves all root nodes and cameras of a scene by a distance in world metres.
void move_scene(Scene& scene, const glm::dvec3& by);

/// Moves the target of a manual camera by a distance in world metres.
void move_camera(Settings& settings, const glm::dvec3& by);

/// Position of a scene and direction of its light.
struct Place {
    glm::dvec3 at{0};       ///< offset of the scene, world metres
    double azimuth = 30;    ///< azimuth of the light, degrees
    double elevation = 60;  ///< elevation of the light, degrees
};
/// Turns the first light as a place requires and moves the camera to the place. Lights with a position stand 9 m away,
/// with a cone of 80 degrees.
void place_light(Settings& settings, LightType type, const Place& place);
/// Places that tests of biases and kernels alternate between: the origin, a distant place with a light at an exact
/// right angle, and a place near the origin with a light straight above.
inline constexpr Place kPlaces[] = {{}, {{4e3, -120, 9e3}, 90, 60}, {{-70, 5, 8}, 180, 90}};

/// Makes a scene of a floor of 10 x 10 m at a place, with a sheet of 4 x 4 m at 2.25 m above its middle. A box would
/// have walls along the rays of lights at right angles, where drivers may draw slivers of any depth.
Scene floor_under_sheet(const Place& place);

/// Returns settings of the slope bias with all amounts 0, in units of depth.
BiasSettings no_bias();

}  // namespace si::test
