// Tests of the encoding of printed text: UTF-8, encoded once.
#include <gtest/gtest.h>

#include "app/commands/commands.h"
#include "tests/support/process.h"
#include "tests/support/text.h"
#include "tests/support/traits.h"

namespace si {
namespace {

SI_TEST_IS(Slow, PrintedText, IsEncodedOnceForEveryCommand);
TEST(PrintedText, IsEncodedOnceForEveryCommand) {
    const auto folder = fresh_test_folder();
    std::vector<std::string> commands = {
        "--help",
        "info",
        "probe boxes --pixel 160,120 --size 320x180",
        "probe boxes --pixel 160,120 --size 320x180 --json",
        "probe boxes --pixel 100,150 --size 320x180 --set bias.kind=constant --set bias.normal=0 --set bias.constant=0",
        "measure boxes --area --size 96x64 --no-time",
        "measure boxes --json --size 96x64 --no-time",
        "check boxes --max-wrong 0 --size 96x64 --junit /dev/stdout",
        "plan boxes --size 96x64 --measure --rounds 3 --waste",
        "plan boxes --size 96x64 --json",
        "truth boxes -o t.png --size 64x64 --report /dev/stdout",
        "render boxes -o r.png --size 64x64 --report r.json",
        "tune boxes -o p.json --size 96x64 --set map.resolution=256",
        "sweep boxes --vary map.resolution=64,128 --size 64x48 -o s --no-time",
        "scene boxes",
        "preset diff acne default",
        "preset show acne",
        "docs settings",
        "docs presets",
        "docs metrics",
        "no-such-command",
        "render boxes -o x.png --set map.resolutoin=1",
        "render boxes -o x.png --size 64x64 --set map.resolution=1",
    };
    for (const std::string& kind : list_kinds()) commands.push_back("list " + kind);
    for (const std::string& command :
         Words("render truth measure check sweep merge tune plan probe list preset edit scene"))
        commands.push_back(command + " --help");
    std::size_t printed = 0;
    for (const std::string& command : commands) {
        const ProcessResult r = run_program(command, folder);
        EXPECT_EQ(test::text_fault(r.out + r.err), "") << command;
        printed += r.out.size() + r.err.size();
    }
    EXPECT_GT(printed, 50'000u);
    for (const char* file : {"r.json", "p.json", "s/report.html", "s/results.json", "s/results.csv"})
        EXPECT_EQ(test::text_fault(file_bytes(folder / file)), "") << file;
}

}  // namespace
}  // namespace si
