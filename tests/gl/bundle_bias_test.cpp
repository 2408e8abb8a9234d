// An own frame as a bundle that does not state its bias: unknown at first, and once it is entered, every error, probe
// and verdict is that of the frame.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/report/frame_bundle.h"
#include "app/report/measure_json.h"
#include "app/report/probe_json.h"
#include "app/session/session.h"
#include "renderer/inspect/given_map_changes.h"
#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/measure/measure.h"
#include "renderer/reference/ray_scenes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;

using BiasSets = std::vector<std::string>;

class BundleBiasTest : public FrameTest {
protected:
    static constexpr int kWidth = 160, kHeight = 90;
    fs::path folder = fresh_test_folder();

    static Session open(const std::string& scene, const BiasSets& sets) {
        return open_session({.scene = scene, .sets = sets});
    }
    /// Exports a frame without its bias, and returns the bundle.
    std::string exported_without_bias(const Session& session) {
        const fs::path path = folder / "out.bundle";
        fs::remove_all(path);
        write_bundle_files(
            frame_bundle(renderer, session.scene, session.settings, {.width = kWidth, .height = kHeight}), path);
        Json frame = Json::parse(std::ifstream(path / "frame.json"));
        for (Json& light : frame["lights"]) light["lookup"].erase("bias");
        for (const char* key : {"kind", "unit", "constant", "slope", "plane_clamp", "normal", "normal_source"})
            frame["settings"].erase(std::string("bias.") + key);
        std::ofstream(path / "frame.json") << frame.dump();
        return path.string();
    }
    Json measured(const Session& session) {
        return error_json(Measurer(renderer, kWidth, kHeight).classify(session.scene, session.settings).error);
    }
    /// Probes and diagnoses pixels of a grid.
    struct Asked {
        Json probes = Json::array();
        std::vector<PixelDiagnosis> diagnoses;
    };
    Asked ask(const Session& session) {
        const Settings& s = session.settings;
        const auto casters = ray_scenes().get(ray_scenes().geometry(session.scene, s));
        const auto traits = object_traits(session.scene, s);
        Asked out;
        for (int y = 6; y < kHeight; y += 16)
            for (int x = 7; x < kWidth; x += 21) {
                const Probe probe = renderer.probe(session.scene, s, {.width = kWidth, .height = kHeight}, x, y);
                out.probes.push_back(probe_json(probe, {}));
                for (const Probe::PerLight& light : probe.lights)
                    out.diagnoses.push_back(diagnose_pixel(probe, light,
                                                           trace_fragment_reference(*casters, probe, light, s, traits),
                                                           s, renderer.driver()));
            }
        return out;
    }
};

const std::vector<BiasSets>& bias_cases() {
    static const std::vector<BiasSets> out = {
        {"bias.kind=slope", "bias.unit=texels", "bias.constant=0.1", "bias.slope=0.3", "bias.normal=0"},
        {"bias.kind=constant", "bias.unit=depth", "bias.constant=0.00002", "bias.normal=0", "map.format=d16"},
        {"bias.kind=constant", "bias.unit=metres", "bias.constant=0.05", "bias.normal=2", "light.type=spot",
         "light.distance=14", "light.cone=50"},
        {"bias.kind=receiver-plane", "bias.constant=0.2", "bias.normal=0", "light.type=point", "light.distance=9"},
    };
    return out;
}

SI_TEST_IS(Slow, BundleBiasTest, OnceEnteredAllIsThatOfTheFrame);
TEST_F(BundleBiasTest, OnceEnteredAllIsThatOfTheFrame) {
    std::size_t wrong = 0, right = 0, asked_first = 0;
    for (const BiasSets& sets : bias_cases()) {
        SCOPED_TRACE(sets[0] + " " + sets[1]);
        BiasSets all = {"map.resolution=128"};
        all.insert(all.end(), sets.begin(), sets.end());
        const Session own = open("boxes", all);
        const std::string bundle = exported_without_bias(own);
        const Session unknown = open(bundle, {});
        BiasSets enter = {"map.bundle_bias=entered"};
        for (const std::string& set : sets)
            if (set.starts_with("bias.")) enter.push_back(set);
        const Session entered = open(bundle, enter);

        const Asked ours = ask(own), first = ask(unknown), then = ask(entered);
        EXPECT_EQ(ours.probes, then.probes);
        EXPECT_EQ(measured(own), measured(entered));
        ASSERT_EQ(ours.diagnoses.size(), then.diagnoses.size());
        for (std::size_t i = 0; i < ours.diagnoses.size(); ++i) {
            const PixelDiagnosis &a = ours.diagnoses[i], &b = then.diagnoses[i], &c = first.diagnoses[i];
            EXPECT_EQ(b.engine_bias, EngineBias::Entered);
            EXPECT_EQ(c.engine_bias, EngineBias::Unknown);
            EXPECT_EQ(a.right, b.right);
            EXPECT_EQ(a.cause().artefact, b.cause().artefact);
            EXPECT_EQ(a.has.depth, b.has.depth);
            EXPECT_EQ(a.least.depth, b.least.depth);
            if (a.reference.state != PixelState::Counted) continue;
            (a.right ? right : wrong) += 1;
            asked_first += c.verdict.starts_with("the engine's bias is unknown");
            // A fix that needs another map is said to.
            if (b.fix_of_map) {
                EXPECT_TRUE(b.verdict.starts_with(a.verdict)) << b.verdict;
                EXPECT_EQ(b.fix_of_map->settings, a.fix->settings);
            } else {
                EXPECT_EQ(a.verdict, b.verdict);
                EXPECT_EQ(a.fix.has_value(), b.fix.has_value());
                if (a.fix && b.fix) {
                    EXPECT_EQ(a.fix->settings, b.fix->settings);
                }
            }
        }
    }
    EXPECT_GT(wrong, 10u);
    EXPECT_GT(right, 20u);
    EXPECT_EQ(asked_first, wrong + right) << "no verdict speaks of the engine's pixel before";
}

// The amounts alone do not make the bias known, and a stated bias that the settings change is no longer the engine's.
TEST_F(BundleBiasTest, NotesSayWhoseBiasItIs) {
    const Session own = open("boxes", {"map.resolution=64", "bias.kind=constant", "bias.constant=0.4"});
    const auto note = [&](const Session& session) {
        std::string out;
        for (const std::string& n : renderer.render(session.scene, session.settings, small_request()).notes)
            if (n.find("the engine reads its map") != n.npos || n.find("bias.* are not") != n.npos) out += n;
        return out;
    };
    const std::string bundle = exported_without_bias(own);
    EXPECT_NE(note(open(bundle, {})).find("is unknown"), std::string::npos);
    EXPECT_NE(note(open(bundle, {"bias.kind=constant", "bias.constant=0.4"})).find("is unknown"), std::string::npos);
    EXPECT_EQ(note(open(bundle, {"bias.kind=constant", "bias.constant=0.4", "map.bundle_bias=entered"})), "");

    write_bundle_files(frame_bundle(renderer, own.scene, own.settings, {.width = kWidth, .height = kHeight}),
                       folder / "stated.bundle");
    const std::string stated = (folder / "stated.bundle").string();
    EXPECT_EQ(note(open(stated, {})), "");
    EXPECT_NE(note(open(stated, {"bias.constant=0.5"})).find("bias.* are not the bias that the bundle states"),
              std::string::npos);
    EXPECT_NE(note(open(stated, {"map.bundle_bias=unknown"})).find("is unknown"), std::string::npos);
    EXPECT_NE(note(open("boxes", {"map.bundle=" + stated})).find("bias.* are not"), std::string::npos)
        << "another scene's settings do not begin with the bundle's bias";
    EXPECT_EQ(note(open(stated, {"bias.constant=0.5", "map.bundle_maps=drawn"})), "") << "no engine has drawn it";
}

}  // namespace
}  // namespace si
