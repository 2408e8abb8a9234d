// Tests the table of fixes: each row has the measured effect that it reports, and the first row fixes the scene's main
// fault.
#include "renderer/advise/fixes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "renderer/scenes/shapes.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/fits.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class FixesTest : public FrameTest {
protected:
    ReferenceCache cache;
    int width = 320, height = 240;

    SearchTools tools(const Scene& scene) { return {renderer, scene, width, height, cache}; }
    MeasuredError measure(const Scene& scene, const Settings& s) {
        return measure_error(renderer, scene, s, {.width = width, .height = height}, 0, {}, cache);
    }
    static Settings with(Settings s, const Trial& t) {
        for (const auto& [key, value] : t.changes) set_setting(s, key, value);
        return s;
    }

    /// Finds fixes and expects each row to have the effect that it reports. Expects the first to be a fix that puts
    /// eight of ten pixels with one of the causes right and makes nothing worse. @returns the fixes
    FixTable expect_fixes(const Scene& scene, const Settings& s, std::vector<Artefact> causes, std::size_t least) {
        const FixTable table = find_fixes(tools(scene), s, {});
        const MeasuredError before = measure(scene, s);
        int checked = 0;
        for (const Trial& row : table.rows) {
            // A measurement of each row would take as long as the search.
            if (!row.is_drawn() || (!row.why_not.empty() && ++checked % 9 != 0)) continue;
            SCOPED_TRACE(row.candidate.name);
            EXPECT_FALSE(row.changes.empty());
            const MeasuredError after = measure(scene, with(s, row));
            std::size_t cured = 0, broken = 0, of = 0;
            for (std::size_t i = 0; i < before.classified.size(); ++i) {
                const bool was = before.classified[i].artefact != Artefact::None,
                           is = after.classified[i].artefact != Artefact::None;
                cured += was && !is;
                broken += !was && is;
            }
            for (const std::size_t n : row.cured_of) of += n;
            EXPECT_EQ(row.cured, cured) << "exactly as predicted";
            EXPECT_EQ(row.broken, broken);
            EXPECT_EQ(row.cured, of);
            EXPECT_EQ(row.metrics.mae, after.metrics.mae);
            EXPECT_EQ(wrong_pixels(row.metrics), wrong_pixels(after.metrics));
            if (row.why_not.empty()) expect_nothing_worse(before.metrics, after.metrics);
        }
        const Trial* const fix = table.fix();
        std::size_t wrong = 0, right = 0;
        for (const Artefact a : causes) wrong += table.wrong_of[std::size_t(a)];
        EXPECT_GE(wrong, least);
        EXPECT_TRUE(fix);
        if (!fix) return table;
        for (const Artefact a : causes) right += fix->cured_of[std::size_t(a)];
        EXPECT_GE(double(right), 0.8 * double(wrong)) << fix->candidate.name;
        for (const Trial& t : table.rows)
            if (t.is_drawn() && t.why_not.empty()) {
                EXPECT_GE(t.metrics.mae, fix->metrics.mae) << "the fix leaves the least error";
            }
        return table;
    }
    static void expect_nothing_worse(const ErrorMetrics& before, const ErrorMetrics& after) {
        EXPECT_LE(wrong_pixels(after), wrong_pixels(before));
        EXPECT_LE(after.mae, before.mae);
        EXPECT_LE(after.any_acne, before.any_acne);
        EXPECT_LE(after.any_leak, before.any_leak);
    }
    static const Trial* row(const FixTable& table, std::string_view name) {
        for (const Trial& t : table.rows)
            if (t.candidate.name == name) return &t;
        return nullptr;
    }
};

SI_TESTS_ARE(DriverIndependent, FixesTest);
SI_TESTS_ARE(Repeated, FixesTest);
SI_TEST_IS(Slow, FixesTest, TheLeastBiasRemovesPeterPanning);
TEST_F(FixesTest, TheLeastBiasRemovesPeterPanning) {
    const Scene scene = test::wall_on_plane();
    const Settings s = test::low_sun_settings("pcf3", 512, 11);
    const FixTable table = expect_fixes(scene, s, {Artefact::PeterPanning}, 100);
    const Trial* least = row(table, "least bias, constant");
    ASSERT_TRUE(least);
    EXPECT_GT(least->cured_of[std::size_t(Artefact::PeterPanning)],
              0.9 * double(table.wrong_of[std::size_t(Artefact::PeterPanning)]));
}

SI_TEST_IS(Slow, FixesTest, ASmallerNormalOffsetRemovesItsStrip);
TEST_F(FixesTest, CausesAreFoundOnlyOfChangesThatMayBeFixes) {
    const Scene scene = test::wall_on_plane();
    const Settings s = test::low_sun_settings("pcf3", 512, 11);
    const auto with_constant = [&](double texels) {
        Candidate c{.name = fmt::format("{:g}", texels), .settings = s};
        c.settings.bias.constant = texels;
        return c;
    };
    Candidate finer{.name = "finer", .settings = with_constant(9).settings};
    finer.settings.map.resolution = 1024;
    const std::vector<Candidate> list{finer, with_constant(40), with_constant(9)};
    TrialMeter meter = renderer_trial_meter(tools(scene), {.work = false});
    meter.time = [](const Settings&, const Settings&) { return CostChange{}; };
    meter.time_to_limit = nullptr;
    const MeasuredSettings before = meter.measure(s, 0);
    const FixTable table = search_fixes(s, before, list, meter, {});
    const Trial *const more = row(table, "40"), *const less = row(table, "9"), *const large = row(table, "finer");
    ASSERT_TRUE(more && less && large);
    EXPECT_EQ(large->why_not.rfind("maps take more than twice the bytes", 0), 0u) << large->why_not;
    EXPECT_LT(large->metrics.mae, before.frame->metrics.mae);
    EXPECT_TRUE(std::isnan(large->metrics.any_acne));
    EXPECT_EQ(more->why_not.rfind("wrong pixels rise", 0), 0u) << more->why_not;
    EXPECT_EQ(more->metrics.without_cause, wrong_pixels(more->metrics));
    EXPECT_TRUE(std::isnan(more->metrics.any_acne) && std::isnan(more->metrics.any_leak));
    EXPECT_EQ(less->why_not, "");
    EXPECT_EQ(less->metrics.without_cause, 0u);
    EXPECT_FALSE(std::isnan(less->metrics.any_acne) || std::isnan(less->metrics.any_leak));
    meter.measure_in_steps = nullptr;
    const FixTable all = search_fixes(s, before, list, meter, {});
    ASSERT_EQ(all.rows.size(), table.rows.size());
    for (std::size_t i = 0; i < all.rows.size(); ++i) {
        const Trial &a = all.rows[i], &b = table.rows[i];
        EXPECT_EQ(a.candidate.name, b.candidate.name);
        EXPECT_EQ(a.why_not, b.why_not);
        EXPECT_EQ(std::tuple(a.cured, a.broken, a.cured_of), std::tuple(b.cured, b.broken, b.cured_of));
        EXPECT_EQ(wrong_pixels(a.metrics), wrong_pixels(b.metrics));
        EXPECT_EQ(a.metrics.mae, b.metrics.mae);
        EXPECT_FALSE(std::isnan(a.metrics.any_acne));
    }
}

TEST_F(FixesTest, ASmallerNormalOffsetRemovesItsStrip) {
    Settings s = test::texel_settings("pcf3", 2048, 2);
    s.bias.normal = 60;
    expect_fixes(test::floor_and_box(10, {1.5, 1, 2}, 0.2), s, {Artefact::PeterPanningOffset, Artefact::OffsetShadow},
                 300);
}

SI_TEST_IS(Slow, FixesTest, FixesWorkOnTheStageWithTooMuchBiasAndFrontCulling);
TEST_F(FixesTest, FixesWorkOnTheStageWithTooMuchBiasAndFrontCulling) {
    const Scene stage = load_scene("stage");
    width = 320;
    height = 180;
    // Under this light few pixels are wrong, for two causes at once.
    const Settings lit = settings_for(stage, {"light.fit=scene", "light.azimuth=72", "light.elevation=36"});
    const auto under = [&](const Sets& sets) { return settings_with(lit, sets); };
    expect_fixes(stage, under({"bias.kind=constant", "bias.constant=40"}), {Artefact::PeterPanning}, 120);
    expect_fixes(stage, under({"caster.cull=front"}), {Artefact::LostCaster}, 120);
}

SI_TEST_IS(Slow, FixesTest, TheNeededResolutionRestoresAFence);
TEST_F(FixesTest, TheNeededResolutionRestoresAFence) {
    const Scene scene = test::fence(16, 0.05, 0.4);
    Settings s = test::texel_settings("hard", 128, 3);
    s.camera.distance = 7;
    width = 480;
    height = 360;
    expect_fixes(scene, s, {Artefact::Undersampled}, 300);
}

SI_TEST_IS(Slow, FixesTest, APixelsFixesAndUntriedFixesAreListed);
TEST_F(FixesTest, APixelsFixesAndUntriedFixesAreListed) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = test::texel_settings("hard", 512, 0);
    const MeasuredError m = measure(scene, s);
    glm::ivec2 pixel(-1);
    for (int i = 0; i < width * height && pixel.x < 0; ++i)
        if (m.classified[std::size_t(i + width * height / 2)].artefact == Artefact::Acne)
            pixel = {(i + width * height / 2) % width, (i + width * height / 2) / width};
    ASSERT_GE(pixel.x, 0);
    s.lights[0].type = LightType::Directional;
    const FixTable table = find_fixes(tools(scene), s, {.pixel = pixel});
    ASSERT_TRUE(table.fix());
    EXPECT_TRUE(table.fix()->ms) << "its price is known";
    const std::size_t at = std::size_t(pixel.y * width + pixel.x);
    bool stays = false;
    int checked = 0;
    for (const Trial& t : table.rows) {
        if (!t.is_drawn()) continue;
        stays |= !t.pixel->right;
        if (++checked % 7 != 1) continue;
        const MeasuredError after = measure(scene, with(s, t));
        EXPECT_EQ(t.pixel->right, after.classified[at].artefact == Artefact::None) << t.candidate.name;
        EXPECT_EQ(t.pixel->visibility, after.classified[at].visibility);
    }
    EXPECT_TRUE(stays) << "not everything helps";
    const FixTable first = find_fixes(tools(scene), s, {.pixel = pixel, .first = true, .list = FixList::Whole});
    ASSERT_TRUE(first.fix());
    EXPECT_EQ(first.drawn(), table.drawn()) << "the short list has a fix";
    EXPECT_GT(first.candidates, table.candidates);
    std::stop_source stop;
    int steps = 0;
    SearchTools stopping = tools(scene);
    stopping.workers.stop = stop.get_token();
    stopping.report = [&](double, const std::string&) {
        if (++steps == 5) stop.request_stop();
    };
    const FixTable stopped = find_fixes(stopping, s, {.pixel = pixel});
    EXPECT_TRUE(stopped.stopped);
    EXPECT_EQ(stopped.drawn(), 3u) << "what is there stays";
    s.lights[0].type = LightType::Point;
    const FixTable point = find_fixes(tools(scene), s, {});
    const Trial* fit = row(point, "tighter fit");
    ASSERT_TRUE(fit);
    EXPECT_FALSE(fit->is_drawn());
    const auto undrawn = std::ranges::find_if_not(point.rows, &Trial::is_drawn);
    EXPECT_TRUE(std::none_of(undrawn, point.rows.end(), [](const Trial& t) { return t.is_drawn(); }))
        << "what was not tried stands last";
}

// The candidates are all rows of the tables of fits and biases that suit the light, and cascades.
SI_TEST_IS(Later, FixesTest, EveryOtherFitBiasAndCascadeCountIsTried);
TEST_F(FixesTest, EveryOtherFitBiasAndCascadeCountIsTried) {
    width = 160;
    height = 120;
    const Scene scene = test::floor_and_box(12, {1.5, 1, 2}, 0.4);
    struct Kind {
        LightType type;
        LightFit fit;
        LightProjection projection;
        bool narrows, cascades;
    };
    const Kind kinds[] = {{LightType::Directional, LightFit::Scene, LightProjection::Automatic, true, true},
                          {LightType::Directional, LightFit::View, LightProjection::Automatic, true, true},
                          {LightType::Directional, LightFit::Manual, LightProjection::Automatic, true, false},
                          {LightType::Directional, LightFit::Scene, LightProjection::Perspective, false, false},
                          {LightType::Spot, LightFit::Casters, LightProjection::Automatic, true, false},
                          {LightType::Point, LightFit::Scene, LightProjection::Automatic, false, false}};
    for (const Kind& kind : kinds) {
        SCOPED_TRACE(testing::Message() << int(kind.type) << " " << int(kind.fit) << " " << int(kind.projection));
        Settings s = test::texel_settings("pcf3", 256, 0);
        s.lights[0].type = kind.type;
        s.lights[0].fit = kind.fit;
        s.lights[0].projection = kind.projection;
        const MeasuredError m = measure(scene, s);
        const std::vector<Candidate> ideas = fix_candidates(s, fix_facts(m, s, renderer.driver()), FixList::Short);
        const auto tried = [&](auto&& like) {
            return std::ranges::count_if(ideas,
                                         [&](const Candidate& i) { return i.untried.empty() && like(i.settings); });
        };
        for (std::size_t i = 0; i < fits().size(); ++i) {
            const auto fit = LightFit(i);
            const bool other = fit != kind.fit && fit != LightFit::Manual;
            const bool suits = kind.narrows || (kind.fit == LightFit::Manual && !fits()[i].narrows);
            const auto count =
                tried([&](const Settings& t) { return t.lights[0].fit == fit && t.lights[0].fit != s.lights[0].fit; });
            EXPECT_EQ(count > 0, other && suits) << fits()[i].key;
        }
        for (int n = 2; n <= kMaxCascades; n *= 2)
            EXPECT_EQ(tried([&](const Settings& t) { return t.lights[0].cascades == n; }) > 0, kind.cascades);
        for (const Choice& bias : bias_choices())
            if (bias.key != "constant") {  // the slope row gains as much by its constant
                EXPECT_GT(tried([&](const Settings& t) { return bias_of(t).key == bias.key && !(t.bias == s.bias); }),
                          0)
                    << bias.key;
            }
        EXPECT_GT(tried([&](const Settings& t) { return t.bias.normal > 0; }), 0);
        EXPECT_GT(tried([&](const Settings& t) { return t.bias.raster_slope > 0; }), 0);
    }
    Settings s = test::texel_settings("pcf3", 256, 0);
    s.lights[0].cascades = 3;
    const std::vector<Candidate> ideas =
        fix_candidates(s, fix_facts(measure(scene, s), s, renderer.driver()), FixList::Short);
    const auto of = [&](int n) {
        return std::ranges::count_if(ideas, [&](const Candidate& i) { return i.settings.lights[0].cascades == n; });
    };
    EXPECT_GT(of(2), 0);
    EXPECT_GT(of(4), 0);
    EXPECT_EQ(std::ranges::count_if(ideas, [](const Candidate& i) { return i.name.starts_with("fit: "); }), 0)
        << "cascades are fitted by what they are";
}

// The least bias of each row of the table clears flat ground entirely.
SI_TEST_IS(Slow, FixesTest, TheLeastBiasOfEachRowLeavesNoAcne);
TEST_F(FixesTest, TheLeastBiasOfEachRowLeavesNoAcne) {
    width = 240;
    height = 180;
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.6);
    int numbers = 0;
    for (const char* kernel : {"pcf3", "pcf7"})
        for (const LightType type : {LightType::Directional, LightType::Spot}) {
            Settings s = test::texel_settings(kernel, 512, 0);
            s.lights[0].type = type;
            s.lights[0].elevation = 35;
            const MeasuredError before = measure(scene, s);
            ASSERT_GT(before.metrics.artefacts[std::size_t(Artefact::Acne)], 1000u);
            for (const Bias& bias : biases()) {
                SCOPED_TRACE(std::string(bias.key) + " " + kernel);
                const auto least = least_bias_of_row(bias, before, s, renderer.driver());
                ASSERT_TRUE(least);
                Settings with = s;
                with.bias = *least;
                const ErrorMetrics after = measure(scene, with).metrics;
                EXPECT_EQ(after.artefacts[std::size_t(Artefact::Acne)], 0u);
                EXPECT_LT(after.any_acne, 1e-3) << "but where the kernel reaches over the box's edges";
                if (bias.gives_needed_bias) {
                    EXPECT_EQ(least->constant + least->slope + least->normal, 0) << "it needs no numbers";
                }
                Settings less = with;
                for (const std::string_view key : bias.settings)
                    if (key == "bias.raster_slope") {
                        less.bias.raster_slope *= 0.5;
                        ++numbers;
                    }
                if (!(less == with)) {
                    EXPECT_GT(measure(scene, less).metrics.any_acne, 0.01) << "twice too much";
                }
            }
        }
    EXPECT_EQ(numbers, 4);
}

SI_TEST_IS(Slow, FixesTest, CascadesRestoreShadowsTooFineForOneMap);
TEST_F(FixesTest, CascadesRestoreShadowsTooFineForOneMap) {
    width = 320;
    height = 180;
    const Scene scene = load_scene("landscape");
    const Settings s = settings_for(scene, {"light.cascades=1", "map.resolution=512", "light.fit=scene"});
    const FixTable table = find_fixes(tools(scene), s, {});
    const Trial* four = row(table, "4 cascades");
    ASSERT_TRUE(four);
    EXPECT_GT(four->gain(), 0.3 * double(table.wrong));
    EXPECT_EQ(four->map_bytes(), 3 * 512 * 512 * 4);
    const MeasuredError after = measure(scene, with(s, *four));
    EXPECT_EQ(after.lights[0].views.size(), 4u);
    std::size_t left = 0;
    for (std::size_t a = 1; a < kArtefacts; ++a) left += after.metrics.artefacts[a];
    EXPECT_EQ(left, table.wrong - four->cured + four->broken);
}

SI_TEST_IS(Slow, FixesTest, ATighterFitKeepsVisibleShadowsAndReportsItsTexels);
TEST_F(FixesTest, ATighterFitKeepsVisibleShadowsAndReportsItsTexels) {
    const Scene scene = test::floor_and_box(40, {1.5, 1, 2}, 0);
    Settings s = settings_with(test::texel_settings("hard", 256, 3), {"camera.distance=4", "light.fit=scene"});
    const FixTable table = find_fixes(tools(scene), s, {});
    const Trial* fit = row(table, "fit: view frustum");
    ASSERT_TRUE(fit);
    EXPECT_GT(fit->gain(), 0);
    EXPECT_EQ(fit->map_bytes(), 0);
    const MeasuredError after = measure(scene, with(s, *fit));
    EXPECT_EQ(after.metrics.outside_map, 0);
    EXPECT_LT(after.lights[0].views[0].half_extent(), 0.5 * measure(scene, s).lights[0].views[0].half_extent());
}

}  // namespace
}  // namespace si
