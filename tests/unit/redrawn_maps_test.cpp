// Tests of maps that are drawn again with the views of a bundle: size, raster state, and the settings that change them.
#include "renderer/bundle/redrawn_maps.h"

#include <gtest/gtest.h>

#include "tests/support/sets.h"

namespace si {
namespace {

ImportedMaps raster_maps(bool reversed, std::vector<CasterRaster> raster) {
    LightView view;
    view.curve = {.perspective = false, .near = 0, .far = 20, .convention = {}, .warp = {}};
    view.curve.convention.reversed = reversed;
    view.set_half_extents(glm::dvec2(4, 1));
    const FloatImage image{8, 2, 1, std::vector<float>(16, 0.5f)};
    const std::size_t count = std::max<std::size_t>(raster.size(), 1);
    return *imported_maps(std::vector<FloatImage>(count, image), ImportedViews{std::vector<LightView>(count, view), {}},
                          std::move(raster));
}

TEST(RedrawnMaps, KeepViewsAndProportions) {
    const ImportedMaps given = raster_maps(false, {});
    for (const auto& [resolution, size] : {std::pair{8, MapSize(8, 2)}, {32, MapSize(32, 8)}, {1, MapSize(1, 1)}}) {
        Settings s;
        s.map.resolution = resolution;
        const auto drawn = redrawn_maps(given, s, {});
        EXPECT_FALSE(drawn->has_images());
        EXPECT_EQ(drawn->size(), size);
        EXPECT_TRUE(drawn->raster.empty()) << "the settings decide";
        EXPECT_EQ(drawn->views->views[0].projection, given.views->views[0].projection);
    }
    Settings a, b;
    b.map.resolution = 2 * a.map.resolution;
    EXPECT_NE(redrawn_maps(given, a, {})->key, redrawn_maps(given, b, {})->key);
}

// Settings that are as the bundle began leave each map its own state. A changed setting acts on all maps.
TEST(RedrawnMaps, ChangedSettingsReplaceTheRasterState) {
    for (const bool reversed : {false, true}) {
        const double sign = reversed ? -1 : 1;
        const std::vector<CasterRaster> raster = {{sign * 2, sign * 3, sign * 0.5, Cull::Back},
                                                  {sign * 5, 0, 0, Cull::Front}};
        const ImportedMaps given = raster_maps(reversed, raster);
        const CasterRaster begun{2, 3, 0.5, Cull::Back};
        const Settings same = settings_with(
            Settings{}, {"bias.raster_slope=2", "bias.raster_units=3", "bias.raster_clamp=0.5", "caster.cull=back"});
        EXPECT_EQ(redrawn_maps(given, same, begun)->raster, raster);
        const auto with = [&](const char* change) {
            return redrawn_maps(given, settings_with(same, {change}), begun)->raster;
        };
        for (const std::size_t i : {0, 1}) {
            EXPECT_EQ(with("bias.raster_slope=1")[i].offset_factor, sign);
            EXPECT_EQ(with("bias.raster_units=7")[i].offset_units, sign * 7);
            EXPECT_EQ(with("bias.raster_clamp=0.25")[i].offset_clamp, sign * 0.25);
            EXPECT_EQ(with("caster.cull=none")[i].cull, std::nullopt);
            EXPECT_EQ(with("bias.raster_slope=1")[i].offset_units, raster[i].offset_units);
            EXPECT_EQ(with("bias.raster_slope=1")[i].cull, raster[i].cull);
        }
    }
}

TEST(RedrawnMaps, TheFirstMapGivesTheStateAtTheBeginning) {
    Bundle bundle;
    bundle.lights.resize(2);
    bundle.lights[1].maps.resize(2);
    EXPECT_EQ(first_raster(bundle), (CasterRaster{0, 0, 0, Cull::None}));
    BundleMap& map = bundle.lights[1].maps[0];
    map.raster.offset_factor = 2;
    map.raster.cull = Cull::Front;
    EXPECT_EQ(first_raster(bundle), (CasterRaster{2, 0, 0, Cull::Front}));
    map.depth.convention.reversed = true;
    EXPECT_EQ(first_raster(bundle), (CasterRaster{-2, 0, 0, Cull::Front})) << "above 0 is away from the light";
}

}  // namespace
}  // namespace si
