#include "ui/scene_view/light_drag.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/base/angles.h"
#include "renderer/base/directions.h"
#include "renderer/base/index_of.h"
#include "renderer/view/fits/manual_light.h"
#include "ui/state/panels.h"

namespace si {
namespace {

constexpr double kSnapDegrees = 5;
constexpr double kMinShare = 1e-4;  // lower limit of near, extent and distance, as a share of distance or range
constexpr double kMinRange = 0.01;  // smallest difference of far and near, as a share of far
constexpr double kMaxRange = 1e8;   // m, limit of the setting

double snapped(double value, double step) {
    return step > 0 ? std::round(value / step) * step : value;
}
glm::dvec3 snapped(const glm::dvec3& p, double step) {
    return {snapped(p.x, step), snapped(p.y, step), snapped(p.z, step)};
}

void set_target(LightSettings& s, const glm::dvec3& target, const glm::dvec3& centre) {
    s.target_x = target.x - centre.x;
    s.target_y = target.y - centre.y;
    s.target_z = target.z - centre.z;
}

/// Sets azimuth and elevation from a unit vector. For vertical vectors the azimuth stays.
void set_angles(LightSettings& s, const glm::dvec3& to_light, double step) {
    const double level = std::hypot(to_light.x, to_light.z);
    if (level > 1e-9) s.azimuth = std::atan2(to_light.x, to_light.z) / kDegree;
    s.elevation = std::atan2(to_light.y, level) / kDegree;
    if (step > 0) {
        s.azimuth = snapped(s.azimuth, kSnapDegrees);
        s.elevation = snapped(s.elevation, kSnapDegrees);
    }
}

/// Sets the light's settings so that the light is at `position` and looks at `target`.
void set_place(LightSettings& s, const glm::dvec3& position, const glm::dvec3& target, const LightPose& start) {
    set_target(s, target, start.centre);
    const glm::dvec3 d = position - target;
    const double distance = glm::length(d), least = kMinShare * start.distance;
    s.distance = std::max(distance, least);
    if (distance > least) set_angles(s, d / distance, 0);
}

void move_place(LightSettings& s, const glm::dvec3& position, const LightPose& start) {
    if (start.type == LightType::Directional)
        set_target(s, glm::dvec3(s.target_x, s.target_y, s.target_z) + start.centre + position - start.position,
                   start.centre);
    else
        set_place(s, position, start.target, start);
}

/// Returns the point of a ball that a ray hits, as a unit vector from the centre. Beyond the ball's outline the far
/// side is mirrored, so that one drag reaches every direction.
glm::dvec3 on_ball(const Ray& ray, const glm::dvec3& centre, double radius, bool front) {
    const glm::dvec3 to_centre = centre - ray.origin;
    const double along = glm::dot(to_centre, ray.direction);
    glm::dvec3 aside = ray.origin + along * ray.direction - centre;  // perpendicular from the centre to the ray
    double off = glm::length(aside);
    if (off > radius) {
        const double mirrored = std::max(2 * radius - off, 0.0);
        aside *= mirrored / off;
        off = mirrored;
        front = !front;
    }
    const double depth = std::sqrt(std::max(radius * radius - off * off, 0.0));
    return glm::normalize(aside - (front ? depth : -depth) * ray.direction);
}

bool drag_direction(LightSettings& s, const LightPose& start, const PictureView& view, const Ray& ray, double step) {
    const bool spot = start.type == LightType::Spot;
    const glm::dvec3 centre = spot ? start.position : start.target;
    const glm::dvec3 tip = handle_position(start, LightHandle::Direction, view);
    const auto seen = view.point(tip);
    if (!seen) return false;
    const bool front = glm::dot(tip - centre, view.ray(*seen).direction) <= 0;
    const glm::dvec3 way = on_ball(ray, centre, glm::distance(tip, centre), front);
    set_angles(s, spot ? -way : way, step);
    if (spot) set_target(s, start.position - direction_from_angles(s.azimuth, s.elevation) * s.distance, start.centre);
    return true;
}

/// Sets the cone so that the handle on its rim comes as near to the mouse on the screen as it can. Where two angles do
/// equally well, as in a view along the axis, the one nearer to the present angle counts.
bool drag_cone(LightSettings& s, const LightPose& start, LightHandle h, const PictureView& view, const glm::dvec2& to,
               double step) {
    constexpr int kParts = 720;               // of 180 degrees
    constexpr double kLeast = 0.1 * kDegree;  // of the half angle
    constexpr double kPrecise = 1e-8;         // radians
    constexpr double kTiePixels = 1;
    const glm::dvec3 axis = -start.to_light, side = handle_axis(start, h);
    const double most = std::numbers::pi, present = half_cone_rad(start.settings), reach = cone_rim_distance(start);
    const auto pixels_off = [&](double half) {
        const auto seen = view.point(start.position + reach * (std::sin(half) * side + std::cos(half) * axis));
        return seen ? glm::distance(*seen, to) : std::numeric_limits<double>::infinity();
    };
    const auto half_of = [&](int part) { return kLeast + (most - kLeast) * part / kParts; };
    double least = std::numeric_limits<double>::infinity(), best = present;
    for (int part = 0; part <= kParts; ++part) least = std::min(least, pixels_off(half_of(part)));
    if (!std::isfinite(least)) return false;
    double nearest = std::numeric_limits<double>::infinity();
    for (int part = 0; part <= kParts; ++part) {
        const double half = half_of(part), change = std::abs(half - present);
        if (pixels_off(half) > least + kTiePixels || change >= nearest) continue;
        nearest = change;
        best = half;
    }
    for (double width = (most - kLeast) / kParts; width > kPrecise; width /= 2)
        for (const double by : {-width, width})
            for (double half = std::clamp(best + by, kLeast, most); pixels_off(half) < pixels_off(best);
                 half = std::clamp(best + by, kLeast, most))
                best = half;
    const double degrees = 2 * best / kDegree;
    s.cone = std::clamp(step > 0 ? snapped(degrees, kSnapDegrees) : degrees, 0.2, 360.0);
    return true;
}

bool drag_range(LightSettings& s, const LightPose& start, const Ray& ray, double step) {
    const auto metres = nearest_on_line(ray, start.position, range_axis(start));
    if (!metres) return false;
    s.range = std::clamp(snapped(*metres, step), std::max(kMinShare * start.settings.range, step), kMaxRange);
    return true;
}

bool drag_plane(LightSettings& s, const LightPose& start, LightHandle h, const Ray& ray, double step) {
    const auto z = nearest_on_line(ray, start.view.eye, -start.view.axes[2]);
    if (!z) return false;
    const double wanted = snapped(*z, step);
    if (h == LightHandle::Far) {
        s.far = std::max(wanted, start.view.curve.near + kMinRange * std::abs(start.view.curve.far));
        return true;
    }
    const double far = start.view.curve.far, most = far - kMinRange * std::abs(far);
    const double least = std::max(kMinShare * far, step);
    if (wanted < least && start.type == LightType::Directional && start.orthographic()) {
        // A directional light has no fixed position: it moves back, and its other plane stays in place.
        const double back = least - wanted;
        s.distance += back;
        s.far += back;
    }
    s.near = std::clamp(wanted, std::min(least, most), most);
    return true;
}

}  // namespace

LightPose grab_light(const LightPose& pose, LightHandle h, const FittedLight& fitted) {
    LightPose start = pose;
    if (h == LightHandle::Range) return start;
    const bool directional = pose.type == LightType::Directional;
    const bool turns = h == LightHandle::Direction || is_cone(h);
    const bool moves = h == LightHandle::Position || h == LightHandle::Target || is_axis(h);
    if (turns || (moves && !directional)) {
        if (!directional) start.settings.distance = pose.distance;
        return start;
    }
    start.settings = manual_light(pose.settings, fitted);
    // The light may have moved back to keep near positive.
    const double back = start.settings.distance - pose.distance;
    if (directional && back > 0) {
        start.position += start.to_light * back;
        start.view.eye += start.to_light * back;
        start.view.curve.near += back;
        start.view.curve.far += back;
        start.distance += back;
    }
    return start;
}

std::optional<LightSettings> drag_light(const LightPose& start, LightHandle h, const PictureView& view,
                                        const glm::dvec2& to, double step) {
    LightSettings s = start.settings;
    const Ray ray = view.ray(to);
    const auto in_camera_plane = [&](const glm::dvec3& p) { return intersect_plane(ray, p, view.camera.axes[2]); };
    if (h == LightHandle::Position) {
        const auto p = in_camera_plane(start.position);
        if (!p) return {};
        move_place(s, snapped(*p, step), start);
    } else if (is_axis(h)) {
        const glm::dvec3 way = handle_axis(start, h), tip = handle_position(start, h, view);
        const auto t = nearest_on_line(ray, tip, way);
        if (!t) return {};
        glm::dvec3 p = start.position + way * *t;
        const int axis = index_of(h) - index_of(LightHandle::AxisX);
        p[axis] = snapped(p[axis], step);
        move_place(s, p, start);
    } else if (h == LightHandle::Target) {
        const auto p = in_camera_plane(start.target);
        if (!p) return {};
        const glm::dvec3 target = snapped(*p, step);
        if (start.type == LightType::Directional)
            set_target(s, target, start.centre);
        else
            set_place(s, start.position, target, start);
    } else if (h == LightHandle::Direction) {
        if (!drag_direction(s, start, view, ray, step)) return {};
    } else if (is_extent(h)) {
        const glm::dvec3 way = handle_axis(start, h);
        const auto t = nearest_on_line(ray, handle_position(start, h, view) - way * start.view.half_extent(), way);
        if (!t) return {};
        s.extent = std::max(snapped(*t, step), std::max(kMinShare * start.view.half_extent(), step));
    } else if (is_cone(h)) {
        if (!drag_cone(s, start, h, view, to, step)) return {};
    } else if (h == LightHandle::Range) {
        if (!drag_range(s, start, ray, step)) return {};
    } else if (!drag_plane(s, start, h, ray, step)) {
        return {};
    }
    return s;
}

double snap_step(double scene_radius) {
    const double wanted = std::max(scene_radius, 1e-9) / 50, decade = std::pow(10, std::floor(std::log10(wanted)));
    const double share = wanted / decade;
    return decade * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
}

std::string handle_numbers(const LightPose& pose, LightHandle h) {
    const LightSettings& s = pose.settings;
    // Lengths negligible at the light's distance become 0.
    const auto metres = [&](double v) { return metres_text(std::abs(v) < 1e-9 * pose.distance ? 0 : v); };
    const auto place = [&](const glm::dvec3& p) {
        return fmt::format("x {}   y {}   z {}", metres(p.x), metres(p.y), metres(p.z));
    };
    if (h == LightHandle::Position) return place(pose.position);
    if (is_axis(h)) {
        const int axis = index_of(h) - index_of(LightHandle::AxisX);
        return fmt::format("{} {}", "xyz"[axis], metres(pose.position[axis]));
    }
    if (h == LightHandle::Target) return place(pose.target);
    if (h == LightHandle::Direction) return fmt::format("azimuth {:.1f}°   elevation {:.1f}°", s.azimuth, s.elevation);
    if (h == LightHandle::Range) return metres_text(s.range);
    if (h == LightHandle::Near) return metres_text(pose.view.curve.near);
    if (h == LightHandle::Far) return metres_text(pose.view.curve.far);
    if (is_cone(h)) return fmt::format("{:.1f}°", s.cone);
    return metres_text(pose.view.half_extent());
}

}  // namespace si
