#include "renderer/view/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "renderer/base/angles.h"
#include "renderer/base/finite.h"
#include "renderer/settings/param.h"
#include "renderer/view/camera_settings.h"
#include "renderer/view/projection.h"

namespace si {
namespace {

constexpr double kFramingMargin = 1.05;
/// Of the picture that a model on a ground fills together with its shadow.
constexpr double kFilled = 0.85;
/// A shadow longer than so many times the model's size is not seen to its end.
constexpr double kLongestShadow = 3;

/// Right, up and back of a view from an azimuth and elevation. `right` comes from the azimuth alone, so that looking
/// straight up or down is nothing special.
glm::dmat3 orbit_axes(double azimuth_deg, double elevation_deg, double roll_deg) {
    const SineCosine az = sine_cosine(azimuth_deg), roll = sine_cosine(roll_deg);
    const glm::dvec3 back = direction_from_angles(azimuth_deg, elevation_deg);
    const glm::dvec3 right(az.cosine, 0, -az.sine);
    const glm::dvec3 up = glm::cross(back, right);
    return {roll.cosine * right + roll.sine * up, roll.cosine * up - roll.sine * right, back};
}

glm::dvec3 corner(const Bounds& b, int i) {
    return {i & 1 ? b.hi.x : b.lo.x, i & 2 ? b.hi.y : b.lo.y, i & 4 ? b.hi.z : b.lo.z};
}

/// The bounds to look at: a unit box around zero when the scene is empty.
Bounds view_bounds(const Scene& scene) {
    Bounds b = scene.bounds;
    if (b.empty() || !std::isfinite(b.radius())) return {glm::dvec3(-1), glm::dvec3(1)};
    const double scale = std::max({1e-7, b.radius() * 1e-3, glm::length(b.centre()) * 1e-9});
    if (b.radius() < scale) b.lo -= scale, b.hi += scale;
    return b;
}

/// Near and far tight around the bounds along the view axis. The depth is a reversed float: a small near costs little.
void fit_range(Camera& c, const Bounds& bounds, double near, double far) {
    double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
    for (int i = 0; i < 8; ++i) {
        const double z = glm::dot(c.axes[2], c.eye - corner(bounds, i));
        nearest = std::min(nearest, z);
        farthest = std::max(farthest, z);
    }
    const double pad = 0.01 * (farthest - nearest) + 1e-3 * bounds.radius();
    if (c.orthographic) {
        c.curve.near = near > 0 ? near : nearest - pad;
        c.curve.far = far > 0 ? far : farthest + pad;
        if (!(c.curve.far > c.curve.near)) c.curve.far = c.curve.near + std::max(pad, 1e-3 * std::abs(c.curve.near));
        return;
    }
    c.curve.far = far > 0 ? far : std::max(farthest + pad, c.focus * 1e-2);
    c.curve.near = near > 0 ? near : std::max({0.9 * nearest, c.curve.far * 1e-6, c.focus * 1e-4});
    if (!(c.curve.far > c.curve.near * 1.0001)) {
        if (near > 0)
            c.curve.far = 2 * c.curve.near;
        else
            c.curve.near = 0.5 * c.curve.far;
    }
}

/// Moves the eye along `back` until the bounds fill the picture.
void frame_bounds(Camera& c, const Bounds& bounds) {
    const double tan_y = std::tan(0.5 * c.fov_y_rad), tan_x = tan_y * c.aspect;
    double distance = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 v = glm::transpose(c.axes) * (corner(bounds, i) - bounds.centre());
        distance = std::max({distance, v.z + std::abs(v.x) / tan_x, v.z + std::abs(v.y) / tan_y});
    }
    c.focus = kFramingMargin * distance;
    c.height = 2 * c.focus * tan_y;  // for a change to an orthographic camera
    c.eye = bounds.centre() + c.axes[2] * c.focus;
}

/// Places the eye so that all points lie in the middle kFilled of the picture, and reach its ends.
void frame_points(Camera& c, std::span<const glm::dvec3> points) {
    const glm::dmat3 turn = glm::transpose(c.axes);
    const double tan_y = kFilled * std::tan(0.5 * c.fov_y_rad), tan_x = tan_y * c.aspect;
    // As seen along the view, z towards the eye: |x - eye.x| <= tan (eye.z - z).
    glm::dvec4 most(-std::numeric_limits<double>::infinity());
    double nearest = most.x, farthest = -most.x;
    for (const glm::dvec3& p : points) {
        const glm::dvec3 v = turn * p;
        most = glm::max(most, glm::dvec4(tan_x * v.z + v.x, tan_x * v.z - v.x, tan_y * v.z + v.y, tan_y * v.z - v.y));
        nearest = std::max(nearest, v.z), farthest = std::min(farthest, v.z);
    }
    const double along = std::max((most.x + most.y) / (2 * tan_x), (most.z + most.w) / (2 * tan_y));
    c.eye = c.axes * glm::dvec3(0.5 * (most.x - most.y), 0.5 * (most.z - most.w), along);
    c.focus = std::max(along - 0.5 * (nearest + farthest), 1e-12);
    c.height = 2 * c.focus * std::tan(0.5 * c.fov_y_rad);
}

/// Where the scene suggests its first light, or the program does: a light that is turned leaves the camera alone.
glm::dvec3 suggested_light(const Scene& scene) {
    Settings s;
    for (const auto& [key, value] : scene.suggested)
        if (key == "light.azimuth" || key == "light.elevation" || key == "light.0.azimuth" ||
            key == "light.0.elevation")
            set_setting(s, key, value);
    return direction_from_angles(s.lights[0].azimuth, s.lights[0].elevation);
}

/// Whether the picture is framed for the shadow of what stands there, as of files that are shown on a ground.
bool frames_shadow(const Scene& scene, const Settings& settings) {
    const double size = scene.standing.radius();
    return settings.scene.ground == int(Ground::Auto) && !scene.file_scenes.empty() && std::isfinite(size) &&
           size > std::max(1e-7, 1e-9 * glm::length(scene.standing.centre()));
}

Bounds standing_as_framed(const Scene& scene) {
    return scene.framed.empty() ? scene.standing : scene.framed.transformed(scene.placement);
}

/// Where the camera stands that frames_shadow(): higher over what is flat, whose shadows are hidden from beside it, and
/// across what is long.
glm::dmat3 axes_for_shadow(const Bounds& standing) {
    const CameraSettings standard;
    constexpr double kHighest_deg = 50, kUpright = 0.35;  // from this height over the diagonal on as usual
    const glm::dvec3 size = standing.hi - standing.lo;
    const double upright = std::min(size.y / (kUpright * std::max(std::hypot(size.x, size.z), 1e-300)), 1.0);
    const double elevation = kHighest_deg + (standard.elevation - kHighest_deg) * upright;
    const double azimuth = std::clamp(standard.azimuth / 45 * std::atan2(size.z, size.x) / kDegree, 15.0, 75.0);
    return orbit_axes(azimuth, elevation, 0);
}

/// What a file's first picture is to hold: the corners of what stands on the ground, or on a floor of the file's own,
/// and their shadows on it as the scene is first shown.
std::vector<glm::dvec3> points_with_shadow(const Scene& scene, const Bounds& standing) {
    const bool own_floor = scene.ground_bounds.empty();
    const Box box = standing.corners();
    std::vector<glm::dvec3> points(box.begin(), box.end());
    const glm::dvec3 to_light = suggested_light(scene);
    if (to_light.y <= 0) return points;
    const double level = own_floor ? standing.lo.y : scene.ground_bounds.hi.y;
    const double longest = kLongestShadow * 2 * standing.radius();
    for (const glm::dvec3& p : box) {
        const glm::dvec3 cast = to_light * ((level - p.y) / to_light.y);
        if (glm::length(cast) > longest) continue;
        // A shadow is not seen beyond the floor.
        points.push_back(own_floor ? glm::clamp(p + cast, scene.bounds.lo, scene.bounds.hi) : p + cast);
    }
    return points;
}

/// The axes of a scene camera, made orthonormal; false when its transform is singular.
bool scene_axes(const glm::dmat4& world, glm::dmat3& axes) {
    const glm::dvec3 back = glm::normalize(glm::dvec3(world[2]));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(world[1]), back));
    axes = glm::dmat3(right, glm::cross(back, right), back);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!std::isfinite(axes[i][j]) || !std::isfinite(world[3][j])) return false;
    return true;
}

/// The scene's camera that is chosen, when there is one whose transform is usable; its orthonormal axes go to `axes`.
const SceneCamera* scene_camera(const Scene& scene, int index, glm::dmat3& axes) {
    if (index < 0 || std::size_t(index) >= scene.cameras.size()) return nullptr;
    const SceneCamera& camera = scene.cameras[std::size_t(index)];
    return scene_axes(camera.world, axes) ? &camera : nullptr;
}

/// The view of view.light, view.face as a camera; false when there is no light.
bool look_through_light(Camera& c, const Settings& settings, const Bounds& bounds,
                        std::span<const FittedLight> fitted) {
    if (fitted.empty()) return false;
    const FittedLight& light = fitted[std::size_t(std::clamp(settings.view.light, 0, int(fitted.size()) - 1))];
    if (light.views.empty()) return false;
    const LightView& view = light.views[std::size_t(std::clamp(settings.view.face, 0, int(light.views.size()) - 1))];
    const double half_y = view.half_width / std::min(c.aspect, 1.0);
    c.eye = view.eye;
    c.axes = view.axes;
    c.orthographic = !view.curve.perspective;
    c.fov_y_rad = c.orthographic ? c.fov_y_rad : 2 * std::atan(half_y);
    c.focus = std::max(glm::distance(c.eye, bounds.centre()), 1e-3 * bounds.radius());
    c.height = c.orthographic ? 2 * half_y : 2 * half_y * c.focus;
    c.curve.near = view.curve.near;
    c.curve.far = view.curve.far;
    return true;
}

double clamped_fov_rad(double fov_deg) {
    return std::clamp(finite_or(fov_deg, 45), 1e-3, 179.0) * kDegree;
}

}  // namespace

glm::dmat4 Camera::projection() const {
    const double half = orthographic ? 0.5 * height : std::tan(0.5 * fov_y_rad);
    return projection_matrix(curve, half * aspect, half);
}

glm::dmat4 Camera::clip_from_relative(const glm::dvec3& origin) const {
    return si::clip_from_relative(projection(), axes, eye, origin);
}

glm::dvec3 Camera::origin() const {
    const double spacing = std::exp2(std::ceil(std::log2(4 * focus)));
    return glm::round(eye / spacing) * spacing;
}

void Camera::pixel_ray(double x, double y, int width, int height_px, glm::dvec3& ray_origin,
                       glm::dvec3& ray_dir) const {
    const double half = orthographic ? 0.5 * height : std::tan(0.5 * fov_y_rad);
    const double vx = ((x + 0.5) / width * 2 - 1) * half * aspect, vy = (1 - (y + 0.5) / height_px * 2) * half;
    if (orthographic) {
        ray_origin = eye + axes * glm::dvec3(vx, vy, 0);
        ray_dir = -axes[2];
    } else {
        ray_origin = eye;
        ray_dir = glm::normalize(axes * glm::dvec3(vx, vy, -1));
    }
}

glm::dvec4 Camera::project(const glm::dvec3& world, int width, int height_px) const {
    const glm::dvec4 clip = projection() * glm::dvec4(glm::transpose(axes) * (world - eye), 1.0);
    const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
    return {(ndc.x + 1) / 2 * width - 0.5, (1 - ndc.y) / 2 * height_px - 0.5, uvd_from_ndc(curve.convention, ndc).z,
            clip.w};
}

Camera make_camera(const Scene& scene, const Settings& settings, double aspect,
                   std::span<const FittedLight> as_placed) {
    const CameraSettings& s = settings.camera;
    const Bounds bounds = view_bounds(scene);
    Camera c;
    c.aspect = positive_or(aspect, 1);
    c.orthographic = s.orthographic;
    c.fov_y_rad = clamped_fov_rad(s.fov);
    c.height = positive_or(s.height, 10);
    c.curve.convention = {true, true};
    double near = 0, far = 0;
    if (s.source == int(CameraSource::Light)) {
        std::vector<FittedLight> own;
        if (as_placed.empty()) as_placed = own = fit_lights(scene, settings);
        if (look_through_light(c, settings, bounds, as_placed)) {
            c.curve.perspective = !c.orthographic;
            return c;
        }
    }
    if (s.source == int(CameraSource::Manual)) {
        c.axes = orbit_axes(finite_or(s.azimuth, 35), finite_or(s.elevation, 25), finite_or(s.roll, 0));
        c.focus = positive_or(s.distance, bounds.radius());
        const glm::dvec3 target(finite_or(s.target_x, 0), finite_or(s.target_y, 0), finite_or(s.target_z, 0));
        c.eye = target + c.focus * c.axes[2];
        near = positive_or(s.near, 0);
        far = positive_or(s.far, 0);
    } else if (const SceneCamera* sc = scene_camera(scene, s.index, c.axes)) {
        c.eye = glm::dvec3(sc->world[3]);
        c.orthographic = sc->orthographic;
        c.fov_y_rad = clamped_fov_rad(sc->fov_y_deg);
        c.height = positive_or(sc->height, 10);
        c.focus = std::max(glm::distance(c.eye, bounds.centre()), 1e-3 * bounds.radius());
        near = positive_or(sc->near, 0);
        far = positive_or(sc->far, 0);
    } else {
        const CameraSettings standard;
        c.orthographic = false;
        c.fov_y_rad = clamped_fov_rad(standard.fov);
        if (frames_shadow(scene, settings)) {
            const Bounds standing = standing_as_framed(scene);
            c.axes = axes_for_shadow(standing);
            frame_points(c, points_with_shadow(scene, standing));
        } else {
            c.axes = orbit_axes(standard.azimuth, standard.elevation, 0);
            frame_bounds(c, bounds);
        }
    }
    c.curve.perspective = !c.orthographic;
    Bounds seen = bounds;
    seen.add(scene.ground_bounds);
    fit_range(c, seen, near, far);
    return c;
}

CameraSettings camera_settings(const Camera& c) {
    CameraSettings s;
    s.source = int(CameraSource::Manual);
    const glm::dvec3 back = c.axes[2];
    const double level = std::hypot(back.x, back.z);
    // Straight up or down the azimuth is free: roll then says everything.
    s.azimuth = level > 1e-12 ? std::atan2(back.x, back.z) / kDegree : 0;
    s.elevation = std::atan2(back.y, level) / kDegree;
    const glm::dmat3 level_axes = orbit_axes(s.azimuth, s.elevation, 0);
    s.roll = std::atan2(glm::dot(c.axes[0], level_axes[1]), glm::dot(c.axes[0], level_axes[0])) / kDegree;
    const glm::dvec3 target = c.eye - c.focus * back;
    s.target_x = target.x, s.target_y = target.y, s.target_z = target.z;
    s.distance = c.focus;
    s.fov = c.fov_y_rad / kDegree;
    s.orthographic = c.orthographic;
    s.height = c.height;
    return s;
}

CameraSettings manual_camera(const Scene& scene, const Settings& settings, double aspect) {
    if (settings.camera.source == int(CameraSource::Manual)) return settings.camera;
    CameraSettings s = camera_settings(make_camera(scene, settings, aspect));
    s.index = settings.camera.index;
    glm::dmat3 unused;
    const bool light = settings.camera.source == int(CameraSource::Light);
    const SceneCamera* sc = light ? nullptr : scene_camera(scene, s.index, unused);
    s.near = sc ? positive_or(sc->near, 0) : 0;
    s.far = sc ? positive_or(sc->far, 0) : 0;
    return s;
}

}  // namespace si
