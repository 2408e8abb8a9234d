// Tests of `export --bundle`, and of commands on a bundle: an exported frame reads back with equal numbers.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/process.h"
#include "tests/support/text.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Exports a frame and returns the folder with out.bundle or out.zip.
fs::path exported(const Words& scene_and_settings, const std::string& name = "out.bundle") {
    const fs::path folder = fresh_test_folder();
    const ProcessResult r =
        run_program(Words("export") + scene_and_settings + Words("--size 192x108 --bundle " + name), folder);
    EXPECT_EQ(r.code, 0) << r.err;
    return folder;
}

/// Removes what a reader of a bundle may state otherwise: names, times, what drawing took, and whose map it is.
Json numbers_only(Json json) {
    if (json.is_object()) {
        for (const char* name : {"scene", "cost", "driver", "cures", "cpu_ms", "gpu_ms", "frame_ms", "ms", "seconds",
                                 "notes", "settings", "reason", "engine_bias", "engine_bias_from"})
            json.erase(name);
        for (auto& [name, value] : json.items()) value = numbers_only(value);
    } else if (json.is_array()) {
        for (Json& value : json) value = numbers_only(value);
    }
    return json;
}

/// Returns the first difference of two JSON values; empty where they are equal.
std::string first_difference(const Json& a, const Json& b) {
    const Json patch = Json::diff(a, b);
    return patch.empty() ? "" : patch[0].dump() + " of " + std::to_string(patch.size());
}

struct Case {
    const char* name;
    Words scene;
    std::vector<const char*> pixels;
};

const std::vector<Case>& cases() {
    static const std::vector<Case> out = {
        {"boxes by bias",
         "boxes --set map.resolution=256 --set bias.kind=slope --set bias.constant=0.5 --set "
         "bias.slope=1 --set bias.raster_slope=1 --set map.format=d16",
         {"60,70"}},
        {"reversed depth",
         "boxes --set map.resolution=256 --set map.reversed_z=true --set filter.kernel=vsm",
         {"90,80"}},
        {"spot",
         "boxes --set map.resolution=256 --set light.type=spot --set light.distance=14 --set light.cone=50",
         {"60,70"}},
        {"point", "boxes --set map.resolution=256 --set light.type=point --set light.distance=9", {"90,80"}},
        {"cascades", "stage --set map.resolution=256 --set light.cascades=3 --set light.fit=view", {"60,70"}},
        {"two lights",
         "boxes --set map.resolution=256 --set light.count=2 --set light.1.azimuth=60 --set "
         "light.1.cast=false",
         {"90,80"}},
        {"by hand",
         "boxes --set map.resolution=256 --set camera.source=manual --set camera.distance=9 --set "
         "camera.azimuth=20 --set scene.distance=1000",
         {"90,80"}},
    };
    return out;
}

SI_TEST_IS(Slow, BundleCommand, ExportedFramesMeasureAndProbeEqual);
TEST(BundleCommand, ExportedFramesMeasureAndProbeEqual) {
    for (const Case& c : cases()) {
        SCOPED_TRACE(c.name);
        Words scene = c.scene;
        // Causes that need masked casters drawn again take the given map as it is.
        if (c.scene.front() == "stage")
            for (int i = 1; i <= 9; ++i)
                scene = scene + Words{"--set", "object.Stage/Tree/Leaves " + std::to_string(i) + ".cast=false"};
        const fs::path folder = exported(scene);
        const Words size = "--size 192x108";
        const Json own = program_json(Words("measure --no-time") + scene + size, folder);
        const Json read = program_json(Words("measure --no-time out.bundle") + size, folder);
        EXPECT_EQ(first_difference(numbers_only(own), numbers_only(read)), "");
        // Fixes that need another map are not tried on an imported one, and the stage has such pixels.
        if (c.scene.front() == "stage") continue;
        for (const char* pixel : c.pixels) {
            const Words at = size + Words("--pixel") + Words(pixel);
            const Json a = program_json(Words("probe") + scene + at, folder);
            const Json b = program_json(Words("probe out.bundle") + at, folder);
            EXPECT_EQ(first_difference(numbers_only(a), numbers_only(b)), "") << pixel;
        }
    }
}

TEST(BundleCommand, PlansDifferInTheMapsAlone) {
    const Words scene = "boxes --set map.resolution=256 --set light.count=2 --set light.1.azimuth=60";
    const fs::path folder = exported(scene);
    const Json own = program_json(Words("plan") + scene + Words("--size 192x108"), folder);
    const Json read = program_json("plan out.bundle --size 192x108", folder);
    std::map<std::string, Json> drawn;
    for (const Json& e : own["effects"]) drawn[e["name"]] = e;
    int imported = 0;
    for (const Json& e : read["effects"]) {
        const std::string name = e["name"];
        ASSERT_TRUE(drawn.contains(name)) << name;
        const Json a = drawn[name];
        drawn.erase(name);
        const bool is_map = e["reason"].get<std::string>().find("mported") != std::string::npos;
        imported += is_map && name.starts_with("shadow map");
        if (is_map) continue;
        EXPECT_EQ(a["state"], e["state"]) << name;
        EXPECT_EQ(a["reason"], e["reason"]) << name;
    }
    // Casters are left out of maps that are drawn alone.
    for (const auto& [name, e] : drawn) EXPECT_NE(name.find("map"), std::string::npos) << name;
    EXPECT_EQ(imported, 2);
}

TEST(BundleCommand, ZipFolderAndFrameJsonAreOneScene) {
    const fs::path folder = exported("boxes --set map.resolution=128");
    ASSERT_EQ(run_program("export boxes --set map.resolution=128 --size 192x108 --bundle out.zip", folder).code, 0);
    const auto picture = [&](const std::string& scene) {
        const ProcessResult r = run_program("render " + scene + " --size 96x54 -o p.png", folder);
        EXPECT_EQ(r.code, 0) << r.err;
        return file_bytes(folder / "p.png");
    };
    const std::string own = picture("boxes --set map.resolution=128");
    for (const char* name : {"out.bundle", "out.bundle/", "out.bundle/frame.json", "out.zip"})
        EXPECT_EQ(picture(name), own) << name;
}

TEST(BundleCommand, MapsInExrReadAsThoseInPfm) {
    const std::string frame = "stage --set map.resolution=128 --set light.type=spot --set map.format=d16";
    const fs::path folder = exported(frame);
    for (const char* name : {"exr.bundle", "exr.zip"})
        ASSERT_EQ(
            run_program(Words("export " + frame + " --size 192x108 --maps exr --bundle ") + Words(name), folder).code,
            0);
    EXPECT_TRUE(fs::exists(folder / "exr.bundle/maps/light0-0.exr"));
    EXPECT_FALSE(fs::exists(folder / "exr.bundle/maps/light0-0.pfm"));
    const auto stored = [&](const std::string& scene) {
        const ProcessResult r = run_program("render " + scene + " --view shadow-map --size 128x128 -o map.pfm", folder);
        EXPECT_EQ(r.code, 0) << r.err;
        return file_bytes(folder / "map.pfm");
    };
    const std::string own = stored(frame);
    for (const char* name : {"out.bundle", "exr.bundle", "exr.zip"}) EXPECT_EQ(stored(name), own) << name;
    expect_error("export boxes --maps exr -o a.glb", 2, "--bundle", folder);
    expect_error("export boxes --maps tiff --bundle a.zip", 2, "pfm, exr", folder);
}

TEST(BundleCommand, TheSettingChoosesAndRemovesTheMaps) {
    const fs::path folder = exported("boxes --set map.resolution=128");
    fs::create_directories(folder / "presets");
    const auto state = [&](const Words& words) {
        const Json plan = program_json(Words("plan") + words + Words("--size 96x54"), folder);
        for (const Json& e : plan["effects"])
            if (e["name"] == "shadow map 0 (directional)") return e["reason"].get<std::string>();
        return std::string("none");
    };
    EXPECT_NE(state("out.bundle").find("Imported"), std::string::npos);
    EXPECT_EQ(state("out.bundle --set map.bundle=").find("Imported"), std::string::npos);
    EXPECT_NE(state("boxes --set map.bundle=out.bundle").find("Imported"), std::string::npos);
    expect_error("plan boxes --set map.bundle=none.bundle", 1, "none.bundle: cannot be opened", folder);
    expect_error("plan none.zip", 1, "none.zip: cannot be opened", folder);
    EXPECT_EQ(run_program("scene out.bundle", folder).code, 0);
}

/// Removes the bias of all look-ups from a bundle's frame.json.
void remove_bias(const fs::path& bundle) {
    Json frame = Json::parse(file_bytes(bundle / "frame.json"));
    for (Json& light : frame["lights"]) light["lookup"].erase("bias");
    for (const char* key : {"kind", "unit", "constant", "slope", "plane_clamp", "normal", "normal_source"})
        frame["settings"].erase(std::string("bias.") + key);
    std::ofstream(bundle / "frame.json") << frame.dump();
}

SI_TEST_IS(Slow, BundleCommand, ABiasThatIsEnteredCounts);
TEST(BundleCommand, ABiasThatIsEnteredCounts) {
    const Words bias =
        "--set bias.kind=slope --set bias.unit=texels --set bias.constant=0.2 --set bias.slope=0.5 --set bias.normal=0";
    const Words scene = Words("boxes --set map.resolution=128") + bias, size = "--size 192x108";
    // The pixel is right with and without this bias, so that no fix is searched.
    const Words pixel = "--pixel 100,60";
    const fs::path folder = exported(scene);
    remove_bias(folder / "out.bundle");
    const Words entered = Words("out.bundle") + bias + Words("--set map.bundle_bias=entered");
    const auto probed = [&](const Words& words) { return program_json(Words("probe") + words + size + pixel, folder); };
    const auto dossier = [&](const Words& words) { return probed(words)["lights"][0]["dossier"]; };
    const Json own = dossier(scene), before = dossier("out.bundle"), then = dossier(entered);
    EXPECT_EQ(own["engine_bias"], "own");
    EXPECT_EQ(own["engine_bias_from"], nullptr);
    EXPECT_EQ(before["engine_bias"], "unknown");
    EXPECT_EQ(before["engine_bias_from"], nullptr);
    EXPECT_TRUE(before["verdict"].get<std::string>().starts_with("the engine's bias is unknown"));
    EXPECT_EQ(then["engine_bias"], "known");
    EXPECT_EQ(then["engine_bias_from"], "entered");
    EXPECT_EQ(own["verdict"], then["verdict"]);
    EXPECT_EQ(dossier(Words("out.bundle") + bias)["engine_bias"], "unknown") << "amounts alone state nothing";

    const auto measured = [&](const Words& words) {
        return program_json(Words("measure --no-time") + words + size, folder);
    };
    const Json ours = measured(scene), unknown = measured("out.bundle"), known = measured(entered);
    EXPECT_EQ(ours["engine_bias"], "own");
    EXPECT_EQ(unknown["engine_bias"], "unknown");
    EXPECT_EQ(known["engine_bias"], "known");
    EXPECT_EQ(known["engine_bias_from"], "entered");
    EXPECT_EQ(ours["error"], known["error"]);

    const auto compared = [&](const Words& words) {
        return program_json(Words("compare-maps --json") + words, folder)["bias"][0];
    };
    const Json bias_of_unknown = compared("out.bundle"), bias_of_known = compared(entered);
    EXPECT_EQ(bias_of_unknown["engine_bias"], nullptr);
    EXPECT_EQ(bias_of_unknown["engine_bias_from"], nullptr);
    EXPECT_NE(bias_of_known["engine_bias"], nullptr);
    EXPECT_EQ(bias_of_known["engine_bias_from"], "entered");
    EXPECT_FALSE(bias_of_known["enough"].empty());

    // A preset keeps it, and the text says it.
    EXPECT_EQ(run_program(Words("preset save -o entered.json") + entered, folder).code, 0);
    const ProcessResult text =
        run_program(Words("probe out.bundle --preset entered.json --no-truth") + size + pixel, folder);
    EXPECT_NE(text.out.find("the engine's bias: as entered (map.bundle_bias)"), std::string::npos) << text.out;
    expect_error("probe out.bundle --pixel 1,1 --set map.bundle_bias=enterd", 2, "entered", folder);
}

// A sweep begins at the settings of the bundle, and so do other searches.
SI_TEST_IS(Later, BundleCommand, ASweepBeginsAtTheSettingsOfTheBundle);
TEST(BundleCommand, ASweepBeginsAtTheSettingsOfTheBundle) {
    const Words scene =
        "boxes --set map.resolution=128 --set filter.kernel=pcf3 --set bias.kind=constant --set bias.constant=0.3 "
        "--set bias.normal=1.5";
    const fs::path folder = exported(scene);
    const auto rows = [&](const Words& words, const std::string& out) {
        const ProcessResult r = run_program(
            Words("sweep") + words + Words("--vary bias.constant=0.3,2 --no-time --size 96x54 -o " + out), folder);
        EXPECT_EQ(r.code, 0) << r.err;
        const Json results = Json::parse(file_bytes(folder / out / "results.json"));
        Json errors = Json::array();
        for (const Json& row : results["rows"]) errors.push_back(row["error"]);
        return errors;
    };
    const Json own = rows(scene, "own"), theirs = rows("out.bundle", "theirs");
    ASSERT_EQ(own.size(), 2u);
    EXPECT_EQ(own, theirs);
    EXPECT_NE(own[0], own[1]);
}

SI_TEST_IS(Slow, BundleCommand, FixesThatNeedAnotherMapAreTriedOnAnOwnOne);
TEST(BundleCommand, FixesThatNeedAnotherMapAreTriedOnAnOwnOne) {
    const fs::path folder = exported("boxes --set map.resolution=48");
    const Words size = "--size 96x54";
    const Json measured = program_json(Words("measure --no-time --cures out.bundle") + size, folder);
    std::size_t own = 0, given = 0, views = 0;
    for (const Json& row : measured["cures"]) {
        const Json& settings = row["settings"];
        if (!row["tried"].get<bool>()) {
            views += row["reason"] == "needs another map from the engine";
            continue;
        }
        const bool redrawn = settings.contains("map.bundle_maps");
        EXPECT_EQ(row["own_map"], redrawn) << row.dump();
        (redrawn ? own : given) += 1;
        EXPECT_TRUE(redrawn || !settings.contains("map.resolution"));
    }
    EXPECT_GT(own, 3u);
    EXPECT_GT(given, 10u);
    EXPECT_GT(views, 0u) << "other fits";
    const ProcessResult text = run_program(Words("measure --no-time --cures out.bundle") + size, folder);
    EXPECT_NE(text.out.find("tried on the inspector's own map from the same light"), std::string::npos) << text.out;
}

TEST(BundleCommand, ExportRefusesBadNamesAndInputs) {
    const fs::path folder = exported("boxes --set map.resolution=64");
    expect_error("export boxes --bundle out.glb", 2, "ends in .bundle (a folder) or .zip", folder);
    expect_error("export boxes", 2, "-o FILE or --bundle BUNDLE", folder);
    expect_error("export boxes -o a.glb --bundle b.zip", 2, "--bundle", folder);
    expect_error("export out.bundle --bundle out.bundle", 2, "of this bundle is read; write another one", folder);
    expect_error("export boxes --bundle none/out.zip", 1, "none", folder);
    expect_error("export boxes --set light.cast=false --bundle a.zip", 1, "no light has a shadow map", folder);
    expect_error("export boxes --set map.virtual=true --bundle a.zip", 1, "map.virtual", folder);
    EXPECT_FALSE(fs::exists(folder / "a.zip"));
}

}  // namespace
}  // namespace si
