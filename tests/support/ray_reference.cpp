#include "tests/support/ray_reference.h"

#include <algorithm>
#include <cmath>

#include "renderer/bias/light_receiver.h"

namespace si::test {
namespace {

constexpr double kFar = 1e300;

/// Returns the distance of a two-sided hit; infinite for a miss. Möller and Trumbore, Fast, Minimum Storage
/// Ray/Triangle Intersection, 1997.
double intersect(const Triangle& t, const glm::dvec3& origin, const glm::dvec3& dir) {
    const glm::dvec3 e1 = t.b - t.a, e2 = t.c - t.a, p = glm::cross(dir, e2);
    const double det = glm::dot(e1, p);
    if (det == 0) return INFINITY;
    const glm::dvec3 s = origin - t.a;
    const double u = glm::dot(s, p) / det;
    if (!(u >= -1e-12 && u <= 1 + 1e-12)) return INFINITY;
    const glm::dvec3 q = glm::cross(s, e1);
    const double v = glm::dot(dir, q) / det;
    if (!(v >= -1e-12 && u + v <= 1 + 1e-12)) return INFINITY;
    return glm::dot(e2, q) / det;
}

}  // namespace

RayReference::RayReference(const Scene& scene)
    : centre_(scene.bounds.centre()), radius_(std::max(scene.bounds.radius(), 1e-9)) {
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& o = scene.objects[i];
        const Mesh& mesh = scene.meshes[std::size_t(o.mesh)];
        glm::dmat4 world = o.world;
        world[3] -= glm::dvec4(centre_, 0);
        const auto at = [&](std::uint32_t k) {
            return glm::dvec3(world * glm::dvec4(glm::dvec3(mesh.positions[k]), 1));
        };
        Group group{triangles_.size(), 0};
        Bounds box;
        for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
            Triangle t{at(mesh.indices[k]), at(mesh.indices[k + 1]), at(mesh.indices[k + 2]), {}, int(i)};
            const glm::dvec3 n = glm::cross(t.b - t.a, t.c - t.a);
            if (!(glm::dot(n, n) > 0)) continue;
            t.normal = glm::normalize(n);
            triangles_.push_back(t);
            for (const glm::dvec3& corner : {t.a, t.b, t.c}) box.add(corner);
        }
        group.end = triangles_.size();
        group.centre = box.centre();
        group.radius = box.radius() * (1 + 1e-9) + 1e-9 * radius_;
        if (group.end > group.begin) groups_.push_back(group);
    }
}

template <class Visit>
bool RayReference::visit_near_line(const glm::dvec3& origin, const glm::dvec3& direction, Visit visit) const {
    const double length2 = glm::dot(direction, direction);
    for (const Group& g : groups_) {
        const glm::dvec3 aside = glm::cross(g.centre - origin, direction);
        if (glm::dot(aside, aside) > g.radius * g.radius * length2) continue;
        for (std::size_t i = g.begin; i < g.end; ++i)
            if (visit(i)) return true;
    }
    return false;
}

std::optional<Hit> RayReference::first_hit(const glm::dvec3& origin_ws, const glm::dvec3& direction) const {
    const glm::dvec3 origin = origin_ws - centre_;
    Hit hit;
    hit.distance = kFar;
    visit_near_line(origin, direction, [&](std::size_t i) {
        const double t = intersect(triangles_[i], origin, direction);
        if (t > 0 && t < hit.distance) {
            hit.distance = t;
            hit.triangle = int(i);
        }
        return false;
    });
    if (hit.triangle < 0) return std::nullopt;
    hit.position = origin_ws + hit.distance * direction;
    hit.normal = triangles_[std::size_t(hit.triangle)].normal;
    if (glm::dot(hit.normal, direction) > 0) hit.normal = -hit.normal;
    return hit;
}

bool RayReference::occluded(const glm::dvec3& point_ws, const FittedLight& light, int own, double least) const {
    const glm::dvec3 dir = direction_to(light, point_ws), origin = point_ws - centre_;
    const double reach = light.type == LightType::Directional ? kFar : glm::distance(light.position, point_ws);
    // Neighbours in the receiver's own plane have hits at distance 0.
    const double from = std::max(least, 1e-9 * radius_);
    return visit_near_line(origin, dir, [&](std::size_t i) {
        if (int(i) == own) return false;
        const double t = intersect(triangles_[i], origin, dir);
        return t > from && t < reach;
    });
}

glm::dvec3 direction_to(const FittedLight& light, const glm::dvec3& point_ws) {
    return light.type == LightType::Directional ? light.to_light : glm::normalize(light.position - point_ws);
}

const LightView& view_of(const FittedLight& light, const glm::dvec3& point_ws) {
    if (light.views.size() != 6) return light.views[light.chooser.choose(light.views, point_ws).view];
    const glm::dvec3 d = point_ws - light.position, a = glm::abs(d);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    return light.views[std::size_t(2 * axis + (d[axis] < 0))];
}

glm::dvec4 uvdw(const LightView& view, const glm::dvec3& point_ws) {
    const glm::dvec4 q = view.clip_from_relative(point_ws)[3];
    const double z = view.curve.convention.zero_to_one ? q.z / q.w : 0.5 * q.z / q.w + 0.5;
    return {0.5 * q.x / q.w + 0.5, 0.5 * q.y / q.w + 0.5, z, q.w};
}

bool meets_box(const glm::dvec3& p, const glm::dvec3& d, double most, const glm::dvec3& lo, const glm::dvec3& hi) {
    double from = 0, to = most;
    for (int axis = 0; axis < 3; ++axis) {
        if (d[axis] == 0) {
            if (p[axis] < lo[axis] || p[axis] > hi[axis]) return false;
            continue;
        }
        double a = (lo[axis] - p[axis]) / d[axis], b = (hi[axis] - p[axis]) / d[axis];
        if (a > b) std::swap(a, b);
        from = std::max(from, a);
        to = std::min(to, b);
    }
    return from <= to;
}

std::vector<PixelRay> pixel_rays(const Camera& camera, int width, int height, int step, int first) {
    std::vector<PixelRay> out;
    for (int y = first; y < height; y += step)
        for (int x = first; x < width; x += step) {
            PixelRay& ray = out.emplace_back(PixelRay{.x = x, .y = y});
            camera.pixel_ray(x, y, width, height, ray.origin, ray.direction);
        }
    return out;
}

std::vector<PixelHit> pixel_hits(const RayReference& scene, const Camera& camera, int width, int height, int step,
                                 int first) {
    std::vector<PixelHit> out;
    for (const auto& [x, y, origin, direction] : pixel_rays(camera, width, height, step, first))
        if (const auto hit = scene.first_hit(origin, direction)) out.push_back({x, y, *hit});
    return out;
}

ReferenceImage trace_reference(const RayReference& scene, const Camera& camera, const FittedLight& light, int width,
                               int height, int map_resolution, double reach_texels) {
    ReferenceImage image;
    image.width = width;
    image.height = height;
    image.states.assign(std::size_t(width) * std::size_t(height), ReferenceState::Nothing);
    image.hits.resize(image.states.size());
    for (const auto& [x, y, origin, dir] : pixel_rays(camera, width, height)) {
        const std::size_t at = std::size_t(y) * std::size_t(width) + std::size_t(x);
        const std::optional<Hit> hit = image.hits[at] = scene.first_hit(origin, dir);
        if (!hit) continue;
        if (!faces_light(glm::dot(hit->normal, direction_to(light, hit->position)))) {
            image.states[at] = ReferenceState::Away;
            continue;
        }
        const bool shadow = scene.occluded(hit->position, light, hit->triangle);
        image.states[at] = shadow ? ReferenceState::Shadow : ReferenceState::Lit;
        if (!(reach_texels > 0)) continue;
        // The receiver's plane under map places around the point, along the light's rays.
        const LightView& view = view_of(light, hit->position);
        const double step = view.texel_size_at(hit->position, map_resolution).longest;
        for (int i = -2; i <= 2; ++i)
            for (int j = -2; j <= 2; ++j) {
                const glm::dvec3 aside =
                    0.5 * reach_texels * step * (double(i) * view.axes[0] + double(j) * view.axes[1]);
                const glm::dvec3 at_depth = hit->position + aside;
                const glm::dvec3 ray = view.curve.perspective ? at_depth - view.eye : -view.axes[2];
                const double slope = glm::dot(ray, hit->normal);
                const glm::dvec3 moved = at_depth - ray * (glm::dot(aside, hit->normal) / slope);
                if (scene.occluded(moved, light, hit->triangle) != shadow) image.states[at] = ReferenceState::Boundary;
            }
    }
    return image;
}

}  // namespace si::test
