// Tests that an opened model shows its shadow, on an added ground or on one that it stands on.
#include "renderer/scene/ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "app/session/session.h"
#include "renderer/base/error.h"
#include "renderer/inspect/texel_usage.h"
#include "renderer/reference/live_error.h"
#include "renderer/reference/reference_geometry.h"
#include "renderer/reference/reference_picture.h"
#include "renderer/render/reference_frames.h"
#include "renderer/scenes/shapes.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/combinations.h"
#include "tests/support/missing_reason.h"
#include "tests/support/shared_models.h"
#include "tests/support/traits.h"

namespace si {
namespace {

Session session_of(Scene scene, std::vector<std::string> sets = {}) {
    sets.insert(sets.begin(), "map.resolution=512");  // pictures here are a fourth of a window's
    scene.file_scenes = {""};                         // marks the scene as loaded from a file
    return compose_session(plan_session({.scene = "a file", .sets = std::move(sets)}), std::move(scene));
}

Scene box_alone() {
    Scene scene;
    scene.name = "box";
    add_object(scene, "box", -1, add_mesh(scene, "box", make_box({1, 2, 1.5}), add_material(scene, "grey", {1, 1, 1})),
               moved(3, 5, -2) * turned(20));
    finalise(scene);
    return scene;
}

/// Makes a model with a flat top and thin casters, so that shadows fall mostly on the ground.
Scene table_alone() {
    Scene scene;
    scene.name = "table";
    const int grey = add_material(scene, "grey", {1, 1, 1});
    add_object(scene, "top", -1, add_mesh(scene, "top", make_plane(2, 1.2), grey), moved(0, 1, 0));
    const int leg = add_mesh(scene, "leg", make_box({0.1, 1, 0.1}), grey);
    for (const double x : {-0.9, 0.9})
        for (const double z : {-0.5, 0.5}) add_object(scene, "leg", -1, leg, moved(x, 0.5, z));
    add_object(scene, "block", -1, add_mesh(scene, "block", make_box({0.3, 0.3, 0.3}), grey), moved(0.3, 1.2, 0.1));
    finalise(scene);
    return scene;
}

/// Model with an added ground, and the same without.
struct GroundedModel {
    std::string name;
    Session with, without;
};
GroundedModel with_and_without_ground(const std::string& name, Scene (*make)()) {
    return {name, session_of(make()), session_of(make(), {"scene.ground=off"})};
}
/// Returns the box, and the real models that exist.
std::vector<GroundedModel> grounded_models() {
    std::vector<GroundedModel> out{with_and_without_ground("box", box_alone)};
    for (const test::SharedModel& model : test::shared_models()) {
        const std::string name = model.file.filename().string();
        if (name != "sunflower.gltf" && name != "GlassVaseFlowers.gltf" && name != "Suzanne.gltf" &&
            name != "living_room.glb")
            continue;
        const std::vector<std::string> sets{"map.resolution=512", "camera.index=-1"};
        std::vector<std::string> off = sets;
        off.push_back("scene.ground=off");
        out.push_back({name, open_session({.scene = model.file.string(), .sets = sets}),
                       open_session({.scene = model.file.string(), .sets = off})});
    }
    return out;
}

/// First picture of a model: its shadow on the added ground or on its own floor.
struct FirstPicture {
    std::size_t ground = 0, dark = 0, dark_at_rim = 0;
    std::size_t surfaces = 0, dark_surfaces = 0;  ///< all visible pixels
    bool own_floor = false;
    double read = 0;  ///< share of the map's texels
};

/// Returns for each object whether it is a floor for shadows: the ground, or a sheet at the bottom that carries the
/// model.
std::vector<bool> floors_of(const Scene& scene) {
    std::vector<bool> floors;
    const glm::dvec3 size = scene.bounds.hi - scene.bounds.lo;
    for (const Object& o : scene.objects) {
        const Bounds own = scene.meshes[std::size_t(o.mesh)].bounds.transformed(o.world);
        const bool flat = own.hi.y - own.lo.y < 0.01 * size.y && own.hi.y < scene.bounds.lo.y + 0.1 * size.y;
        floors.push_back(o.ground ||
                         (flat && own.hi.x - own.lo.x > 0.9 * size.x && own.hi.z - own.lo.z > 0.9 * size.z));
    }
    return floors;
}

class GroundTest : public FrameTest {
protected:
    FirstPicture first_picture(const Session& session) {
        FrameRequest request{.width = 320, .height = 180, .outputs = {.surface_ids = true, .map_coordinates = true}};
        ReferenceCache cache;
        const FrameResult frame = renderer.render(session.scene, session.settings, request);
        const SurfaceIds ids = renderer.read_surface_ids(frame.surface_ids);
        FirstPicture out;
        if (!frame.lights.empty() && frame.lights[0].casts)
            out.read =
                texel_usage(renderer.read_float(frame.map_coordinates, 4), session.settings, frame.map_resolution)
                    .utilisation();
        request.outputs = {.error = true};
        const FrameResult classified = render_with_reference(renderer, session.scene, session.settings, request, cache);
        const Reference& reference = *request.reference->traced.reference;
        const std::vector<bool> floors = floors_of(session.scene);
        out.own_floor = session.scene.ground_bounds.empty() && std::ranges::count(floors, true) > 0;
        for (int y = 0; y < ids.height; ++y)
            for (int x = 0; x < ids.width; ++x) {
                const std::size_t i = std::size_t(y) * std::size_t(ids.width) + std::size_t(x);
                if (ids.data[i].x == 0) continue;
                ++out.surfaces;
                out.dark_surfaces += reference.visibility.data[i] < 0.5f;
                if (!floors[ids.data[i].x - 1]) continue;
                const bool dark = reference.visibility.data[i] < 0.5f;
                ++out.ground;
                out.dark += dark;
                out.dark_at_rim += dark && (x == 0 || y == 0 || x == ids.width - 1 || y == ids.height - 1);
            }
        if (!out.own_floor) {
            EXPECT_EQ(out.ground, classified.error ? classified.error->metrics.ground_pixels : 0);
        }
        return out;
    }
    /// Draws the editor's first view of a dropped file with cameras. Returns a text about the visible shadow.
    std::string picture_by_own_camera(Session& session) {
        const Scene& scene = session.scene;
        session.settings.camera = base_settings(scene).camera;
        const auto [width, height] = std::pair(small_request().width, small_request().height);
        const Camera camera = make_camera(scene, session.settings, double(width) / height);
        EXPECT_EQ(camera.eye, glm::dvec3(scene.cameras[0].world[3])) << "another camera than the file's first";
        const glm::dvec4 middle = camera.project(scene.bounds.centre(), width, height);
        EXPECT_GT(middle.w, 0) << "the scene lies behind it";
        EXPECT_TRUE(middle.x >= 0 && middle.x < width && middle.y >= 0 && middle.y < height)
            << middle.x << ", " << middle.y << ": the scene lies outside its picture";
        const FirstPicture seen = first_picture(session);
        const std::size_t standing = seen.surfaces - seen.ground;
        const std::string text =
            fmt::format("{} of {} pixels show the model, {} its ground or floor; in shadow are {} of these, {} in all",
                        standing, width * height, seen.ground, seen.dark, seen.dark_surfaces);
        EXPECT_GT(standing, std::size_t(width * height) / 50) << text;
        return text;
    }
};

TEST_F(GroundTest, AModelAloneShowsItsShadow) {
    const FirstPicture seen = first_picture(session_of(box_alone()));
    EXPECT_GT(seen.ground, 10000u);
    EXPECT_GE(double(seen.dark), 0.02 * double(seen.ground));
    EXPECT_EQ(seen.dark_at_rim, 0u) << "the shadow's edge is inside the picture";
    EXPECT_GE(seen.read, 0.2);
    EXPECT_EQ(first_picture(session_of(box_alone(), {"scene.ground=off"})).ground, 0u);
}

TEST_F(GroundTest, ReceivesShadowsWithoutCastingOrWideningFits) {
    const Session with = session_of(box_alone()), without = session_of(box_alone(), {"scene.ground=off"});
    ASSERT_FALSE(with.scene.ground_bounds.empty());
    EXPECT_TRUE(without.scene.ground_bounds.empty());
    EXPECT_EQ(with.scene.triangle_count(), without.scene.triangle_count());
    EXPECT_EQ(with.scene.object_count(), without.scene.object_count());
    EXPECT_EQ(with.scene.bounds.lo, without.scene.bounds.lo);
    EXPECT_EQ(with.scene.bounds.hi, without.scene.bounds.hi);
    const Camera camera = make_camera(with.scene, with.settings, 16.0 / 9);
    for (const Choice& fit : find_setting("light.fit")->param->choices())
        for (const char* type : {"directional", "spot", "point"})
            for (const Camera* seen_by : {static_cast<const Camera*>(nullptr), &camera}) {
                SCOPED_TRACE(std::string(fit.key) + " " + type + (seen_by ? " of the picture" : ""));
                Settings s = with.settings;
                set_setting(s, "light.fit", fit.key);
                set_setting(s, "light.type", type);
                const auto a = fit_lights(with.scene, s, seen_by), b = fit_lights(without.scene, s, seen_by);
                EXPECT_LE(a[0].views[0].half_extent(), b[0].views[0].half_extent() * (1 + 1e-9));
            }
    const auto drawn = [&](const Scene& scene) {
        FrameRequest whole = small_request({.shadow_map = true});
        whole.force = true;
        for (const PassInfo& pass : renderer.render(scene, with.settings, whole).passes)
            if (pass.name.starts_with("shadow map 0")) return pass.triangles;
        return std::uint64_t(0);
    };
    EXPECT_EQ(drawn(with.scene), drawn(without.scene)) << "into the map";
    EXPECT_EQ(ReferenceGeometry(with.scene, with.settings).caster_triangles(),
              ReferenceGeometry(without.scene, with.settings).caster_triangles())
        << "in the reference";
    // Under a light from below the box is lit as it is without a ground.
    Settings s = with.settings;
    s.camera = manual_camera(without.scene, without.settings, 16.0 / 9);
    s.lights[0].elevation = -60;
    FrameRequest request = small_request({.visibility = true, .surface_ids = true});
    const auto of_box = [&](const Scene& scene) {
        const FrameResult frame = renderer.render(scene, s, request);
        const SurfaceIds ids = renderer.read_surface_ids(frame.surface_ids);
        FloatImage v = renderer.read_float(frame.visibility, 1);
        for (std::size_t i = 0; i < v.data.size(); ++i)
            if (ids.data[i].x != 1) v.data[i] = -1;
        return v.data;
    };
    const std::vector<float> stood = of_box(with.scene), alone = of_box(without.scene);
    std::size_t box = 0, differ = 0;
    for (std::size_t i = 0; i < alone.size(); ++i) {
        box += alone[i] >= 0;
        differ += stood[i] != alone[i];
    }
    EXPECT_GT(box, 5000u);
    EXPECT_LT(differ, box / 100);
}

// The picture shows the whole model.
TEST_F(GroundTest, KeepsTheExtentOfModelsMaps) {
    for (const GroundedModel& model : grounded_models()) {
        ASSERT_FALSE(model.with.scene.ground_bounds.empty()) << model.name;
        const Camera camera = make_camera(model.with.scene, model.with.settings, 16.0 / 9);
        for (const Choice& fit : find_setting("light.fit")->param->choices()) {
            SCOPED_TRACE(model.name + " " + std::string(fit.key));
            Settings s = model.with.settings;
            set_setting(s, "light.type", "directional");
            set_setting(s, "light.fit", fit.key);
            const auto a = fit_lights(model.with.scene, s, &camera), b = fit_lights(model.without.scene, s, &camera);
            ASSERT_EQ(a[0].views.size(), b[0].views.size());
            const LightView &stands = a[0].views[0], &floats = b[0].views[0];
            EXPECT_LE(stands.half_extent(), floats.half_extent() * (1 + 1e-9));
            EXPECT_NEAR(stands.texel_size_range(512).longest / floats.texel_size_range(512).longest, 1, 1e-9);
            EXPECT_EQ(a[0].closed, b[0].closed);
        }
    }
}

// Depths reach to the end of the shadow, with room for a kernel. Points past a map's far plane are not looked up.
TEST_F(GroundTest, ExtendsMapDepthToTheEndOfTheShadow) {
    const GroundedModel box = with_and_without_ground("box", box_alone);
    const Camera camera = make_camera(box.with.scene, box.with.settings, 16.0 / 9);
    for (const char* fit : {"scene", "casters", "view", "stabilised"}) {
        SCOPED_TRACE(fit);
        Settings s = box.with.settings;
        set_setting(s, "light.fit", fit);
        const FittedLight stands = fit_lights(box.with.scene, s, &camera)[0];
        const FittedLight floats = fit_lights(box.without.scene, s, &camera)[0];
        const auto along = [](const LightView& v, const glm::dvec3& p) { return -glm::dot(v.axes[2], p); };
        const LightView &a = stands.views[0], &b = floats.views[0];
        double shadow_ends = -1e300;
        for (const glm::dvec3& p : box.with.scene.meshes[0].bounds.corners(box.with.scene.objects[0].world)) {
            const double steps = (p.y - box.with.scene.ground_bounds.hi.y) / stands.to_light.y;
            shadow_ends = std::max(shadow_ends, along(a, p - stands.to_light * steps));
        }
        const double begins = along(a, a.eye) + a.curve.near, ends = along(a, a.eye) + a.curve.far;
        EXPECT_NEAR(begins, along(b, b.eye) + b.curve.near, 1e-3 * (ends - begins));
        EXPECT_GT(ends, shadow_ends);
        EXPECT_LT(ends, shadow_ends + 0.05 * (ends - begins));
    }
}

// The whole model is visible, and the map has the same texels.
SI_TEST_IS(Later, GroundTest, KeepsTheVisibilityOfTheModelsPixels);
TEST_F(GroundTest, KeepsTheVisibilityOfTheModelsPixels) {
    for (const GroundedModel& model : grounded_models())
        for (const Choice& fit : find_setting("light.fit")->param->choices()) {
            SCOPED_TRACE(model.name + " " + std::string(fit.key));
            Settings s = model.with.settings;
            set_setting(s, "light.type", "directional");
            set_setting(s, "light.fit", fit.key);
            s.camera = manual_camera(model.with.scene, model.with.settings, 16.0 / 9);
            Settings bare = s;
            bare.scene = model.without.settings.scene;
            FrameRequest request = small_request({.visibility = true, .surface_ids = true});
            const FrameResult stands = renderer.render(model.with.scene, s, request);
            const SurfaceIds ids = renderer.read_surface_ids(stands.surface_ids);
            const FloatImage on = renderer.read_float(stands.visibility, 1);
            const FrameResult floats = renderer.render(model.without.scene, bare, request);
            const SurfaceIds own_ids = renderer.read_surface_ids(floats.surface_ids);
            const FloatImage off = renderer.read_float(floats.visibility, 1);
            std::size_t own = 0, elsewhere = 0, differ = 0;
            for (std::size_t i = 0; i < ids.data.size(); ++i) {
                if (own_ids.data[i].x == 0) continue;
                ++own;
                elsewhere += ids.data[i].x != own_ids.data[i].x;
                differ += ids.data[i].x == own_ids.data[i].x && on.data[i] != off.data[i];
            }
            EXPECT_GT(own, 300u);
            EXPECT_LE(elsewhere, own / 500) << "hidden by the ground, or as deep as something else";
            // Depths of a warped map are divided, and round differently.
            EXPECT_LE(differ, fit.key == "lispsm" ? own / 1000 : 0) << "of " << own;
        }
}

// The picture may show part of the model, with maps for that part or for slices of it.
TEST_F(GroundTest, ShowsACompleteShadowUnderEveryFit) {
    for (const auto& make : {box_alone, table_alone}) {
        const Session session = session_of(make(), {"map.resolution=1024"});
        ASSERT_FALSE(session.scene.ground_bounds.empty());
        const std::size_t ground = session.scene.objects.size();
        for (const double nearer : {1.0, 0.4}) {
            Settings s = session.settings;
            s.camera = manual_camera(session.scene, session.settings, 16.0 / 9);
            s.camera.distance *= nearer;
            FrameRequest request = small_request({.visibility = true, .surface_ids = true});
            const auto visibility = [&](std::string_view fit, const char* cascades) {
                set_setting(s, "light.fit", fit);
                set_setting(s, "light.cascades", cascades);
                return renderer.read_float(renderer.render(session.scene, s, request).visibility, 1);
            };
            const FloatImage whole = visibility("scene", "1");
            const SurfaceIds ids = renderer.read_surface_ids(renderer.render(session.scene, s, request).surface_ids);
            for (const Choice& fit : find_setting("light.fit")->param->choices())
                for (const char* cascades : {"1", "4"}) {
                    SCOPED_TRACE(session.scene.name + " " + std::string(fit.key) + " " + cascades + " from " +
                                 std::to_string(nearer));
                    const FloatImage fitted = visibility(fit.key, cascades);
                    std::size_t dark = 0, lost = 0, lit = 0, made = 0;
                    for (std::size_t i = 0; i < ids.data.size(); ++i) {
                        if (ids.data[i].x != ground) continue;
                        const float was = whole.data[i], is = fitted.data[i];
                        dark += was < 0.01f;
                        lost += was < 0.01f && is > 0.99f;
                        lit += was > 0.99f;
                        made += was > 0.99f && is < 0.01f;
                    }
                    EXPECT_GT(dark, nearer == 1 ? 500u : 50u);
                    EXPECT_LE(lost, dark / 30 + 5);
                    EXPECT_LE(made, lit / 30 + 5);
                }
        }
    }
}

// Visible ground needs shadows of invisible casters. The map grows for those, up to the bounds of its casters.
TEST_F(GroundTest, AMapOfPartOfAModelCoversOnlyItsCasters) {
    const GroundedModel table = with_and_without_ground("table", table_alone);
    Settings s = table.with.settings;
    s.camera = manual_camera(table.with.scene, table.with.settings, 16.0 / 9);
    const auto half_width = [&](const Scene& scene, std::string_view fit, double nearer) {
        Settings t = s;
        t.camera.distance *= nearer;
        set_setting(t, "light.fit", fit);
        const Camera camera = make_camera(scene, t, 16.0 / 9);
        return fit_lights(scene, t, &camera)[0].views[0].half_extent();
    };
    const double margin = 2 * fit_margin_texels(s, 512) / 512;
    const double casters = half_width(table.without.scene, "scene", 1) * (1 - 4.0 / 512) / (1 - margin);
    for (const double nearer : {1.0, 0.6, 0.4, 0.25}) {
        SCOPED_TRACE(nearer);
        EXPECT_LE(half_width(table.with.scene, "view", nearer), casters * (1 + 1e-9));
        EXPECT_LE(half_width(table.with.scene, "casters", nearer), casters * (1 + 1e-9));
    }
}

/// Models that differ from the others, with the reason.
constexpr std::pair<std::string_view, std::string_view> kOthers[] = {
    {"04_lights.gltf", "it is one sheet, and nothing stands on it"},
    {"TwoSidedPlane.gltf", "the same"},
    {"01_alpha_mask.gltf", "most of its one sheet is cut out, so that nothing looks up what the map holds there"},
    {"MorphStressTest.glb", "it is five times as long as wide, and the map is square"},
    {"chainlink_fence.glb", "its wires are thinner than a hundredth of the fence's height"},
    {"huge_extent.glb", "it lies about a million metres apart"},
    {"LightsPunctualLamp.gltf", "its first light hangs low at the stem, whose shadow runs to the ground's end"},
    {"ToyCar.gltf", "it stands on a cloth of its own, which spreads as wide and as flat as its shadow falls"},
};

SI_TEST_IS(Repeated, GroundTest, ShowsModelsShadowsWithDefaultSettings);
SI_TEST_IS(Product, GroundTest, ShowsModelsShadowsWithDefaultSettings);
SI_TEST_IS(DriverIndependent, GroundTest, ShowsModelsShadowsWithDefaultSettings);
// The test uses the camera that frames the scene, because a file's own camera may show no shadow. A file opens with
// its own camera, which must draw a picture too.
SI_TEST_IS(Later, GroundTest, ShowsModelsShadowsWithDefaultSettings);
TEST_F(GroundTest, ShowsModelsShadowsWithDefaultSettings) {
    const std::vector<test::SharedModel> files = test::portion(test::shared_models(), 4);
    if (files.empty()) GTEST_SKIP() << test::kMissingReason << "../shared/models";
    int shown = 0, with_camera = 0;
    std::string by_own_cameras;
    for (const test::SharedModel& model : files) {
        SCOPED_TRACE(model.file);
        std::optional<Session> session;
        try {
            session = open_session({.scene = model.file.string(), .sets = {"map.resolution=512", "camera.index=-1"}});
        } catch (const Error& e) {
            EXPECT_TRUE(model.may_be_refused) << e.what();
            continue;
        }
        const FirstPicture seen = first_picture(*session);
        if (!session->scene.cameras.empty()) {
            ++with_camera;
            by_own_cameras += model.file.filename().string() + ": " + picture_by_own_camera(*session) + "; ";
        }
        const bool shows = session->scene.objects.back().ground || seen.own_floor;
        const bool enough = shows ? double(seen.dark) >= 0.02 * double(seen.ground)
                                  : double(seen.dark_surfaces) >= 0.02 * double(seen.surfaces);
        const bool whole = seen.dark_at_rim == 0;
        const std::string name = model.file.filename().string();
        const auto* other = std::ranges::find(kOthers, name, [](const auto& row) { return row.first; });
        if (other != std::end(kOthers)) {
            EXPECT_FALSE(enough && whole && seen.read >= 0.2) << "no longer, though " << other->second;
            continue;
        }
        EXPECT_TRUE(!shows || seen.ground > 5000u) << seen.ground;
        EXPECT_TRUE(enough) << seen.dark << " of " << seen.ground << ", in all " << seen.dark_surfaces << " of "
                            << seen.surfaces;
        EXPECT_TRUE(whole) << seen.dark_at_rim << " at the picture's rim";
        EXPECT_GE(seen.read, 0.2);
        ++shown;
    }
    EXPECT_GT(shown, int(files.size()) * 2 / 3);
    EXPECT_GT(with_camera, 0);
    RecordProperty("by_own_cameras", by_own_cameras);
}

TEST_F(GroundTest, FollowsTheSettingAndThePlacement) {
    Session session = session_of(box_alone(), {"scene.scale=3", "scene.distance=100"});
    const double gap = session.scene.bounds.lo.y - session.scene.ground_bounds.hi.y;
    EXPECT_GT(gap, 0);
    EXPECT_LT(gap, 0.01);
    SceneSettings moment = session.settings.scene;
    moment.ground = Ground::Off;
    const std::size_t objects = session.scene.objects.size(), nodes = session.scene.nodes.size();
    pose_scene(session.scene, moment);
    EXPECT_EQ(session.scene.objects.size(), objects - 1);
    EXPECT_EQ(session.scene.nodes.size(), nodes - 1);
    EXPECT_TRUE(session.scene.ground_bounds.empty());
    moment.ground = Ground::Auto;
    moment.scale = 1;
    moment.distance = 0;
    pose_scene(session.scene, moment);
    EXPECT_EQ(session.scene.objects.size(), objects);
    EXPECT_NEAR(session.scene.ground_bounds.hi.y, session.scene.bounds.lo.y, 0.01);
}

TEST_F(GroundTest, IsNotAddedToModelsWithALevelSurface) {
    for (const BuiltinScene& row : builtin_scenes()) {
        if (row.key == "plane") continue;
        EXPECT_TRUE(has_level_surface(row.make())) << row.key;
    }
    EXPECT_FALSE(has_level_surface(box_alone()));
    // A floor under a roof is indoors: shadows fall outside.
    const auto place_with = [](bool roof) {
        Scene scene;
        const auto add = [&](const char* name, Mesh mesh, const glm::dmat4& at) {
            add_object(scene, name, -1, add_mesh(scene, name, std::move(mesh), -1), at);
        };
        add("floor", make_plane(10, 10), glm::dmat4(1));
        add("wall", make_box({0.2, 3, 10}), moved(-5, 1.5, 0));
        if (roof) add("roof", make_box({10, 0.1, 10}), moved(0, 3, 0));
        finalise(scene);
        return scene;
    };
    EXPECT_TRUE(has_level_surface(place_with(false)));
    EXPECT_FALSE(has_level_surface(place_with(true)));
    const Session session = session_of(load_scene("boxes"));
    EXPECT_TRUE(session.scene.ground_bounds.empty());
    EXPECT_TRUE(open_session({.scene = "boxes"}).scene.ground_bounds.empty());
}

}  // namespace
}  // namespace si
