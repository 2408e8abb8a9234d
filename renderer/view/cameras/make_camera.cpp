#include "renderer/view/cameras/make_camera.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "renderer/base/angles.h"
#include "renderer/base/finite.h"
#include "renderer/view/cameras/framing.h"
#include "renderer/view/fits/light_fit.h"

namespace si {
namespace {

/// Returns bounds that a camera can look at: a unit box around zero when `b` is empty, and no point.
Bounds view_bounds(Bounds b) {
    if (b.empty() || !std::isfinite(b.radius())) return {glm::dvec3(-1), glm::dvec3(1)};
    const double scale = std::max({1e-7, b.radius() * 1e-3, glm::length(b.centre()) * 1e-9});
    if (b.radius() < scale) {
        b.lo -= scale;
        b.hi += scale;
    }
    return b;
}

/// Sets near and far planes tight around the bounds. Depth is a reversed float, so a small near plane costs little
/// precision.
/// @param main part of the bounds that must not be cut off, even where they reach a million times as far
void fit_range(Camera& c, const Bounds& bounds, const Bounds& main, double near, double far) {
    double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
    for (const glm::dvec3& p : bounds.corners()) {
        const double z = glm::dot(c.axes[2], c.eye - p);
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
    const double least = main == bounds ? c.curve.far * 1e-6 : std::min(c.curve.far * 1e-6, 1e-2 * main.radius());
    c.curve.near = near > 0 ? near : std::max({0.9 * nearest, least, c.focus * 1e-4});
    if (!(c.curve.far > c.curve.near * 1.0001)) {
        if (near > 0)
            c.curve.far = 2 * c.curve.near;
        else
            c.curve.near = 0.5 * c.curve.far;
    }
}

/// Computes orthonormal axes of a scene camera; returns false when its transform is singular.
bool scene_axes(const glm::dmat4& world, glm::dmat3& axes) {
    const glm::dvec3 back = glm::normalize(glm::dvec3(world[2]));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(world[1]), back));
    axes = glm::dmat3(right, glm::cross(back, right), back);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!std::isfinite(axes[i][j]) || !std::isfinite(world[3][j])) return false;
    return true;
}

/// Returns the chosen camera of the scene if its transform is usable, and its orthonormal axes in `axes`.
const SceneCamera* scene_camera(const Scene& scene, int index, glm::dmat3& axes) {
    if (index < 0 || std::size_t(index) >= scene.cameras.size()) return nullptr;
    const SceneCamera& camera = scene.cameras[std::size_t(index)];
    return scene_axes(camera.world, axes) ? &camera : nullptr;
}

/// Makes a camera from the view of view.light, view.face; returns false without a light.
bool look_through_light(Camera& c, const Settings& settings, const Bounds& bounds,
                        std::span<const FittedLight> fitted) {
    if (fitted.empty()) return false;
    const FittedLight& light = fitted[std::size_t(std::clamp(settings.view.light, 0, int(fitted.size()) - 1))];
    if (light.views.empty()) return false;
    const LightView& view = light.views[std::size_t(std::clamp(settings.view.face, 0, int(light.views.size()) - 1))];
    const glm::dvec2 half = view.half_extents();
    const double half_y = std::max(half.y, half.x / c.aspect);
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

Camera make_camera(const Scene& scene, const Settings& settings, double aspect,
                   std::span<const FittedLight> fitted_without_camera) {
    const CameraSettings& s = settings.camera;
    const Bounds whole = view_bounds(scene.bounds);
    const Bounds bounds = scene.main_part.empty() ? whole : view_bounds(main_bounds(scene));
    Camera c;
    c.aspect = positive_or(aspect, 1);
    c.orthographic = s.orthographic;
    c.fov_y_rad = clamped_fov_rad(s.fov);
    c.height = positive_or(s.height, 10);
    c.curve.convention = {true, true};
    double near = 0, far = 0;
    if (s.source == CameraSource::Light) {
        std::vector<FittedLight> own;
        if (fitted_without_camera.empty()) fitted_without_camera = own = fit_lights(scene, settings);
        if (look_through_light(c, settings, bounds, fitted_without_camera)) {
            c.curve.perspective = !c.orthographic;
            return c;
        }
    }
    if (s.source == CameraSource::Manual) {
        c.axes = orbit_axes(finite_or(s.azimuth, 35), finite_or(s.elevation, 25), finite_or(s.roll, 0));
        c.focus = positive_or(s.distance, bounds.radius());
        const glm::dvec3 target(finite_or(s.target_x, 0), finite_or(s.target_y, 0), finite_or(s.target_z, 0));
        c.eye = target + c.focus * c.axes[2];
        near = positive_or(s.near, 0);
        far = positive_or(s.far, 0);
    } else if (const SceneCamera* sc = scene_camera(scene, s.index, c.axes)) {
        const double scale = placement_scale(scene);
        c.eye = glm::dvec3(sc->world[3]);
        c.orthographic = sc->orthographic;
        c.fov_y_rad = clamped_fov_rad(sc->fov_y_deg);
        c.height = positive_or(scale * sc->height, 10);
        c.focus = std::max(glm::distance(c.eye, bounds.centre()), 1e-3 * bounds.radius());
        near = positive_or(scale * sc->near, 0);
        far = positive_or(scale * sc->far, 0);
    } else {
        const CameraSettings standard;
        c.orthographic = false;
        c.fov_y_rad = clamped_fov_rad(standard.fov);
        const bool far_too = s.index < 0 && !scene.main_part.empty();
        if (should_frame_shadow(scene, settings) && !far_too) {
            frame_with_shadow(c, scene);
        } else {
            c.axes = orbit_axes(standard.azimuth, standard.elevation, 0);
            frame_bounds(c, far_too ? whole : bounds);
        }
    }
    c.curve.perspective = !c.orthographic;
    Bounds seen = whole, main = bounds;
    seen.add(scene.ground_bounds);
    main.add(scene.ground_bounds);
    fit_range(c, seen, main, near, far);
    return c;
}

CameraSettings camera_settings(const Camera& c) {
    CameraSettings s;
    s.source = CameraSource::Manual;
    const glm::dvec3 back = c.axes[2];
    const double level = std::hypot(back.x, back.z);
    // Looking straight up or down, the azimuth is arbitrary; roll then sets the orientation.
    s.azimuth = level > 1e-12 ? std::atan2(back.x, back.z) / kDegree : 0;
    s.elevation = std::atan2(back.y, level) / kDegree;
    const glm::dmat3 level_axes = orbit_axes(s.azimuth, s.elevation, 0);
    s.roll = std::atan2(glm::dot(c.axes[0], level_axes[1]), glm::dot(c.axes[0], level_axes[0])) / kDegree;
    const glm::dvec3 target = c.eye - c.focus * back;
    s.target_x = target.x;
    s.target_y = target.y;
    s.target_z = target.z;
    s.distance = c.focus;
    s.fov = c.fov_y_rad / kDegree;
    s.orthographic = c.orthographic;
    s.height = c.height;
    return s;
}

CameraSettings manual_camera(const Scene& scene, const Settings& settings, double aspect) {
    if (settings.camera.source == CameraSource::Manual) return settings.camera;
    CameraSettings s = camera_settings(make_camera(scene, settings, aspect));
    s.index = settings.camera.index;
    glm::dmat3 unused;
    const bool light = settings.camera.source == CameraSource::Light;
    const SceneCamera* sc = light ? nullptr : scene_camera(scene, s.index, unused);
    const double scale = placement_scale(scene);
    s.near = sc ? positive_or(scale * sc->near, 0) : 0;
    s.far = sc ? positive_or(scale * sc->far, 0) : 0;
    return s;
}

}  // namespace si
