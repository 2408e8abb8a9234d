// Tests that maps and casters read by no look-up are skipped, that the picture stays equal, and that readers of whole
// maps get them.
#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/inspect/effects.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/fits.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/traits.h"

namespace si {
namespace {

/// Makes a floor, and a row of balls along x.
Scene row_of_balls() {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    const int ball = add_mesh(scene, "Ball", make_sphere(0.5), grey);
    add_object(scene, "Floor", -1, add_mesh(scene, "Floor", make_plane(40, 40), grey));
    for (int i = -4; i <= 4; ++i) add_object(scene, "Ball", -1, ball, moved(4 * i, 0.5, 0));
    finalise(scene);
    return scene;
}

/// Returns settings of a camera that looks down at a place on the floor.
Sets camera_over(const char* x) {
    return {{"camera.source", "manual"}, {"camera.target_x", x},   {"camera.target_y", "0.5"},
            {"camera.target_z", "0"},    {"camera.distance", "5"}, {"camera.elevation", "40"},
            {"camera.azimuth", "0"}};
}

class ViewOptimisationsTest : public FrameTest {
protected:
    FrameResult frame(const Scene& scene, const Settings& s, FrameRequest request = {.width = 96, .height = 54}) {
        return renderer.render(scene, s, request);
    }
    static std::uint64_t drawn_triangles(const FrameResult& f) {
        const PassInfo& p = map_pass(f);
        return p.state == PassState::Drawn ? p.triangles : 0;
    }
    static FrameRequest cold(OptimisationSet forced = {}) {
        return {.width = 96, .height = 54, .force = true, .forced = forced};
    }
    /// Draws with and without the optimisation. @returns the triangles drawn into maps by each
    std::pair<std::uint64_t, std::uint64_t> expect_one_picture(const Scene& scene, const Settings& s,
                                                               const std::string& what,
                                                               const std::optional<MapCamera>& map_camera = {}) {
        FrameRequest request = cold(), whole = cold({Optimisation::UnreadViews});
        request.map_camera = whole.map_camera = map_camera;
        const FrameResult saved = frame(scene, s, request);
        const std::uint64_t drawn = drawn_triangles(saved);
        const ByteImage picture = renderer.read_colour(saved.colour);
        const FrameResult forced = frame(scene, s, whole);
        EXPECT_EQ(different_pixels(picture, renderer.read_colour(forced.colour)), 0u) << what;
        return {drawn, drawn_triangles(forced)};
    }
};

SI_TESTS_ARE(Repeated, ViewOptimisationsTest);
TEST_F(ViewOptimisationsTest, CastersWithoutVisibleShadowAreNotDrawn) {
    const Scene scene = row_of_balls();
    const std::uint64_t ball = scene.meshes[0].indices.size() / 3;
    for (const Sets& light : {Sets{}, Sets{{"light.type", "spot"}, {"light.distance", "30"}}}) {
        const Settings s = settings_for(scene, joined(camera_over("-16"), light));
        const auto [saved, forced] = expect_one_picture(scene, s, light.empty() ? "directional" : "spot");
        EXPECT_EQ(forced, 9 * ball + 2);
        EXPECT_LE(saved, 3 * ball + 2) << "the camera sees one end of the row";
        EXPECT_GE(saved, ball);
        const FrameResult f = frame(scene, s, cold());
        const PartInfo& part = map_pass(f).parts.at(0);
        EXPECT_EQ(part.by, Optimisation::UnreadViews);
        EXPECT_GE(part.left_out, 6u);
        EXPECT_NE(part.reason.find("camera"), std::string::npos) << part.reason;
    }
}

TEST_F(ViewOptimisationsTest, RunsOfLargeCastersThatShadowNothingVisibleAreNotDrawn) {
    const Scene scene = load_scene("landscape");
    Settings s =
        settings_for(scene, {"light.cascades=1", "camera.source=manual", "camera.elevation=60", "map.resolution=512"});
    s.camera.target_x = scene.bounds.centre().x;
    s.camera.target_y = scene.bounds.hi.y;
    s.camera.target_z = scene.bounds.lo.z;
    s.camera.distance = 0.1 * scene.bounds.radius();
    const auto [saved, forced] = expect_one_picture(scene, s, "landscape");
    EXPECT_GT(saved, 0u);
    EXPECT_LT(double(saved), 0.3 * double(forced)) << "its triangles go row by row along z";
}

TEST_F(ViewOptimisationsTest, FacesReadByNoVisiblePointAreNotDrawn) {
    const Scene scene = row_of_balls();
    const Settings s = settings_for(
        scene,
        joined(camera_over("14"), {{"light.type", "point"}, {"light.distance", "2"}, {"light.elevation", "90"}}));
    const auto [saved, forced] = expect_one_picture(scene, s, "point");
    EXPECT_LT(saved, forced / 2);
    const FrameResult f = frame(scene, s, cold());
    const PassInfo& pass = map_pass(f);
    ASSERT_GE(pass.parts.size(), 6u);
    EXPECT_EQ(pass.parts[0].state, PassState::Drawn) << "face +x holds the visible part";
    EXPECT_EQ(pass.parts[1].state, PassState::Skipped) << "face -x looks the other way";
    EXPECT_EQ(pass.parts[1].draws, 0u);
    EXPECT_EQ(pass.parts[1].by, Optimisation::UnreadViews);
    EXPECT_EQ(pass.parts[2].state, PassState::Skipped) << "nothing is above";
    const Effect unread = effect_named(frame_effects(scene, s, f), "face -x of light 0");
    EXPECT_EQ(unread.state, EffectState::NotNeeded);
    EXPECT_NE(unread.reason.find("camera"), std::string::npos) << unread.reason;
}

TEST_F(ViewOptimisationsTest, CascadesReadByNoVisiblePointAreNotDrawn) {
    // A ball is near the camera and a wall far behind it; between them, outside the picture, balls only cast.
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    const int ball = add_mesh(scene, "Ball", make_sphere(0.5), grey);
    add_object(scene, "Ball", -1, ball, moved(0, 0.5, 0));
    for (const double z : {-20, -30, -40})
        for (const double x : {-60, 60}) add_object(scene, "Ball", -1, ball, moved(x, 0.5, z));
    add_object(scene, "Wall", -1, add_mesh(scene, "Wall", make_box({100, 80, 1}), grey), moved(0, -40, -70));
    finalise(scene);
    const Settings s = settings_for(scene, {{"camera.source", "manual"},
                                            {"camera.target_y", "0.5"},
                                            {"camera.distance", "5"},
                                            {"camera.elevation", "0"},
                                            {"camera.azimuth", "0"},
                                            {"light.azimuth", "30"},
                                            {"light.cascades", "4"},
                                            {"light.split", "uniform"}});
    const auto [saved, forced] = expect_one_picture(scene, s, "cascades");
    EXPECT_LT(saved, forced);
    const FrameResult f = frame(scene, s, cold());
    const PassInfo& pass = map_pass(f);
    std::vector<const PartInfo*> cascades;
    for (const PartInfo& part : pass.parts)
        if (part.name.starts_with("cascade ")) cascades.push_back(&part);
    ASSERT_EQ(cascades.size(), 4u);
    for (const std::size_t between : {1u, 2u}) {
        EXPECT_EQ(cascades[between]->state, PassState::Skipped) << cascades[between]->name;
        EXPECT_EQ(cascades[between]->draws, 0u);
        EXPECT_EQ(cascades[between]->by, Optimisation::UnreadViews);
    }
    EXPECT_EQ(cascades[0]->state, PassState::Drawn) << "it holds the ball";
    EXPECT_EQ(cascades[3]->state, PassState::Drawn) << "it holds the wall";
}

TEST_F(ViewOptimisationsTest, ReceiversThatFaceAwayNeedNoCasters) {
    // A large ball fills the picture; outside the picture many small ones lie between it and the light.
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    add_object(scene, "Large", -1, add_mesh(scene, "Large", make_sphere(2, 160, 80), grey));
    const int ball = add_mesh(scene, "Ball", make_sphere(0.1, 24, 12), grey);
    for (int i = 0; i < 49; ++i)
        add_object(scene, "Ball", -1, ball, moved(0.2 * (i % 7 - 3), 10.6 + 0.2 * (i / 7 - 3), -22.6));
    finalise(scene);
    for (const char* type : {"directional", "spot", "point"})
        for (const bool against : {false, true}) {
            const Settings s = settings_for(scene, {{"camera.source", "manual"},
                                                    {"camera.target_y", "0"},
                                                    {"camera.elevation", against ? "0" : "-10"},
                                                    {"camera.azimuth", against ? "0" : "180"},
                                                    {"camera.distance", "9"},
                                                    {"camera.fov", "24"},
                                                    {"filter.kernel", "pcf3"},
                                                    {"light.type", type},
                                                    {"light.elevation", "25"},
                                                    {"light.azimuth", "180"},
                                                    {"light.distance", "40"}});
            const auto [few, all] = expect_one_picture(scene, s, type);
            if (type != std::string("directional")) continue;  // cells of other light types hold more
            if (against)
                EXPECT_LT(few, all / 2) << "the small ones cover only what faces away from the camera";
            else
                EXPECT_GT(few, all / 2) << "their shadows are visible";
        }
}

TEST_F(ViewOptimisationsTest, FloorsAndWallsThatFaceAwayNeedNoMap) {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    add_object(scene, "Floor", -1, add_mesh(scene, "Floor", make_plane(40, 40), grey), moved(7, 3, -2) * turned(20));
    add_object(scene, "Ball", -1, add_mesh(scene, "Ball", make_sphere(1), grey), moved(67, 2, -2));
    finalise(scene);
    for (const char* type : {"directional", "spot", "point"})
        for (const bool below : {false, true}) {
            const Settings s = settings_for(scene, {{"camera.source", "manual"},
                                                    {"camera.target_x", "7"},
                                                    {"camera.target_y", "3"},
                                                    {"camera.elevation", "40"},
                                                    {"camera.distance", "8"},
                                                    {"light.type", type},
                                                    {"light.fit", "scene"},
                                                    {"light.elevation", below ? "-50" : "50"},
                                                    {"light.distance", "30"}});
            const auto [saved, forced] = expect_one_picture(scene, s, type);
            EXPECT_GT(forced, 0u);
            if (below)
                EXPECT_EQ(saved, 0u) << type << ": no lit side is visible";
            else
                EXPECT_GT(saved, 0u) << type;
        }
}

// A face is chosen by the surface's position for every kernel: also where kernels of moments, or repeating maps, read
// the whole face.
SI_TEST_IS(Later, ViewOptimisationsTest, PicturesAreTheSameFromEveryCamera);
TEST_F(ViewOptimisationsTest, PicturesAreTheSameFromEveryCamera) {
    const Scene scene = row_of_balls();
    const Sets lights[] = {{},
                           {{"light.elevation", "12"}, {"map.wrap", "clamp"}, {"light.fit", "manual"}},
                           {{"light.type", "spot"}, {"map.wrap", "clamp"}, {"light.distance", "4"}},
                           {{"light.type", "spot"}, {"map.wrap", "repeat"}, {"light.elevation", "20"}},
                           {{"light.type", "point"}, {"light.distance", "1.5"}},
                           {{"light.type", "point"}, {"light.range", "6"}, {"map.wrap", "clamp"}},
                           {{"light.cascades", "3"}, {"light.cascade_blend", "0.3"}},
                           {{"light.cascades", "3"}, {"light.fit", "stabilised"}, {"light.cascade_choice", "map"}},
                           {{"light.fit", "lispsm"}}};
    const char* kernels[] = {"pcf5", "pcss", "vsm", "hard"};
    std::uint64_t saved = 0, forced = 0;
    int next = 0;
    std::optional<MapCamera> frozen;
    for (const Sets& light : lights)
        for (const double azimuth : {0.0, 75.0, 200.0}) {
            Settings s = settings_for(scene, joined({{"map.resolution", "256"}, {"bias.normal", "3"}}, light));
            set_setting(s, "filter.kernel", kernels[next++ % 4]);
            CameraSettings& c = s.camera;
            c.source = CameraSource::Manual;
            c.azimuth = azimuth;
            c.elevation = 5 + 0.2 * azimuth;
            c.distance = 2 + 0.03 * azimuth;
            c.target_x = -9 + 0.08 * azimuth;
            c.target_y = 0.5;
            c.target_z = 0.01 * azimuth;
            const std::string what =
                (light.empty() ? std::string("plain") : light.back().second) + ", " + std::to_string(azimuth);
            const auto [few, all] = expect_one_picture(scene, s, what);
            if (!frozen) frozen = MapCamera{frame(scene, s).camera, {}};
            if (fit_reads_camera(s, 0)) expect_one_picture(scene, s, what + ", maps made for another camera", frozen);
            saved += few;
            forced += all;
        }
    EXPECT_LT(double(saved), 0.85 * double(forced));
}

SI_TEST_IS(Later, ViewOptimisationsTest, UnreadTexelsAreNotBlurred);
TEST_F(ViewOptimisationsTest, UnreadTexelsAreNotBlurred) {
    const Scene scene = row_of_balls();
    const auto unread = [](const FrameResult& f, std::string_view name) {
        std::uint64_t count = 0;
        for (const PartInfo& part : f.pass(name)->parts)
            count += part.by == Optimisation::UnreadViews ? part.left_out : 0;
        return count;
    };
    const Sets kinds[] = {{{"filter.kernel", "esm"}, {"filter.blur_shape", "gaussian"}},
                          {{"filter.kernel", "evsm4"}, {"map.samples", "4"}},
                          {{"filter.kernel", "msm_hausdorff"}, {"light.type", "spot"}, {"light.distance", "30"}},
                          {{"map.blur_texels", "3"}, {"filter.kernel", "pcf3"}},
                          {{"map.blur_texels", "2"}, {"map.format", "colour"}}};
    for (const Sets& kind : kinds) {
        const Settings s = settings_for(scene, joined(camera_over("-16"), joined(kind, {{"map.resolution", "512"}})));
        const std::string_view pass = kind[0].first == "filter.kernel" ? "moments" : "depth blur";
        expect_one_picture(scene, s, kind[0].second);
        const std::uint64_t left_out = unread(frame(scene, s, cold()), pass);
        EXPECT_GT(left_out, 512u * 512u / 2) << kind[0].second << ": the camera sees one end of the row";
        EXPECT_LT(left_out, 512u * 512u) << kind[0].second;
        EXPECT_EQ(unread(frame(scene, s, cold({Optimisation::UnreadViews})), pass), 0u) << kind[0].second;
    }
    for (const Sets& whole :
         {Sets{{"filter.kernel", "vsm"}, {"filter.mips", "true"}}, Sets{{"filter.kernel", "savsm"}}}) {
        const Settings s = settings_for(scene, joined(camera_over("-16"), whole));
        EXPECT_EQ(unread(frame(scene, s, cold()), "moments"), 0u) << "each is made of all of a map";
    }
}

TEST_F(ViewOptimisationsTest, AMovingCameraDrawsEachMapOnce) {
    const Scene scene = row_of_balls();
    const Sets point = {{"light.type", "point"}, {"light.distance", "2"}, {"map.resolution", "128"}};
    // The last two kernels preprocess whole maps.
    for (const Sets& light : {Sets{}, point, joined(point, {{"filter.kernel", "vsm"}}),
                              Sets{{"filter.kernel", "vogel"}, {"filter.taps", "64"}, {"map.resolution", "256"}}}) {
        Settings s = settings_for(scene, joined(camera_over("-16"), light));
        const std::uint64_t first = drawn_triangles(frame(scene, s));
        EXPECT_EQ(drawn_triangles(frame(scene, s)), 0u);
        s.camera.azimuth += 0.2;
        EXPECT_EQ(drawn_triangles(frame(scene, s)), 0u) << "what was drawn for the last step holds this one's";
        std::uint64_t orbit = 0;
        int redrawn = 0;
        for (int i = 0; i < 12; ++i) {
            s.camera.target_x = -16 + 32 * (i % 2);
            s.camera.azimuth += 30;
            const FrameResult f = frame(scene, s);
            const ByteImage kept = renderer.read_colour(f.colour);
            const std::uint64_t drawn = drawn_triangles(f);
            redrawn += drawn > 0;
            orbit += drawn;
            EXPECT_EQ(map_pass(f).state, drawn > 0 ? PassState::Drawn : PassState::Cached);
            Renderer other;
            EXPECT_EQ(different_pixels(kept, other.read_colour(other.render(scene, s, cold()).colour)), 0u) << i;
        }
        const std::size_t views = frame(scene, s).lights[0].views.size();
        EXPECT_LE(redrawn, int(views)) << "each map draws its missing part once";
        const std::uint64_t all = drawn_triangles(frame(scene, s, cold({Optimisation::UnreadViews})));
        EXPECT_LE(first + orbit, 2 * all);
    }
}

TEST_F(ViewOptimisationsTest, AnOrbitOverCompleteMapsDrawsNone) {
    const Scene scene = row_of_balls();
    for (const Sets& light : {Sets{}, Sets{{"light.type", "point"}}, Sets{{"filter.kernel", "vsm"}}}) {
        Settings s = settings_for(scene, joined(camera_over("-16"), light));
        FrameRequest whole{.width = 96, .height = 54};
        whole.outputs.shadow_map = true;
        EXPECT_GT(drawn_triangles(frame(scene, s, whole)), 0u);
        for (int i = 0; i < 12; ++i) {
            s.camera.azimuth += 30;
            s.camera.target_x += 2;
            const FrameResult f = frame(scene, s);
            EXPECT_EQ(map_pass(f).state, PassState::Cached);
            if (const PassInfo* moments = f.pass("moments")) {
                EXPECT_NE(moments->state, PassState::Drawn);
            }
        }
    }
}

TEST_F(ViewOptimisationsTest, ReadersOfWholeMapsGetThemWhole) {
    const Scene scene = row_of_balls();
    for (const Sets& light : {Sets{}, Sets{{"light.type", "point"}, {"light.distance", "2"}}}) {
        const Settings s = settings_for(scene, joined(camera_over("-16"), joined({{"map.resolution", "128"}}, light)));
        FrameRequest whole = cold();
        whole.outputs = {.colour = false, .shadow_map = true};
        const FrameResult all = frame(scene, s, whole);
        std::vector<std::vector<float>> maps;
        for (std::size_t v = 0; v < all.lights[0].views.size(); ++v)
            maps.push_back(renderer.read_shadow_map(all, 0, int(v)).data);
        const auto expect_whole = [&](const Settings& shown, FrameRequest request, const char* what) {
            const FrameResult part = frame(scene, s, cold());
            EXPECT_FALSE(part.maps_are_whole) << what;
            EXPECT_THROW(renderer.read_shadow_map(part, 0, 0), Error) << what;
            const FrameResult f = frame(scene, shown, request);
            EXPECT_TRUE(f.maps_are_whole) << what;
            EXPECT_EQ(map_pass(f).reason.find("more texels of it are needed"), 0u)
                << what << ": " << map_pass(f).reason;
            for (std::size_t v = 0; v < maps.size(); ++v)
                EXPECT_EQ(renderer.read_shadow_map(f, 0, int(v)).data, maps[v]) << what << ", map " << v;
        };
        FrameRequest request{.width = 96, .height = 54};
        const auto asks = [&](bool Outputs::*output, const char* what) {
            FrameRequest r = request;
            r.outputs.*output = true;
            expect_whole(s, r, what);
        };
        asks(&Outputs::shadow_map, "shadow map");
        asks(&Outputs::texels_read, "texels read");
        asks(&Outputs::unfiltered_map, "unfiltered map");
        asks(&Outputs::evidence, "evidence");
        Settings shown = s;
        set_setting(shown, "view.overlay", "stored-depth");
        expect_whole(shown, request, "overlay");
        shown = s;
        set_setting(shown, "view.slabs", "both");
        expect_whole(shown, request, "slabs");
        frame(scene, s, cold());
        const Probe probe = renderer.probe(scene, s, {.width = 96, .height = 54}, 48, 27);
        EXPECT_TRUE(probe.hit);
        EXPECT_TRUE(frame(scene, s).maps_are_whole) << "a probe reads the map, and the map is cached";
    }
}

/// Settings under which a light's maps are not needed, and the reason.
struct UnneededMaps {
    Sets sets;
    const char* reason;
};

TEST_F(ViewOptimisationsTest, AnUnusedLightHasNoMapAndReportsTheReason) {
    const Scene scene = row_of_balls();
    const UnneededMaps all[] = {
        {{{"light.intensity", "0"}}, "intensity"},
        {{{"light.red", "0"}, {"light.green", "0"}, {"light.blue", "0"}}, "colour"},
        {{{"camera.target_y", "500"}}, "camera sees nothing"},
        {{{"light.type", "point"}, {"light.range", "3"}, {"light.distance", "2"}, {"light.target_x", "15"}}, "range"},
        {{{"light.type", "spot"},
          {"light.distance", "3"},
          {"light.elevation", "90"},
          {"light.target_x", "15"},
          {"light.range", "10"}},
         "range and cone"},
    };
    for (const UnneededMaps& u : all) {
        const Settings s = settings_for(scene, joined(camera_over("-16"), u.sets));
        const auto [saved, forced] = expect_one_picture(scene, s, u.reason);
        EXPECT_EQ(saved, 0u) << u.reason;
        EXPECT_GT(forced, 0u) << u.reason;
        for (const bool again : {false, true}) {
            const FrameResult f = frame(scene, s);
            EXPECT_EQ(map_pass(f).state, PassState::Skipped) << again;
            EXPECT_EQ(map_pass(f).draws, 0u);
            EXPECT_NE(map_pass(f).reason.find(u.reason), std::string::npos) << map_pass(f).reason;
        }
        // Visibility differs: on request it has a map, unless nothing is visible.
        FrameRequest asked{.width = 96, .height = 54};
        asked.outputs.visibility = true;
        const FrameResult f = frame(scene, s, asked);
        const std::vector<float> found = renderer.read_float(f.visibility, 1).data;
        Renderer other;
        asked.forced = {Optimisation::UnreadViews};
        EXPECT_EQ(found, other.read_float(other.render(scene, s, asked).visibility, 1).data) << u.reason;
    }
}

}  // namespace
}  // namespace si
