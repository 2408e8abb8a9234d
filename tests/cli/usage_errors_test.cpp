// Tests of mistakes on the command line: one line on stderr that names the mistake, and the right exit code.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/support/process.h"

namespace si {
namespace {

struct Mistake {
    const char* name;
    Words arguments;
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
        << R"({"format":"shadow-inspector-preset","version":3,"settings":{"bias.slop":1}})";
    std::ofstream(folder / "lost.json")
        << R"({"format":"shadow-inspector-preset","version":3,"scene":"gone.glb","settings":{}})";
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

const Mistake kMistakes[] = {
    {"command", "rendr stage", 2, "did you mean render?"},
    {"subcommand", "preset chek bad.json", 2, "did you mean check?"},
    {"option", "render boxes -o a.png --bogus", 2, "--bogus"},
    {"extra", "render boxes plane -o a.png", 2, "plane"},
    {"no_scene", "render -o a.png", 2, "SCENE"},
    {"no_output", "render boxes", 2, "--output is required"},
    {"fit_of_a_picture", "render boxes -o a.png --fit", 2, "--view shadow-map or --view camera-depth"},
    {"unknown_key", "render boxes -o a.png --set bias.slop=1", 2, "did you mean bias.slope?"},
    {"series", "precision boxes --over sideways", 2, "distance, scale, stretch"},
    {"motion", "shimmer boxes --motion jump", 2, "camera, turn, light"},
    {"step", "shimmer boxes --step-texels nan", 2, "--step-texels"},
    {"shimmer_unlit", "shimmer boxes --set light.cast=off --size 32x18", 1, "no shadow map"},
    {"precision_unlit", "precision boxes --set light.count=0 --size 32x18", 1, "view.light"},
    {"no_value", "render boxes -o a.png --set bias.slope", 2, "KEY=VALUE"},
    {"nan", "render boxes -o a.png --set bias.slope=nan", 2, "not finite"},
    {"range", "render boxes -o a.png --set map.resolution=0", 2, "1 to 16384"},
    {"choice", "render boxes -o a.png --set filter.kernel=pcf33", 2, "did you mean pcf?"},
    {"node", "render boxes -o a.png --set object.Nowhere.cast=off", 2, "no such node"},
    {"sweep_nothing", "sweep boxes -o out", 2, "--vary"},
    {"sweep_key", "sweep boxes --vary bias.slop=1,2 -o out", 2, "did you mean bias.slope?"},
    {"sweep_value", "sweep boxes --vary bias.slope=1:9:0 -o out", 2, "does not lead"},
    {"sweep_twice", "sweep boxes --vary bias.slope=1 --vary bias.slope=2 -o out", 2, "varied twice"},
    {"sweep_shard", "sweep boxes --vary bias.slope=1 -o out --shard 3/2", 2, "2/8"},
    {"sweep_rounds", "sweep boxes --vary bias.slope=1 -o out --rounds 0", 2, "--rounds"},
    {"sweep_scene", "sweep broken.gltf --vary bias.slope=1 -o out", 1, "broken.gltf"},
    {"sweep_file", "sweep boxes --vary bias.slope=1 -o bad.json", 1, "bad.json"},
    {"merge_nothing", "merge folder.png -o out", 1, "holds no sweep"},
    {"size", "render boxes -o a.png --size 64", 2, "WIDTHxHEIGHT"},
    {"size_zero", "render boxes -o a.png --size 0x64", 2, "WIDTHxHEIGHT"},
    {"size_negative", "render boxes -o a.png --size -4x64", 2, "WIDTHxHEIGHT"},
    {"size_tail", "render boxes -o a.png --size 64x64x", 2, "WIDTHxHEIGHT"},
    {"view", "render boxes -o a.png --view visibilty", 2, "did you mean visibility?"},
    {"swipe_alone", "render boxes -o a.png --swipe 0.5", 2, "--against"},
    {"swipe_range", "render boxes -o a.png --against truth --swipe 2", 2, "--swipe"},
    {"against_view", "render boxes -o a.png --against truth --view normals", 2, "--view"},
    {"against_nothing", "render boxes -o a.png --against bad.json", 1, "bad.json"},
    {"extension", "render boxes -o a.jpg", 2, ".png"},
    {"float_picture", "render boxes -o a.pfm", 2, "write it as .png"},
    {"float_colours", "render boxes -o a.pfm --view light-uv", 2, "write it as .png"},
    {"to_folder", "render boxes -o folder.png", 1, "is a directory"},
    {"to_nowhere", "render boxes -o none/a.png", 1, "does not exist"},
    {"report_nowhere", "render boxes -o a.png --report none/r.json", 1, "none/r.json"},
    {"swipe_nan", "render boxes -o a.png --against truth --swipe nan", 2, "\"nan\""},
    {"noise_nan", "truth boxes -o a.png --noise nan", 2, "a number from 0 to 1"},
    {"seconds_nan", "advise boxes --seconds nan", 2, "a number from 1 to 1e+06"},
    {"empty_scene", Words{"render", "", "-o", "a.png"}, 2, "SCENE is given as an empty word"},
    {"empty_default", Words{"edit", ""}, 2, "SCENE is given as an empty word"},
    {"empty_preset", Words{"render", "boxes", "-o", "a.png", "--preset", ""}, 2, "--preset is given as an empty"},
    {"empty_size", Words{"render", "boxes", "-o", "a.png", "--size", ""}, 2, "--size is given as an empty word"},
    {"empty_name", Words{"preset", "show", ""}, 2, "FILE is given as an empty word"},
    {"one_output", "render boxes -o a.png --report ./a.png", 2, "are one file"},
    {"one_output_of_truth", "truth boxes -o a.png --report a.png", 2, "are one file"},
    {"unlike", "render boxes -o a.png --set qqqq=1", 2, "\"qqqq\": unknown setting\n"},
    {"group", "render boxes -o a.png --set filter=1", 2, "did you mean filter.kernel?"},
    {"scene", "render boxs -o a.png", 2, "did you mean boxes?"},
    {"scene_of_great_length", Words{"render", std::string(5000, 'a'), "-o", "a.png"}, 2, "aaaa\u2026'"},
    {"preset_name", "render boxes -o a.png --preset acn", 2, "did you mean acne?"},
    {"preset_scene", "preset check lost.json", 1, "lost.json: its scene: gone.glb: cannot be opened"},
    {"preset_of_lost_scene", "render --preset lost.json gone.glb -o a.png", 1, "gone.glb"},
    {"scene_file", "render none.glb -o a.png", 1, "none.glb"},
    {"scene_broken", "render broken.gltf -o a.png", 1, "broken.gltf"},
    {"preset_missing", "render boxes -o a.png --preset none.json", 1, "none.json: no such file"},
    {"preset_bad", "render boxes -o a.png --preset bad.json", 1, "did you mean bias.slope?"},
    {"preset_check", "preset check bad.json", 1, "bad.json: settings.\"bias.slop\""},
    {"no_map", "render boxes -o a.png --view shadow-map --set light.cast=off", 1, "light 0 has no shadow map"},
    {"no_light", "render boxes -o a.pfm --view shadow-map --set view.light=3", 1, "light.count is 1"},
    {"pixel", "probe boxes --pixel 12", 2, "X,Y"},
    {"pixel_outside", "probe boxes --pixel 1280,0", 2, "outside of the picture"},
    {"pixel_negative", "probe boxes --pixel=-1,0", 2, "outside of the picture"},
    {"list", "list setings", 2, "did you mean settings?"},
    {"list_key", "list settings bais", 2, "did you mean bias"},
    {"export", "export boxes -o a.obj", 2, ".gltf or .glb"},
    {"screenshot", "edit --headless", 2, "--screenshot"},
    {"window", "edit boxes", 1, "display"},
    {"advise_unbounded", "advise boxes -o p.json", 2, "--max-error or --max-ms"},
    {"advise_vary", "advise boxes --vary map.resolution=256", 2, "--max-error or --max-ms"},
    {"advise_error_zero", "advise boxes --max-error 0", 2, "--max-error: \"0\" is not a number above 0"},
    {"advise_error_nan", "advise boxes --max-error nan", 2, "\"nan\" is not a number above 0"},
    {"advise_extension", "advise boxes --max-ms 5 -o p.txt", 2, ".json"},
    {"advise_cost", "advise boxes --cost soon", 2, "forced, camera, light"},
    {"advise_error", "advise boxes --error prettiness", 2, "it is one of mae"},
    {"advise_value", "advise boxes --max-ms 5 --vary map.resolution=many", 2, "map.resolution"},
    {"tune_nothing", "tune boxes", 2, "-o"},
    {"tune_extension", "tune boxes -o p.txt", 2, ".json"},
    {"tune_error_zero", "tune boxes -o p.json --max-error 0", 2, "--max-error: \"0\" is not a number above 0"},
    {"tune_ms_inf", "tune boxes -o p.json --max-ms inf", 2, "\"inf\" is not a number above 0"},
    {"tune_ms_word", "tune boxes -o p.json --max-ms soon", 2, "--max-ms"},
    {"tune_error", "tune boxes -o p.json --error prettiness", 2, "it is one of mae"},
    {"tune_unlit", "tune boxes -o p.json --set light.cast=false", 1, "no bias to find"},
    {"tune_nowhere", "tune boxes -o none/p.json", 1, "none"},
    {"docs_only_settings", "docs settings -o s.md --only filter.kernel=hard", 2, ""},
    {"docs_only_printed", "docs techniques --only filter.kernel=hard", 2, ""},
    {"docs_only_missing", "docs techniques -o none.md --only filter.kernel=hard", 1, "none.md"},
    {"option_before_missing", "render boxes --ouput x.png", 2, "no option '--ouput'; did you mean --output?"},
    {"option_with_value", "measure boxes --size=3x3 --nope=1", 2, "no option '--nope'"},
    {"against_misspelt", "render boxes -o x.png --against tuth", 2, "did you mean truth?"},
    {"truth_extension", "truth boxes -o t.jpg", 2, ""},
    {"truth_nothing", "truth boxes", 2, ""},
    {"truth_samples", "truth boxes -o t.png --samples 0", 2, ""},
    {"truth_nowhere", "truth boxes -o nowhere/t.png", 1, ""},
    {"truth_unlit", "truth boxes -o t.png --set light.count=0 --size 64x64", 1, ""},
    {"list_light", "list settings light.16.fit", 2, "no key starts with 'light.16.fit'"},
    {"list_words", "list settings zzz", 2, "no setting is found by these words"},
    {"list_other", Words{"list", "filters", "normal bias"}, 2, ""},
    {"plan_rounds", "plan boxes --rounds 9", 2, ""},
    {"plan_no_rounds", "plan boxes --measure --rounds 0", 2, ""},
    {"plan_scene", "plan no-such-scene", 2, ""},
    {"scene_missing", "scene nothing.glb", 1, ""},
    {"sheet_extension", "contact-sheet folder.png -o s.jpg", 2, ".png"},
    {"sheet_missing", "contact-sheet nowhere -o s.png", 1, ""},
    {"theme", "edit boxes --headless --screenshot t.png --theme pink", 2, ""},
    {"case_scene", "scene hard/grazig", 2, "did you mean hard/grazing"},
    {"case_preset", "render boxes --preset hard/grazig -o x.png", 2, "did you mean hard/grazing"},
    {"light_map_too_small",
     "render stage -o x.png --no-cache --set light.source=light-map --set light_map.resolution=32", 1,
     "light_map.resolution 32"},
};

INSTANTIATE_TEST_SUITE_P(All, Mistakes, testing::ValuesIn(kMistakes),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace si
