// Tests of triangles, indices and vertex data of glTF files in every layout.
#include <gtest/gtest.h>

#include "tests/unit/gltf_test_file.h"

namespace si::test {
namespace {

/// Returns the corner positions of each triangle, in drawing order.
std::vector<glm::vec3> corners(const Mesh& mesh) {
    std::vector<glm::vec3> out;
    for (const std::uint32_t i : mesh.indices) out.push_back(mesh.positions[i]);
    return out;
}

std::vector<float> flat(const std::vector<glm::vec3>& points) {
    std::vector<float> out;
    for (const glm::vec3& p : points) out.insert(out.end(), {p.x, p.y, p.z});
    return out;
}

/// Four points, no three on a line.
const std::vector<glm::vec3> kQuad{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5f}};
const std::vector<float> kUp{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};

Scene with_mode(int mode) {
    GltfFile file;
    const Json attributes = {{"POSITION", file.floats(flat(kQuad), "VEC3")}, {"NORMAL", file.floats(kUp, "VEC3")}};
    file.root({{"mesh", file.mesh({{"attributes", attributes}, {"mode", mode}})}});
    return file.load();
}

TEST(GltfGeometry, StripsKeepTheFacingOfEachTriangle) {
    const Scene scene = with_mode(5);
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(corners(scene.meshes[0]),
              (std::vector<glm::vec3>{kQuad[0], kQuad[1], kQuad[2], kQuad[1], kQuad[3], kQuad[2]}));
}

TEST(GltfGeometry, FansTurnAroundTheirFirstVertex) {
    const Scene scene = with_mode(6);
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(corners(scene.meshes[0]),
              (std::vector<glm::vec3>{kQuad[1], kQuad[2], kQuad[0], kQuad[2], kQuad[3], kQuad[0]}));
}

TEST(GltfGeometry, UnindexedListDropsAnUnfinishedTriangle) {
    const Scene scene = with_mode(4);
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(corners(scene.meshes[0]), (std::vector<glm::vec3>{kQuad[0], kQuad[1], kQuad[2]}));
    EXPECT_TRUE(mentions(scene.warnings, "no multiple of three"));
}

TEST(GltfGeometry, PointsAndLinesAreLeftOutWithAWarning) {
    for (int mode = 0; mode < 4; ++mode) {
        const Scene scene = with_mode(mode);
        EXPECT_TRUE(scene.objects.empty());
        EXPECT_TRUE(mentions(scene.warnings, "not drawn"));
    }
}

template <class T>
void expect_indices_of_type() {
    GltfFile file;
    const Json attributes = {{"POSITION", file.floats(flat(kQuad), "VEC3")}, {"NORMAL", file.floats(kUp, "VEC3")}};
    const int indices = file.indices(std::vector<T>{2, 0, 1, 1, 3, 2});
    file.root({{"mesh", file.mesh({{"attributes", attributes}, {"indices", indices}})}});
    const Scene scene = file.load();
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(corners(scene.meshes[0]),
              (std::vector<glm::vec3>{kQuad[2], kQuad[0], kQuad[1], kQuad[1], kQuad[3], kQuad[2]}));
}

TEST(GltfGeometry, IndicesOf8Bit) {
    expect_indices_of_type<std::uint8_t>();
}
TEST(GltfGeometry, IndicesOf16Bit) {
    expect_indices_of_type<std::uint16_t>();
}
TEST(GltfGeometry, IndicesOf32Bit) {
    expect_indices_of_type<std::uint32_t>();
}

TEST(GltfGeometry, IndicesBeyondTheVerticesAreRefused) {
    const auto error_with = [](std::uint16_t index, std::size_t vertices) {
        GltfFile file;
        const int position = file.floats(std::vector<float>(3 * vertices), "VEC3");
        const int indices = file.indices(std::vector<std::uint16_t>{0, 1, index});
        file.root({{"mesh", file.mesh({{"attributes", {{"POSITION", position}}}, {"indices", indices}})}});
        return file.error();
    };
    EXPECT_EQ(error_with(2, 3), "");
    EXPECT_NE(error_with(3, 3).find("meshes[0].primitives[0].indices: accessor 1: index 3 is out of range"),
              std::string::npos);
    EXPECT_NE(error_with(65535, 65535), "");
}

TEST(GltfGeometry, RestartValuesThatNameAVertexAreIndices) {
    const auto loaded = [](int indices, std::size_t vertices, GltfFile& file) {
        std::vector<float> positions(3 * vertices);
        positions[3] = positions[positions.size() - 2] = 1;  // the second and the last vertex
        const int position = file.floats(positions, "VEC3");
        file.root({{"mesh", file.mesh({{"attributes", {{"POSITION", position}}}, {"indices", indices}})}});
        return file.load();
    };
    GltfFile bytes, shorts;
    const Scene scene = loaded(bytes.indices(std::vector<std::uint8_t>{0, 1, 255}), 256, bytes);
    EXPECT_EQ(corners(scene.meshes[0]), (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_TRUE(mentions(scene.warnings, "meshes[0].primitives[0].indices: accessor 0: 255 is the restart value"));
    const Scene wide = loaded(shorts.indices(std::vector<std::uint16_t>{0, 1, 65535}), 65536, shorts);
    EXPECT_EQ(wide.triangle_count(), 1u);
    EXPECT_TRUE(mentions(wide.warnings, "65535 is the restart value"));
}

TEST(GltfGeometry, InterleavedAttributesAreSeparated) {
    GltfFile file;
    std::vector<float> data;
    for (const glm::vec3& p : kQuad) data.insert(data.end(), {p.x, p.y, p.z, 0, 0, 1});
    const int view = file.view(data, 24);
    const Json attributes = {{"POSITION", file.accessor(view, 5126, "VEC3", 4)},
                             {"NORMAL", file.accessor(view, 5126, "VEC3", 4, 12)}};
    file.root({{"mesh", file.mesh({{"attributes", attributes}, {"mode", 5}})}});
    const Scene scene = file.load();
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].positions, kQuad);
    for (const glm::vec3& n : scene.meshes[0].normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
}

TEST(GltfGeometry, NormalisedIntegersSpanMinusOneToOne) {
    GltfFile file;
    file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    // Rows of 8 bytes: three shorts and padding. -32768 and -32767 both mean -1.
    const int view = file.view(std::vector<std::int16_t>{-32768, 0, 0, 0, 32767, -32767, 0, 0, 0, 16384, 0, 0}, 8);
    const int position = file.accessor(view, 5122, "VEC3", 3, 0, true);
    file.root({{"mesh", file.mesh({{"attributes", {{"POSITION", position}}}})}});
    const Scene scene = file.load();
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].positions[0], glm::vec3(-1, 0, 0));
    EXPECT_EQ(scene.meshes[0].positions[1], glm::vec3(1, -1, 0));
    EXPECT_EQ(scene.meshes[0].positions[2], glm::vec3(0, 16384.0f / 32767.0f, 0));
}

TEST(GltfGeometry, IntegersThatAreNotNormalisedKeepTheirValue) {
    GltfFile file;
    file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const int view = file.view(std::vector<std::uint8_t>{0, 0, 0, 0, 200, 0, 0, 0, 0, 100, 0, 0}, 4);
    file.root({{"mesh", file.mesh({{"attributes", {{"POSITION", file.accessor(view, 5121, "VEC3", 3)}}}})}});
    const Scene scene = file.load();
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].positions[1], glm::vec3(200, 0, 0));
}

TEST(GltfGeometry, SparseValuesReplaceTheBase) {
    for (const bool with_base : {true, false}) {
        GltfFile file;
        const int base = with_base ? file.view(flat(kQuad)) : -1;
        const int position = file.accessor(base, 5126, "VEC3", 4);
        const int where = file.view(std::vector<std::uint16_t>{1, 3}),
                  what = file.view(std::vector<float>{7, 0, 0, 0, 9, 1});
        file.json["accessors"][position]["sparse"] = {{"count", 2},
                                                      {"indices", {{"bufferView", where}, {"componentType", 5123}}},
                                                      {"values", {{"bufferView", what}}}};
        const Json attributes = {{"POSITION", position}, {"NORMAL", file.floats(kUp, "VEC3")}};
        file.root({{"mesh", file.mesh({{"attributes", attributes}, {"mode", 5}})}});
        const Scene scene = file.load();
        ASSERT_EQ(scene.meshes.size(), 1u);
        const glm::vec3 third = with_base ? kQuad[2] : glm::vec3(0);
        EXPECT_EQ(scene.meshes[0].positions, (std::vector<glm::vec3>{{0, 0, 0}, {7, 0, 0}, third, {0, 9, 1}}));
    }
}

TEST(GltfGeometry, PrimitivesUseOnlyTheirPartOfASharedVertexArray) {
    GltfFile file;
    std::vector<float> positions, normals;
    for (int i = 0; i < 300; ++i) {
        positions.insert(positions.end(), {static_cast<float>(i), static_cast<float>(i * i), 0});
        normals.insert(normals.end(), {0, 0, 1});
    }
    const Json attributes = {{"POSITION", file.floats(positions, "VEC3")}, {"NORMAL", file.floats(normals, "VEC3")}};
    const int indices = file.indices(std::vector<std::uint16_t>{299, 7, 50});
    file.root({{"mesh", file.mesh({{"attributes", attributes}, {"indices", indices}})}});
    const Scene scene = file.load();
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].positions.size(), 3u);
    EXPECT_EQ(corners(scene.meshes[0]), (std::vector<glm::vec3>{{299, 89401, 0}, {7, 49, 0}, {50, 2500, 0}}));
}

TEST(GltfGeometry, NodesShareOneMesh) {
    GltfFile file;
    const int mesh = file.mesh({{"attributes", {{"POSITION", file.triangle_positions()}}}});
    for (int i = 0; i < 5; ++i) file.root({{"mesh", mesh}});
    // A second mesh with the same accessors is the same geometry.
    file.root({{"mesh", file.append("meshes", file.json["meshes"][mesh])}});
    const Scene scene = file.load();
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.objects.size(), 6u);
}

TEST(GltfGeometry, VertexColoursWithAndWithoutAlpha) {
    GltfFile file;
    const int position = file.triangle_positions();
    const int rgb = file.accessor(file.view(std::vector<std::uint8_t>{255, 0, 51, 0, 0, 255, 0, 0, 0, 0, 255, 0}, 4),
                                  5121, "VEC3", 3, 0, true);
    const int rgba = file.floats({1, 1, 1, 0.25f, 1, 1, 1, 0.5f, 1, 1, 1, 1}, "VEC4");
    file.root({{"mesh", file.mesh({{"attributes", {{"POSITION", position}, {"COLOR_0", rgb}}}})}});
    file.root({{"mesh", file.mesh({{"attributes", {{"POSITION", position}, {"COLOR_0", rgba}}}})}});
    const Scene scene = file.load();
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.meshes[0].colours[0], glm::vec4(1, 0, 0.2f, 1));
    EXPECT_EQ(scene.meshes[1].colours[1], glm::vec4(1, 1, 1, 0.5f));
}

TEST(GltfGeometry, PrimitiveWithoutFiniteDataIsDroppedAlone) {
    GltfFile file;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const int good = file.triangle_positions(), bad = file.floats({0, 0, 0, nan, 0, 0, 0, 1, 0}, "VEC3");
    const int far = file.floats({0, 0, 0, 1e30f, 0, 0, 0, 1, 0}, "VEC3");
    file.root({{"mesh", file.mesh({{"attributes", {{"POSITION", bad}}}})}});
    file.root({{"mesh", file.mesh({{"attributes", {{"POSITION", far}}}})}});
    file.root({{"mesh", file.mesh({{"attributes", {{"POSITION", good}}}})}});
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangle_count(), 1u);
    EXPECT_TRUE(mentions(scene.warnings, "not finite"));
    EXPECT_TRUE(mentions(scene.warnings, "beyond 1e18"));
}

}  // namespace
}  // namespace si::test
