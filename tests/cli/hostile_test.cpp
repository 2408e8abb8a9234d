// Tests in a hostile environment: closed and full streams, full disks, obstructing files.
#include <gtest/gtest.h>

#include <fstream>

#include "app/sweep/journal.h"
#include "tests/support/process.h"

namespace si {
namespace {

namespace fs = std::filesystem;

const std::string kSweep = "\"$SI\" sweep boxes --vary map.resolution=64,128 --size 32x24 --no-time -o out ";

bool is_png(const fs::path& file) {
    const std::string bytes = file_bytes(file);
    return bytes.starts_with("\x89PNG") && bytes.substr(bytes.size() - 8, 4) == "IEND";
}

TEST(Streams, ClosedStderrTakesNoNumberOfAFile) {
    const fs::path folder = fresh_test_folder();
    const ProcessResult r = run_shell(kSweep + "2>&-", folder);
    EXPECT_EQ(r.code, 0) << r.out;
    const SweepState state = read_journal(folder / "out");
    EXPECT_TRUE(state.notes.empty()) << state.notes[0];
    EXPECT_EQ(state.cases.size(), 2u);
    EXPECT_EQ(file_bytes(folder / "out" / kJournalFile).find("error and cost"), std::string::npos);
}

TEST(Streams, PictureIsWholeWithAllStreamsClosed) {
    const fs::path folder = fresh_test_folder();
    EXPECT_EQ(run_shell("\"$SI\" render boxes -o a.png --size 32x32 <&- >&- 2>&-", folder).code, 0);
    EXPECT_TRUE(is_png(folder / "a.png"));
    EXPECT_EQ(run_shell("\"$SI\" list metrics >&-", folder).code, 1) << "what was asked for went nowhere";
}

TEST(Streams, NoMessageEndsTheProgram) {
    const fs::path folder = fresh_test_folder();
    EXPECT_EQ(run_shell(kSweep + "2>/dev/full", folder).code, 0);
    EXPECT_EQ(run_shell("\"$SI\" render nothing -o a.png 2>/dev/full", folder).code, 2);
    // Its note reports the single texel.
    EXPECT_EQ(run_shell("\"$SI\" render boxes -o a.png --size 32x32 --set map.resolution=1 2>/dev/full", folder).code,
              0);
    EXPECT_TRUE(is_png(folder / "a.png"));
}

TEST(FullDisk, LeavesOnlyTheOldFile) {
    const fs::path folder = fresh_test_folder();
    std::ofstream(folder / "a.png") << "old";
    // A file size limit of one block acts like a full disk: the first bytes are written and the rest is not.
    const ProcessResult r = run_shell("ulimit -f 1; exec \"$SI\" render boxes -o a.png --size 200x200 2>&1", folder);
    EXPECT_EQ(r.code, 1);
    EXPECT_NE(r.out.find("a.png: cannot be written: File too large"), std::string::npos) << r.out;
    EXPECT_EQ(file_bytes(folder / "a.png"), "old");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
    const ProcessResult full = run_shell("\"$SI\" render boxes -o a.png --size 32x32 --report /dev/full", folder);
    EXPECT_EQ(full.code, 1);
    EXPECT_NE(full.err.find("/dev/full: cannot be written: No space left on device"), std::string::npos) << full.err;
}

TEST(HostilePresets, ForAnotherOrNoSceneAreReported) {
    const fs::path folder = fresh_test_folder();
    const auto write = [&](const char* scene, const char* settings) {
        std::ofstream(folder / "p.json") << R"({"format":"shadow-inspector-preset","version":3,"scene":")" << scene
                                         << R"(","settings":{)" << settings << "}}";
    };
    const auto draw = [&](const std::string& scene, const std::string& more = {}) {
        return run_shell("\"$SI\" render " + scene + " --preset p.json -o p.png --size 16x12 " + more, folder);
    };
    write("", "");
    EXPECT_EQ(run_program("preset check p.json", folder).code, 1);
    write("boxes", R"("object.Boxes/Tower.cast":false)");
    const ProcessResult lacking = draw("figures");
    EXPECT_EQ(lacking.code, 1);
    EXPECT_NE(lacking.err.find("p.json, saved with boxes: object.Boxes/Tower: figures has no such node"),
              std::string::npos)
        << lacking.err;
    write("boxes", R"("camera.source":"manual")");
    EXPECT_NE(draw("figures").err.find("p.json was saved with the scene boxes"), std::string::npos);
    EXPECT_EQ(draw("figures", "--set camera.source=auto").err, "");
    EXPECT_EQ(draw("boxes").err, "");
    fs::rename(folder / "p.json", folder / "p\x1b[31m.json");
    const ProcessResult named = run_program({"preset", "check", "p\x1b[31m.json"}, folder);
    EXPECT_EQ(named.code, 0);
    EXPECT_EQ(named.out.find('\x1b'), std::string::npos) << named.out;
}

TEST(HostilePresets, EscapesArePrintedNotObeyed) {
    const fs::path folder = fresh_test_folder();
    std::ofstream(folder / "e.json") << R"({"format":"shadow-inspector-preset","version":3,"title":"\u001b[31mred",)"
                                     << R"("topic":"\u009b2J","about":"a\u202eb","scene":"\u0007",)"
                                     << R"("settings":{"object.\u001b]0;x.cast":false}})";
    EXPECT_NE(run_program("preset show e.json", folder).out.find("\\x1b[31mred"), std::string::npos);
    for (const char* words : {"preset show e.json", "preset diff e.json acne", "preset check e.json"}) {
        const ProcessResult r = run_program(words, folder);
        for (const char* control : {"\x1b", "\x07", "\xc2\x9b", "\u202e"})
            EXPECT_EQ((r.out + r.err).find(control), std::string::npos) << words << ": " << r.out << r.err;
    }
}

TEST(HostilePresets, DeepJsonIsRefusedQuickly) {
    const fs::path folder = fresh_test_folder();
    const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
    std::ofstream(folder / "deep.json")
        << R"({"format":"shadow-inspector-preset","version":3,"settings":{"bias.slope":)" << deep << "}}";
    expect_error("preset check deep.json", 1, "deep.json: it nests 100002 levels deep, at most 32 are read", folder);
}

}  // namespace
}  // namespace si
