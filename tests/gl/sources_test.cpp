// Tests sources of visibility: their outputs, the passes that they skip, and their comparison with the reference.
#include "renderer/settings/sources.h"

#include <algorithm>

#include "renderer/inspect/fragment_reference.h"
#include "renderer/measure/measured_error.h"
#include "renderer/reference/live_error.h"
#include "renderer/reference/reference_picture.h"
#include "renderer/settings/idle_reason.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/hard_case.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class SourcesTest : public FrameTest {
protected:
    ReferenceCache cache;
    Workers workers{.threads = 2};

    static FrameRequest asks_for_visibility() {
        FrameRequest request{.width = 161, .height = 93, .outputs = {.colour = false, .visibility = true}};
        return request;
    }
    FloatImage visibility(const Scene& scene, const Settings& s) {
        FrameRequest request = asks_for_visibility();
        return renderer.read_float(render_with_reference(renderer, scene, s, request, cache, workers).visibility, 1);
    }
    Reference reference(const Scene& scene, const Settings& s, int light) {
        const ReferenceTask task =
            reference_task(renderer, scene, s, asks_for_visibility(), light, reference_options(s));
        return *cache.trace(task, workers).reference;
    }
};

SI_TEST_IS(Repeated, SourcesTest, EveryRowHasTextsAndConsistentNeeds);
TEST_F(SourcesTest, EveryRowHasTextsAndConsistentNeeds) {
    ASSERT_FALSE(sources().empty());
    EXPECT_EQ(sources()[std::size_t(LightSettings{}.source)].key, "map");
    for (const Source& s : sources()) {
        EXPECT_FALSE(s.key.empty() || s.label.empty() || s.help.empty()) << s.key;
        EXPECT_EQ(s.paper.empty(), s.key == "none") << s.key;
        EXPECT_FALSE(s.fused && (s.needs.stencil || s.needs.reference || s.needs.blobs || s.needs.light_map))
            << s.key << ": shading has neither";
    }
}

// A search changes the bias many times under one reference.
TEST_F(SourcesTest, AnotherBiasUploadsTheReferenceNoSecondTime) {
    const Scene scene = load_scene("boxes");
    Settings s = settings_for(scene);
    const auto state = [&] {
        FrameRequest request = small_request({.colour = false, .classified = true});
        const FrameResult f = render_with_reference(renderer, scene, s, request, cache, workers, ReferenceOptions{});
        return f.pass("reference uploaded")->state;
    };
    EXPECT_EQ(state(), PassState::Drawn);
    s.bias.constant += 1;
    EXPECT_EQ(state(), PassState::Cached);
    s.lights[0].azimuth += 10;
    EXPECT_EQ(state(), PassState::Drawn) << "another light has another reference";
}

SI_TEST_IS(Repeated, SourcesTest, OnlyShadowMapsDrawMaps);
// For each source visibility lies in [0,1] at every pixel. Maps are drawn only for the source "map", and the plan
// gives the reason.
SI_TEST_IS(Later, SourcesTest, OnlyShadowMapsDrawMaps);
TEST_F(SourcesTest, OnlyShadowMapsDrawMaps) {
    const Scene scene = load_scene("boxes");
    for (const Source& source : sources())
        for (const char* type : {"directional", "spot", "point"}) {
            SCOPED_TRACE(testing::Message() << source.key << " " << type);
            const Settings s = settings_for(scene, {{"light.type", type}, {"light.source", std::string(source.key)}});
            FrameRequest request = small_request({.shadow_map = true, .visibility = true});
            const FrameResult f = render_with_reference(renderer, scene, s, request, cache, workers);
            EXPECT_EQ(f.lights[0].casts, source.needs.map);
            EXPECT_TRUE(f.lights[0].shadowed);
            EXPECT_EQ(f.passes[0].state == PassState::Skipped, !source.needs.map);
            if (!source.needs.map) {
                EXPECT_NE(f.passes[0].reason.find(source.key), std::string::npos);
            }
            EXPECT_EQ(f.pass("visibility")->state, PassState::Drawn);
            const FloatImage v = renderer.read_float(f.visibility, 1);
            for (const float x : v.data) ASSERT_TRUE(x >= 0 && x <= 1) << x;
            const auto dark = std::count_if(v.data.begin(), v.data.end(), [](float x) { return x < 0.5f; });
            EXPECT_EQ(dark > 300, source.key != "none") << dark;
        }
}

// One box above a floor: the disc's middle lies where the light's ray through the box's middle meets the floor. The
// disc's rim is one radius away across the light, and between them visibility fades by the setting.
TEST_F(SourcesTest, ABlobIsADiscBelowItsCaster) {
    for (const test::Place& place : test::kPlaces)
        for (const LightType type : test::kLightTypes) {
            SCOPED_TRACE(testing::Message() << int(type) << " at " << place.at.x);
            Scene scene = test::floor_and_box(10, {1, 0.8, 1.2}, 0.6);
            test::move_scene(scene, place.at);
            Settings s = test::hard_settings();
            set_setting(s, "light.source", "blob");
            test::place_light(s, type, place);
            s.blob = {.size = 1.5, .softness = 0.4, .opacity = 0.8, .reach = 6};
            const test::Shot shot = test::draw_shot(scene, s, 160, 120);
            const test::RayReference rays(scene);
            const FittedLight& fitted = shot.light();
            const glm::dvec3 middle = place.at + glm::dvec3(0, 1, 0);
            const glm::dvec3 away = fitted.type == LightType::Directional ? -fitted.to_light : middle - fitted.position;
            const glm::dvec3 axis = glm::normalize(away);
            const glm::dvec3 half(0.5, 0.4, 0.6);
            double squares = glm::dot(half, half);
            for (int k = 0; k < 3; ++k) squares -= std::pow(half[k] * axis[k], 2);
            const double radius = 1.5 * std::sqrt(squares / 2);
            int dark = 0, lit = 0;
            for (const auto& [x, y, hit] : test::pixel_hits(rays, shot)) {
                if (std::abs(hit.position.y - place.at.y) > 1e-3) continue;
                const glm::dvec3 from = hit.position - middle;
                const double along = glm::dot(from, axis), across = glm::length(from - axis * along);
                const double spread = fitted.type == LightType::Directional ? 1 : 1 + along / glm::length(away);
                const double rim = std::clamp((1 - across / (radius * spread)) / 0.4, 0.0, 1.0);
                const double fades =
                    std::clamp(along / radius / 0.25, 0.0, 1.0) * std::clamp(1 - along / radius / 6, 0.0, 1.0);
                const double expected = 1 - 0.8 * rim * fades;
                ASSERT_NEAR(shot.visibility.at(x, y), expected, 5e-3) << x << ' ' << y;
                expected < 0.5 ? ++dark : ++lit;
            }
            EXPECT_GT(dark, 40);
            EXPECT_GT(lit, 1000);
        }
}

SI_TEST_IS(Repeated, SourcesTest, FusedAndSeparateSourcesGiveTheSamePicture);
SI_TEST_IS(Later, SourcesTest, FusedAndSeparateSourcesGiveTheSamePicture);
TEST_F(SourcesTest, FusedAndSeparateSourcesGiveTheSamePicture) {
    const Scene scene = load_scene("stage");
    for (const Source& source : sources()) {
        if (!source.fused) continue;
        SCOPED_TRACE(source.key);
        Settings s = settings_for(scene, {"light.count=2",
                                          {"light.0.source", std::string(source.key)},
                                          "light.1.type=spot",
                                          "light.1.elevation=60"});
        const FrameResult fused = renderer.render(scene, s, small_request());
        EXPECT_NE(fused.pass("shading (with visibility)"), nullptr);
        const ByteImage picture = renderer.read_colour(fused.colour);
        s.shading.separate_visibility = true;
        EXPECT_EQ(different_pixels(picture, this->picture(scene, s), 1), 0u);
        FrameRequest all = small_request();
        all.forced = OptimisationSet::all();
        EXPECT_EQ(different_pixels(this->picture(scene, s), this->picture(scene, s, all)), 0u);
    }
}

// Visibility equals the rays' answer at every pixel, for all positions of scene and light, with and without light
// size.
TEST_F(SourcesTest, TracedEqualsTheReference) {
    Scene scene = load_scene("boxes");
    test::move_scene(scene, {4e3, -2e3, 9e3});
    for (const char* type : {"directional", "spot", "point"})
        for (const char* elevation : {"35", "90"})
            for (const bool area : {false, true}) {
                SCOPED_TRACE(testing::Message() << type << " " << elevation << " " << area);
                Settings s = settings_for(scene, {{"light.type", type},
                                                  {"light.elevation", elevation},
                                                  "light.source=traced",
                                                  "light.size=2",
                                                  "truth.samples=64"});
                s.truth.area = area;
                s.truth.step = area ? 2 : 1;
                const FloatImage v = visibility(scene, s);
                const Reference t = reference(scene, s, 0);
                std::size_t grey = 0, dark = 0;
                for (int y = 0; y < v.height; ++y)
                    for (int x = 0; x < v.width; ++x) {
                        ASSERT_EQ(v.at(x, y), t.visibility.at(x / t.step, y / t.step)) << x << ", " << y;
                        grey += v.at(x, y) > 0 && v.at(x, y) < 1;
                        dark += v.at(x, y) < 0.5f;
                    }
                EXPECT_EQ(grey > 50, area) << grey;
                EXPECT_GT(dark, 300u);
            }
}

SI_TEST_IS(Repeated, SourcesTest, EachLightHasItsOwnSource);
SI_TEST_IS(Later, SourcesTest, EachLightHasItsOwnSource);
TEST_F(SourcesTest, EachLightHasItsOwnSource) {
    const Scene scene = load_scene("stage");
    Settings s = settings_for(scene, {"light.count=3", "light.1.type=spot", "light.1.azimuth=60",
                                      "light.1.source=traced", "light.2.type=point", "light.2.azimuth=100"});
    Settings maps = s;
    maps.lights[1].source = 0;
    for (const int light : {0, 2}) {
        s.view.light = maps.view.light = light;
        EXPECT_EQ(visibility(scene, s).data, visibility(scene, maps).data) << light;
    }
    s.view.light = 1;
    EXPECT_EQ(visibility(scene, s).data, reference(scene, s, 1).visibility.data);
}

TEST_F(SourcesTest, WithoutRaysALightHasNoShadowAndANoteReportsIt) {
    const Scene scene = load_scene("boxes");
    const Settings s = settings_for(scene, {"light.source=traced"});
    const Settings none = settings_for(scene, {"light.source=none"});
    FrameRequest request = small_request();
    const FrameResult untraced = renderer.render(scene, s, request);
    ASSERT_EQ(untraced.traced.size(), 1u);
    EXPECT_NE(untraced.traced[0].key, 0u);
    EXPECT_FALSE(untraced.traced[0].met);
    ASSERT_FALSE(untraced.notes.empty());
    EXPECT_NE(untraced.notes.back().find("light 0 has no shadow yet"), std::string::npos) << untraced.notes.back();
    const ByteImage lit = renderer.read_colour(untraced.colour);
    EXPECT_EQ(different_pixels(lit, picture(scene, none), 1), 0u);
    const FrameResult traced = render_with_reference(renderer, scene, s, request, cache, workers);
    EXPECT_TRUE(traced.traced[0].met);
    EXPECT_TRUE(traced.notes.empty());
    EXPECT_GT(different_pixels(lit, renderer.read_colour(traced.colour), 8), 1000u);
    Settings turned = s;
    turned.lights[0].azimuth += 20;
    EXPECT_FALSE(renderer.render(scene, turned, request).traced[0].met) << "another light, other rays";
}

SI_TEST_IS(Repeated, SourcesTest, TheReferencePictureEqualsTheTracedSource);
// The reference picture equals the row's result.
SI_TEST_IS(Later, SourcesTest, TheReferencePictureEqualsTheTracedSource);
TEST_F(SourcesTest, TheReferencePictureEqualsTheTracedSource) {
    const Scene scene = load_scene("stage");
    Settings s = settings_for(scene, {"light.count=2", "light.1.type=spot", "map.resolution=256"});
    for (const int light : {0, 1}) {
        s.view.light = light;
        FrameRequest request = small_request({.true_colour = true});
        const ByteImage reference =
            renderer.read_colour(render_with_reference(renderer, scene, s, request, cache, workers).true_colour);
        Settings traced = s;
        set_setting(traced, "light." + std::to_string(light) + ".source", "traced");
        FrameRequest plain = small_request();
        const ByteImage row =
            renderer.read_colour(render_with_reference(renderer, scene, traced, plain, cache, workers).colour);
        EXPECT_EQ(different_pixels(reference, row), 0u) << light;
        EXPECT_GT(different_pixels(reference, picture(scene, s), 4), 20u) << light;
    }
}

SI_TEST_IS(Repeated, SourcesTest, ErrorsWithoutAMapAreAttributedToNoMap);
// Compared with the reference, the traced source has no error. Without a shadow all dark pixels are errors, and none
// has a cause of maps.
TEST_F(SourcesTest, ErrorsWithoutAMapAreAttributedToNoMap) {
    const Scene scene = load_scene("boxes");
    FrameRequest request{.width = 161, .height = 93, .outputs = {.colour = false, .error = true}};
    for (const char* type : {"directional", "point"})
        for (const bool area : {false, true}) {
            SCOPED_TRACE(testing::Message() << type << " " << area);
            Settings s =
                settings_for(scene, {{"light.type", type}, "light.source=none", "light.size=1", "truth.samples=64"});
            s.truth.area = area;
            const Reference t = reference(scene, s, 0);
            std::size_t dark = 0, penumbra = 0;
            for (std::size_t i = 0; i < t.state.size(); ++i) {
                if (t.state[i] != PixelState::Counted || !is_wrong(1, reference_pixel(t, i))) continue;
                ++dark;
                penumbra += t.hard().data[i] >= 0.5f;
            }
            ASSERT_GT(dark, 300u);
            const FrameResult f = render_with_reference(renderer, scene, s, request, cache, workers);
            ASSERT_TRUE(f.error);
            const ErrorMetrics& gpu = f.error->metrics;
            const ErrorMetrics cpu =
                measure_error(renderer, scene, s, request, 0, reference_options(s), cache, workers).metrics;
            EXPECT_EQ(gpu.artefacts, cpu.artefacts);
            EXPECT_EQ(cpu.artefacts[std::size_t(Artefact::NoMap)], dark - penumbra);
            EXPECT_EQ(cpu.artefacts[std::size_t(Artefact::Penumbra)], penumbra);
            EXPECT_EQ(std::llround(cpu.false_light * double(cpu.counted)), (long long)dark);
            EXPECT_NEAR(gpu.boundary_false_light, gpu.false_light, 1e-12) << "the sum of its causes";
            EXPECT_EQ(cpu.any_acne, 0);
            EXPECT_EQ(cpu.outside_map, 0);

            set_setting(s, "light.source", "traced");
            const ErrorMetrics none =
                measure_error(renderer, scene, s, request, 0, reference_options(s), cache, workers).metrics;
            EXPECT_EQ(none.mae, 0);
            EXPECT_EQ(none.false_light + none.false_shadow, 0);
            EXPECT_EQ(none.iou, 1);
        }
}

TEST_F(SourcesTest, AProbeReportsTheSourcesVisibility) {
    const Scene scene = load_scene("boxes");
    const Settings s = settings_for(scene, {"light.source=traced"});
    FrameRequest request = asks_for_visibility();
    const FloatImage v =
        renderer.read_float(render_with_reference(renderer, scene, s, request, cache, workers).visibility, 1);
    const SurfaceIds ids = [&] {
        FrameRequest r = asks_for_visibility();
        r.outputs = {.colour = false, .surface_ids = true};
        return renderer.read_surface_ids(renderer.render(scene, s, r).surface_ids);
    }();
    int lit = 0, dark = 0;
    for (int y = 5; y < v.height; y += 17)
        for (int x = 5; x < v.width; x += 17) {
            if (ids.data[std::size_t(y * v.width + x)].x == 0) continue;
            const Probe p = renderer.probe(scene, s, request, x, y);
            ASSERT_EQ(p.lights.size(), 1u);
            EXPECT_EQ(p.lights[0].visibility, v.at(x, y)) << x << ", " << y;
            EXPECT_FALSE(p.lights[0].casts);
            ++(v.at(x, y) < 0.5f ? dark : lit);
        }
    EXPECT_GT(lit, 5);
    EXPECT_GT(dark, 2);
}

// The cause of a pixel without a map follows from the drawn visibility: none where it is right.
TEST_F(SourcesTest, AProbesCauseFollowsFromTheSourcesVisibility) {
    const Scene scene = load_scene("boxes");
    int dark = 0;
    for (const Source& source : sources()) {
        if (source.needs.map) continue;
        SCOPED_TRACE(source.key);
        const Settings s = settings_for(scene, {{"light.source", std::string(source.key)}});
        FrameRequest request = asks_for_visibility();
        render_with_reference(renderer, scene, s, request, cache, workers);
        const ReferenceScene casters(std::make_shared<ReferenceGeometry>(scene, s));
        for (int y = 5; y < request.height; y += 17)
            for (int x = 5; x < request.width; x += 17) {
                const Probe p = renderer.probe(scene, s, request, x, y);
                if (!p.hit) continue;
                const Probe::PerLight& light = p.lights.at(0);
                EXPECT_EQ(light.evidence.visibility, float(light.visibility)) << x << ", " << y;
                const FragmentReference t = trace_fragment_reference(casters, p, light, s, object_traits(scene, s));
                if (t.state != PixelState::Counted) continue;
                const bool right = (light.visibility >= 0.5) == t.lit;
                EXPECT_EQ(t.cause.artefact, right ? Artefact::None : Artefact::NoMap) << x << ", " << y;
                dark += right && !t.lit;
            }
    }
    EXPECT_GT(dark, 2);
}

TEST_F(SourcesTest, MapSettingsAreIdleWithoutAMap) {
    Settings s;
    const auto idle = [&](const char* key) { return std::string(idle_reason(s, *find_setting(key))); };
    const char* const of_maps[] = {"map.resolution", "map.wrap",      "bias.constant", "bias.raster_slope",
                                   "filter.kernel",  "filter.method", "caster.cull"};
    for (const char* key : of_maps) EXPECT_EQ(idle(key).find("light.source"), std::string::npos) << key;
    set_setting(s, "light.source", "none");
    for (const char* key : of_maps) EXPECT_NE(idle(key).find("light.source"), std::string::npos) << key;
    for (const char* key : {"light.fit", "light.projection", "light.near"})
        EXPECT_NE(idle(key).find("light.source"), std::string::npos) << key;
    EXPECT_EQ(idle("light.azimuth"), "");
    EXPECT_EQ(idle("caster.blend"), "");
    s.light_count = 2;
    for (const char* key : of_maps) EXPECT_EQ(idle(key).find("light.source"), std::string::npos) << key;
    EXPECT_NE(idle("light.0.fit").find("light.source"), std::string::npos);
    EXPECT_EQ(idle("light.1.fit"), "");
    s.lights[1].cast = false;
    EXPECT_NE(idle("light.1.source"), "");
}

}  // namespace
}  // namespace si
