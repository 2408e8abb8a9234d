// Changes that need another map than an engine's, tried on the program's own map from the same light.
#include "renderer/advise/own_map.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/base/output.h"
#include "app/report/frame_bundle.h"
#include "app/session/session.h"
#include "renderer/advise/fixes.h"
#include "renderer/bundle/given_maps.h"
#include "renderer/inspect/given_map_changes.h"
#include "renderer/measure/axes.h"
#include "renderer/measure/measured_error.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;

class OwnMapTest : public FrameTest {
protected:
    static constexpr int kWidth = 160, kHeight = 90;
    fs::path folder = fresh_test_folder();
    ReferenceCache cache;

    static Session open(const std::string& scene, const std::vector<std::string>& sets = {}) {
        Session out = open_session({.scene = scene, .sets = sets});
        out.settings = measured_settings(out.settings);
        return out;
    }
    std::string exported(const Session& session) {
        const fs::path path = folder / "out.bundle";
        write_bundle_files(
            frame_bundle(renderer, session.scene, session.settings, {.width = kWidth, .height = kHeight}), path);
        return path.string();
    }
    SearchTools tools(const Scene& scene) { return {renderer, scene, kWidth, kHeight, cache}; }
    TrialMeter meter(const Scene& scene) {
        return renderer_trial_meter(tools(scene), {.work = false, .reference = ReferenceOptions()});
    }
    /// Returns candidates of single changes, named as the change.
    static std::vector<Candidate> candidates(const Settings& base, const std::vector<std::string>& changes) {
        std::vector<Candidate> out;
        for (const std::string& change : changes)
            out.push_back({.name = change, .settings = settings_with(base, {change})});
        return out;
    }
    FixTable searched(const Session& session, const std::vector<std::string>& changes,
                      std::optional<glm::ivec2> pixel = {}) {
        const TrialMeter m = meter(session.scene);
        const MeasuredSettings before = m.measure(session.settings, 0);
        return search_fixes(session.settings, before, candidates(session.settings, changes), m, {.pixel = pixel}, {},
                            {}, 1000, [&] { return own_map_of(tools(session.scene), session.settings, before, m); });
    }
};

const Trial* row_of(const FixTable& table, const std::string& name) {
    for (const Trial& t : table.rows)
        if (t.candidate.name == name) return &t;
    return nullptr;
}

TEST_F(OwnMapTest, StandsForAMapThatPassesTheGate) {
    for (const std::vector<std::string>& sets :
         {std::vector<std::string>{"map.format=d16", "bias.raster_slope=2", "bias.raster_units=3"},
          {"map.reversed_z=true", "caster.cull=front", "bias.raster_units=5"},
          {"light.type=spot", "light.distance=14", "light.cone=50"}}) {
        SCOPED_TRACE(sets[0]);
        std::vector<std::string> all = {"map.resolution=96"};
        all.insert(all.end(), sets.begin(), sets.end());
        fs::remove_all(folder / "out.bundle");
        const Session read = open(exported(open("boxes", all)));
        const TrialMeter m = meter(read.scene);
        const MeasuredSettings before = m.measure(read.settings, 0);
        const OwnMap own = own_map_of(tools(read.scene), read.settings, before, m);
        EXPECT_EQ(own.why_not, "");
        EXPECT_EQ(own.settings.map.bundle_maps, BundleMaps::Drawn);
        EXPECT_EQ(own.before.frame->lights[0].provider, MapProvider::Drawn);
        EXPECT_EQ(before.frame->lights[0].provider, MapProvider::Imported);
        EXPECT_EQ(own.before.error, before.error);
        // Causes that need the map drawn without polygon offset differ.
        EXPECT_EQ(wrong_pixels(own.before.frame->metrics), wrong_pixels(before.frame->metrics));
    }
}

// The changes of a trial, applied to the present settings, draw what was tried. A second drawing with the bundle's view
// by hand gives the same numbers.
SI_TEST_IS(Later, OwnMapTest, ChangesLeadToWhatWasDrawn);
TEST_F(OwnMapTest, ChangesLeadToWhatWasDrawn) {
    const Session read = open(exported(open("boxes", {"map.resolution=64", "bias.raster_slope=1"})));
    const FixTable table = searched(
        read, {"map.resolution=256", "caster.cull=front", "bias.raster_slope=4", "map.format=d16", "bias.normal=2"});
    ASSERT_EQ(table.rows.size(), 5u);
    const auto measured = [&](const Settings& s, FrameRequest request = {.width = kWidth, .height = kHeight}) {
        return measure_error(renderer, read.scene, s, request, 0, {}, cache).metrics;
    };
    for (const Trial& t : table.rows) {
        SCOPED_TRACE(t.candidate.name);
        ASSERT_TRUE(t.is_drawn()) << t.candidate.untried;
        EXPECT_EQ(t.on_own_map, t.candidate.name != "bias.normal=2") << "the look-up acts on the given map itself";
        EXPECT_EQ(t.candidate.shown_name().find(kTriedOnOwnMap) != std::string::npos, t.on_own_map);
        Settings applied = read.settings;
        set_settings(applied, t.changes);
        const ErrorMetrics literal = measured(applied);
        EXPECT_EQ(literal.mae, t.metrics.mae);
        EXPECT_EQ(wrong_pixels(literal), wrong_pixels(t.metrics));
        if (t.metrics.without_cause == 0) {
            EXPECT_EQ(literal.artefacts, t.metrics.artefacts);
        }
    }
    FrameRequest by_hand{.width = kWidth, .height = kHeight};
    const auto given = given_maps(read.settings.map.bundle)->lights[0];
    by_hand.imported = {drawn_maps(*given->views, MapSize(256), given->raster)};
    EXPECT_EQ(measured(read.settings, by_hand).mae, row_of(table, "map.resolution=256")->metrics.mae);
    std::vector<CasterRaster> raster = given->raster;
    raster.at(0).offset_factor = 4;
    by_hand.imported = {drawn_maps(*given->views, given->size(), raster)};
    EXPECT_EQ(measured(read.settings, by_hand).mae, row_of(table, "bias.raster_slope=4")->metrics.mae);
    raster = given->raster;
    raster.at(0).cull = Cull::Front;
    by_hand.imported = {drawn_maps(*given->views, given->size(), raster)};
    // The bias of surfaces follows the setting.
    EXPECT_EQ(measured(settings_with(read.settings, {"caster.cull=front"}), by_hand).mae,
              row_of(table, "caster.cull=front")->metrics.mae);
}

// A fix was drawn, makes its pixel right and nothing worse, on the own map and beside the engine's.
TEST_F(OwnMapTest, AFixMakesItsPixelRightAndNothingWorse) {
    const Session read =
        open(exported(open("boxes", {"map.resolution=256", "bias.kind=constant", "bias.constant=0", "bias.normal=0"})));
    const TrialMeter m = meter(read.scene);
    const MeasuredSettings before = m.measure(read.settings, 0);
    std::vector<std::size_t> wrong;
    for (std::size_t i = 0; i < before.frame->classified.size(); ++i)
        if (before.frame->classified[i].artefact != Artefact::None) wrong.push_back(i);
    ASSERT_GE(wrong.size(), 4u);
    int fixed = 0, asked = 0;
    std::string why;
    for (std::size_t k = 0; k < wrong.size(); k += std::max<std::size_t>(wrong.size() / 4, 1)) {
        const std::size_t i = wrong[k];
        ++asked;
        const glm::ivec2 pixel(int(i) % kWidth, int(i) / kWidth);
        const FixTable table =
            searched(read, {"map.resolution=320", "bias.raster_slope=1", "caster.cull=front"}, pixel);
        const Trial* const fix = table.fix();
        if (!fix) {
            for (const Trial& t : table.rows) why += t.candidate.name + ": " + t.why_not + t.candidate.untried + "\n";
            continue;
        }
        ++fixed;
        EXPECT_TRUE(fix->on_own_map);
        Settings applied = read.settings;
        set_settings(applied, fix->changes);
        const MeasuredSettings after = m.measure(applied, 0);
        EXPECT_EQ(after.frame->classified[i].artefact, Artefact::None);
        EXPECT_LE(std::abs(after.frame->classified[i].visibility - after.frame->traced.reference->visibility.data[i]),
                  kRightVisibilityError);
        EXPECT_LE(wrong_pixels(after.frame->metrics), wrong_pixels(before.frame->metrics));
        EXPECT_LE(after.error, before.error + 1e-12);
        EXPECT_LE(after.frame->metrics.any_acne, before.frame->metrics.any_acne);
        EXPECT_LE(after.frame->metrics.any_leak, before.frame->metrics.any_leak);
    }
    EXPECT_GT(fixed, 0) << "of " << asked << ": " << why;
}

TEST_F(OwnMapTest, WithoutTheGateNothingIsTried) {
    const Session lacks = open("boxes", {"map.resolution=64", "object.Boxes/Tower.cast=false"});
    const Session read = open(exported(lacks), {"object.Boxes/Tower.cast=true"});
    const FixTable table = searched(read, {"map.resolution=256", "caster.cull=front", "bias.normal=2"});
    EXPECT_EQ(table.drawn(), 1u) << "what acts on the given map itself";
    for (const char* name : {"map.resolution=256", "caster.cull=front"}) {
        const Trial* const t = row_of(table, name);
        ASSERT_TRUE(t);
        EXPECT_TRUE(t->candidate.untried.starts_with(std::string(kNeedsAnotherMap) +
                                                     "; the inspector's own map from the same light differs: failed:"))
            << t->candidate.untried;
        EXPECT_FALSE(t->on_own_map);
    }
}

// A shader that moves casters is part of how a map was drawn: own maps move them alike.
TEST_F(OwnMapTest, CastersThatTheEngineMovesAreMoved) {
    const std::string first = exported(open("boxes", {"map.resolution=96"}));
    const fs::path file = fs::path(first) / "frame.json";
    nlohmann::json frame = nlohmann::json::parse(read_text_file(file));
    frame["lights"][0]["maps"][0]["raster"].update({{"shift_m", 0.25}, {"grazing_shift_m", 0.125}});
    write_file(file.string(), frame.dump());
    const auto why_not = [&](const Session& read) {
        const TrialMeter m = meter(read.scene);
        return own_map_of(tools(read.scene), read.settings, m.measure(read.settings, 0), m).why_not;
    };
    EXPECT_NE(why_not(open(first)).find("the median depth differs by"), std::string::npos)
        << "the image holds casters that are not moved";
    // The own maps of that bundle are a frame of such an engine.
    const Session engine = open(first, {"map.bundle_maps=drawn"});
    const fs::path second = folder / "moved.bundle";
    write_bundle_files(frame_bundle(renderer, engine.scene, engine.settings, {.width = kWidth, .height = kHeight}),
                       second);
    const Session read = open(second.string());
    EXPECT_EQ(given_maps(read.settings.map.bundle)->lights[0]->views->views.at(0).caster_shift,
              (CasterShift{.all_m = 0.25, .grazing_m = 0.125}));
    EXPECT_EQ(why_not(read), "");
    const FixTable table = searched(read, {"map.resolution=256"});
    EXPECT_TRUE(table.rows.at(0).on_own_map) << table.rows[0].candidate.untried;
}

// Texels that masked casters cover count in no gate, as masks are rarely those of the engine to the texel.
TEST_F(OwnMapTest, MaskedCastersAreLeftOutOfTheGate) {
    const auto why_not = [&](const std::string& alpha) {
        Session session = open("boxes", {"map.resolution=96"});
        for (Object& object : session.scene.objects)
            if (session.scene.nodes[std::size_t(object.node)].path == "Boxes/Tower") {
                Material mask =
                    session.scene.materials.at(std::size_t(session.scene.meshes[std::size_t(object.mesh)].material));
                mask.alpha = alpha == "mask" ? AlphaMode::Mask : AlphaMode::Opaque;
                mask.double_sided = true;
                session.scene.materials.push_back(mask);
                Mesh mesh = session.scene.meshes[std::size_t(object.mesh)];
                mesh.material = int(session.scene.materials.size()) - 1;
                session.scene.meshes.push_back(mesh);
                object.mesh = int(session.scene.meshes.size()) - 1;
            }
        refresh(session.scene);
        // The engine's mask drops the whole tower, ours none of it.
        Settings without = session.settings;
        set_setting(without, "object.Boxes/Tower.cast", "false");
        fs::remove_all(folder / "out.bundle");
        write_bundle_files(frame_bundle(renderer, session.scene, without, {.width = kWidth, .height = kHeight}),
                           folder / "out.bundle");
        const Session read = open((folder / "out.bundle").string(), {"object.Boxes/Tower.cast=true"});
        const TrialMeter m = meter(read.scene);
        return own_map_of(tools(read.scene), read.settings, m.measure(read.settings, 0), m).why_not;
    };
    EXPECT_NE(why_not("opaque").find("differs: failed:"), std::string::npos);
    EXPECT_EQ(why_not("mask"), "");
}

// The gate draws with the bundle's raster state. Settings that are another one already draw something else.
TEST_F(OwnMapTest, ChangedRasterStateStandsForNothing) {
    const std::string bundle = exported(open("boxes", {"map.resolution=64"}));
    for (const char* change : {"bias.raster_slope=2", "caster.cull=front"}) {
        const FixTable table = searched(open(bundle, {change}), {"map.resolution=256"});
        EXPECT_NE(table.rows.at(0).candidate.untried.find("are not as the engine has drawn it"), std::string::npos)
            << table.rows[0].candidate.untried;
    }
}

TEST_F(OwnMapTest, AStopIsNoReasonAgainstOwnMaps) {
    const Session read = open(exported(open("boxes", {"map.resolution=64"})));
    TrialMeter m = meter(read.scene);
    const MeasuredSettings before = m.measure(read.settings, 0);
    m.measure = [](const Settings&, int) -> MeasuredSettings { throw Cancelled(); };
    EXPECT_THROW(own_map_of(tools(read.scene), read.settings, before, m), Cancelled);
}

TEST_F(OwnMapTest, OtherViewsAreNotTried) {
    const Session read = open(exported(open("boxes", {"map.resolution=64"})));
    const std::vector<std::string> changes = {"light.fit=view", "light.near_far=casters", "light.cascades=2",
                                              "map.reversed_z=true"};
    const FixTable table = searched(read, changes);
    EXPECT_EQ(table.drawn(), 0u);
    for (const Trial& t : table.rows) EXPECT_EQ(t.candidate.untried, kNeedsAnotherMap) << t.candidate.name;
    // Without a way to own maps all stays as it was.
    const TrialMeter m = meter(read.scene);
    const FixTable plain = search_fixes(read.settings, m.measure(read.settings, 0),
                                        candidates(read.settings, {"map.resolution=256"}), m, {});
    EXPECT_EQ(plain.rows.at(0).candidate.untried, kNeedsAnotherMap);
}

}  // namespace
}  // namespace si
