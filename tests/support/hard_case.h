// What the hard cases share: one renderer, shots whose every number is checked to be finite, and ways to compare them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "renderer/render/renderer.h"
#include "tests/support/ray_reference.h"

namespace si::test {

/// The renderer of this process, on a headless context; made on first use.
Renderer& hard_renderer();

/// Everything of a frame that may hold a bad number.
struct Shot {
    FrameResult frame;
    FloatImage visibility;  ///< of view.light; NaN-free (checked)
    ByteImage colour;
    std::vector<FloatImage> maps;  ///< of view.light, one a face; empty when it casts nothing
    int width = 0, height = 0;
    const FittedLight& light(std::size_t i = 0) const { return frame.lights.at(i); }
    const LightView& view(std::size_t i = 0) const { return frame.lights.at(0).views.at(i); }
};

/// Draws and demands what holds for every case (C0): no NaN or infinity in matrices, maps and visibility, visibility
/// and depth within [0,1], no fragment under the NaN overlay, no message of the driver.
Shot shoot(const Scene& scene, const Settings& settings, int width = 160, int height = 120);

/// Pixels whose visibility differs by more than `tolerance`, as a share of those that show geometry in `a`.
double differing_share(const Shot& a, const Shot& b, double tolerance = 0.02);

/// Share of the pixels with visibility below one half.
double shadow_share(const Shot& shot);

/// Errors against the truth, as shares of the pixels that face the light (and lie in its map).
struct ReferenceErrors {
    int domain = 0, shadow = 0, boundary = 0;
    int false_shadow = 0, false_light = 0;  ///< inside, boundary pixels left out
    int any_acne = 0;                       ///< fully lit in truth, visibility below 1 - 1e-3
    int any_leak = 0;                       ///< fully shadowed in truth, visibility above 1e-3
};
ReferenceErrors compare(const Shot& shot, const Scene& scene, double reach_texels);

/// Row of the filter table by key.
int kernel(std::string_view key);

/// A floor of `size` metres at y = 0 with a box of `box` metres that floats `gap` metres above its middle.
Scene floor_and_box(double size = 10, const glm::dvec3& box = {1.5, 1, 2}, double gap = 0);

/// A floor of 10 m with a sheet of 3 m so far above it.
Scene sheet_over_floor(double height_m);

inline constexpr LightType kLightTypes[] = {LightType::Directional, LightType::Spot, LightType::Point};

/// As map.format has it.
std::string format_name(MapFormat format);

/// A directional light of 30 degrees azimuth and 40 degrees elevation, a map of 512, hand-set camera above the floor.
Settings hard_settings();

/// The same with a map over the whole scene and a bias of so many texels and no other.
Settings texel_settings(std::string_view filter, int resolution, double constant_texels);

/// A wall 2 m high on a plane of 20 m, and the settings of texel_settings() under a sun 15 degrees high behind it.
Scene wall_on_plane();
Settings low_sun_settings(std::string_view filter, int resolution, double constant_texels);

/// Moves all of a scene, its cameras too, and what a hand-set camera looks at.
void move_scene(Scene& scene, const glm::dvec3& by);
void move_camera(Settings& settings, const glm::dvec3& by);

/// Where a scene stands and where its light comes from: at home, far away under a light at an exact right angle, and
/// beside the origin under one straight above. Tests take them by turns.
struct Place {
    glm::dvec3 at{0};
    double azimuth = 30, elevation = 60;
};
inline constexpr Place kPlaces[] = {{}, {{4e3, -120, 9e3}, 90, 60}, {{-70, 5, 8}, 180, 90}};

/// A floor of 10 m there, and a sheet of 4 m 2.25 m above its middle. No box: its walls would lie along the rays of a
/// light at a right angle, where a driver may draw a sliver of no width with any depth.
Scene floor_under_a_sheet(const Place& place);

/// No bias of any kind, in units of depth.
BiasSettings no_bias();

}  // namespace si::test
