// Compares shadow volumes with rays, pixel by pixel, for many positions of light, camera and scene.
#include "renderer/passes/shadow_volumes.h"

#include <algorithm>
#include <cmath>

#include "renderer/reference/reference_picture.h"
#include "renderer/render/reference_frames.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si {
namespace {

/// Returns the scene with masked materials made opaque, as volumes treat them.
Scene solid(Scene scene) {
    for (Material& m : scene.materials)
        if (m.alpha == AlphaMode::Mask) m.alpha = AlphaMode::Opaque;
    refresh(scene);
    return scene;
}

Scene moved_by(Scene scene, const glm::dvec3& by) {
    for (Node& node : scene.nodes)
        if (node.parent < 0) node.local[3] += glm::dvec4(by, 0);
    for (SceneCamera& camera : scene.cameras) camera.world[3] += glm::dvec4(by, 0);
    refresh(scene);
    return scene;
}

struct Compared {
    std::size_t dark = 0;        ///< pixels in shadow in the reference, among those that face the light
    std::size_t off = 0;         ///< differing pixels
    std::size_t off_inside = 0;  ///< differing pixels without an edge within a pixel
    std::size_t pixels = 0;
    int x = -1, y = -1;  ///< position of the last differing pixel away from edges
};

class ShadowVolumesTest : public FrameTest {
protected:
    ReferenceCache cache;
    FrameRequest request{.width = 480, .height = 270, .outputs = {.colour = false, .visibility = true}};

    /// Compares drawn visibility with rays. Edges are those of the reference and of visible triangles: at an edge a
    /// pixel's centre may lie on either side.
    Compared compare(const Scene& scene, Settings s) {
        set_setting(s, "light.source", "volumes-zfail");
        const FrameResult frame = renderer.render(scene, s, request);
        for (const std::string& note : frame.notes) ADD_FAILURE() << note;
        const FloatImage v = renderer.read_float(frame.visibility, 1);
        const ReferenceTask task = reference_task(renderer, scene, s, request, 0, {.nearest = false});
        const std::shared_ptr<const Reference> reference = cache.trace(task, {.threads = 2}).reference;
        Compared c{.pixels = v.data.size()};
        for (int y = 0; y < v.height; ++y)
            for (int x = 0; x < v.width; ++x) {
                const float t = reference->visibility.at(x, y);
                c.dark += t < 0.5f && reference->state[std::size_t(y * v.width + x)] == PixelState::Counted;
                EXPECT_TRUE(v.at(x, y) == 0 || v.at(x, y) == 1);
                if (v.at(x, y) == t) continue;
                ++c.off;
                bool edge = false;
                const auto triangle = [&](int i, int j) {
                    return task.ids.data[std::size_t(j) * std::size_t(v.width) + std::size_t(i)];
                };
                for (int j = std::max(y - 1, 0); j <= std::min(y + 1, v.height - 1); ++j)
                    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, v.width - 1); ++i)
                        edge |= reference->visibility.at(i, j) != t || triangle(i, j) != triangle(x, y);
                if (!edge) {
                    ++c.off_inside;
                    c.x = x;
                    c.y = y;
                }
            }
        return c;
    }
    /// Expects visibility to equal that of rays. @param inside accepted differing pixels away from edges
    void expect_exact(const Scene& scene, const Settings& s, std::size_t least_dark, std::size_t inside = 0) {
        const Compared c = compare(scene, s);
        EXPECT_LE(double(c.off), 1e-4 * double(c.pixels));
        EXPECT_LE(c.off_inside, inside) << "such as " << c.x << ", " << c.y;
        EXPECT_GE(c.dark, least_dark);
        std::printf("%6zu dark, %zu off\n", c.dark, c.off);
    }
};

SI_TESTS_ARE(Repeated, ShadowVolumesTest);
SI_TEST_IS(Later, ShadowVolumesTest, AreExactOverScenesAndLights);
TEST_F(ShadowVolumesTest, AreExactOverScenesAndLights) {
    for (const char* name : {"boxes", "stage", "teapot", "figures", "plane", "relief"}) {
        const Scene scene = solid(load_scene(name));
        for (const char* type : {"directional", "spot", "point"})
            for (const auto& [azimuth, elevation] : {std::pair{"-40", "38"}, {"0", "90"}, {"90", "30"}}) {
                SCOPED_TRACE(testing::Message() << name << " " << type << " " << azimuth << " " << elevation);
                expect_exact(scene,
                             settings_for(scene, {{"light.type", type},
                                                  {"light.azimuth", azimuth},
                                                  {"light.elevation", elevation},
                                                  "volumes.allow_large=true"}),
                             std::string(name) == "plane" || std::string(name) == "relief" ? 0 : 100);
            }
    }
}

// Z-pass counts are equal for all cameras outside of volumes. Within a volume they swap light and shadow.
TEST_F(ShadowVolumesTest, ZPassFailsWithTheCameraInside) {
    const auto differing = [&](const Scene& scene, Settings s) {
        FloatImage v[2];
        for (const int which : {0, 1}) {
            set_setting(s, "light.source", which ? "volumes-zpass" : "volumes-zfail");
            const FrameResult frame = renderer.render(scene, s, request);
            EXPECT_TRUE(frame.notes.empty());
            v[which] = renderer.read_float(frame.visibility, 1);
        }
        std::size_t n = 0;
        for (std::size_t i = 0; i < v[0].data.size(); ++i) n += v[0].data[i] != v[1].data[i];
        return double(n) / double(v[0].data.size());
    };
    for (const glm::dvec3& by : {glm::dvec3(0), glm::dvec3(1e4, -3e3, 1e4)}) {
        const Scene boxes = moved_by(solid(load_scene("boxes")), by);
        for (const char* type : {"directional", "spot", "point"})
            EXPECT_LT(differing(boxes, settings_for(boxes, {{"light.type", type}})), 1e-4) << type;
    }
    // The camera is under a sheet with the sun straight above, then outside the sheet's shadow.
    const Scene sheet = test::floor_under_sheet({});
    Settings s = settings_with(test::hard_settings(), {"light.elevation=90", "camera.target_y=0.5",
                                                       "camera.elevation=10", "camera.distance=1.2"});
    EXPECT_GT(differing(sheet, s), 0.5);
    set_all(s, {"camera.distance=8", "camera.elevation=30"});
    EXPECT_LT(differing(sheet, s), 1e-4);
}

TEST_F(ShadowVolumesTest, AreExactTenKilometresFromTheOrigin) {
    const Scene scene = moved_by(solid(load_scene("boxes")), {1e4, -3e3, 1e4});
    for (const char* type : {"directional", "spot", "point"}) {
        SCOPED_TRACE(type);
        expect_exact(scene, settings_for(scene, {{"light.type", type}}), 500);
    }
}

/// Makes a room with a hole in its roof, a table and a lamp post, on a floor outside the room.
Scene room(bool inside_out) {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    scene.materials[std::size_t(grey)].double_sided = true;
    Mesh walls = make_box({6, 3, 6});
    if (inside_out)
        for (std::size_t i = 0; i + 2 < walls.indices.size(); i += 3)
            std::swap(walls.indices.edit()[i], walls.indices.edit()[i + 1]);
    add_object(scene, "walls", -1, add_mesh(scene, "walls", walls, grey), moved(0, 1.5, 0));
    add_object(scene, "table", -1, add_mesh(scene, "table", make_box({1.5, 0.1, 1}), grey), moved(0.5, 0.8, -1));
    add_object(scene, "sheet", -1, add_mesh(scene, "sheet", make_plane(1, 1), grey), moved(-1, 1.7, -0.5));
    add_object(scene, "floor", -1, add_mesh(scene, "floor", make_plane(30, 30), grey), moved(0, -0.01, 0));
    finalise(scene);
    return scene;
}

// The camera is within volumes and closed surfaces: under a roof everything is dark, and a lamp inside lights the
// room.
TEST_F(ShadowVolumesTest, AreExactWithTheCameraInside) {
    for (const bool inside_out : {false, true}) {
        const Scene scene = room(inside_out);
        const Sets camera = {"camera.source=manual", "camera.target_x=0", "camera.target_y=-0.4",
                             "camera.target_z=-1",   "camera.azimuth=20", "camera.elevation=10",
                             "camera.distance=3",    "camera.fov=70"};
        for (const auto& light :
             std::vector<Sets>{{"light.type=directional"},
                               {"light.type=directional", "light.elevation=90"},
                               {"light.type=point", "light.distance=1.1", "light.elevation=60"},
                               {"light.type=spot", "light.distance=1.3", "light.elevation=90", "light.cone=150"},
                               {"light.type=point", "light.distance=20"}}) {
            auto all = camera;
            all.insert(all.end(), light.begin(), light.end());
            SCOPED_TRACE(testing::Message() << inside_out << " " << light[0].second << " " << light.back().second);
            expect_exact(scene, settings_for(scene, all), 1000);
        }
    }
    // The camera is in the shadow of a box, close enough for the near plane to cut its volume.
    const Scene boxes = load_scene("boxes");
    for (const char* elevation : {"5", "20", "60"}) {
        SCOPED_TRACE(elevation);
        expect_exact(boxes,
                     settings_for(boxes, {"light.azimuth=180",
                                          {"light.elevation", elevation},
                                          "camera.source=manual",
                                          "camera.azimuth=0",
                                          "camera.elevation=3",
                                          "camera.distance=4",
                                          "camera.near=0.4"}),
                     100);
    }
}

// Casters past the far plane and behind the camera still cast, also in orthographic views.
TEST_F(ShadowVolumesTest, AreExactAtTheNearAndFarPlanes) {
    const Scene scene = load_scene("boxes");
    for (const char* type : {"directional", "point"})
        for (const char* parallel : {"false", "true"})
            for (const auto& [near, far] : {std::pair{"0", "9"}, {"7", "0"}, {"0", "0"}})
                for (const char* azimuth : {"-150", "60"}) {
                    SCOPED_TRACE(testing::Message() << type << " " << parallel << " " << near << " " << far);
                    expect_exact(scene,
                                 settings_for(scene, {{"light.type", type},
                                                      {"light.azimuth", azimuth},
                                                      "light.elevation=25",
                                                      "camera.source=manual",
                                                      {"camera.orthographic", parallel},
                                                      "camera.distance=8",
                                                      "camera.azimuth=35",
                                                      "camera.elevation=25",
                                                      {"camera.near", near},
                                                      {"camera.far", far}}),
                                 50);
                }
}

// Light along the view direction: its shadows end in one point of the picture.
TEST_F(ShadowVolumesTest, AreExactAlongTheView) {
    const Scene scene = load_scene("boxes");
    for (const char* parallel : {"false", "true"})
        for (const auto& [azimuth, elevation, camera_azimuth, camera_elevation] : {std::array{"35", "25", "35", "25"},
                                                                                   {"215", "10", "35", "25"},
                                                                                   {"0", "0", "0", "0"},
                                                                                   {"180", "0", "0", "0"},
                                                                                   {"0", "90", "0", "90"},
                                                                                   {"0", "90", "0", "0"}}) {
            SCOPED_TRACE(testing::Message() << parallel << " " << azimuth << " " << elevation << " " << camera_azimuth);
            expect_exact(scene,
                         settings_for(scene, {{"light.azimuth", azimuth},
                                              {"light.elevation", elevation},
                                              "camera.source=manual",
                                              {"camera.orthographic", parallel},
                                              {"camera.azimuth", camera_azimuth},
                                              {"camera.elevation", camera_elevation}}),
                         0, 1);  // a volume's side is a line in the picture there, and a pixel may lie on it
        }
}

TEST_F(ShadowVolumesTest, ObjectsThatDoNotCastOrReceiveAreLeftOut) {
    const Scene scene = load_scene("boxes");
    Settings s = settings_for(scene);
    const std::size_t all = compare(scene, s).dark;
    for (const Node& node : scene.nodes)
        if (node.path.find("Floor") == std::string::npos) s.objects[node.path].cast = false;
    EXPECT_LT(compare(scene, s).dark, all / 4);
    EXPECT_EQ(compare(scene, s).off, 0u);
    s.objects.clear();
    for (const Node& node : scene.nodes)
        if (node.path.find("Floor") != std::string::npos) s.objects[node.path].receive = false;
    EXPECT_LE(compare(scene, s).off, 10u);
    s.objects.clear();
    set_setting(s, "caster.cull", "front");
    EXPECT_EQ(compare(scene, s).dark, all) << "culling is of maps";
}

TEST_F(ShadowVolumesTest, LightsMayMixVolumesAndMaps) {
    const Scene scene = load_scene("boxes");
    Settings s =
        settings_for(scene, {"light.count=3", "light.0.source=volumes-zfail", "light.1.type=spot", "light.1.azimuth=70",
                             "light.2.type=point", "light.2.azimuth=140", "light.2.source=volumes-zfail"});
    const auto layer = [&](const Settings& of, int light) {
        Settings shown = of;
        shown.view.light = light;
        return renderer.read_float(renderer.render(scene, shown, request).visibility, 1).data;
    };
    for (const int light : {0, 1, 2}) {
        Settings alone = s;
        for (int i = 0; i < 3; ++i)
            if (i != light) alone.lights[std::size_t(i)].cast = false;
        EXPECT_EQ(layer(s, light), layer(alone, light)) << light;
    }
    EXPECT_NE(layer(s, 0), layer(s, 2));
}

// The plan reports each pass, its reason and its costs; unchanged results are cached.
TEST_F(ShadowVolumesTest, ThePlanRunsAndCachesThem) {
    const Scene scene = load_scene("boxes");
    Settings s = settings_for(scene, {"light.source=volumes-zfail"});
    FrameRequest colour = small_request();
    FrameResult f = renderer.render(scene, s, colour);
    const auto state = [&](const char* name) { return f.pass(name)->state; };
    EXPECT_EQ(f.passes[0].state, PassState::Skipped);
    EXPECT_EQ(f.passes[0].reason, "light.source is volumes-zfail, which needs no map");
    EXPECT_EQ(state("shadow volumes 0"), PassState::Drawn);
    EXPECT_EQ(f.pass("shadow volumes 0")->category, PassCategory::Maps) << "shadows' cost";
    EXPECT_EQ(state("camera depth"), PassState::Drawn);
    EXPECT_NE(f.pass("shading (reads visibility)"), nullptr);
    f = renderer.render(scene, s, colour);
    EXPECT_EQ(state("shadow volumes 0"), PassState::Cached);
    s.shading.ambient = 0.5;
    f = renderer.render(scene, s, colour);
    EXPECT_EQ(state("shadow volumes 0"), PassState::Cached);
    s.lights[0].azimuth += 1;
    f = renderer.render(scene, s, colour);
    EXPECT_EQ(state("shadow volumes 0"), PassState::Drawn);
    const ByteImage kept = renderer.read_colour(f.colour);
    colour.force = true;
    colour.forced = OptimisationSet::all();
    EXPECT_EQ(kept.data, picture(scene, s, colour).data);
    set_setting(s, "light.source", "map");
    EXPECT_EQ(renderer.render(scene, s, small_request()).pass("shadow volumes 0"), nullptr);
}

// Scenes with too many open triangles draw no volumes without consent: the light has no shadow, and the plan and a
// note report the cost.
TEST_F(ShadowVolumesTest, LargeVolumesNeedConsent) {
    const Scene scene =
        test::grey_scene({{"floor", make_plane(10, 10)}, {"sheet", make_plane(2, 2, 101, 100), moved(0, 1, 0)}});
    Settings s = settings_for(scene, {"light.source=volumes-zfail"});
    FrameResult f = renderer.render(scene, s, request);
    EXPECT_EQ(f.pass("shadow volumes 0")->state, PassState::Skipped);
    ASSERT_EQ(f.notes.size(), 1u);
    EXPECT_EQ(f.notes[0], f.pass("shadow volumes 0")->reason);
    for (const char* part : {"20202 triangles", "more than 20000", "volumes.allow_large", "cover the picture about"})
        EXPECT_NE(f.notes[0].find(part), std::string::npos) << f.notes[0];
    const FloatImage lit = renderer.read_float(f.visibility, 1);
    EXPECT_EQ(std::count(lit.data.begin(), lit.data.end(), 0.f), 0);
    s.volumes.allow_large = true;
    expect_exact(scene, s, 500);
    s.volumes.allow_large = false;
    s.objects[scene.nodes[1].path].cast = false;
    EXPECT_TRUE(renderer.render(scene, s, request).notes.empty());
}

}  // namespace
}  // namespace si
