// Tests in a hostile environment: closed and full streams, full disks, obstructing files.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/commands/commands.h"
#include "app/sweep/journal.h"
#include "renderer/base/error.h"
#include "tests/support/process.h"
#include "tests/support/text.h"
#include "tests/support/traits.h"

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

/// Runs a script that a blocked program does not outlive. Exit code 137: it was killed after a minute.
ProcessResult run_unblocked(const std::string& script, const fs::path& folder) {
    return run_shell("timeout -s KILL 60 " + script, folder);
}

TEST(Pipes, SweepsRefuseThemInTheirFolder) {
    const fs::path folder = fresh_test_folder();
    ASSERT_EQ(run_shell(kSweep, folder).code, 0);
    for (const char* name : {"base.json", "results.json", "results.csv", "report.html", "pictures/0000.jpg"}) {
        fs::rename(folder / "out" / name, folder / "aside");
        ASSERT_EQ(::mkfifo((folder / "out" / name).c_str(), 0600), 0);
        const ProcessResult r = run_unblocked(kSweep, folder);
        EXPECT_EQ(r.code, 1) << name;
        EXPECT_NE(r.err.find(std::string("out/") + name + ": is not a regular file"), std::string::npos) << r.err;
        fs::remove(folder / "out" / name);
        fs::rename(folder / "aside", folder / "out" / name);
    }
    fs::remove(folder / "out" / kJournalFile);
    ASSERT_EQ(::mkfifo((folder / "out" / kJournalFile).c_str(), 0600), 0);
    for (const char* script : {kSweep.c_str(), "\"$SI\" merge out -o joined"}) {
        const ProcessResult r = run_unblocked(script, folder);
        EXPECT_EQ(r.code, 1) << script;
        EXPECT_NE(r.err.find("regular file"), std::string::npos) << r.err;
    }
}

TEST(Pipes, CommandsRefuseThemAsInputsAndPresets) {
    const fs::path folder = fresh_test_folder();
    for (const char* name : {"p.json", "m.glb", "m.gltf"}) ASSERT_EQ(::mkfifo((folder / name).c_str(), 0600), 0);
    for (const char* command :
         {"render boxes --preset p.json -o a.png", "render boxes --against p.json -o a.png",
          "render boxes --fit-camera p.json -o a.png", "preset diff p.json acne", "preset save boxes -o p.json",
          "sweep boxes --preset p.json --vary map.resolution=64 -o s", "scene m.glb", "render m.gltf -o a.png"}) {
        const ProcessResult r = run_unblocked(std::string("\"$SI\" ") + command, folder);
        EXPECT_EQ(r.code, 1) << command;
        EXPECT_NE(r.err.find(" file"), std::string::npos) << r.err;
    }
}

TEST(Pipes, LightMapIsBakedInTheirPlace) {
    const fs::path folder = fresh_test_folder();
    const std::string draw =
        "env XDG_CACHE_HOME=\"$PWD/cache\" \"$SI\" render boxes -o v.png --view visibility --size 32x24 --set "
        "light.source=light-map";
    ASSERT_EQ(run_unblocked(draw, folder).code, 0);
    const fs::path map = fs::directory_iterator(folder / "cache/shadow-inspector/light-maps")->path();
    fs::remove(map);
    ASSERT_EQ(::mkfifo(map.c_str(), 0600), 0);
    const ProcessResult r = run_unblocked(draw, folder);
    EXPECT_EQ(r.code, 0);
    EXPECT_NE(r.err.find("is not a regular file; the light map is baked again"), std::string::npos) << r.err;
    EXPECT_TRUE(fs::is_regular_file(map)) << "the next frame reads it";
}

/// Folder with the scene boxes as a file with a texture beside it, and its names.
class InputsAsOutputs : public testing::Test {
protected:
    const fs::path folder_ = fresh_test_folder();

    void SetUp() override {
        ASSERT_EQ(run_program("export boxes -o m.gltf", folder_).code, 0);
        nlohmann::json model = nlohmann::json::parse(file_bytes(folder_ / "m.gltf"));
        ASSERT_EQ(run_program("render boxes -o t.png --size 8x8", folder_).code, 0);
        model["images"] = {{{"uri", "t.png"}}};
        model["textures"] = {{{"source", 0}}};
        model["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
        std::ofstream(folder_ / "m.gltf") << model;
        ASSERT_EQ(run_program("preset save m.gltf -o p.json", folder_).code, 0);
        fs::create_hard_link(folder_ / "m.gltf", folder_ / "hard.gltf");
        fs::create_symlink("m.gltf", folder_ / "link.gltf");
        fs::create_symlink("t.png", folder_ / "t2.png");
        fs::create_symlink("p.json", folder_ / "p2.json");
    }
    /// Expects that the command is refused and changes nothing.
    void expect_refused(const Words& words) {
        const auto bytes = [&] {
            return file_bytes(folder_ / "m.gltf") + file_bytes(folder_ / "t.png") + file_bytes(folder_ / "p.json");
        };
        const std::string before = bytes();
        const ProcessResult r = run_program(words, folder_);
        EXPECT_EQ(r.code, 2) << words.front() << ": " << r.err;
        EXPECT_NE(r.err.find("name another file"), std::string::npos) << words.front() << ": " << r.err;
        EXPECT_EQ(bytes(), before) << words.front();
    }
};

SI_TEST_IS(Later, InputsAsOutputs, AreRefusedByEveryCommand);
TEST_F(InputsAsOutputs, AreRefusedByEveryCommand) {
    const Words quick = "--size 16x12";
    for (const char* name : {"m.gltf", "hard.gltf", "link.gltf"}) expect_refused("export m.gltf -o" + Words{name});
    expect_refused("render m.gltf -o t.png" + quick);
    expect_refused("render m.gltf -o t2.png" + quick);
    expect_refused("render m.gltf -o a.png --report m.gltf" + quick);
    expect_refused("render m.gltf -o a.png --report p2.json --preset p.json" + quick);
    expect_refused("render m.gltf -o a.png --report p.json --against p2.json" + quick);
    expect_refused("render m.gltf -o a.png --report p.json --fit-camera p.json" + quick);
    expect_refused("truth m.gltf -o t.png" + quick);
    expect_refused("truth m.gltf -o a.png --report m.gltf" + quick);
    expect_refused("shimmer m.gltf -o t.png" + quick);
    fs::create_symlink("t.png", folder_ / "t.svg");
    expect_refused("probe m.gltf --pixel 1,1 -o t.svg" + quick);
    expect_refused("preset save m.gltf --preset p.json -o p2.json");
    expect_refused("tune m.gltf --preset p.json -o p.json" + quick);
    expect_refused("advise m.gltf --preset p.json --max-error 0.5 -o p.json" + quick);
    expect_refused("edit m.gltf --headless --screenshot t.png --size 320x240");
    expect_refused("edit m.gltf --headless --screenshot a.png --report m.gltf --size 320x240");
    expect_refused("contact-sheet . -o t.png" + quick);
    fs::create_directory(folder_ / "out");
    fs::create_hard_link(folder_ / "t.png", folder_ / "out/scene.png");
    expect_refused("overview m.gltf -o out" + quick);
    ASSERT_EQ(run_program("sweep m.gltf --vary map.resolution=64 --no-time -o s" + quick, folder_).code, 0);
    const Words again = "sweep m.gltf --preset s/base.json --vary map.resolution=64,128 --no-time --fresh -o s" + quick;
    const std::string base = file_bytes(folder_ / "s/base.json");
    expect_refused(again);
    EXPECT_EQ(file_bytes(folder_ / "s/base.json"), base);
}

TEST_F(InputsAsOutputs, ExportReportsWhatItDrops) {
    const ProcessResult plain = run_program("export boxes -o b.glb", folder_);
    EXPECT_EQ(plain.err, "") << "a built-in scene loses nothing";
    nlohmann::json model = nlohmann::json::parse(file_bytes(folder_ / "m.gltf"));
    model["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_clearcoat"};
    model["materials"][0]["emissiveFactor"] = {1, 1, 1};
    model["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 0.5;
    model["nodes"][0]["extras"] = {{"id", 7}};
    model["asset"]["copyright"] = "A. Maker";
    std::ofstream(folder_ / "rich.gltf") << model;
    const ProcessResult rich = run_program("export rich.gltf -o r.glb --set scene.distance=5", folder_);
    EXPECT_EQ(rich.code, 0);
    EXPECT_EQ(test::lacking(rich.err, {"extensions are dropped: KHR_materials_clearcoat;",
                                       "materials lose metallic and roughness, emission\n", "extras of nodes",
                                       "the copyright is dropped: A. Maker", "scene.distance"}),
              "")
        << rich.err;
    EXPECT_EQ(rich.err.find("PNG"), std::string::npos) << "its image is a PNG";
}

TEST(HostileNames, PresetsMustBeUtf8) {
    const fs::path folder = fresh_test_folder();
    ASSERT_EQ(run_program("export boxes -o m.glb", folder).code, 0);
    fs::rename(folder / "m.glb", folder / "m\xff.glb");
    const ProcessResult scene = run_program({"preset", "save", "m\xff.glb", "-o", "p.json"}, folder);
    EXPECT_EQ(scene.code, 1);
    EXPECT_NE(scene.err.find("the scene \"m\\xff.glb\" is not UTF-8"), std::string::npos) << scene.err;
    const ProcessResult name = run_program({"preset", "save", "boxes", "-o", "p\xe9.json"}, folder);
    EXPECT_EQ(name.code, 1);
    EXPECT_NE(name.err.find("the name \"p\\xe9.json\" is not UTF-8"), std::string::npos) << name.err;
    const ProcessResult title = run_program({"preset", "save", "boxes", "-o", "p.json", "--title", "\xc0\xaf"}, folder);
    EXPECT_EQ(title.code, 1);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1) << "nothing was written";
}

TEST(LargePictures, AreRefusedBeforeTheWorkWhereTheyCannotFit) {
    const fs::path folder = fresh_test_folder();
    const ProcessResult r =
        run_unblocked("sh -c 'ulimit -v 4000000; exec \"$SI\" render boxes -o a.png --size 16384x16384'", folder);
    EXPECT_EQ(r.code, 1);
    EXPECT_EQ(test::lacking(r.err, {"--size 16384x16384: 16384 x 16384 pixels take about 5120 MiB of memory, and",
                                    "MiB are free; choose a smaller picture"}),
              "")
        << r.err;
    EXPECT_FALSE(fs::exists(folder / "a.png"));
}

TEST(LargePictures, NoteWhatTheyTake) {
    constexpr std::uint64_t kGib = std::uint64_t{1} << 30;
    EXPECT_EQ(picture_memory_note({1920, 1080}, kMeasuredPixelBytes, kGib), "") << "below 1 GiB";
    EXPECT_EQ(picture_memory_note({16384, 16384}, kDrawnPixelBytes, 8 * kGib),
              "16384 x 16384 pixels take about 5120 MiB of memory; 8192 MiB are free");
    EXPECT_EQ(picture_memory_note({16384, 16384}, kDrawnPixelBytes, 0),
              "16384 x 16384 pixels take about 5120 MiB of memory");
    EXPECT_THROW(picture_memory_note({16384, 16384}, kTracedPixelBytes, 8 * kGib), Error);
}

}  // namespace
}  // namespace si
