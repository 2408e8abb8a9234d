#include "renderer/view/culling/needed_maps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/projection/projection.h"
#include "renderer/view/bounds/convex.h"

namespace si {
namespace {

/// Padding of the view frustum in pixels, for float rounding in the driver's clipper.
constexpr double kFrustumPadPixels = 2;
/// Padding of near and far planes, as a share of their depth.
constexpr double kFrustumDepthPad = 1e-3;

/// Least distance from a light as a share of a body's farthest distance; nearer points may lie anywhere in a map.
constexpr double kMinLightDistanceShare = 1e-4;
/// Padding of the end of a view, where a driver may choose the next view.
constexpr double kSpanEndPad = 1e-5;
/// Padding of a light's range and cone.
constexpr double kLightRangePad = 1e-4;
/// Padding of the texels that are read or drawn.
constexpr double kLookupPadTexels = 2;

CameraSlice padded_frustum(Camera camera, int lines) {
    const double more = 1 + 2 * kFrustumPadPixels / std::max(lines, 1);
    camera.fov_y_rad = 2 * std::atan(std::tan(0.5 * camera.fov_y_rad) * more);
    camera.height *= more;
    const DepthCurve& c = camera.curve;
    const double room = camera.orthographic ? kFrustumDepthPad * (c.far - c.near) : 0;
    return {camera, c.near - std::max(kFrustumDepthPad * std::abs(c.near), room),
            c.far + std::max(kFrustumDepthPad * std::abs(c.far), room)};
}

Sphere ball_around(std::span<const glm::dvec3> points) {
    Bounds bounds;
    for (const glm::dvec3& p : points) bounds.add(p);
    Sphere ball{bounds.centre(), 0};
    for (const glm::dvec3& p : points) ball.radius = std::max(ball.radius, glm::distance(ball.centre, p));
    return ball;
}

/// Projection of points into a map. Points behind a light are never looked up.
struct Projected {
    Bounds2 rect;
    double nearest = std::numeric_limits<double>::infinity();    ///< clip-space w
    double farthest = -std::numeric_limits<double>::infinity();  ///< clip-space w
    bool outside = false;                                        ///< all points lie outside one side of the map
};

class ViewRegion {
public:
    ViewRegion(const FittedLight& light, std::size_t view, const LookupArea& area)
        : light_(light),
          view_(light.views[view]),
          number_(view),
          area_(area),
          uvd_from_relative_(uvd_from_clip(view_.curve.convention) * view_.clip_from_relative(light.map_origin)) {
        const double wide = view_.curve.perspective ? 1 + view_.half_extent() : 1;
        room_ = (area.reach_texels + std::abs(area.normal_texels) * wide + kLookupPadTexels) / area.resolution;
        if (area.normal_m == 0) return;
        // Near a perspective light a metre is any number of texels.
        is_room_known_ = !view_.curve.perspective;
        const CrossSection sides = view_.cross_section();
        room_ += std::abs(area.normal_m) / std::min(sides.hi.x - sides.lo.x, sides.hi.y - sides.lo.y);
    }

    MapCells region;

    void add(const VisibleBodies& seen, const VisibleBody& body) {
        const std::span<const glm::dvec3> points = body.points();
        if (region.is_whole() || !may_be_chosen(points)) return;
        const Projected p = project(points);
        const bool faces = light_.chooser.choice == ViewChoice::Face;
        if (!(p.farthest > 0) || (faces && p.outside)) return;
        const double near = std::max(kMinLightDistanceShare * p.farthest, kMinLightDistanceShare * view_.curve.near);
        if (!view_.curve.perspective) {
            if (!(p.nearest > 0)) return add_all();
            return add_rect(p.rect, false);
        }
        if (p.nearest > near) return add_rect(p.rect, faces);
        add_in_front(seen, body, p.farthest);
    }

private:
    const FittedLight& light_;
    const LightView& view_;
    std::size_t number_;
    const LookupArea& area_;
    glm::dmat4 uvd_from_relative_;
    double room_;
    bool is_room_known_ = true;

    void add_all() { region = MapCells::whole(); }

    /// @param is_face look-ups outside the map's sides belong to another view
    void add_rect(Bounds2 rect, bool is_face) {
        if (!is_room_known_ || (!is_face && area_.wrap == MapWrap::Repeat)) return add_all();
        rect.lo -= room_;
        rect.hi += room_;
        const bool beyond = !is_face && (area_.wrap == MapWrap::Clamp || area_.reads_border_texels);
        MapCells read;
        read.add(rect, beyond);
        if (read.empty()) return;
        // Texels of a warped view differ in width, so the padding in texels does not hold.
        if (area_.whole_maps || area_.wrap == MapWrap::Repeat || view_.warped()) return add_all();
        region.add(rect, beyond);
    }

    Projected project(std::span<const glm::dvec3> points) const {
        Projected out;
        if (!view_.curve.perspective && !view_.warped()) {
            const glm::dmat4& m = uvd_from_relative_;
            for (const glm::dvec3& p : points) {
                const glm::dvec3 d = p - light_.map_origin;
                out.rect.add({m[0][0] * d.x + m[1][0] * d.y + m[2][0] * d.z + m[3][0],
                              m[0][1] * d.x + m[1][1] * d.y + m[2][1] * d.z + m[3][1]});
            }
            out.nearest = out.farthest = 1;
            out.outside = out.rect.hi.x < 0 || out.rect.hi.y < 0 || out.rect.lo.x > 1 || out.rect.lo.y > 1;
            return out;
        }
        bool beyond[4] = {true, true, true, true};
        for (const glm::dvec3& p : points) {
            const glm::dvec4 h = uvd_from_relative_ * glm::dvec4(p - light_.map_origin, 1);
            out.nearest = std::min(out.nearest, h.w);
            out.farthest = std::max(out.farthest, h.w);
            beyond[0] &= h.x < 0.0;
            beyond[1] &= h.w < h.x;
            beyond[2] &= h.y < 0.0;
            beyond[3] &= h.w < h.y;
            if (h.w > 0) out.rect.add(glm::dvec2(h) / h.w);
        }
        out.outside = std::ranges::any_of(beyond, [](bool all) { return all; });
        return out;
    }

    /// Adds a body beside or around a light: the part of it between the view's sides.
    void add_in_front(const VisibleBodies& seen, const VisibleBody& body, double farthest) {
        const double near = kMinLightDistanceShare * farthest, wide = 2 * near * (1 + view_.half_extent());
        const Box pyramid = view_pyramid(view_, near, 1.01 * farthest);
        const Box about = Bounds{view_.eye - wide, view_.eye + wide}.corners();
        if (!seen.view.visible_points(body.box, &about).empty()) return add_all();
        const std::vector<glm::dvec3> within = seen.view.visible_points(body.box, &pyramid);
        if (!within.empty()) {
            const Projected p = project(within);
            if (!(p.nearest > 0)) return add_all();
            add_rect(p.rect, true);
        }
        const bool ends = area_.wrap == MapWrap::Border || area_.wrap == MapWrap::Range;
        if (light_.chooser.choice == ViewChoice::Face || (ends && !area_.reads_border_texels)) return;
        if (area_.whole_maps || area_.wrap == MapWrap::Repeat) return add_all();
        region.add_border_cells();
    }

    /// Returns true when choose_view() may choose or blend in this view for a point among these.
    bool may_be_chosen(std::span<const glm::dvec3> points) const {
        const ViewChooser& c = light_.chooser;
        const bool last = number_ + 1 == light_.views.size();
        if (c.choice == ViewChoice::Interval) {
            double from = std::numeric_limits<double>::infinity(), to = -from;
            for (const glm::dvec3& p : points) {
                const double depth = glm::dot(p - c.from_ws, c.forward);
                from = std::min(from, depth);
                to = std::max(to, depth);
            }
            const double ends = c.spans[number_].ends;
            if (!last && from > ends + kSpanEndPad * std::abs(ends)) return false;
            if (number_ == 0) return true;
            const ViewSpan& before = c.spans[number_ - 1];
            const double begins = std::min(before.ends, before.blends_from);
            return to >= begins - kSpanEndPad * std::abs(begins);
        }
        if (c.choice != ViewChoice::Map || last) return true;
        const Bounds2 rect = project(points).rect;
        constexpr double kPad = 1e-3;
        return rect.hi.x >= -kPad && rect.hi.y >= -kPad && rect.lo.x <= 1 + kPad && rect.lo.y <= 1 + kPad;
    }
};

/// Returns true when the camera sees only triangles of a body whose other side faces the light. Shaders take normals on
/// the camera's side, and skip look-ups where those face away.
bool is_turned_away(const VisibleBody& body, const VisibleBodies& seen, const FittedLight& light) {
    if (body.side == VisibleSide::Either) return false;
    const glm::dvec4 from =
        light.type == LightType::Directional ? glm::dvec4(light.to_light, 0) : glm::dvec4(light.position, 1);
    const VisibleSide side = visible_side(body.cluster, seen.mesh_from_world[body.object] * from);
    return side != VisibleSide::Either && side != body.side;
}

std::string none_arrives(const FittedLight& light) {
    return light.range_m > 0 ? "no visible surface lies within the light's range and cone"
                             : "no visible surface lies where the light shines";
}

}  // namespace

bool may_illuminate(const FittedLight& light, std::span<const glm::dvec3> points) {
    if (light.type == LightType::Directional) return true;
    const Sphere ball = ball_around(points);
    if (!std::isfinite(ball.radius)) return true;
    const glm::dvec3 d = ball.centre - light.position;
    if (light.range_m > 0 && glm::length(d) - ball.radius > light.range_m * (1 + kLightRangePad)) return false;
    if (light.type != LightType::Spot || !(light.cos_cone_outer > kLightRangePad)) return true;
    const double along = -glm::dot(d, light.to_light);
    const double aside = std::sqrt(std::max(glm::dot(d, d) - along * along, 0.0));
    const double cosine = light.cos_cone_outer, sine = std::sqrt(std::max(1 - cosine * cosine, 0.0));
    // Distance of the centre from the cone's side, or from its tip.
    return aside * cosine - along * sine <= ball.radius + kLightRangePad * glm::length(d);
}

VisibleBodies find_visible_bodies(const Scene& scene, const Camera& camera, int lines,
                                  const std::function<std::span<const Cluster>(std::size_t mesh)>& clusters) {
    VisibleBodies out{padded_frustum(camera, lines), {}};
    out.mesh_from_world.resize(scene.objects.size());
    out.bodies.reserve(scene.objects.size());
    for (std::size_t number = 0; number < scene.objects.size(); ++number) {
        const Object& object = scene.objects[number];
        const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
        if (mesh.indices.size() < 3 || mesh.bounds.empty()) continue;
        const Box box = mesh.bounds.corners(object.world);
        if (!is_finite(box)) {
            out.unknown = true;
            continue;
        }
        const BoxPlacement where = out.view.classify_box(box);
        if (where == BoxPlacement::Outside) continue;
        const std::span<const Cluster> parts = clusters(std::size_t(object.mesh));
        const auto has_sides = [](const Cluster& part) { return part.axis != glm::dvec3(0); };
        const bool sides = std::ranges::any_of(parts, has_sides) && is_well_conditioned(glm::dmat3(object.world));
        glm::dmat4& mesh_from_world = out.mesh_from_world[number];
        if (sides) mesh_from_world = glm::inverse(object.world);
        const glm::dvec4 eye =
            mesh_from_world * (camera.orthographic ? glm::dvec4(camera.axes[2], 0) : glm::dvec4(camera.eye, 1));
        const auto side = [&](const Cluster& part) { return sides ? visible_side(part, eye) : VisibleSide::Either; };
        if (parts.size() > 1) {
            for (const Cluster& part : parts) {
                const Box corners = part.box.corners(object.world);
                if (where != BoxPlacement::Inside && out.view.classify_box(corners) == BoxPlacement::Outside) continue;
                out.bodies.push_back({corners, {}, part, side(part), number});
            }
            continue;
        }
        const Cluster whole = parts.empty() ? Cluster{mesh.bounds} : parts[0];
        if (where == BoxPlacement::Inside) {
            out.bodies.push_back({box, {}, whole, side(whole), number});
        } else if (std::vector<glm::dvec3> seen = out.view.visible_points(box); !seen.empty()) {
            out.bodies.push_back({box, std::move(seen), whole, side(whole), number});
        }
    }
    return out;
}

NeededMaps needed_maps(const FittedLight& light, const VisibleBodies& seen, const LookupArea& area) {
    NeededMaps out;
    if (area.only_lit_points && light.radiance == glm::dvec3(0)) {
        out.views.resize(light.views.size());
        out.unneeded_reason = kLightAddsNothing;
        return out;
    }
    if (seen.unknown || light.chooser.choice == ViewChoice::Distance) {
        out.views.assign(light.views.size(), MapCells::whole());
        return out;
    }
    std::vector<ViewRegion> views;
    for (std::size_t v = 0; v < light.views.size(); ++v) views.emplace_back(light, v, area);
    bool arrives = false, turned = false;
    for (const VisibleBody& body : seen.bodies) {
        if (area.only_lit_points && !may_illuminate(light, body.points())) continue;
        arrives = true;
        if (is_turned_away(body, seen, light)) {
            turned = true;
            continue;
        }
        for (ViewRegion& view : views) view.add(seen, body);
    }
    bool needed = false;
    for (const ViewRegion& view : views) {
        out.views.push_back(view.region);
        needed |= !view.region.empty();
    }
    if (!needed)
        out.unneeded_reason = seen.bodies.empty() ? "the camera sees nothing"
                              : !arrives          ? none_arrives(light)
                              : turned ? "all visible surfaces face away from the light, or lie outside its maps"
                                       : "no visible surface is looked up in it";
    return out;
}

}  // namespace si
