#include "renderer/view/bounds/scene_shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/view/bounds/convex.h"
#include "renderer/view/bounds/flat_mesh.h"

namespace si {
namespace {

constexpr std::size_t kMaxFitObjects = 20000;
/// Largest number of caster vertices projected onto the ground; above it boxes are projected.
constexpr std::size_t kMaxShadowVertices = 1 << 16;

void add_box(SceneShape& shape, const Box& box, bool casts, bool receives, std::size_t object,
             const std::optional<HalfSpace>& plane, bool travels) {
    shape.boxes.push_back(box);
    shape.box_casts.push_back(casts);
    shape.box_receives.push_back(receives);
    shape.box_objects.push_back(object);
    shape.box_planes.push_back(plane);
    shape.box_spans_animation.push_back(travels);
    shape.box_tolerance.push_back(flat_tolerance(0.5 * glm::distance(box[0], box[7])));
}

bool clipped(const Box& box, const LightView& view) {
    if (view.warped()) return false;  // no setting moves the near plane of a warped map
    const double near = view.curve.near - 1e-9 * std::abs(view.curve.near);
    if (!view.curve.perspective) return extent_inside_view(box, view).lo.z < near;
    const ViewExtent e = extent_in_view(box, view);
    return e.hi.z > 0 && std::max(0.0, pyramid_entry_m(e, view.cross_section())) < near;
}

std::vector<HalfSpace> sides_of(const LightView& view) {
    const auto [lo, hi] = view.cross_section();
    std::vector<HalfSpace> sides;
    for (const int axis : {0, 1}) {
        sides.push_back(HalfSpace::through(view.eye + hi[axis] * view.axes[axis], -view.axes[axis]));
        sides.push_back(HalfSpace::through(view.eye + lo[axis] * view.axes[axis], view.axes[axis]));
    }
    return sides;
}

/// Returns the convex hull of many points. Points inside the hull of the eight outermost are dropped first.
std::vector<glm::dvec2> hull_of(std::vector<glm::dvec2> points) {
    if (points.size() < 3) return points;
    constexpr std::size_t kDirections = 8;
    const glm::dvec2 ways[kDirections] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    std::vector<glm::dvec2> outermost(kDirections, points.front());
    for (const glm::dvec2& p : points)
        for (std::size_t i = 0; i < kDirections; ++i)
            if (glm::dot(ways[i], p - outermost[i]) > 0) outermost[i] = p;
    const std::vector<glm::dvec2> core = convex_hull(outermost);
    if (core.size() >= 3)
        std::erase_if(points, [&](const glm::dvec2& p) {
            for (std::size_t i = 0; i < core.size(); ++i) {
                const glm::dvec2 along = core[(i + 1) % core.size()] - core[i], to = p - core[i];
                if (!(along.x * to.y - along.y * to.x > 0)) return false;
            }
            return true;
        });
    std::vector<glm::dvec2> hull = convex_hull(points);
    if (hull.empty()) hull.push_back(points.front());
    return hull;
}

/// Calls `add` with points whose hull contains every caster: vertices, or the box where there are many vertices or the
/// object is animated.
template <class Add>
void visit_casters(const SceneShape& shape, const Scene& scene, const Add& add) {
    const auto mesh_of = [&](std::size_t box) -> const Mesh& {
        return scene.meshes[std::size_t(scene.objects[shape.box_objects[box]].mesh)];
    };
    std::size_t vertices = 0;
    for (std::size_t i = 0; i < shape.boxes.size() && !shape.one_box; ++i)
        if (shape.box_casts[i] && !shape.box_spans_animation[i]) vertices += mesh_of(i).positions.size();
    const bool boxes_only = shape.one_box || vertices > kMaxShadowVertices;
    for (std::size_t i = 0; i < shape.boxes.size(); ++i) {
        if (!shape.box_casts[i]) continue;
        if (boxes_only || shape.box_spans_animation[i]) {
            for (const glm::dvec3& p : shape.boxes[i]) add(p);
            continue;
        }
        const glm::dmat4& world = scene.objects[shape.box_objects[i]].world;
        const Mesh& mesh = mesh_of(i);
        for (const glm::vec3& p : mesh.positions) {
            // Vertices that no triangle uses may lie outside the bounds.
            const glm::dvec3 held = glm::clamp(glm::dvec3(p), mesh.bounds.lo, mesh.bounds.hi);
            add(glm::dvec3(world * glm::dvec4(held, 1)));
        }
    }
}

}  // namespace

bool is_finite(const Box& box) {
    return std::ranges::all_of(
        box, [](const glm::dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); });
}

SceneShape scene_shape(const Scene& scene, const Settings& settings) {
    SceneShape s;
    std::vector<std::optional<std::optional<HalfSpace>>> planes(scene.meshes.size());  // planes by mesh, found once
    for (const Object& o : scene.objects) {
        const Mesh& mesh = scene.meshes[o.mesh];
        if (mesh.indices.size() < 3 || mesh.bounds.empty()) continue;
        s.triangles = true;
        const ObjectSettings& own = object_settings(scene, settings, o);
        const bool casts = own.cast && !o.ground;
        s.casters = s.casters || casts;
        s.receivers = s.receivers || own.receive;
        if (scene.objects.size() > kMaxFitObjects && !o.ground) continue;
        const bool travels = !o.animation_bounds.empty();
        const Box box = travels ? o.animation_bounds.corners(scene.placement) : mesh.bounds.corners(o.world);
        if (!is_finite(box)) continue;
        std::optional<HalfSpace> plane;
        if (!travels) {
            auto& known = planes[std::size_t(o.mesh)];
            if (!known) known = mesh_plane(mesh);
            if (*known) plane = transform_plane(**known, o.world);
        }
        if (o.ground) s.ground = s.boxes.size();
        add_box(s, box, casts, own.receive, std::size_t(&o - scene.objects.data()), plane, travels);
    }
    Bounds bounds = light_fit_bounds(scene);
    if (bounds.empty() || !std::isfinite(bounds.radius())) {
        bounds = Bounds();
        for (const Box& box : s.boxes)
            for (const glm::dvec3& p : box) bounds.add(p);
    }
    if (bounds.empty()) bounds = {glm::dvec3(-1), glm::dvec3(1)};
    s.one_box = s.boxes.size() == (s.ground ? 1 : 0);
    if (s.one_box) add_box(s, bounds.corners(), s.casters, s.receivers, 0, std::nullopt, false);
    s.centre = bounds.centre();
    // A single point gets a radius of the resolution of a double at its distance from the origin.
    s.radius = std::max({bounds.radius(), 1e-7, glm::length(s.centre) * 0x1p-38});
    s.main_radius = scene.main_part.empty() ? s.radius : main_bounds(scene).radius();
    return s;
}

SceneShape with_shadowed_ground(const SceneShape& shape, const Scene& scene, const PlacedLight& light) {
    SceneShape out = shape;
    Box& ground = out.boxes[*out.ground];
    const glm::dvec3 lo = ground[0], hi = ground[7];
    std::vector<glm::dvec2> shadowed;
    bool everywhere = false;
    if (light.type != LightType::Directional || light.to_light.y > 0)
        visit_casters(shape, scene, [&](const glm::dvec3& p) {
            const glm::dvec3 from = light.type == LightType::Directional ? light.to_light : light.position - p;
            const double steps = (p.y - hi.y) / from.y;
            everywhere = everywhere || (!(from.y > 0) && p.y > hi.y);
            if (from.y > 0 && std::isfinite(steps)) shadowed.emplace_back(p.x - from.x * steps, p.z - from.z * steps);
        });
    if (everywhere) return out;
    Polygon part;
    for (const glm::dvec2& p : hull_of(std::move(shadowed))) part.emplace_back(p.x, hi.y, p.y);
    for (const int axis : {0, 2}) {
        glm::dvec3 inwards(0);
        inwards[axis] = 1;
        clip_polygon(part, HalfSpace::through(lo, inwards));
        clip_polygon(part, HalfSpace::through(hi, -inwards));
    }
    // Without a shadow on the ground one point of the ground under the scene suffices.
    if (part.empty()) part.push_back({0.5 * (lo.x + hi.x), hi.y, 0.5 * (lo.z + hi.z)});
    Bounds around;
    for (const glm::dvec3& p : part) around.add(p);
    ground = around.corners();
    out.ground_shadow = std::move(part);
    return out;
}

ViewExtent extent_in_view(std::span<const glm::dvec3> points, const LightView& view) {
    const glm::dmat3 view_from_world = glm::transpose(view.axes);
    ViewExtent e;
    for (const glm::dvec3& p : points) {
        const glm::dvec3 v = view_from_world * (p - view.eye);
        e.add(glm::dvec3(v.x, v.y, -v.z));
    }
    return e;
}

Box view_pyramid(const LightView& view, double near, double far, double widening) {
    const auto [lo, hi] = view.cross_section();
    const glm::dvec2 middle = 0.5 * (lo + hi);
    Box box;
    for (unsigned i = 0; i < 8; ++i) {
        const double z = i & 4 ? far : near;
        const glm::dvec2 side = glm::dvec2(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y) - middle;
        box[i] = view.eye + view.axes * glm::dvec3(widening * z * side + z * middle, -z);
    }
    return box;
}

ViewExtent extent_inside_view(const Box& box, const LightView& view) {
    return extent_in_view(points_inside_planes(box, sides_of(view)), view);
}

ViewExtent extent_inside_view(const SceneShape& shape, std::size_t box, const LightView& view) {
    return extent_in_view(points_inside_planes(shape, box, sides_of(view)), view);
}

std::vector<glm::dvec3> points_inside_planes(const SceneShape& shape, std::size_t box,
                                             std::span<const HalfSpace> planes) {
    if (box != shape.ground || shape.ground_shadow.empty()) return points_inside_planes(shape.boxes[box], planes);
    Polygon part = shape.ground_shadow;
    for (const HalfSpace& plane : planes) clip_polygon(part, plane);
    return part;
}

void widen_for_ground_shadow(ViewExtent& model, const ViewExtent& ground) {
    const glm::dvec3 size = model.hi - model.lo;
    for (int axis = 0; axis < 2; ++axis) {
        const double rounding = kMinGroundWidening * std::max(size.x, size.y);
        if (!(ground.lo[axis] >= model.lo[axis] - rounding)) model.lo[axis] = std::min(model.lo[axis], ground.lo[axis]);
        if (!(ground.hi[axis] <= model.hi[axis] + rounding)) model.hi[axis] = std::max(model.hi[axis], ground.hi[axis]);
    }
    model.lo.z = std::min(model.lo.z, ground.lo.z);
    model.hi.z = std::max(model.hi.z, ground.hi.z);
}

ViewExtent extent_in_view(const SceneShape& shape, const LightView& view) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    ViewExtent all;
    for (std::size_t i = 0; i < shape.boxes.size(); ++i) {
        const bool shadow = i == shape.ground && !shape.ground_shadow.empty();
        ViewExtent e = shadow ? extent_in_view(shape.ground_shadow, view) : extent_in_view(shape.boxes[i], view);
        if (i == shape.ground) {
            e.lo.x = e.lo.y = kFar;
            e.hi.x = e.hi.y = -kFar;
        }
        all.add(e);
    }
    return all;
}

double pyramid_entry_m(const ViewExtent& e, const CrossSection& sides) {
    // A box beside an axis meets the pyramid between two distances, where its nearest side crosses the pyramid's sides.
    double entry = e.lo.z, leaves = e.hi.z;
    for (const int axis : {0, 1})
        // z sides.hi >= e.lo and z sides.lo <= e.hi
        for (const auto& [tangent, aside] :
             {std::pair(sides.hi[axis], e.lo[axis]), std::pair(-sides.lo[axis], -e.hi[axis])}) {
            if (tangent > 0)
                entry = std::max(entry, std::max(aside, 0.0) / tangent);
            else if (aside > 0)
                return std::numeric_limits<double>::infinity();
            else if (tangent < 0)
                leaves = std::min(leaves, aside / tangent);
        }
    return entry <= leaves ? entry : std::numeric_limits<double>::infinity();
}

int count_near_clipped_casters(const SceneShape& shape, const std::vector<LightView>& views) {
    int count = 0;
    for (std::size_t i = 0; i < shape.boxes.size(); ++i)
        count += shape.box_casts[i] && std::any_of(views.begin(), views.end(),
                                                   [&](const LightView& v) { return clipped(shape.boxes[i], v); });
    return count;
}

}  // namespace si
