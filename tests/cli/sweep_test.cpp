// Tests of sweep and merge: files, continuing, refusing, shards, GNU parallel and the Slurm script.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/report/measure_json.h"
#include "app/sweep/columns.h"
#include "app/sweep/journal.h"
#include "tests/support/missing_reason.h"
#include "tests/support/number_at.h"
#include "tests/support/process.h"
#include "tests/support/text.h"
#include "tests/support/traits.h"
#include "tests/unit/gltf_test_file.h"

namespace si {
namespace {

using OrderedJson = nlohmann::ordered_json;
namespace fs = std::filesystem;

Words sweep_of(const std::string& folder, const Words& more = {}) {
    return "sweep boxes --vary filter.kernel=hard,pcf3 --vary map.resolution=64,256 --size 96x64 --rounds 2 --frames 1 "
           "-o" +
           Words{folder} + more;
}

OrderedJson results_of(const fs::path& folder) {
    return OrderedJson::parse(file_bytes(folder / "results.json"));
}

bool has(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

int shell(const std::string& command, const fs::path& folder) {
    const int status = std::system(("cd '" + folder.string() + "' && " + command + " >shell.txt 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Returns the words of the command that the report shows for each case, behind "shadow-inspector edit".
std::vector<Words> commands_of(const fs::path& folder) {
    const std::string html = file_bytes(folder / "report.html"), mark = "\"command\":\"shadow-inspector edit ";
    std::vector<Words> commands;
    for (auto at = html.find(mark); at != std::string::npos; at = html.find(mark, at + 1)) {
        const auto begin = at + mark.size();
        commands.emplace_back(html.substr(begin, html.find('"', begin) - begin));
    }
    return commands;
}

SI_TEST_IS(Later, SweepCommand, CommandsOfTheReportKeepWhatTheBaseHolds);
TEST(SweepCommand, CommandsOfTheReportKeepWhatTheBaseHolds) {
    const fs::path folder = fresh_test_folder();
    const ProcessResult r = run_program(
        "sweep boxes --set bias.normal=2 --vary bias.kind=adaptive,slope --size 32x24 --rounds 1 --frames 1 -o out",
        folder);
    ASSERT_EQ(r.code, 0) << r.err;
    const std::string html = file_bytes(folder / "out/report.html");
    const auto at = html.find("--set bias.kind=slope");
    ASSERT_NE(at, std::string::npos);
    const std::string command = html.substr(html.rfind("shadow-inspector edit", at), 300);
    EXPECT_NE(command.find("--set bias.normal=2"), std::string::npos) << command;
    EXPECT_NE(command.find("--set bias.constant=0.1"), std::string::npos) << command;
}

TEST(SweepCommand, CommandsOfTheReportRunWhereTheSweepRan) {
    const fs::path folder = fresh_test_folder();
    fs::create_directory(folder / "models");
    std::ofstream(folder / "models/leaf.glb", std::ios::binary) << test::falling_leaf(1, {1, -2, 0}, {1, -2, 0});
    const ProcessResult r =
        run_program("sweep models/leaf.glb --vary map.resolution=64,128 --size 32x24 --no-time -o out/leaf", folder);
    ASSERT_EQ(r.code, 0) << r.err;
    const std::vector<Words> commands = commands_of(folder / "out/leaf");
    ASSERT_EQ(commands.size(), 2u);
    for (const Words& words : commands) {
        const ProcessResult drawn = run_program("render" + words + "-o a.png --size 32x24", folder);
        EXPECT_EQ(drawn.code, 0) << drawn.err;
    }
}

SI_TEST_IS(Later, SweepCommand, CommandsOfTheReportDrawWhatAProfileMeasured);
TEST(SweepCommand, CommandsOfTheReportDrawWhatAProfileMeasured) {
    const fs::path folder = fresh_test_folder();
    const Words size = "--size 96x64 --no-time";
    // Metres are converted to texels of each case's map. The engine's bias gives way to an axis over bias.*.
    for (const char* options : {"--profile three --set engine.normalBias=0.05 --vary map.resolution=256,512",
                                "--profile bevy --vary bias.normal=0,1"}) {
        const ProcessResult r = run_program("sweep boxes --fresh -o out" + size + options, folder);
        ASSERT_EQ(r.code, 0) << r.err;
        const OrderedJson rows = results_of(folder / "out")["rows"];
        const std::vector<Words> commands = commands_of(folder / "out");
        ASSERT_EQ(rows.size(), 2u) << options;
        ASSERT_EQ(commands.size(), 2u) << options;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            EXPECT_TRUE(rows[i].contains("own_settings")) << options;
            const auto m = program_json("measure" + commands[i] + size, folder);
            EXPECT_EQ(m["error"]["mae"], number_at(rows[i], "error.mae")) << rows[i].dump();
        }
    }
    ASSERT_EQ(run_program("sweep boxes --fresh -o out --vary map.resolution=256,512" + size, folder).code, 0);
    const OrderedJson plain = results_of(folder / "out")["rows"];
    for (const OrderedJson& row : plain) EXPECT_FALSE(row.contains("own_settings")) << row.dump();
}

SI_TEST_IS(Later, SweepCommand, WritesResultsAndReport);
TEST(SweepCommand, WritesResultsAndReport) {
    const fs::path folder = fresh_test_folder();
    const ProcessResult r = run_program(sweep_of("out"), folder);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_NE(r.out.find("wrote out/report.html"), std::string::npos);
    EXPECT_NE(r.err.find("error and cost: 4/4"), std::string::npos) << r.err;
    const OrderedJson results = results_of(folder / "out");
    EXPECT_EQ(results["format"], "shadow-inspector-sweep");
    EXPECT_EQ(results["version"], 1);
    ASSERT_EQ(results["rows"].size(), 4u);
    for (const OrderedJson& row : results["rows"]) {
        EXPECT_TRUE(row["failed"].is_null());
        for (const char* key : {"error.mae", "error.false_shadow", "error.false_light", "error.iou", "cost.map_texels",
                                "cost.taps_per_pixel", "cost.draws", "cost.triangles", "time.total_ms.median",
                                "time.shadow_maps_ms.median", "time.picture_ms.median"})
            EXPECT_TRUE(std::isfinite(number_at(row, key))) << key;
        const auto sum = [&](std::initializer_list<const char*> keys) {
            double v = 0;
            for (const char* key : keys) v += number_at(row, std::string("error.") + key);
            return v;
        };
        EXPECT_EQ(number_at(row, "error.meaning"), kErrorMeaning);
        EXPECT_NEAR(number_at(row, "error.false_shadow"),
                    sum({"acne", "offset_false_shadow", "contact_false_shadow", "boundary_false_shadow",
                         "outside_false_shadow"}),
                    1e-12);
        EXPECT_NEAR(
            number_at(row, "error.false_light"),
            sum({"bias_false_light", "lost_false_light", "leak", "boundary_false_light", "outside_false_light"}),
            1e-12);
        const double n = std::stod(row["settings"]["map.resolution"].get<std::string>());
        EXPECT_EQ(number_at(row, "cost.map_texels"), n * n);
        EXPECT_GT(fs::file_size(folder / "out" / row["picture"].get<std::string>()), 500u);
        EXPECT_GT(fs::file_size(folder / "out" / row["artefacts"].get<std::string>()), 100u);
    }
    EXPECT_FALSE(results["frontier"]["cases"].empty());
    EXPECT_NE(results["clock"], "");
    const std::string csv = file_bytes(folder / "out/results.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
    EXPECT_TRUE(csv.starts_with("case,filter.kernel,map.resolution,error.")) << csv.substr(0, 100);
    const std::string header = csv.substr(0, csv.find('\n')) + ",";
    for (const Column& column : columns())
        EXPECT_NE(header.find("," + std::string(column.key) + ","), std::string::npos) << column.key;
    // The command in the report draws the picture of its case.
    const std::vector<Words> commands = commands_of(folder / "out");
    ASSERT_EQ(commands.size(), 4u);
    EXPECT_EQ(run_program("render" + commands[0] + "-o a.png --size 96x64", folder).code, 0);
    // A finished sweep: the same command changes nothing.
    const std::string journal = file_bytes(folder / "out" / kJournalFile);
    EXPECT_EQ(run_program(sweep_of("out"), folder).code, 0);
    EXPECT_EQ(file_bytes(folder / "out" / kJournalFile), journal);
}

SI_TEST_IS(Later, SweepCommand, LightSizeAxisMeasuresEachSize);
TEST(SweepCommand, LightSizeAxisMeasuresEachSize) {
    const fs::path folder = fresh_test_folder();
    const Words sweep = "sweep boxes --vary light.size=0.1,2,8 --size 96x64 --no-time -o";
    ASSERT_EQ(run_program(sweep + "area --area", folder).code, 0);
    const OrderedJson rows = results_of(folder / "area")["rows"];
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_LT(number_at(rows[0], "error.mae"), number_at(rows[1], "error.mae"));
    EXPECT_LT(number_at(rows[1], "error.mae"), number_at(rows[2], "error.mae"));
    for (const OrderedJson& row : rows) {
        const auto m = program_json("measure boxes --area --no-time --size 96x64 --set light.size=" +
                                    row["settings"]["light.size"].get<std::string>());
        EXPECT_EQ(m["error"]["mae"], number_at(row, "error.mae"));
    }
    expect_error(sweep + "hard", 0, "light.size: 2 of 3 values give no cases of their own", folder);
    EXPECT_EQ(results_of(folder / "hard")["rows"].size(), 1u) << "a point has no size";
}

SI_TEST_IS(Later, SweepCommand, EachSceneOfAFileIsMeasured);
TEST(SweepCommand, EachSceneOfAFileIsMeasured) {
    const fs::path folder = fresh_test_folder();
    test::GltfFile f;
    const auto at = [&](double height) {
        return f.append("nodes", {{"mesh", 0},
                                  {"translation", {0, height, 0}},
                                  {"rotation", {-0.7071068, 0, 0, 0.7071068}},
                                  {"scale", {4, 4, 4}}});
    };
    f.add_triangle();
    f.json["scenes"].push_back({{"nodes", {at(0), at(1), at(2)}}});
    std::ofstream(folder / "two.glb", std::ios::binary) << f.glb();
    const auto sweep = [&](const std::string& axis) {
        return run_program("sweep two.glb --size 96x64 --no-time -o out --fresh --vary " + axis, folder);
    };
    const Words measure = "measure two.glb --no-time --size 96x64 --set";
    ASSERT_EQ(sweep("scene.index=0,1,-1").code, 0);
    const OrderedJson rows = results_of(folder / "out")["rows"];
    ASSERT_EQ(rows.size(), 3u);
    for (const OrderedJson& row : rows) {
        const std::string set = "scene.index=" + row["settings"]["scene.index"].get<std::string>();
        const nlohmann::json m = program_json(measure + set, folder), swept = row;
        EXPECT_EQ(m["error"]["pixels"], swept["error"]["pixels"]) << set;
        EXPECT_EQ(m["cost"]["triangles"], swept["cost"]["triangles"]) << set;
    }
    EXPECT_NE(rows[0]["error"]["pixels"], rows[1]["error"]["pixels"]);
    // An axis refuses values with the words of --set, before anything is measured.
    const std::string before = file_bytes(folder / "out" / kJournalFile);
    for (const char* wrong : {"camera.index=0,9999", "scene.index=0,2", "object.Nowhere.cast=true,false"}) {
        const ProcessResult r = sweep(wrong);
        const std::string_view axis = wrong;
        const std::string key(axis.substr(0, axis.find('=') + 1)), value(axis.substr(axis.find(',') + 1));
        const ProcessResult set = run_program(measure + (key + value), folder);
        EXPECT_NE(r.code, 0) << wrong;
        EXPECT_EQ(r.code, set.code) << wrong;
        EXPECT_EQ(r.err, set.err) << wrong;
        EXPECT_EQ(file_bytes(folder / "out" / kJournalFile), before) << wrong;
    }
}

SI_TEST_IS(Later, SweepCommand, OtherArgumentsAreRefusedUnlessFresh);
TEST(SweepCommand, OtherArgumentsAreRefusedUnlessFresh) {
    const fs::path folder = fresh_test_folder();
    ASSERT_EQ(run_program(sweep_of("out", "--no-time"), folder).code, 0);
    const std::string journal = file_bytes(folder / "out" / kJournalFile),
                      html = file_bytes(folder / "out/report.html");
    const ProcessResult r = run_program(sweep_of("out", "--no-time --set bias.slope=1"), folder);
    EXPECT_EQ(r.code, 1);
    EXPECT_EQ(r.err,
              "shadow-inspector: out: holds another sweep (bias.slope: the default there, 1 here); choose another "
              "folder, or --fresh to start again\n");
    EXPECT_EQ(file_bytes(folder / "out" / kJournalFile), journal);
    EXPECT_EQ(file_bytes(folder / "out/report.html"), html);
    std::ofstream(folder / "out/mine.txt") << "kept";
    const ProcessResult fresh = run_program(sweep_of("out", "--no-time --set bias.slope=1 --fresh"), folder);
    EXPECT_EQ(fresh.code, 0) << fresh.err;
    EXPECT_EQ(results_of(folder / "out")["settings"]["bias.slope"], "1");
    EXPECT_TRUE(results_of(folder / "out")["rows"][0]["time"].is_null());
    EXPECT_EQ(file_bytes(folder / "out/mine.txt"), "kept");
    fs::remove(folder / "out" / kJournalFile);
    EXPECT_EQ(run_program(sweep_of("out", "--no-time"), folder).code, 1) << "results of who knows what";
}

SI_TEST_IS(Later, SweepCommand, ErrorsOfAnotherDefinitionAreNeitherContinuedNorMerged);
TEST(SweepCommand, ErrorsOfAnotherDefinitionAreNeitherContinuedNorMerged) {
    const fs::path folder = fresh_test_folder();
    for (const char* part : {"1", "2"})
        ASSERT_EQ(run_program(sweep_of(part, "--no-time --shard " + std::string(part) + "/2"), folder).code, 0);
    const fs::path file = folder / "1" / kJournalFile;
    std::string text = file_bytes(file);
    const std::string meaning = "\"meaning\":" + std::to_string(kErrorMeaning) + ",";
    for (auto at = text.find(meaning); at != std::string::npos; at = text.find(meaning)) text.erase(at, meaning.size());
    std::ofstream(file, std::ios::binary) << text;
    const std::string said = "1/journal.jsonl: line ";
    const Words again = sweep_of("1", "--no-time --shard 1/2");
    const ProcessResult went_on = expect_error(again, 1, said, folder);
    EXPECT_EQ(test::lacking(went_on.err, {"errors of meaning 1", "--fresh"}), "");
    EXPECT_EQ(file_bytes(file), text);
    for (const char* parts : {"1 2", "2 1", "1"}) {
        expect_error("merge -o merged" + Words(parts), 1, said, folder);
        EXPECT_FALSE(fs::exists(folder / "merged")) << parts;
    }
    ASSERT_EQ(run_program(again + "--fresh", folder).code, 0);
    EXPECT_EQ(run_program("merge 1 2 -o merged", folder).code, 0);
    EXPECT_EQ(results_of(folder / "merged")["finished"], 4);
}

SI_TEST_IS(Slow, SweepCommand, InterruptedSweepContinues);
TEST(SweepCommand, InterruptedSweepContinues) {
    const fs::path folder = fresh_test_folder();
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGKILL}) {
        const std::string out = std::to_string(signal);
        // Enough cases that the sweep cannot end before the signal.
        Words words = sweep_of(out, "--no-time --vary bias.normal=0:1.4:0.1");
        const fs::path journal = folder / out / kJournalFile;
        const pid_t child = ::fork();
        if (child == 0) {
            if (::chdir(folder.c_str()) != 0 || !std::freopen("/dev/null", "w", stdout) ||
                !std::freopen("child.txt", "w", stderr))
                ::_exit(126);
            std::vector<char*> argv = {const_cast<char*>(SI_PROGRAM)};
            for (std::string& w : words) argv.push_back(w.data());
            argv.push_back(nullptr);
            ::execv(argv[0], argv.data());
            ::_exit(127);
        }
        const auto finished = [&] {
            std::error_code error;
            if (!fs::exists(journal, error)) return std::size_t(0);
            const std::string text = file_bytes(journal);
            std::size_t n = 0;
            for (std::size_t at = 0; (at = text.find("{\"facts\":", at)) != std::string::npos; ++at) ++n;
            return n;
        };
        while (finished() < 2 && ::waitpid(child, nullptr, WNOHANG) == 0)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        ::kill(child, signal);
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status;
        const std::size_t kept = finished();
        EXPECT_GE(kept, 2u);
        EXPECT_LT(kept, 60u);
        if (signal != SIGKILL) {
            EXPECT_EQ(results_of(folder / out)["finished"], kept);
            EXPECT_NE(file_bytes(folder / "child.txt").find("interrupted after"), std::string::npos);
        }
        const std::string before = file_bytes(journal);
        const ProcessResult r = run_program(words, folder);
        ASSERT_EQ(r.code, 0) << r.err;
        EXPECT_EQ(results_of(folder / out)["finished"], 60);
        EXPECT_EQ(finished(), 60u) << "no case twice";
        const auto whole = before.rfind('\n') + 1;
        EXPECT_EQ(file_bytes(journal).substr(0, whole), before.substr(0, whole));
    }
}

TEST(SweepCommand, FailingCaseIsARow) {
    const fs::path folder = fresh_test_folder();
    std::ofstream(folder / "leaf.glb", std::ios::binary) << test::falling_leaf(1, {1, -2, 0}, {1, -2, 0});
    const ProcessResult r = run_program(
        "sweep leaf.glb --vary view.light=0,7 --vary scene.animation=-1,0 --set map.resolution=64 --size 48x32 -o out "
        "--no-time",
        folder);
    ASSERT_EQ(r.code, 0) << r.err;
    const OrderedJson results = results_of(folder / "out");
    EXPECT_EQ(results["failed"], 2);
    EXPECT_NE(results["rows"][2]["failed"].get<std::string>().find("view.light is 7"), std::string::npos);
    EXPECT_NE(results["rows"][0]["error"]["mae"], results["rows"][1]["error"]["mae"]) << "each case has its own pose";
    EXPECT_NE(r.out.find("2 of 4 cases failed"), std::string::npos);
}

SI_TEST_IS(Later, SweepCommand, ParallelShardsMergeIntoTheWhole);
TEST(SweepCommand, ParallelShardsMergeIntoTheWhole) {
    if (!has("parallel")) GTEST_SKIP() << test::kMissingReason << "GNU parallel";
    const fs::path folder = fresh_test_folder();
    ASSERT_EQ(run_program(sweep_of("whole", "--no-time"), folder).code, 0);
    std::string command = "parallel -j 2 '" SI_PROGRAM "'";
    for (const std::string& word : sweep_of("part-{}", "--shard {}/3")) command += " " + word;
    ASSERT_EQ(shell(command + " ::: 1 2 3", folder), 0) << file_bytes(folder / "shell.txt");
    EXPECT_EQ(results_of(folder / "part-1")["rows"].size(), 2u);
    EXPECT_TRUE(results_of(folder / "part-1")["rows"][0]["time"].is_null()) << "shards take no times";
    expect_error("merge part-1 part-3 -o merged", 0, "1 of 4 cases are missing", folder);
    const ProcessResult r = run_program("merge part-1 part-2 part-3 -o merged", folder);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.err, "");
    OrderedJson whole = results_of(folder / "whole"), merged = results_of(folder / "merged");
    whole.erase("runs");
    merged.erase("runs");
    EXPECT_EQ(whole, merged);
    for (const OrderedJson& row : merged["rows"])
        EXPECT_TRUE(fs::exists(folder / "merged" / row["artefacts"].get<std::string>()));
    // The whole sweep continues in the merged folder: only times are missing.
    ASSERT_EQ(run_program(sweep_of("merged"), folder).code, 0);
    EXPECT_EQ(results_of(folder / "merged")["rounds"], 2);
    EXPECT_EQ(results_of(folder / "merged")["rows"][3]["error"], whole["rows"][3]["error"]);
    EXPECT_EQ(run_program(sweep_of("part-1", "--shard 2/3"), folder).code, 1) << "another shard's folder";
    // A restart of the whole would delete a part's pictures.
    expect_error("merge part-1 part-2 -o ./part-2 --fresh", 2, "./part-2: is one of the parts", folder);
    EXPECT_TRUE(fs::exists(folder / "part-2" / kJournalFile));
    ASSERT_EQ(run_program(sweep_of("other", "--no-time --set bias.slope=1"), folder).code, 0);
    EXPECT_EQ(run_program("merge part-1 other -o wrong", folder).code, 1);
    EXPECT_FALSE(fs::exists(folder / "wrong"));
}

SI_TEST_IS(Later, SweepCommand, MergeLeavesTheFolderOfAnotherSweepAsItIs);
TEST(SweepCommand, MergeLeavesTheFolderOfAnotherSweepAsItIs) {
    const fs::path folder = fresh_test_folder();
    ASSERT_EQ(run_program(sweep_of("part", "--no-time"), folder).code, 0);
    ASSERT_EQ(run_program(sweep_of("other", "--no-time --set bias.slope=1"), folder).code, 0);
    const fs::path picture = folder / "other/pictures/0003.jpg";
    ASSERT_TRUE(fs::remove(picture));
    expect_error("merge part -o other", 1, "other: holds another sweep", folder);
    EXPECT_FALSE(fs::exists(picture)) << "a picture of the part";
}

SI_TEST_IS(Later, SweepCommand, SlurmArrayRunsShards);
TEST(SweepCommand, SlurmArrayRunsShards) {
    const fs::path folder = fresh_test_folder();
    const std::string script = std::string("'") + SI_SOURCE_DIR + "/scripts/sweep_slurm.sh'";
    const std::string arguments = " boxes --vary filter.kernel=hard,pcf3,pcf5 --size 48x32 -o 'a folder'";
    for (const char* id : {"5", "6"}) {
        const std::string task = std::string("SHADOW_INSPECTOR='" SI_PROGRAM
                                             "' SLURM_ARRAY_TASK_COUNT=2 "
                                             "SLURM_ARRAY_TASK_MIN=5 SLURM_ARRAY_TASK_ID=") +
                                 id + " " + script + arguments;
        ASSERT_EQ(shell(task, folder), 0) << file_bytes(folder / "shell.txt");
    }
    ASSERT_EQ(run_program({"merge", "a folder/shard-1", "a folder/shard-2", "-o", "whole"}, folder).code, 0);
    EXPECT_EQ(results_of(folder / "whole")["finished"], 3);
    EXPECT_NE(shell(script + arguments, folder), 0) << "without Slurm";
    EXPECT_EQ(shell("SLURM_ARRAY_TASK_ID=1 SLURM_ARRAY_TASK_COUNT=1 " + script + " boxes", folder), 2) << "without -o";
    if (!has("shellcheck")) GTEST_SKIP() << test::kMissingReason << "shellcheck";
    EXPECT_EQ(shell("shellcheck " + script, folder), 0) << file_bytes(folder / "shell.txt");
}

}  // namespace
}  // namespace si
