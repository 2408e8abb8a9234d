#include "renderer/view/fit_bounds.h"

#include <algorithm>
#include <cmath>

#include "renderer/scene/animation.h"
#include "renderer/view/fits/convex.h"
#include "renderer/view/fits/flat_mesh.h"

namespace si {
namespace {

constexpr std::size_t kMaxFitObjects = 20000;

bool finite(const Box& box) {
    return std::all_of(box.begin(), box.end(), [](const glm::dvec3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
}

/// What the settings say of an object; the defaults where they say nothing.
ObjectSettings settings_of(const Scene& scene, const Settings& settings, const Object& object) {
    if (settings.objects.empty() || object.node < 0 || std::size_t(object.node) >= scene.nodes.size()) return {};
    const auto it = settings.objects.find(scene.nodes[object.node].path);
    return it == settings.objects.end() ? ObjectSettings() : it->second;
}

void add_box(SceneShape& shape, const Box& box, bool casts, bool receives, std::size_t object,
             const std::optional<HalfSpace>& plane, bool travels) {
    shape.boxes.push_back(box);
    shape.box_casts.push_back(casts), shape.box_receives.push_back(receives);
    shape.box_objects.push_back(object);
    shape.box_planes.push_back(plane);
    shape.box_travels.push_back(travels);
    shape.box_tolerance.push_back(flat_tolerance(0.5 * glm::distance(box[0], box[7])));
}

bool clipped(const Box& box, const LightView& view) {
    if (view.warped()) return false;  // no setting moves where it begins
    const double near = view.curve.near - 1e-9 * std::abs(view.curve.near);
    if (!view.curve.perspective) return extent_within(box, view).lo.z < near;
    const ViewExtent e = extent_of(box, view);
    return e.hi.z > 0 && std::max(0.0, entry_into_pyramid(e, view.half_width)) < near;
}

}  // namespace

SceneShape scene_shape(const Scene& scene, const Settings& settings) {
    SceneShape s;
    std::vector<std::optional<std::optional<HalfSpace>>> planes(scene.meshes.size());  // of meshes that were looked at
    for (const Object& o : scene.objects) {
        const Mesh& mesh = scene.meshes[o.mesh];
        if (mesh.indices.size() < 3 || mesh.bounds.empty()) continue;
        s.triangles = true;
        const ObjectSettings own = settings_of(scene, settings, o);
        const bool casts = own.cast && !o.ground;
        s.casters = s.casters || casts;
        s.receivers = s.receivers || own.receive;
        if (scene.objects.size() > kMaxFitObjects && !o.ground) continue;
        const bool travels = !o.travel.empty();
        const Box box = travels ? o.travel.corners(scene.placement) : mesh.bounds.corners(o.world);
        if (!finite(box)) continue;
        std::optional<HalfSpace> plane;
        if (!travels) {
            auto& known = planes[std::size_t(o.mesh)];
            if (!known) known = plane_of(mesh);
            if (*known) plane = transformed(**known, o.world);
        }
        if (o.ground) s.ground = s.boxes.size();
        add_box(s, box, casts, own.receive, std::size_t(&o - scene.objects.data()), plane, travels);
    }
    Bounds bounds = bounds_of_fit(scene);
    if (bounds.empty() || !std::isfinite(bounds.radius())) {
        bounds = Bounds();
        for (const Box& box : s.boxes)
            for (const glm::dvec3& p : box) bounds.add(p);
    }
    if (bounds.empty()) bounds = {glm::dvec3(-1), glm::dvec3(1)};
    s.one_box = s.boxes.size() == (s.ground ? 1 : 0);
    if (s.one_box) add_box(s, bounds.corners(), s.casters, s.receivers, 0, std::nullopt, false);
    s.centre = bounds.centre();
    // A single point still needs a size: what a double resolves at its distance from the origin.
    s.radius = std::max({bounds.radius(), 1e-7, glm::length(s.centre) * 0x1p-38});
    return s;
}

SceneShape with_shadowed_ground(const SceneShape& shape, const PlacedLight& light) {
    SceneShape out = shape;
    Box& ground = out.boxes[*out.ground];
    const double level = ground[7].y;
    Bounds shadowed;
    bool everywhere = false;
    for (std::size_t i = 0; i < shape.boxes.size(); ++i) {
        if (!shape.box_casts[i]) continue;
        for (const glm::dvec3& p : shape.boxes[i]) {
            const glm::dvec3 from = light.type == LightType::Directional ? light.to_light : light.position - p;
            const double steps = (p.y - level) / from.y;
            everywhere |= !(from.y > 0) && p.y > level;
            if (from.y > 0 && std::isfinite(steps)) shadowed.add(p - from * steps);
        }
    }
    if (light.type == LightType::Directional && !(light.to_light.y > 0)) shadowed = {}, everywhere = false;
    if (everywhere) return out;
    // Where nothing casts onto it, a point of it under the scene says no more than the scene does.
    const glm::dvec3 lo = ground[0], hi = ground[7], middle = 0.5 * (lo + hi);
    if (shadowed.empty()) shadowed.add(middle);
    Bounds part;
    for (const glm::dvec3& p : {shadowed.lo, shadowed.hi}) part.add(glm::clamp(p, lo, hi));
    ground = part.corners();
    return out;
}

ViewExtent extent_of(std::span<const glm::dvec3> points, const LightView& view) {
    const glm::dmat3 view_from_world = glm::transpose(view.axes);
    ViewExtent e;
    for (const glm::dvec3& p : points) {
        const glm::dvec3 v = view_from_world * (p - view.eye);
        e.add(glm::dvec3(v.x, v.y, -v.z));
    }
    return e;
}

ViewExtent extent_within(const Box& box, const LightView& view) {
    std::vector<HalfSpace> sides;
    for (const int axis : {0, 1})
        for (const double way : {-1.0, 1.0}) {
            const glm::dvec3 inwards = way * view.axes[axis];
            sides.push_back(HalfSpace::through(view.eye - view.half_width * inwards, inwards));
        }
    return extent_of(points_within(box, sides), view);
}

ViewExtent extent_of(const SceneShape& shape, const LightView& view) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    ViewExtent all;
    for (std::size_t i = 0; i < shape.boxes.size(); ++i) {
        ViewExtent e = extent_of(shape.boxes[i], view);
        if (i == shape.ground) e.lo.x = e.lo.y = kFar, e.hi.x = e.hi.y = -kFar;
        all.add(e);
    }
    return all;
}

double entry_into_pyramid(const ViewExtent& e, double tan_half) {
    const double aside_x = std::max({0.0, e.lo.x, -e.hi.x}), aside_y = std::max({0.0, e.lo.y, -e.hi.y});
    const double z = std::max(e.lo.z, std::max(aside_x, aside_y) / tan_half);
    return z <= e.hi.z ? z : std::numeric_limits<double>::infinity();
}

int count_clipped(const SceneShape& shape, const std::vector<LightView>& views) {
    int count = 0;
    for (std::size_t i = 0; i < shape.boxes.size(); ++i)
        count += shape.box_casts[i] && std::any_of(views.begin(), views.end(),
                                                   [&](const LightView& v) { return clipped(shape.boxes[i], v); });
    return count;
}

}  // namespace si
