// Tests of the command `check`: limits, baselines, JUnit reports, captures and exit codes.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "tests/support/missing_reason.h"
#include "tests/support/process.h"
#include "tests/support/strict_xml.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Picture with acne: no bias, and a coarse map.
const Words kCheckedAcne =
    "boxes --size 96x54 --set bias.kind=constant --set bias.constant=0 --set bias.normal=0 --set filter.kernel=hard "
    "--set map.resolution=256";

/// Runs `check` on the picture with acne.
ProcessResult check_acne(const Words& options, const fs::path& folder) {
    return run_program(Words("check") + kCheckedAcne + options, folder);
}

void write_check_text(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

SI_TEST_IS(Slow, Check, LimitsAreOnTheNumbersOfMeasure);
TEST(Check, LimitsAreOnTheNumbersOfMeasure) {
    const fs::path folder = fresh_test_folder();
    const Json measured = program_json(Words("measure --json --no-time") + kCheckedAcne, folder)["error"];
    const auto acne = measured["artefacts"]["acne"].get<int>();
    const auto counted = measured["pixels"]["counted"].get<double>();
    const double shares = measured["false_shadow"].get<double>() + measured["false_light"].get<double>();
    const int wrong = int(std::lround(shares * counted));
    const auto mae = measured["mae"].get<double>();
    ASSERT_GT(acne, 1);
    ASSERT_GT(wrong, acne);
    const auto code = [&](const std::string& option, const std::string& value) {
        return check_acne({option, value}, folder).code;
    };
    EXPECT_EQ(code("--max-acne", std::to_string(acne)), 0);
    EXPECT_EQ(code("--max-acne", std::to_string(acne - 1)), 3);
    EXPECT_EQ(code("--max-wrong", std::to_string(wrong)), 0);
    EXPECT_EQ(code("--max-wrong", std::to_string(wrong - 1)), 3);
    EXPECT_EQ(code("--max-wrong", std::to_string(100 * (wrong + 0.5) / counted) + "%"), 0);
    EXPECT_EQ(code("--max-wrong", std::to_string(100 * (wrong - 0.5) / counted) + "%"), 3);
    EXPECT_EQ(code("--max-error", std::to_string(mae * 1.01)), 0);
    EXPECT_EQ(code("--max-error", std::to_string(mae * 0.99)), 3);
    const ProcessResult iou = check_acne("--max-error 0 --error iou", folder);
    EXPECT_EQ(iou.code, 3);
    EXPECT_NE(iou.out.find("exceeded: max-error iou: "), std::string::npos) << iou.out;

    const ProcessResult both = check_acne("--max-acne 0 --max-wrong 100%", folder);
    EXPECT_EQ(both.code, 3);
    EXPECT_EQ(both.err, "shadow-inspector: boxes: 1 of 2 limits is exceeded\n");
    EXPECT_EQ(both.out.find("exceeded: max-acne acne_px: " + std::to_string(acne) + " pixels, "), 0u) << both.out;
    EXPECT_NE(both.out.find("passed: max-wrong wrong_px: " + std::to_string(wrong) + " pixels, "), std::string::npos);
    EXPECT_NE(both.out.find("(acne " + std::to_string(acne)), std::string::npos) << both.out;

    const ProcessResult printed = check_acne("--max-acne 0 --max-error 1 --json", folder);
    EXPECT_EQ(printed.code, 3);
    const Json json = Json::parse(printed.out);
    EXPECT_EQ(json["format"], "shadow-inspector-check");
    EXPECT_EQ(json["passed"], false);
    ASSERT_EQ(json["checks"].size(), 2u);
    EXPECT_EQ(json["checks"][0]["check"], "max-acne");
    EXPECT_EQ(json["checks"][0]["value"], acne);
    EXPECT_EQ(json["checks"][0]["passed"], false);
    EXPECT_EQ(json["checks"][1]["field"], "mae");
    EXPECT_EQ(json["checks"][1]["value"], mae);
    EXPECT_EQ(json["error"], measured);
    EXPECT_TRUE(fs::is_empty(folder));
}

SI_TEST_IS(Later, Check, TheReferenceIsHardUnlessAreaIsGiven);
TEST(Check, TheReferenceIsHardUnlessAreaIsGiven) {
    const fs::path folder = fresh_test_folder();
    const std::string options = "check boxes --size 32x18 --max-wrong 100% --json ";
    ASSERT_EQ(run_program("preset save boxes --set truth.area=true -o area.json", folder).code, 0);
    EXPECT_EQ(program_json(options + "--preset area.json", folder)["area"], false);
    EXPECT_EQ(program_json(options + "--preset area.json --area", folder)["area"], true);
    EXPECT_EQ(program_json(options + "--set truth.area=true", folder)["area"], true);
    const Json standard = program_json("check boxes --max-wrong 100% --json", folder);
    EXPECT_EQ(standard["width"], 640);
    EXPECT_EQ(standard["height"], 360);
}

SI_TEST_IS(Later, Check, ABaselineIsKeptByTheSamePictureAndExceededByAWorseOne);
TEST(Check, ABaselineIsKeptByTheSamePictureAndExceededByAWorseOne) {
    const fs::path folder = fresh_test_folder();
    ASSERT_EQ(check_acne("--write-baseline base.json", folder).out, "wrote base.json\n");
    const ProcessResult same = check_acne("--baseline base.json", folder);
    EXPECT_EQ(same.code, 0) << same.err;
    EXPECT_EQ(same.out.find("exceeded"), std::string::npos) << same.out;
    const ProcessResult worse = check_acne("--baseline base.json --set map.resolution=64", folder);
    EXPECT_EQ(worse.code, 3) << worse.err;
    EXPECT_NE(worse.out.find("exceeded: baseline-wrong"), std::string::npos) << worse.out;
    EXPECT_EQ(check_acne("--baseline base.json --tolerance 100% --set map.resolution=64", folder).code, 0);
    // A picture beyond its limits becomes no baseline.
    EXPECT_EQ(check_acne("--max-acne 0 --write-baseline other.json", folder).code, 3);
    EXPECT_FALSE(fs::exists(folder / "other.json"));
}

SI_TEST_IS(Later, Check, ABaselineOfOtherCircumstancesCannotBeCompared);
TEST(Check, ABaselineOfOtherCircumstancesCannotBeCompared) {
    const fs::path folder = fresh_test_folder();
    ASSERT_EQ(check_acne("--write-baseline base.json", folder).code, 0);
    const Json good = Json::parse(file_bytes(folder / "base.json"));
    EXPECT_EQ(good["error"]["meaning"].type(), Json::value_t::number_unsigned);
    const auto with = [&](const std::function<void(Json&)>& change, const Words& options) {
        Json json = good;
        change(json);
        write_check_text(folder / "changed.json", json.dump());
        return check_acne(Words("--baseline changed.json") + options, folder);
    };
    const auto driver = [](Json& j) { j["driver"] = "another driver"; };
    const auto meaning = [](Json& j) { j["error"]["meaning"] = 1; };
    for (const auto& [change, text] :
         {std::pair<std::function<void(Json&)>, const char*>{driver, "measured with the driver \"another driver\""},
          {meaning, "its errors have meaning 1, and this program's have "},
          {[](Json& j) { j["width"] = 97; }, "pass --size 97x54"},
          {[](Json& j) { j.erase("error"); }, "changed.json: error is missing"},
          {[](Json& j) { j = 4; }, "changed.json: is no baseline of `check`"}}) {
        const ProcessResult r = with(change, "");
        EXPECT_EQ(r.code, 1) << text;
        EXPECT_EQ(r.err.find("shadow-inspector: changed.json: "), 0u) << r.err;
        EXPECT_NE(r.err.find(text), std::string::npos) << r.err;
        EXPECT_EQ(r.out, "");
    }
    for (const auto& change : {std::function<void(Json&)>(driver), std::function<void(Json&)>(meaning)}) {
        const ProcessResult r = with(change, "--tolerance 0");
        EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_NE(r.err.find("compared within --tolerance"), std::string::npos) << r.err;
    }
    EXPECT_EQ(with([](Json& j) { j["width"] = 97; }, "--tolerance 1%").code, 1);
    fs::create_directory(folder / "folder.json");
    write_check_text(folder / "broken.json", "{");
    for (const char* file : {"none.json", "folder.json", "broken.json"})
        expect_error(Words("check --baseline") + Words(file) + kCheckedAcne, 1, file, folder);
}

TEST(Check, UsageErrorsAndFilesThatCannotBeWritten) {
    const fs::path folder = fresh_test_folder();
    write_check_text(folder / "base.json", "{}");
    const auto fails = [&](const Words& options, int code, const char* text) {
        expect_error(Words("check boxes") + options, code, text, folder);
    };
    fails("", 2, "no limit is given");
    fails("--junit a.xml", 2, "no limit is given");
    fails("--max-acne -1", 2, "--max-acne");
    fails("--max-acne 1.5", 2, "--max-acne \"1.5\": must be a whole number of pixels");
    fails("--max-wrong 101%", 2, "--max-wrong");
    fails("--max-wrong nan%", 2, "--max-wrong");
    fails("--max-error nan", 2, "--max-error");
    fails("--max-error 2", 2, "--max-error");
    fails("--max-error 0 --error prettiness", 2, "it is one of mae");
    fails("--max-error 0 --error boundary_px_max", 2, "it is one of mae");
    fails("--max-acne 0 --error rmse", 2, "--error: is the error that");
    fails("--max-acne 0 --tolerance 1%", 2, "--tolerance: is of a baseline");
    fails("--baseline base.json --tolerance 1,5", 2, "--tolerance");
    fails("--baseline base.json --write-baseline base.json", 2, "base.json: is read");
    fails("--baseline base.json --junit base.json", 2, "base.json: is read");
    fails("--write-baseline b.json --junit ./b.json", 2, "are one file");
    fails("--write-baseline b.txt", 2, ".json");
    fails("--write-baseline none/b.json", 1, "none");
    fails("--max-acne 0 --junit none/a.xml", 1, "none");
    fails("--max-acne 0 --junit .", 1, "is a directory");
    fails("--max-acne 0 --preset acn", 2, "did you mean acne?");
    expect_error("check --max-acne 0", 2, "SCENE", folder);
    expect_error("check none.glb --max-acne 0", 1, "none.glb", folder);
    // A picture of the sky alone passes nothing.
    fails("--max-acne 0 --size 32x18 --set light.count=0", 1, "");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
    EXPECT_EQ(file_bytes(folder / "base.json"), "{}");
}

TEST(Check, WritesJunitOfFindingsAndOfWhatCouldNotBeChecked) {
    const fs::path folder = fresh_test_folder();
    EXPECT_EQ(check_acne("--max-acne 0 --max-wrong 100% --junit a.xml", folder).code, 3);
    const std::string found = file_bytes(folder / "a.xml");
    EXPECT_EQ(test::xml_fault(found), "") << found;
    EXPECT_NE(found.find("tests=\"2\" failures=\"1\" errors=\"0\""), std::string::npos) << found;
    EXPECT_NE(found.find("<testcase classname=\"boxes\" name=\"max-wrong\""), std::string::npos) << found;

    // A name with all that XML and a terminal may trip over.
    const std::string name = "a\"><failure &amp;]]>\x01\xff'\n.glb";
    ASSERT_EQ(run_program("export boxes -o boxes.glb", folder).code, 0);
    fs::rename(folder / "boxes.glb", folder / name);
    const ProcessResult hostile =
        run_program({"check", name, "--size", "32x18", "--max-wrong", "100%", "--junit", "b.xml", "--json"}, folder);
    EXPECT_EQ(hostile.code, 0) << hostile.err;
    EXPECT_TRUE(Json::accept(hostile.out)) << hostile.out;
    EXPECT_EQ(test::xml_fault(file_bytes(folder / "b.xml")), "") << file_bytes(folder / "b.xml");

    write_check_text(folder / "c\"<&\x02.glb", "no model");
    EXPECT_EQ(run_program({"check", "c\"<&\x02.glb", "--max-acne", "0", "--junit", "a.xml"}, folder).code, 1);
    const std::string broken = file_bytes(folder / "a.xml");
    EXPECT_EQ(test::xml_fault(broken), "") << broken;
    EXPECT_NE(broken.find("failures=\"0\" errors=\"1\""), std::string::npos) << broken;
}

TEST(Check, AReportReplacesNoFileOfTheScene) {
    const fs::path folder = fresh_test_folder();
    ASSERT_EQ(run_program("export boxes -o a.glb", folder).code, 0);
    const std::string bytes = file_bytes(folder / "a.glb");
    expect_error("check a.glb --max-acne 0 --junit a.glb", 2, "a.glb: is read", folder);
    EXPECT_EQ(file_bytes(folder / "a.glb"), bytes);
    // A model that cannot be read names no files of its own, so an existing file stays.
    write_check_text(folder / "broken.gltf", "{");
    write_check_text(folder / "broken.bin", "numbers");
    expect_error("check broken.gltf --max-acne 0 --junit broken.bin", 1, "broken.gltf", folder);
    EXPECT_EQ(file_bytes(folder / "broken.bin"), "numbers");
}

TEST(Check, OpensABundleAsTheProgramExportedIt) {
    const fs::path folder = fresh_test_folder();
    ASSERT_EQ(run_program(Words("export --bundle acne.zip") + kCheckedAcne, folder).code, 0);
    const Json json = program_json("check acne.zip --size 96x54 --max-wrong 100% --json", folder);
    EXPECT_GT(json["error"]["artefacts"]["acne"], 1);
    EXPECT_NE(json["engine_bias"], nullptr);
}

SI_TEST_IS(Frame, Check, ACaptureBecomesABundleThatDoesNotStay);
TEST(Check, ACaptureBecomesABundleThatDoesNotStay) {
    const fs::path file = fs::path(SI_SOURCE_DIR) / "../shared/captures/filament_csm_gl.rdc";
    if (!fs::exists(file)) GTEST_SKIP() << test::kMissingReason << "../shared/captures";
    if (run_shell("/usr/bin/python3 -I -c 'import renderdoc, numpy'").code != 0)
        GTEST_SKIP() << test::kMissingReason << "python3-renderdoc";
    const fs::path folder = fresh_test_folder();
    fs::create_directory(folder / "temporary");
    const std::string options = "--size 96x54 --max-wrong 100% --json";
    const ProcessResult r =
        run_shell("TMPDIR=\"$PWD/temporary\" \"$SI\" check '" + file.string() + "' " + options, folder);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(fs::is_empty(folder / "temporary"));
    EXPECT_EQ(r.err.find("capture.bundle"), std::string::npos) << "remarks name the capture: " << r.err;
    // The same numbers as of the bundle that import-capture writes.
    ASSERT_EQ(run_program({"import-capture", file.string(), "-o", "a.bundle"}, folder).code, 0);
    const Json direct = Json::parse(r.out), bundle = program_json("check a.bundle " + options, folder);
    EXPECT_EQ(direct["error"], bundle["error"]);
    EXPECT_EQ(direct["scene"], file.string());
}

TEST(Check, ACaptureThatCannotBeOpenedLeavesNothing) {
    const fs::path folder = fresh_test_folder();
    fs::create_directory(folder / "temporary");
    write_check_text(folder / "a.rdc", "RDOC and nothing else");
    write_check_text(folder / "python", "#!/bin/sh\nkill -SEGV $$\n");
    ::chmod((folder / "python").c_str(), 0755);
    const ProcessResult r = run_shell(
        "TMPDIR=\"$PWD/temporary\" SI_CAPTURE_PYTHON=\"$PWD/python\" \"$SI\" check a.rdc --max-acne 0 --junit a.xml",
        folder);
    EXPECT_EQ(r.code, 1);
    EXPECT_NE(r.err.find("a.rdc: the capture helper crashed"), std::string::npos) << r.err;
    EXPECT_NE(file_bytes(folder / "a.xml").find("<error "), std::string::npos);
    EXPECT_TRUE(fs::is_empty(folder / "temporary"));
    const ProcessResult nowhere = run_shell("TMPDIR=/nowhere \"$SI\" check a.rdc --max-acne 0", folder);
    EXPECT_EQ(nowhere.code, 1);
    EXPECT_NE(nowhere.err.find("set TMPDIR"), std::string::npos) << nowhere.err;
}

SI_TEST_IS(Later, Check, TheScriptOfTheDocumentsChecksAFolder);
TEST(Check, TheScriptOfTheDocumentsChecksAFolder) {
    const fs::path folder = fresh_test_folder();
    fs::create_directory(folder / "frames");
    ASSERT_EQ(run_program(Words("export --bundle frames/acne.bundle") + kCheckedAcne, folder).code, 0);
    ASSERT_EQ(run_program("export boxes -o frames/fine.glb", folder).code, 0);
    const auto script = [&](const std::string& arguments) {
        return run_shell("SHADOW_INSPECTOR=\"$SI\" '" SI_SOURCE_DIR "/scripts/check_frames.sh' " + arguments, folder);
    };
    const ProcessResult kept = script("frames reports --size 96x54 --max-wrong 100%");
    EXPECT_EQ(kept.code, 0) << kept.out << kept.err;
    EXPECT_NE(kept.out.find("== 2 frames: 0 beyond a limit, 0 not checked"), std::string::npos) << kept.out;
    const ProcessResult exceeded = script("frames reports --size 96x54 --max-acne 5%");
    EXPECT_EQ(exceeded.code, 3) << exceeded.out << exceeded.err;
    EXPECT_NE(exceeded.out.find("== 2 frames: 1 beyond a limit, 0 not checked"), std::string::npos) << exceeded.out;
    EXPECT_NE(file_bytes(folder / "reports/acne.bundle.xml").find("<failure "), std::string::npos);
    EXPECT_EQ(file_bytes(folder / "reports/fine.glb.xml").find("<failure "), std::string::npos);
    fs::create_directory(folder / "baselines");
    write_check_text(folder / "baselines/fine.glb.json", "{}");
    write_check_text(folder / "frames/broken.glb", "no model");
    const ProcessResult broken = script("frames reports baselines --size 96x54 --max-acne 5%");
    EXPECT_EQ(broken.code, 1) << broken.out << broken.err;
    EXPECT_NE(broken.out.find("== 3 frames: 1 beyond a limit, 2 not checked"), std::string::npos) << broken.out;
    EXPECT_EQ(script("frames").code, 2);
    EXPECT_EQ(script("frames reports --max-acne much").code, 2);
    EXPECT_EQ(script("reports others --max-acne 0").code, 1) << "no frame was found";
    EXPECT_EQ(script("none reports --max-acne 0").code, 2);
    const ProcessResult no_baselines = script("frames reports none --max-acne 0");
    EXPECT_EQ(no_baselines.code, 2);
    EXPECT_NE(no_baselines.err.find("none: no such folder"), std::string::npos) << no_baselines.err;
}

TEST(Check, TheScriptChecksModelsOfAnyNameAndNamesWhatItLeavesOut) {
    const fs::path folder = fresh_test_folder();
    fs::create_directory(folder / "frames");
    for (const char* file : {"a.OBJ", "b.glb", "b.bin", "a.mtl", "wood.PNG", "b.json", "notes.txt", "fbx"})
        write_check_text(folder / "frames" / file, "text");
    // `true` in place of the program: the choice of files counts.
    const ProcessResult r =
        run_shell("SHADOW_INSPECTOR=true '" SI_SOURCE_DIR "/scripts/check_frames.sh' frames reports", folder);
    EXPECT_EQ(r.code, 0) << r.out << r.err;
    EXPECT_EQ(r.out,
              "== a.OBJ\n== b.glb\n== fbx: left out: no extension of a frame\n"
              "== notes.txt: left out: no extension of a frame\n"
              "== 2 frames: 0 beyond a limit, 0 not checked\n== 2 files left out\n");
}

TEST(Check, ASignalLeavesNothing) {
    const fs::path folder = fresh_test_folder();
    fs::create_directory(folder / "temporary");
    write_check_text(folder / "a.rdc", "RDOC and nothing else");
    write_check_text(folder / "python", "#!/bin/sh\necho $$ > helper\nexec sleep 987\n");
    ::chmod((folder / "python").c_str(), 0755);
    const ProcessResult r = run_shell(
        "export TMPDIR=\"$PWD/temporary\" SI_CAPTURE_PYTHON=\"$PWD/python\"\n"
        "\"$SI\" check a.rdc --max-acne 0 --junit a.xml & " +
            signal_once("[ -s helper ]", "TERM") + "ls",
        folder);
    EXPECT_NE(r.out.find("code 143"), std::string::npos) << r.out << r.err;
    EXPECT_EQ(r.out.find("a.xml"), std::string::npos) << r.out;
    EXPECT_TRUE(fs::is_empty(folder / "temporary"));
}

}  // namespace
}  // namespace si
