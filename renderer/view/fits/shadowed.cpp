// Regions across a light's view in which casters shadow receivers, for the fits that narrow a map. Brabec, Annen,
// Seidel, Practical Shadow Mapping, Journal of Graphics Tools 7(4), 2002, call that of the fit `view` the focus of a
// shadow map.
#include <algorithm>
#include <span>
#include <vector>

#include "renderer/view/bounds/convex.h"
#include "renderer/view/bounds/flat_mesh.h"
#include "renderer/view/cascades/cascades.h"
#include "renderer/view/fits/region.h"

namespace si {
namespace {

constexpr double kViewBegins = 1e-4;  // start of a perspective view, as a share of the farthest corner's distance
constexpr double kEdgeOn = 1e-6;      // cosine up to which rounding decides the lit side of a plane
constexpr std::size_t kMaxShadowPairs = 1 << 18;  // pairs of casters and receivers that are compared
constexpr std::size_t kMaxTriangles = 1 << 19;    // receiver triangles that are clipped
constexpr double kLarge = 0.25;  // caster area, as a share of the receivers' area, from which its shape counts
constexpr std::size_t kMaxOutlineVertices = 4096;  // vertices of a caster whose outline is found
constexpr std::size_t kMaxOutlineEdges = 256;      // edges of an outline

MapRegion across(const ViewExtent& e) {
    return {glm::dvec2(e.lo), glm::dvec2(e.hi)};
}

/// Returns a point in view space: x and y as in MapRegion, z metres along the axis.
glm::dvec3 seen_from_light(const LightView& view, const glm::dvec3& p) {
    const glm::dvec3 v = glm::transpose(view.axes) * (p - view.eye);
    return view.curve.perspective ? glm::dvec3(v.x / -v.z, v.y / -v.z, -v.z) : glm::dvec3(v.x, v.y, -v.z);
}

ViewExtent seen_from_light(const LightView& view, std::span<const glm::dvec3> points) {
    ViewExtent e;
    for (const glm::dvec3& p : points) e.add(seen_from_light(view, p));
    return e;
}

bool is_within(const ViewExtent& e, const LightView& view, double near, double far) {
    const auto section = view.cross_section();
    const auto is_between = [&](int axis) {
        return e.lo[axis] >= e.lo.z * section.lo[axis] && e.hi[axis] <= e.lo.z * section.hi[axis];
    };
    return e.lo.z >= near && e.hi.z <= far && is_between(0) && is_between(1);
}

/// Returns the extent of the part of a box that a light can reach; x and y as in MapRegion, z in metres. Empty if the
/// light reaches no part.
/// @param box index into SceneShape::boxes
/// @param seen a slice of the camera's frustum; only the part inside it counts
ViewExtent lit_extent(const FitInput& in, std::size_t box, const CameraSlice* seen = nullptr) {
    const Box& corners = in.shape.boxes[box];
    const auto all = [&] {
        return seen ? seen->visible_points(in.shape, box) : points_inside_planes(in.shape, box, {});
    };
    if (!in.view.curve.perspective) return seen_from_light(in.view, all());
    const ViewExtent e = extent_in_view(corners, in.view);
    const double far = std::min(e.hi.z, in.reach_m), near = kViewBegins * far;
    if (!(far > 0) || e.lo.z > far) return {};
    if (is_within(e, in.view, near, far)) return seen_from_light(in.view, all());
    const Box pyramid = view_pyramid(in.view, near, far);
    if (seen) return seen_from_light(in.view, seen->visible_points(corners, &pyramid));
    const std::vector<HalfSpace> sides = box_half_spaces(pyramid);
    const ConvexBody lit{pyramid, sides};
    return seen_from_light(in.view, intersection_points(corners, {&lit, 1}));
}

/// Space that a caster can shadow: the positive sides of all planes, inside the outline.
struct Blocker {
    std::vector<HalfSpace> planes;
    std::vector<HalfSpace> outline;  ///< lines across the view; z of the normals is 0
    double rim = 0;                  ///< distance of the outline inside the caster's own outline
};

class Shadowed {
public:
    Shadowed(const FitInput& in, std::span<const ViewExtent> receivers) : in_(in), receivers_(receivers) {
        for (const ViewExtent& e : receivers_)
            if (!e.empty()) all_.add(e);
    }

    std::optional<MapRegion> region() {
        if (all_.empty()) return std::nullopt;
        const SceneShape& s = in_.shape;
        const glm::dvec3 size = all_.hi - all_.lo;
        std::vector<std::size_t> last;
        casts_.resize(s.boxes.size());
        for (std::size_t i = 0; i < s.boxes.size(); ++i) {
            if (!s.box_casts[i]) continue;
            casts_[i] = lit_extent(in_, i);
            if (casts_[i].empty() || casts_[i].lo.z > all_.hi.z) continue;
            const glm::dvec3 own = casts_[i].hi - casts_[i].lo;
            const bool large = own.x * own.y >= kLarge * size.x * size.y;
            if (s.box_planes[i] || (large && never_shades_itself(i)))
                last.push_back(i);
            else
                add(across(casts_[i]).intersection(across(all_)));
        }
        // The region found so far makes most of these tests unnecessary.
        for (const std::size_t i : last) add_caster(i);
        return region_.empty() ? std::nullopt : std::optional(region_);
    }

private:
    void add(const MapRegion& r) {
        if (!r.empty()) region_.add(r);
    }

    const Mesh& mesh_of(std::size_t box) const {
        return in_.scene.meshes[std::size_t(in_.scene.objects[in_.shape.box_objects[box]].mesh)];
    }

    bool is_two_sided(const Mesh& mesh) const {
        return mesh.material >= 0 && in_.scene.materials[std::size_t(mesh.material)].double_sided;
    }

    /// Returns true for convex casters whose inner side is not drawn.
    bool never_shades_itself(std::size_t caster) const {
        if (in_.shape.one_box || in_.shape.box_spans_animation[caster]) return false;
        const Mesh& mesh = mesh_of(caster);
        return !is_two_sided(mesh) && is_convex(mesh);
    }

    /// Counts the pairs of one more caster, and returns true while they are affordable.
    bool affords_pairs() {
        pairs_ += receivers_.size();
        return pairs_ <= kMaxShadowPairs;
    }

    /// Returns the approximate cosine between the direction to the light and a plane's normal.
    double facing(const HalfSpace& plane, const glm::dvec3& at) const {
        if (!in_.view.curve.perspective) return glm::dot(plane.normal, in_.view.axes[2]);
        return plane.distance(in_.view.eye) / std::max(glm::distance(in_.view.eye, at), 1e-300);
    }

    /// Adds the shadows of a caster that never shades itself.
    void add_caster(std::size_t caster) {
        const MapRegion most = across(casts_[caster]).intersection(across(all_));
        if (most.empty() || region_.contains(most)) return;
        if (!affords_pairs()) return region_.add(most);
        const double tolerance = in_.shape.box_tolerance[caster];
        const glm::dvec3 at = in_.shape.boxes[caster][0];
        const auto behind = [&](const HalfSpace& p) { return HalfSpace{-p.normal, -p.offset - tolerance}; };
        if (const auto& plane = in_.shape.box_planes[caster]) {
            const double cosine = facing(*plane, at);
            const HalfSpace flipped{-plane->normal, -plane->offset};
            if (cosine > -kEdgeOn) add_behind(caster, {{behind(*plane)}, {}});
            if (cosine < kEdgeOn) add_behind(caster, {{behind(flipped)}, {}});
            return;
        }
        Blocker blocker;
        for (const HalfSpace& inwards : box_half_spaces(in_.shape.boxes[caster])) {
            const HalfSpace side{-inwards.normal, -inwards.offset};
            if (facing(side, at) > kEdgeOn) blocker.planes.push_back(behind(side));
        }
        add_behind(caster, std::move(blocker));
    }

    void add_behind(std::size_t caster, Blocker blocker) {
        for (std::size_t i = 0; i < receivers_.size(); ++i) {
            if (i == caster || receivers_[i].empty()) continue;
            const MapRegion both = across(casts_[caster]).intersection(across(receivers_[i]));
            if (both.empty() || region_.contains(both)) continue;
            const Box& box = in_.shape.boxes[i];
            if (std::ranges::any_of(blocker.planes, [&](const HalfSpace& plane) {
                    return std::ranges::all_of(box, [&](const glm::dvec3& p) { return plane.distance(p) <= 0; });
                }))
                continue;
            if (blocker.outline.empty()) find_outline(caster, blocker);
            add_receiver(blocker, i, both);
        }
    }

    /// Sets the outline of a caster, slightly inside the true one, so that receivers touching its rim are outside.
    void find_outline(std::size_t caster, Blocker& blocker) const {
        std::vector<glm::dvec2> points;
        const Object& object = in_.scene.objects[in_.shape.box_objects[caster]];
        const Mesh& mesh = mesh_of(caster);
        bool in_front = true;
        const auto add = [&](const glm::dvec3& p) {
            const glm::dvec3 v = seen_from_light(in_.view, p);
            in_front = in_front && (!in_.view.curve.perspective || v.z > 0);
            points.emplace_back(v);
        };
        if (mesh.positions.size() <= kMaxOutlineVertices)
            for (const glm::vec3& p : mesh.positions) add(glm::dvec3(object.world * glm::dvec4(p, 1)));
        std::vector<glm::dvec2> hull = in_front ? convex_hull(points) : std::vector<glm::dvec2>();
        if (in_front && (hull.size() < 3 || hull.size() > kMaxOutlineEdges)) {
            points.clear();
            for (const glm::dvec3& p : in_.shape.boxes[caster]) add(p);
            hull = convex_hull(points);
        }
        // Casters reaching behind a perspective light have no outline: every point counts as inside.
        if (!in_front) return;
        const ViewExtent& e = casts_[caster];
        blocker.rim = flat_tolerance(std::max(e.hi.x - e.lo.x, e.hi.y - e.lo.y));
        for (std::size_t i = 0; i < hull.size(); ++i) {
            const glm::dvec2 a = hull[i], along = hull[(i + 1) % hull.size()] - a;
            const double length = glm::length(along);
            if (!(length > 0)) continue;
            const glm::dvec3 normal(-along.y / length, along.x / length, 0);
            blocker.outline.push_back({normal, -glm::dot(normal, glm::dvec3(a, 0)) - blocker.rim});
        }
    }

    /// Adds the part of the view where a caster shadows a receiver; at most `both`.
    void add_receiver(const Blocker& blocker, std::size_t receiver, const MapRegion& both) {
        if (in_.shape.box_spans_animation[receiver]) return add(both);  // its triangles move
        const Object& object = in_.scene.objects[in_.shape.box_objects[receiver]];
        const Mesh& mesh = mesh_of(receiver);
        triangles_ += mesh.indices.size() / 3;
        if (triangles_ > kMaxTriangles) return add(both);
        const LightView& view = in_.view;
        const bool two_sided = is_two_sided(mesh);
        const double winding = glm::determinant(glm::dmat3(object.world)) < 0 ? -1 : 1;
        const HalfSpace ahead = HalfSpace::through(view.eye, -view.axes[2]);
        const auto corner = [&](std::size_t i) {
            return glm::dvec3(object.world * glm::dvec4(mesh.positions[mesh.indices[i]], 1));
        };
        Polygon polygon;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const glm::dvec3 a = corner(i), b = corner(i + 1), c = corner(i + 2);
            const glm::dvec3 to_light = view.curve.perspective ? view.eye - a : view.axes[2];
            if (!two_sided && winding * glm::dot(glm::cross(b - a, c - a), to_light) <= 0) continue;
            polygon.assign({a, b, c});
            for (const HalfSpace& plane : blocker.planes) clip_polygon(polygon, plane);
            if (view.curve.perspective &&
                std::ranges::any_of(polygon, [&](const glm::dvec3& p) { return !(ahead.distance(p) > 0); }))
                return add(both);
            for (glm::dvec3& p : polygon) p = seen_from_light(view, p);
            for (const HalfSpace& line : blocker.outline) clip_polygon(polygon, line);
            MapRegion part;
            for (const glm::dvec3& p : polygon) {
                part.add(glm::dvec2(p) - blocker.rim);
                part.add(glm::dvec2(p) + blocker.rim);
            }
            add(part.intersection(both));
        }
    }

    const FitInput& in_;
    std::span<const ViewExtent> receivers_;
    std::vector<ViewExtent> casts_;  ///< lit extents by box; empty for objects that do not cast
    ViewExtent all_;                 ///< extent of all receivers
    MapRegion region_;
    std::size_t pairs_ = 0, triangles_ = 0;
};

}  // namespace

std::optional<MapRegion> shadowed_region(const FitInput& in, const CameraSlice* seen) {
    std::vector<ViewExtent> receivers(in.shape.boxes.size());
    for (std::size_t i = 0; i < receivers.size(); ++i)
        if (in.receives(i)) receivers[i] = lit_extent(in, i, seen);
    return Shadowed(in, receivers).region();
}

std::optional<MapRegion> fit_casters(const FitInput& in) {
    return shadowed_region(in);
}

std::optional<MapRegion> fit_view(const FitInput& in) {
    if (!in.camera) return fit_casters(in);
    const DepthSpan depths = in.seen_m.value_or(DepthSpan{in.camera->curve.near, in.camera->curve.far});
    const CameraSlice seen(*in.camera, depths.from_m, depths.to_m);
    return shadowed_region(in, &seen);
}

}  // namespace si
