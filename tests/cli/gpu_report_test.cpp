// Tests of `bench --gpu-report`, the report for other graphics cards.
#ifdef SI_BENCH  // only where benchmarks are built
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "tests/support/process.h"

namespace si {
namespace {

/// Runs a report of one round and small pictures.
ProcessResult run_gpu_report(const std::string& arguments, const std::filesystem::path& folder) {
    return run_shell("SI_BENCH_ROUNDS=1 '" SI_BENCH "' --gpu-report " + arguments + " --size 96x54", folder);
}

TEST(GpuReport, NamesTheDriverItsClockAndTheTimesOfBothWays) {
    const std::filesystem::path folder = fresh_test_folder();
    const ProcessResult r = run_gpu_report("report.json --choices map_format,back_faces,light_loop/4", folder);
    ASSERT_EQ(r.code, 0) << r.err;
    const auto report = nlohmann::json::parse(file_bytes(folder / "report.json"));
    EXPECT_EQ(report.at("version"), 1);
    EXPECT_EQ(report.at("width"), 96);
    EXPECT_EQ(report.at("height"), 54);
    EXPECT_FALSE(report.at("driver").at("renderer").get<std::string>().empty());
    EXPECT_FALSE(report.at("driver").at("version").get<std::string>().empty());
    EXPECT_FALSE(report.at("clock").at("used").get<std::string>().empty());
    EXPECT_GE(report.at("clock").at("query_share_of_wall_time").get<double>(), 0);
    std::set<std::string> keys;
    for (const auto& choice : report.at("choices")) {
        const auto key = choice.at("key").get<std::string>();
        keys.insert(key);
        EXPECT_FALSE(choice.at("question").get<std::string>().empty()) << key;
        EXPECT_EQ(choice.at("rounds"), 1) << key;
        for (const char* way : {"a", "b"}) {
            EXPECT_FALSE(choice.at(way).at("name").get<std::string>().empty()) << key;
            for (const char* clock : {"ms", "wall_ms"})
                for (const char* part : {"median", "p25", "p75"})
                    EXPECT_GT(choice.at(way).at(clock).at(part).get<double>(), 0) << key << " " << way << " " << clock;
        }
        EXPECT_GT(choice.at("ratio_b_to_a").at("median").get<double>(), 0) << key;
        const auto preferred = choice.at("preferred").get<std::string>();
        EXPECT_TRUE(preferred == "undecided" || preferred == choice.at("a").at("name").get<std::string>() ||
                    preferred == choice.at("b").at("name").get<std::string>())
            << key;
    }
    EXPECT_EQ(keys, (std::set<std::string>{"map_format", "back_faces", "light_loop/4"}));
}

TEST(GpuReport, RefusesAMissingFolderAndUnknownArguments) {
    const std::filesystem::path folder = fresh_test_folder();
    for (const auto& [arguments, code, text] :
         {std::tuple{"no/such/folder/report.json", 1, "report.json"},
          {"report.json --choices no_such_choice", 2, "map_format"},  // the error lists the choices
          {"report.json --rounds 3", 2, "--choices"}}) {
        const ProcessResult r = run_gpu_report(arguments, folder);
        EXPECT_EQ(r.code, code) << arguments;
        EXPECT_NE(r.err.find(text), std::string::npos) << arguments << ": " << r.err;
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace si
#endif
