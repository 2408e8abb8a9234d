// Tests of compressed glTF: meshopt, Draco, WebP. Small scenes of tests/data/compressed beside their twins, streams of
// the libraries' own encoders, and damaged bytes.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <draco/point_cloud/point_cloud_builder.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <webp/encode.h>

#include <algorithm>
#include <random>

#include "renderer/scene/animation.h"
#include "renderer/scenes/builtin.h"
#include "tests/support/error_text.h"
#include "tests/support/missing_reason.h"
#include "tests/support/process.h"
#include "tests/support/text.h"
#include "tests/unit/gltf_test_file.h"

namespace si::test {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

const fs::path kFolder = fs::path(SI_SOURCE_DIR) / "tests/data/compressed";
const fs::path kShared = fs::path(SI_SOURCE_DIR) / ".." / "shared";

/// Compressed model of tests/data/compressed, its scene, and the bits of its positions.
struct Model {
    const char* name;
    const char* scene;
    int position_bits;  ///< 0: not quantised
};

constexpr Model kModels[] = {{"draco-boxes", "boxes", 14},
                             {"draco-sequential", "hard/grazing", 14},
                             {"draco-mirrored", "hard/mirrored", 11},
                             {"draco-plane", "plane", 16},
                             {"meshopt-instances", "hard/snapping", 14},
                             {"meshopt-spheres", "hard/thin-caster", 14},
                             {"meshopt-planes", "hard/edge-on-planes", 14},
                             {"webp-mask", "hard/alpha", 0},
                             {"webp-lossy-draco", "hard/alpha", 14},
                             {"webp-meshopt", "hard/alpha", 14}};

/// Compares everything that a file gives, bit by bit.
void expect_same(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (std::size_t i = 0; i < a.meshes.size(); ++i) {
        const Mesh &x = a.meshes[i], &y = b.meshes[i];
        for_each_attribute([&](auto member) { EXPECT_TRUE((x.*member).all() == (y.*member).all()) << "mesh " << i; });
        EXPECT_TRUE(x.indices.all() == y.indices.all()) << "mesh " << i;
        EXPECT_EQ(x.material, y.material);
        EXPECT_EQ(x.name, y.name);
    }
    EXPECT_EQ(a.materials, b.materials);
    ASSERT_EQ(a.textures.size(), b.textures.size());
    for (std::size_t i = 0; i < a.textures.size(); ++i) {
        EXPECT_EQ(a.textures[i].width, b.textures[i].width);
        EXPECT_TRUE(a.textures[i].rgba.all() == b.textures[i].rgba.all()) << "texture " << i;
        EXPECT_EQ(a.textures[i].mipmaps, b.textures[i].mipmaps);
        EXPECT_EQ(a.textures[i].wrap_s, b.textures[i].wrap_s);
    }
    ASSERT_EQ(a.objects.size(), b.objects.size());
    for (std::size_t i = 0; i < a.objects.size(); ++i) {
        EXPECT_EQ(a.objects[i].world, b.objects[i].world);
        EXPECT_EQ(a.objects[i].mesh, b.objects[i].mesh);
    }
    EXPECT_EQ(a.triangle_count(), b.triangle_count());
    EXPECT_EQ(a.suggested, b.suggested);
    EXPECT_EQ(a.lights.size(), b.lights.size());
}

/// Returns all vertices of a scene in world space.
std::vector<glm::dvec3> vertices(const Scene& scene) {
    std::vector<glm::dvec3> out;
    for (const Object& object : scene.objects)
        for (const glm::vec3& p : scene.meshes[std::size_t(object.mesh)].positions)
            out.push_back(glm::dvec3(object.world * glm::dvec4(p, 1)));
    return out;
}

/// Returns the largest distance of a point of `from` to the nearest one of `to`.
double farthest(const std::vector<glm::dvec3>& from, const std::vector<glm::dvec3>& to) {
    double out = 0;
    for (const glm::dvec3& p : from) {
        double nearest = INFINITY;
        for (const glm::dvec3& q : to) nearest = std::min(nearest, glm::length(p - q));
        out = std::max(out, nearest);
    }
    return out;
}

class Compressed : public testing::TestWithParam<Model> {};

TEST_P(Compressed, EqualsItsTwin) {
    const std::string name = GetParam().name;
    const Scene scene = load_gltf(kFolder / (name + ".glb"));
    const Scene twin = load_gltf(kFolder / (name + ".twin.glb"));
    expect_same(scene, twin);
    EXPECT_EQ(scene.warnings, twin.warnings);
}

TEST_P(Compressed, PositionsLieWithinTheQuantisation) {
    const Model& model = GetParam();
    const Scene scene = load_gltf(kFolder / (std::string(model.name) + ".glb"));
    const Scene original = load_scene(model.scene);
    EXPECT_EQ(scene.triangle_count(), original.triangle_count());
    // A step of the grid over a mesh, half of it per axis, with the scale of the largest mesh.
    double extent = 0;
    for (const Object& object : original.objects) {
        const Bounds& b = original.meshes[std::size_t(object.mesh)].bounds;
        const glm::dvec3 size = glm::dmat3(object.world) * glm::dvec3(b.hi - b.lo);
        extent = std::max(extent, glm::length(size));
    }
    const double step = model.position_bits == 0 ? 1e-5 : extent / ((1 << model.position_bits) - 1);
    const auto ours = vertices(scene), theirs = vertices(original);
    EXPECT_LE(farthest(ours, theirs), step) << model.name;
    EXPECT_LE(farthest(theirs, ours), step) << model.name;
    if (model.position_bits > 0) {
        EXPECT_GT(farthest(ours, theirs), 0) << "nothing is quantised";
    }
}

INSTANTIATE_TEST_SUITE_P(All, Compressed, testing::ValuesIn(kModels), [](const auto& test) {
    std::string name = test.param.name;
    std::ranges::replace(name, '-', '_');
    return name;
});

TEST(CompressedShared, ModelsEqualTheirTwins) {
    const fs::path models = kShared / "models";
    if (!fs::exists(models)) GTEST_SKIP() << kMissingReason << models;
    const auto same_triangles = [&](const char* compressed, const char* plain) {
        const Scene a = load_gltf(models / compressed), b = load_gltf(models / plain);
        EXPECT_EQ(a.triangle_count(), b.triangle_count()) << compressed;
        EXPECT_LT(farthest(vertices(a), vertices(b)), 1e-3) << compressed;
        EXPECT_LT(farthest(vertices(b), vertices(a)), 1e-3) << compressed;
    };
    same_triangles("khr_Box/glTF-Draco/Box.gltf", "khr_Box/glTF/Box.gltf");
    same_triangles("gltftransform_meshopt/BoxMeshopt.gltf", "gltftransform_meshopt/BoxMeshopt.glb");
    EXPECT_GT(load_gltf(models / "gltftransform_meshopt/BoxMeshopt.glb").triangle_count(), 11u);
    for (const char* file : {"box-textured-separate.gltf", "box-textured-with-fallback.gltf"}) {
        const Scene scene = load_gltf(models / "pipeline_webp/box-textured-separate" / file);
        ASSERT_EQ(scene.textures.size(), 1u) << file;
        EXPECT_GT(scene.textures[0].width, 1) << file;
    }
}

TEST(CompressedShared, GrassHasItsMask) {
    const fs::path file = kShared / "real-files/eztree_grass/grass.glb";
    if (!fs::exists(file)) GTEST_SKIP() << kMissingReason << file;
    const Scene scene = load_gltf(file);
    ASSERT_FALSE(scene.textures.empty());
    const auto masked = std::ranges::find_if(
        scene.materials, [](const Material& m) { return m.alpha != AlphaMode::Opaque && m.base_colour_texture >= 0; });
    ASSERT_NE(masked, scene.materials.end());
    const Texture& texture = scene.textures[std::size_t(masked->base_colour_texture)];
    std::size_t holes = 0;
    for (std::size_t i = 3; i < texture.rgba.size(); i += 4) holes += texture.rgba[i] < 128;
    EXPECT_GT(holes, texture.rgba.size() / 40);
}

/// File whose buffer view is compressed by meshopt.
struct MeshoptFile : GltfFile {
    /// Appends a compressed view of `count` elements of `stride` bytes and returns its index.
    int compressed(const Bytes& bytes, std::size_t count, std::size_t stride, const char* mode,
                   const char* filter = nullptr, const char* extension = "EXT_meshopt_compression") {
        const int source = view(bytes);
        Json properties = json["bufferViews"][std::size_t(source)];
        properties.update({{"count", count}, {"byteStride", stride}, {"mode", mode}});
        if (filter) properties["filter"] = filter;
        json["bufferViews"].erase(std::size_t(source));
        Json out = {{"buffer", 0}, {"byteLength", count * stride}};
        if (std::string_view(mode) == "ATTRIBUTES") out["byteStride"] = stride;
        out["extensions"][extension] = properties;
        return append("bufferViews", out);
    }
    /// Returns the properties of a compressed view.
    Json& properties(int view) {
        return json["bufferViews"][std::size_t(view)]["extensions"]["EXT_meshopt_compression"];
    }
};

Bytes encoded_attributes(const void* data, std::size_t count, std::size_t stride) {
    Bytes out(meshopt_encodeVertexBufferBound(count, stride));
    out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), data, count, stride));
    return out;
}

const std::vector<float> kCorners = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
const std::vector<std::uint32_t> kFaces = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};

/// Returns the corners of kCorners.
std::vector<glm::dvec3> tetrahedron_corners() {
    return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
}

Bytes encoded_faces() {
    Bytes out(meshopt_encodeIndexBufferBound(kFaces.size(), 4));
    out.resize(meshopt_encodeIndexBuffer(out.data(), out.size(), kFaces.data(), kFaces.size()));
    return out;
}

/// Returns a file of a tetrahedron whose positions and indices are compressed, views 0 and 1.
MeshoptFile tetrahedron() {
    MeshoptFile file;
    const int positions = file.compressed(encoded_attributes(kCorners.data(), 4, 12), 4, 12, "ATTRIBUTES");
    const int indices = file.compressed(encoded_faces(), kFaces.size(), 4, "TRIANGLES");
    file.root({{"mesh", file.mesh({{"attributes", {{"POSITION", file.accessor(positions, 5126, "VEC3", 4)}}},
                                   {"indices", file.accessor(indices, 5125, "SCALAR", kFaces.size())}})}});
    return file;
}

TEST(Meshopt, AttributesAndTrianglesAreDecoded) {
    const Scene scene = tetrahedron().load();
    EXPECT_EQ(scene.triangle_count(), 4u);
    EXPECT_EQ(farthest(tetrahedron_corners(), vertices(scene)), 0);
}

TEST(Meshopt, IndicesOfEitherSizeAndModeAreDecoded) {
    for (const std::size_t stride : {std::size_t{2}, std::size_t{4}})
        for (const bool sequence : {false, true}) {
            MeshoptFile file;
            Bytes bytes(meshopt_encodeIndexSequenceBound(kFaces.size(), 4));
            bytes.resize(meshopt_encodeIndexSequence(bytes.data(), bytes.size(), kFaces.data(), kFaces.size()));
            const int indices = file.compressed(sequence ? bytes : encoded_faces(), kFaces.size(), stride,
                                                sequence ? "INDICES" : "TRIANGLES");
            const int type = stride == 2 ? 5123 : 5125;
            file.root({{"mesh", file.mesh({{"attributes", {{"POSITION", file.floats(kCorners, "VEC3")}}},
                                           {"indices", file.accessor(indices, type, "SCALAR", kFaces.size())}})}});
            EXPECT_EQ(file.load().triangle_count(), 4u) << stride << sequence << file.error();
        }
}

TEST(Meshopt, FiltersAreApplied) {
    const std::vector<float> normals = {0, 0, 1, 0, 0.6f, 0, 0.8f, 0, 0, 1, 0, 0, -0.6f, 0, -0.8f, 0};
    for (const std::size_t stride : {std::size_t{4}, std::size_t{8}}) {
        MeshoptFile file = tetrahedron();
        Bytes filtered(4 * stride);
        meshopt_encodeFilterOct(filtered.data(), 4, stride, stride == 4 ? 8 : 12, normals.data());
        const int view =
            file.compressed(encoded_attributes(filtered.data(), 4, stride), 4, stride, "ATTRIBUTES", "OCTAHEDRAL");
        file.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
            file.accessor(view, stride == 4 ? 5120 : 5122, "VEC3", 4, 0, true);
        const Scene scene = file.load();
        for (std::size_t i = 0; i < 4; ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(scene.meshes.at(0).normals[i][c], normals[4 * i + std::size_t(c)],
                            stride == 4 ? 0.02 : 2e-3);
    }

    MeshoptFile file = tetrahedron();
    Bytes filtered(48);
    meshopt_encodeFilterExp(filtered.data(), 4, 12, 15, kCorners.data());
    const int positions =
        file.compressed(encoded_attributes(filtered.data(), 4, 12), 4, 12, "ATTRIBUTES", "EXPONENTIAL");
    file.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = file.accessor(positions, 5126, "VEC3", 4);
    EXPECT_EQ(farthest(tetrahedron_corners(), vertices(file.load())), 0);
}

TEST(Meshopt, QuaternionsAreDecoded) {
    MeshoptFile file = tetrahedron();
    const std::vector<float> turns = {0, 0, 0, 1, 0, 0.6f, 0, 0.8f};
    Bytes filtered(16);
    meshopt_encodeFilterQuat(filtered.data(), 2, 8, 16, turns.data());
    const int view = file.compressed(encoded_attributes(filtered.data(), 2, 8), 2, 8, "ATTRIBUTES", "QUATERNION");
    const int values = file.accessor(view, 5122, "VEC4", 2, 0, true);
    file.json["animations"] = {{{"samplers", {{{"input", file.floats({0, 1}, "SCALAR")}, {"output", values}}}},
                                {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
    const Scene scene = file.load();
    ASSERT_TRUE(scene.rig) << ::testing::PrintToString(scene.warnings);
    ASSERT_EQ(scene.rig->animations.size(), 1u);
    const auto& read = scene.rig->animations[0].channels.at(0).values;
    ASSERT_EQ(read.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(read[i], turns[i], 1e-3) << i;
}

TEST(Meshopt, WrongPropertiesAreNamed) {
    const auto error = [](int view, const Json& changes) {
        MeshoptFile file = tetrahedron();
        file.properties(view).update(changes);
        return file.error();
    };
    const struct {
        int view;
        Json changes;
        const char* text;
    } rows[] = {
        {0, {{"mode", "POINTS"}}, "\"POINTS\" is no mode"},
        {0, {{"byteStride", 6}}, "byteStride 6 is no multiple of 4 up to 256"},
        {0, {{"byteStride", 512}}, "byteStride 512"},
        {0, {{"count", 0}}, "count is 0"},
        {0, {{"count", -1}}, "not a whole number"},
        {0, {{"count", 100'000'000}}, "are more than"},
        {0, {{"count", std::uint64_t{1} << 33}}, "are more than"},
        {0, {{"filter", "SMOOTH"}}, "\"SMOOTH\" is no filter"},
        {0, {{"filter", "OCTAHEDRAL"}}, "needs a byteStride of 4 or 8"},
        {0, {{"filter", "QUATERNION"}}, "needs a byteStride of 8"},
        {0, {{"filter", "COLOR"}}, "the filter COLOR is not read"},
        {0, {{"buffer", 7}}, "index 7 is out of range"},
        {0, {{"byteOffset", 1'000'000}}, "more than the greatest possible value"},
        {0, {{"byteLength", 1'000'000}}, "more than the greatest possible value"},
        {0, {{"byteLength", 3}}, "its stream is cut or damaged"},
        {0, {{"mode", "TRIANGLES"}}, "byteStride 12 is neither 2 nor 4"},
        {1, {{"count", 11}}, "count 11 is no multiple of 3"},
        {1, {{"filter", "EXPONENTIAL"}}, "the filter EXPONENTIAL is for ATTRIBUTES"},
        {1, {{"mode", "INDICES"}}, "no meshopt stream of this mode"},
    };
    for (const auto& row : rows) {
        const std::string said = error(row.view, row.changes);
        EXPECT_NE(said.find(row.text), std::string::npos) << row.text << ": " << said;
        EXPECT_NE(said.find(fmt::format("bufferViews[{}].extensions.EXT_meshopt_compression", row.view)),
                  std::string::npos)
            << said;
    }
}

TEST(Meshopt, DecodedIndicesAreChecked) {
    MeshoptFile file = tetrahedron();
    file.json["accessors"][0]["count"] = 3;
    EXPECT_NE(file.error().find("index 3 is out of range, there are 3 vertices"), std::string::npos) << file.error();
}

TEST(Meshopt, LaterVersionIsRefusedWithItsFix) {
    Bytes bytes = encoded_attributes(kCorners.data(), 4, 12);
    const auto error = [&](const char* filter) {
        MeshoptFile file;
        const int view = file.compressed(bytes, 4, 12, "ATTRIBUTES", filter, "KHR_meshopt_compression");
        file.json["extensionsRequired"] = {"KHR_meshopt_compression"};
        file.root({{"mesh", file.mesh({{"attributes", {{"POSITION", file.accessor(view, 5126, "VEC3", 3)}}}})}});
        return file.error();
    };
    EXPECT_EQ(error(nullptr), "");  // version 0
    EXPECT_TRUE(
        mentions(std::string_view(error("COLOR")), {"KHR_meshopt_compression", "COLOR", "gltf-transform copy"}));
    bytes[0] = 0xa1;
    EXPECT_TRUE(
        mentions(std::string_view(error(nullptr)), {"KHR_meshopt_compression", "version 1", "gltf-transform copy"}));
}

/// Attribute of a mesh for Draco: values of four corners.
struct DracoValues {
    draco::GeometryAttribute::Type type;
    draco::DataType data_type;
    int width;
    const void* data;
    bool normalised = false;
};

/// Encodes the tetrahedron with attributes beside its positions, whose ids count from 0.
Bytes draco_tetrahedron(const std::vector<DracoValues>& values, bool edgebreaker, bool points = false) {
    draco::EncoderBuffer buffer;
    draco::Encoder encoder;
    encoder.SetEncodingMethod(edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING : draco::MESH_SEQUENTIAL_ENCODING);
    if (points) {
        draco::PointCloudBuilder builder;
        builder.Start(4);
        const int id = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
        builder.SetAttributeValuesForAllPoints(id, kCorners.data(), 12);
        const auto cloud = builder.Finalize(false);
        EXPECT_TRUE(encoder.EncodePointCloudToBuffer(*cloud, &buffer).ok());
    } else {
        draco::TriangleSoupMeshBuilder builder;
        builder.Start(int(kFaces.size() / 3));
        for (const DracoValues& v : values) {
            const int id = builder.AddAttribute(v.type, std::int8_t(v.width), v.data_type);
            const std::size_t bytes = std::size_t(draco::DataTypeLength(v.data_type) * v.width);
            const auto at = [&](std::size_t corner) {
                return static_cast<const std::uint8_t*>(v.data) + kFaces[corner] * bytes;
            };
            for (std::uint32_t f = 0; f < kFaces.size() / 3; ++f)
                builder.SetAttributeValuesForFace(id, draco::FaceIndex(f), at(3 * f), at(3 * f + 1), at(3 * f + 2));
        }
        const auto mesh = builder.Finalize();
        EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    }
    const auto* data = reinterpret_cast<const std::uint8_t*>(buffer.data());
    return {data, data + buffer.size()};
}

const DracoValues kPositions = {draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, kCorners.data()};

/// File of a tetrahedron that Draco compresses: view 0, accessors 0 (positions) and 1 (indices), without views.
struct DracoFile : GltfFile {
    explicit DracoFile(const Bytes& bytes) {
        const int source = view(bytes);
        const int positions = accessor(-1, 5126, "VEC3", 4);
        const int indices = accessor(-1, 5123, "SCALAR", kFaces.size());
        Json made = {{"attributes", {{"POSITION", positions}}}, {"indices", indices}};
        made["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", source}, {"attributes", {{"POSITION", 0}}}};
        root({{"mesh", mesh(made)}});
        json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    }
    Json& primitive() { return json["meshes"][0]["primitives"][0]; }
    Json& extension() { return primitive()["extensions"]["KHR_draco_mesh_compression"]; }
};

TEST(Draco, BothMethodsAreDecoded) {
    for (const bool edgebreaker : {false, true}) {
        const Scene scene = DracoFile(draco_tetrahedron({kPositions}, edgebreaker)).load();
        EXPECT_EQ(scene.triangle_count(), 4u);
        EXPECT_EQ(scene.warnings, std::vector<std::string>{});
        EXPECT_EQ(scene.bounds.hi, glm::dvec3(1));
    }
}

TEST(Draco, AttributesAreFoundByTheirIds) {
    const std::vector<std::uint8_t> colours = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 51, 102, 153, 204};
    const DracoValues colour = {draco::GeometryAttribute::COLOR, draco::DT_UINT8, 4, colours.data()};
    DracoFile file(draco_tetrahedron({colour, kPositions}, true));
    file.primitive()["attributes"]["COLOR_0"] = file.accessor(-1, 5121, "VEC4", 4, 0, true);
    file.extension()["attributes"] = {{"POSITION", 1}, {"COLOR_0", 0}};
    const Scene scene = file.load();
    const Mesh& mesh = scene.meshes.at(0);
    for (std::size_t i = 0; i < 4; ++i) {
        std::size_t corner = 0;
        while (corner < 4 &&
               glm::vec3(kCorners[3 * corner], kCorners[3 * corner + 1], kCorners[3 * corner + 2]) != mesh.positions[i])
            ++corner;
        ASSERT_LT(corner, 4u);
        for (int c = 0; c < 4; ++c)
            EXPECT_FLOAT_EQ(mesh.colours[i][c], float(colours[4 * corner + std::size_t(c)]) / 255);
    }
    file.extension()["attributes"]["COLOR_0"] = 5;
    EXPECT_NE(file.error().find("its Draco data have no attribute 5"), std::string::npos) << file.error();
    file.extension()["attributes"]["COLOR_0"] = 1;
    EXPECT_NE(file.error().find("Draco attribute 1 has 3 components, its accessor has 4"), std::string::npos);
}

TEST(Draco, OtherCountsThanStatedGiveANote) {
    DracoFile file(draco_tetrahedron({kPositions}, true));
    file.json["accessors"][0]["count"] = 7;
    file.json["accessors"][1]["count"] = 3;
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangle_count(), 4u);
    EXPECT_TRUE(mentions(scene.warnings, "its Draco data have 4 points, accessor 0 states 7"));
}

TEST(Draco, AttributesBesideTheDracoDataAreRead) {
    DracoFile file(draco_tetrahedron({kPositions}, false));
    file.primitive()["attributes"]["NORMAL"] = file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    EXPECT_EQ(file.load().meshes.at(0).normals.all().at(2), glm::vec3(0, 0, 1));
    file.primitive()["attributes"]["NORMAL"] = file.floats({0, 0, 1}, "VEC3");
    EXPECT_NE(file.error().find("has 1 elements, POSITION has 4"), std::string::npos) << file.error();
}

TEST(Draco, PrimitivesShareOneMesh) {
    DracoFile file(draco_tetrahedron({kPositions}, true));
    file.json["materials"] = {Json::object()};
    file.json["meshes"][0]["primitives"].push_back(file.primitive());
    EXPECT_EQ(file.load().meshes.size(), 1u);
    Json other = file.primitive();
    other["material"] = 0;
    file.json["meshes"][0]["primitives"].push_back(other);
    other["attributes"]["POSITION"] = file.accessor(-1, 5126, "VEC3", 4);
    file.json["meshes"][0]["primitives"].push_back(other);
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangle_count(), 16u);
    EXPECT_EQ(scene.meshes.at(0).positions.all(), scene.meshes.back().positions.all());
}

TEST(Draco, FallbackOfAnotherPrimitiveStays) {
    DracoFile file(draco_tetrahedron({kPositions}, true));
    const int plain = file.triangle_positions();
    file.primitive()["attributes"]["POSITION"] = plain;  // the extension is used, not required
    file.json.erase("extensionsRequired");
    file.root({{"mesh", file.mesh({{"attributes", {{"POSITION", plain}}}})}});
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangle_count(), 5u);
}

TEST(Draco, PointsAreRefused) {
    const std::string error = DracoFile(draco_tetrahedron({}, false, true)).error();
    EXPECT_TRUE(mentions(std::string_view(error), {"meshes[0].primitives[0].extensions.KHR_draco_mesh_compression",
                                                   "its Draco data are points, not triangles", "gltf-transform copy"}))
        << error;
}

TEST(Draco, WrongPropertiesAreNamed) {
    const Bytes bytes = draco_tetrahedron({kPositions}, true);
    DracoFile view(bytes);
    view.extension()["bufferView"] = 9;
    EXPECT_NE(view.error().find("index 9 is out of range"), std::string::npos) << view.error();
    DracoFile ids(bytes);
    ids.extension()["attributes"]["POSITION"] = "zero";
    EXPECT_NE(ids.error().find("not a whole number"), std::string::npos) << ids.error();
    DracoFile type(bytes);
    type.json["accessors"][0]["type"] = "MAT4";
    EXPECT_NE(type.error().find("no type of a vertex attribute"), std::string::npos) << type.error();
    DracoFile lacking(bytes);
    lacking.extension().erase("attributes");
    EXPECT_NE(lacking.error().find("attributes: is missing"), std::string::npos) << lacking.error();
    // So many decodings of the same data are an attack.
    DracoFile often(bytes);
    for (int i = 1; i < 40; ++i) {
        Json more = often.primitive();
        more["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = i;
        often.json["meshes"][0]["primitives"].push_back(more);
    }
    EXPECT_NE(often.error().find("decoded too often"), std::string::npos) << often.error();
}

/// Encodes a picture of two colours, one of them transparent.
Bytes webp_picture(int width, int height) {
    Bytes rgba(std::size_t(width * height) * 4);
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        const bool hole = i % 32 < 16;
        rgba[i] = 200;
        rgba[i + 3] = hole ? 0 : 255;
        if (hole) rgba[i] = 0;
    }
    std::uint8_t* out = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), width, height, 4 * width, &out);
    const Bytes bytes(out, out + size);
    WebPFree(out);
    return bytes;
}

/// File of a masked triangle with a WebP picture.
struct WebpFile : GltfFile {
    explicit WebpFile(const Bytes& bytes) {
        const int source = view(bytes);
        json["images"] = {{{"bufferView", source}, {"mimeType", "image/webp"}}};
        json["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
        json["extensionsRequired"] = {"EXT_texture_webp"};
        json["materials"] = {{{"alphaMode", "MASK"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
        root({{"mesh", mesh({{"attributes",
                              {{"POSITION", triangle_positions()}, {"TEXCOORD_0", floats({0, 0, 1, 0, 0, 1}, "VEC2")}}},
                             {"material", 0}})}});
    }
};

TEST(Webp, ImagesAreDecoded) {
    const Scene scene = WebpFile(webp_picture(16, 4)).load();
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.textures[0].width, 16);
    EXPECT_EQ(scene.textures[0].height, 4);
    EXPECT_EQ(scene.textures[0].rgba[3], 0);
    EXPECT_EQ(scene.textures[0].rgba[16 + 3], 255);
    EXPECT_EQ(scene.textures[0].rgba[16], 200);
    EXPECT_EQ(scene.warnings, std::vector<std::string>{});
}

TEST(Webp, ManyImagesKeepTheirOrder) {
    WebpFile file(webp_picture(8, 8));
    constexpr int kImages = 9;
    for (int i = 1; i < kImages; ++i) {
        file.json["images"].push_back({{"bufferView", file.view(webp_picture(8 + i, 8))}});
        file.json["textures"].push_back({{"extensions", {{"EXT_texture_webp", {{"source", i}}}}}});
        Json material = file.json["materials"][0];
        material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = i;
        file.json["materials"].push_back(material);
        Json primitive = file.json["meshes"][0]["primitives"][0];
        primitive["material"] = i;
        file.json["meshes"][0]["primitives"].push_back(primitive);
    }
    file.json["images"][4] = {{"bufferView", file.view(Bytes{'R', 'I', 'F', 'F', 0, 0, 0, 0, 'W', 'E', 'B', 'P', 0})}};
    const Scene scene = file.load();
    ASSERT_EQ(scene.textures.size(), std::size_t(kImages) - 1);
    for (int i = 0; i < kImages; ++i) {
        const int texture = scene.materials[std::size_t(i)].base_colour_texture;
        if (i == 4)
            EXPECT_EQ(texture, -1);
        else
            EXPECT_EQ(scene.textures[std::size_t(texture)].width, 8 + i);
    }
    EXPECT_TRUE(mentions(scene.warnings, "images[4]: not a WebP image, or damaged"));
    EXPECT_TRUE(mentions(scene.warnings, "materials[4]: its alpha (MASK) is in an image that is not read"));
}

TEST(Webp, WithoutTheExtensionItIsReadWithANote) {
    WebpFile file(webp_picture(8, 8));
    file.json["textures"] = {{{"source", 0}}};
    file.json.erase("extensionsRequired");
    const Scene scene = file.load();
    EXPECT_EQ(scene.textures.size(), 1u);
    EXPECT_TRUE(mentions(scene.warnings, "images[0]: is WebP without EXT_texture_webp"));
}

TEST(Webp, LargeImagesAreRefusedBeforeTheirMemory) {
    // A lossless header of 16,384 pixels each way.
    Bytes bytes = webp_picture(8, 8);
    for (std::size_t i = 21; i < 24; ++i) bytes[i] = 0xff;
    bytes[24] |= 0x0f;
    const Scene scene = WebpFile(bytes).load();
    EXPECT_TRUE(scene.textures.empty());
    EXPECT_TRUE(mentions(scene.warnings, "MiB to decode, at most 768 are allowed"))
        << ::testing::PrintToString(scene.warnings);
}

TEST(Ktx2, LostAlphaIsNamedWithItsFix) {
    WebpFile file(webp_picture(8, 8));
    file.json["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
    file.json["extensionsRequired"] = {"KHR_texture_basisu"};
    const auto note = [&] {
        for (const std::string& warning : file.load().warnings)
            if (warning.starts_with("materials[0]")) return warning;
        return std::string();
    };
    EXPECT_EQ(
        note(),
        "materials[0]: its alpha (MASK) is in an image that is not read, so its shadow is wrong; convert KTX2 images "
        "(gltf-transform ktxdecompress IN OUT)");
    file.json["materials"][0]["alphaMode"] = "BLEND";
    EXPECT_NE(note().find("(BLEND)"), std::string::npos);
    file.json["materials"][0].erase("alphaMode");
    EXPECT_EQ(note(), "");
}

/// Loads a file with damaged compressed bytes many times: each loads or is refused in one sentence.
/// @param make makes a file of the bytes @param refused_at_least number of refusals or notes among all
template <class Make>
void damage(const Bytes& bytes, const Make& make, std::size_t refused_at_least) {
    std::mt19937 random(7);
    std::size_t refused = 0, runs = 0;
    const auto run = [&](const Bytes& changed) {
        ++runs;
        const auto file = make(changed);
        try {
            refused += !file.load().warnings.empty();
        } catch (const Error& error) {
            const std::string said = error.what();
            EXPECT_EQ(said.find("(signal"), std::string::npos) << said;
            EXPECT_EQ(said.find('\n'), std::string::npos) << said;
            EXPECT_LT(said.size(), 1000u);
            ++refused;
        }
    };
    for (std::size_t size = 1; size < bytes.size(); size += 1 + bytes.size() / 40)
        run({bytes.begin(), bytes.begin() + std::ptrdiff_t(size)});
    for (int i = 0; i < 160; ++i) {
        Bytes changed = bytes;
        for (unsigned n = 1 + random() % 3; n > 0; --n)
            changed[random() % changed.size()] ^= std::uint8_t(1 << random() % 8);
        run(changed);
    }
    EXPECT_GE(refused, refused_at_least) << "of " << runs;
}

TEST(CompressedDamage, MeshoptIsRefusedOrLoads) {
    damage(
        encoded_attributes(kCorners.data(), 4, 12),
        [](const Bytes& bytes) {
            MeshoptFile file;
            const int view = file.compressed(bytes, 4, 12, "ATTRIBUTES");
            file.root({{"mesh", file.mesh({{"attributes", {{"POSITION", file.accessor(view, 5126, "VEC3", 3)}}}})}});
            return file;
        },
        20);
    damage(
        encoded_faces(),
        [](const Bytes& bytes) {
            MeshoptFile file;
            const int view = file.compressed(bytes, kFaces.size(), 4, "TRIANGLES");
            file.root({{"mesh", file.mesh({{"attributes", {{"POSITION", file.floats(kCorners, "VEC3")}}},
                                           {"indices", file.accessor(view, 5125, "SCALAR", kFaces.size())}})}});
            return file;
        },
        20);
}

TEST(CompressedDamage, DracoIsRefusedOrLoads) {
    const auto make = [](const Bytes& bytes) { return DracoFile(bytes); };
    for (const bool edgebreaker : {false, true}) damage(draco_tetrahedron({kPositions}, edgebreaker), make, 40);
}

TEST(CompressedDamage, WebpIsRefusedOrLoads) {
    damage(
        webp_picture(16, 16), [](const Bytes& bytes) { return WebpFile(bytes); }, 20);
}

}  // namespace
}  // namespace si::test
