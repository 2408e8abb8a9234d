// Tests of mistakes on the command line: one line on stderr that names the mistake, and the right exit code.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/support/process.h"

namespace si {
namespace {

struct Mistake {
    const char* name;
    std::vector<std::string> arguments;
    int code;
    const char* mentions;
};

void PrintTo(const Mistake& m, std::ostream* out) {
    *out << m.name;
}

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, AreReportedInOneLine) {
    const auto folder = fresh_test_folder();
    std::ofstream(folder / "bad.json")
        << R"({"format":"shadow-inspector-preset","version":2,"settings":{"bias.slop":1}})";
    std::ofstream(folder / "lost.json")
        << R"({"format":"shadow-inspector-preset","version":2,"scene":"gone.glb","settings":{}})";
    std::ofstream(folder / "broken.gltf") << "{ this is no glTF";
    std::filesystem::create_directory(folder / "folder.png");
    const auto before = std::distance(std::filesystem::directory_iterator(folder), {});
    const ProcessResult r = run_program(GetParam().arguments, folder);
    EXPECT_EQ(r.code, GetParam().code) << r.err;
    EXPECT_EQ(r.out, "");
    EXPECT_TRUE(r.err.starts_with("shadow-inspector: ")) << r.err;
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r.err;
    EXPECT_LT(r.err.size(), 1500u) << r.err;
    EXPECT_NE(r.err.find(GetParam().mentions), std::string::npos) << r.err;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), before) << "a file was left";
}

INSTANTIATE_TEST_SUITE_P(
    All, Mistakes,
    testing::Values(
        Mistake{"command", {"rendr", "stage"}, 2, "did you mean render?"},
        Mistake{"subcommand", {"preset", "chek", "bad.json"}, 2, "did you mean check?"},
        Mistake{"option", {"render", "boxes", "-o", "a.png", "--bogus"}, 2, "--bogus"},
        Mistake{"extra", {"render", "boxes", "plane", "-o", "a.png"}, 2, "plane"},
        Mistake{"no_scene", {"render", "-o", "a.png"}, 2, "SCENE"},
        Mistake{"no_output", {"render", "boxes"}, 2, "--output"},
        Mistake{
            "unknown_key", {"render", "boxes", "-o", "a.png", "--set", "bias.slop=1"}, 2, "did you mean bias.slope?"},
        Mistake{"series", {"precision", "boxes", "--over", "sideways"}, 2, "distance, scale, stretch"},
        Mistake{"motion", {"shimmer", "boxes", "--motion", "jump"}, 2, "camera, turn, light"},
        Mistake{"step", {"shimmer", "boxes", "--step-texels", "nan"}, 2, "--step-texels"},
        Mistake{
            "shimmer_unlit", {"shimmer", "boxes", "--set", "light.cast=off", "--size", "32x18"}, 1, "no shadow map"},
        Mistake{
            "precision_unlit", {"precision", "boxes", "--set", "light.count=0", "--size", "32x18"}, 1, "view.light"},
        Mistake{"no_value", {"render", "boxes", "-o", "a.png", "--set", "bias.slope"}, 2, "KEY=VALUE"},
        Mistake{"nan", {"render", "boxes", "-o", "a.png", "--set", "bias.slope=nan"}, 2, "not finite"},
        Mistake{"range", {"render", "boxes", "-o", "a.png", "--set", "map.resolution=0"}, 2, "1 to 16384"},
        Mistake{"choice", {"render", "boxes", "-o", "a.png", "--set", "filter.kernel=pcf33"}, 2, "did you mean pcf?"},
        Mistake{"node", {"render", "boxes", "-o", "a.png", "--set", "object.Nowhere.cast=off"}, 2, "no such node"},
        Mistake{"sweep_nothing", {"sweep", "boxes", "-o", "out"}, 2, "--vary"},
        Mistake{"sweep_key", {"sweep", "boxes", "--vary", "bias.slop=1,2", "-o", "out"}, 2, "did you mean bias.slope?"},
        Mistake{"sweep_value", {"sweep", "boxes", "--vary", "bias.slope=1:9:0", "-o", "out"}, 2, "does not lead"},
        Mistake{"sweep_twice",
                {"sweep", "boxes", "--vary", "bias.slope=1", "--vary", "bias.slope=2", "-o", "out"},
                2,
                "varied twice"},
        Mistake{"sweep_shard", {"sweep", "boxes", "--vary", "bias.slope=1", "-o", "out", "--shard", "3/2"}, 2, "2/8"},
        Mistake{
            "sweep_rounds", {"sweep", "boxes", "--vary", "bias.slope=1", "-o", "out", "--rounds", "0"}, 2, "--rounds"},
        Mistake{"sweep_scene", {"sweep", "broken.gltf", "--vary", "bias.slope=1", "-o", "out"}, 1, "broken.gltf"},
        Mistake{"sweep_file", {"sweep", "boxes", "--vary", "bias.slope=1", "-o", "bad.json"}, 1, "bad.json"},
        Mistake{"merge_nothing", {"merge", "folder.png", "-o", "out"}, 1, "holds no sweep"},
        Mistake{"size", {"render", "boxes", "-o", "a.png", "--size", "64"}, 2, "WIDTHxHEIGHT"},
        Mistake{"size_zero", {"render", "boxes", "-o", "a.png", "--size", "0x64"}, 2, "WIDTHxHEIGHT"},
        Mistake{"size_negative", {"render", "boxes", "-o", "a.png", "--size", "-4x64"}, 2, "WIDTHxHEIGHT"},
        Mistake{"size_tail", {"render", "boxes", "-o", "a.png", "--size", "64x64x"}, 2, "WIDTHxHEIGHT"},
        Mistake{"view", {"render", "boxes", "-o", "a.png", "--view", "visibilty"}, 2, "did you mean visibility?"},
        Mistake{"swipe_alone", {"render", "boxes", "-o", "a.png", "--swipe", "0.5"}, 2, "--against"},
        Mistake{"swipe_range", {"render", "boxes", "-o", "a.png", "--against", "truth", "--swipe", "2"}, 2, "--swipe"},
        Mistake{
            "against_view", {"render", "boxes", "-o", "a.png", "--against", "truth", "--view", "normals"}, 2, "--view"},
        Mistake{"against_nothing", {"render", "boxes", "-o", "a.png", "--against", "bad.json"}, 1, "bad.json"},
        Mistake{"extension", {"render", "boxes", "-o", "a.jpg"}, 2, ".png"},
        Mistake{"float_picture", {"render", "boxes", "-o", "a.pfm"}, 2, "write it as .png"},
        Mistake{"float_colours", {"render", "boxes", "-o", "a.pfm", "--view", "light-uv"}, 2, "write it as .png"},
        Mistake{"to_folder", {"render", "boxes", "-o", "folder.png"}, 1, "is a directory"},
        Mistake{"to_nowhere", {"render", "boxes", "-o", "none/a.png"}, 1, "does not exist"},
        Mistake{"report_nowhere", {"render", "boxes", "-o", "a.png", "--report", "none/r.json"}, 1, "none/r.json"},
        Mistake{"swipe_nan", {"render", "boxes", "-o", "a.png", "--against", "truth", "--swipe", "nan"}, 2, "\"nan\""},
        Mistake{"noise_nan", {"truth", "boxes", "-o", "a.png", "--noise", "nan"}, 2, "a number from 0 to 1"},
        Mistake{"seconds_nan", {"advise", "boxes", "--seconds", "nan"}, 2, "a number from 1 to 1e+06"},
        Mistake{"empty_scene", {"render", "", "-o", "a.png"}, 2, "SCENE is given as an empty word"},
        Mistake{"empty_default", {"edit", ""}, 2, "SCENE is given as an empty word"},
        Mistake{"empty_preset", {"render", "boxes", "-o", "a.png", "--preset", ""}, 2, "--preset is given as an empty"},
        Mistake{"empty_size", {"render", "boxes", "-o", "a.png", "--size", ""}, 2, "--size is given as an empty word"},
        Mistake{"empty_name", {"preset", "show", ""}, 2, "FILE is given as an empty word"},
        Mistake{"one_output", {"render", "boxes", "-o", "a.png", "--report", "./a.png"}, 2, "are one file"},
        Mistake{"one_output_of_truth", {"truth", "boxes", "-o", "a.png", "--report", "a.png"}, 2, "are one file"},
        Mistake{"unlike", {"render", "boxes", "-o", "a.png", "--set", "qqqq=1"}, 2, "\"qqqq\": unknown setting\n"},
        Mistake{"group", {"render", "boxes", "-o", "a.png", "--set", "filter=1"}, 2, "did you mean filter.kernel?"},
        Mistake{"scene", {"render", "boxs", "-o", "a.png"}, 2, "did you mean boxes?"},
        Mistake{"scene_of_great_length", {"render", std::string(5000, 'a'), "-o", "a.png"}, 2, "aaaa\u2026'"},
        Mistake{"preset_name", {"render", "boxes", "-o", "a.png", "--preset", "acn"}, 2, "did you mean acne?"},
        Mistake{
            "preset_scene", {"preset", "check", "lost.json"}, 1, "lost.json: its scene: gone.glb: cannot be opened"},
        Mistake{"preset_of_lost_scene", {"render", "--preset", "lost.json", "gone.glb", "-o", "a.png"}, 1, "gone.glb"},
        Mistake{"scene_file", {"render", "none.glb", "-o", "a.png"}, 1, "none.glb"},
        Mistake{"scene_broken", {"render", "broken.gltf", "-o", "a.png"}, 1, "broken.gltf"},
        Mistake{"preset_missing",
                {"render", "boxes", "-o", "a.png", "--preset", "none.json"},
                1,
                "none.json: no such file"},
        Mistake{
            "preset_bad", {"render", "boxes", "-o", "a.png", "--preset", "bad.json"}, 1, "did you mean bias.slope?"},
        Mistake{"preset_check", {"preset", "check", "bad.json"}, 1, "bad.json: settings.\"bias.slop\""},
        Mistake{"no_map",
                {"render", "boxes", "-o", "a.png", "--view", "shadow-map", "--set", "light.cast=off"},
                1,
                "light 0 has no shadow map"},
        Mistake{"no_light",
                {"render", "boxes", "-o", "a.pfm", "--view", "shadow-map", "--set", "view.light=3"},
                1,
                "light.count is 1"},
        Mistake{"pixel", {"probe", "boxes", "--pixel", "12"}, 2, "X,Y"},
        Mistake{"pixel_outside", {"probe", "boxes", "--pixel", "1280,0"}, 2, "outside of the picture"},
        Mistake{"pixel_negative", {"probe", "boxes", "--pixel=-1,0"}, 2, "outside of the picture"},
        Mistake{"list", {"list", "setings"}, 2, "did you mean settings?"},
        Mistake{"list_key", {"list", "settings", "bais"}, 2, "did you mean bias"},
        Mistake{"export", {"export", "boxes", "-o", "a.obj"}, 2, ".gltf or .glb"},
        Mistake{"screenshot", {"edit", "--headless"}, 2, "--screenshot"},
        Mistake{"window", {"edit", "boxes"}, 1, "display"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace si
