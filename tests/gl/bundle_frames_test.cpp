// Frames of this program as bundles: exported and read again, each number of measuring and probing is equal, and in the
// plan the passes of maps alone differ.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "app/report/effects_json.h"
#include "app/report/frame_bundle.h"
#include "app/report/measure_json.h"
#include "app/report/probe_json.h"
#include "app/session/session.h"
#include "renderer/base/error.h"
#include "renderer/bundle/bundle_json.h"
#include "renderer/bundle/given_maps.h"
#include "renderer/inspect/effects.h"
#include "renderer/measure/measure.h"
#include "renderer/projection/view_of_matrix.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;

class BundleFramesTest : public FrameTest {
protected:
    static constexpr int kWidth = 160, kHeight = 90;
    fs::path folder = fresh_test_folder();

    Session open(const std::string& scene, const std::vector<std::string>& sets = {}) {
        return open_session({.scene = scene, .sets = sets});
    }
    /// Exports a session's frame and opens the bundle.
    Session exported(const Session& session, const char* name = "out.bundle") {
        write_bundle_files(
            frame_bundle(renderer, session.scene, session.settings, {.width = kWidth, .height = kHeight}),
            folder / name);
        return open((folder / name).string());
    }
    Json measured(const Session& session) {
        Measurer measurer(renderer, kWidth, kHeight);
        const Classification c = measurer.classify(session.scene, session.settings);
        Json cost = cost_json(c.cost);
        for (const char* of_casters : {"draws", "triangles"}) cost.erase(of_casters);  // given maps draw none
        return {{"error", error_json(c.error)},
                {"truth", reference_quality_json(*c.reference)},
                {"cost", cost},
                {"map_resolution", c.map_resolution}};
    }
    Json probed(const Session& session) {
        Json out = Json::array();
        for (int y = 9; y < kHeight; y += 18)
            for (int x = 11; x < kWidth; x += 23)
                out.push_back(probe_json(
                    renderer.probe(session.scene, session.settings, {.width = kWidth, .height = kHeight}, x, y), {}));
        return out;
    }
    std::vector<Effect> planned(const Session& session) {
        Renderer first;  // nothing is cached
        return frame_effects(session.scene, session.settings,
                             first.render(session.scene, session.settings, {.width = kWidth, .height = kHeight}));
    }
    static std::string first_difference(const Json& a, const Json& b) {
        const Json patch = Json::diff(a, b);
        if (patch.empty()) return "";
        const Json::json_pointer place(patch[0]["path"].get<std::string>());
        const std::string was = a.contains(place) ? a[place].dump() : "nothing";
        return patch[0].dump() + ", was " + was + ", of " + std::to_string(patch.size());
    }
    void expect_equal_numbers(const Session& own, const Session& read) {
        EXPECT_EQ(first_difference(measured(own), measured(read)), "");
        EXPECT_EQ(first_difference(probed(own), probed(read)), "");
        const ByteImage a = picture(own.scene, own.settings), b = picture(read.scene, read.settings);
        EXPECT_EQ(different_pixels(a, b), 0u);
    }
};

struct FrameCase {
    const char* name;
    const char* scene;
    std::vector<std::string> sets;
};

const std::vector<FrameCase>& frame_cases() {
    static const std::vector<FrameCase> out = {
        {"stage", "stage", {}},
        {"biased d16",
         "boxes",
         {"map.format=d16", "bias.kind=slope", "bias.constant=0.5", "bias.slope=1", "bias.raster_slope=1"}},
        {"reversed depth, moments", "boxes", {"map.reversed_z=true", "filter.kernel=vsm"}},
        {"spot", "boxes", {"light.type=spot", "light.distance=14", "light.cone=50"}},
        {"wide spot", "boxes", {"light.type=spot", "light.distance=9", "light.cone=200"}},
        {"point", "boxes", {"light.type=point", "light.distance=9", "filter.kernel=pcf3"}},
        {"cascades", "stage", {"light.cascades=3", "light.fit=view"}},
        {"cascades by map", "stage", {"light.cascades=3", "light.fit=view", "light.cascade_choice=map"}},
        {"LiSPSM", "stage", {"light.fit=lispsm"}},
        {"two lights", "boxes", {"light.count=2", "light.1.azimuth=60", "light.cast=false", "view.light=1"}},
        {"far away, by hand", "boxes", {"camera.source=manual", "camera.distance=9", "scene.distance=1000"}},
        {"culled and hidden", "boxes", {"caster.cull=front", "filter.kernel=pcss"}},
    };
    return out;
}

SI_TEST_IS(Slow, BundleFramesTest, ExportedFramesReadBackEqual);
TEST_F(BundleFramesTest, ExportedFramesReadBackEqual) {
    for (const FrameCase& c : frame_cases()) {
        SCOPED_TRACE(c.name);
        std::vector<std::string> sets = {"map.resolution=256"};
        sets.insert(sets.end(), c.sets.begin(), c.sets.end());
        // Causes at masks compare with casters drawn again, which a given map does not have.
        if (std::string_view(c.scene) == "stage")
            for (int i = 1; i <= 9; ++i) sets.push_back(fmt::format("object.Stage/Tree/Leaves {}.cast=false", i));
        const Session own = open(c.scene, sets), read = exported(own);
        EXPECT_FALSE(read.settings.map.bundle.empty());
        expect_equal_numbers(own, read);
    }
}

TEST_F(BundleFramesTest, WideSpotLightsReadBack) {
    const Session faces = exported(open("boxes", {"map.resolution=64", "light.type=spot", "light.cone=175"}));
    EXPECT_EQ(faces.settings.lights[0].cone, 175);
    const FrameResult frame = renderer.render(faces.scene, faces.settings, small_request());
    EXPECT_EQ(frame.lights.at(0).provider, MapProvider::Imported);
    EXPECT_EQ(frame.lights.at(0).views.size(), 6u);
    const Session without_map = exported(open("boxes", {"map.resolution=64", "light.count=2", "light.1.type=spot",
                                                        "light.1.cone=360", "light.1.cast=false"}),
                                         "without_map.bundle");
    EXPECT_EQ(without_map.settings.lights[1].cone, 360);
}

TEST_F(BundleFramesTest, PlansDifferInThePassesOfMapsAlone) {
    const Session own = open("boxes", {"map.resolution=128", "light.count=2", "light.1.azimuth=60"});
    const Session read = exported(own);
    const std::vector<Effect> a = planned(own), b = planned(read);
    std::set<std::string> imported;
    for (const Effect& effect : b) {
        if (effect.reason.find("mported") != std::string::npos) {
            imported.insert(effect.name);
            continue;
        }
        const auto same = std::ranges::find(a, effect.name, &Effect::name);
        ASSERT_NE(same, a.end()) << effect.name;
        EXPECT_EQ(same->reason, effect.reason) << effect.name;
        EXPECT_EQ(same->state, effect.state) << effect.name;
    }
    EXPECT_TRUE(imported.contains("shadow map 0 (directional)"));
    EXPECT_TRUE(imported.contains("shadow map 1 (directional)"));
    for (const Effect& effect : a) {
        if (std::ranges::find(b, effect.name, &Effect::name) != b.end()) continue;
        EXPECT_NE(effect.name.find("maps of light"), std::string::npos) << effect.name << ": given maps draw no caster";
    }
}

TEST_F(BundleFramesTest, TheSettingChoosesMapsAndRemovesThem) {
    const Session own = open("boxes", {"map.resolution=128"});
    Session read = exported(own);
    const FrameRequest request = small_request();
    const auto provider = [&](const Scene& scene, const Settings& s) {
        return renderer.render(scene, s, request).lights.at(0).provider;
    };
    EXPECT_EQ(provider(read.scene, read.settings), MapProvider::Imported);
    Settings s = own.settings;
    s.map.bundle = read.settings.map.bundle;
    EXPECT_EQ(provider(own.scene, s), MapProvider::Imported) << "over another scene";
    s.map.bundle.clear();
    EXPECT_EQ(provider(own.scene, s), MapProvider::Drawn);
    read.settings.lights[0].azimuth += 30;
    const FrameResult moved = renderer.render(read.scene, read.settings, request);
    EXPECT_TRUE(std::ranges::any_of(moved.notes, [](const std::string& note) {
        return note.find("shines in another direction than the one whose map is given") != note.npos;
    }));
    s.map.bundle = (folder / "none.bundle").string();
    EXPECT_THROW(renderer.render(own.scene, s, request), Error);
    set_setting(s, "light.source", "none");
    EXPECT_NO_THROW(renderer.render(own.scene, s, request)) << "no light reads a map";
}

// A projection that is flipped in y, as engines for Vulkan have it, gives a mirrored map with clockwise front faces.
TEST_F(BundleFramesTest, CopiesOfMirroredMapsCullTheSameFaces) {
    const Session own = open("boxes", {"map.resolution=128", "caster.cull=back"});
    BundleContents files = frame_bundle(renderer, own.scene, own.settings, {.width = kWidth, .height = kHeight});
    const std::string frame_json(kFrameJson);
    Bundle bundle = parse_bundle(files.at(frame_json), frame_json);
    BundleMap& map = bundle.lights.at(0).maps.at(0);
    EXPECT_EQ(map.raster.front, BundleFront::Ccw);
    glm::dmat4 flip(1.0);
    flip[1][1] = -1;
    map.clip.projection = flip * map.clip.projection.value();
    map.image.first_row = FirstRow::Top;
    map.raster.front = BundleFront::Cw;
    files[frame_json] = format_bundle(bundle);
    write_bundle_files(files, folder / "mirrored.bundle");
    const Session mirrored = open((folder / "mirrored.bundle").string());
    const Session copy = exported(mirrored, "copy.bundle");
    for (const Session* session : {&mirrored, &copy}) {
        const auto maps = given_maps(session->settings.map.bundle)->lights.at(0);
        EXPECT_TRUE(is_mirrored(maps->views->views.at(0)));
        EXPECT_EQ(maps->raster.at(0).cull, Cull::Back);
    }
    const auto drawn = [&](const Session& session) {
        Settings s = session.settings;
        s.map.bundle_maps = BundleMaps::Drawn;
        return map_texels(renderer, renderer.render(session.scene, s, small_request({.shadow_map = true})));
    };
    EXPECT_EQ(differing_floats(drawn(mirrored), drawn(copy)), 0u);
}

TEST_F(BundleFramesTest, ExportedFramesStateTheCullingEvenByDefault) {
    const Session read = exported(open("boxes", {"map.resolution=64"}));
    const auto maps = given_maps(read.settings.map.bundle);
    EXPECT_EQ(maps->bundle.settings.at("caster.cull"), "none");
}

// The maps follow a scene that is placed elsewhere.
TEST_F(BundleFramesTest, MapsMoveWithTheScene) {
    const Session read = exported(open("boxes", {"map.resolution=128"}));
    Session moved = open((folder / "out.bundle").string(), {"scene.distance=50"});
    const FloatImage a = visibility(read.scene, read.settings), b = visibility(moved.scene, moved.settings);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < a.data.size(); ++i) differ += std::abs(a.data[i] - b.data[i]) > 0.01f;
    EXPECT_LT(differ, a.data.size() / 100);
}

}  // namespace
}  // namespace si
