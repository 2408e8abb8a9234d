// Tests the diagnosis of a probed pixel: taps that add up to the GPU's visibility, a reference that agrees with
// `measure`, verdicts, and working fixes.
#include <bit>
#include <cstring>
#include <tuple>

#include "renderer/inspect/moment_bound.h"
#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/measure/measured_error.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/filters.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/mesh_scene.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si {
namespace {

const FrameRequest kPicture{.width = 160, .height = 120};

class DiagnosisTest : public FrameTest {
protected:
    Probe probed;

    PixelDiagnosis diagnosis(const Scene& scene, const Settings& s, glm::ivec2 pixel) {
        probed = renderer.probe(scene, s, kPicture, pixel.x, pixel.y);
        EXPECT_TRUE(probed.hit);
        const ReferenceScene casters(std::make_shared<ReferenceGeometry>(scene, s));
        return diagnose_pixel(probed, probed.lights.at(0),
                              trace_fragment_reference(casters, probed, probed.lights[0], s, object_traits(scene, s)),
                              s, renderer.driver());
    }
    MeasuredError measure(const Scene& scene, const Settings& s) {
        ReferenceCache cache;
        return measure_error(renderer, scene, s, kPicture, 0, {}, cache);
    }
    /// Returns the first pixel with a class of `measure`, searched from the middle of the picture outwards.
    std::optional<glm::ivec2> find(const MeasuredError& m, Artefact wanted) {
        std::optional<glm::ivec2> best;
        int least = 1 << 30;
        for (int y = 0; y < kPicture.height; ++y)
            for (int x = 0; x < kPicture.width; ++x) {
                if (m.classified[std::size_t(y * kPicture.width + x)].artefact != wanted) continue;
                const glm::ivec2 off = glm::ivec2(x, y) - glm::ivec2(80, 60);
                const int distance = off.x * off.x + off.y * off.y;
                if (distance < least) {
                    least = distance;
                    best = glm::ivec2(x, y);
                }
            }
        return best;
    }
    static Settings plain(const char* kernel, double constant_texels) {
        return test::texel_settings(kernel, 512, constant_texels);
    }
    static void apply(Settings& s, const SuggestedFix& fix) {
        for (const auto& [key, value] : fix.settings) set_setting(s, key, value);
    }
};

/// A probe answers by each light's own map, source and sides, for any shown light and for light numbers out of range.
TEST_F(DiagnosisTest, AnswersConcernTheChosenLight) {
    const Scene scene = load_scene("boxes");
    Settings s = settings_for(scene, {"map.resolution=128", "light.count=2", "light.0.source=none",
                                      "light.1.azimuth=120", "light.1.contact=0.1"});
    const auto bits_of = [&](int shown) {
        s.view.light = shown;
        std::vector<std::array<glm::vec4, kEvidenceImages>> bits;
        for (const glm::ivec2 pixel : {glm::ivec2(80, 90), glm::ivec2(60, 70), glm::ivec2(100, 80)}) {
            const Probe probe = renderer.probe(scene, s, kPicture, pixel.x, pixel.y);
            EXPECT_TRUE(probe.hit);
            for (const auto& light : probe.lights)
                bits.push_back(std::bit_cast<std::array<glm::vec4, kEvidenceImages>>(light.evidence));
        }
        return bits;
    };
    const auto own = bits_of(1);
    ASSERT_EQ(own.size(), 6u);
    for (const int shown : {0, 5, kMaxLights - 1}) {
        const auto other = bits_of(shown);
        ASSERT_EQ(other.size(), own.size());
        for (std::size_t i = 1; i < own.size(); i += 2)
            EXPECT_EQ(std::memcmp(&other[i], &own[i], sizeof own[i]), 0)
                << "light 1 while light " << shown << " is shown";
    }
}

SI_TEST_IS(Repeated, DiagnosisTest, TapsAddUpToTheVisibilityOnTheGpu);
SI_TEST_IS(Slow, DiagnosisTest, TapsAddUpToTheVisibilityOnTheGpu);
TEST_F(DiagnosisTest, TapsAddUpToTheVisibilityOnTheGpu) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    constexpr std::pair<const char*, const char*> kUnder[] = {{"d16", "receiver-plane"},
                                                              {"d32f", "slope"},
                                                              {"colour", "constant"},
                                                              {"linear16", "constant"},
                                                              {"d32f", "receiver-plane"}};
    int checked = 0, partial = 0, off = 0;
    std::size_t next = 0;  // alternates between kernels
    for (const Filter& filter : filters())
        for (int turn = 0; turn < 2; ++turn) {
            if (!filter.linear) continue;
            const auto [format, kind] = kUnder[next++ % std::size(kUnder)];
            Settings s = plain(std::string(filter.key).c_str(), 0.7);
            set_setting(s, "map.format", format);
            set_setting(s, "bias.kind", kind);
            set_all(s, {"map.resolution=128", "bias.normal=0.5"});
            for (int y = 20; y < 110; y += 17)
                for (int x = 13; x < 150; x += 23) {
                    const Probe p = renderer.probe(scene, s, kPicture, x, y);
                    if (!p.hit || p.lights[0].account.receiver.n_dot_l <= 0) continue;
                    double sum = p.lights[0].taps.empty() && filter.searches_blockers ? 1 : 0;
                    for (const KernelTap& t : p.lights[0].taps) sum += t.weight * t.lit;
                    ++checked;
                    partial += sum > 0 && sum < 1;
                    off += std::abs(sum - p.lights[0].visibility) > 1e-3;
                }
        }
    EXPECT_GT(checked, 500);
    EXPECT_GT(partial, 30);
    // Single precision may decide a comparison or a texel differently.
    EXPECT_LE(off, checked / 200);
}

SI_TEST_IS(Later, DiagnosisTest, TapsWithARemainderAddUpToTheVisibilityOnTheGpu);
TEST_F(DiagnosisTest, TapsWithARemainderAddUpToTheVisibilityOnTheGpu) {
    const Scene scene = test::floor_and_box(10, {1.5, 0.25, 2}, 0);
    int checked = 0, off = 0, off_without = 0;
    for (const auto& [format, reversed] : {std::pair{"d16", false}, {"d32f", true}, {"d24", true}}) {
        Settings s = plain("pcf5", 0);
        set_setting(s, "map.format", format);
        s.map.reversed_z = reversed;
        set_all(s, {"map.resolution=64", "bias.kind=receiver-plane-remainder", "bias.normal=0.25"});
        for (int y = 30; y < 100; y += 7)
            for (int x = 40; x < 130; x += 7) {
                const Probe p = renderer.probe(scene, s, kPicture, x, y);
                if (!p.hit || p.lights[0].account.receiver.n_dot_l <= 0) continue;
                BiasBreakdown plane_alone = p.lights[0].account;
                EXPECT_GT(plane_alone.remainder_per_texel, 0);
                plane_alone.remainder_per_texel = 0;
                double sum = 0, sum_without = 0;
                for (const KernelTap& t : p.lights[0].taps) {
                    sum += t.weight * t.lit;
                    const double own = plane_alone.compared_depth_at((glm::dvec2(t.texel) + 0.5) / 64.0);
                    sum_without += t.weight * (reversed ? own >= t.stored : own <= t.stored);
                }
                ++checked;
                off += std::abs(sum - p.lights[0].visibility) > 1e-3;
                off_without += std::abs(sum_without - p.lights[0].visibility) > 1e-3;
            }
    }
    EXPECT_GT(checked, 150);
    // Single precision may decide a comparison differently.
    EXPECT_LE(off, checked / 100);
    EXPECT_GT(off_without, checked / 20) << "the remainder decides no tap here";
}

SI_TEST_IS(DriverIndependent, DiagnosisTest, AgreesWithMeasureOnEveryPixel);
SI_TEST_IS(Repeated, DiagnosisTest, AgreesWithMeasureOnEveryPixel);
SI_TEST_IS(Later, DiagnosisTest, AgreesWithMeasureOnEveryPixel);
TEST_F(DiagnosisTest, AgreesWithMeasureOnEveryPixel) {
    const Scene scene = test::sheet_over_floor(1.5);
    int kinds[kArtefacts] = {}, dark = 0;
    for (const double constant : {12.0, 3.0, 0.5}) {
        Settings s = plain("hard", constant);
        s.map.resolution = 64;
        const MeasuredError m = measure(scene, s);
        const ReferenceScene casters(std::make_shared<ReferenceGeometry>(scene, s));
        int wrong = 0;
        for (int y = 0; y < kPicture.height; ++y)
            for (int x = 0; x < kPicture.width; ++x) {
                const std::size_t i = std::size_t(y * kPicture.width + x);
                // The test samples few of the right pixels and more of the wrong ones.
                if (m.classified[i].artefact == Artefact::None ? (x % 11 != 3 || y % 9 != 5) : ++wrong % 23 != 0)
                    continue;
                const Probe p = renderer.probe(scene, s, kPicture, x, y);
                EXPECT_EQ(p.hit, m.traced.reference->state[i] != PixelState::Background);
                if (!p.hit) continue;
                const FragmentReference t =
                    trace_fragment_reference(casters, p, p.lights[0], s, object_traits(scene, s));
                EXPECT_EQ(t.state, m.traced.reference->state[i]);
                EXPECT_EQ(t.lit, m.traced.reference->hard().data[i] >= 0.5f);
                EXPECT_EQ(t.cause.artefact, m.classified[i].artefact) << x << "," << y;
                EXPECT_EQ(t.cause.also, m.classified[i].also()) << x << "," << y;
                EXPECT_EQ(t.evidence.run_m, m.traced.runs->run_m.data[i]) << "a part of the picture gives the whole's";
                EXPECT_EQ(t.evidence.edge_m, m.traced.runs->edge_m.data[i]);
                const float gap = m.traced.reference->nearest_m.data[i];
                EXPECT_EQ(std::isnan(t.gap_m), std::isnan(gap));
                if (!std::isnan(gap)) {
                    EXPECT_NEAR(t.gap_m, gap, 1e-6);
                    ++dark;
                }
                ++kinds[std::size_t(t.cause.artefact)];
            }
    }
    EXPECT_GT(dark, 20);
    EXPECT_GT(kinds[std::size_t(Artefact::None)], 100);
    EXPECT_GT(kinds[std::size_t(Artefact::EdgeAliasing)] + kinds[std::size_t(Artefact::Undersampled)], 2);
    EXPECT_GT(kinds[std::size_t(Artefact::PeterPanning)], 5);
    EXPECT_GT(kinds[std::size_t(Artefact::Acne)], 5);
}

SI_TEST_IS(Later, DiagnosisTest, AcneReportsTheNeededBiasAndItsFixWorks);
TEST_F(DiagnosisTest, AcneReportsTheNeededBiasAndItsFixWorks) {
    const Scene scene = make_scene(make_plane(10, 10));
    for (const char* kernel : {"hard", "hw2x2"})
        for (const bool slope : {false, true}) {
            Settings s = plain(kernel, 0.2);
            if (slope) s.bias.slope = 0.6;
            const MeasuredError before = measure(scene, s);
            const auto pixel = find(before, Artefact::Acne);
            ASSERT_TRUE(pixel) << kernel;
            const PixelDiagnosis d = diagnosis(scene, s, *pixel);
            EXPECT_EQ(d.verdict.find("acne: needs"), 0u) << d.verdict;
            EXPECT_FALSE(d.right);
            EXPECT_LT(d.has.texels, d.least.texels);
            EXPECT_TRUE(d.window_open());
            EXPECT_TRUE(std::isinf(d.occluder.texels)) << "nothing stands over a bare floor";
            int own = 0;
            for (const KernelTap& t : probed.lights[0].taps) own += !t.lit && t.meets == KernelTap::Meets::Own;
            EXPECT_GT(own, 0) << "what darkens it is the surface itself";
            ASSERT_TRUE(d.fix) << kernel;
            EXPECT_EQ(d.fix->settings[0].first, slope ? "bias.slope" : "bias.constant");
            EXPECT_GT(d.fix->equivalent_bias_texels, 0.999 * d.least.texels);
            EXPECT_LT(d.fix->equivalent_bias_texels, 1.02 * d.least.texels) << "the surface's need, rounded up";
            apply(s, *d.fix);
            EXPECT_TRUE(diagnosis(scene, s, *pixel).right);
            // The floor is one plane under one light: a fix for one pixel fixes all.
            const ErrorMetrics after = measure(scene, s).metrics;
            EXPECT_GT(before.metrics.acne, 0.1);
            EXPECT_EQ(after.acne, 0) << kernel << d.fix->text;
        }
}

TEST_F(DiagnosisTest, AcneUnderAWideKernelIsStillReported) {
    const Scene scene = make_scene(make_plane(10, 10));
    Settings s = plain("pcf5", 1.5);
    const PixelDiagnosis d = diagnosis(scene, s, {80, 60});
    EXPECT_TRUE(d.right);
    EXPECT_LT(probed.lights[0].visibility, 0.99);
    EXPECT_EQ(d.verdict.find("faint acne: lit"), 0u) << d.verdict;
    ASSERT_TRUE(d.fix);
    apply(s, *d.fix);
    EXPECT_EQ(diagnosis(scene, s, {80, 60}).verdict.find("correct: lit"), 0u);
    EXPECT_EQ(measure(scene, s).metrics.any_acne, 0);
}

TEST_F(DiagnosisTest, TooMuchBiasIsPeterPanningAndLessFixesIt) {
    const Scene scene = test::sheet_over_floor(0.6);
    Settings s = plain("hard", 0);
    s.bias.constant = 60;
    const auto pixel = find(measure(scene, s), Artefact::PeterPanning);
    ASSERT_TRUE(pixel);
    const PixelDiagnosis d = diagnosis(scene, s, *pixel);
    EXPECT_EQ(d.verdict.find("peter-panning: bias moves it"), 0u) << d.verdict;
    EXPECT_TRUE(d.window_open());
    EXPECT_GE(d.shift.texels, d.occluder.texels);
    // The distance is along a ray 40 degrees above the horizon.
    EXPECT_NEAR(d.occluder.metres, 0.6 / std::sin(glm::radians(40.0)), 1e-4);
    EXPECT_NEAR(d.reference.gap_m, d.occluder.metres, 1e-6);
    ASSERT_TRUE(d.fix);
    EXPECT_EQ(d.fix->settings[0].first, "bias.constant");
    apply(s, *d.fix);
    const PixelDiagnosis after_fix = diagnosis(scene, s, *pixel);
    EXPECT_TRUE(after_fix.right) << after_fix.verdict;
    EXPECT_EQ(measure(scene, s).metrics.artefacts[std::size_t(Artefact::Acne)], 0u);
}

TEST_F(DiagnosisTest, WithoutAValidBiasItNamesTheNeededResolution) {
    const Scene scene = test::sheet_over_floor(0.3);
    Settings s = plain("pcf7", 12);
    s.map.resolution = 128;
    s.camera.elevation = 5;  // beneath the sheet
    s.camera.target_y = 0.1;
    const auto pixel = find(measure(scene, s), Artefact::Leak);
    ASSERT_TRUE(pixel);
    const PixelDiagnosis d = diagnosis(scene, s, *pixel);
    EXPECT_FALSE(d.window_open());
    EXPECT_NE(d.verdict.find("no depth bias can be right here"), std::string::npos) << d.verdict;
    EXPECT_NE(d.verdict.find(std::to_string(int(d.opening_resolution)) + "² would open the window"), std::string::npos);
    EXPECT_GT(d.opening_resolution, 128);
    // A valid bias exists at that resolution, and none at half of it.
    for (const auto& [resolution, open] :
         {std::pair{int(d.opening_resolution), true}, {int(d.opening_resolution) / 2, false}}) {
        s.map.resolution = resolution;
        EXPECT_EQ(diagnosis(scene, s, *pixel).window_open(), open) << resolution;
    }
    s.map.resolution = int(d.opening_resolution);
    const PixelDiagnosis opened = diagnosis(scene, s, *pixel);
    s.bias.constant = 0.5 * (opened.least.texels + opened.occluder.texels);
    EXPECT_TRUE(diagnosis(scene, s, *pixel).right);
}

// Front faces are culled, and the kernel finds light past the back faces. Pixel 582,212 is 30 % lit beside a true edge;
// other pixels are lit away from all edges.
TEST_F(DiagnosisTest, NamesFaintLightAwayFromTrueEdges) {
    const Scene scene = load_scene("boxes");
    const Settings s = settings_for(scene, {{"map.resolution", "512"},
                                            {"caster.cull", "front"},
                                            {"bias.normal", "0"},
                                            {"bias.constant", "0"},
                                            {"bias.slope", "0"}});
    const FrameRequest request{.width = 640, .height = 360};
    const ReferenceScene casters(std::make_shared<ReferenceGeometry>(scene, s));
    const auto diagnosed = [&](int x, int y) {
        const Probe probe = renderer.probe(scene, s, request, x, y);
        const Probe::PerLight& light = probe.lights.at(0);
        return diagnose_pixel(probe, light, trace_fragment_reference(casters, probe, light, s, object_traits(scene, s)),
                              s, renderer.driver());
    };
    const PixelDiagnosis beside_edge = diagnosed(582, 212);
    EXPECT_FALSE(beside_edge.reference.any_leak);
    EXPECT_NE(beside_edge.verdict.find("30 % lit, since a true edge lies within the kernel's reach (± "),
              std::string::npos)
        << beside_edge.verdict;
    ReferenceCache cache;
    const MeasuredError m = measure_error(renderer, scene, s, request, 0, {}, cache);
    int named = 0;
    for (std::size_t i = 0; i < m.classified.size() && named < 3; ++i) {
        if (!m.classified[i].any_leak || m.classified[i].visibility >= 0.5f) continue;
        const PixelDiagnosis d = diagnosed(int(i % 640), int(i / 640));
        EXPECT_TRUE(d.right);
        EXPECT_TRUE(d.verdict.starts_with("faint light: in shadow, as in the reference, but ")) << d.verdict;
        ++named;
    }
    EXPECT_GT(named, 0);
}

SI_TEST_IS(Later, DiagnosisTest, WritesOutTheBoundThatBleeds);
TEST_F(DiagnosisTest, WritesOutTheBoundThatBleeds) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.1);
    for (const char* kernel : {"vsm", "savsm", "esm", "evsm2", "evsm4", "msm_hamburger", "msm_hausdorff"}) {
        Settings s = plain(kernel, 0);
        set_all(s, {"filter.exponent=3", "filter.negative_exponent=3", "filter.blur=6", "filter.window=12",
                    "filter.bleed=0", "map.resolution=256"});
        const auto pixel = find(measure(scene, s), Artefact::LightBleeding);
        if (!pixel) continue;
        const PixelDiagnosis d = diagnosis(scene, s, *pixel);
        EXPECT_EQ(d.cause().artefact, Artefact::LightBleeding) << kernel;
        EXPECT_TRUE(d.verdict.starts_with("light bleeding: upper bound 0.")) << d.verdict;
        EXPECT_NE(d.verdict.find(" within the blur (± "), std::string::npos) << d.verdict;
        const KernelFacts& k = probed.lights[0].kernel;
        const MomentBound bound = moment_bound(filter_of(s), s.filter, k);
        // Numbers of the printed formula give the kernel's own bound.
        double v = 0, behind = 0;
        const auto at = bound.formula.find(" with v ");
        if (at == std::string::npos) continue;
        ASSERT_EQ(std::sscanf(bound.formula.c_str() + at, " with v %lf, z - m %lf", &v, &behind), 2) << bound.formula;
        EXPECT_NEAR(v / (v + behind * behind), k.bound, 0.01 * k.bound) << kernel << ": " << bound.formula;
    }
}

// The depth range is so large that the floor of the variance, and not the depths, decides the bound.
TEST_F(DiagnosisTest, NamesTheFloorOfTheVariance) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = plain("vsm", 0);
    set_all(s,
            {"light.near_far=manual", "light.near=1", "light.far=20000", "filter.min_variance=1e-6", "filter.bleed=0"});
    const auto pixel = find(measure(scene, s), Artefact::LightBleeding);
    ASSERT_TRUE(pixel);
    const PixelDiagnosis d = diagnosis(scene, s, *pixel);
    EXPECT_NE(d.verdict.find("v is the floor by filter.min_variance 1e-06"), std::string::npos) << d.verdict;
    EXPECT_NE(d.verdict.find("spread by ± 20 m"), std::string::npos) << d.verdict;
    const std::size_t before = measure(scene, s).metrics.artefacts[std::size_t(Artefact::LightBleeding)];
    set_setting(s, "filter.min_variance", "1e-9");
    EXPECT_LT(measure(scene, s).metrics.artefacts[std::size_t(Artefact::LightBleeding)], before / 2);
}

TEST_F(DiagnosisTest, NamesTheShadowTerminatorWithoutBiasNumbers) {
    const Scene scene = test::grey_scene({{"ball", make_sphere(1, 10, 6)}});
    const Settings s = plain("hard", 1);
    const MeasuredError m = measure(scene, s);
    const auto& state = m.traced.reference->state;
    const auto at = std::size_t(std::ranges::find(state, PixelState::ShadowTerminator) - state.begin());
    ASSERT_LT(at, state.size());
    const PixelDiagnosis d = diagnosis(scene, s, {int(at) % kPicture.width, int(at) / kPicture.width});
    EXPECT_EQ(d.reference.state, PixelState::ShadowTerminator);
    EXPECT_EQ(d.verdict,
              "not compared: shadow terminator: the triangle faces away from the light, its smooth normal "
              "does not: no bias cures it");
    EXPECT_EQ(d.least.texels, 0);
    EXPECT_FALSE(d.fix);
}

TEST_F(DiagnosisTest, NormalOffsetCountsByItsEquivalentDepthBias) {
    const Scene scene = make_scene(make_plane(10, 10));
    Settings s = plain("hard", 0);
    s.bias.normal = 1;
    const PixelDiagnosis d = diagnosis(scene, s, {80, 60});
    const BiasBreakdown& a = probed.lights[0].account;
    const double cosine = std::sin(glm::radians(40.0));
    EXPECT_NEAR(a.amount(a.normal).metres, a.receiver.texel_m / cosine, 1e-6);
    EXPECT_NEAR(d.shift.metres, a.receiver.texel_m * cosine, 1e-6) << "towards the light only its part along it";
    EXPECT_NEAR(a.contact_gap_m(), a.receiver.texel_m * std::tan(std::acos(cosine)), 1e-6) << "h tan(theta)";
    // The least offset by the theory balances the account.
    s.bias.normal =
        least_normal_offset(probed.lights[0].fitted.views[0], probed.position_ws, probed.normal_ws, a.least.total()) /
        a.receiver.texel_m;
    const PixelDiagnosis even = diagnosis(scene, s, {80, 60});
    EXPECT_NEAR(even.has.depth / even.least.depth, 1, 1e-4);
}

TEST_F(DiagnosisTest, DistinguishesEdgesLostCastersAndPointsOutsideTheMap) {
    const Scene box = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = plain("hard", 3);
    s.map.resolution = 64;
    const auto edge = find(measure(box, s), Artefact::EdgeAliasing);
    ASSERT_TRUE(edge);
    const PixelDiagnosis at_edge = diagnosis(box, s, *edge);
    EXPECT_EQ(at_edge.verdict.find("edge aliasing"), 0u) << at_edge.verdict;
    EXPECT_FALSE(at_edge.fix);

    const Scene sheet = test::sheet_over_floor(1.2);
    s = plain("hard", 3);
    s.caster.cull = Cull::Front;
    const auto lost = find(measure(sheet, s), Artefact::LostCaster);
    ASSERT_TRUE(lost);
    const PixelDiagnosis d = diagnosis(sheet, s, *lost);
    EXPECT_EQ(d.verdict.find("lost caster"), 0u) << d.verdict;
    ASSERT_TRUE(d.fix);
    apply(s, *d.fix);
    EXPECT_TRUE(diagnosis(sheet, s, *lost).right);

    set_all(s, {"light.fit=manual", "light.extent=1.2"});
    const auto outside = find(measure(sheet, s), Artefact::OutsideMap);
    ASSERT_TRUE(outside);
    EXPECT_EQ(diagnosis(sheet, s, *outside).verdict.find("outside the map"), 0u);
}

TEST_F(DiagnosisTest, NamesTheBlurWhereTheUnblurredMapIsRight) {
    Settings s = plain("hard", 3);
    s.map.blur_texels = 6;
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    const auto pixel = find(measure(scene, s), Artefact::Filter);
    ASSERT_TRUE(pixel);
    const PixelDiagnosis d = diagnosis(scene, s, *pixel);
    EXPECT_EQ(d.verdict.find("kernel too wide"), 0u) << d.verdict;
    EXPECT_NE(d.verdict.find("depth blur (map.blur_texels)"), std::string::npos) << d.verdict;
    s.map.blur_texels = 0;
    EXPECT_TRUE(diagnosis(scene, s, *pixel).right) << "the verdict's change";
}

TEST_F(DiagnosisTest, NamesAProjectionThatIsNotTheLights) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    for (const auto& [type, projection, words] : {std::tuple{"directional", "perspective", "in perspective"},
                                                  {"spot", "orthographic", "without perspective"}}) {
        SCOPED_TRACE(type);
        Settings s = settings_with(
            plain("hard", 3),
            {{"light.type", type}, {"light.projection", projection}, {"light.distance", "9"}, {"light.cone", "100"}});
        const auto pixel = find(measure(scene, s), Artefact::EdgeAliasing);
        ASSERT_TRUE(pixel);
        EXPECT_NE(diagnosis(scene, s, *pixel).verdict.find(words), std::string::npos)
            << diagnosis(scene, s, *pixel).verdict;
    }
}

TEST_F(DiagnosisTest, ValuesOfFixesAreShortDecimals) {
    for (const auto& [from, to] :
         {std::pair{2.7501, 2.76}, {0.0027501, 0.00276}, {1e-7 * 1.2301, 1.24e-7}, {27501.0, 27600.0}, {3.0, 3.0}})
        EXPECT_EQ(round_up_3_digits(from), to);
}

TEST_F(DiagnosisTest, ALargeLightIsPartlyVisible) {
    const Scene scene = test::sheet_over_floor(1.2);
    Settings s = plain("hard", 3);
    s.lights[0].size = 8;
    const MeasuredError m = measure(scene, s);
    const auto edge = find(m, Artefact::EdgeAliasing);
    ASSERT_TRUE(edge);
    const PixelDiagnosis d = diagnosis(scene, s, *edge);
    EXPECT_GT(d.reference.share, 0.02);
    EXPECT_LT(d.reference.share, 0.98);
    s.lights[0].size = 0;
    const double share = diagnosis(scene, s, *edge).reference.share;
    EXPECT_TRUE(share == 0 || share == 1) << share;
}

// Most of the light is seen here, and a pixel's first rays often miss the hidden part.
TEST_F(DiagnosisTest, ThinPenumbraeOfALargeLightAreFound) {
    const Scene scene = test::sheet_over_floor(1.2);
    Settings s = plain("hard", 3);
    s.lights[0].size = 8;
    ReferenceCache cache;
    const MeasuredError m = measure_error(renderer, scene, s, kPicture, 0, {.area = true}, cache);
    const Reference& reference = *m.traced.reference;
    int checked = 0, missed = 0;
    for (std::size_t i = 0; i < reference.state.size() && checked < 60; ++i) {
        const float share = reference.visibility.data[i];
        if (reference.state[i] != PixelState::Counted || share < 0.92f || share > 0.97f) continue;
        ++checked;
        const PixelDiagnosis d = diagnosis(scene, s, {int(i) % kPicture.width, int(i) / kPicture.width});
        missed += d.reference.share == 1;
        EXPECT_NEAR(d.reference.share, share, 0.08) << i;
        EXPECT_LT(d.reference.noise, 0.02) << i;
    }
    EXPECT_GT(checked, 20);
    EXPECT_LE(missed, checked / 20);
}

// Bias has detached the shadow from the box. Contact shadows close the gap, where the map alone still says lit.
TEST_F(DiagnosisTest, AGapThatContactShadowsCloseIsRight) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2});
    Settings s = plain("pcf3", 40);
    const MeasuredError before = measure(scene, s);
    set_all(s, {"light.contact=0.6", "contact.steps=64", "contact.thickness=2"});
    const MeasuredError after = measure(scene, s);
    int closed = 0;
    for (std::size_t i = 0; i < after.classified.size() && closed < 3; ++i) {
        if (before.classified[i].artefact != Artefact::PeterPanning) continue;
        if (after.classified[i].artefact != Artefact::None || after.classified[i].visibility >= 0.5f) continue;
        ++closed;
        const PixelDiagnosis d = diagnosis(scene, s, {int(i) % kPicture.width, int(i) / kPicture.width});
        EXPECT_EQ(probed.lights[0].visibility, after.classified[i].visibility);
        EXPECT_GE(probed.lights[0].evidence.map_visibility, 0.5f);
        EXPECT_TRUE(d.right) << d.verdict;
        EXPECT_EQ(d.cause().artefact, Artefact::None) << d.verdict;
    }
    EXPECT_GT(closed, 0);
}

// Rays that take each surface for 20 m thick darken pixels beside the box.
TEST_F(DiagnosisTest, NamesContactShadowsThatDarkenALitPixel) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2});
    int named = 0;
    for (const char* azimuth : {"-110", "-20", "70", "160"}) {
        Settings s = plain("pcf3", 3);
        set_all(s, {{"camera.azimuth", azimuth}, "light.contact=3", "contact.steps=64", "contact.thickness=20"});
        const auto pixel = find(measure(scene, s), Artefact::Contact);
        if (!pixel) continue;
        ++named;
        const PixelDiagnosis d = diagnosis(scene, s, *pixel);
        EXPECT_EQ(d.cause().artefact, Artefact::Contact) << d.verdict;
        EXPECT_NE(d.verdict.find("without contact shadows it is lit"), std::string::npos) << d.verdict;
        EXPECT_FALSE(d.fix);
    }
    EXPECT_GT(named, 0);
}

}  // namespace
}  // namespace si
