#include "renderer/view/cameras/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "renderer/base/angles.h"
#include "renderer/base/directions.h"
#include "renderer/settings/param.h"
#include "renderer/view/bounds/convex.h"

namespace si {
namespace {

constexpr double kFramingMargin = 1.05;
/// Share of the picture that a model fills together with its shadow on a ground.
constexpr double kFilled = 0.85;
/// Longest framed shadow, as a multiple of the size of the model.
constexpr double kLongestShadow = 3;
/// Share of the picture that a shadow should cover outside its casters.
constexpr double kShadowSeen = 0.035;
/// Elevation from which the automatic camera sees an upright model: less than half the usual field of view of 45
/// degrees, so that the horizon is in the picture.
constexpr double kUsual_deg = 16;
/// Highest elevations of the automatic camera. The second applies to shadows on a floor of the file's own, unless the
/// model is very flat.
constexpr double kHighest_deg = 50, kHighestOverFloor_deg = 40;

/// Places the eye so that all points just fit into the middle kFilled of the picture.
void frame_points(Camera& c, std::span<const glm::dvec3> points) {
    const glm::dmat3 turn = glm::transpose(c.axes);
    const double tan_y = kFilled * std::tan(0.5 * c.fov_y_rad), tan_x = tan_y * c.aspect;
    // View space with z towards the eye: |x - eye.x| <= tan (eye.z - z).
    glm::dvec4 most(-std::numeric_limits<double>::infinity());
    double nearest = most.x, farthest = -most.x;
    for (const glm::dvec3& p : points) {
        const glm::dvec3 v = turn * p;
        most = glm::max(most, glm::dvec4(tan_x * v.z + v.x, tan_x * v.z - v.x, tan_y * v.z + v.y, tan_y * v.z - v.y));
        nearest = std::max(nearest, v.z);
        farthest = std::min(farthest, v.z);
    }
    const double along = std::max((most.x + most.y) / (2 * tan_x), (most.z + most.w) / (2 * tan_y));
    c.eye = c.axes * glm::dvec3(0.5 * (most.x - most.y), 0.5 * (most.z - most.w), along);
    c.focus = std::max(along - 0.5 * (nearest + farthest), 1e-12);
    c.height = 2 * c.focus * std::tan(0.5 * c.fov_y_rad);
}

/// Direction to the first light as the scene suggests it, or its default. Turning the light then leaves the camera
/// alone.
glm::dvec3 suggested_light(const Scene& scene) {
    Settings s;
    for (const auto& [key, value] : scene.suggested)
        if (key == "light.azimuth" || key == "light.elevation" || key == "light.0.azimuth" ||
            key == "light.0.elevation")
            set_setting(s, key, value);
    return direction_from_angles(s.lights[0].azimuth, s.lights[0].elevation);
}

/// Points of the model that the picture has to contain, world.
std::vector<glm::dvec3> points_to_frame(const Scene& scene) {
    const Box box = (scene.main_part.empty() ? scene.bounds_without_floor : main_bounds(scene)).corners();
    if (scene.framed.empty()) return {box.begin(), box.end()};
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& p : scene.framed) points.emplace_back(scene.placement * glm::dvec4(p, 1));
    return points;
}

/// Direction of the camera that frames a shadow: from higher above flat models, whose shadows are otherwise hidden, and
/// across long ones.
struct ShadowView {
    double azimuth_deg, elevation_deg;
};
ShadowView view_for_shadow(const Bounds& standing) {
    const CameraSettings standard;
    constexpr double kUpright = 0.35;  // height / diagonal above which the usual elevation applies
    const glm::dvec3 size = standing.hi - standing.lo;
    const double upright = std::min(size.y / (kUpright * std::max(std::hypot(size.x, size.z), 1e-300)), 1.0);
    return {std::clamp(standard.azimuth / 45 * std::atan2(size.z, size.x) / kDegree, 15.0, 75.0),
            kHighest_deg + (kUsual_deg - kHighest_deg) * upright};
}

/// Adds the shadows of the model on the ground, or on a floor of the file's own, under the suggested light.
std::vector<glm::dvec3> with_shadows(const Scene& scene, const std::vector<glm::dvec3>& standing,
                                     const Bounds& bounds) {
    const bool own_floor = scene.ground_bounds.empty();
    const Bounds whole = scene.framed.empty() ? main_bounds(scene) : scene.framed_bounds.transformed(scene.placement);
    std::vector<glm::dvec3> points = standing;
    const glm::dvec3 to_light = suggested_light(scene);
    if (to_light.y <= 0) return points;
    const double level = own_floor ? bounds.lo.y : scene.ground_bounds.hi.y;
    const double longest = kLongestShadow * 2 * bounds.radius();
    for (const glm::dvec3& p : standing) {
        const glm::dvec3 cast = to_light * ((level - p.y) / to_light.y);
        if (glm::length(cast) > longest) continue;
        // Shadows end at the edge of the floor.
        points.push_back(own_floor ? glm::clamp(p + cast, whole.lo, whole.hi) : p + cast);
    }
    return points;
}

/// Share of the picture covered by the hull around `all` but not by the hull around `standing`.
double shadow_seen(const Camera& c, const std::vector<glm::dvec3>& standing, const std::vector<glm::dvec3>& all) {
    const double tan_y = std::tan(0.5 * c.fov_y_rad);
    const auto covered = [&](const std::vector<glm::dvec3>& points) {
        std::vector<glm::dvec2> seen;
        for (const glm::dvec3& p : points) {
            const glm::dvec3 v = glm::transpose(c.axes) * (p - c.eye);
            const double reach = tan_y * std::max(-v.z, 1e-12);
            seen.emplace_back(v.x / (reach * c.aspect), v.y / reach);
        }
        return 0.25 * polygon_area(convex_hull(std::move(seen)));
    };
    return covered(all) - covered(standing);
}

}  // namespace

glm::dmat3 orbit_axes(double azimuth_deg, double elevation_deg, double roll_deg) {
    const SineCosine az = sine_cosine(azimuth_deg), roll = sine_cosine(roll_deg);
    const glm::dvec3 back = direction_from_angles(azimuth_deg, elevation_deg);
    const glm::dvec3 right(az.cosine, 0, -az.sine);
    const glm::dvec3 up = glm::cross(back, right);
    return {roll.cosine * right + roll.sine * up, roll.cosine * up - roll.sine * right, back};
}

void frame_bounds(Camera& c, const Bounds& bounds) {
    const double tan_y = std::tan(0.5 * c.fov_y_rad), tan_x = tan_y * c.aspect;
    double distance = 0;
    for (const glm::dvec3& p : bounds.corners()) {
        const glm::dvec3 v = glm::transpose(c.axes) * (p - bounds.centre());
        distance = std::max({distance, v.z + std::abs(v.x) / tan_x, v.z + std::abs(v.y) / tan_y});
    }
    c.focus = kFramingMargin * distance;
    c.height = 2 * c.focus * tan_y;  // for a change to an orthographic camera
    c.eye = bounds.centre() + c.axes[2] * c.focus;
}

bool should_frame_shadow(const Scene& scene, const Settings& settings) {
    const double size = scene.bounds_without_floor.radius();
    return settings.scene.ground == Ground::Auto && !scene.file_scenes.empty() && std::isfinite(size) &&
           size > std::max(1e-7, 1e-9 * glm::length(scene.bounds_without_floor.centre()));
}

void frame_with_shadow(Camera& c, const Scene& scene) {
    const std::vector<glm::dvec3> standing = points_to_frame(scene);
    Bounds bounds;
    for (const glm::dvec3& p : standing) bounds.add(p);
    const std::vector<glm::dvec3> all = with_shadows(scene, standing, bounds);
    const ShadowView from = view_for_shadow(bounds);
    constexpr double kStep_deg = 5;
    Camera usual = c;  // fixed aspect, so that windows of any shape look from the same side
    usual.aspect = 16.0 / 9;
    const double highest = scene.ground_bounds.empty() ? kHighestOverFloor_deg : kHighest_deg;
    for (double elevation = from.elevation_deg;; elevation = std::min(elevation + kStep_deg, highest)) {
        usual.axes = orbit_axes(from.azimuth_deg, elevation, 0);
        frame_points(usual, all);
        if (elevation >= highest || all.size() == standing.size() || !(shadow_seen(usual, standing, all) < kShadowSeen))
            break;
    }
    c.axes = usual.axes;
    frame_points(c, all);
}

}  // namespace si
