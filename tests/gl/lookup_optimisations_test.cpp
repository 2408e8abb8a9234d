// Tests optimisations of map look-ups: forced look-ups give the same bytes, and the overlay `taps` counts fewer
// fetches.
#include <algorithm>
#include <numeric>

#include "renderer/measure/optimisation_times.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/depth_compare.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/map_storage.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/hard_case.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class LookupOptimisationsTest : public FrameTest {
protected:
    FrameRequest request{.width = 128, .height = 96};

    /// Draws the maps once, because bounds exist only for cached maps.
    void draw_maps(const Scene& scene, const Settings& s, OptimisationSet forced) {
        FrameRequest maps = request;
        maps.forced = forced;
        maps.outputs = {.colour = false, .shadow_map = true};
        renderer.render(scene, s, maps);
    }
    FloatImage visibility(const Scene& scene, const Settings& s, OptimisationSet forced = {}) {
        request.forced = forced;
        draw_maps(scene, s, forced);
        request.outputs = {.colour = false, .visibility = true};
        return renderer.read_float(renderer.render(scene, s, request).visibility, 1);
    }
    /// Returns the fetched texels by pixel; negative without surface or number.
    std::vector<float> taps(const Scene& scene, Settings s, OptimisationSet forced = {}) {
        set_setting(s, "view.overlay", "taps");
        request.forced = forced;
        draw_maps(scene, s, forced);
        request.outputs = {.colour = false, .overlay = true};
        const FloatImage values = renderer.read_float(renderer.render(scene, s, request).overlay, 4);
        std::vector<float> out;
        for (std::size_t i = 0; i < values.data.size(); i += 4)
            out.push_back(values.data[i + 3] > 0 && std::isfinite(values.data[i]) ? values.data[i] : -1);
        return out;
    }
    /// Expects the same number of fetched texels at every pixel with a surface.
    void expect_taps(const Scene& scene, const Settings& s, OptimisationSet forced, float texels, const char* what) {
        int shown = 0, other = 0;
        for (const float n : taps(scene, s, forced)) {
            shown += n >= 0;
            other += n >= 0 && n != texels;
        }
        EXPECT_GT(shown, 1000) << what;
        EXPECT_EQ(other, 0) << what;
    }
    void expect_equal_bytes(const Scene& scene, const Settings& s, OptimisationSet forced, const std::string& what) {
        const FloatImage some = visibility(scene, s), all = visibility(scene, s, forced);
        EXPECT_EQ(some.data, all.data) << what << ", visibility";
        request.outputs = {};
        request.forced = {};
        draw_maps(scene, s, {});
        const ByteImage saved = picture(scene, s, request);
        request.forced = forced;
        EXPECT_EQ(different_pixels(saved, picture(scene, s, request)), 0u) << what << ", picture";
    }
};

const OptimisationSet kLookups = {Optimisation::EarlyOut, Optimisation::BlockerSearch,
                                  Optimisation::BackFacingReceivers};

/// Returns settings for a bare floor within the map, whose outside mode continues the floor.
Settings floor_settings(std::string_view kernel) {
    Settings s = test::texel_settings(kernel, 256, 0.2);
    set_setting(s, "bias.kind", "adaptive");
    s.bias.normal = 1;  // adaptive bias leaves no margin
    set_setting(s, "map.wrap", "clamp");
    return s;
}

Scene bare_floor() {
    Scene scene = test::floor_and_box();
    scene.objects.resize(1);
    finalise(scene);
    return scene;
}

SI_TESTS_ARE(Repeated, LookupOptimisationsTest);
TEST_F(LookupOptimisationsTest, NoTapIsFetchedWhereTheMapHoldsOnePlane) {
    const Scene scene = bare_floor();
    for (const char* kernel : {"pcf", "gauss", "poisson", "vogel", "dpcf", "pcss"}) {
        Settings s = floor_settings(kernel);
        s.filter.size = 15;
        s.map.resolution = 1024;
        s.camera.distance = 2;  // well inside the floor's edges
        s.filter.taps = s.filter.blocker_taps = 64;
        s.lights[0].size = 0.2;
        const FilterCost cost = kernel_cost(s);
        const bool searches = std::string_view(kernel) == "pcss";  // a search ends where it finds no blocker
        expect_taps(scene, s, {Optimisation::EarlyOut}, float(searches ? 64 : cost.texels), kernel);
        expect_taps(scene, s, {}, 0, kernel);
    }
}

TEST_F(LookupOptimisationsTest, TapsAreFetchedNearEdgesOnly) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = floor_settings("pcf");
    s.filter.size = 15;
    s.map.resolution = 1024;
    const std::vector<float> saved = taps(scene, s);
    const FloatImage lit = visibility(scene, s);
    int dark = 0, bright = 0, fetched = 0;
    for (std::size_t i = 0; i < saved.size(); ++i) {
        if (saved[i] > 0) ++fetched;
        if (saved[i] != 0) continue;
        dark += lit.data[i] == 0;
        bright += lit.data[i] == 1;
        EXPECT_TRUE(lit.data[i] == 0 || lit.data[i] == 1) << i;
    }
    EXPECT_GT(dark, 100);
    EXPECT_GT(bright, 1000);
    EXPECT_GT(fetched, 100) << "there are edges";
    EXPECT_LT(fetched, int(saved.size()) / 2);
}

TEST_F(LookupOptimisationsTest, ABlockerSearchWithoutPenumbraReadsOnce) {
    const Scene scene = bare_floor();
    Settings s = floor_settings("pcss");
    s.filter.blocker_taps = 24;
    s.lights[0].size = 0;
    expect_taps(scene, s, {Optimisation::EarlyOut}, 1, "size 0");
    expect_taps(scene, s, {Optimisation::EarlyOut, Optimisation::BlockerSearch}, 24, "size 0, forced");
    s.lights[0].size = 0.5;
    expect_taps(scene, s, {Optimisation::EarlyOut}, 24, "a light of size");
    set_setting(s, "filter.kernel", "smrt");
    s.lights[0].size = 0;
    s.bias.normal = 3;
    expect_taps(scene, s, {Optimisation::EarlyOut}, 1, "rays, size 0");
    expect_taps(scene, s, {Optimisation::EarlyOut, Optimisation::BlockerSearch},
                float(1 + s.filter.rays * s.filter.steps), "forced");
}

TEST_F(LookupOptimisationsTest, NothingIsFetchedForLightThatDoesNotArrive) {
    const Scene scene = bare_floor();
    Settings s = floor_settings("pcf3");
    const float all = float(kernel_cost(s).texels);
    s.lights[0].elevation = -30;  // from below
    expect_taps(scene, s, {}, 0, "turned away");
    s = floor_settings("pcf3");
    set_setting(s, "light.type", "point");
    set_setting(s, "light.distance", "2");
    set_setting(s, "light.range", "3");
    set_setting(s, "light.elevation", "40");
    for (const bool separate : {false, true}) {
        s.shading.separate_visibility = separate;
        const std::vector<float> saved = taps(scene, s), forced = taps(scene, s, {Optimisation::BackFacingReceivers});
        const auto sum = [](const std::vector<float>& v) {
            return std::accumulate(v.begin(), v.end(), 0.0, [](double a, float b) { return a + std::max(b, 0.f); });
        };
        EXPECT_GT(sum(forced), 1000 * all);
        EXPECT_GT(sum(saved), 100 * all) << "in range";
        if (separate)
            EXPECT_EQ(saved, forced) << "what is read by others is there";
        else
            EXPECT_LT(sum(saved), 0.8 * sum(forced));
        const Scene shadowed = test::floor_and_box(10, {1.5, 1, 2}, 0.1);
        expect_equal_bytes(shadowed, s, kLookups, separate ? "separate" : "fused");
    }
}

/// Returns the cases: each tests one way in which bounds could be wrong.
const std::vector<Sets>& ways() {
    static const std::vector<Sets> all = {
        {},
        {{"map.reversed_z", "true"}},
        {{"map.compare", "less"}, {"light.elevation", "90"}},
        {{"map.format", "d16"}, {"filter.method", "sampler"}},
        {{"map.format", "d24"}, {"filter.method", "sampler"}, {"map.reversed_z", "true"}},
        {{"map.format", "linear"}, {"light.type", "spot"}},
        {{"map.format", "linear16"}, {"light.type", "point"}, {"map.reversed_z", "true"}},
        {{"map.format", "colour"}, {"map.blur_texels", "2"}},
        {{"map.wrap", "repeat"}, {"light.fit", "manual"}, {"light.extent", "2"}},
        {{"map.wrap", "border"}, {"map.outside", "unlit"}, {"light.fit", "manual"}, {"light.extent", "2"}},
        {{"map.wrap", "clamp"}, {"light.fit", "manual"}, {"light.extent", "2"}},
        {{"map.wrap", "range"}, {"map.resolution", "250"}},
        {{"map.resolution", "13"}},
        {{"light.type", "point"}, {"bias.kind", "receiver-plane"}},
        {{"light.cascades", "3"}, {"light.cascade_blend", "0.3"}},
        {{"light.fit", "lispsm"}, {"bias.kind", "receiver-plane"}},
        {{"map.virtual", "true"}},
        {{"bias.kind", "constant"}, {"bias.constant", "0"}, {"bias.normal", "0"}},
        {{"bias.kind", "receiver-plane-derivatives"}, {"bias.normal", "1"}, {"map.reversed_z", "true"}},
        {{"light.count", "3"}, {"light.1.type", "spot"}, {"light.2.elevation", "20"}},
        {{"map.format", "linear"}, {"light.type", "spot"}, {"bias.kind", "receiver-plane"}},
        {{"map.format", "linear16"}, {"light.type", "point"}, {"bias.kind", "receiver-plane"}},
    };
    return all;
}

SI_TEST_IS(DriverIndependent, LookupOptimisationsTest, ForcedLookUpsGiveTheSameBytesForEveryMap);
SI_TEST_IS(Slow, LookupOptimisationsTest, ForcedLookUpsGiveTheSameBytesForEveryMap);
TEST_F(LookupOptimisationsTest, ForcedLookUpsGiveTheSameBytesForEveryMap) {
    static constexpr const char* kKernels[] = {"pcf", "gauss", "poisson", "vogel", "pcss", "dpcf", "smrt"};
    Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4), far = scene;
    request.width = 64;
    request.height = 48;
    test::move_scene(far, {115, -3, 40});
    for (std::size_t way = 0; way < ways().size(); ++way) {
        int bounded = 0;
        bool planes_over_distances = false;  // such maps have no bounds
        std::string told;
        for (std::size_t i = 0; i < 2; ++i) {
            const char* kernel = kKernels[(way + 3 * i) % std::size(kKernels)];
            Settings s = test::texel_settings("pcf", 256, 0.2);
            set_setting(s, "filter.kernel", kernel);
            s.filter.size = 15;
            s.bias.normal = 3;
            s.filter.point = way % 2 != 0;
            s.lights[0].size = way % 3 == 0 ? 0 : 0.1;
            s.filter.taps = s.filter.blocker_taps = 64;
            std::string what = kernel;
            for (const auto& [key, value] : ways()[way]) {
                set_setting(s, key, value);
                what += " " + key + "=" + value;
            }
            planes_over_distances |= holds_distances(s.map.format) && compares_per_texel(s);
            const bool away = way % 2 != 0;
            if (away) test::move_camera(s, {115, -3, 40});
            expect_equal_bytes(away ? far : scene, s, kLookups, what);
            request.outputs = {};
            request.forced = {};
            draw_maps(away ? far : scene, s, {});
            const FrameResult frame = renderer.render(away ? far : scene, s, request);
            told = frame.pass("map bounds")->reason;
            bounded += frame.pass("map bounds")->state != PassState::Skipped;
        }
        const bool paged = !ways()[way].empty() && ways()[way][0].first == "map.virtual";
        EXPECT_EQ(bounded > 0, !paged && !planes_over_distances) << way << ": " << told;
    }
}

/// A probe draws the maps, which then have no bounds yet.
TEST_F(LookupOptimisationsTest, AProbeOfNewMapsNeedsNoBounds) {
    const Scene scene = load_scene("stage");
    Settings s = settings_for(scene, {"filter.kernel=vogel", "filter.taps=64", "light.cascades=3"});
    s.map.resolution = 512;
    const Settings other = settings_with(s, {"map.resolution=128"});
    request = small_request({.colour = false, .visibility = true});
    const FloatImage lit = renderer.read_float(renderer.render(scene, s, request).visibility, 1);
    int bright_behind_the_first_cascade = 0;
    for (const int x : {80, 160, 240})
        for (int y = 20; y < request.height; y += 24) {
            draw_maps(scene, other, {});
            const Probe p = renderer.probe(scene, s, request, x, y);
            if (!p.hit) continue;
            // The rounding of a shifted viewport moves a few of the taps to the next texel.
            EXPECT_NEAR(p.lights.at(0).visibility, lit.at(x, y), 0.1) << x << ", " << y;
            bright_behind_the_first_cascade += p.lights[0].face > 0 && lit.at(x, y) > 0.5f;
        }
    EXPECT_GT(bright_behind_the_first_cascade, 2);
}

/// Bounds belong to cached maps: the test measures them while the camera moves.
TEST_F(LookupOptimisationsTest, TheGainOfBoundsIsMeasuredOverCachedMaps) {
    const Scene scene = load_scene("boxes");
    Settings s = settings_for(scene, {{"filter.kernel", "vogel"}, {"filter.taps", "64"}, {"map.resolution", "256"}});
    const FrameRequest tiny{.width = 64, .height = 36};
    CachedFrames frames(scene, s, tiny, Optimisation::EarlyOut);
    for (int i = 0; i < 3; ++i) {
        frames.draw({});
        frames.draw({Optimisation::EarlyOut});
    }
    const FrameResult with = frames.draw({});
    EXPECT_NE(with.pass("map bounds")->state, PassState::Skipped) << with.pass("map bounds")->reason;
    const ByteImage picture = renderer.read_colour(with.colour);
    const FrameResult without = frames.draw({Optimisation::EarlyOut});
    EXPECT_EQ(without.pass("map bounds")->state, PassState::Skipped);
    EXPECT_EQ(different_pixels(picture, renderer.read_colour(without.colour)), 0u) << "they are of one moment";
    const std::vector<Effect> effects = frame_effects(scene, s, renderer.render(scene, s, tiny));
    const Effect bounds = effect_named(effects, "map bounds");
    EXPECT_EQ(bounds.optimisation, Optimisation::EarlyOut) << bounds.reason;
    const SavedTimes times = measure_saved_times(renderer, scene, s, tiny, optimisations_of(effects), 4);
    ASSERT_TRUE(times.saved_ms(bounds));
    EXPECT_EQ(times.saved_ms(bounds)->samples, 4);
}

}  // namespace
}  // namespace si
