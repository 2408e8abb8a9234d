// Tests of hostile and damaged glTF files.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "renderer/base/printable.h"
#include "renderer/gltf/file.h"
#include "tests/support/error_text.h"
#include "tests/unit/gltf_test_file.h"

namespace si::test {
namespace {

std::string error_of(const std::filesystem::path& path) {
    return error_text([&] { load_gltf(path); });
}

/// Makes a .gltf whose buffer is the file `uri`; `bin` gets the bytes.
std::string external(const std::string& uri, std::string& bin) {
    GltfFile file;
    file.add_triangle();
    bin = file.bin();
    file.json["buffers"] = {{{"uri", uri}, {"byteLength", bin.size()}}};
    return file.json.dump();
}

TEST(GltfGuard, ManyWarningsAreCountedNotListed) {
    GltfFile file;
    file.add_triangle();
    Json primitives = Json::array();
    for (int i = 0; i < 130; ++i)
        primitives.push_back({{"attributes", {{"POSITION", file.triangle_positions()}}}, {"mode", 0}});
    file.root({{"mesh", file.append("meshes", {{"primitives", primitives}})}});
    const Scene scene = file.load();
    ASSERT_EQ(scene.warnings.size(), 101u);
    EXPECT_EQ(scene.warnings.back(), "30 more warnings of this file are not listed");
    EXPECT_EQ(scene.triangle_count(), 1u);
}

TEST(GltfGuard, EveryTruncationOfAGlbIsRefused) {
    GltfFile file;
    file.add_triangle();
    const std::string whole = file.glb();
    const TemporaryFolder folder;
    EXPECT_EQ(error_of(folder.write("whole.glb", whole)), "");
    for (std::size_t n = 0; n < whole.size(); ++n) {
        EXPECT_NE(error_of(folder.write("cut.glb", whole.substr(0, n))), "") << n;
    }
}

TEST(GltfGuard, ChunksThatPassTheEndAreRefused) {
    GltfFile file;
    file.add_triangle();
    const std::string whole = file.glb();
    const std::size_t bin_header =
        20 + static_cast<unsigned char>(whole[12]) + 256 * static_cast<unsigned char>(whole[13]);
    const TemporaryFolder folder;
    for (const std::size_t header : {std::size_t{12}, bin_header}) {
        for (const std::string& length :
             {std::string("\xff\xff\xff\xff"), std::string("\xfc\xff\xff\xff"),
              std::string(1, static_cast<char>(whole[header] + 4)) + whole.substr(header + 1, 3)}) {
            std::string changed = whole;
            changed.replace(header, 4, length);
            const std::string error = error_of(folder.write("chunk.glb", changed));
            // A JSON chunk that is slightly longer includes the next header and is invalid JSON.
            EXPECT_TRUE(error.find("are left") != std::string::npos || error.find("parse error") != std::string::npos)
                << error;
        }
    }
}

TEST(GltfGuard, EverySingleByteChangeLoadsOrIsRefused) {
    GltfFile file;
    file.add_triangle();
    const std::string whole = file.glb();
    const TemporaryFolder folder;
    std::size_t refused = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        for (const char c : {'\xff', '9', '"'}) {
            std::string changed = whole;
            changed[i] = c;
            refused += error_of(folder.write("changed.glb", changed)).empty() ? 0 : 1;
        }
    }
    EXPECT_GT(refused, whole.size() / 2);
}

TEST(GltfGuard, ErrorsAreOneLineWithFilePlaceAndFix) {
    GltfFile file;
    file.add_triangle();
    file.json["accessors"][0]["count"] = 4;
    const std::string error = file.error();
    EXPECT_NE(error.find("model.glb: accessors[0]: 4 elements end at byte 48, its buffer view has 36; "),
              std::string::npos)
        << error;
    EXPECT_EQ(error.find('\n'), std::string::npos);
}

TEST(GltfGuard, UnsupportedRequiredExtensionsAreNamed) {
    for (const char* name : {"KHR_texture_procedurals", "EXT_structural_metadata", "VENDOR_thing"}) {
        GltfFile file;
        file.add_triangle();
        file.json["extensionsRequired"] = {name};
        EXPECT_NE(file.error().find(name), std::string::npos);
        file.json["extensionsUsed"] = file.json["extensionsRequired"];
        file.json.erase("extensionsRequired");
        EXPECT_EQ(file.error(), "");
    }
}

TEST(GltfGuard, FaultyViewsAreRefusedOnlyWhereAnAccessorReadsThem) {
    for (const auto& [view, fault] :
         {std::pair<Json, const char*>{{{"buffer", 0}, {"byteLength", 0}}, "its byteLength is 0"},
          {{{"buffer", 7}, {"byteLength", 4}}, "buffer 7 does not exist, the file has 1"},
          {{{"buffer", 0}, {"byteOffset", 4}, {"byteLength", 4000}}, "bytes 4 to 4004 pass the end of buffer 0"}}) {
        GltfFile file;
        file.add_triangle();
        file.append("bufferViews", view);
        const Scene scene = file.load();
        EXPECT_EQ(scene.triangle_count(), 1u);
        EXPECT_TRUE(mentions(scene.warnings, std::string("bufferViews[1]: ") + fault)) << fault;
        file.json["accessors"][0]["bufferView"] = 1;
        EXPECT_NE(file.error().find(std::string("bufferViews[1]: ") + fault), std::string::npos) << file.error();
    }
}

TEST(GltfGuard, VersionsOtherThanTwoAreRefused) {
    const auto with_asset = [](const Json& asset) {
        GltfFile file;
        file.add_triangle();
        file.json["asset"] = asset;
        return file.error();
    };
    EXPECT_EQ(with_asset({{"version", "2.1"}, {"minVersion", "2.0"}}), "");
    for (const char* version : {"1.0", "3.0", "2", "2.x", "", "20.0"})
        EXPECT_NE(with_asset({{"version", version}}), "") << version;
    EXPECT_NE(with_asset({{"version", "2.1"}, {"minVersion", "2.1"}}), "");
}

TEST(GltfGuard, DepthIsBoundedBeforeParsing) {
    const TemporaryFolder folder;
    const std::string deep =
        R"({"asset":{"version":"2.0"},"extras":)" + std::string(1'000'000, '[') + std::string(1'000'000, ']') + "}";
    EXPECT_NE(error_of(folder.write("deep.gltf", deep)).find("levels deep"), std::string::npos);
    // Brackets inside strings are text.
    const std::string flat = R"({"asset":{"version":"2.0","generator":"\"[[[[)" + std::string(100, '[') + "\"}}";
    EXPECT_EQ(error_of(folder.write("flat.gltf", flat)), "");
}

TEST(GltfGuard, BuffersInTheModelFolderAreRead) {
    const TemporaryFolder folder;
    std::string bin;
    for (const auto& [uri, name] : {std::pair{"a b.bin", "a b.bin"},
                                    {"c%20d.bin", "c d.bin"},
                                    {"e+f.bin", "e+f.bin"},
                                    {"g%41.bin", "gA.bin"},
                                    {"h%zz.bin", "h%zz.bin"},
                                    {"in/side.bin", "in/side.bin"},
                                    {"in/../up.bin", "up.bin"},
                                    {"i%20j.bin", "i%20j.bin"}}) {
        const std::string text = external(uri, bin);
        folder.write(name, bin);
        folder.write("in/side.bin", bin);
        EXPECT_EQ(error_of(folder.write("model.gltf", text)), "") << uri;
    }
}

TEST(GltfGuard, BuffersOutsideTheFolderAreNeverRead) {
    const TemporaryFolder folder;
    std::string bin;
    external("x", bin);
    folder.write("secret.bin", bin);
    std::filesystem::create_directories(folder.path() / "in");
    std::filesystem::create_symlink(folder.path() / "secret.bin", folder.path() / "in" / "link.bin");
    const std::string absolute = (folder.path() / "secret.bin").string();
    for (const std::string& uri :
         {std::string("../secret.bin"), std::string("%2e%2e/secret.bin"), std::string("./../secret.bin"),
          std::string("a/../../secret.bin"), std::string("link.bin"), std::string("../missing.bin"), absolute,
          "file://" + absolute, std::string("http://127.0.0.1/secret.bin"), std::string(""), std::string("."),
          std::string("/")}) {
        const std::string error = error_of(folder.write("in/model.gltf", external(uri, bin)));
        EXPECT_NE(error.find("buffers[0].uri"), std::string::npos) << uri;
        // The error does not reveal whether a file outside exists.
        EXPECT_EQ(error.find("does not exist"), std::string::npos) << error;
    }
}

TEST(GltfGuard, PipesAndDirectoriesAreRefusedAtOnce) {
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder.path() / "pipe.bin").c_str(), 0600), 0);
    ASSERT_EQ(mkfifo((folder.path() / "pipe.glb").c_str(), 0600), 0);
    std::string bin;
    EXPECT_NE(error_of(folder.write("model.gltf", external("pipe.bin", bin))).find("not a regular file"),
              std::string::npos);
    EXPECT_NE(error_of(folder.path() / "pipe.glb").find("not a regular file"), std::string::npos);
    EXPECT_NE(error_of(folder.path()).find("is a directory"), std::string::npos);
}

TEST(GltfGuard, FilesBeyondTheLimitAreRefused) {
    GltfFile file;
    file.add_triangle();
    GltfOptions options;
    options.max_file_bytes = file.glb().size();
    EXPECT_NO_THROW(file.load(options));
    --options.max_file_bytes;
    EXPECT_THROW(file.load(options), Error);
}

TEST(GltfGuard, Base64IsStrict) {
    const auto decoded = [](std::string_view data) {
        const auto result = gltf::decode_data_uri("data:application/octet-stream;base64," + std::string(data));
        return result.error.empty()
                   ? std::string(reinterpret_cast<const char*>(result.bytes.data.get()), result.bytes.size)
                   : "!";
    };
    EXPECT_EQ(decoded("Zm9vYmFy"), "foobar");
    EXPECT_EQ(decoded("Zm9vYg=="), "foob");
    EXPECT_EQ(decoded("Zm9vYmE="), "fooba");
    EXPECT_EQ(decoded("Zm9vYg"), "foob");
    EXPECT_EQ(decoded(""), "");
    for (const char* bad : {"Zm9v Yg", "Zm9vY", "Zm=vYg==", "Zm9vYg===", "Zm9-", "===="})
        EXPECT_EQ(decoded(bad), "!") << bad;
}

TEST(GltfGuard, NamesAreMadePrintable) {
    EXPECT_EQ(printable("größe 模型 ❤"), "größe 模型 ❤");
    EXPECT_TRUE(is_utf8("größe 模型 ❤"));
    for (const char* broken : {"\xff", "a\xc3", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\x80"})
        EXPECT_FALSE(is_utf8(broken)) << printable(broken);
    EXPECT_EQ(printable("a\x1b[31m\n"), "a\\x1b[31m\\x0a");
    EXPECT_EQ(printable("\u202e"
                        "x\xff"),
              "\\u202ex\\xff");
    EXPECT_EQ(printable(std::string(1000, 'a'), 10), "aaaaaaaaaa…");
}

TEST(GltfGuard, ProgressRisesAndCancels) {
    const TemporaryFolder folder;
    std::string bin;
    const auto path = folder.write("model.gltf", external("model.bin", bin));
    folder.write("model.bin", bin);
    std::vector<double> seen;
    GltfOptions options;
    options.progress = [&](double p) { return seen.push_back(p), true; };
    load_gltf(path, options);
    ASSERT_GE(seen.size(), 4u);
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    EXPECT_EQ(seen.back(), 1.0);
    for (std::size_t stop = 0; stop < seen.size(); ++stop) {
        std::size_t calls = 0;
        options.progress = [&](double) { return calls++ < stop; };
        EXPECT_EQ(error_text([&] { load_gltf(path, options); }), "cancelled") << "at call " << stop;
    }
}

TEST(GltfGuard, MissingBuffersAreNamedBeforeTheirCountsAreUsed) {
    constexpr std::uint32_t kCount = 5'000'000;
    GltfFile file;
    const int beyond = file.indices(std::vector<std::uint32_t>{0, 1, kCount});
    const int view = file.append("bufferViews", {{"buffer", 1}, {"byteLength", 12 * kCount}});
    const int position = file.accessor(view, 5126, "VEC3", kCount);
    const Json attributes = {{"POSITION", position}};
    file.json["buffers"] = {{{"uri", "indices.bin"}, {"byteLength", file.bin().size()}},
                            {{"uri", "a.bin"}, {"byteLength", 12 * kCount}}};
    const TemporaryFolder folder;
    folder.write("indices.bin", file.bin());
    const Json indexed = {{"attributes", attributes}, {"indices", beyond}};
    const Json strip = {{"attributes", attributes}, {"mode", 5}};
    for (const Json& primitive : {indexed, strip}) {
        GltfFile one = file;
        one.root({{"mesh", one.mesh(primitive)}});
        const std::string error = error_of(folder.write("model.gltf", one.json.dump()));
        EXPECT_NE(error.find("buffers[1].uri: \"a.bin\": the file does not exist"), std::string::npos) << error;
    }
}

TEST(GltfGuard, EndlesslyRepeatedBytesAreRefused) {
    GltfFile file;
    const int position = file.triangle_positions();
    const int mesh = file.mesh({{"attributes", {{"POSITION", position}}}});
    const int shown = file.accessor(file.view(std::vector<float>(3)), 5126, "VEC3", 1);
    file.root({{"mesh", mesh}});
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = shown;
    EXPECT_EQ(file.error(), "");
    // A thousand million instances out of twelve bytes: refused by the range check, and without bytes by the cap.
    file.json["accessors"][shown]["count"] = 1'000'000'000;
    EXPECT_NE(file.error(), "");
    file.json["accessors"][shown].erase("bufferView");
    EXPECT_NE(file.error().find("have no bufferView"), std::string::npos);
}

}  // namespace
}  // namespace si::test
