// Fits of warped maps (LiSPSM): directional maps with a perspective across their rays, so that texels near the camera
// are smaller.
// Wimmer, Scherzer, Purgathofer, Light Space Perspective Shadow Maps, EGSR 2004.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "renderer/base/finite.h"
#include "renderer/settings/fits.h"
#include "renderer/view/bounds/convex.h"
#include "renderer/view/fits/fit_context.h"
#include "renderer/view/fits/near_far.h"

namespace si {
namespace {

constexpr double kMinSine = 1e-9;  // least sine of the angle between light and view at which `across` has a direction
constexpr double kRimShare = 0.5;  // least 1 / w at the map's rim, as a share of 1 / w at the farthest point

/// A range of numbers.
struct Extent {
    double lo = std::numeric_limits<double>::infinity(), hi = -std::numeric_limits<double>::infinity();
    void add(double v) {
        lo = std::min(lo, v);
        hi = std::max(hi, v);
    }
    double size() const { return hi - lo; }
    double middle() const { return 0.5 * (lo + hi); }
    void widen(double least) {
        if (size() < least) *this = {middle() - 0.5 * least, middle() + 0.5 * least};
    }
};

/// Turns the view so that the camera looks up in its map.
/// @return the sine of the angle between light and view
double turn_to_camera(LightView& view, const Camera& camera) {
    const glm::dvec3 back = view.axes[2], forward = -camera.axes[2];
    const auto across = [&](const glm::dvec3& v) { return v - glm::dot(v, back) * back; };
    glm::dvec3 up = across(forward);
    const double sine = glm::length(up);
    // Direction for a light parallel to the viewing direction, from behind the camera or towards it.
    if (sine < kMinSine) up = across(glm::dot(forward, back) > 0 ? -camera.axes[1] : camera.axes[1]);
    up = glm::normalize(up);
    view.axes = glm::dmat3(glm::cross(up, back), up, back);
    return sine;
}

/// Returns the relative growth of the divisor w per metre along y at the middle of the map, y = 0. The result is 1 over
/// the distance to the plane w = 0; the paper's n_opt counts from the nearest y.
/// @param depths camera depths of the points in the map
/// @param length_m length of the points along y
/// @param most_ratio largest growth of w over that length
double rise_of_w(const Extent& depths, double length_m, double sine, double most_ratio) {
    const double near = std::max(depths.lo, kMinSeenDepthShare * depths.hi);
    // The paper's formula times the sine. A sine of 0 makes n_opt infinite, and nothing is warped.
    const double n_opt_sine = near + std::sqrt(near * (near + length_m * sine));
    const double least_sine = length_m / (most_ratio - 1) * sine;
    return sine / (std::max(n_opt_sine, least_sine) + 0.5 * length_m * sine);
}

/// Returns the length in metres of the longest texel in a row of the map.
double texel_in_row(const LightView& view, double row, int resolution) {
    const auto longest = [&](double u) {
        return view.texel_size_at(view.position_ws({u, row}, 0), resolution).longest;
    };
    return std::max(longest(0), longest(1));
}

/// Returns the warped view with a margin in texels on each side of the points.
/// @param deep points that count along the rays only
LightView warped_view(LightView view, const FitContext& c, const Camera& camera, std::span<const glm::dvec3> points,
                      std::span<const glm::dvec3> deep, double margin) {
    const double sine = turn_to_camera(view, camera);
    const glm::dmat3 to_view = glm::transpose(view.axes);
    Extent x, y;
    for (const glm::dvec3& p : points) {
        const glm::dvec3 at = to_view * (p - view.eye);
        x.add(at.x);
        y.add(at.y);
    }
    // x = 0 passes through the camera, so that both sides are widened equally.
    view.eye += view.axes * glm::dvec3((to_view * (camera.eye - view.eye)).x, y.middle(), 0);
    Extent camera_depths, depths;
    for (const glm::dvec3& p : points) {
        camera_depths.add(glm::dot(p - camera.eye, -camera.axes[2]));
        depths.add(glm::dot(view.eye - p, view.axes[2]));
    }
    const double share = c.resolution > 4 * margin ? 1 - 2 * margin / c.resolution : 0.5;
    // The margin extends the map to where 1 / w falls to half its value at the farthest point, never to 0.
    const double most_ratio = 1 + (1 - kRimShare) * 2 * share / (1 - share);
    double k = 0;
    if (!camera.orthographic && camera_depths.hi > 0) k = rise_of_w(camera_depths, y.size(), sine, most_ratio);

    // Across the rays: u = x / w and v = y / w, with w = 1 + k y, stretched over the map.
    const auto w_at = [&](double at_y) { return 1 + k * at_y; };
    Extent u, v;
    for (const glm::dvec3& p : points) {
        const glm::dvec3 at = to_view * (p - view.eye);
        u.add(at.x / w_at(at.y));
        v.add(at.y / w_at(at.y));
    }
    const double least_m = half_extent_with_margin(0, c.shape.radius, c.resolution, 0);
    u.widen(2 * least_m);
    v.widen(2 * least_m);
    const double au = 2 * share / u.size(), bu = -au * u.middle(), av = 2 * share / v.size(), bv = -av * v.middle();
    view.curve.convention = c.convention;
    view.curve.warp = DepthWarp{};
    view.projection = glm::dmat4(0.0);
    view.projection[0][0] = au;
    view.projection[1][0] = bu * k;
    view.projection[3][0] = bu;
    view.projection[1][1] = av + bv * k;
    view.projection[3][1] = bv;
    view.projection[1][3] = k;
    view.projection[3][3] = 1;
    // 1 / w is 1 - k y / w, and so falls evenly over the map.
    const auto inverse_w = [&](double ndc) { return 1 - k * (ndc - bv) / av; };
    const auto near_far = c.settings.near_far;
    view.clamps_near = near_far == NearFar::Pancaking;

    // Along the rays depth is (z - middle) / w, so its unit grows away from the camera. It counts from the middle of
    // the visible points to lose little of the range. Points between the map's sides bound the range.
    std::vector<HalfSpace> sides;
    const auto add_side = [&](const glm::dvec2& normal, double offset) {
        const double length = glm::length(normal);
        sides.push_back(HalfSpace::through(view.eye - view.axes * glm::dvec3(normal * (offset / (length * length)), 0),
                                           view.axes * glm::dvec3(normal / length, 0)));
    };
    for (const double side : {-1.0, 1.0}) {  // w + side * (clip x or y) >= 0
        add_side({side * au, k * (1 + side * bu)}, 1 + side * bu);
        add_side({0, side * av + k * (1 + side * bv)}, 1 + side * bv);
    }
    const double middle = depths.middle();
    Extent all;
    const auto depth_of = [&](const glm::dvec3& p) {
        const glm::dvec3 at = to_view * (p - view.eye);
        return (-at.z - middle) / w_at(at.y);
    };
    Extent casters;
    for (std::size_t i = 0; i < c.shape.boxes.size(); ++i)
        if (near_far == NearFar::Scene || (near_far != NearFar::Pancaking && c.shape.box_casts[i]))
            for (const glm::dvec3& p : points_inside_planes(c.shape, i, sides)) casters.add(depth_of(p));
    for (const glm::dvec3& p : points) all.add(depth_of(p));
    for (const glm::dvec3& p : deep) all.add(depth_of(p));
    // A caster behind all receivers does not bound the near end.
    if (casters.lo <= all.hi) all.lo = near_far == NearFar::Casters ? casters.lo : std::min(all.lo, casters.lo);
    if (near_far == NearFar::Scene) all.hi = std::max(all.hi, casters.hi);
    // Metres per depth step and per texel are largest at one end of the map.
    double room = 0, texel = 0;
    for (const double row : {0.0, 1.0}) {
        const double w = 1 / inverse_w(2 * row - 1), longest = texel_in_row(view, row, c.resolution);
        texel = std::max(texel, longest / w);
        if (view.clamps_near) room = std::max(room, near_margin_for_bias_m(c, longest, all.size() * w) / w);
    }
    all.widen(std::max(2 * texel, least_m));
    const double pad = kDepthMargin * all.size();
    // A floor facing the light has no depth of its own, so the pad is a texel.
    const double begin = all.lo - pad - room;
    const double end = all.hi + pad + (view.clamps_near ? texel : 0) + ground_kernel_depth_m(view, c, texel);

    const bool reversed = c.convention.reversed;
    // Depth rises by ad per unit of (z - middle) / w from bd.
    double ad = (reversed ? -1 : 1) / (end - begin), bd = (reversed ? end : -begin) / (end - begin);
    if (!c.convention.zero_to_one) {
        ad *= 2;
        bd = 2 * bd - 1;
    }
    glm::dmat4& m = view.projection;
    m[2][2] = -ad;
    m[1][2] = bd * k;
    m[3][2] = bd - ad * middle;

    const double front = inverse_w(-1), behind = inverse_w(1);
    view.curve.warp = DepthWarp{middle, begin / front, end / front, behind / front - 1};
    const DepthCurve low = view.curve.curve_at_row(0), high = view.curve.curve_at_row(1);
    view.curve.near = std::min(low.near, high.near);
    view.curve.far = std::max(low.far, high.far);
    return view;
}

/// Returns true when points lie inside a warped map of other points across the rays, up to rounding.
bool holds_across(const LightView& view, std::span<const glm::dvec3> points, std::span<const glm::dvec3> others) {
    const glm::dmat4 m = view.clip_from_relative(view.eye);
    Extent x, y;
    const auto map = [&](const glm::dvec3& p) { return m * glm::dvec4(p - view.eye, 1); };
    for (const glm::dvec3& p : points) {
        const glm::dvec4 h = map(p);
        x.add(h.x / h.w);
        y.add(h.y / h.w);
    }
    return std::ranges::all_of(others, [&](const glm::dvec3& p) {
        const glm::dvec4 h = map(p);
        const auto within = [&](double at, const Extent& e) {
            return at >= e.lo - kMinGroundWidening && at <= e.hi + kMinGroundWidening;
        };
        return h.w > 0 && within(h.x / h.w, x) && within(h.y / h.w, y);
    });
}

}  // namespace

void fit_warped(FittedLight& light, LightView view, const FitContext& c, const Camera& camera,
                std::span<const glm::dvec3> points, std::span<const glm::dvec3> on_ground, double margin) {
    Extent depths;
    for (const glm::dvec3& p : points) depths.add(glm::dot(view.axes[2], view.eye - p));
    view.eye -= view.axes[2] * eye_advance_m(depths.lo, depths.hi);
    LightView warped = warped_view(view, c, camera, points, {}, margin);
    std::vector<glm::dvec3> seen(points.begin(), points.end());
    if (!on_ground.empty()) {
        if (!holds_across(warped, points, on_ground)) seen.insert(seen.end(), on_ground.begin(), on_ground.end());
        warped = warped_view(view, c, camera, seen, on_ground, margin);
    }
    // The normal offset is a length, or a multiple of the longest side of a texel, so the margin in texels does not
    // cover it. A wider map has longer texels.
    const double normal = std::abs(finite_or(c.all_settings.bias.normal, 0));
    std::vector<glm::dvec3> held;
    for (int i = 0; i < 3 && normal > 0; ++i) {
        held = seen;
        for (const glm::dvec3& p : seen) {
            const double offset =
                c.normal_m != 0 ? std::abs(c.normal_m) : normal * warped.texel_size_at(p, c.resolution).longest;
            for (int axis = 0; axis < 2; ++axis)
                for (const double by : {-offset, offset}) held.push_back(p + by * warped.axes[axis]);
        }
        warped = warped_view(view, c, camera, held, on_ground, margin);
    }
    if (camera.orthographic)
        add_note(light,
                 "light.fit lispsm: an orthographic camera sees all depths at one size, so its map is not warped");
    if (uses_manual_near_far(c.settings))
        add_note(light, "light.fit lispsm: near and far by hand have no effect on a warped map");
    light.views.push_back(warped);
}

}  // namespace si
