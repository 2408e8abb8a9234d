// Tests of fixes on the command line: a row's settings, given to `measure`, cure and break exactly the reported number
// of pixels.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

using Json = nlohmann::json;

Json run(const char* command, const Words& more) {
    return program_json(command +
                        Words("boxes --set map.resolution=512 --set bias.kind=constant --set bias.normal=0 --set "
                              "bias.constant=0 --size 320x180") +
                        more);
}

long long wrong_pixel_count(const Json& measured) {
    long long n = 0;
    for (const auto& [cause, pixels] : measured["error"]["artefacts"].items())
        if (cause != "none") n += pixels.get<long long>();
    return n;
}

SI_TEST_IS(Slow, FixesInJson, AreNullUnlessRequestedAndReachTheirFigures);
TEST(FixesInJson, AreNullUnlessRequestedAndReachTheirFigures) {
    const Json none = run("measure", "--no-time");
    EXPECT_TRUE(none.at("cures").is_null());
    EXPECT_TRUE(none.at("cures_stopped").is_null());
    const Json all = run("measure", "--no-time --cures");
    ASSERT_TRUE(all["cures"].is_array());
    EXPECT_EQ(all.at("cures_stopped"), false);
    const Json& first = all["cures"][0];
    EXPECT_GT(first["cured_px"], 1000);
    EXPECT_TRUE(first["fix"].get<bool>());
    EXPECT_TRUE(first["ms"].is_object()) << "the price of a fix is known";
    EXPECT_LT(first["error"]["after"], first["error"]["before"]);
    for (const Json& row : all["cures"])
        if (row["tried"].get<bool>()) {
            EXPECT_EQ(row["fix"].get<bool>(), row["why_not"].is_null());
        }
    EXPECT_EQ(wrong_pixel_count(run("measure", "--no-time" + set_words(first["settings"]))),
              wrong_pixel_count(all) - first["cured_px"].get<long long>() + first["broken_px"].get<long long>());
}

SI_TEST_IS(Slow, FixesInJson, AnInterruptPrintsTheTriedOnesAndMarksThem);
TEST(FixesInJson, AnInterruptPrintsTheTriedOnesAndMarksThem) {
    const std::filesystem::path folder = fresh_test_folder();
    // The first line of progress names the present settings, the next one a change.
    const ProcessResult r = run_shell(
        "$SI measure boxes --set map.resolution=512 --set bias.kind=constant --set bias.normal=0 --set "
        "bias.constant=0 --size 1280x720 --cures --json >printed 2>said & " +
            signal_once("[ $(grep -c % said) -gt 1 ]", "INT") + "cat said",
        folder);
    const bool interrupted = r.out.find("code 130\n") != std::string::npos;
    EXPECT_EQ(r.out.find("interrupted; not everything was tried") != std::string::npos, interrupted) << r.out;
    const Json printed = Json::parse(file_bytes(folder / "printed"));
    EXPECT_TRUE(printed.at("cures").is_array());
    EXPECT_EQ(printed.at("cures_stopped"), interrupted) << "a fast machine may end before the signal";
}

}  // namespace
}  // namespace si
