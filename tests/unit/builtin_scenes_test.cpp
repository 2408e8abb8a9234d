// Tests of the built-in scenes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <ostream>
#include <set>

#include "renderer/base/error.h"
#include "renderer/gltf/gltf.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"
#include "tests/support/error_text.h"

namespace si {

/// Prints the name of a row for GoogleTest.
void PrintTo(const BuiltinScene& row, std::ostream* out) {
    *out << row.key;
}

namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

fs::path scratch(const std::string& name) {
    const fs::path folder = fs::path(testing::TempDir()) / "shadow-inspector-scenes";
    fs::create_directories(folder);
    return folder / name;
}

/// Returns the hash by Fowler, Noll and Vo (FNV-1a, 64 bits).
std::uint64_t fnv1a(const std::string& bytes) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char byte : bytes) hash = (hash ^ std::uint8_t(byte)) * 0x100000001b3;
    return hash;
}

/// Hash of each scene as a .glb file.
const std::map<std::string, std::string> kContents = {
    {"boxes", "a8753f6a8ea737b6"},  {"figures", "b66fcd7a2271c628"}, {"landscape", "3234defc65dc4dba"},
    {"plane", "ba6aa561348953c5"},  {"relief", "ab137dafd0471770"},  {"stage", "f7a26e20b9f81c17"},
    {"teapot", "7b3bd220b15d0726"},
};

void expect_equal_meshes(const Mesh& a, const Mesh& b, bool textured = true) {
    SCOPED_TRACE(a.name);
    EXPECT_EQ(a.name, b.name);
    EXPECT_TRUE(a.positions == b.positions);
    EXPECT_TRUE(a.normals == b.normals);
    EXPECT_TRUE(!textured || a.uv == b.uv);
    EXPECT_TRUE(a.colours == b.colours);
    EXPECT_TRUE(a.indices == b.indices);
    EXPECT_EQ(a.material, b.material);
}

void expect_equal_materials(const Material& a, const Material& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_TRUE(a.base_colour == b.base_colour);
    EXPECT_EQ(a.base_colour_texture, b.base_colour_texture);
    EXPECT_EQ(a.alpha, b.alpha);
    EXPECT_EQ(a.alpha_cutoff, b.alpha_cutoff);
    EXPECT_EQ(a.double_sided, b.double_sided);
}

void expect_equal_textures(const Texture& a, const Texture& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_TRUE(a.rgba == b.rgba);
    EXPECT_EQ(a.wrap_s, b.wrap_s);
    EXPECT_EQ(a.srgb, b.srgb);
}

/// Returns the lowest world y of objects whose path starts with `prefix`.
double lowest(const Scene& scene, const std::string& prefix) {
    double y = std::numeric_limits<double>::infinity();
    for (const Object& o : scene.objects) {
        if (scene.nodes[o.node].path.rfind(prefix, 0) != 0) continue;
        for (const glm::vec3& p : scene.meshes[o.mesh].positions) y = std::min(y, (o.world * glm::dvec4(p, 1)).y);
    }
    return y;
}

class BuiltinScenes : public testing::TestWithParam<BuiltinScene> {};

TEST_P(BuiltinScenes, AreValidWithoutWarnings) {
    const Scene scene = GetParam().make();
    EXPECT_EQ(scene.name, GetParam().key);
    EXPECT_FALSE(scene.about.empty());
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    EXPECT_EQ(scene.dropped_triangles, 0u);
    ASSERT_FALSE(scene.bounds.empty());
    EXPECT_TRUE(std::isfinite(scene.bounds.radius()));
    std::set<std::string> paths, materials;
    for (const Node& n : scene.nodes) EXPECT_TRUE(paths.insert(n.path).second) << n.path;
    for (const Node& n : scene.nodes) EXPECT_EQ(n.path.find('#'), std::string::npos) << n.path;
    for (const Material& m : scene.materials) EXPECT_TRUE(materials.insert(m.name).second) << m.name;
}

TEST_P(BuiltinScenes, HaveNormalsOnTheirFrontSides) {
    for (const Mesh& mesh : GetParam().make().meshes) {
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const auto p = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
            const glm::dvec3 cross = glm::cross(p(1) - p(0), p(2) - p(0));
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec3 n(mesh.normals[mesh.indices[i + k]]);
                wrong += !(glm::dot(n, cross) > 0) || std::abs(glm::length(n) - 1) > 1e-5;
            }
        }
        EXPECT_EQ(wrong, 0u) << mesh.name;
    }
}

TEST_P(BuiltinScenes, AreTheSameEachTime) {
    const Scene a = GetParam().make(), b = GetParam().make();
    EXPECT_NE(a.id, b.id);
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (std::size_t i = 0; i < a.meshes.size(); ++i) expect_equal_meshes(a.meshes[i], b.meshes[i]);
    ASSERT_EQ(a.objects.size(), b.objects.size());
    for (std::size_t i = 0; i < a.objects.size(); ++i) EXPECT_EQ(a.objects[i].world, b.objects[i].world);
    for (std::size_t i = 0; i < a.textures.size(); ++i) expect_equal_textures(a.textures[i], b.textures[i]);
}

TEST_P(BuiltinScenes, HaveACameraThatShowsThem) {
    const Scene scene = GetParam().make();
    ASSERT_FALSE(scene.cameras.empty());
    const SceneCamera& camera = scene.cameras[0];
    const glm::dmat4 view = glm::inverse(camera.world);
    const double half = std::tan(glm::radians(camera.fov_y_deg) / 2);
    std::size_t seen = 0;
    for (const Object& o : scene.objects) {
        const glm::dvec4 p = view * o.world * glm::dvec4(scene.meshes[o.mesh].bounds.centre(), 1);
        seen += p.z < 0 && std::abs(p.y) < -p.z * half && std::abs(p.x) < -p.z * half * 16 / 9;
    }
    EXPECT_GE(seen * 5, scene.objects.size()) << "fewer than a fifth of the objects are in the picture";
}

TEST_P(BuiltinScenes, SuggestSettingsThatExist) {
    const Scene scene = GetParam().make();
    EXPECT_FALSE(scene.suggested.empty());
    Settings settings;
    for (const auto& [key, value] : scene.suggested) EXPECT_NO_THROW(set_setting(settings, key, value)) << key;
    EXPECT_NE(settings, Settings{});
}

TEST_P(BuiltinScenes, LoadFromTheirFilesUnchanged) {
    const Scene made = GetParam().make();
    for (const char* extension : {".gltf", ".glb"}) {
        const fs::path path = scratch("round-trip-" + std::string(GetParam().key) + extension);
        save_gltf(made, path);
        const Scene read = load_scene(path.string());
        EXPECT_TRUE(read.warnings.empty()) << read.warnings.front();
        ASSERT_EQ(read.objects.size(), made.objects.size());
        EXPECT_EQ(read.triangle_count(), made.triangle_count());
        ASSERT_EQ(read.materials.size(), made.materials.size());
        for (std::size_t i = 0; i < made.materials.size(); ++i)
            expect_equal_materials(read.materials[i], made.materials[i]);
        ASSERT_EQ(read.textures.size(), made.textures.size());
        for (std::size_t i = 0; i < made.textures.size(); ++i)
            expect_equal_textures(read.textures[i], made.textures[i]);
        // Loaders may reorder objects and meshes: compare by the path of the node.
        std::map<std::string, const Object*> by_path;
        for (const Object& o : read.objects) by_path[read.nodes[o.node].path] = &o;
        for (const Object& o : made.objects) {
            const std::string& path_of_node = made.nodes[o.node].path;
            ASSERT_TRUE(by_path.count(path_of_node)) << path_of_node;
            const Object& other = *by_path[path_of_node];
            EXPECT_EQ(other.world, o.world) << path_of_node;
            if (&o - made.objects.data() > 80) continue;  // shared meshes: a sample is enough
            const Mesh& mesh = made.meshes[o.mesh];
            // Files carry texture coordinates only for meshes with textures.
            expect_equal_meshes(read.meshes[other.mesh], mesh, made.materials[mesh.material].base_colour_texture >= 0);
        }
        ASSERT_FALSE(read.cameras.empty());
        EXPECT_EQ(read.cameras[0].world, made.cameras[0].world);
        EXPECT_NEAR(read.cameras[0].fov_y_deg, made.cameras[0].fov_y_deg, 1e-12);
        fs::remove(path);
    }
}

// Presets, claims and golden pictures depend on these scenes. An intended change of a scene updates its number here;
// the failure message names it.
TEST_P(BuiltinScenes, AreTheSameToTheByte) {
    const std::string key(GetParam().key);
    const fs::path path = scratch("same-" + key + ".glb");
    save_gltf(GetParam().make(), path);
    EXPECT_EQ(fmt::format("{:016x}", fnv1a(bytes_of(path))), kContents.at(key));
    fs::remove(path);
}

INSTANTIATE_TEST_SUITE_P(All, BuiltinScenes, testing::ValuesIn(builtin_scenes().begin(), builtin_scenes().end()),
                         [](const auto& row) { return std::string(row.param.key); });

TEST(LoadScene, KnowsTheKeysAndTheDefault) {
    EXPECT_EQ(builtin_scenes()[0].key, "stage");
    EXPECT_EQ(load_scene("teapot").name, "teapot");
}

TEST(LoadScene, NamesTheNearestKeyAndTheExtensions) {
    EXPECT_TRUE(test::fails_with([] { load_scene("teepot"); }, {"'teepot'", "did you mean teapot?", ".gltf, .glb"}));
    EXPECT_TRUE(test::fails_with([] { load_scene("cube.xyz"); }, {"cannot open 'cube.xyz'", ".xyz", ".gltf, .glb"}));
}

TEST(LoadScene, TakesExtensionsInAnyCase) {
    const fs::path path = scratch("CASE.GlTf");
    save_gltf(load_scene("boxes"), path);
    EXPECT_EQ(load_scene(path.string()).triangle_count(), load_scene("boxes").triangle_count());
    fs::remove(path);
}

TEST(SaveGltf, RefusesOtherExtensionsAndFoldersThatDoNotExist) {
    const Scene scene = load_scene("boxes");
    fs::remove(scratch("scene.obj"));
    EXPECT_THROW(save_gltf(scene, scratch("scene.obj")), Error);
    EXPECT_FALSE(fs::exists(scratch("scene.obj")));
    EXPECT_THROW(save_gltf(scene, scratch("") / "missing" / "scene.gltf"), Error);
}

TEST(SaveGltf, KeepsTheOldFileWhenItCannotReplaceIt) {
    const fs::path path = scratch("occupied") / "folder.gltf";
    fs::create_directories(path / "inside");
    EXPECT_THROW(save_gltf(load_scene("boxes"), path), Error);
    EXPECT_TRUE(fs::exists(path / "inside"));
    std::size_t leftovers = 0;
    for (const auto& entry : fs::directory_iterator(path.parent_path()))
        leftovers += entry.path().extension() == ".tmp";
    EXPECT_EQ(leftovers, 0u);
    fs::remove_all(path.parent_path());
}

TEST(Stage, HasTheDocumentedContents) {
    const Scene scene = load_scene("stage");
    bool mask = false, sheet = false;
    for (const Mesh& mesh : scene.meshes) {
        const Material& m = scene.materials[mesh.material];
        if (m.alpha == AlphaMode::Mask && m.base_colour_texture >= 0) {
            const Texture& t = scene.textures[m.base_colour_texture];
            std::size_t solid = 0;
            for (std::size_t i = 3; i < t.rgba.size(); i += 4) solid += t.rgba[i] >= 128;
            const double share = double(solid) / double(t.width * t.height);
            mask = mask || (share > 0.1 && share < 0.9 && m.double_sided);
        }
        sheet = sheet || (mesh.indices.size() == 6 && m.double_sided && m.alpha == AlphaMode::Opaque);
    }
    EXPECT_TRUE(mask) << "no leaves with holes";
    EXPECT_TRUE(sheet) << "no single-plane wall";
    for (const char* standing : {"Stage/Figure", "Stage/Wall", "Stage/Ramp", "Stage/Sphere", "Stage/Distant box",
                                 "Stage/Pedestal", "Stage/Fence/Post", "Stage/Rods"})
        EXPECT_NEAR(lowest(scene, standing), 0, 1e-6) << standing;
}

TEST(Relief, IsFlatUnderSteepMappedNormals) {
    const Scene scene = load_scene("relief");
    ASSERT_EQ(scene.textures.size(), 1u);
    const Texture& cobbles = scene.textures.front();
    EXPECT_FALSE(cobbles.srgb) << "normals are numbers, no colours";
    double steepest = 0;
    glm::dvec3 mean(0);
    for (std::size_t i = 0; i < cobbles.rgba.size(); i += 4) {
        const glm::dvec3 n = glm::dvec3(cobbles.rgba[i], cobbles.rgba[i + 1], cobbles.rgba[i + 2]) / 255.0 * 2.0 - 1.0;
        EXPECT_NEAR(glm::length(n), 1, 0.02);
        steepest = std::max(steepest, glm::degrees(std::acos(n.z / glm::length(n))));
        mean += n;
    }
    mean = glm::normalize(mean);
    EXPECT_NEAR(mean.x, 0, 1e-3);
    EXPECT_NEAR(mean.y, 0, 1e-3);
    EXPECT_GT(steepest, 50);
    EXPECT_LT(steepest, 70);
    int flat = 0;
    for (const Object& o : scene.objects)
        if (const Mesh& mesh = scene.meshes[std::size_t(o.mesh)]; mesh.name == "Floor") {
            ++flat;
            EXPECT_EQ(scene.materials[std::size_t(mesh.material)].normal_texture, 0);
            for (const glm::vec3& n : mesh.normals) EXPECT_EQ(n, glm::vec3(0, 1, 0));
        }
    EXPECT_EQ(flat, 1);
}

TEST(Figures, StandOnTheFloor) {
    const Scene scene = load_scene("figures");
    for (const char* figure : {"Room/Walking figure", "Room/Reaching figure", "Room/Kneeling figure"})
        EXPECT_NEAR(lowest(scene, figure), 0, 1e-6) << figure;
}

TEST(PlaneScene, SpansOneToAHundredMetres) {
    const Scene scene = load_scene("plane");
    ASSERT_EQ(scene.cameras[0].world, glm::dmat4(1.0));
    EXPECT_EQ(scene.bounds.hi.z, -1);
    EXPECT_EQ(scene.bounds.lo.z, -100);
    EXPECT_EQ(scene.cameras[0].near, 1);
    EXPECT_EQ(scene.cameras[0].far, 100);
    const Mesh& mesh = scene.meshes[0];
    for (const glm::vec3& p : mesh.positions)
        EXPECT_NEAR(glm::dot(glm::dvec3(p) - glm::dvec3(mesh.positions[0]), glm::dvec3(mesh.normals[0])), 0, 1e-5);
}

}  // namespace
}  // namespace si
