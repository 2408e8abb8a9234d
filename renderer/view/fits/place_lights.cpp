// Placement of the lights of the settings in a scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/base/angles.h"
#include "renderer/base/directions.h"
#include "renderer/base/finite.h"
#include "renderer/scene/placement.h"
#include "renderer/view/fits/fit_context.h"
#include "renderer/view/fits/light_fit.h"

namespace si {
namespace {

double size_of(const LightSettings& s) {
    const double size = positive_or(s.size, 0);
    return s.type == LightType::Directional ? std::tan(std::min(size, 89.0) * kDegree) : size;
}

double range_of(const LightSettings& s) {
    return s.type == LightType::Directional ? 0 : positive_or(s.range, 0);
}

/// Returns half the cone's angle in radians, clamped.
double half_cone(PlacedLight& light, const LightSettings& s) {
    double half = 0.5 * s.cone * kDegree;
    if (std::isnan(half) || half < kMinHalfAngle) {
        add_note(light, fmt::format("light.cone {:.4g} degrees is too narrow: {:.3g} is used", s.cone,
                                    2 * kMinHalfAngle / kDegree));
        half = kMinHalfAngle;
    }
    return std::min(half, std::numbers::pi);
}

void place_spot(PlacedLight& light, const LightSettings& s) {
    light.half_cone_rad = half_cone(light, s);
    const double blend = std::clamp(finite_or(s.cone_blend, 0), 0.0, 1.0);
    light.cos_cone_outer = std::cos(light.half_cone_rad);
    light.cos_cone_inner = std::cos(light.half_cone_rad * (1 - blend));
    light.six_faces = light.half_cone_rad > kMaxHalfAngle;
    if (light.six_faces) add_note(light, "the cone is wider than one map can hold: it is drawn as six faces");
}

/// Returns the automatic distance of a light from its target, metres.
double automatic_distance(const PlacedLight& light, const LightSettings& s, double radius) {
    if (light.type == LightType::Directional) return (s.projection == LightProjection::Perspective ? 4 : 2) * radius;
    if (light.type == LightType::Spot)  // the sphere around the scene fits into the cone
        return radius / std::sin(std::min(light.half_cone_rad, kMaxHalfAngle));
    return 1.5 * radius;
}

double intensity_of(const LightSettings& s) {
    return s.on ? positive_or(s.intensity, 0) : 0;
}

PlacedLight place(const LightSettings& s, const SceneShape& shape) {
    PlacedLight light;
    light.type = s.type;
    light.to_light = direction_from_angles(finite_or(s.azimuth, -40), finite_or(s.elevation, 45));
    light.radiance =
        intensity_of(s) * glm::dvec3(positive_or(s.red, 0), positive_or(s.green, 0), positive_or(s.blue, 0));
    light.target =
        shape.centre + glm::dvec3(finite_or(s.target_x, 0), finite_or(s.target_y, 0), finite_or(s.target_z, 0));
    light.range_m = range_of(s);
    light.size = size_of(s);
    if (light.type == LightType::Spot) place_spot(light, s);
    if (light.type == LightType::Point) light.six_faces = true;
    light.distance_m = positive_or(s.distance, automatic_distance(light, s, shape.radius));
    light.position = light.target + light.to_light * light.distance_m;
    return light;
}

/// Divides spot and point radiances by the illuminance of the brightest at the scene's centre, so that the shaders'
/// 1/d^2 gives 1 there. Lights nearer than a quarter of the scene's radius count as being that far.
void normalise_punctual(std::vector<PlacedLight>& lights, const Settings& settings, const SceneShape& shape) {
    double brightest = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (lights[i].type == LightType::Directional) continue;
        const double d = std::max(glm::distance(lights[i].position, shape.centre), 0.25 * shape.radius);
        brightest = std::max(brightest, intensity_of(settings.lights[i]) / (d * d));
    }
    if (!(brightest > 0)) return;
    for (PlacedLight& light : lights)
        if (light.type != LightType::Directional) light.radiance /= brightest;
}

}  // namespace

PlacedLights place_lights(const Scene& scene, const Settings& settings) {
    const auto shape = std::make_shared<const SceneShape>(scene_shape(scene, settings));
    PlacedLights out{shape, {}, {}};
    for (int i = 0; i < std::clamp(settings.light_count, 0, kMaxLights); ++i)
        out.lights.push_back(place(settings.lights[std::size_t(i)], *shape));
    // Floats are finest near the origin, so it lies where objects lie close together.
    const glm::dvec3 nearby = scene.main_part.empty() ? shape->centre : main_bounds(scene).centre();
    for (PlacedLight& light : out.lights) light.map_origin = shader_origin(settings, nearby);
    normalise_punctual(out.lights, settings, *shape);
    for (const PlacedLight& light : out.lights)
        out.shapes.push_back(
            shape->ground ? std::make_shared<const SceneShape>(with_shadowed_ground(*shape, scene, light)) : shape);
    return out;
}

}  // namespace si
