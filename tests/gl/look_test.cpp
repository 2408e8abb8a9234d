// Tests that the look (sky, ambient light, tone curve, smoothing of static views) changes no measured number.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/editor/frame_loop.h"
#include "app/report/picture_comparison.h"
#include "app/session/session.h"
#include "renderer/inspect/effects.h"
#include "renderer/scenes/shapes.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/lights/sky.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"
#include "tests/support/shared_models.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class LookTest : public FrameTest {
protected:
    static Settings plain(const Settings& s) {
        return settings_with(s, {"shading.sky=plain", "shading.curve=plain", "shading.exposure=0"});
    }
    static glm::ivec3 pixel(const ByteImage& image, int x, int y) {
        const std::uint8_t* p = &image.data[4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x))];
        return {p[0], p[1], p[2]};
    }
    static int brightest(const ByteImage& image) {
        int most = 0;
        for (std::size_t i = 0; i < image.data.size(); ++i)
            most = i % 4 == 3 ? most : std::max(most, int(image.data[i]));
        return most;
    }
};

SI_TESTS_ARE(Repeated, LookTest);
SI_TEST_IS(Later, LookTest, VisibilityHasTheSameBytesWithAndWithoutTheLook);
TEST_F(LookTest, VisibilityHasTheSameBytesWithAndWithoutTheLook) {
    for (const BuiltinScene& row : builtin_scenes()) {
        SCOPED_TRACE(row.key);
        const Scene scene = row.make();
        Settings on = settings_for(scene, {"map.resolution=512"});
        on.shading.exposure = 1;
        FrameRequest request{.width = 96, .height = 54, .outputs = {.visibility = true}};
        FrameRequest smooth = request;
        smooth.smoothed = kMaxSmoothedShadings;
        const FrameResult drawn = renderer.render(scene, on, smooth);
        const FloatImage visibility = renderer.read_float(drawn.visibility, 1);
        const ByteImage picture = renderer.read_colour(drawn.colour);
        const FrameResult bare = renderer.render(scene, plain(on), request);
        EXPECT_EQ(bare.pass("visibility")->state, PassState::Cached) << "it does not even have to be drawn again";
        EXPECT_GT(different_pixels(picture, renderer.read_colour(bare.colour)), 1000u);
        request.force = true;
        const FloatImage again = renderer.read_float(renderer.render(scene, plain(on), request).visibility, 1);
        EXPECT_TRUE(again.data == visibility.data);
    }
}

// The look "studio" and tinted overlays are drawn on request only, and only into pictures.
SI_TEST_IS(Later, LookTest, StudioAndTintChangeNoNumberAndNoMask);
TEST_F(LookTest, StudioAndTintChangeNoNumberAndNoMask) {
    const Scene scene = load_scene("stage");
    Settings s = settings_for(scene, {"map.resolution=512", "view.overlay=cascade", "light.cascades=3", "light.count=1",
                                      "view.panes=two", "view.overlay_2=stored-depth", "view.map_fit=true"});
    FrameRequest request = small_request(
        {.shadow_map = true, .visibility = true, .overlay = true, .surface_ids = true, .map_coordinates = true});
    request.force = true;
    struct Drawn {
        FloatImage visibility, overlay, coordinates, map;
        SurfaceIds ids;
        ByteImage colour, map_view;
    };
    const auto draw = [&](const Settings& settings, bool with_look) {
        request.with_look = with_look;
        const FrameResult f = renderer.render(scene, settings, request);
        return Drawn{renderer.read_float(f.visibility, 1),
                     f.overlay.texture ? renderer.read_float(f.overlay, 4) : FloatImage(),
                     renderer.read_float(f.map_coordinates, 4),
                     renderer.read_shadow_map(f, 0, 0),
                     renderer.read_surface_ids(f.surface_ids),
                     renderer.read_colour(f.colour),
                     renderer.read_colour(f.map_view)};
    };
    for (const char* overlay : {"none", "cascade"}) {
        SCOPED_TRACE(overlay);
        set_setting(s, "view.overlay", overlay);
        const Drawn plain_one = draw(s, false), look = draw(s, true);
        EXPECT_EQ(differing_values(look.visibility, plain_one.visibility), 0u);
        EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(look.overlay.data)),
                                       std::as_bytes(std::span(plain_one.overlay.data))));
        EXPECT_EQ(differing_values(look.coordinates, plain_one.coordinates), 0u);
        EXPECT_EQ(differing_values(look.map, plain_one.map), 0u);
        EXPECT_TRUE(look.ids.data == plain_one.ids.data);
        for (std::size_t i = 0; i < look.map_view.data.size(); ++i) {
            if (look.map_view.data[i | 3] == 0) continue;  // an empty texel, which the viewer hatches
            ASSERT_EQ(look.map_view.data[i], plain_one.map_view.data[i]) << "byte " << i;
        }
        EXPECT_GT(different_pixels(look.colour, plain_one.colour, 2), 400u) << "the picture has the look";
        Settings off = s;
        off.view.look = Look::Plain;
        off.view.overlay_blend = OverlayBlend::Flat;
        EXPECT_EQ(draw(off, true).colour, plain_one.colour) << "switched off";
    }
}

TEST_F(LookTest, PicturesThatAreMeasuredArePlain) {
    const Scene scene = load_scene("boxes");
    const Settings s = settings_for(scene, {"map.resolution=256"});
    FrameRequest request = small_request();
    request.with_look = true;
    const FrameResult shown = renderer.render(scene, s, request);
    EXPECT_TRUE(shown.contacts_darkened);
    const ByteImage with = renderer.read_colour(shown.colour);
    request.outputs.true_colour = true;
    const FrameResult compared = renderer.render(scene, s, request);
    EXPECT_FALSE(compared.contacts_darkened) << "its partner by the reference has no look";
    const ByteImage without = renderer.read_colour(compared.colour);
    EXPECT_EQ(without, picture(scene, s));
    EXPECT_GT(different_pixels(with, without), 100u);
    Settings flip = s;
    set_setting(flip, "view.panes", "two");
    set_setting(flip, "view.overlay_2", "flip-difference");
    request.outputs.true_colour = false;
    EXPECT_FALSE(renderer.render(scene, flip, request).contacts_darkened) << "FLIP reads the shaded picture";
}

// Contact darkening multiplies the picture: it never brightens, leaves open ground alone, and darkens the crease
// between a box and the floor, also on lit pixels.
TEST_F(LookTest, ContactDarkeningDarkensCreasesOnly) {
    const Scene scene = load_scene("boxes");
    const Settings s = settings_for(scene, {"light.cast=false"});
    FrameRequest request = small_request();
    const ByteImage before = picture(scene, s, request);
    request.with_look = true;
    const ByteImage after = picture(scene, s, request);
    std::size_t brighter = 0, darker = 0, much = 0;
    for (std::size_t i = 0; i < before.data.size(); i += 4) {
        const int change = int(after.data[i]) - int(before.data[i]);
        brighter += change > 0;
        darker += change < -2;
        much += change < -20;
    }
    const std::size_t pixels = before.data.size() / 4;
    EXPECT_EQ(brighter, 0u);
    EXPECT_GT(much, pixels / 500) << "creases";
    EXPECT_LT(darker, pixels / 4) << "open ground stays";
}

// Tinted overlays keep the legend's colour where the picture is bright, and are darker where it is dark.
TEST_F(LookTest, TintKeepsTheLegendsColourOnLitSurfaces) {
    const Scene scene = load_scene("boxes");
    Settings s = settings_for(scene, {"map.resolution=256"});
    s.view.look = Look::Plain;  // its darkened creases tint the overlay, too
    FrameRequest request = small_request();
    const ByteImage shaded = picture(scene, s, request);
    set_setting(s, "view.overlay", "cascade");
    const ByteImage flat = picture(scene, s, request);
    request.with_look = true;
    const FrameResult frame = renderer.render(scene, s, request);
    EXPECT_TRUE(frame.panes[0].tinted);
    const ByteImage tinted = renderer.read_colour(frame.colour);
    std::size_t lit = 0, dark = 0;
    for (std::size_t i = 0; i < flat.data.size(); i += 4) {
        const double bright =
            (0.2126 * shaded.data[i] + 0.7152 * shaded.data[i + 1] + 0.0722 * shaded.data[i + 2]) / 255;
        if (flat.data[i] == shaded.data[i] && flat.data[i + 2] == shaded.data[i + 2]) continue;  // no surface
        const double share = double(tinted.data[i + 2]) / flat.data[i + 2];
        if (bright > 0.51) {
            ++lit;
            EXPECT_NEAR(share, 1, 0.01);
        } else if (bright < 0.35) {
            ++dark;
            EXPECT_LT(share, 0.9);
            EXPECT_GT(share, 0.4) << "the colour can still be told";
        }
    }
    EXPECT_GT(lit, 100u);
    EXPECT_GT(dark, 100u);
    set_setting(s, "view.overlay", "artefacts");
    EXPECT_FALSE(renderer.render(scene, s, request).panes[0].tinted) << "causes lie on a grey picture";
}

// The ground added to a loaded model belongs to the look: the model's own pixels stay unchanged.
SI_TEST_IS(Later, LookTest, AModelHasTheSameVisibilityWithAndWithoutTheLook);
TEST_F(LookTest, AModelHasTheSameVisibilityWithAndWithoutTheLook) {
    std::vector<std::string> files{""};
    for (const test::SharedModel& model : test::shared_models()) {
        const std::string name = model.file.filename().string();
        if (name == "Suzanne.gltf" || name == "Fox.glb") files.push_back(model.file.string());
    }
    for (const std::string& file : files) {
        SCOPED_TRACE(file);
        const auto open = [&](const char* ground) {
            std::vector<std::string> sets{"map.resolution=512", "camera.index=-1",
                                          std::string("scene.ground=") + ground};
            // Other fits cover boxes that shadow each other only in the caster region, unless there is a ground.
            if (file.empty()) sets.emplace_back("light.fit=scene");
            if (!file.empty()) return open_session({.scene = file, .sets = sets});
            Scene scene;
            const int mesh = add_mesh(scene, "box", make_box({1, 2, 1.5}), add_material(scene, "grey", {1, 1, 1}));
            add_object(scene, "box", -1, mesh, turned(20));
            add_object(scene, "lid", -1, mesh, moved(0.4, 1.8, 0.2) * turned(50));
            finalise(scene);
            scene.file_scenes = {""};  // marks the scene as loaded from a file
            return compose_session(plan_session({.scene = "a file", .sets = sets}), std::move(scene));
        };
        const Session with = open("auto"), without = open("off");
        ASSERT_FALSE(with.scene.ground_bounds.empty());
        ASSERT_TRUE(without.scene.ground_bounds.empty());
        Settings on = with.settings;
        on.shading.exposure = 1;
        on.camera = manual_camera(with.scene, with.settings, 16.0 / 9);
        FrameRequest request = small_request({.visibility = true, .surface_ids = true});
        request.force = true;
        struct Drawn {
            FloatImage visibility;
            SurfaceIds ids;
        };
        const auto draw = [&](const Session& session, bool look, int smoothed) {
            Settings s = look ? on : plain(on);
            s.scene = session.settings.scene;
            request.smoothed = smoothed;
            const FrameResult frame = renderer.render(session.scene, s, request);
            return Drawn{renderer.read_float(frame.visibility, 1), renderer.read_surface_ids(frame.surface_ids)};
        };
        const Drawn all = draw(with, true, kMaxSmoothedShadings), none = draw(without, false, 0);
        EXPECT_TRUE(draw(with, false, 0).visibility.data == all.visibility.data) << "sky, tone curve and smoothing";
        EXPECT_TRUE(draw(with, true, 0).visibility.data == all.visibility.data) << "smoothing";
        EXPECT_TRUE(draw(with, false, kMaxSmoothedShadings).visibility.data == all.visibility.data)
            << "sky and tone curve";
        EXPECT_TRUE(draw(without, true, kMaxSmoothedShadings).visibility.data == none.visibility.data)
            << "without a ground";
        std::size_t own = 0, dark = 0, differ = 0;
        for (std::size_t i = 0; i < none.ids.data.size(); ++i) {
            if (none.ids.data[i].x == 0 || none.ids.data[i].x != all.ids.data[i].x) continue;
            ++own;
            dark += none.visibility.data[i] < 0.5f;
            differ += none.visibility.data[i] != all.visibility.data[i];
        }
        EXPECT_GT(own, 1000u);
        EXPECT_GT(dark, own / 50);
        EXPECT_EQ(differ, 0u) << "with all of it and with nothing, of " << own;
    }
}

TEST_F(LookTest, SeveralLightsAreNotOverexposed) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = test::texel_settings("hard", 128, 3);
    s.light_count = 2;
    s.lights[0].intensity = 1.5;
    s.lights[1] = s.lights[0];
    s.lights[1].azimuth += 20;
    const int filmic = brightest(picture(scene, s));
    s.shading.curve = ToneCurve::Plain;
    EXPECT_EQ(brightest(picture(scene, s)), 255);
    EXPECT_LT(filmic, 250);
    EXPECT_GT(filmic, 200);
}

// Under hemispheric ambient light, surfaces turned up are brighter than surfaces turned sideways. Under constant
// ambient light both are equal.
TEST_F(LookTest, ShadowsKeepTheirForm) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = test::texel_settings("hard", 64, 3);
    s.lights[0].intensity = 0;
    const auto tones = [&](const Settings& of) {
        std::vector<int> greens;
        const ByteImage image = picture(scene, of);
        FrameRequest request = small_request({.colour = false, .surface_ids = true});
        const SurfaceIds ids = renderer.read_surface_ids(renderer.render(scene, of, request).surface_ids);
        for (std::size_t i = 0; i < ids.data.size(); ++i)
            if (ids.data[i].x == 2) greens.push_back(image.data[4 * i + 1]);  // pixels of the box
        std::ranges::sort(greens);
        return greens;
    };
    const std::vector<int> formed = tones(s), flat = tones(plain(s));
    ASSERT_GT(formed.size(), 100u);
    EXPECT_GT(formed.back() - formed.front(), 12);
    EXPECT_LE(flat.back() - flat.front(), 1);
}

// Brightness is that of encoded values, as an eye sees it.
TEST_F(LookTest, TheStageIsNeitherTooDarkNorOverexposed) {
    const Scene scene = load_scene("stage");
    const Settings s = settings_for(scene);
    FrameRequest request{.width = 480, .height = 270, .outputs = {.visibility = true, .surface_ids = true}};
    const FrameResult frame = renderer.render(scene, s, request);
    const ByteImage image = renderer.read_colour(frame.colour);
    const FloatImage visibility = renderer.read_float(frame.visibility, 1);
    const SurfaceIds ids = renderer.read_surface_ids(frame.surface_ids);
    double sum = 0, clipped = 0, lit = 0, dark = 0, lit_count = 0, dark_count = 0;
    for (std::size_t i = 0; i < ids.data.size(); ++i) {
        const std::uint8_t* p = &image.data[4 * i];
        const double luma = (0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]) / 255;
        sum += luma;
        clipped += std::max({p[0], p[1], p[2]}) == 255;
        if (ids.data[i].x == 0 || scene.nodes[std::size_t(scene.objects[ids.data[i].x - 1].node)].name != "Ground")
            continue;
        if (visibility.data[i] > 0.99f) {
            lit += luma;
            ++lit_count;
        }
        if (visibility.data[i] < 0.01f) {
            dark += luma;
            ++dark_count;
        }
    }
    const double count = double(ids.data.size());
    EXPECT_GT(sum / count, 0.35);
    EXPECT_LT(sum / count, 0.6);
    EXPECT_LE(clipped / count, 0.01);
    ASSERT_GT(dark_count, 1000);
    EXPECT_GE(lit / lit_count, 1.8 * (dark / dark_count));
}

TEST_F(LookTest, TheSkyFollowsTheSunAndFillsOnlyBackgroundPixels) {
    const Scene scene = load_scene("stage");
    Settings s = settings_for(scene, {"map.resolution=256"});
    const ByteImage high = picture(scene, s);
    EXPECT_GT(std::abs(pixel(high, 4, 2).z - pixel(high, 4, 70).z), 5) << "a gradient";
    EXPECT_GT(pixel(high, 4, 2).z, pixel(high, 4, 2).x) << "and a blue one";
    s.lights[0].elevation = 3;
    const ByteImage low = picture(scene, s);
    EXPECT_GT(pixel(low, 4, 70).x - pixel(low, 4, 70).z, pixel(high, 4, 70).x - pixel(high, 4, 70).z + 10)
        << "a low sun is warm at the horizon";
    const ByteImage none = picture(scene, plain(s));
    EXPECT_EQ(pixel(none, 4, 2), pixel(none, 4, 30));
}

TEST_F(LookTest, ExposureCountsInPowersOfTwo) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = settings_with(test::texel_settings("hard", 64, 3),
                               {"shading.specular=0", "shading.sky=plain", "shading.exposure=1"});
    const ByteImage exposed = picture(scene, s);
    s.shading.exposure = 0;
    s.lights[0].intensity *= 2;
    s.shading.ambient *= 2;
    EXPECT_LE(different_pixels(exposed, picture(scene, s), 1), 3u);
}

TEST_F(LookTest, AStaticViewIsSmoothedOverCachedMaps) {
    const Scene scene = load_scene("boxes");
    const Settings s = settings_for(scene, {"map.resolution=512"});
    FrameRequest request = small_request();
    const FrameResult first = renderer.render(scene, s, request);
    const ByteImage as_drawn = renderer.read_colour(first.colour);
    EXPECT_EQ(first.smooth.texture, 0u) << "smoothing was not requested";
    ByteImage one;
    for (request.smoothed = 1; request.smoothed <= kMaxSmoothedShadings; ++request.smoothed) {
        const FrameResult frame = renderer.render(scene, s, request);
        for (const PassInfo& pass : frame.passes)
            EXPECT_EQ(pass.state == PassState::Drawn,
                      pass.name == "smoothing of a static view" ||
                          (request.smoothed == 1 && (pass.name == "visibility" || pass.name == "visible surfaces")))
                << pass.name;
        EXPECT_TRUE(renderer.read_colour(frame.colour).data == as_drawn.data) << "the picture itself stays";
        if (request.smoothed == 1) one = renderer.read_colour(frame.smooth);
    }
    request.smoothed = kMaxSmoothedShadings;
    const ByteImage by_steps = renderer.read_colour(renderer.render(scene, s, request).smooth);
    request.force = true;
    const ByteImage at_once = renderer.read_colour(renderer.render(scene, s, request).smooth);
    EXPECT_TRUE(by_steps.data == at_once.data);
    // Pixels at a surface's edge lie between both sides' values: neighbours differ by less than in a single picture.
    // Edges of shadows stay.
    const auto steepest = [](const ByteImage& image) {
        long steep = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x + 1 < image.width; ++x)
                steep += std::abs(pixel(image, x, y).y - pixel(image, x + 1, y).y) > 40;
        return steep;
    };
    EXPECT_LT(steepest(by_steps), 0.9 * double(steepest(one)));
    EXPECT_GT(different_pixels(one, as_drawn, 20), 20u) << "its camera is turned by part of a pixel";
    // Blue sky and plain ground are the same in all shadings.
    EXPECT_LT(different_pixels(by_steps, as_drawn, 12), by_steps.data.size() / 4 / 8);
}

/// Noise of a kernel and acne are as in the one picture: only edges of surfaces are averaged. Blended surfaces evaluate
/// the kernel in each shading.
TEST_F(LookTest, SmoothingAveragesNoVisibility) {
    const Scene opaque = load_scene("boxes");
    Scene blended = opaque;
    for (Material& m : blended.materials) {
        m.alpha = AlphaMode::Blend;
        m.base_colour.a = 0.999f;
    }
    finalise(blended);
    const Sets noisy{"filter.kernel=vogel", "filter.rotate=true", "filter.taps=4", "filter.radius=6"};
    struct Case {
        const char* name;
        const Scene& scene;
        Sets look;
    };
    for (const Case& c :
         {Case{"noise", opaque, noisy},
          Case{"acne", opaque, {"filter.kernel=hard", "bias.constant=0", "bias.normal=0"}},
          Case{"noise on blended surfaces", blended, joined(noisy, {"caster.blend=mask"})},
          Case{"noise on blended surfaces, parallel camera", blended,
               joined(noisy, {"caster.blend=mask", "camera.source=manual", "camera.orthographic=true"})}}) {
        SCOPED_TRACE(c.name);
        // A face then shows nothing but visibility.
        const Settings s =
            settings_for(c.scene, joined({"map.resolution=512", "shading.specular=0", "shading.sky=plain",
                                          "shading.curve=plain", "bias.kind=constant"},
                                         c.look));
        FrameRequest request = small_request();
        FrameResult frame;
        for (request.smoothed = 1; request.smoothed <= kMaxSmoothedShadings; ++request.smoothed)
            frame = renderer.render(c.scene, s, request);
        const ByteImage one = renderer.read_colour(frame.colour), smooth = renderer.read_colour(frame.smooth);
        const SurfaceIds ids =
            renderer.read_surface_ids(renderer.render(opaque, s, small_request({.surface_ids = true})).surface_ids);
        int inner = 0, differing = 0, steep = 0;
        for (int y = 1; y + 1 < ids.height; ++y)
            for (int x = 1; x + 1 < ids.width; ++x) {
                const auto id = [&](int dx, int dy) { return ids.data[std::size_t((y + dy) * ids.width + x + dx)]; };
                bool same = id(0, 0).x != 0;
                for (int k = 0; k < 9; ++k) same &= id(k % 3 - 1, k / 3 - 1) == id(0, 0);
                if (!same) continue;
                ++inner;
                differing += std::abs(int(pixel(one, x, y).y) - int(pixel(smooth, x, y).y)) > 2;
                steep += std::abs(int(pixel(one, x, y).y) - int(pixel(one, x + 1, y).y)) > 10;
            }
        EXPECT_GT(inner, 20000);
        EXPECT_GT(steep, 300) << "there is noise";
        // Blended surfaces are moved to the static pixel's place: taps at the edge of a texel may round to its
        // neighbour.
        EXPECT_LE(differing, &c.scene == &blended ? inner / 1000 : 0);
    }
}

/// Each shading turns the camera by a fraction of a pixel, for every size and position of the scene.
TEST_F(LookTest, SmoothPicturesShowTheSameSceneAtEverySize) {
    const auto unlike = [&](const char* scale) {
        const Session session =
            open_session({.scene = "stage", .sets = {"map.resolution=256", std::string("scene.scale=") + scale}});
        FrameRequest request{.width = 240, .height = 135};
        const ByteImage plain = renderer.read_colour(renderer.render(session.scene, session.settings, request).colour);
        FrameResult frame;
        for (request.smoothed = 1; request.smoothed <= kMaxSmoothedShadings; ++request.smoothed)
            frame = renderer.render(session.scene, session.settings, request);
        return mean_difference(plain, renderer.read_colour(frame.smooth));
    };
    const double is_unmoved = unlike("1");
    EXPECT_GT(is_unmoved, 0);
    EXPECT_NEAR(unlike("100"), is_unmoved, 0.1 * is_unmoved);
    EXPECT_NEAR(unlike("0.01"), is_unmoved, 0.1 * is_unmoved);
}

TEST_F(LookTest, TheEditorAccumulatesAStaticViewAndThenSleeps) {
    const Scene scene = load_scene("boxes");
    FrameLoop loop(false);
    PictureState state;
    state.settings = settings_for(scene, {"map.resolution=64"});
    EditorRequests requests;
    requests.scene_width = 64;
    requests.scene_height = 36;
    const auto changed = [&] { return loop.update(scene, state, requests, nullptr).changed; };
    const auto shows_smooth = [&] {
        const FrameResult result = loop.facts().result;
        return result.panes.front().picture.texture != result.colour.texture;
    };
    EXPECT_TRUE(changed());
    EXPECT_FALSE(changed()) << "somebody still touches something";
    requests.at_rest = true;
    for (int i = 0; i < kMaxSmoothedShadings; ++i) EXPECT_TRUE(changed()) << i;
    EXPECT_FALSE(changed()) << "it sleeps";
    EXPECT_TRUE(shows_smooth());
    state.settings.camera.source = CameraSource::Manual;
    EXPECT_TRUE(changed());
    EXPECT_FALSE(shows_smooth()) << "what moves is shown as it is drawn";
    EXPECT_TRUE(changed());
    EXPECT_TRUE(shows_smooth());
    set_setting(state.settings, "view.overlay", "visibility");
    while (changed()) {
    }
    EXPECT_FALSE(shows_smooth()) << "an overlay speaks of the one picture";
    set_setting(state.settings, "view.overlay", "none");
    state.settings.view.smooth = false;
    EXPECT_TRUE(changed());
    EXPECT_FALSE(changed()) << "pixels as they are";
    EXPECT_FALSE(shows_smooth());
}

TEST_F(LookTest, ThePlanReportsEachLookPass) {
    const Scene scene = load_scene("boxes");
    const auto told = [&](const Settings& s, std::string_view name) {
        FrameRequest request = small_request();
        request.smoothed = 1;
        request.force = true;
        return effect_named(frame_effects(scene, s, renderer.render(scene, s, request)), name);
    };
    const Settings s = settings_for(scene, {"map.resolution=64"});
    for (const char* name : {"sky and its ambient light", "tone curve", "smoothing of a static view"}) {
        EXPECT_EQ(told(s, name).state, EffectState::Drawn) << name;
        EXPECT_FALSE(told(s, name).reason.empty()) << name;
    }
    EXPECT_EQ(told(plain(s), "sky and its ambient light").state, EffectState::NotNeeded);
    EXPECT_EQ(told(plain(s), "tone curve").state, EffectState::NotNeeded);
    EXPECT_EQ(told(s, "ground").state, EffectState::NotNeeded);
    Settings apart = s;
    apart.lights[0].contact = 0.2;
    EXPECT_EQ(told(apart, "smoothing of a static view").state, EffectState::Drawn) << "contact shadows are kept";
}

TEST(SkyTest, AmbientLightEqualsTheSetting) {
    for (const double sine : {-1.0, -0.1, 0.0, 0.3, 0.7, 1.0}) {
        const Sky sky = sky_for_sun({std::sqrt(1 - sine * sine), sine, 0});
        EXPECT_NEAR(luminance(sky.ambient), 1, 1e-9) << sine;
        EXPECT_GT(sky.rise, 0);
        EXPECT_LT(sky.rise, 1) << "what is turned away is not black";
        EXPECT_GT(luminance(sky.horizon), luminance(sky.zenith));
    }
    EXPECT_GT(luminance(sky_for_sun({0, 1, 0}).zenith), luminance(sky_for_sun({1, 0, 0}).zenith));
}

}  // namespace
}  // namespace si
