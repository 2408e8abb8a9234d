#include "renderer/reference/precision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "renderer/projection/projection.h"

namespace si {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

/// Corners of a triangle in world space and in a view's map, in double precision.
struct Corners {
    std::array<glm::dvec3, 3> ws, uvd;
};

/// Converts a triangle to map coordinates. Positions are relative to the scene's centre, for precision.
std::optional<Corners> corners_of(const Scene& scene, const glm::uvec2& id, const LightView& view,
                                  const glm::dmat4& uvd_from_centred, const glm::dvec3& centre) {
    if (id.x == 0 || id.x > scene.objects.size()) return std::nullopt;
    const Object& object = scene.objects[id.x - 1];
    const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
    const std::size_t triangles = mesh.indices.size() / 3;
    if (triangles == 0) return std::nullopt;
    Corners out;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec3& local = mesh.positions[mesh.indices[3 * (id.y % triangles) + i]];
        out.ws[i] = glm::dvec3(object.world * glm::dvec4(glm::dvec3(local), 1)) - centre;
        const glm::dvec4 h = uvd_from_centred * glm::dvec4(out.ws[i], 1);
        if (!(h.w > 0) && (view.curve.perspective || view.warped())) return std::nullopt;  // behind the light
        out.uvd[i] = glm::dvec3(h) / h.w;
    }
    return out;
}

/// Returns the point where a ray meets the triangle's plane; none for a parallel ray.
std::optional<glm::dvec3> meet(const Corners& t, const glm::dvec3& origin, const glm::dvec3& dir) {
    const glm::dvec3 normal = glm::cross(t.ws[1] - t.ws[0], t.ws[2] - t.ws[0]);
    const double slope = glm::dot(normal, dir);
    if (!(std::abs(slope) > 1e-6 * glm::length(normal) * glm::length(dir))) return std::nullopt;
    return origin + dir * (glm::dot(normal, t.ws[0] - origin) / slope);
}

/// Returns the plane's depth at map coordinates; none for an edge-on plane. Depths are affine over a triangle under
/// every projection.
std::optional<double> plane_depth(const Corners& t, const glm::dvec2& uv) {
    const glm::dvec2 a(t.uvd[1] - t.uvd[0]), b(t.uvd[2] - t.uvd[0]), c = uv - glm::dvec2(t.uvd[0]);
    const double det = a.x * b.y - a.y * b.x;
    if (!(std::abs(det) > 1e-4 * glm::length(a) * glm::length(b))) return std::nullopt;
    const double s = (c.x * b.y - c.y * b.x) / det, q = (a.x * c.y - a.y * c.x) / det;
    return t.uvd[0].z + s * (t.uvd[1].z - t.uvd[0].z) + q * (t.uvd[2].z - t.uvd[0].z);
}

/// Returns the step of a 32-bit float at a depth.
double float_step(double depth) {
    const double d = std::max(std::abs(depth), 0x1p-126);
    return std::exp2(std::floor(std::log2(d)) - 23);
}

PrecisionSpread precision_spread_of(const FloatImage& error, int channel) {
    std::vector<float> values;
    PrecisionSpread out;
    for (int y = 0; y < error.height; ++y)
        for (int x = 0; x < error.width; ++x) {
            const float v = error.at(x, y, channel);
            if (std::isnan(v)) continue;
            values.push_back(v);
            if (!(v <= out.worst)) {
                out.worst = v;
                out.worst_at = {x, y};
            }
        }
    if (values.empty()) return out;
    const auto share = [&](double p) {
        const auto at = values.begin() + std::ptrdiff_t(p * double(values.size() - 1));
        std::nth_element(values.begin(), at, values.end());
        return double(*at);
    };
    out.median = share(0.5);
    out.p99 = share(0.99);
    return out;
}

}  // namespace

Precision measure_precision(const Scene& scene, const Camera& camera, const FittedLight& light, MapSize size,
                            const DrawnLookUps& drawn) {
    const int width = drawn.uvd.width, height = drawn.uvd.height;
    Precision out;
    out.error = {width, height, 2, std::vector<float>(std::size_t(width) * std::size_t(height) * 2, kNothing)};
    const glm::dvec3 centre = scene.bounds.centre();
    std::vector<glm::dmat4> uvd_from_centred;
    for (const LightView& view : light.views)
        uvd_from_centred.push_back(uvd_from_clip(view.curve.convention) * view.clip_from_relative(centre));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t pixel = std::size_t(y) * std::size_t(width) + std::size_t(x);
            const float layer = drawn.uvd.at(x, y, 3);
            if (!(layer >= 1) || std::size_t(layer) > light.views.size()) continue;
            const std::size_t v = std::size_t(layer) - 1;
            const auto corners = corners_of(scene, drawn.ids.data[pixel], light.views[v], uvd_from_centred[v], centre);
            if (!corners) continue;
            ++out.pixels;
            const glm::dvec3 looked_up(drawn.uvd.at(x, y, 0), drawn.uvd.at(x, y, 1), drawn.uvd.at(x, y, 2));
            glm::dvec3 origin, dir;
            camera.pixel_ray(x, y, width, height, origin, dir);
            if (const auto at = meet(*corners, origin - centre, dir)) {
                const glm::dvec4 h = uvd_from_centred[v] * glm::dvec4(*at, 1);
                const double texels = glm::length((glm::dvec2(h) / h.w - glm::dvec2(looked_up)) * size.texels());
                if (std::isfinite(texels)) out.error.data[2 * pixel] = float(texels);
            }
            if (const auto depth = plane_depth(*corners, glm::dvec2(looked_up)))
                out.error.data[2 * pixel + 1] = float(std::abs(looked_up.z - *depth) / float_step(*depth));
        }
    out.texels = precision_spread_of(out.error, 0);
    out.ulps = precision_spread_of(out.error, 1);
    return out;
}

}  // namespace si
