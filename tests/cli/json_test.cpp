// Tests of the JSON for scripts: lists, reports, probes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/commands/commands.h"
#include "app/session/presets.h"
#include "renderer/scenes/hard_cases.h"
#include "renderer/settings/param.h"
#include "tests/support/process.h"
#include "tests/support/text.h"
#include "tests/support/traits.h"

namespace si {
namespace {

using Json = nlohmann::json;

const Json* row(const Json& list, const std::string& key) {
    const auto it = std::find_if(list.begin(), list.end(), [&](const Json& r) { return r["key"] == key; });
    return it == list.end() ? nullptr : &*it;
}

TEST(Lists, RowsHaveKeyLabelAndHelp) {
    for (const std::string& kind : list_kinds()) {
        const Json list = program_json({"list", kind});
        ASSERT_TRUE(list.is_array()) << kind;
        if (kind != "presets") {
            EXPECT_FALSE(list.empty()) << kind;
        }
        for (const Json& r : list) {
            EXPECT_TRUE(r["key"].is_string() && r["label"].is_string() && r["help"].is_string()) << r;
            EXPECT_FALSE(r["help"].get<std::string>().empty()) << r;
        }
    }
    EXPECT_EQ(program_json("list scenes")[0]["key"], "stage");
}

TEST(Lists, TechniquesNameTheirSourceAndTheirSettings) {
    const Json settings = program_json("list settings");
    for (const char* kind : {"filters", "biases", "overlays"}) {
        std::size_t papers = 0;
        for (const Json& r : program_json({"list", kind})) {
            ASSERT_TRUE(r["paper"].is_string()) << r;
            papers += !r["paper"].get<std::string>().empty();
            EXPECT_TRUE(std::filesystem::exists(SI_SOURCE_DIR "/shaders/" + r["file"].get<std::string>())) << r;
            if (!r.contains("settings")) continue;
            for (const Json& key : r["settings"]) EXPECT_TRUE(row(settings, key)) << key;
        }
        EXPECT_GT(papers, 2u) << kind;
    }
    const Json list = program_json("list biases");
    const Json* plane = row(list, "receiver-plane");
    ASSERT_TRUE(plane);
    EXPECT_EQ((*plane)["stage"], "compare");
    EXPECT_EQ((*plane)["per_texel"], true);
    EXPECT_EQ((*plane)["settings"], Json({"bias.constant", "bias.unit", "bias.plane_clamp"}));
    EXPECT_NE((*plane)["paper"].get<std::string>().find("Isidoro"), std::string::npos);
    // bias.kind offers exactly the rows of that stage.
    for (const Json& r : list) {
        bool choice = false;
        for (const Json& c : (*row(settings, "bias.kind"))["choices"]) choice |= c["key"] == r["key"];
        EXPECT_EQ(choice, r["stage"] == "compare") << r;
    }
    EXPECT_NE(run_program("list biases").out.find("Isidoro"), std::string::npos);
}

TEST(Lists, SettingsNameTheirValues) {
    const Json list = program_json("list settings");
    ASSERT_EQ(list.size(), params().size());
    for (const std::string& key :
         Words("map.resolution map.format map.wrap map.outside map.far_guard map.compare map.reversed_z caster.cull "
               "bias.unit bias.constant bias.slope bias.normal bias.raster_slope bias.raster_units bias.normal_source "
               "filter.kernel light.type light.azimuth light.elevation light.distance light.size light.near light.far "
               "light.extent light.fit light.count view.map"))
        EXPECT_TRUE(row(list, key)) << key;
    const Json& resolution = *row(list, "map.resolution");
    EXPECT_EQ(resolution["type"], "int");
    EXPECT_EQ(resolution["unit"], "texels");
    EXPECT_EQ(resolution["max"], 16384);
    EXPECT_EQ(resolution["default"], Settings{}.map.resolution);
    const Json& format = *row(list, "map.format");
    EXPECT_EQ(format["type"], "choice");
    EXPECT_EQ(format["default"], "d32f");
    ASSERT_EQ(format["choices"].size(), 6u);
    EXPECT_EQ(format["choices"][3]["key"], "colour");
    EXPECT_EQ((*row(list, "map.reversed_z"))["type"], "bool");
    const Json& name = *row(list, "light.name");
    EXPECT_EQ(name["type"], "text");
    EXPECT_EQ(name["max"], 60);
    EXPECT_EQ(name["default"], "");
}

TEST(Lists, PrefixNarrowsTheList) {
    EXPECT_EQ(program_json("list settings bias.").size(), 12u);
    EXPECT_EQ(program_json("list settings bias").size(), 12u) << "the beginning of keys goes before words";
    // Keys in the form of --set are found too: rows cover all lights and all objects.
    const Json fit = program_json("list settings light.0.fit");
    ASSERT_EQ(fit.size(), 1u);
    EXPECT_EQ(fit[0]["key"], "light.fit");
    EXPECT_EQ(program_json("list settings light.15."), program_json("list settings light."));
    EXPECT_EQ(program_json("list settings object.Root/Box.cast")[0]["key"], "object.PATH.cast");
}

TEST(Lists, SettingsAreFoundByWordsIfNoKeyHasThePrefix) {
    for (const auto& [words, key] : {std::pair{"normal bias", "bias.normal"},
                                     {"softness", "filter.radius"},
                                     {"cascade", "light.split"},
                                     {"slope scale", "bias.raster_slope"},
                                     {"depth bias", "bias.constant"},
                                     {"shadow_normal_bias", "bias.normal"},
                                     {"PCSS", "filter.kernel"},
                                     {"castShadows", "object.PATH.cast"}}) {
        const Json list = program_json({"list", "settings", words});
        EXPECT_TRUE(row(list, key)) << words;
        EXPECT_LT(list.size(), params().size() / 2) << words;
    }
    EXPECT_NE(run_program("list settings softness").out.find("filter.radius"), std::string::npos);
}

TEST(Help, IsPrintedByEveryCommandFromTheTable) {
    std::string help_of_render;
    for (const char* command : {"", "edit", "render", "probe", "list", "info", "preset", "preset check", "preset show",
                                "preset save", "export", "overview", "sweep", "merge", "docs"}) {
        const ProcessResult r = run_program(Words(command) + "--help");
        EXPECT_EQ(r.code, 0) << command;
        EXPECT_NE(r.out.find("--help"), std::string::npos) << command;
        EXPECT_EQ(r.err, "") << command;
        if (std::string_view(command) == "render") help_of_render = r.out;
    }
    for (const Param& p : params())
        EXPECT_TRUE(p.scope == Scope::Object || help_of_render.find(p.key) != std::string::npos) << p.key;
}

TEST(Report, HoldsSceneSettingsFitAndPasses) {
    const auto folder = fresh_test_folder();
    const ProcessResult r = run_program(
        "render boxes -o a.png --size 64x48 --report r.json --set map.resolution=256 --set light.elevation=90 --set "
        "light.fit=scene",
        folder);
    ASSERT_EQ(r.code, 0) << r.err;
    const Json report = Json::parse(file_bytes(folder / "r.json"));
    for (const char* count : {"triangles", "meshes", "nodes"}) EXPECT_GT(report["scene"][count], 0) << count;
    const Json bounds = report["scene"]["bounds"];
    EXPECT_LT(bounds["min"][0], bounds["max"][0]);
    EXPECT_EQ(report["settings"]["map.resolution"], 256);
    EXPECT_EQ(report["settings"]["filter.kernel"], "pcf");
    EXPECT_EQ(report["picture"]["width"], 64);
    ASSERT_EQ(report["fit"].size(), 1u);
    const Json& fit = report["fit"][0];
    EXPECT_LT(fit["depth_range_m"][0], fit["depth_range_m"][1]);
    // An orthographic map holds the whole floor: width over resolution, with the margin of the fit.
    const double width = bounds["max"][0].get<double>() - bounds["min"][0].get<double>();
    EXPECT_GT(fit["texel_size_m"].get<double>(), width / 256);
    EXPECT_LT(fit["texel_size_m"].get<double>(), 2 * width / 256);
    bool mapped = false;
    for (const Json& pass : report["passes"]) {
        EXPECT_TRUE(pass["state"] == "ran" || pass["state"] == "reused" || pass["state"] == "skipped");
        EXPECT_FALSE(pass["reason"].get<std::string>().empty()) << pass;
        EXPECT_TRUE(pass["state"] != "skipped" || pass["draws"] == 0) << pass;
        if (!pass["name"].get<std::string>().starts_with("shadow map") || pass["state"] != "ran") continue;
        mapped = true;
        for (const char* number : {"gpu_ms", "draws", "triangles"}) EXPECT_GT(pass[number], 0) << number;
    }
    EXPECT_TRUE(mapped);
    EXPECT_FALSE(report["clock"].get<std::string>().empty());
}

SI_TEST_IS(Later, Report, MatricesAreRowsAndAgreeWithTheProbe);
TEST(Report, MatricesAreRowsAndAgreeWithTheProbe) {
    const auto folder = fresh_test_folder();
    const Words view = "boxes --size 64x48 --set light.type=spot --set light.azimuth=20";
    ASSERT_EQ(run_program("render -o a.png --report r.json" + view, folder).code, 0);
    const Json probe = program_json("probe --pixel 32,30" + view);
    ASSERT_TRUE(probe["hit"]);
    const Json matrix = Json::parse(file_bytes(folder / "r.json"))["fit"][0]["matrices"]["clip_from_world"];
    const Json& p = probe["position_ws"];
    for (std::size_t r = 0; r < 4; ++r) {
        double clip = matrix[r][3];
        for (std::size_t c = 0; c < 3; ++c) clip += matrix[r][c].get<double>() * p[c].get<double>();
        EXPECT_NEAR(clip, probe["lights"][0]["clip"][r].get<double>(), 1e-4 * (1 + std::abs(clip))) << r;
    }
}

// The light is edge-on to the tower's side: infinite amounts are null in JSON and a word in text.
TEST(Probe, PrintsWordsForMissingNumbers) {
    const Words probe =
        "probe boxes --pixel 32,24 --size 64x48 --set light.elevation=90 --set light.azimuth=90 "
        "--set camera.source=manual --set camera.azimuth=-12 --set camera.elevation=5 --set camera.distance=3 "
        "--set camera.target_x=2 --set camera.target_y=1.2 --set camera.target_z=-1.6";
    const Json light = program_json(probe)["lights"][0];
    EXPECT_NEAR(light["n_dot_l"], 0, 1e-6);
    EXPECT_EQ(light["dossier"]["truth"]["state"], "faces_away");
    EXPECT_TRUE(light["bias"]["least"]["texels"].is_null());
    const ProcessResult text = run_program(probe);
    EXPECT_EQ(text.code, 0) << text.err;
    EXPECT_NE(text.out.find("needed                    infinite"), std::string::npos) << text.out;
    EXPECT_EQ(text.out.find("nan"), std::string::npos) << text.out;
    EXPECT_EQ(text.out.find("inf "), std::string::npos) << text.out;
}

TEST(Probe, PrintsTheDepthTestInFull) {
    const Words command = "probe boxes --pixel 32,40 --size 64x48";
    const Json probe = program_json(command);
    ASSERT_TRUE(probe["hit"]);
    EXPECT_FALSE(probe["object"].get<std::string>().empty());
    const Json& light = probe["lights"][0];
    for (const std::string& key :
         Words("light face casts clip ndc uvd texel n_dot_l stored stored_m own own_m bias_depth bias_texels bias_m "
               "normal_offset_m texel_m compared visibility where verdict gap_m"))
        EXPECT_TRUE(light.contains(key)) << key;
    const double w = light["clip"][3], x = light["clip"][0], ndc = light["ndc"][0], u = light["uvd"][0];
    EXPECT_NEAR(ndc, x / w, 1e-9);
    EXPECT_NEAR(u, ndc * 0.5 + 0.5, 1e-9);
    const ProcessResult text = run_program(command);
    EXPECT_EQ(text.code, 0) << text.err;
    EXPECT_EQ(test::lacking(text.out, {"clip space", "divided by w", "stored depth", "compared depth", "visibility",
                                       light["verdict"].get<std::string>()}),
              "");
}

SI_TEST_IS(Slow, Probe, DiagnosesThePixelAndNamesItsFix);
TEST(Probe, DiagnosesThePixelAndNamesItsFix) {
    const Words command =
        "probe boxes --pixel 160,130 --size 320x180 --set bias.kind=constant --set bias.normal=0 --set bias.constant=0 "
        "--set filter.kernel=pcf5";
    const Json probe = program_json(command);
    EXPECT_EQ(probe["hit"], true);
    const Json& light = probe["lights"][0];
    const Json& d = light["dossier"];
    EXPECT_EQ(d["truth"]["state"], "counted");
    EXPECT_EQ(d["truth"]["lit"], true);
    EXPECT_NE(d["verdict"].get<std::string>().find("acne"), std::string::npos) << d["verdict"];
    EXPECT_EQ(d["window"]["open"], true);
    EXPECT_TRUE(d["window"]["occluder"]["depth"].is_null()) << "nothing stands between";
    const Json& bias = light["bias"];
    double parts = 0;
    for (const auto& [name, part] : bias["least_parts"].items()) parts += part["texels"].get<double>();
    EXPECT_NEAR(parts, bias["least"]["texels"].get<double>(), 1e-9);
    EXPECT_EQ(bias["worth"]["texels"], 0);
    ASSERT_EQ(light["taps"].size(), 36u);
    double lit = 0;
    int own = 0;
    for (const Json& tap : light["taps"]) {
        lit += tap["lit"].get<bool>() ? tap["weight"].get<double>() : 0;
        own += !tap["lit"].get<bool>() && tap["meets"] == "own surface";
    }
    EXPECT_NEAR(lit, light["visibility"].get<double>(), 1e-3);
    EXPECT_GT(own, 0);
    // The reported fix is the first row of the searched ones, and it cures the pixel.
    ASSERT_TRUE(d["remedy"].is_object());
    ASSERT_TRUE(probe["cures"].is_array() && !probe["cures"].empty());
    const Json& first = probe["cures"][0];
    EXPECT_EQ(first["settings"], d["remedy"]["settings"]);
    EXPECT_TRUE(first["pixel_right"].get<bool>());
    EXPECT_TRUE(first["fix"].get<bool>());
    EXPECT_TRUE(first["ms"].is_object());
    EXPECT_EQ(probe.at("cures_stopped"), false);
    const Json after = program_json(command + set_words(first["settings"]));
    const Json& cured = after["lights"][0];
    EXPECT_NEAR(cured["visibility"].get<double>(), 1, 0.25);
    EXPECT_EQ(cured["dossier"]["artefact"], "none");
    EXPECT_EQ(after["cures"], Json::array()) << "nothing is wrong";
    EXPECT_FALSE(program_json(command + "--no-truth")["lights"][0].contains("dossier"));
    EXPECT_EQ(test::lacking(run_program(command).out,
                            {"verdict: ", "fix: ", "\n    needed ", "\n    have ", "S self-shadowed", "bias window ["}),
              "");
}

TEST(Info, NamesTheDriverAndLargePagesIfTheSystemHasThem) {
    const Json info = program_json("info");
    const std::string mode = file_bytes("/sys/kernel/mm/transparent_hugepage/enabled");
    const bool has = mode.find("[always]") != mode.npos || mode.find("[madvise]") != mode.npos;
    EXPECT_EQ(info["memory_pages"], has ? "large" : "small") << mode;
    EXPECT_FALSE(info["driver"]["renderer"].get<std::string>().empty());
    EXPECT_FALSE(info["driver"]["clock"].get<std::string>().empty());
    EXPECT_GE(info["driver"]["max_texture_size"], 1024);
    for (const char* format : {"d16", "d24", "d32f", "colour"}) {
        const Json& offset = info["driver"]["polygon_offset"][format];
        EXPECT_NE(offset["unit_depth"] > 0, offset["unit_steps"] > 0) << format;
        EXPECT_TRUE(offset["slope"] == "larger" || offset["slope"] == "length") << format;
        EXPECT_NEAR(offset["slope_gain"], 1, 0.02) << format;
    }
}

TEST(List, PrintsPresetsInColumns) {
    const auto presets = builtin_presets();
    std::istringstream lines(run_program("list presets").out);
    std::size_t column = 0, found = 0;
    for (std::string line; std::getline(lines, line);)
        for (const BuiltinPreset& p : presets) {
            if (!line.starts_with("  " + p.key + " ")) continue;
            const std::size_t at = line.find("  " + p.title + " (");  // two spaces separate the title from the key
            ASSERT_NE(at, std::string::npos) << line;
            if (column == 0) column = at;
            EXPECT_EQ(at, column) << line;
            ++found;
        }
    EXPECT_EQ(found, presets.size());
}

SI_TEST_IS(Later, HardCases, AreListedAndOpenByNameAsSceneAndAsPreset);
TEST(HardCases, AreListedAndOpenByNameAsSceneAndAsPreset) {
    const Json list = program_json("list hard-cases");
    EXPECT_EQ(list.size(), hard_cases().size());
    const Json* grazing = row(list, "hard/grazing");
    ASSERT_TRUE(grazing);
    EXPECT_EQ((*grazing)["number"], 1);
    EXPECT_EQ((*grazing)["fixed"], "hard/grazing-fixed");
    const Json whole = program_json("measure hard/grazing --no-time --size 96x72");
    const Json preset = program_json("measure hard/grazing-fixed --preset hard/grazing --no-time --size 96x72");
    const Json mended = program_json("measure hard/grazing-fixed --no-time --size 96x72");
    EXPECT_GT(whole["error"]["acne"].get<double>(), 0.1);
    EXPECT_EQ(preset["error"], whole["error"]);
    EXPECT_LT(mended["error"]["acne"].get<double>(), 0.01);
    const ProcessResult diff = run_program("preset diff hard/grazing hard/grazing-fixed");
    EXPECT_EQ(diff.code, 0) << diff.err;
    EXPECT_NE(diff.out.find("bias.kind"), std::string::npos) << diff.out;
}

TEST(Docs, TheWrittenPagesAreUpToDate) {
    for (const auto& [name, page] : {std::pair<std::string, std::string>{"settings", settings_page()},
                                     {"presets", presets_page()},
                                     {"metrics", metrics_page()},
                                     {"hard-cases", hard_cases_page()}})
        EXPECT_EQ(file_bytes(SI_SOURCE_DIR "/docs/" + name + ".md"), page)
            << "write it with: shadow-inspector docs " << name << " -o docs/" << name << ".md";
}

}  // namespace
}  // namespace si
