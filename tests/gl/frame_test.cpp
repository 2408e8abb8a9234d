// Tests one frame as a function: equal inputs give equal bytes, alternative paths give one picture, and the plan is
// correct.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "renderer/reference/reference_picture.h"
#include "renderer/render/reference_frames.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/overlays.h"
#include "renderer/view/cameras/make_camera.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/combinations.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si {
namespace {

double shadowed_share(const FloatImage& visibility) {
    const auto dark = std::count_if(visibility.data.begin(), visibility.data.end(), [](float v) { return v < 0.5f; });
    return double(dark) / double(visibility.data.size());
}

TEST_F(FrameTest, EqualInputsGiveEqualBytesInAnotherRenderer) {
    const Scene scene = load_scene("stage");
    const Settings s = settings_for(scene);
    const ByteImage first = picture(scene, s);
    FrameRequest again = small_request();
    again.force = true;
    EXPECT_EQ(first.data, picture(scene, s, again).data);
    {
        HeadlessContext other_context;
        Renderer other;
        EXPECT_EQ(first.data, other.read_colour(other.render(load_scene("stage"), s, small_request()).colour).data);
    }
    context.make_current();
}

SI_TEST_IS(Repeated, FrameTest, FusedAndSeparateVisibilityGiveOnePicture);
TEST_F(FrameTest, FusedAndSeparateVisibilityGiveOnePicture) {
    for (const char* name : {"stage", "boxes"}) {
        const Scene scene = load_scene(name);
        for (const char* light : {"directional", "spot", "point"}) {
            Settings s = settings_for(scene, {{"light.type", light}});
            const ByteImage fused = picture(scene, s);
            s.shading.separate_visibility = true;
            const FrameResult separate = renderer.render(scene, s, small_request());
            ASSERT_NE(separate.pass("visibility"), nullptr);
            EXPECT_EQ(separate.pass("visibility")->state, PassState::Drawn);
            // Not one pixel may differ by more than the rounding of one 8-bit step.
            EXPECT_EQ(different_pixels(fused, renderer.read_colour(separate.colour), 1), 0u) << name << " " << light;
        }
    }
}

SI_TEST_IS(Repeated, FrameTest, GatherAndShadowSamplerGiveOnePicture);
SI_TEST_IS(Slow, FrameTest, GatherAndShadowSamplerGiveOnePicture);
TEST_F(FrameTest, GatherAndShadowSamplerGiveOnePicture) {
    const Scene scene = load_scene("stage");
    for (const Filter& filter : filters()) {
        Settings s = settings_for(scene, {{"filter.kernel", std::string(filter.key)}, "filter.method=gather"});
        const FloatImage gather = visibility(scene, s);
        set_setting(s, "filter.method", "sampler");
        // The two paths round texture coordinates differently, so a fragment on a texel border may choose the other
        // texel.
        EXPECT_LE(differing_values(gather, visibility(scene, s), 1e-3f), gather.data.size() / 1000) << filter.key;
        EXPECT_GT(shadowed_share(gather), 0.02) << filter.key;
    }
}

SI_TEST_IS(Repeated, FrameTest, GatherAndShadowSamplerGiveOnePictureOutsideTheMapsRange);
// Depths past the far and before the near plane: a fixed-point format's sampler clamps the compared depth, a float's
// does not.
SI_TEST_IS(Later, FrameTest, GatherAndShadowSamplerGiveOnePictureOutsideTheMapsRange);
TEST_F(FrameTest, GatherAndShadowSamplerGiveOnePictureOutsideTheMapsRange) {
    const Scene scene = load_scene("boxes");
    for (const char* format : {"d16", "d24", "d32f"})
        for (const char* reversed : {"false", "true"})
            for (const char* compare : {"less", "lequal"})
                for (const char* kernel : {"hard", "pcf3"}) {
                    SCOPED_TRACE(testing::Message()
                                 << format << " reversed " << reversed << " " << compare << " " << kernel);
                    Settings s = settings_for(scene, {{"filter.kernel", kernel},
                                                      {"map.format", format},
                                                      {"map.reversed_z", reversed},
                                                      {"map.compare", compare},
                                                      "map.far_guard=false",
                                                      "map.wrap=clamp",
                                                      "map.resolution=256"});
                    set_all(s, {"light.fit=manual", "light.distance=20"});
                    // The far plane cuts through the scene, or the near plane lies behind it.
                    for (const bool behind : {false, true}) {
                        s.lights[0].near = behind ? 24 : 1;
                        s.lights[0].far = behind ? 60 : 20;
                        set_setting(s, "filter.method", "gather");
                        const FloatImage gather = visibility(scene, s);
                        set_setting(s, "filter.method", "sampler");
                        EXPECT_LE(differing_values(gather, visibility(scene, s), 1e-3f), gather.data.size() / 1000)
                            << (behind ? "before the near plane" : "beyond the far plane");
                    }
                }
}

TEST_F(FrameTest, WiderKernelsSoftenMore) {
    const Scene scene = load_scene("boxes");
    std::size_t previous = 0;
    for (const char* kernel : {"hard", "hw2x2", "pcf3", "pcf5", "pcf7", "pcf9"}) {
        const Settings s = settings_for(
            scene, {{"filter.kernel", kernel}, "map.resolution=512", "bias.kind=constant", "bias.normal=8"});
        const std::size_t grey = values_between(visibility(scene, s), 0.01f, 0.99f);
        if (std::string_view(kernel) == "hard") {
            EXPECT_EQ(grey, 0u);
        } else {
            EXPECT_GT(grey, previous) << kernel;
        }
        previous = grey;
    }
}

/// Fixture that draws frames under choices of the settings that select programs.
class ProgramsTest : public FrameTest {
protected:
    std::vector<const Param*> rows;
    ProgramsTest() {
        for (const Param& p : params())
            if (p.shader && p.cost == Cost::Program && p.scope == Scope::Scene) rows.push_back(&p);
    }
    static int choices(const Param* p) { return p->choices ? int(p->choices().size()) : 2; }
    void draw(const Scene& scene, std::initializer_list<std::pair<const Param*, int>> chosen) {
        FrameRequest request{.width = 32, .height = 18, .outputs = {.colour = true, .shadow_map = true}};
        Settings s = settings_for(scene, {"map.resolution=16", "filter.kernel=hard"});
        std::string what;
        for (const auto& [p, v] : chosen) {
            set_value(s, {p, 0, {}}, p->choices ? Value(v) : Value(v != 0));
            what += fmt::format("{} {} ", p->key, v);
        }
        ASSERT_NO_THROW(renderer.render(scene, s, request)) << what;
    }
};

SI_TESTS_ARE(DriverIndependent, ProgramsTest);
SI_TESTS_ARE(Repeated, ProgramsTest);
SI_TEST_IS(Slow, ProgramsTest, EveryChoiceCompiles);
TEST_F(ProgramsTest, EveryChoiceCompiles) {
    ASSERT_GE(rows.size(), 8u);
    const Scene stage = load_scene("stage");  // masked, textured and plain materials
    for (const Param* p : rows)
        for (int i = 0; i < choices(p); ++i) draw(stage, {{p, i}});
}

// Each choice of each row under some choice of each other row.
TEST_F(ProgramsTest, PairsOfChoicesCompile) {
    if (!std::getenv("SI_LONG"))
        GTEST_SKIP() << "tests/glsl compiles these texts; the driver compiles them too with SI_LONG=1";
    const Scene boxes = load_scene("boxes");
    for (std::size_t a = 0; a < rows.size(); ++a)
        for (std::size_t b = a + 1; b < rows.size(); ++b)
            for (int i = 0; i < std::max(choices(rows[a]), choices(rows[b])); ++i)
                draw(boxes, {{rows[a], i % choices(rows[a])}, {rows[b], (i + int(a)) % choices(rows[b])}});
}

SI_TEST_IS(DriverIndependent, FrameTest, EveryOverlayDrawsEveryLightTypeWithEitherPath);
SI_TEST_IS(Repeated, FrameTest, EveryOverlayDrawsEveryLightTypeWithEitherPath);
SI_TEST_IS(Product, FrameTest, EveryOverlayDrawsEveryLightTypeWithEitherPath);
SI_TEST_IS(Slow, FrameTest, EveryOverlayDrawsEveryLightTypeWithEitherPath);
TEST_F(FrameTest, EveryOverlayDrawsEveryLightTypeWithEitherPath) {
    const Scene scene = load_scene("stage");
    ReferenceCache references;
    // Overlays meet alternating lights and paths; in the full product all of them.
    const std::vector<std::pair<const char*, const char*>> ways = {{"directional", "false"}, {"spot", "true"},
                                                                   {"point", "false"},       {"directional", "true"},
                                                                   {"spot", "false"},        {"point", "true"}};
    std::vector<std::tuple<const Overlay*, const char*, const char*>> cases;
    for (std::size_t i = 0; i < overlays().size(); ++i)
        for (const auto& [light, path] : test::portion(ways, ways.size(), i))
            cases.emplace_back(&overlays()[i], light, path);
    for (const auto& [row, light, separate] : cases) {
        const Overlay& overlay = *row;
        const bool pages = overlay.key.starts_with("page-");  // whole maps have none of these
        const Settings s = settings_for(scene, {{"view.overlay", std::string(overlay.key)},
                                                {"light.type", light},
                                                {"shading.separate_visibility", separate},
                                                {"map.virtual", pages ? "true" : "false"},
                                                {"map.resolution", "256"}});
        FrameRequest request{.width = 64, .height = 36};
        request.outputs.overlay = true;
        const FrameResult f = render_with_reference(renderer, scene, s, request, references);
        const FloatImage values = renderer.read_float(f.overlay, 4);
        std::size_t drawn = 0, infinite = 0;
        for (std::size_t i = 0; i < values.data.size(); i += 4) {
            drawn += values.data[i + 3] > 0;
            infinite += std::isinf(values.data[i]);
        }
        const bool finds_faults =
            overlay.key == "non-finite" || overlay.key == "outside-map" || overlay.key == "invalid-moments";
        EXPECT_FALSE(f.panes.front().lacks_reference) << overlay.key;
        if (overlay.key != "artefacts") {
            EXPECT_EQ(drawn > 0, !finds_faults) << overlay.key << " " << light;
        }
        EXPECT_EQ(infinite, 0u) << overlay.key;
    }
}

TEST_F(FrameTest, OverlayChangesThePictureAndItsOpacityMatters) {
    const Scene scene = load_scene("boxes");
    const ByteImage plain = picture(scene, settings_for(scene));
    const ByteImage full = picture(scene, settings_for(scene, {"view.overlay=n-dot-l"}));
    const ByteImage none = picture(scene, settings_for(scene, {"view.overlay=n-dot-l", "view.overlay_opacity=0"}));
    EXPECT_GT(different_pixels(plain, full), plain.data.size() / 4 / 3);
    EXPECT_EQ(different_pixels(plain, none), 0u);
}

TEST_F(FrameTest, PlanCachesUnchangedPassesAndRunsTheOthers) {
    const Scene scene = load_scene("boxes");
    Settings s = settings_for(scene);
    FrameRequest request = small_request({.shadow_map = true});
    using Names = std::set<std::string>;
    Names reused;
    const auto ran = [&] {
        Names out;
        reused.clear();
        for (const PassInfo& p : renderer.render(scene, s, request).passes) {
            if (p.state == PassState::Drawn) out.insert(p.name);
            if (p.state == PassState::Cached) reused.insert(p.name);
        }
        return out;
    };
    const std::string map = "shadow map 0 (directional)", shading = "shading (with visibility)", viewer = "map viewer";
    EXPECT_EQ(ran(), (Names{map, shading, viewer}));
    EXPECT_EQ(ran(), Names{});
    EXPECT_EQ(reused, (Names{map, shading, viewer}));
    s.bias.normal += 0.5;
    EXPECT_EQ(ran(), Names{shading});
    s.lights[0].azimuth += 1;
    EXPECT_EQ(ran(), (Names{map, shading, viewer}));
    s.camera = manual_camera(scene, s);
    s.camera.azimuth += 3;
    EXPECT_EQ(ran(), Names{shading});
    s.view.map_fit = true;
    EXPECT_EQ(ran(), (Names{"drawn depth range", viewer}));
    set_setting(s, "view.map", "raw");
    EXPECT_EQ(ran(), Names{viewer}) << "the range of what is drawn is the same for every way to show it";
    set_setting(s, "view.overlay", "visibility");
    const Names overlaid = {"visibility", "shading (reads visibility)", "overlay values", "overlay over picture"};
    EXPECT_EQ(ran(), overlaid);
    EXPECT_EQ(ran(), Names{});
    s.view.overlay_opacity = 0.5;
    EXPECT_EQ(ran(), Names{"overlay over picture"});
    set_all(s, {"view.panes=four", "view.overlay_3=n-dot-l", "view.overlay_4=n-dot-l"});
    EXPECT_EQ(ran(), (Names{"overlay values (n-dot-l)", "overlay over picture (n-dot-l)"}))
        << "drawn once for two panes";
    EXPECT_EQ(ran(), Names{});
    set_setting(s, "view.slabs", "both");
    EXPECT_EQ(ran(), (Names{"stored-depth quads", "stored-depth quads (none)", "stored-depth quads (n-dot-l)"}));
    EXPECT_TRUE(reused.contains("camera depth")) << "the shading pass left it";
    renderer.probe(scene, s, request, 100, 100);
    EXPECT_EQ(ran(), Names{}) << "a probe leaves the picture's depth alone";
    set_setting(s, "view.slabs_texels", "8");
    EXPECT_EQ(ran(), (Names{"stored-depth quads", "stored-depth quads (none)", "stored-depth quads (n-dot-l)"}));
    request.outputs.map_coordinates = true;
    EXPECT_EQ(ran(), Names{"map coordinates"});
    set_setting(s, "view.map_source", "camera");
    EXPECT_EQ(ran(), (Names{"drawn depth range", viewer}));
    s.lights[0].cast = false;
    const FrameResult dark = renderer.render(scene, s, request);
    EXPECT_EQ(dark.passes[0].state, PassState::Skipped);
    EXPECT_EQ(dark.passes[0].draws, 0u);
    EXPECT_EQ(dark.passes[0].reason, "light.cast is off");
    request.outputs = {.colour = false};
    for (const PassInfo& p : renderer.render(scene, s, request).passes) {
        EXPECT_EQ(p.state, PassState::Skipped) << p.name;
        EXPECT_FALSE(p.reason.empty()) << p.name;
    }
}

/// Returns everything a frame shows: the panes, the map viewer's picture, and the read texels.
std::vector<ByteImage> pictures(const Scene& scene, const Settings& s, FrameRequest request, Renderer& renderer) {
    request.outputs.shadow_map = request.outputs.map_coordinates = true;
    const FrameResult f = renderer.render(scene, s, request);
    std::vector<ByteImage> out;
    for (const Pane& pane : f.panes) out.push_back(renderer.read_colour(pane.picture));
    for (const Image& image : {f.map_view, f.map_coordinates})
        if (image.texture) out.push_back(renderer.read_colour(image));
    return out;
}

SI_TEST_IS(Repeated, FrameTest, SkippingAndCachingChangeNoPixel);
SI_TEST_IS(Later, FrameTest, SkippingAndCachingChangeNoPixel);
TEST_F(FrameTest, SkippingAndCachingChangeNoPixel) {
    const Scene scene = load_scene("stage");
    for (const auto& extra :
         std::vector<Sets>{{},
                           {"light.cast=false"},
                           {"view.overlay=visibility"},
                           {"light.type=spot"},
                           {"camera.source=light", "light.type=point"},
                           {"view.slabs=both", "view.map_source=camera"},
                           {"view.panes=four", "view.overlay_2=n-dot-l", "view.overlay_range=fitted"}}) {
        const Settings s = settings_for(scene, extra);
        FrameRequest all = small_request();
        all.force = true;
        all.forced = OptimisationSet::all();
        EXPECT_EQ(pictures(scene, s, small_request(), renderer), pictures(scene, s, all, renderer));
        FrameRequest timed = small_request();
        timed.timing = timed.force = true;
        EXPECT_EQ(picture(scene, s).data, picture(scene, s, timed).data);
    }
}

void expect_cached_as_fresh(HeadlessContext& context, Renderer& renderer, const Scene& scene, Settings s,
                            const Sets& walk) {
    for (const auto& [key, value] : walk) {
        set_setting(s, key, value);
        const auto cached = pictures(scene, s, {.width = 320, .height = 180}, renderer);
        {
            HeadlessContext fresh_context;
            Renderer fresh;
            const auto expected = pictures(scene, s, {.width = 320, .height = 180}, fresh);
            ASSERT_EQ(cached.size(), expected.size());
            for (std::size_t i = 0; i < cached.size(); ++i)
                EXPECT_EQ(different_pixels(cached[i], expected[i]), 0u)
                    << "picture " << i << " after " << key << " = " << value;
        }
        context.make_current();
    }
}

SI_TEST_IS(DriverIndependent, FrameTest, CachedPicturesEqualFreshOnesAlongAWalkThroughSettings);
SI_TEST_IS(Repeated, FrameTest, CachedPicturesEqualFreshOnesAlongAWalkThroughSettings);
SI_TEST_IS(Slow, FrameTest, CachedPicturesEqualFreshOnesAlongAWalkThroughSettings);
TEST_F(FrameTest, CachedPicturesEqualFreshOnesAlongAWalkThroughSettings) {
    const Scene scene = load_scene("stage");
    expect_cached_as_fresh(context, renderer, scene, settings_for(scene),
                           {"map.resolution=512",
                            "filter.kernel=hard",
                            "light.azimuth=100",
                            {"object.Stage/Ground.receive", "false"},
                            "caster.cull=front",
                            "map.reversed_z=true",
                            "light.type=point",
                            "shading.separate_visibility=true",
                            "light.count=2",
                            "light.1.elevation=70",
                            "map.format=colour",
                            "shading.textures=false",
                            "camera.source=manual",
                            "view.overlay=light-uv",
                            "light.count=1",
                            "map.format=d24"});
}

SI_TEST_IS(DriverIndependent, FrameTest, CachedPicturesEqualFreshOnesAlongAWalkThroughViews);
SI_TEST_IS(Repeated, FrameTest, CachedPicturesEqualFreshOnesAlongAWalkThroughViews);
SI_TEST_IS(Later, FrameTest, CachedPicturesEqualFreshOnesAlongAWalkThroughViews);
TEST_F(FrameTest, CachedPicturesEqualFreshOnesAlongAWalkThroughViews) {
    const Scene scene = load_scene("boxes");
    expect_cached_as_fresh(context, renderer, scene, settings_for(scene, {"map.resolution=256"}),
                           {"camera.source=light",       "view.slabs=stored",      "bias.kind=constant",
                            "bias.constant=2",           "view.slabs=both",        "bias.unit=metres",
                            "light.elevation=60",        "view.panes=two",         "view.overlay_2=own-depth",
                            "view.overlay_range=fitted", "view.map_source=camera", "view.map_fit=true",
                            "camera.source=auto",        "view.map=raw",           "view.overlay_2=overdraw",
                            "view.overlay=wireframe",    "view.map_source=light",  "map.reversed_z=true",
                            "view.slabs_u=0.4",          "view.slabs=none"});
}

TEST_F(FrameTest, CullingAndPerObjectExceptionsActOnTheMap) {
    const Scene scene = load_scene("boxes");
    FrameRequest request = small_request({.colour = false, .shadow_map = true});
    const auto sum = [&](const Settings& s) {
        const FloatImage map = renderer.read_shadow_map(renderer.render(scene, s, request), 0, 0);
        double total = 0;
        for (const float d : map.data) total += d;
        return total / double(map.data.size());
    };
    Settings s = settings_for(scene, {"map.resolution=256"});
    const double none = sum(s);
    set_setting(s, "caster.cull", "front");
    const double front = sum(s);
    EXPECT_GT(front, none + 1e-3);  // only back sides remain, and the one-sided floor is missing
    set_setting(s, "object.Boxes/Floor.cull", "none");
    EXPECT_LT(sum(s), front - 1e-3);  // the exception brings the floor back
    set_setting(s, "object.Boxes/Floor.cast", "false");
    EXPECT_GT(sum(s), none);
}

TEST_F(FrameTest, TheFitIgnoresObjectsThatNoLongerCast) {
    const Scene scene = load_scene("boxes");
    Settings s = settings_for(scene);
    EXPECT_TRUE(renderer.render(scene, s, small_request()).lights.at(0).casts);
    for (const Object& o : scene.objects) s.objects[scene.nodes[std::size_t(o.node)].path].cast = false;
    const FittedLight none = renderer.render(scene, s, small_request()).lights.at(0);
    EXPECT_FALSE(none.casts);
    EXPECT_EQ(none.reason, "no object casts");
    s.objects.begin()->second.cast = true;
    EXPECT_TRUE(renderer.render(scene, s, small_request()).lights.at(0).casts);
    for (auto& [path, object] : s.objects) {
        object.cast = true;
        object.receive = false;
    }
    EXPECT_EQ(renderer.render(scene, s, small_request()).lights.at(0).reason, "no object receives shadows");
}

SI_TEST_IS(Repeated, FrameTest, ProbeAgreesWithTheVisibilityPicture);
SI_TEST_IS(Slow, FrameTest, ProbeAgreesWithTheVisibilityPicture);
TEST_F(FrameTest, ProbeAgreesWithTheVisibilityPicture) {
    const Scene scene = load_scene("stage");
    for (const char* light : {"directional", "spot", "point"}) {
        const Settings s = settings_for(scene, {{"light.type", light}});
        FrameRequest request = small_request({.colour = false, .visibility = true});
        const FloatImage v = renderer.read_float(renderer.render(scene, s, request).visibility, 1);
        int hits = 0, dark = 0;
        for (int y = 5; y < 180; y += 17)
            for (int x = 3; x < 320; x += 23) {
                const Probe p = renderer.probe(scene, s, request, x, y);
                if (!p.hit) continue;
                ++hits;
                ASSERT_EQ(p.lights.size(), 1u);
                // The probe draws with a shifted viewport, whose rounding moves a bilinear weight in its last digits.
                EXPECT_NEAR(p.lights[0].visibility, v.at(x, y), 2e-4) << x << "," << y;
                dark += p.lights[0].visibility < 0.5;
                EXPECT_FALSE(p.lights[0].verdict.empty());
                EXPECT_FALSE(p.object.empty());
            }
        EXPECT_GT(hits, 40);
        EXPECT_GT(dark, 3);
        EXPECT_LT(dark, hits);
    }
}

TEST_F(FrameTest, MapViewerShowsTheMap) {
    const Scene scene = load_scene("boxes");
    FrameRequest request = small_request({.colour = false, .shadow_map = true});
    for (const char* format : {"d16", "d24", "d32f", "colour"})
        for (const char* reversed : {"false", "true"}) {
            const Settings s = settings_for(
                scene, {{"map.format", format}, {"map.reversed_z", reversed}, "map.resolution=128", "view.map=raw"});
            const FrameResult f = renderer.render(scene, s, request);
            const ByteImage shown = renderer.read_colour(f.map_view);
            const FloatImage stored = renderer.read_shadow_map(f, 0, 0);
            ASSERT_EQ(shown.width, 128);
            for (int y = 0; y < 128; y += 7)
                for (int x = 0; x < 128; x += 7)
                    EXPECT_NEAR(shown.data[std::size_t(y * 128 + x) * 4], stored.at(x, y) * 255, 1.0);
        }
}

}  // namespace
}  // namespace si
