#include "tests/support/bundle_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <set>

#include "tests/support/process.h"

namespace si::test {

using Json = nlohmann::json;

GivenMap read_given_map(const std::filesystem::path& bundle, const Json& json) {
    GivenMap out;
    out.json = json;
    const Json& image = json["image"];
    const std::string bytes = file_bytes(bundle / image["file"].get<std::string>());
    const bool is_raw = image.contains("format");
    int width = is_raw ? image["width"].get<int>() : 0, height = is_raw ? image["height"].get<int>() : 0;
    std::size_t start = 0;
    if (!is_raw) {
        int used = 0;
        EXPECT_EQ(std::sscanf(bytes.c_str(), "Pf\n%d %d\n-1.0\n%n", &width, &height, &used), 2);
        start = std::size_t(used);
    }
    const std::size_t size = is_raw ? 2 : 4;
    EXPECT_EQ(bytes.size() - start, std::size_t(width) * std::size_t(height) * size);
    std::array<int, 4> region = {0, 0, width, height};
    if (json.contains("region")) region = json["region"].get<std::array<int, 4>>();
    out.width = region[2];
    out.height = region[3];
    EXPECT_EQ(image["first_row"], "bottom");
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) {
            const char* at = bytes.data() + start +
                             (std::size_t(region[1] + y) * std::size_t(width) + std::size_t(region[0] + x)) * size;
            std::uint16_t whole = 0;
            float real = 0;
            std::memcpy(is_raw ? static_cast<void*>(&whole) : &real, at, size);
            out.depth.push_back(is_raw ? whole / 65535.0 : double(real));
        }
    out.clip_from_world = glm::make_mat4(json["clip_from_world"].get<std::vector<double>>().data());
    const Json& depth = json["depth"];
    if (depth["reversed"]) std::swap(out.near_value, out.far_value);
    if (depth["range"] == "0..1") {
        out.ndc_near = out.near_value;
        out.ndc_far = out.far_value;
    }
    const std::map<std::string, int> bits = {{"d16", 16}, {"d24", 24}, {"d32f", 23}, {"r16f", 11}};
    out.step = std::ldexp(1, -bits.at(depth["format"]));
    return out;
}

namespace {

/// BundleTriangle of the scene in world space.
struct BundleTriangle {
    std::array<glm::dvec3, 3> corner;
    std::array<glm::dvec2, 3> uv;
    const Texture* mask = nullptr;
    double cutoff = 0;
};

/// Returns the triangles of all objects that cast shadows.
std::vector<BundleTriangle> casting_triangles(const Scene& scene) {
    std::vector<BundleTriangle> out;
    std::set<std::string> left_out;
    for (const auto& [key, value] : scene.suggested)
        if (value == "false") left_out.insert(key);
    for (const Object& object : scene.objects) {
        if (left_out.contains("object." + scene.nodes[std::size_t(object.node)].path + ".cast")) continue;
        const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
        const Material& material = scene.materials[std::size_t(mesh.material)];
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            BundleTriangle t;
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t vertex = mesh.indices[i + c];
                t.corner[c] = object.world * glm::dvec4(glm::dvec3(mesh.positions[vertex]), 1);
                t.uv[c] = mesh.uv.empty() ? glm::vec2(0) : mesh.uv[vertex];
            }
            if (material.alpha == AlphaMode::Mask) {
                t.mask = &scene.textures[std::size_t(material.base_colour_texture)];
                t.cutoff = double(material.alpha_cutoff);
            }
            out.push_back(t);
        }
    }
    return out;
}

/// Returns the alpha of a repeated texture, linearly between four texels.
double alpha_at(const Texture& texture, glm::dvec2 uv) {
    const glm::dvec2 at = uv * glm::dvec2(texture.width, texture.height) - 0.5;
    const glm::dvec2 low = glm::floor(at), part = at - low;
    const auto texel = [&](int dx, int dy) {
        const int x = (int(low.x) + dx + texture.width) % texture.width;
        const int y = (int(low.y) + dy + texture.height) % texture.height;
        return texture.rgba[std::size_t(y * texture.width + x) * 4 + 3] / 255.0;
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), part.x), glm::mix(texel(0, 1), texel(1, 1), part.x), part.y);
}

/// Ray tracer for one map: depth of the nearest caster as the recorded state stores it.
class MapRays {
public:
    MapRays(const GivenMap& map, const Scene& scene)
        : map_(map), world_from_clip_(glm::inverse(map.clip_from_world)), triangles_(casting_triangles(scene)) {
        const Json& raster = map.json["raster"];
        factor_ = raster["offset_factor"];
        units_ = raster["offset_units"];
        cull_ = raster["cull"];
        EXPECT_EQ(raster["front"], "ccw");
    }
    /// Stored value, and how much it changes at most over a texel along each side.
    struct Hit {
        double depth, slope;
    };
    /// Returns the stored value at a texel's centre; the far plane's where no caster is.
    Hit stored(double x, double y) const {
        const auto [from, to] = ray(x, y);
        Hit out{map_.far_value, 0};
        const bool reversed = map_.near_value > map_.far_value;
        for (const BundleTriangle& t : triangles_) {
            const glm::dvec3 a = t.corner[1] - t.corner[0], b = t.corner[2] - t.corner[0], along = to - from;
            const glm::dvec3 normal = glm::cross(a, b);
            const double facing = glm::dot(normal, along);
            if (facing == 0 || (cull_ == "back" && facing > 0) || (cull_ == "front" && facing < 0)) continue;
            const double share = glm::dot(normal, t.corner[0] - from) / facing;
            if (share < 0 || share > 1) continue;
            const glm::dvec3 hit = from + share * along, within = hit - t.corner[0];
            const double area = glm::dot(normal, normal);
            const double v = glm::dot(normal, glm::cross(within, b)) / area;
            const double w = glm::dot(normal, glm::cross(a, within)) / area;
            if (v < 0 || w < 0 || v + w > 1) continue;
            if (t.mask && alpha_at(*t.mask, (1 - v - w) * t.uv[0] + v * t.uv[1] + w * t.uv[2]) < t.cutoff) continue;
            const double across = plane_depth(t, normal, x + 0.5, y) - plane_depth(t, normal, x - 0.5, y);
            const double up = plane_depth(t, normal, x, y + 0.5) - plane_depth(t, normal, x, y - 0.5);
            const double slope = std::max(std::abs(across), std::abs(up));
            const double offset = factor_ == 0 && units_ == 0 ? 0 : factor_ * slope + units_ * map_.step;
            const double depth = std::clamp(window_depth(hit) + offset, 0.0, 1.0);
            if (reversed ? depth > out.depth : depth < out.depth) out = {depth, std::abs(across) + std::abs(up)};
        }
        return out;
    }

private:
    std::pair<glm::dvec3, glm::dvec3> ray(double x, double y) const {
        const glm::dvec2 ndc = 2.0 * glm::dvec2(x, y) / glm::dvec2(map_.width, map_.height) - 1.0;
        const auto world = [&](double z) {
            const glm::dvec4 p = world_from_clip_ * glm::dvec4(ndc, z, 1);
            return glm::dvec3(p) / p.w;
        };
        return {world(map_.ndc_near), world(map_.ndc_far)};
    }
    double window_depth(const glm::dvec3& at) const {
        const glm::dvec4 clip = map_.clip_from_world * glm::dvec4(at, 1);
        const double share = (clip.z / clip.w - map_.ndc_near) / (map_.ndc_far - map_.ndc_near);
        return glm::mix(map_.near_value, map_.far_value, share);
    }
    /// Returns the depth of a triangle's plane at a place of the map.
    double plane_depth(const BundleTriangle& t, const glm::dvec3& normal, double x, double y) const {
        const auto [from, to] = ray(x, y);
        return window_depth(from + glm::dot(normal, t.corner[0] - from) / glm::dot(normal, to - from) * (to - from));
    }

    const GivenMap& map_;
    glm::dmat4 world_from_clip_;
    std::vector<BundleTriangle> triangles_;
    double factor_ = 0, units_ = 0;
    std::string cull_;
};

}  // namespace

MapAgreement compare_with_rays(const GivenMap& map, const Scene& scene, int every, double snap_texels) {
    const MapRays rays(map, scene);
    // A unit of polygon offset is one or two steps: OpenGL leaves it to the driver, and Mesa takes two.
    const double units = map.json["raster"]["offset_units"];
    std::array<std::vector<double>, 2> steps_by_unit;
    MapAgreement out;
    const auto is_covered_nearby = [&](double x, double y, bool wanted) {
        for (const auto& [dx, dy] : {std::pair{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}) {
            const double depth = rays.stored(x + dx * snap_texels, y + dy * snap_texels).depth;
            if ((depth != map.far_value) == wanted) return true;
        }
        return false;
    };
    for (int y = 0; y < map.height; y += every)
        for (int x = 0; x < map.width; x += every) {
            const double given = map.depth[std::size_t(y) * std::size_t(map.width) + std::size_t(x)];
            const auto own = rays.stored(x + 0.5, y + 0.5);
            const bool is_given = given != map.far_value;
            const bool is_own = own.depth != map.far_value;
            out.covered += is_given;
            if (is_given != is_own && (snap_texels == 0 || !is_covered_nearby(x + 0.5, y + 0.5, is_given)))
                ++(is_given ? out.missed : out.extra);
            if (!is_given || !is_own) continue;
            for (std::size_t more = 0; more < 2; ++more) {
                const double difference = std::abs(given - own.depth - double(more) * units * map.step);
                steps_by_unit[more].push_back(std::max(0.0, difference - own.slope * snap_texels) / map.step);
            }
        }
    for (std::vector<double>& steps : steps_by_unit) std::ranges::sort(steps);
    const auto middle = [](const std::vector<double>& steps) { return steps.empty() ? 0 : steps[steps.size() / 2]; };
    out.steps = std::ranges::min(steps_by_unit, {}, middle);
    return out;
}

}  // namespace si::test
