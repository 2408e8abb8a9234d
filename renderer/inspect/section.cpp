#include "renderer/inspect/section.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/reference/artefact_picture.h"
#include "renderer/reference/first_surface.h"
#include "renderer/view/lights/kernel_reach.h"

namespace si {
namespace {

constexpr int kRaysPerTexel = 8;
constexpr int kMinSideTexels = 4;   ///< texels to either side of the look-up that are always shown
constexpr int kMaxEdgeTexels = 10;  ///< distance up to which a shadow edge is shown, too

const LightView& view_of(const Probe::PerLight& p) {
    return p.fitted.views[std::size_t(p.face)];
}

/// Plane of a cut, with conversion of world space to the plane's own metres. The plane holds the look-up, the line of
/// the map through it, and the rays to that line. Other points are projected along the normal.
class CutPlane {
public:
    CutPlane(const Probe::PerLight& p, int axis, MapSize size)
        : n(size.sides()[axis]), view_(view_of(p)), axis_(axis), tap_(p.account.receiver.tap) {
        const bool perspective = view_.curve.perspective;
        tap_m = perspective ? p.account.receiver.tap_m : curve().distance(tap_.z);
        origin_ = view_.position_ws(glm::dvec2(p.account.receiver.uvd), p.account.receiver.own_m);
        const glm::dvec3 here = world(tap_[axis], tap_m);
        up_ = glm::normalize(perspective ? view_.eye - here : view_.axes[2]);
        const double step = 0.5 / n;
        const glm::dvec3 across = world(tap_[axis] + step, tap_m) - world(tap_[axis] - step, tap_m);
        right_ = glm::normalize(across - up_ * glm::dot(across, up_));
        texel_m = glm::dot(across, right_);
        texel_long_m = glm::length(across);
        light_ray = glm::normalize(in_cut(perspective ? view_.eye - origin_ : view_.axes[2]));
    }

    glm::dvec2 at(double along, double axis_m) const { return in_cut(world(along, axis_m) - origin_); }
    glm::dvec3 world(double along, double axis_m) const {
        glm::dvec2 uv(tap_);
        uv[axis_] = along;
        return view_.position_ws(uv, axis_m);
    }
    /// Returns the unit vector towards the light at a point, in the cut.
    glm::dvec2 ray(double along, double axis_m) const {
        const glm::dvec2 d = at(along, 0.99 * axis_m - (view_.curve.perspective ? 0 : 1)) - at(along, axis_m);
        return d / glm::length(d);
    }
    /// Returns the depth curve in the row of the look-up. In a cut along u it holds for all rays of a warped map.
    DepthCurve curve() const { return view_.curve.curve_at_row(tap_.y); }
    /// Returns the metres along the axis at a depth nearer to the light than the look-up by `depth`.
    double nearer_m(double depth) const {
        const double z = tap_m - curve().metres_towards_light(tap_m, depth);
        if (!view_.curve.perspective) return z;
        return std::clamp(z, 1e-3 * view_.curve.near, 4 * std::max(view_.curve.far, tap_m));
    }
    double metres(double depth) const { return nearer_m(towards() * (tap_.z - depth)); }
    /// Returns 1 when nearer surfaces have smaller depths, else -1.
    double towards() const { return view_.curve.convention.reversed ? -1 : 1; }

    double tap_along() const { return tap_[axis_]; }
    int n;                       ///< texels of the map along the axis of the cut
    double tap_m = 1;            ///< metres from the light along its axis at the look-up
    double texel_m = 1;          ///< width of a texel at the look-up, across the light's ray
    double texel_long_m = 1;     ///< width of a texel along the map
    glm::dvec2 light_ray{0, 1};  ///< unit vector from the surface towards the light

private:
    const LightView& view_;
    int axis_;
    glm::dvec3 tap_;
    glm::dvec3 origin_{0}, up_{0, 1, 0}, right_{1, 0, 0};

    glm::dvec2 in_cut(const glm::dvec3& way) const { return {glm::dot(way, right_), glm::dot(way, up_)}; }
};

/// Returns the number of texels from the look-up to the nearest shadow edge in a row.
int change_within(const std::vector<KernelTap>& row) {
    const auto occludes = [&](int i) { return row[std::size_t(i)].meets == KernelTap::Meets::Nearer; };
    const int middle = int(row.size()) / 2;
    for (int d = 1; d <= middle; ++d)
        if (occludes(middle - d) != occludes(middle) || occludes(middle + d) != occludes(middle)) return d;
    return middle + 1;
}

glm::dvec2 unit(const glm::dvec2& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec2(1, 0);
}

/// Splits points into surfaces. Neighbouring points belong to one surface when the slope continues.
std::vector<std::vector<glm::dvec2>> surfaces(const std::vector<glm::dvec2>& points, double texel_m) {
    std::vector<std::vector<glm::dvec2>> out;
    const auto known = [&](std::size_t i) { return i < points.size() && std::isfinite(points[i].y); };
    const auto goes_on = [&](std::size_t i) {
        const double rise = points[i + 1].y - points[i].y, step = texel_m / kRaysPerTexel;
        const auto as_before = [&](std::size_t from) {
            return known(from) && known(from + 1) &&
                   std::abs(points[from + 1].y - points[from].y - rise) < 0.5 * step + 0.1 * std::abs(rise);
        };
        return std::abs(rise) < 2 * step || (i > 0 && as_before(i - 1)) || as_before(i + 1);
    };
    bool open = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!known(i)) {
            open = false;
            continue;
        }
        if (!open) out.emplace_back();
        out.back().push_back(points[i]);
        open = known(i + 1) && goes_on(i);
    }
    return out;
}

void add_steps(Section& s, const Probe::PerLight& p, const CutPlane& plane, MapSize size) {
    const int row_count = size.sides()[1 - s.cut.axis];
    for (const KernelTap& t : p.rows[std::size_t(s.cut.axis)]) {
        const int i = t.texel[s.cut.axis];
        if (i < s.cut.first || i >= s.cut.first + s.cut.count) continue;
        const double from = double(i) / plane.n, to = double(i + 1) / plane.n;
        const double compared_m = plane.metres(t.compared);
        Section::Step step{.texel = i,
                           .from = plane.at(from, t.stored_m),
                           .to = plane.at(to, t.stored_m),
                           .from_ray = plane.ray(from, t.stored_m),
                           .to_ray = plane.ray(to, t.stored_m),
                           .compared_from = plane.at(from, compared_m),
                           .compared_to = plane.at(to, compared_m),
                           .stored = t.stored,
                           .stored_m = t.stored_m,
                           .weight = t.weight,
                           .lit = t.lit,
                           .in_map = i >= 0 && i < plane.n && s.row >= 0 && s.row < row_count,
                           .meets = t.meets};
        s.steps.push_back(step);
    }
}

void add_terms(Section& s, const Probe::PerLight& p, const CutPlane& plane) {
    const BiasBreakdown& a = p.account;
    double spent = 0;
    const auto add = [&](const char* name, double depth) {
        if (depth == 0 || !std::isfinite(depth)) return;
        const double from = plane.nearer_m(spent), to = plane.nearer_m(spent + depth);
        s.terms.push_back({name, a.amount(depth), plane.at(plane.tap_along(), from), plane.at(plane.tap_along(), to)});
        spent += depth;
    };
    add("constant bias", a.constant);
    add("slope bias", a.slope);
    add("bias of the plane", a.bias_of_kind);
    s.raster = a.amount(a.raster);
}

void add_moments(Section& s, const Probe::PerLight& p, const CutPlane& plane) {
    const KernelFacts& k = p.kernel;
    if (std::isnan(k.bound) || std::isnan(k.mean)) return;
    const DepthCurve curve = plane.curve();
    const double near = curve.distance(curve.convention.near_depth());
    const double range = curve.distance(curve.convention.far_depth()) - near;
    const auto y = [&](double share) { return plane.at(plane.tap_along(), near + share * range).y; };
    Section::Moments m{.mean = y(k.mean), .spread = KernelFacts::kUnknown, .bound = k.bound};
    if (k.variance >= 0) m.spread = std::abs(y(k.mean) - y(k.mean - std::sqrt(k.variance)));
    s.moments = m;
}

void add_reference(Section& s, const Probe::PerLight& p, const PixelDiagnosis& d) {
    for (const ArtefactStyle& style : artefact_styles())
        if (style.artefact == d.cause().artefact) s.artefact = style.label;
    if (d.reference.state != PixelState::Counted) return;
    s.least = d.least;
    s.has = d.has;
    s.shift = d.shift;
    s.occluder_in_map = std::isfinite(d.reference.gap_m);
    const double gap = s.occluder_in_map ? d.reference.gap_m : d.reference.blocker_m;
    if (std::isfinite(gap)) {
        s.occluder = gap * s.light_ray;
        s.occluder_m = gap;
    }
    if (!std::isfinite(d.least.depth) || p.account.plane.edge_on()) return;
    // Both ends count from the surface. After an offset h along the normal the plane at the look-up lies h sin^2 / cos
    // below the surface. Counted from there, the near end would move by as much and the far end would not.
    s.window_from = d.least.metres;
    if (std::isfinite(d.occluder.depth)) s.window_to = d.occluder.metres;
    s.has_window = true;
}

}  // namespace

const Section::Step* Section::find_step(int texel) const {
    for (const Step& step : steps)
        if (step.texel == texel) return &step;
    return nullptr;
}

SectionCut section_cut(const Probe::PerLight& p, const PixelDiagnosis* d, const Settings& settings, MapSize size) {
    SectionCut cut;
    if (!p.casts || p.rows[0].empty() || size.shortest() <= 0) return cut;
    const glm::dvec2 gradient = glm::abs(p.account.plane.gradient);
    cut.axis = gradient.y > gradient.x ? 1 : 0;
    // The cut does not depend on bias: along the plane's slope where the light sees the surface and no shadow edge is
    // near, else across the nearest edge.
    const int change[2] = {change_within(p.rows[0]), change_within(p.rows[1])};
    const bool at_an_edge = !d || !d->reference.lit || std::min(change[0], change[1]) <= kMaxEdgeTexels;
    if (at_an_edge && change[0] != change[1]) cut.axis = change[1] < change[0] ? 1 : 0;
    // Moment kernels read blurred texels, so their reach comes from the settings. Other kernels record their texels.
    const int look_up = p.texel[cut.axis];
    if (p.taps.empty()) {
        cut.reach_texels = kernel_reach_in_light(settings, p.fitted, size).read;
    } else {
        const int last = p.taps_first[cut.axis] + p.taps_size[cut.axis];
        cut.reach_texels = 0.5 + std::max(look_up - p.taps_first[cut.axis], last - 1 - look_up);
    }
    const int edge = change[cut.axis] <= kMaxEdgeTexels ? change[cut.axis] + 2 : 0;
    const int side = std::clamp(std::max(int(std::ceil(std::min(cut.reach_texels, 1e3))) + 2, edge), kMinSideTexels,
                                kProbeRowReachTexels);
    const double moved = (p.account.receiver.tap[cut.axis] - p.account.receiver.uvd[cut.axis]) * size.sides()[cut.axis];
    const int back = int(std::clamp(std::ceil(std::abs(moved)), 0.0, double(kProbeRowReachTexels)));
    const int first = std::max(look_up - std::max(side, moved > 0 ? back + 2 : 0), look_up - kProbeRowReachTexels);
    const int last = std::min(look_up + std::max(side, moved < 0 ? back + 2 : 0), look_up + kProbeRowReachTexels);
    cut.first = first;
    cut.count = last - first + 1;
    return cut;
}

std::vector<ReferencePoint> reference_profile(const ReferenceScene& scene, const Probe::PerLight& p,
                                              const SectionCut& cut, MapSize size) {
    std::vector<ReferencePoint> out;
    if (cut.count <= 0) return out;
    const CutPlane plane(p, cut.axis, size);
    const Bounds& bounds = scene.geometry().bounds;
    const double extent_m = bounds.empty() ? 0 : glm::length(bounds.hi - bounds.lo);
    // Parallel rays begin before all casters, others at the light.
    const DepthCurve curve = plane.curve();
    const double from_m =
        curve.perspective ? 1e-3 * curve.near : std::min(curve.near, p.account.receiver.own_m - extent_m);
    const double to_m = std::max(p.account.receiver.own_m + std::max(extent_m, plane.texel_m), 2 * from_m);
    std::vector<LightRaySegment> ways;
    for (int i = 0; i <= cut.count * kRaysPerTexel; ++i) {
        const double along = (cut.first + double(i) / kRaysPerTexel) / size.sides()[cut.axis];
        out.push_back({along, 0});
        ways.push_back({plane.world(along, from_m), plane.world(along, to_m)});
    }
    const std::vector<double> first = first_caster_distances(scene, ways);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double share = first[i] / glm::length(ways[i].to_ws - ways[i].from_ws);
        out[i].axis_m = from_m + share * (to_m - from_m);
    }
    return out;
}

Section cross_section(const Probe::PerLight& p, const PixelDiagnosis* d, const SectionCut& cut, MapSize size,
                      std::span<const ReferencePoint> profile) {
    Section s;
    s.cut = cut;
    s.light = p.fitted.type;
    s.visibility = p.visibility;
    s.lit = p.visibility >= 0.5;
    s.classified = d != nullptr;
    s.verdict = d ? d->verdict : p.verdict;
    s.reference_lit = !d || d->reference.lit;
    s.tested = !d || d->reference.state == PixelState::Counted;
    s.shadowed = cut.count > 0;
    if (!s.shadowed) return s;
    const BiasBreakdown& a = p.account;
    const CutPlane plane(p, cut.axis, size);
    s.row = p.texel[1 - cut.axis];
    s.row_offset_texels = s.row + 0.5 - p.account.receiver.tap[1 - cut.axis] * size.sides()[1 - cut.axis];
    s.lookup_texel = p.texel[cut.axis];
    s.surface_offset_texels =
        (p.account.receiver.uvd[1 - cut.axis] - p.account.receiver.tap[1 - cut.axis]) * size.sides()[1 - cut.axis];
    s.texel_m = plane.texel_m;
    s.texel_long_m = plane.texel_long_m;
    s.light_m = view_of(p).curve.perspective ? p.account.receiver.own_m : p.account.receiver.own_m - plane.curve().near;
    s.theta_rad = a.theta_rad;
    s.per_texel = a.per_texel;
    s.normal_offset_m = p.account.receiver.normal_offset_m;
    s.light_ray = plane.light_ray;
    s.moved = plane.at(plane.tap_along(), plane.tap_m);
    s.compared = plane.at(plane.tap_along(), plane.metres(p.compared));
    if (a.plane.edge_on()) {
        s.surface_along = {0, 1};
    } else {
        glm::dvec2 other(p.account.receiver.tap);
        const auto on_surface = [&](double along) {
            other[cut.axis] = along;
            const double nearer = plane.towards() * (p.account.receiver.tap.z - a.plane.depth_at(other));
            return plane.at(along, plane.nearer_m(nearer));
        };
        const double at = p.account.receiver.uvd[cut.axis], step = 0.25 / plane.n;
        s.surface_at = on_surface(at);
        s.surface_along = unit(on_surface(at + step) - on_surface(at - step));
    }
    add_steps(s, p, plane, size);
    add_terms(s, p, plane);
    add_moments(s, p, plane);
    if (d) add_reference(s, p, *d);
    std::vector<glm::dvec2> points;
    for (const ReferencePoint& point : profile) points.push_back(plane.at(point.along, point.axis_m));
    s.profile = surfaces(points, s.texel_m);
    return s;
}

Section pixel_section(const Probe& probe, std::size_t light, std::span<const PixelDiagnosis> diagnoses,
                      const Settings& settings, const ReferenceScene* casters) {
    const Probe::PerLight& p = probe.lights[light];
    const PixelDiagnosis* const diagnosis = light < diagnoses.size() ? &diagnoses[light] : nullptr;
    const SectionCut cut = section_cut(p, diagnosis, settings, probe.map_size);
    std::vector<ReferencePoint> profile;
    if (casters && diagnosis) profile = reference_profile(*casters, p, cut, probe.map_size);
    return cross_section(p, diagnosis, cut, probe.map_size, profile);
}

}  // namespace si
