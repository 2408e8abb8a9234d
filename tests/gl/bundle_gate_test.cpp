// Draws the maps of bundles again, with their own matrices and states, and compares them with the given ones: the gate
// that imported maps have to pass.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/context/headless_context.h"
#include "renderer/bundle/imported_maps.h"
#include "renderer/gltf/gltf.h"
#include "renderer/inspect/map_comparison.h"
#include "renderer/projection/view_of_matrix.h"
#include "renderer/settings/param.h"
#include "tests/support/bundle_rays.h"
#include "tests/support/combinations.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Returns the maps of a bundle's first light with their views and raster states.
std::shared_ptr<const ImportedMaps> maps_of(const fs::path& bundle, const Json& maps) {
    std::vector<FloatImage> images;
    ImportedViews views;
    std::vector<CasterRaster> raster;
    for (const Json& json : maps) {
        const test::GivenMap given = test::read_given_map(bundle, json);
        FloatImage image{given.width, given.height, 1, {}};
        // FloatImage has the top row first.
        for (int y = given.height - 1; y >= 0; --y)
            for (int x = 0; x < given.width; ++x)
                image.data.push_back(float(given.depth[std::size_t(y) * std::size_t(given.width) + std::size_t(x)]));
        images.push_back(std::move(image));
        const DepthConvention convention{.zero_to_one = json["depth"]["range"] == "0..1",
                                         .reversed = json["depth"]["reversed"]};
        views.views.push_back(view_of_matrix(given.clip_from_world, convention));
        const Json& state = json["raster"];
        const Cull culled = state["cull"] == "back" ? Cull::Back : state["cull"] == "front" ? Cull::Front : Cull::None;
        raster.push_back({.offset_factor = state["offset_factor"],
                          .offset_units = state["offset_units"],
                          .offset_clamp = state["offset_clamp"],
                          .cull = culled_faces(culled, state["front"] == "cw", views.views.back())});
    }
    return imported_maps(std::move(images), std::move(views), std::move(raster));
}

SI_TESTS_ARE(Product, BundleGate);

SI_TEST_IS(Later, BundleGate, MapsOfTheExampleAreDrawnAgain);
TEST(BundleGate, MapsOfTheExampleAreDrawnAgain) {
    const HeadlessContext context;
    Renderer renderer;
    using Words = std::vector<std::string>;
    for (const auto& [light, depth, cull, reversed] : test::combinations(
             Words{"sun", "spot"}, Words{"d16", "d32f"}, Words{"none", "back", "front"}, Words{"", " --reversed"})) {
        const std::string options = "--light " + light + " --depth " + depth + " --cull " + cull + reversed;
        SCOPED_TRACE(options);
        const fs::path bundle = fresh_test_folder() / "frame.bundle";
        const ProcessResult run =
            run_shell("'" + std::string(SI_BUNDLE_WRITERS) + "/bundle_opengl' '" + bundle.string() + "' " + options);
        ASSERT_EQ(run.code, 0) << run.err;
        const Json json = Json::parse(file_bytes(bundle / "frame.json"))["lights"][0];
        const Scene scene = load_gltf(bundle / "scene.glb");
        Settings s;
        s.lights[0].type = light == "sun" ? LightType::Directional : LightType::Spot;
        set_setting(s, "map.format", depth);
        set_setting(s, "map.reversed_z", reversed.empty() ? "false" : "true");
        // Vertices are transformed in floats, whose rounding is two steps of a float near the far plane.
        MapCompareOptions compare;
        compare.limits.median_steps = depth == "d32f" ? 2 : 1;
        const auto compared = compare_imported_maps(renderer, scene, s, {maps_of(bundle, json["maps"])}, 0, compare);
        ASSERT_EQ(compared.size(), json["maps"].size());
        for (const ComparedMap& map : compared) {
            EXPECT_TRUE(map.numbers.gate.passed()) << map.numbers.gate.text << map.numbers.gate.hint;
            EXPECT_GT(map.numbers.covered, 10000u);
            EXPECT_TRUE(map.lacking.empty());
        }
    }
}

}  // namespace
}  // namespace si
