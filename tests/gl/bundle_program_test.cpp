// Runs assets/bundle/examples/opengl.c, a renderer that shares nothing with this program, and compares the maps of its
// bundle with rays through the bundle's own scene, by the bundle's own matrices.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "renderer/bundle/bundle_json.h"
#include "renderer/gltf/gltf.h"
#include "renderer/gltf/image_decode.h"
#include "tests/support/bundle_rays.h"
#include "tests/support/process.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

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
    EXPECT_NO_THROW(parse_bundle(file_bytes(bundle / "frame.json"), "frame.json"));
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
        for (std::size_t i = 0; i < scene.nodes.size(); ++i) EXPECT_EQ(json["drawn"][i], scene.nodes[i].path);
        const test::MapAgreement found = test::compare_with_rays(test::read_given_map(bundle, json), scene, 3);
        EXPECT_GT(found.covered, 1000u);
        EXPECT_LE(double(found.missed), 0.001 * double(found.covered));
        EXPECT_LE(double(found.extra), 0.0001 * double(found.covered));
        EXPECT_LE(found.steps_of(0.5), 1);
        EXPECT_LE(found.steps_of(0.99), 4);
        EXPECT_LE(found.steps_of(0.999), 4) << "masks and edges";
    }
}

INSTANTIATE_TEST_SUITE_P(All, BundleProgram,
                         testing::Values(Case{"CascadesOf16Bits", "--light sun --depth d16", 2},
                                         Case{"ReversedCascades", "--light sun --depth d32f --reversed --cull none", 2},
                                         Case{"SpotLight", "--light spot --depth d32f", 1},
                                         Case{"ReversedSpotLight", "--light spot --depth d16 --reversed --cull front",
                                              1}),
                         [](const testing::TestParamInfo<Case>& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace si
