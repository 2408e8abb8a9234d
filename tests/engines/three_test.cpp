// Runs shadow_bundle.js with three.js in a headless browser, and compares the maps of its bundles with rays through the
// bundles' own scenes.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "renderer/bundle/bundle_files.h"
#include "renderer/bundle/bundle_json.h"
#include "renderer/gltf/gltf.h"
#include "renderer/gltf/image_decode.h"
#include "tests/support/bundle_rays.h"
#include "tests/support/missing_reason.h"
#include "tests/support/process.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Precision of SwiftShader's rasteriser, which has four bits below a pixel.
constexpr double kSnapTexels = 1.0 / 16;

std::string quoted(const fs::path& path) {
    return "'" + path.string() + "'";
}

/// Writes the stored entries of a zip file to a folder and returns their names. Expects no other kind of entry.
std::map<std::string, std::size_t> unpack(const fs::path& zip, const fs::path& folder) {
    const std::string bytes = file_bytes(zip);
    std::map<std::string, std::size_t> out;
    fs::create_directories(folder);
    const auto number = [&](std::size_t at, std::size_t size) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, size);
        return std::size_t(value);
    };
    std::size_t at = 0;
    while (at + 30 < bytes.size() && number(at, 4) == 0x04034b50) {
        EXPECT_EQ(number(at + 8, 2), 0u) << "stored";
        const std::size_t size = number(at + 18, 4), name_size = number(at + 26, 2);
        const std::string name = bytes.substr(at + 30, name_size);
        EXPECT_EQ(name.find_first_of("/\\"), name.npos) << name;
        std::ofstream(folder / name, std::ios::binary) << bytes.substr(at + 30 + name_size, size);
        out[name] = size;
        at += 30 + name_size + size;
    }
    EXPECT_EQ(number(at, 4), 0x02014b50u) << "the directory of the zip file";
    return out;
}

/// Bundles of three.js, made once for all tests.
class ThreeBundles : public testing::Test {
protected:
    static inline fs::path folder;
    static inline std::string lacking, failure;

    static void SetUpTestSuite() {
        for (const char* command : {"node", "npm", "chromium"})
            if (run_shell(std::string("command -v ") + command).code != 0) lacking = command;
        if (!lacking.empty()) return;
        folder = fs::path(SI_TEST_OUTPUT_DIR) / "bundle_three";
        const fs::path source = fs::path(SI_SOURCE_DIR) / "tests/bundle_three";
        fs::remove_all(folder / "out");
        fs::create_directories(folder / "out");
        for (const char* file : {"package.json", "package-lock.json"})
            fs::copy_file(source / file, folder / file, fs::copy_options::overwrite_existing);
        const ProcessResult install = run_shell("npm ci --ignore-scripts --no-audit --no-fund 2>&1", folder);
        if (install.code != 0) {
            // A lock that does not fit is an error, a registry that does not answer is not.
            const bool is_wrong =
                install.out.find("EINTEGRITY") != install.out.npos || install.out.find("EUSAGE") != install.out.npos;
            (is_wrong ? failure : lacking) = is_wrong ? install.out : "three.js from npm";
            return;
        }
        const ProcessResult run =
            run_shell("node " + quoted(source / "capture.mjs") + " " + quoted(folder / "out") + " " +
                      quoted(folder / "node_modules") + " " + quoted(fs::path(SI_SOURCE_DIR) / "assets/bundle"));
        if (run.code != 0) failure = run.err;
    }
    void SetUp() override {
        if (!lacking.empty()) GTEST_SKIP() << test::kMissingReason << lacking;
        ASSERT_EQ(failure, "");
    }
    /// Unpacks a bundle and checks what all have.
    static Json read(const std::string& name, const fs::path& bundle) {
        const auto files = unpack(folder / "out" / (name + ".zip"), bundle);
        EXPECT_TRUE(files.contains("frame.json"));
        // The program's reader finds the same.
        BundleFiles opened(folder / "out" / (name + ".zip"));
        for (const auto& [file, size] : files) EXPECT_EQ(opened.read(file, std::size_t{1} << 30).size(), size) << file;
        EXPECT_NO_THROW(parse_bundle(file_bytes(bundle / "frame.json"), "frame.json"));
        const Json frame = Json::parse(file_bytes(bundle / "frame.json"));
        EXPECT_EQ(frame["made_by"], "test \"" + name + "\", three.js r187");
        const std::string png = file_bytes(bundle / "picture.png");
        const gltf::Image picture = gltf::decode_image({reinterpret_cast<const std::uint8_t*>(png.data()), png.size()});
        EXPECT_EQ(picture.error, "");
        EXPECT_EQ(picture.width, frame["camera"]["width"]);
        EXPECT_EQ(picture.height, frame["camera"]["height"]);
        return frame;
    }
};

TEST_F(ThreeBundles, MapsHoldTheirScene) {
    for (const std::string name : {"directional", "spot", "reversed", "point", "cascades"}) {
        SCOPED_TRACE(name);
        if (fs::exists(folder / "out" / (name + ".lacks"))) {
            std::printf("%s is left out: the browser lacks EXT_clip_control\n", name.c_str());
            continue;
        }
        const fs::path bundle = folder / "out" / name;
        const Json frame = read(name, bundle);
        const Scene scene = load_gltf(bundle / "scene.glb");
        EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
        const Json& maps = frame["lights"][0]["maps"];
        ASSERT_EQ(maps.size(), name == "point" ? 6u : name == "cascades" ? 2u : 1u);
        std::size_t covered = 0, missed = 0, extra = 0;
        for (const Json& json : maps) {
            EXPECT_EQ(json["raster"]["cull"], "front") << "three.js draws back faces";
            const test::MapAgreement found =
                test::compare_with_rays(test::read_given_map(bundle, json), scene, 2, kSnapTexels);
            covered += found.covered;
            missed += found.missed;
            extra += found.extra;
            if (found.steps.empty()) continue;
            EXPECT_LE(found.steps_of(0.5), 1);
            EXPECT_LE(found.steps_of(0.99), 4);
        }
        EXPECT_GT(covered, 1000u);
        EXPECT_EQ(maps[0].contains("interval"), name == "cascades");
        EXPECT_LE(double(missed), 0.001 * double(covered));
        EXPECT_LE(double(extra), 0.0001 * double(covered));
    }
}

// A variance map is blurred, so that single texels say little.
TEST_F(ThreeBundles, VarianceMapsHoldTheMeanDepth) {
    const fs::path bundle = folder / "out/variance";
    const Json frame = read("variance", bundle);
    const Json& map = frame["lights"][0]["maps"][0];
    EXPECT_EQ(map["depth"]["stored"], "moments");
    EXPECT_EQ(frame["lights"][0]["lookup"]["kernel"], "vsm");
    const test::MapAgreement found =
        test::compare_with_rays(test::read_given_map(bundle, map), load_gltf(bundle / "scene.glb"), 2, kSnapTexels);
    EXPECT_LE(double(found.missed), 0.001 * double(found.covered));
    EXPECT_LE(found.steps_of(0.5), 1) << "steps of half floats";
}

TEST_F(ThreeBundles, ObjectsKeepNamesFlagsAndBias) {
    const fs::path bundle = folder / "out/named";
    const Json frame = read("directional", bundle);
    const Scene scene = load_gltf(bundle / "scene.glb");
    std::vector<std::string> paths;
    for (const Node& node : scene.nodes) paths.push_back(node.path);
    EXPECT_EQ(paths, (std::vector<std::string>{"Ground", "Box", "Box #2", "Ball", "Fence_front", "Post", "Post #2",
                                               "Post #3"}));
    const Json drawn = frame["lights"][0]["maps"][0]["drawn"];
    EXPECT_EQ(drawn, Json(std::vector<std::string>(paths.begin() + 1, paths.end())));
    ASSERT_EQ(scene.suggested.size(), 4u) << "posts receive nothing";
    EXPECT_EQ(scene.suggested[0].first, "object.Ground.cast");
    const Json& bias = frame["lights"][0]["lookup"]["bias"];
    EXPECT_EQ(bias["constant"], 0.0005);
    EXPECT_EQ(bias["normal"], 0.02);
    EXPECT_EQ(frame["lights"][0]["direction"], (Json{-3.5, -5, -2.5}));
}

}  // namespace
}  // namespace si
