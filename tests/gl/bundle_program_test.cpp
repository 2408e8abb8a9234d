// Runs assets/bundle/examples/opengl.c, a renderer that shares nothing with this program, and compares the maps of its
// bundle with rays through the bundle's own scene, by the bundle's own matrices.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "renderer/gltf/gltf.h"
#include "renderer/gltf/image_decode.h"
#include "tests/support/process.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// One map of a bundle: depths of its region, row 0 at clip y = -1.
struct GivenMap {
    Json json;
    int width = 0, height = 0;
    std::vector<double> depth;
    glm::dmat4 clip_from_world{1};
    double near_value = 0, far_value = 1;  ///< stored values of the near and far plane
    double step = 0;                       ///< smallest difference of stored values near 1
    double ndc_near = -1, ndc_far = 1;
};

GivenMap read_map(const fs::path& bundle, const Json& json) {
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
    out.step = depth["format"] == "d16" ? std::ldexp(1, -16) : std::ldexp(1, -23);
    return out;
}

/// Triangle of the scene in world space.
struct Triangle {
    std::array<glm::dvec3, 3> corner;
    std::array<glm::dvec2, 3> uv;
    const Texture* mask = nullptr;
    double cutoff = 0;
};

std::vector<Triangle> triangles_of(const Scene& scene) {
    std::vector<Triangle> out;
    for (const Object& object : scene.objects) {
        const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
        const Material& material = scene.materials[std::size_t(mesh.material)];
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            Triangle t;
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
    MapRays(const GivenMap& map, std::vector<Triangle> triangles)
        : map_(map), world_from_clip_(glm::inverse(map.clip_from_world)), triangles_(std::move(triangles)) {
        const Json& raster = map.json["raster"];
        factor_ = raster["offset_factor"];
        units_ = raster["offset_units"];
        cull_ = raster["cull"];
        EXPECT_EQ(raster["front"], "ccw");
    }
    /// Returns the stored value at a texel's centre; the far plane's where no caster is.
    double stored(double x, double y) const {
        const auto [from, to] = ray(x, y);
        double out = map_.far_value;
        const bool reversed = map_.near_value > map_.far_value;
        for (const Triangle& t : triangles_) {
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
            const double slope =
                std::max(std::abs(plane_depth(t, normal, x + 0.5, y) - plane_depth(t, normal, x - 0.5, y)),
                         std::abs(plane_depth(t, normal, x, y + 0.5) - plane_depth(t, normal, x, y - 0.5)));
            const double offset = factor_ == 0 && units_ == 0 ? 0 : factor_ * slope + units_ * map_.step;
            const double depth = std::clamp(window_depth(hit) + offset, 0.0, 1.0);
            out = reversed ? std::max(out, depth) : std::min(out, depth);
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
    double plane_depth(const Triangle& t, const glm::dvec3& normal, double x, double y) const {
        const auto [from, to] = ray(x, y);
        return window_depth(from + glm::dot(normal, t.corner[0] - from) / glm::dot(normal, to - from) * (to - from));
    }

    const GivenMap& map_;
    glm::dmat4 world_from_clip_;
    std::vector<Triangle> triangles_;
    double factor_ = 0, units_ = 0;
    std::string cull_;
};

struct Case {
    const char* name;
    const char* options;
    std::size_t maps;
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.options;
}

class BundleProgram : public testing::TestWithParam<Case> {};

TEST_P(BundleProgram, MapsHoldTheirScene) {
    const fs::path bundle = fresh_test_folder() / "frame.bundle";
    const ProcessResult run = run_shell("'" + std::string(SI_BUNDLE_WRITERS) + "/bundle_opengl' '" + bundle.string() +
                                        "' " + GetParam().options);
    ASSERT_EQ(run.code, 0) << run.err;
    const Json frame = Json::parse(file_bytes(bundle / "frame.json"));
    const Scene scene = load_gltf(bundle / frame["scene"].get<std::string>());
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    const std::string png = file_bytes(bundle / frame["picture"].get<std::string>());
    const gltf::Image picture = gltf::decode_image({reinterpret_cast<const std::uint8_t*>(png.data()), png.size()});
    EXPECT_EQ(picture.width, frame["camera"]["width"]);
    EXPECT_EQ(picture.height, frame["camera"]["height"]);

    ASSERT_EQ(frame["lights"].size(), 1u);
    const Json& maps = frame["lights"][0]["maps"];
    ASSERT_EQ(maps.size(), GetParam().maps);
    for (const Json& json : maps) {
        const GivenMap map = read_map(bundle, json);
        for (std::size_t i = 0; i < scene.nodes.size(); ++i) EXPECT_EQ(json["drawn"][i], scene.nodes[i].path);
        const MapRays rays(map, triangles_of(scene));
        std::size_t covered = 0, missed = 0, extra = 0;
        // A unit of polygon offset is one or two steps: OpenGL leaves it to the driver, and Mesa takes two.
        const double units = json["raster"]["offset_units"];
        std::array<std::vector<double>, 2> steps_by_unit;
        // Every third row and column is enough for the shares.
        for (int y = 0; y < map.height; y += 3)
            for (int x = 0; x < map.width; x += 3) {
                const double given = map.depth[std::size_t(y) * std::size_t(map.width) + std::size_t(x)];
                const double own = rays.stored(x + 0.5, y + 0.5);
                const bool is_given = given != map.far_value, is_own = own != map.far_value;
                covered += is_given;
                missed += is_given && !is_own;
                extra += is_own && !is_given;
                if (!is_given || !is_own) continue;
                for (std::size_t more = 0; more < 2; ++more)
                    steps_by_unit[more].push_back(std::abs((given - own) / map.step - double(more) * units));
            }
        EXPECT_GT(covered, 1000u);
        EXPECT_LE(double(missed), 0.001 * double(covered));
        EXPECT_LE(double(extra), 0.0001 * double(covered));
        for (std::vector<double>& steps : steps_by_unit) std::ranges::sort(steps);
        const auto middle = [](const std::vector<double>& steps) { return steps[steps.size() / 2]; };
        const std::vector<double>& steps = std::ranges::min(steps_by_unit, {}, middle);
        EXPECT_LE(middle(steps), 1);
        EXPECT_LE(steps[steps.size() * 99 / 100], 4);
        EXPECT_LE(steps[steps.size() * 999 / 1000], 4) << "masks and edges";
    }
}

INSTANTIATE_TEST_SUITE_P(All, BundleProgram,
                         testing::Values(Case{"CascadesOf16Bits", "--light sun --depth d16", 2},
                                         Case{"ReversedCascades", "--light sun --depth d32f --reversed --cull none", 2},
                                         Case{"SpotLight", "--light spot --depth d32f", 1},
                                         Case{"ReversedSpotLight", "--light spot --depth d16 --reversed --cull front",
                                              1}),
                         [](const testing::TestParamInfo<Case>& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace si
