#include "renderer/view/culling/needed_maps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/projection/projection.h"
#include "renderer/view/bounds/convex.h"

namespace si {
namespace {

// By how much more is taken to be seen: what floats of a driver make of a picture's sides.
constexpr double kPixelsBeside = 2;
constexpr double kSeenDepthShare = 1e-3;

constexpr double kAboutLightShare =
    1e-4;                             ///< of how far a body reaches from a light: nearer, it may be anywhere in a map
constexpr double kSpanShare = 1e-5;   ///< of a view's end, about which a driver may choose the next one
constexpr double kRangeShare = 1e-4;  ///< of a light's range and cone
constexpr double kLookupRoomTexels = 2;  ///< beside all that is read or drawn

CameraSlice wider(Camera camera, int lines) {
    const double more = 1 + 2 * kPixelsBeside / std::max(lines, 1);
    camera.fov_y_rad = 2 * std::atan(std::tan(0.5 * camera.fov_y_rad) * more);
    camera.height *= more;
    const DepthCurve& c = camera.curve;
    const double room = camera.orthographic ? kSeenDepthShare * (c.far - c.near) : 0;
    return {camera, c.near - std::max(kSeenDepthShare * std::abs(c.near), room),
            c.far + std::max(kSeenDepthShare * std::abs(c.far), room)};
}

bool is_finite(const Box& box) {
    return std::ranges::all_of(
        box, [](const glm::dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); });
}

struct BoundingBall {
    glm::dvec3 centre{0};
    double radius = 0;
};

BoundingBall ball_around(std::span<const glm::dvec3> points) {
    Bounds bounds;
    for (const glm::dvec3& p : points) bounds.add(p);
    BoundingBall ball{bounds.centre(), 0};
    for (const glm::dvec3& p : points) ball.radius = std::max(ball.radius, glm::distance(ball.centre, p));
    return ball;
}

/// Where points lie in a map. Nothing of what lies behind a light is looked up.
struct Projected {
    MapRect rect{glm::dvec2(std::numeric_limits<double>::infinity()),
                 glm::dvec2(-std::numeric_limits<double>::infinity())};
    double nearest = std::numeric_limits<double>::infinity();    ///< w
    double farthest = -std::numeric_limits<double>::infinity();  ///< w
    bool beside = false;                                         ///< all of them lie beyond one of the map's sides
};

class ViewRegion {
public:
    ViewRegion(const FittedLight& light, std::size_t view, const LookupArea& area)
        : light_(light),
          view_(light.views[view]),
          number_(view),
          area_(area),
          uvd_from_relative_(uvd_from_clip(view_.curve.convention) * view_.clip_from_relative(light.map_origin)) {
        const double wide = view_.curve.perspective ? 1 + view_.half_width : 1;
        room_ = (area.reach_texels + std::abs(area.normal_texels) * wide + kLookupRoomTexels) / area.resolution;
    }

    MapCells region;

    void add(const SeenBodies& seen, const SeenBody& body) {
        const std::span<const glm::dvec3> points = body.points();
        if (region.is_whole() || !may_be_chosen(points)) return;
        const Projected p = project(points);
        const bool faces = light_.chooser.choice == ViewChoice::Face;
        if (!(p.farthest > 0) || (faces && p.beside)) return;
        const double near = std::max(kAboutLightShare * p.farthest, kAboutLightShare * view_.curve.near);
        if (!view_.curve.perspective) {
            if (!(p.nearest > 0)) return take_all();
            return take(p.rect, false);
        }
        if (p.nearest > near) return take(p.rect, faces);
        add_in_front(seen, body, p.farthest);
    }

private:
    const FittedLight& light_;
    const LightView& view_;
    std::size_t number_;
    const LookupArea& area_;
    glm::dmat4 uvd_from_relative_;
    double room_;

    void take_all() { region = MapCells::whole(); }

    /// @param held look-ups beyond the map's sides are another view's
    void take(MapRect rect, bool held) {
        if (!held && area_.wrap == MapWrap::Repeat) return take_all();
        rect.lo -= room_;
        rect.hi += room_;
        const bool beyond = !held && (area_.wrap == MapWrap::Clamp || area_.weighs_rim);
        MapCells read;
        read.add(rect, beyond);
        if (read.empty()) return;
        // A view that warps has texels of other widths beside.
        if (area_.whole_maps || area_.wrap == MapWrap::Repeat || view_.warped()) return take_all();
        region.add(rect, beyond);
    }

    Projected project(std::span<const glm::dvec3> points) const {
        Projected out;
        if (!view_.curve.perspective && !view_.warped()) {
            const glm::dmat4& m = uvd_from_relative_;
            for (const glm::dvec3& p : points) {
                const glm::dvec3 d = p - light_.map_origin;
                const glm::dvec2 at(m[0][0] * d.x + m[1][0] * d.y + m[2][0] * d.z + m[3][0],
                                    m[0][1] * d.x + m[1][1] * d.y + m[2][1] * d.z + m[3][1]);
                out.rect.lo = glm::min(out.rect.lo, at);
                out.rect.hi = glm::max(out.rect.hi, at);
            }
            out.nearest = out.farthest = 1;
            out.beside = out.rect.hi.x < 0 || out.rect.hi.y < 0 || out.rect.lo.x > 1 || out.rect.lo.y > 1;
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
            if (!(h.w > 0)) continue;
            const glm::dvec2 at = glm::dvec2(h) / h.w;
            out.rect.lo = glm::min(out.rect.lo, at);
            out.rect.hi = glm::max(out.rect.hi, at);
        }
        out.beside = std::ranges::any_of(beyond, [](bool all) { return all; });
        return out;
    }

    /// Of a body beside or around a light: what lies within the view's sides.
    void add_in_front(const SeenBodies& seen, const SeenBody& body, double farthest) {
        Box pyramid, about;
        const double far = 1.01 * farthest, near = kAboutLightShare * farthest;
        for (unsigned i = 0; i < 8; ++i) {
            const double z = i & 4 ? far : near, side = z * view_.half_width;
            pyramid[i] = view_.eye + view_.axes * glm::dvec3(i & 1 ? side : -side, i & 2 ? side : -side, -z);
            const double wide = 2 * near * (1 + view_.half_width);
            about[i] = view_.eye + wide * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
        }
        if (!seen.view.seen_of(body.box, &about).empty()) return take_all();
        const std::vector<glm::dvec3> within = seen.view.seen_of(body.box, &pyramid);
        if (!within.empty()) {
            const Projected p = project(within);
            if (!(p.nearest > 0)) return take_all();
            take(p.rect, true);
        }
        const bool ends = area_.wrap == MapWrap::Border || area_.wrap == MapWrap::Range;
        if (light_.chooser.choice == ViewChoice::Face || (ends && !area_.weighs_rim)) return;
        if (area_.whole_maps || area_.wrap == MapWrap::Repeat) return take_all();
        region.add_rim();
    }

    /// Whether choose_view() may name this view, or blend it in, for a point among these.
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
            if (!last && from > ends + kSpanShare * std::abs(ends)) return false;
            if (number_ == 0) return true;
            const ViewSpan& before = c.spans[number_ - 1];
            const double begins = std::min(before.ends, before.blends_from);
            return to >= begins - kSpanShare * std::abs(begins);
        }
        if (c.choice != ViewChoice::Map || last) return true;
        const MapRect rect = project(points).rect;
        constexpr double kWideLayout = 1e-3;
        return rect.hi.x >= -kWideLayout && rect.hi.y >= -kWideLayout && rect.lo.x <= 1 + kWideLayout &&
               rect.lo.y <= 1 + kWideLayout;
    }
};

/// Whether angles in a mesh's space are nearly those in the world: sides that are clear there are clear here.
bool keeps_sides(const glm::dmat4& world) {
    constexpr double kMostSkew = 30;
    const glm::dmat3 m(world), back = glm::inverse(m);
    double there = 0, here = 0;
    for (int i = 0; i < 3; ++i) {
        there += glm::dot(m[i], m[i]);
        here += glm::dot(back[i], back[i]);
    }
    return std::sqrt(there * here) < kMostSkew;
}

/// Whether all that the camera sees of a body is of triangles whose other side the light meets: shaders take normals on
/// the camera's side, and look nothing up where those face away, whatever is shaded by.
bool is_turned_away(const SeenBody& body, const SeenBodies& seen, const FittedLight& light) {
    if (body.side == VisibleSide::Either) return false;
    const glm::dvec4 from =
        light.type == LightType::Directional ? glm::dvec4(light.to_light, 0) : glm::dvec4(light.position, 1);
    const VisibleSide side = visible_side(body.cluster, seen.mesh_from_world[body.object] * from);
    return side != VisibleSide::Either && side != body.side;
}

std::string none_arrives(const FittedLight& light) {
    return light.range_m > 0 ? "nothing that the camera sees lies within the light's range and cone"
                             : "nothing that the camera sees lies where the light shines";
}

}  // namespace

bool arrives_at(const FittedLight& light, std::span<const glm::dvec3> points) {
    if (light.type == LightType::Directional) return true;
    const BoundingBall ball = ball_around(points);
    if (!std::isfinite(ball.radius)) return true;
    const glm::dvec3 d = ball.centre - light.position;
    if (light.range_m > 0 && glm::length(d) - ball.radius > light.range_m * (1 + kRangeShare)) return false;
    if (light.type != LightType::Spot || !(light.cos_cone_outer > kRangeShare)) return true;
    const double along = -glm::dot(d, light.to_light);
    const double aside = std::sqrt(std::max(glm::dot(d, d) - along * along, 0.0));
    const double cosine = light.cos_cone_outer, sine = std::sqrt(std::max(1 - cosine * cosine, 0.0));
    // How far its centre is from the cone's side, or from its tip.
    return aside * cosine - along * sine <= ball.radius + kRangeShare * glm::length(d);
}

SeenBodies seen_bodies(const Scene& scene, const Camera& camera, int lines,
                       const std::function<std::span<const Cluster>(std::size_t mesh)>& clusters) {
    SeenBodies out{wider(camera, lines), {}};
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
        const Lies where = out.view.lies(box);
        if (where == Lies::Beyond) continue;
        const std::span<const Cluster> parts = clusters(std::size_t(object.mesh));
        const auto has_sides = [](const Cluster& part) { return part.axis != glm::dvec3(0); };
        const bool sides = std::ranges::any_of(parts, has_sides) && keeps_sides(object.world);
        glm::dmat4& mesh_from_world = out.mesh_from_world[number];
        if (sides) mesh_from_world = glm::inverse(object.world);
        const glm::dvec4 eye =
            mesh_from_world * (camera.orthographic ? glm::dvec4(camera.axes[2], 0) : glm::dvec4(camera.eye, 1));
        const auto side = [&](const Cluster& part) { return sides ? visible_side(part, eye) : VisibleSide::Either; };
        if (parts.size() > 1) {
            for (const Cluster& part : parts) {
                const Box corners = part.box.corners(object.world);
                if (where != Lies::Within && out.view.lies(corners) == Lies::Beyond) continue;
                out.bodies.push_back({corners, {}, part, side(part), number});
            }
            continue;
        }
        const Cluster whole = parts.empty() ? Cluster{mesh.bounds} : parts[0];
        if (where == Lies::Within) {
            out.bodies.push_back({box, {}, whole, side(whole), number});
        } else if (std::vector<glm::dvec3> seen = out.view.seen_of(box); !seen.empty()) {
            out.bodies.push_back({box, std::move(seen), whole, side(whole), number});
        }
    }
    return out;
}

NeededMaps needed_maps(const FittedLight& light, const SeenBodies& seen, const LookupArea& area) {
    NeededMaps out;
    if (area.light_alone && light.radiance == glm::dvec3(0)) {
        out.views.resize(light.views.size());
        out.uncalled = kBringsNothing;
        return out;
    }
    if (seen.unknown || light.chooser.choice == ViewChoice::Distance) {
        out.views.assign(light.views.size(), MapCells::whole());
        return out;
    }
    std::vector<ViewRegion> views;
    for (std::size_t v = 0; v < light.views.size(); ++v) views.emplace_back(light, v, area);
    bool arrives = false, turned = false;
    for (const SeenBody& body : seen.bodies) {
        if (area.light_alone && !arrives_at(light, body.points())) continue;
        arrives = true;
        if (is_turned_away(body, seen, light)) {
            turned = true;
            continue;
        }
        for (ViewRegion& view : views) view.add(seen, body);
    }
    bool called = false;
    for (const ViewRegion& view : views) {
        out.views.push_back(view.region);
        called |= !view.region.empty();
    }
    if (!called)
        out.uncalled = seen.bodies.empty() ? "the camera sees nothing"
                       : !arrives          ? none_arrives(light)
                       : turned            ? "all that the camera sees is turned away from the light, or lies beside it"
                                           : "nothing that the camera sees is looked up in it";
    return out;
}

}  // namespace si
