#include "renderer/view/light_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/base/angles.h"
#include "renderer/base/finite.h"
#include "renderer/view/fit_bounds.h"
#include "renderer/view/map_limits.h"
#include "renderer/view/projection.h"

namespace si {
namespace {

constexpr double kMinHalfAngle = 1e-3, kMaxHalfAngle = 1.5;  // rad; tan() stays below 15
constexpr double kMarginTexels = 2;      // at each side, so that a kernel at the edge of the scene finds cleared texels
constexpr double kFaceMarginTexels = 6;  // the widest kernel crosses from one face of six into the next
constexpr double kNearShare = 1e-3;      // least near / far of a perspective map: D24 then resolves far / 2e4
constexpr double kDepthMargin = 1e-4;    // of the depth range, at each end
// 2^10 steps of a float: a thinner range or map has no useful resolution.
constexpr double kMinShare = 1024.0 / (1 << 23);

/// Half extent plus the margin in texels, at least a thousand float steps of `scale`.
double with_margin(double half, double scale, int resolution, double margin = kMarginTexels) {
    const double share = resolution > 4 * margin ? 1 - 2 * margin / resolution : 0.5;
    return std::max(half, kMinShare * scale) / share;
}

/// Makes the range of `curve` positive: at least two texels and a thousand float steps of `scale`, about the same
/// middle.
void widen_range(DepthCurve& curve, double texel, double scale) {
    const double least = std::max({2 * texel, kMinShare * scale, 1e-12});
    if (curve.far - curve.near >= least) return;
    const double middle = 0.5 * (curve.near + curve.far);
    curve.near = middle - 0.5 * least;
    curve.far = middle + 0.5 * least;
    if (curve.perspective && curve.near < kNearShare * curve.far) {
        curve.near = kNearShare * curve.far;
        curve.far = curve.near + least;
    }
}

void note(FittedLight& light, std::string text) {
    if (std::find(light.notes.begin(), light.notes.end(), text) == light.notes.end())
        light.notes.push_back(std::move(text));
}

/// light.near and light.far in place of the fitted range, where they make sense.
void manual_range(FittedLight& light, const LightSettings& s, DepthCurve& curve) {
    if (s.fit != int(LightFit::Manual)) return;
    const double near = finite_or(s.near, 0), far = finite_or(s.far, 0);
    if (near != 0 && (near > 0 || !curve.perspective)) curve.near = near;
    if (far != 0) curve.far = far;
    if (near < 0 && curve.perspective) note(light, "a perspective map needs near > 0: light.near is fitted instead");
    if (!(curve.far > curve.near)) {
        note(light,
             fmt::format("near {:.6g} m is not below far {:.6g} m: far is moved behind near", curve.near, curve.far));
        curve.far = curve.near + std::max(std::abs(curve.near), 1e-6);
    }
}

struct FitContext {
    const SceneShape& shape;
    const LightSettings& settings;
    DepthConvention convention;
    int resolution;
    double reach_m;  ///< how far a spot or point light shines; infinite when unlimited
};

double range_of(const LightSettings& s) {
    return s.type == int(LightType::Directional) ? 0 : positive_or(s.range, 0);
}

void finish_view(FittedLight& light, LightView view, const FitContext& c, double reference_z) {
    manual_range(light, c.settings, view.curve);
    // An orthographic depth is affine: only what doubles resolve that far from the light matters besides the scene.
    const double scale =
        view.curve.perspective ? view.curve.far : std::max(c.shape.radius, 0x1p-30 * std::abs(view.curve.far));
    widen_range(view.curve, view.texel_size(reference_z, c.resolution), scale);
    view.projection = projection_matrix(view.curve, view.half_width, view.half_width);
    light.views.push_back(view);
}

/// Half extent of an orthographic map in metres by hand, or 0.
double manual_half_extent(const LightSettings& s) {
    return s.fit == int(LightFit::Manual) ? positive_or(s.extent, 0) : 0;
}

/// An orthographic map over all boxes (`half` 0) or of a given half extent about the view's axis.
void fit_orthographic(FittedLight& light, LightView view, const FitContext& c, double half, bool in_front_only) {
    const double manual = manual_half_extent(c.settings);
    if (manual > 0) half = manual;
    ViewExtent e = extent_of(c.shape, view);
    if (half <= 0) {
        const glm::dvec3 middle = 0.5 * (e.lo + e.hi);
        view.eye += view.axes * glm::dvec3(middle.x, middle.y, 0);
        half = with_margin(0.5 * std::max(e.hi.x - e.lo.x, e.hi.y - e.lo.y), c.shape.radius, c.resolution);
    }
    view.half_width = half;
    view.curve.perspective = false;
    view.curve.convention = c.convention;
    if (in_front_only) {
        e.lo.z = std::clamp(e.lo.z, 0.0, c.reach_m);
        e.hi.z = std::clamp(e.hi.z, e.lo.z, c.reach_m);
    }
    const double pad = kDepthMargin * (e.hi.z - e.lo.z);
    view.curve.near = e.lo.z - pad;
    view.curve.far = e.hi.z + pad;
    finish_view(light, view, c, 1);
}

/// The range of what lies inside the view's pyramid and the light's range.
DepthCurve perspective_curve(const LightView& view, const FitContext& c) {
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
    for (const Box& box : c.shape.boxes) {
        const ViewExtent e = extent_of(box, view);
        const double entry = entry_into_pyramid(e, view.half_width);
        if (!std::isfinite(entry) || e.hi.z <= 0) continue;
        nearest = std::min(nearest, entry);
        farthest = std::max(farthest, e.hi.z);
    }
    if (!(farthest > 0)) nearest = farthest = std::max(glm::distance(view.eye, c.shape.centre), c.shape.radius);
    nearest = std::min(nearest, c.reach_m);
    farthest = std::min(farthest, c.reach_m);
    DepthCurve curve;
    curve.perspective = true;
    curve.convention = c.convention;
    curve.far = farthest * (1 + kDepthMargin);
    curve.near = std::max(nearest * (1 - kDepthMargin), kNearShare * curve.far);
    return curve;
}

/// A perspective map of tangent `tan_half`; 0 chooses it so that every box is inside.
void fit_perspective(FittedLight& light, LightView view, const FitContext& c, double tan_half) {
    if (tan_half <= 0) {
        double tangent = kMinHalfAngle;
        for (const Box& box : c.shape.boxes)
            for (const glm::dvec3& p : box) {
                const glm::dvec3 v = glm::transpose(view.axes) * (p - view.eye);
                const double aside = std::max(std::abs(v.x), std::abs(v.y));
                tangent = std::max(tangent, -v.z > 0 ? aside / -v.z : std::tan(kMaxHalfAngle));
            }
        const double limit = std::tan(kMaxHalfAngle);
        tan_half = std::min(with_margin(tangent, tangent, c.resolution), limit);
        if (tan_half == limit) note(light, "the light stands in the scene: its map covers 172 degrees only");
    }
    view.half_width = tan_half;
    view.curve = perspective_curve(view, c);
    finish_view(light, view, c, view.curve.far);
}

/// Right, up and back of the six faces, oriented like the faces of a GL cube map.
const std::array<glm::dmat3, 6>& cube_axes() {
    static const std::array<glm::dmat3, 6> axes = [] {
        const std::array<std::pair<glm::dvec3, glm::dvec3>, 6> forward_up = {{{{1, 0, 0}, {0, -1, 0}},
                                                                              {{-1, 0, 0}, {0, -1, 0}},
                                                                              {{0, 1, 0}, {0, 0, 1}},
                                                                              {{0, -1, 0}, {0, 0, -1}},
                                                                              {{0, 0, 1}, {0, -1, 0}},
                                                                              {{0, 0, -1}, {0, -1, 0}}}};
        std::array<glm::dmat3, 6> result;
        for (int i = 0; i < 6; ++i) {
            const auto& [forward, up] = forward_up[i];
            result[i] = glm::dmat3(glm::cross(forward, up), up, -forward);
        }
        return result;
    }();
    return axes;
}

/// Six faces of one range, so that a depth means the same distance in each.
void fit_faces(FittedLight& light, const FitContext& c) {
    std::array<LightView, 6> faces;
    DepthCurve range;
    for (int i = 0; i < 6; ++i) {
        faces[i].eye = light.position;
        faces[i].axes = cube_axes()[i];
        faces[i].half_width = with_margin(1.0, 0, c.resolution, kFaceMarginTexels);
        const DepthCurve curve = perspective_curve(faces[i], c);
        if (i == 0) range = curve;
        range.near = std::min(range.near, curve.near);
        range.far = std::max(range.far, curve.far);
    }
    range.near = std::max(range.near, kNearShare * range.far);
    for (LightView& face : faces) {
        face.curve = range;
        finish_view(light, face, c, range.far);
    }
    if (c.settings.projection == int(LightProjection::Orthographic))
        note(light, "six faces are always perspective: light.projection has no effect");
}

/// Half the cone's angle in radians, clamped; `wide` when one map cannot hold it.
double half_cone(FittedLight& light, const LightSettings& s, bool& wide) {
    double half = 0.5 * s.cone * kDegree;
    if (std::isnan(half) || half < kMinHalfAngle) {
        note(light, fmt::format("light.cone {:.4g} degrees is too narrow: {:.3g} is used", s.cone,
                                2 * kMinHalfAngle / kDegree));
        half = kMinHalfAngle;
    }
    wide = half > kMaxHalfAngle;
    if (half > std::numbers::pi) half = std::numbers::pi;
    return half;
}

void fit_directional(FittedLight& light, const FitContext& c, const glm::dvec3& target) {
    const bool perspective = c.settings.projection == int(LightProjection::Perspective);
    const double automatic = (perspective ? 4 : 2) * c.shape.radius;
    LightView view;
    view.axes = orthonormal_basis(light.to_light);
    view.eye = target + light.to_light * positive_or(c.settings.distance, automatic);
    light.position = view.eye;
    if (perspective)
        fit_perspective(light, view, c, 0);
    else
        fit_orthographic(light, view, c, 0, false);
}

void fit_spot(FittedLight& light, const FitContext& c, const glm::dvec3& target) {
    bool wide = false;
    const double half = half_cone(light, c.settings, wide);
    const double blend = std::clamp(finite_or(c.settings.cone_blend, 0), 0.0, 1.0);
    light.cos_cone_outer = std::cos(half);
    light.cos_cone_inner = std::cos(half * (1 - blend));
    // Automatic: far enough for the sphere around the scene to fit into the cone.
    const double automatic = c.shape.radius / std::sin(std::min(half, kMaxHalfAngle));
    const double distance = positive_or(c.settings.distance, automatic);
    light.position = target + light.to_light * distance;
    if (wide) {
        note(light, "the cone is wider than one map can hold: it is drawn as six faces");
        return fit_faces(light, c);
    }
    LightView view;
    view.eye = light.position;
    view.axes = orthonormal_basis(light.to_light);
    // As the cone's circle touches the map's sides, only kernels at its rim need the margin.
    const double tangent = with_margin(std::tan(half), 0, c.resolution);
    if (c.settings.projection == int(LightProjection::Orthographic))
        fit_orthographic(light, view, c, tangent * distance, true);
    else
        fit_perspective(light, view, c, tangent);
}

void fit_point(FittedLight& light, const FitContext& c, const glm::dvec3& target) {
    light.position = target + light.to_light * positive_or(c.settings.distance, 1.5 * c.shape.radius);
    fit_faces(light, c);
}

/// Whether any box begins within the range; along the views' axes, so that a few may pass that do not.
bool reaches_anything(const FittedLight& light, const SceneShape& shape) {
    return std::any_of(shape.boxes.begin(), shape.boxes.end(), [&](const Box& box) {
        return std::any_of(light.views.begin(), light.views.end(), [&](const LightView& view) {
            const ViewExtent e = extent_of(box, view);
            const double z = view.curve.perspective ? entry_into_pyramid(e, view.half_width) : e.lo.z;
            return e.hi.z > 0 && z < light.range_m;
        });
    });
}

/// Divides spot and point radiances by what the brightest of them brings to the scene's centre, where the shaders'
/// 1/d^2 makes it 1 again. Nearer than a quarter of the scene's radius counts as that far.
void normalise_punctual(std::vector<FittedLight>& lights, const Settings& settings, const SceneShape& shape) {
    double brightest = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (lights[i].type == LightType::Directional) continue;
        const double d = std::max(glm::distance(lights[i].position, shape.centre), 0.25 * shape.radius);
        const double intensity = positive_or(settings.lights[i].intensity, 0);
        brightest = std::max(brightest, intensity / (d * d));
    }
    if (!(brightest > 0)) return;
    for (FittedLight& light : lights)
        if (light.type != LightType::Directional) light.radiance /= brightest;
}

}  // namespace

glm::dmat3 orthonormal_basis(const glm::dvec3& n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    const double b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

glm::dvec3 direction_from_angles(double azimuth_deg, double elevation_deg) {
    const SineCosine az = sine_cosine(azimuth_deg), el = sine_cosine(elevation_deg);
    return glm::dvec3(el.cosine * az.sine, el.sine, el.cosine * az.cosine) + 0.0;  // no zero has a sign
}

std::vector<FittedLight> fit_lights(const Scene& scene, const Settings& settings, int max_resolution) {
    const SceneShape shape = scene_shape(scene, settings);
    const int resolution = std::clamp(settings.map.resolution, 1, std::max(1, max_resolution));
    const int count = std::clamp(settings.light_count, 0, kMaxLights);
    std::vector<FittedLight> lights(count);
    for (int i = 0; i < count; ++i) {
        const LightSettings& s = settings.lights[i];
        FittedLight& light = lights[i];
        light.type = LightType(std::clamp(s.type, 0, 2));
        light.to_light = direction_from_angles(finite_or(s.azimuth, -40), finite_or(s.elevation, 45));
        light.radiance = positive_or(s.intensity, 0) *
                         glm::dvec3(positive_or(s.red, 0), positive_or(s.green, 0), positive_or(s.blue, 0));
        const glm::dvec3 target =
            shape.centre + glm::dvec3(finite_or(s.target_x, 0), finite_or(s.target_y, 0), finite_or(s.target_z, 0));
        light.target = target;
        light.map_origin = shape.centre;
        light.range_m = range_of(s);
        const FitContext context{shape,
                                 s,
                                 {true, settings.map.reversed_z},
                                 resolution,
                                 light.range_m > 0 ? light.range_m : std::numeric_limits<double>::infinity()};
        switch (light.type) {
            case LightType::Directional:
                fit_directional(light, context, target);
                break;
            case LightType::Spot:
                fit_spot(light, context, target);
                break;
            case LightType::Point:
                fit_point(light, context, target);
                break;
        }
        if (light.range_m > 0 && !reaches_anything(light, shape))
            note(light, fmt::format("light.range: nothing lies within {:.4g} m of light {}", light.range_m, i));
        if (!s.cast)
            light.reason = "light.cast is off";
        else if (!shape.triangles)
            light.reason = "the scene has no triangles";
        else if (!shape.casters)
            light.reason = "no object casts";
        else if (!shape.receivers)
            light.reason = "no object receives shadows";
        light.casts = light.reason.empty();
        if (!light.casts) continue;
        light.clipped_casters = count_clipped(shape, light.views);
        light.limits = map_limits(shape, light.views, MapFormat(settings.map.format), resolution);
        for (std::string& text : map_limit_notes(light.limits, i)) note(light, std::move(text));
    }
    normalise_punctual(lights, settings, shape);
    return lights;
}

glm::dmat4 LightView::clip_from_relative(const glm::dvec3& origin) const {
    return si::clip_from_relative(projection, axes, eye, origin);
}

glm::dvec3 LightView::position_ws(const glm::dvec2& uv, double z) const {
    const double half = half_width * (curve.perspective ? z : 1.0);
    return eye + axes * glm::dvec3((2.0 * uv - 1.0) * half, -z);
}

}  // namespace si
