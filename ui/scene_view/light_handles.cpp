#include "ui/scene_view/light_handles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/base/directions.h"
#include "renderer/base/index_of.h"
#include "renderer/view/fits/manual_light.h"

namespace si {
namespace {

constexpr double kArrowPixels = 58, kBallPixels = 92;  // at scale 1
constexpr double kRim = 0.7;                           // share of the distance to the target
constexpr double kMinSine = 0.12;                      // smallest sine between the line of sight and a handle's axis
constexpr double kMostAlong = 0.87;  // largest cosine between the line of sight and a cone handle's side: 30 degrees

/// Returns true if the handle does not move along the line of sight, where small movements would become large.
bool can_move(const LightPose& pose, const PlacedHandle& placed, const PictureView& view) {
    const LightHandle h = placed.handle;
    const glm::dvec3 sight = view.ray(placed.on_screen).direction;
    const auto across = [&](const glm::dvec3& line) { return glm::length(glm::cross(sight, line)) > kMinSine; };
    if (h == LightHandle::Near || h == LightHandle::Far) return across(pose.view.axes[2]);
    if (is_axis(h) || is_extent(h)) return across(handle_axis(pose, h));
    if (h == LightHandle::Range) return across(range_axis(pose));
    if (is_cone(h)) {
        const double half = half_cone_rad(pose.settings);
        const glm::dvec3 side = handle_axis(pose, h);
        const double along_axis = std::abs(glm::dot(sight, pose.to_light));
        // A rim seen edge-on is a line. Its handles before and behind the axis would not follow the mouse along it;
        // those at its ends do.
        if (along_axis < 1 - kMostAlong && std::abs(glm::dot(sight, side)) > kMostAlong) return false;
        return across(std::cos(half) * side + std::sin(half) * pose.to_light);  // along the arc
    }
    return true;
}

}  // namespace

bool is_axis(LightHandle h) {
    return h >= LightHandle::AxisX && h <= LightHandle::AxisZ;
}
bool is_extent(LightHandle h) {
    return h >= LightHandle::ExtentRight && h <= LightHandle::ExtentBottom;
}
bool is_cone(LightHandle h) {
    return h >= LightHandle::ConeRight && h <= LightHandle::ConeBottom;
}

std::string_view handle_name(LightHandle h) {
    constexpr std::string_view kNames[] = {"Place",      "Place along x", "Place along y", "Place along z", "Direction",
                                           "Target",     "Extent",        "Extent",        "Extent",        "Extent",
                                           "Cone",       "Cone",          "Cone",          "Cone",          "Range",
                                           "Near plane", "Far plane"};
    return kNames[index_of(h)];
}

LightPose light_pose(const LightSettings& settings, const FittedLight& fitted, int face) {
    LightPose pose;
    pose.settings = settings;
    pose.type = fitted.type;
    pose.has_map = fitted.casts && !fitted.views.empty();
    if (!fitted.views.empty()) pose.view = fitted.views[std::size_t(std::clamp(face, 0, int(fitted.views.size()) - 1))];
    if (fitted.casts && (fitted.is_cascaded() || fitted.is_warped())) pose.cascades = fitted.views;
    pose.to_light = fitted.to_light;
    pose.centre = target_origin(settings, fitted);
    pose.target = fitted.target;
    pose.position = fitted.position;
    pose.distance = glm::distance(fitted.position, fitted.target);
    if (pose.type == LightType::Directional && pose.orthographic()) {
        if (!pose.cascaded()) pose.position = pose.view.eye;
        // The fit places the map; the target's setting then means nothing, and a light that turns about the scene's
        // centre stays under the cursor.
        if (settings.fit != LightFit::Manual) pose.target = pose.centre;
    }
    return pose;
}

std::vector<LightHandle> handles_of(const LightPose& pose) {
    using enum LightHandle;
    // The fit chooses place and extent of cascades. A manual place or extent would end them.
    if (pose.cascaded()) return {Direction};
    std::vector<LightHandle> all{Position, AxisX, AxisY, AxisZ};
    if (pose.type != LightType::Point) all.push_back(Direction);
    const bool placed_by_fit =
        pose.type == LightType::Directional && pose.orthographic() && pose.settings.fit != LightFit::Manual;
    if (pose.type != LightType::Point && !placed_by_fit) all.push_back(Target);
    if (pose.type == LightType::Spot) all.insert(all.end(), {ConeRight, ConeTop, ConeLeft, ConeBottom});
    if (pose.ranged()) all.push_back(Range);
    if (!pose.has_map) return all;
    if (pose.orthographic()) all.insert(all.end(), {ExtentRight, ExtentTop, ExtentLeft, ExtentBottom});
    all.insert(all.end(), {Near, Far});
    return all;
}

glm::dvec3 handle_axis(const LightPose& pose, LightHandle h) {
    if (is_axis(h)) return glm::dmat3(1.0)[index_of(h) - index_of(LightHandle::AxisX)];
    const int side = index_of(h) - index_of(is_cone(h) ? LightHandle::ConeRight : LightHandle::ExtentRight);
    const glm::dmat3 axes = is_cone(h) ? orthonormal_basis(pose.to_light) : pose.view.axes;
    return (side < 2 ? 1.0 : -1.0) * axes[side % 2];
}

glm::dvec3 range_axis(const LightPose& pose) {
    const glm::dmat3 axes = orthonormal_basis(pose.to_light);
    const glm::dvec3 aside = (axes[0] + axes[1]) / std::numbers::sqrt2;
    if (pose.type != LightType::Spot) return aside;
    const double half = half_cone_rad(pose.settings);
    return std::sin(half) * aside - std::cos(half) * pose.to_light;
}

double half_cone_rad(const LightSettings& settings) {
    return std::clamp(0.5 * settings.cone, 0.05, 180.0) * std::numbers::pi / 180;
}

double direction_ball_radius(const LightPose& pose, const PictureView& view) {
    const glm::dvec3 about = pose.type == LightType::Spot ? pose.position : pose.target;
    const double on_screen = kBallPixels * view.ui_scale * view.metres_per_pixel(about);
    return std::min(on_screen, 0.6 * pose.distance);
}

double cone_rim_distance(const LightPose& pose) {
    return kRim * pose.distance;
}

glm::dvec3 handle_position(const LightPose& pose, LightHandle h, const PictureView& view) {
    const LightView& map = pose.view;
    const auto along = [&](double z) { return map.eye - map.axes[2] * z; };
    switch (h) {
        case LightHandle::Position:
            return pose.position;
        case LightHandle::Target:
            return pose.target;
        case LightHandle::Range:
            return pose.position + range_axis(pose) * pose.settings.range;
        case LightHandle::Near:
            return along(map.curve.near);
        case LightHandle::Far:
            return along(map.curve.far);
        case LightHandle::Direction:
            return pose.type == LightType::Spot ? pose.position - pose.to_light * direction_ball_radius(pose, view)
                                                : pose.target + pose.to_light * direction_ball_radius(pose, view);
        default:
            break;
    }
    const glm::dvec3 way = handle_axis(pose, h);
    if (is_axis(h)) return pose.position + way * (kArrowPixels * view.ui_scale * view.metres_per_pixel(pose.position));
    if (is_extent(h)) return along(0.5 * (map.curve.near + map.curve.far)) + way * map.half_extent();
    const double half = half_cone_rad(pose.settings);
    return pose.position + cone_rim_distance(pose) * (std::sin(half) * way - std::cos(half) * pose.to_light);
}

std::vector<PlacedHandle> place_handles(const LightPose& pose, const PictureView& view) {
    std::vector<PlacedHandle> placed;
    for (const LightHandle h : handles_of(pose)) {
        PlacedHandle p{h, handle_position(pose, h, view), {}};
        const auto on = view.point(p.at);
        if (!on || !view.contains(*on)) continue;
        p.on_screen = *on;
        if (can_move(pose, p, view)) placed.push_back(p);
    }
    return placed;
}

}  // namespace si
