// Tests of materials, textures and texture coordinates of glTF files.
#include <gtest/gtest.h>

#include "tests/unit/gltf_test_file.h"

namespace si::test {
namespace {

/// Returns a PNG of 2 x 1 pixels: red, then green half transparent. Deflate with one stored block and correct
/// checksums.
std::vector<std::uint8_t> png() {
    const auto crc = [](std::string_view bytes) {
        std::uint32_t c = 0xffffffff;
        for (const char b : bytes) {
            c ^= static_cast<unsigned char>(b);
            for (int k = 0; k < 8; ++k) c = (c & 1) ? 0xedb88320u ^ (c >> 1) : c >> 1;
        }
        return ~c;
    };
    std::string out("\x89PNG\r\n\x1a\n", 8);
    const auto u32 = [](std::uint32_t v) {
        return std::string{static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8),
                           static_cast<char>(v)};
    };
    const auto chunk = [&](const std::string& type, const std::string& data) {
        out += u32(static_cast<std::uint32_t>(data.size())) + type + data + u32(crc(type + data));
    };
    chunk("IHDR", u32(2) + u32(1) + std::string("\x08\x06\0\0\0", 5));
    const std::string row("\0\xff\0\0\xff\0\xff\0\x80", 9);
    std::uint32_t a = 1, b = 0;
    for (const char c : row) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    chunk("IDAT", std::string("\x78\x01\x01\x09\0\xf6\xff", 7) + row + u32(b << 16 | a));
    chunk("IEND", "");
    return {out.begin(), out.end()};
}

/// Triangle whose material reads a texture; TEXCOORD_0 and TEXCOORD_1 differ.
struct Textured : GltfFile {
    Textured() {
        const Json attributes = {{"POSITION", triangle_positions()},
                                 {"TEXCOORD_0", floats({0, 0, 1, 0, 0, 1}, "VEC2")},
                                 {"TEXCOORD_1", floats({0.5f, 0.5f, 0.75f, 0.5f, 0.5f, 1}, "VEC2")}};
        root({{"mesh", mesh({{"attributes", attributes}, {"material", 0}})}});
        append("images", {{"bufferView", view(png())}, {"mimeType", "image/png"}, {"name", "leaf"}});
        append("textures", {{"source", 0}});
        append("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    }
    Json& material() { return json["materials"][0]; }
    Json& texture_info() { return material()["pbrMetallicRoughness"]["baseColorTexture"]; }
};

TEST(GltfMaterial, ReadsFactorsModesAndFlags) {
    Textured file;
    file.material()["pbrMetallicRoughness"]["baseColorFactor"] = {0.1, 0.2, 0.3, 0.4};
    file.material()["alphaMode"] = "MASK";
    file.material()["alphaCutoff"] = 0.3;
    file.material()["doubleSided"] = true;
    file.material()["extensions"]["KHR_materials_unlit"] = Json::object();
    file.material()["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
    const Material m = file.load().materials.at(0);
    EXPECT_EQ(m.base_colour, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(m.alpha, AlphaMode::Mask);
    EXPECT_FLOAT_EQ(m.alpha_cutoff, 0.3f);
    EXPECT_TRUE(m.double_sided);
    EXPECT_TRUE(m.unlit);
    EXPECT_FLOAT_EQ(m.normal_scale, 0.5f);
    EXPECT_NE(m.normal_texture, m.base_colour_texture);  // one is sRGB, the other is not
}

TEST(GltfMaterial, DefaultsAreThoseOfGltf) {
    Textured file;
    file.material() = Json::object();
    const Material m = file.load().materials.at(0);
    EXPECT_EQ(m.base_colour, glm::vec4(1));
    EXPECT_EQ(m.alpha, AlphaMode::Opaque);
    EXPECT_FLOAT_EQ(m.alpha_cutoff, 0.5f);
    EXPECT_FALSE(m.double_sided);
}

TEST(GltfMaterial, ReadsTexturePixelsAndSampler) {
    Textured file;
    file.append("samplers", {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9729}});
    file.json["textures"][0]["sampler"] = 0;
    const Scene scene = file.load();
    ASSERT_EQ(scene.textures.size(), 1u);
    const Texture& t = scene.textures[0];
    EXPECT_EQ(t.name, "leaf");
    EXPECT_EQ(t.width, 2);
    EXPECT_EQ(t.rgba, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 128}));
    EXPECT_TRUE(t.srgb);
    EXPECT_EQ(t.wrap_s, TextureWrap::Clamp);
    EXPECT_EQ(t.wrap_t, TextureWrap::Mirror);
    EXPECT_TRUE(t.nearest_mag);
    EXPECT_FALSE(t.nearest_min);
    EXPECT_FALSE(t.mipmaps);
}

TEST(GltfMaterial, ReadsMinificationFilters) {
    struct Row {
        int filter;
        bool nearest, mipmaps;
    };
    for (const Row& row : {Row{9728, true, false}, Row{9729, false, false}, Row{9984, true, true},
                           Row{9985, false, true}, Row{9986, true, true}, Row{9987, false, true}}) {
        Textured file;
        file.append("samplers", {{"minFilter", row.filter}});
        file.json["textures"][0]["sampler"] = 0;
        const Texture t = file.load().textures.at(0);
        EXPECT_EQ(t.nearest_min, row.nearest) << row.filter;
        EXPECT_EQ(t.mipmaps, row.mipmaps) << row.filter;
    }
    EXPECT_TRUE(Textured().load().textures.at(0).mipmaps);
}

TEST(GltfMaterial, SecondCoordinateSetIsBakedIn) {
    Textured file;
    file.texture_info()["texCoord"] = 1;
    EXPECT_EQ(file.load().meshes.at(0).uv, (std::vector<glm::vec2>{{0.5f, 0.5f}, {0.75f, 0.5f}, {0.5f, 1}}));
}

// The example of KHR_texture_transform: offset (0, 1), rotation 90 degrees, scale 0.5 shows the lower left... as
// u' = u0 + s_u u cos + s_v v sin, v' = v0 - s_u u sin + s_v v cos.
TEST(GltfMaterial, TextureTransformScalesThenRotatesThenMoves) {
    Textured file;
    file.texture_info()["extensions"]["KHR_texture_transform"] = {
        {"offset", {0, 1}}, {"rotation", 1.5707963267948966}, {"scale", {0.5, 0.25}}};
    const auto uv = file.load().meshes.at(0).uv;
    const std::vector<glm::vec2> expected{{0, 1}, {0, 0.5f}, {0.25f, 1}};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(glm::length(uv[i] - expected[i]), 1e-6f) << i;
}

TEST(GltfMaterial, TransformMayNameTheCoordinateSet) {
    Textured file;
    file.texture_info()["extensions"]["KHR_texture_transform"] = {{"texCoord", 1}, {"offset", {1, 0}}};
    EXPECT_EQ(file.load().meshes.at(0).uv[0], glm::vec2(1.5f, 0.5f));
}

TEST(GltfMaterial, NormalTextureHasCoordinatesOfItsOwnOnlyWhenTheyDiffer) {
    Textured file;
    file.material()["normalTexture"] = {{"index", 0}};
    EXPECT_TRUE(file.load().meshes.at(0).uv_normal.empty());
    file.material()["normalTexture"]["texCoord"] = 1;
    const Scene scene = file.load();
    EXPECT_EQ(scene.meshes.at(0).uv[0], glm::vec2(0, 0));
    EXPECT_EQ(scene.meshes.at(0).uv_normal.all().at(0), glm::vec2(0.5f, 0.5f));
}

TEST(GltfMaterial, UnreadableFormatFallsBackOrIsUntextured) {
    Textured file;
    file.json["textures"][0]["extensions"]["EXT_texture_avif"]["source"] = 0;
    EXPECT_EQ(file.load().textures.size(), 1u);  // the plain source is the fallback
    file.json["textures"][0].erase("source");
    const Scene scene = file.load();
    EXPECT_TRUE(scene.textures.empty());
    EXPECT_EQ(scene.materials.at(0).base_colour_texture, -1);
    EXPECT_TRUE(mentions(scene.warnings, "EXT_texture_avif is not supported"));
}

TEST(GltfMaterial, BrokenImageDropsOnlyItsTexture) {
    Textured file;
    std::vector<std::uint8_t> cut = png();
    cut.resize(40);
    file.json["images"].push_back({{"bufferView", file.view(cut)}});
    file.json["textures"].push_back({{"source", 1}});
    file.json["textures"].push_back({{"source", 0}, {"name", "again"}});
    file.texture_info()["index"] = 1;
    file.material()["normalTexture"] = {{"index", 0}};
    const Scene scene = file.load();
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.materials.at(0).base_colour_texture, -1);
    EXPECT_EQ(scene.materials.at(0).normal_texture, 0);
    EXPECT_TRUE(mentions(scene.warnings, "images[1]"));
}

TEST(GltfMaterial, WrongReferencesOfTexturesAreDropped) {
    Textured file;
    file.append("textures", {{"source", 4}, {"sampler", 2}});  // read by nothing
    file.append("textures", {{"source", "leaf"}});
    const Scene scene = file.load();
    EXPECT_EQ(scene.materials.at(0).base_colour_texture, 0);
    EXPECT_TRUE(mentions(scene.warnings, "textures[1].source: image 4 does not exist, the file has 1"));
    EXPECT_TRUE(mentions(scene.warnings, "textures[1].sampler: sampler 2 does not exist, the file has 0"));
    EXPECT_TRUE(mentions(scene.warnings, "textures[2].source: names no image"));
    for (const int texture : {1, 9}) {
        file.texture_info()["index"] = texture;
        EXPECT_EQ(file.load().materials.at(0).base_colour_texture, -1) << texture;
    }
    EXPECT_TRUE(mentions(file.load().warnings, "texture 9 does not exist, the file has 3; drawn untextured"));
}

TEST(GltfMaterial, AnImageInAFaultyViewIsNotShown) {
    Textured file;
    file.json["images"][0]["bufferView"] = file.append("bufferViews", {{"buffer", 0}, {"byteLength", 4000}});
    const Scene scene = file.load();
    EXPECT_TRUE(scene.textures.empty());
    EXPECT_TRUE(mentions(scene.warnings, "images[0]: its bufferView"));
}

TEST(GltfMaterial, BlendWithFullAlphaIsOpaque) {
    const auto alpha = [](GltfFile& file) {
        const Scene scene = file.load();
        const bool opaque = scene.materials.at(0).alpha == AlphaMode::Opaque;
        EXPECT_EQ(mentions(scene.warnings,
                           "materials[0]: alphaMode is BLEND with alpha 1 everywhere; drawn and cast "
                           "as opaque"),
                  opaque);
        return scene.materials.at(0).alpha;
    };
    Textured file;
    file.material()["alphaMode"] = "BLEND";
    EXPECT_EQ(alpha(file), AlphaMode::Blend) << "the texture's second texel has alpha 128";
    Textured undecoded = file;
    undecoded.json["images"][0] = {{"uri", "missing.png"}};
    EXPECT_EQ(alpha(undecoded), AlphaMode::Blend) << "its alpha is unknown";
    file.material()["pbrMetallicRoughness"].erase("baseColorTexture");
    EXPECT_EQ(alpha(file), AlphaMode::Opaque);
    for (const auto& [factor, mode] : {std::pair{0.9965, AlphaMode::Opaque}, {0.995, AlphaMode::Blend}}) {
        file.material()["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, factor};
        EXPECT_EQ(alpha(file), mode) << factor;
    }
    file.material()["pbrMetallicRoughness"].erase("baseColorFactor");
    Json& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["COLOR_0"] = file.floats({1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1}, "VEC4");
    EXPECT_EQ(alpha(file), AlphaMode::Opaque);
    attributes["COLOR_0"] = file.floats({1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 0.5f}, "VEC4");
    EXPECT_EQ(alpha(file), AlphaMode::Blend);
}

TEST(GltfMaterial, WrongValuesFallBackWithAWarning) {
    Textured file;
    file.material()["alphaMode"] = "HASHED";
    file.material()["alphaCutoff"] = -1;
    file.material()["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1};
    const Scene scene = file.load();
    EXPECT_EQ(scene.materials.at(0).alpha, AlphaMode::Opaque);
    EXPECT_EQ(scene.materials.at(0).base_colour, glm::vec4(1));
    EXPECT_EQ(scene.materials.at(0).base_colour_texture, 0);
    for (const char* key : {"alphaMode", "alphaCutoff", "baseColorFactor"})
        EXPECT_TRUE(mentions(scene.warnings, key)) << key;
}

}  // namespace
}  // namespace si::test
