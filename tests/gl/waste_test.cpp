// Tests the search for waste: each map, face and cascade is left out in turn, and is waste if no pixel changes.
#include "renderer/advise/waste.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stop_token>

#include "renderer/scene/ground.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/mesh_scene.h"
#include "tests/support/shared_models.h"
#include "tests/support/traits.h"

namespace si {
namespace {

/// Accepted share of waste, in triangles drawn into maps and in their time.
constexpr double kMaxWasteShare = 0.05;

class WasteTest : public FrameTest {
protected:
    Waste waste_of(const Scene& scene, const Sets& sets, bool timing = false) {
        ReferenceCache cache;
        return find_waste({renderer, scene, 320, 180, cache}, settings_for(scene, sets),
                          {.width = 320, .height = 180, .timing = timing});
    }
};

const WasteTrial& tried_named(const Waste& waste, std::string_view name) {
    static const WasteTrial none;
    for (const WasteTrial& t : waste.tried)
        if (t.name == name) return t;
    ADD_FAILURE() << name << " was not tried";
    return none;
}

SI_TESTS_ARE(DriverIndependent, WasteTest);
SI_TESTS_ARE(Repeated, WasteTest);
TEST_F(WasteTest, VisibleLightsAreNeededAndInvisibleOnesAreNot) {
    const Scene scene = load_scene("boxes");
    const Waste needed = waste_of(scene, {});
    EXPECT_TRUE(tried_named(needed, "map of light 0").changes);
    EXPECT_GT(tried_named(needed, "map of light 0").read, 0);
    EXPECT_GT(needed.triangles(), 0u);
    EXPECT_EQ(needed.share(), 0);
    // The camera looks away from the scene: nothing reads the map.
    const Waste unseen = waste_of(scene, {"camera.source=manual", "camera.target_x=500"});
    EXPECT_EQ(tried_named(unseen, "map of light 0").read, 0);
    EXPECT_FALSE(tried_named(unseen, "map of light 0").changes);
    if (unseen.triangles() > 0) {
        EXPECT_EQ(unseen.share(), 1);
    }
}

SI_TEST_IS(Slow, WasteTest, UnreadMapsChangeNothing);
TEST_F(WasteTest, UnreadMapsChangeNothing) {
    for (const Sets& sets : {Sets{"light.type=point"}, Sets{"light.cascades=4"}}) {
        const Waste waste = waste_of(load_scene("stage"), sets);
        EXPECT_GE(waste.tried.size(), 4u);
        for (const WasteTrial& t : waste.tried)
            if (t.changes && t.read >= 0) {
                EXPECT_GT(t.read, 0) << t.name << " changes pixels, and no texel of it is read";
            }
    }
}

TEST_F(WasteTest, MomentsOfSeveralSamplesNeedTheirCasters) {
    const Scene scene = load_scene("boxes");
    const Waste waste = waste_of(scene, {"filter.kernel=vsm", "map.samples=4", "map.resolution=256"});
    EXPECT_TRUE(tried_named(waste, "map of light 0").changes);
    EXPECT_EQ(waste.share(), 0);
}

TEST_F(WasteTest, TryingAnEmptyMapRestoresTheMap) {
    const Scene scene = load_scene("boxes");
    const Settings s = settings_for(scene);
    FrameRequest request = small_request();
    const ByteImage before = picture(scene, s, request);
    request.emptied = MapOfLight{0, 0};
    EXPECT_GT(different_pixels(before, picture(scene, s, request)), 100u) << "the shadows are still there";
    request.emptied.reset();
    EXPECT_EQ(different_pixels(before, picture(scene, s, request)), 0u);
}

SI_TEST_IS(Later, WasteTest, EffectsEnabledBySettingsAreTried);
TEST_F(WasteTest, EffectsEnabledBySettingsAreTried) {
    const Scene scene = load_scene("stage");
    const Waste waste = waste_of(scene, {"light.contact=0.5", "map.blur_texels=2"});
    EXPECT_TRUE(tried_named(waste, "contact shadows of light 0").changes);
    EXPECT_TRUE(tried_named(waste, "depth blur").changes);
    const Waste moments = waste_of(scene, {"filter.kernel=vsm", "filter.blur=3"});
    EXPECT_TRUE(tried_named(moments, "blur of the moments").changes);
}

bool was_tried(const Waste& waste, std::string_view name) {
    return std::ranges::any_of(waste.tried, [&](const WasteTrial& t) { return t.name == name; });
}

TEST_F(WasteTest, LookEffectsAreTriedWhereTheyAreEnabled) {
    const Scene scene = load_scene("boxes");
    const Waste waste = waste_of(scene, {});
    EXPECT_TRUE(tried_named(waste, "sky and its ambient light").changes);
    EXPECT_TRUE(tried_named(waste, "tone curve").changes);
    const Waste plain = waste_of(scene, {"shading.sky=plain", "shading.curve=plain"});
    for (const char* name :
         {"sky and its ambient light", "tone curve", "ground", "alpha test in maps", "stored-depth quads"})
        EXPECT_FALSE(was_tried(plain, name)) << name << " is not drawn";
    EXPECT_TRUE(was_tried(waste_of(scene, {"shading.curve=plain", "shading.exposure=1"}), "tone curve"));
}

TEST_F(WasteTest, TheGroundIsTriedWhereItWasAdded) {
    Scene scene = make_scene(make_box({1, 2, 1.5}));
    add_ground(scene);
    ASSERT_FALSE(scene.ground_bounds.empty());
    EXPECT_TRUE(tried_named(waste_of(scene, {}), "ground").changes);
    EXPECT_FALSE(scene.ground_bounds.empty()) << "it is still there";
    EXPECT_TRUE(std::ranges::any_of(scene.objects, [](const Object& o) { return o.ground; }));
}

TEST_F(WasteTest, PagesAreTriedLightByLight) {
    const Scene scene = load_scene("boxes");
    const Sets paged = {"map.virtual=true", "light.contact=0.5"};
    const Waste waste = waste_of(scene, paged);
    EXPECT_TRUE(tried_named(waste, "pages of light 0").changes);
    EXPECT_GT(tried_named(waste, "pages of light 0").triangles, 0u);
    EXPECT_TRUE(was_tried(waste, "contact shadows of light 0")) << "by itself";
    EXPECT_EQ(waste.share(), 0);
    // The camera sees only points without look-ups.
    Sets away = paged;
    away.emplace_back("camera.source", "manual");
    away.emplace_back("camera.target_x", "500");
    EXPECT_FALSE(tried_named(waste_of(scene, away), "pages of light 0").changes);
}

TEST_F(WasteTest, TheLightsSizeIsTriedUnderKernelsThatReadIt) {
    const Scene scene = load_scene("boxes");
    const Sets soft = {"filter.kernel=pcss", "light.size=3"};
    EXPECT_TRUE(tried_named(waste_of(scene, soft), "size of light 0").changes);
    EXPECT_FALSE(was_tried(waste_of(scene, {"light.size=3"}), "size of light 0"));
    // The reference reads it, the picture does not.
    EXPECT_FALSE(was_tried(waste_of(scene, {"light.size=3", "truth.area=true"}), "size of light 0"));
}

/// Makes a fence that stands on a floor, or on nothing.
Scene fence(bool cut_out, bool floor = true) {
    Scene scene;
    Texture holes;
    holes.width = holes.height = 8;
    for (int i = 0; i < 64; ++i)
        holes.rgba.append({90, 90, 90, std::uint8_t(cut_out && (i + i / 8) % 2 == 0 ? 0 : 255)});
    holes.nearest_mag = holes.nearest_min = true;
    holes.mipmaps = false;
    scene.textures.push_back(holes);
    scene.materials.push_back(
        {.name = "fence", .base_colour_texture = 0, .alpha = AlphaMode::Mask, .double_sided = true});
    add_object(scene, "Fence", -1, add_mesh(scene, "fence", make_quad(2, 2), 0));
    if (floor)
        add_object(scene, "Floor", -1,
                   add_mesh(scene, "floor", make_plane(12, 12), add_material(scene, "grey", {0.6f, 0.6f, 0.6f})));
    finalise(scene);
    return scene;
}

TEST_F(WasteTest, TheAlphaTestInMapsIsTriedByShadowsOfMaskedCasters) {
    EXPECT_TRUE(tried_named(waste_of(fence(true), {}), "alpha test in maps").changes);
    EXPECT_FALSE(tried_named(waste_of(fence(false), {}), "alpha test in maps").changes) << "it cuts nothing";
    EXPECT_FALSE(was_tried(waste_of(fence(true), {"light.cast=false"}), "alpha test in maps"));
    // Holes visible to the camera do not belong to the map.
    EXPECT_FALSE(tried_named(waste_of(fence(true, false), {}), "alpha test in maps").changes);
}

TEST_F(WasteTest, BlendedCastersAreTriedWhereTheyCast) {
    Scene scene = fence(false);
    scene.materials[0].alpha = AlphaMode::Blend;
    refresh(scene);
    EXPECT_TRUE(tried_named(waste_of(scene, {"caster.blend=mask"}), "shadows of blended casters").changes);
    EXPECT_FALSE(was_tried(waste_of(scene, {"caster.blend=none"}), "shadows of blended casters"));
}

TEST_F(WasteTest, OverlaysAreTriedPaneByPane) {
    const Scene scene = load_scene("boxes");
    const Waste waste =
        waste_of(scene, {"view.panes=two", "view.overlay_2=n-dot-l", "view.slabs=stored", "view.slabs_texels=256"});
    EXPECT_TRUE(tried_named(waste, "overlay n-dot-l in pane 2").changes);
    EXPECT_FALSE(was_tried(waste, "overlay n-dot-l in pane 1"));
    EXPECT_TRUE(tried_named(waste, "stored-depth quads").changes);
    const Waste see_through = waste_of(scene, {"view.overlay=n-dot-l", "view.overlay_opacity=0"});
    EXPECT_FALSE(tried_named(see_through, "overlay n-dot-l").changes) << "drawn, and nobody sees it";
    EXPECT_FALSE(was_tried(waste_of(scene, {"view.overlay=truth"}), "overlay truth")) << "there is no reference";
    EXPECT_TRUE(tried_named(see_through, "map of light 0").changes) << "the overlay is left out of the comparison";
}

TEST_F(WasteTest, WasteIsTimedOnRequest) {
    const Scene scene = load_scene("boxes");
    const Waste untimed = waste_of(scene, {});
    EXPECT_FALSE(untimed.maps_ms);
    EXPECT_FALSE(untimed.share_of_time());
    const Waste needed = waste_of(scene, {}, true);
    ASSERT_TRUE(needed.maps_ms);
    EXPECT_GT(*needed.maps_ms, 0);
    EXPECT_EQ(needed.wasted_ms(), 0);
    EXPECT_EQ(needed.share_of_time(), 0);
    // The alpha test has no time of its own in a map that is itself waste.
    const Waste twice = waste_of(fence(false), {"light.intensity=1e-10"}, true);
    EXPECT_GT(tried_named(twice, "map of light 0").maps_ms, 0);
    EXPECT_FALSE(tried_named(twice, "alpha test in maps").changes);
    EXPECT_EQ(tried_named(twice, "alpha test in maps").maps_ms, 0);
    // The light is so dim that no byte shows its shadow: its map is drawn all the same.
    const Waste dim = waste_of(scene, {"light.intensity=1e-10"}, true);
    const WasteTrial& unseen = tried_named(dim, "map of light 0");
    EXPECT_FALSE(unseen.changes);
    EXPECT_GT(unseen.triangles, 0u);
    EXPECT_GT(unseen.maps_ms, 0);
    EXPECT_EQ(dim.share(), 1);
    EXPECT_GT(dim.share_of_time().value_or(0), 0);
    EXPECT_LE(dim.share_of_time().value_or(2), 1);
    Waste some;
    some.maps_ms = 8;
    some.tried = {{.name = "needed", .changes = true, .maps_ms = 5},
                  {.name = "waste", .maps_ms = 2.5},
                  {.name = "noise", .maps_ms = -0.5}};
    EXPECT_EQ(some.wasted_ms(), 2);
    EXPECT_EQ(some.share_of_time(), 0.25);
    some.tried.pop_back();
    some.tried.push_back({.name = "more noise", .maps_ms = -9});
    EXPECT_EQ(some.share_of_time(), 0) << "never below nothing";
}

SI_TEST_IS(Later, WasteTest, RowsAppearAsTheyAreMeasuredAndStayWhenItIsStopped);
TEST_F(WasteTest, RowsAppearAsTheyAreMeasuredAndStayWhenItIsStopped) {
    const Scene scene = load_scene("boxes");
    const Settings settings = settings_for(scene, {"light.cascades=4"});
    ReferenceCache cache;
    const Waste whole = waste_of(scene, {"light.cascades=4"});
    std::stop_source stop;
    std::vector<std::size_t> rows;
    std::vector<std::string> steps;
    const SearchTools tools{
        renderer, scene, 320, 180, cache, {.stop = stop.get_token()}, [&](double, const std::string& step) {
            steps.push_back(step);
        }};
    const Waste some = find_waste(tools, settings, {.width = 320, .height = 180}, [&](const Waste& so_far) {
        rows.push_back(so_far.tried.size());
        if (rows.size() == 2) stop.request_stop();
    });
    EXPECT_FALSE(whole.stopped);
    EXPECT_TRUE(some.stopped);
    EXPECT_EQ(rows, (std::vector<std::size_t>{1, 2}));
    ASSERT_EQ(some.tried.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(some.tried[i].name, whole.tried[i].name);
        EXPECT_EQ(some.tried[i].triangles, whole.tried[i].triangles);
        EXPECT_EQ(steps[i], whole.tried[i].name) << "the step that is reported";
    }
    EXPECT_THROW(find_waste(tools, settings, {.width = 320, .height = 180}), Cancelled) << "there is nothing to keep";
}

struct Sum {
    std::uint64_t drawn = 0, unread = 0, changes_nothing = 0;  ///< triangles; of the wasted ones: not read, and read
    double maps_ms = 0, wasted_ms = 0;
    std::string list;
    void add(const std::string& what, const Waste& waste) {
        drawn += waste.triangles();
        maps_ms += waste.maps_ms.value_or(0);
        wasted_ms += waste.wasted_ms();
        for (const WasteTrial& t : waste.tried) {
            if (!t.changes && t.read < 0 && t.triangles == 0)
                list += fmt::format("  {}: {} changes nothing, {:.2f} ms\n", what, t.name, t.maps_ms);
            if (t.changes || t.triangles == 0) continue;
            (t.read > 0 ? changes_nothing : unread) += t.triangles;
            list += fmt::format("  {}: {}, {} triangles, {:.2f} ms, {:.2f} % read\n", what, t.name, t.triangles,
                                t.maps_ms, 100 * std::max(t.read, 0.0));
        }
    }
    double share(std::uint64_t n) const { return drawn ? double(n) / double(drawn) : 0; }
    double share_of_time() const { return maps_ms > 0 ? wasted_ms / maps_ms : 0; }
    void print() const {
        fmt::print("of {} triangles drawn into maps {:.1f} % change nothing though read, {:.1f} % are not read", drawn,
                   100 * share(changes_nothing), 100 * share(unread));
        if (maps_ms > 0) fmt::print("; of {:.0f} ms that they take {:.1f} % are waste", maps_ms, 100 * share_of_time());
        fmt::print(":\n{}", list);
    }
};

bool takes_long() {
    return std::getenv("SI_LONG") != nullptr;
}

struct Named {
    std::string name;  ///< key of a built-in scene, or a model's path
    bool is_model = false, may_be_refused = false;
    bool is_always_drawn = true;
};

/// Returns the built-in scenes and some models; all models under SI_LONG.
std::vector<Named> scene_names() {
    std::vector<Named> names;
    for (const BuiltinScene& row : builtin_scenes()) names.push_back({std::string(row.key)});
    static const std::string_view kFew[] = {"godot_room",           "kaykit_graveyard",  "khr_SimpleInstancing",
                                            "gen_mirrored_sheared", "gen_leaf_mask_uv1", "gen_far_from_origin"};
    for (const std::string_view few : kFew)
        for (const test::SharedModel& model : test::shared_models())
            if (model.file.string().find(fmt::format("/{}/", few)) != std::string::npos) {
                names.push_back({model.file.string(), true, model.may_be_refused});
                break;
            }
    if (!takes_long()) return names;
    for (const test::SharedModel& model : test::shared_models())
        if (std::ranges::find(names, model.file.string(), &Named::name) == names.end())
            names.push_back({model.file.string(), true, model.may_be_refused, false});
    return names;
}

/// Loads a scene or a model. Returns nothing if the model was refused, which its list allows.
std::optional<Scene> loaded(const Named& named) {
    try {
        Scene scene = load_scene(named.name);
        if (named.is_model) add_ground(scene);  // as the editor opens it: only without a floor
        return scene;
    } catch (const std::exception& e) {
        EXPECT_TRUE(named.may_be_refused) << named.name << ": " << e.what();
        return {};
    }
}

// SI_LONG=1, or ctest -L long, measures all models, and their times.
SI_TEST_IS(Later, WasteTest, OfMapsIsSmallOverScenesAndModels);
TEST_F(WasteTest, OfMapsIsSmallOverScenesAndModels) {
    Sum sum;
    for (const Named& named : scene_names())
        if (const std::optional<Scene> scene = loaded(named))
            sum.add(std::filesystem::path(named.name).stem().string(), waste_of(*scene, {}, takes_long()));
    sum.print();
    EXPECT_GT(sum.drawn, 0u);
    EXPECT_LE(sum.share(sum.unread + sum.changes_nothing), kMaxWasteShare);
    if (takes_long()) {
        EXPECT_GT(sum.maps_ms, 0) << "its share is printed: times are no test's";
    }
}

// Lights have several maps, and some of these are read by nobody. SI_LONG=1, or ctest -L long, measures all models.
TEST_F(WasteTest, OfFacesAndCascadesIsSmallOverScenesAndModels) {
    if (!takes_long()) GTEST_SKIP() << "every scene and model under six faces and four cascades: SI_LONG=1";
    Sum sum, others;
    for (const Named& named : scene_names()) {
        const std::optional<Scene> scene = loaded(named);
        for (const Sets& sets : {Sets{"light.type=point"}, Sets{"light.cascades=4"}})
            if (scene)
                (named.is_always_drawn ? sum : others)
                    .add(std::filesystem::path(named.name).stem().string() + ", " + sets[0].second,
                         waste_of(*scene, sets, true));
    }
    sum.print();
    others.print();  // further maps are waste: flat casters, which nothing proves free of self-shadowing
    EXPECT_GT(sum.drawn, 0u);
    EXPECT_LE(sum.share(sum.changes_nothing), kMaxWasteShare);
    EXPECT_LE(sum.share(sum.unread + sum.changes_nothing), kMaxWasteShare);
    EXPECT_GT(sum.maps_ms, 0) << "its share is printed: times are no test's";
}

}  // namespace
}  // namespace si
