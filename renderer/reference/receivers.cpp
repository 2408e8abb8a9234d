#include "renderer/reference/receivers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/base/directions.h"

namespace si {
namespace {

/// Clamps barycentric coordinates (1-u-v, u, v) to triangle `t` and returns the point.
glm::dvec3 inside(const TriangleWs& t, double u, double v) {
    if (!std::isfinite(u + v)) u = v = 1.0 / 3;  // edge-on
    double w = std::max(1 - u - v, 0.0);
    u = std::max(u, 0.0);
    v = std::max(v, 0.0);
    const double sum = u + v + w;
    return (w * t[0] + u * t[1] + v * t[2]) / sum;
}

/// Triangle with the values that all its pixels share.
struct Prepared {
    std::uint32_t object = Receiver::kNothing, primitive = 0;
    TriangleWs corners{};
    glm::dvec3 e1{0}, e2{0}, normal{0};
    float edge_m = 0;
    bool mirrored = false;

    void load(const ReferenceGeometry& geometry, std::uint32_t new_object, std::uint32_t drawn_primitive) {
        if (new_object >= geometry.objects.size() || geometry.objects[new_object].mesh->indices.empty())
            throw Error(fmt::format("a pixel shows object {}, but the traced scene has {}", new_object,
                                    geometry.objects.size()));
        // Drivers may continue to count primitives over the instances of a draw.
        const auto count = std::uint32_t(geometry.objects[new_object].mesh->triangles());
        const std::uint32_t new_primitive = drawn_primitive % count;
        if (new_object == object && new_primitive == primitive) return;
        object = new_object;
        primitive = new_primitive;
        corners = geometry.triangle(object, primitive);
        e1 = corners[1] - corners[0];
        e2 = corners[2] - corners[0];
        mirrored = glm::determinant(glm::dmat3(geometry.objects[object].world)) < 0;
        normal = unit_normal(corners[0], corners[1], corners[2]);
        edge_m = float(std::max({glm::length(e1), glm::length(e2), glm::length(e2 - e1)}));
    }

    Receiver meet(const glm::dvec3& origin, const glm::dvec3& dir) const {
        Receiver r;
        r.object = object;
        r.primitive = primitive;
        r.edge_m = edge_m;
        r.normal_ws = glm::dot(normal, dir) > 0 ? -normal : normal;
        if (normal == glm::dvec3(0)) r.normal_ws = -dir;
        r.front = (glm::dot(normal, dir) <= 0) != mirrored;
        // Möller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997.
        const glm::dvec3 p = glm::cross(dir, e2), s = origin - corners[0], q = glm::cross(s, e1);
        const double det = glm::dot(e1, p);
        r.position_ws = inside(corners, glm::dot(s, p) / det, glm::dot(dir, q) / det);
        return r;
    }
};

/// Returns true when two neighbouring pixels show one surface: each point is close to the other's plane, compared with
/// the distance of the points.
bool joined(const Receiver& a, const Receiver& b) {
    if (!a.hit() || !b.hit()) return false;
    const glm::dvec3 d = b.position_ws - a.position_ws;
    const double most = 0.5 * glm::length(d);
    return std::abs(glm::dot(d, a.normal_ws)) <= most && std::abs(glm::dot(d, b.normal_ws)) <= most;
}

constexpr std::size_t kRowsPlaced = 16;  ///< rows per block of work

void join_row_below(Receivers& to, std::size_t y) {
    const auto width = std::size_t(to.width);
    for (std::size_t x = 0; x < width; ++x) {
        Receiver& r = to.pixels[y * width + x];
        r.same_surface_below = joined(r, to.pixels[(y + 1) * width + x]);
    }
}

/// Sets same_surface_right and same_surface_below for a row of receivers. @param below the row below is complete
void join_row(Receivers& to, std::size_t y, bool below) {
    const auto width = std::size_t(to.width);
    for (std::size_t x = 0; x + 1 < width; ++x) {
        Receiver& r = to.pixels[y * width + x];
        r.same_surface_right = joined(r, to.pixels[y * width + x + 1]);
    }
    if (below) join_row_below(to, y);
}

Receiver meet(const Prepared& triangle, const Camera& camera, std::size_t x, std::size_t y, int width, int height) {
    glm::dvec3 origin, dir;
    camera.pixel_ray(double(x), double(y), width, height, origin, dir);
    return triangle.meet(origin, dir);
}

}  // namespace

glm::vec3 ray_origin(const UnitFrame& frame, const Receiver& r) {
    const glm::dvec3 point = frame.to_unit(r.position_ws), a = glm::abs(point);
    // Rounding errors of corners, origin and intersection are proportional to the largest coordinate involved.
    const double largest = std::max({a.x, a.y, a.z, double(r.edge_m) * frame.scale});
    return glm::vec3(point + r.normal_ws * (32 * 0x1p-23 * largest));
}

Receivers reconstruct_receivers(const ReferenceGeometry& geometry, const Camera& camera, const SurfaceIds& ids,
                                const PixelRaster& raster, const Workers& workers) {
    Receivers out{ids.width, ids.height, {}};
    out.pixels.resize(ids.data.size());
    out.starts.resize(ids.data.size());
    const UnitFrame frame = geometry.unit_frame();
    const auto step = std::size_t(raster.step), left = std::size_t(raster.first.x), top = std::size_t(raster.first.y);
    const auto width = std::size_t(ids.width), height = std::size_t(ids.height);
    const std::size_t strips = (height + kRowsPlaced - 1) / kRowsPlaced;
    parallel_for_blocks(strips, workers.with_progress_range(0, 0.95), [&](std::size_t strip) {
        const std::size_t first = strip * kRowsPlaced, end = std::min(first + kRowsPlaced, height);
        Prepared triangle;
        for (std::size_t y = first; y < end; ++y)
            for (std::size_t x = 0; x < width; ++x) {
                const std::size_t i = y * width + x;
                const glm::uvec2 id = ids.data[i];
                Receiver r;
                RayStart start;
                if (id.x != 0) {
                    triangle.load(geometry, id.x - 1, id.y);
                    r = meet(triangle, camera, left + x * step, top + y * step, raster.width, raster.height);
                    start = {ray_origin(frame, r), glm::vec3(r.normal_ws), r.object};
                }
                out.pixels[i] = r;
                out.starts[i] = start;
            }
        for (std::size_t y = first; y < end; ++y) join_row(out, y, y + 1 < end);  // while it is in the cache
    });
    parallel_for_blocks(strips, workers.with_progress_range(0.95, 1), [&](std::size_t strip) {
        if (const std::size_t below = (strip + 1) * kRowsPlaced; below < height) join_row_below(out, below - 1);
    });
    out.held = TrackedMemory("receivers", array_bytes(out.pixels) + array_bytes(out.starts));
    return out;
}

}  // namespace si
