// Verdicts, least bias, fixes and times on maps that are given: with the engine's bias known, and unknown.
#include <filesystem>

#include "renderer/advise/least_bias.h"
#include "renderer/bundle/imported_maps.h"
#include "renderer/inspect/given_map_changes.h"
#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/measure/measured_error.h"
#include "renderer/measure/time_sampler.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class GivenMapVerdicts : public FrameTest {
protected:
    FrameRequest request{.width = 160, .height = 120, .map_size = MapSize(64, 256)};
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);

    /// Draws the map of a light and returns it as if an engine had given it.
    std::shared_ptr<const ImportedMaps> given(const Settings& s, bool bias_known) {
        FrameRequest maps = request;
        maps.outputs = {.shadow_map = true};
        const FrameResult frame = renderer.render(scene, s, maps);
        ImportedMaps out = *imported_maps({renderer.read_shadow_map(frame, 0, 0)},
                                          ImportedViews{frame.lights[0].views, frame.lights[0].chooser});
        out.bias_known = bias_known;
        return std::make_shared<const ImportedMaps>(std::move(out));
    }
    FrameRequest with(std::shared_ptr<const ImportedMaps> maps) const {
        FrameRequest out = request;
        out.map_size.reset();
        out.imported = {std::move(maps)};
        return out;
    }
    PixelDiagnosis diagnosis(const Settings& s, const FrameRequest& r, glm::ivec2 pixel) {
        const Probe probed = renderer.probe(scene, s, r, pixel.x, pixel.y);
        if (!probed.hit) return {};
        const ReferenceScene casters(std::make_shared<ReferenceGeometry>(scene, s));
        return diagnose_pixel(probed, probed.lights.at(0),
                              trace_fragment_reference(casters, probed, probed.lights[0], s, object_traits(scene, s)),
                              s, renderer.driver());
    }
    MeasuredError measure(const Settings& s, const FrameRequest& r) {
        ReferenceCache cache;
        return measure_error(renderer, scene, s, r, 0, {}, cache);
    }
};

SI_TEST_IS(Later, GivenMapVerdicts, AreThoseOfADrawnMapOnceTheBiasIsKnown);
TEST_F(GivenMapVerdicts, AreThoseOfADrawnMapOnceTheBiasIsKnown) {
    const Settings s = test::texel_settings("hard", 512, 0.1);
    const FrameRequest known = with(given(s, true)), unknown = with(given(s, false));
    int wrong = 0, right = 0, with_fix = 0;
    for (int y = 4; y < request.height; y += 13)
        for (int x = 3; x < request.width; x += 17) {
            const PixelDiagnosis own = diagnosis(s, request, {x, y}), same = diagnosis(s, known, {x, y}),
                                 asked = diagnosis(s, unknown, {x, y});
            if (own.verdict.empty()) continue;
            EXPECT_EQ(own.engine_bias, EngineBias::Own);
            EXPECT_EQ(same.engine_bias, EngineBias::File);
            EXPECT_EQ(asked.engine_bias, EngineBias::Unknown);
            EXPECT_EQ(own.right, same.right);
            EXPECT_EQ(own.least.depth, asked.least.depth);
            if (own.reference.state != PixelState::Counted) {
                EXPECT_EQ(own.verdict, same.verdict);
                EXPECT_EQ(own.verdict, asked.verdict);
                continue;
            }
            (own.right ? right : wrong) += 1;
            EXPECT_TRUE(same.verdict.starts_with(own.verdict)) << own.verdict << "\n" << same.verdict;
            // Without the engine's bias, the sentence begins with what the map itself tells.
            EXPECT_TRUE(asked.verdict.starts_with("the engine's bias is unknown, and its map needs ")) << asked.verdict;
            EXPECT_NE(asked.verdict.find("under bias.* of these settings: " + own.verdict), std::string::npos);
            if (!own.fix) continue;
            bool redrawn = false;
            for (const auto& [key, value] : own.fix->settings) redrawn |= acts_while_drawing(key);
            EXPECT_EQ(same.fix.has_value(), !redrawn);
            EXPECT_EQ(same.verdict.find(kNeedsAnotherMap) != std::string::npos, redrawn) << same.verdict;
            with_fix += !redrawn;
        }
    const auto notes = [&](const FrameRequest& r) { return renderer.render(scene, s, r).notes; };
    const auto asks = [](const std::string& note) { return note.find("is unknown") != std::string::npos; };
    EXPECT_TRUE(std::ranges::none_of(notes(known), asks));
    EXPECT_TRUE(std::ranges::any_of(notes(unknown), asks));
    EXPECT_GT(wrong, 5);
    EXPECT_GT(right, 5);
    EXPECT_GT(with_fix, 3);
}

// The fix of a pixel holds for maps of 1:4 and 4:1, whose texels are no squares. It is no larger than it has to be.
TEST_F(GivenMapVerdicts, FixesOfAnOblongMapPutThePixelRight) {
    const Settings s = test::texel_settings("hard", 512, 0.1);
    for (const MapSize size : {MapSize(64, 256), MapSize(256, 64)}) {
        request.map_size = size;
        const FrameRequest known = with(given(s, true));
        int fixed = 0;
        for (int y = 4; y < request.height && fixed < 6; y += 13)
            for (int x = 3; x < request.width && fixed < 6; x += 17) {
                const PixelDiagnosis d = diagnosis(s, known, {x, y});
                if (d.right || !d.fix || d.reference.cause.artefact != Artefact::Acne) continue;
                Settings changed = s;
                for (const auto& [key, value] : d.fix->settings) set_setting(changed, key, value);
                const PixelDiagnosis with_fix = diagnosis(changed, known, {x, y});
                EXPECT_TRUE(with_fix.right) << x << "," << y << ": " << d.fix->text;
                EXPECT_GE(with_fix.has.depth, with_fix.least.depth);
                EXPECT_LE(with_fix.has.depth, 1.02 * with_fix.least.depth) << d.fix->text;
                ++fixed;
            }
        EXPECT_GT(fixed, 3);
    }
}

SI_TEST_IS(Later, GivenMapVerdicts, TheLeastBiasOfTheMapEndsAcneOnIt);
TEST_F(GivenMapVerdicts, TheLeastBiasOfTheMapEndsAcneOnIt) {
    Settings s = test::texel_settings("pcf3", 512, 0);
    const FrameRequest known = with(given(s, true));
    const MeasuredError before = measure(s, known);
    EXPECT_GT(before.metrics.artefacts[std::size_t(Artefact::Acne)], 1000u);
    const auto offsets = [](const BiasStart& start) {
        return start.least.raster_slope != 0 || start.least.raster_units != 0;
    };
    const auto starts = bias_starts(before, s, renderer.driver());
    EXPECT_TRUE(std::ranges::none_of(starts, offsets)) << "the given map cannot be drawn with polygon offset";
    EXPECT_TRUE(std::ranges::any_of(bias_starts(measure(s, request), s, renderer.driver()), offsets));
    int tried = 0;
    for (const BiasStart& start : starts) {
        if (start.row->gives_needed_bias) continue;
        Settings with_bias = s;
        with_bias.bias = start.least;
        const ErrorMetrics after = measure(with_bias, known).metrics;
        EXPECT_LE(double(after.artefacts[std::size_t(Artefact::Acne)]), 0.002 * double(after.counted))
            << start.row->key << ": " << bias_text(start.least);
        ++tried;
    }
    EXPECT_GE(tried, 3);
}

// Settings of drawing leave the visibility of a given map as it is; settings of the look-up do not.
TEST_F(GivenMapVerdicts, SettingsOfDrawingChangeNoGivenMap) {
    const Settings s = test::texel_settings("pcf3", 512, 0.3);
    const FrameRequest known = with(given(s, true));
    const FloatImage plain = visibility(scene, s, known);
    const auto differ = [&](const char* key, const char* value) {
        return differing_floats(plain.data, visibility(scene, settings_with(s, {{key, value}}), known).data);
    };
    for (const auto& [key, value] : {std::pair{"map.resolution", "64"},
                                     {"map.samples", "4"},
                                     {"map.origin", "near"},
                                     {"map.virtual", "true"},
                                     {"caster.cull", "front"},
                                     {"object.box.cull", "front"},
                                     {"object.box.cast", "false"},
                                     {"bias.raster_slope", "3"},
                                     {"bias.raster_units", "500"},
                                     {"light.0.fit", "view"},
                                     {"light.0.near_far", "casters"},
                                     {"light.0.extent", "3"},
                                     {"light.0.cascades", "3"},
                                     {"light.0.snap", "false"}}) {
        EXPECT_TRUE(acts_while_drawing(key)) << key;
        EXPECT_EQ(differ(key, value), 0u) << key;
    }
    for (const auto& [key, value] : {std::pair{"bias.constant", "0.9"},
                                     {"bias.normal", "3"},
                                     {"filter.kernel", "hard"},
                                     {"map.blur_texels", "2"}}) {
        EXPECT_FALSE(acts_while_drawing(key)) << key;
        EXPECT_GT(differ(key, value), 0u) << key;
    }
}

TEST_F(GivenMapVerdicts, NoTimeOfDrawingIsCounted) {
    const Settings s = test::texel_settings("pcf3", 512, 0.3);
    FrameRequest known = with(given(s, true)), own = request;
    known.timing = known.force = own.timing = own.force = true;
    const FrameResult theirs = renderer.render(scene, s, known), ours = renderer.render(scene, s, own);
    EXPECT_EQ(drawn_ms(theirs, PassCategory::Maps), 0);
    EXPECT_GT(drawn_ms(ours, PassCategory::Maps), 0);
    double all = 0;
    for (const PassInfo& pass : theirs.passes)
        if (pass.state == PassState::Drawn && pass.makes != Result::DrawnMaps) all += pass.gpu_ms;
    EXPECT_DOUBLE_EQ(drawn_ms(theirs), all);
    TimeSamples samples;
    samples.add(theirs);
    for (const TimeSamples::Pass& pass : samples.passes) EXPECT_FALSE(pass.name.starts_with("shadow map")) << pass.name;
}

}  // namespace
}  // namespace si
