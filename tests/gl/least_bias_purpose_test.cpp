// Tests what the search for the least bias is for: no row of the bias table at any strength of an independent grid has
// a clearly smaller score, from several cameras, on all built-in scenes and on models.
#include <cmath>

#include "renderer/advise/least_bias.h"
#include "renderer/measure/axes.h"
#include "renderer/settings/biases.h"
#include "renderer/view/cameras/make_camera.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/missing_reason.h"
#include "tests/support/shared_models.h"
#include "tests/support/traits.h"

namespace si {
namespace {

constexpr int kWidth = 160, kHeight = 90;

/// Lists every row of the bias table at 40 strengths, without the search's own starts.
std::vector<BiasSettings> grid(const Settings& base) {
    std::vector<BiasSettings> out;
    const auto add = [&](const Sets& sets) {
        Sets all = {"bias.normal=0",       "bias.constant=0",     "bias.slope=0",
                    "bias.raster_slope=0", "bias.raster_units=0", "bias.unit=texels"};
        all.insert(all.end(), sets.begin(), sets.end());
        out.push_back(settings_with(base, all).bias);
    };
    for (const Choice& kind : bias_choices()) add({"bias.kind=" + std::string(kind.key)});
    for (int i = 0; i < 40; ++i) {
        const double strength = 0.02 * std::pow(5000.0, i / 39.0);
        const std::string text = std::to_string(strength), below_100 = std::to_string(std::min(strength, 99.0));
        add({"bias.kind=constant", "bias.constant=" + text});
        add({"bias.kind=slope", "bias.slope=" + text});
        add({"bias.kind=constant", "bias.normal=" + below_100});
        add({"bias.kind=constant", "bias.raster_slope=" + below_100});
        for (const char* plane : {"receiver-plane", "receiver-plane-derivatives", "receiver-plane-remainder"})
            add({"bias.kind=" + std::string(plane), "bias.constant=" + text});
    }
    return out;
}

class LeastBiasPurpose : public FrameTest {
protected:
    /// Compares the search with the grid from four cameras around the scene. @return number of trials of the grid
    std::size_t expect_least(const Scene& scene) {
        std::size_t trials = 0;
        for (const double turn : {0.0, 80.0, 170.0, 260.0}) {
            Settings base = measured_settings(settings_for(scene, {"bias.kind=constant", "bias.constant=0.1"}));
            if (turn != 0) {
                base.camera = manual_camera(scene, base, double(kWidth) / kHeight);
                base.camera.azimuth = std::remainder(base.camera.azimuth + turn, 360.0);
            }
            SCOPED_TRACE(testing::Message() << "camera turned by " << turn << " degrees");
            ReferenceCache cache;
            const auto measure = [&](const BiasSettings& bias) {
                Settings s = base;
                s.bias = bias;
                return measure_error(renderer, scene, s, {.width = kWidth, .height = kHeight}, 0, {}, cache);
            };
            const MeasuredError first = measure(base.bias);
            if (!has_lit_receivers(first)) continue;
            const BiasScore score(first, base);
            const FoundBias found = find_least_bias({renderer, scene, kWidth, kHeight, cache}, base);
            const TriedBias* const best = found.best();
            if (!best) {
                ADD_FAILURE() << "no bias was found";
                continue;
            }
            const MeasuredError result = measure(best->bias);
            EXPECT_LE(wrong_pixels(result.metrics), wrong_pixels(first.metrics));
            double least = std::numeric_limits<double>::infinity();
            BiasSettings least_bias;
            for (const BiasSettings& bias : grid(base)) {
                ++trials;
                const MeasuredError m = measure(bias);
                if (wrong_pixels(m.metrics) > wrong_pixels(first.metrics) || score.compute_score(m) >= least) continue;
                least = score.compute_score(m);
                least_bias = bias;
            }
            // Steps of the score are whole pixels, and a score of few pixels has several minima.
            EXPECT_LE(score.compute_score(result), 1.02 * least + 2)
                << best->row->key << " " << bias_text(best->bias) << " against " << bias_text(least_bias);
        }
        return trials;
    }
};

SI_TESTS_ARE(DriverIndependent, LeastBiasPurpose);
SI_TESTS_ARE(Minutes, LeastBiasPurpose);

TEST_F(LeastBiasPurpose, BuiltInScenesHaveNoBetterRow) {
    std::size_t trials = 0;
    for (const BuiltinScene& row : builtin_scenes()) {
        SCOPED_TRACE(row.key);
        trials += expect_least(load_scene(row.key));
        std::printf("%s: %zu trials so far\n", std::string(row.key).c_str(), trials);
        std::fflush(stdout);
    }
    EXPECT_GT(trials, 5 * 4 * 7 * 40u);
}

TEST_F(LeastBiasPurpose, ModelsHaveNoBetterRow) {
    constexpr std::string_view kModels[] = {"kaykit_graveyard", "kenney_city",     "godot_living_room",
                                            "khr_Fox",          "khr_Suzanne",     "godot_tree",
                                            "khr_ToyCar",       "khr_BoxAnimated", "khr_NegativeScaleTest",
                                            "khr_SheenChair",   "webxr_sunflower", "vksamples_terrain"};
    std::size_t models = 0;
    for (const test::SharedModel& model : test::shared_models()) {
        const std::string path = model.file.string();
        if (std::ranges::none_of(kModels, [&](auto name) { return path.find(name) != std::string::npos; })) continue;
        SCOPED_TRACE(path);
        expect_least(load_scene(path));
        std::printf("%s\n", path.c_str());
        std::fflush(stdout);
        ++models;
    }
    if (models == 0) GTEST_SKIP() << test::kMissingReason << "../shared/models";
    EXPECT_GE(models, 12u);
}

}  // namespace
}  // namespace si
