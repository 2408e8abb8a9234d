// Tests of --profile and of `list profiles` and `list profile NAME`.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

using Json = nlohmann::json;

TEST(Profiles, AreListed) {
    const Json list = program_json("list profiles");
    ASSERT_EQ(list.size(), 18u);
    EXPECT_EQ(list[0]["key"], "three");
    const Json three = program_json("list profile three");
    const auto& parameters = three["parameters"];
    const auto normal = std::ranges::find_if(parameters, [](const Json& p) { return p["key"] == "normalBias"; });
    ASSERT_NE(normal, parameters.end());
    EXPECT_EQ((*normal)["unit"], "m");
    EXPECT_EQ((*normal)["setting"], "bias.normal");
    const Json bevy = program_json("list profile bevy");
    EXPECT_NEAR(bevy["parameters"][0]["default_equivalent"]["metres"].get<double>(), 0.02, 1e-9);
    const ProcessResult text = run_program("list profile urp");
    EXPECT_EQ(text.code, 0);
    EXPECT_NE(text.out.find("shadowDepthBias"), std::string::npos);
    EXPECT_NE(text.out.find("hidden bias: 2.5 texels"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("cannot be turned off: bias.raster_slope=2.5"), std::string::npos) << text.out;
    const ProcessResult unverified = run_program("list profile unreal");
    EXPECT_NE(unverified.out.find("not verified: "), std::string::npos) << unverified.out;
    expect_error("list profile godto", 2, "did you mean godot?");
    expect_error("list profile", 2, "list profiles");
}

TEST(Profiles, AreFoundByEnginesNames) {
    for (const auto& [name, key] : {std::pair("normalOffsetBias", "bias.normal"),
                                    {"shadow_depth_bias", "bias.constant"},
                                    {"polygonOffsetSlope", "bias.raster_slope"}}) {
        const ProcessResult r = run_program(Words{"list", "settings", name});
        EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_NE(r.out.find(key), std::string::npos) << name << "\n" << r.out;
    }
    const ProcessResult r = run_program("list settings shadow_depth_bias");
    EXPECT_NE(r.out.find("Bevy shadow_depth_bias (m)"), std::string::npos) << r.out;
    EXPECT_NE(r.out.find("0.02 = 2.05 texels = 0.02 m"), std::string::npos) << "the conversion\n" << r.out;
}

TEST(Profiles, DrawTheEnginesNumbers) {
    const auto folder = fresh_test_folder();
    const Words size = "--size 160x90";
    const auto picture = [&](const Words& words, const char* name) {
        const ProcessResult r = run_program("render boxes" + words + size + Words{"-o", name}, folder);
        EXPECT_EQ(r.code, 0) << r.err;
        return file_bytes(folder / name);
    };
    const std::string none = picture("--profile three", "none.png");
    const std::string some = picture("--profile three --set engine.bias=-0.002", "some.png");
    const std::string same = picture(
        "--set map.format=d24 --set filter.kernel=vogel --set filter.taps=5 --set filter.bilinear=true --set "
        "filter.radius=1 --set "
        "caster.cull=front --set bias.kind=constant --set bias.unit=depth --set bias.constant=0.002 --set "
        "bias.normal=0",
        "same.png");
    EXPECT_NE(none, some) << "without bias there is acne";
    EXPECT_EQ(some, same) << "the engine's numbers are these settings";
}

/// Renders and returns the settings that were drawn.
Json drawn_settings(const std::filesystem::path& folder, const Words& words) {
    const ProcessResult r = run_program("render" + words + Words("--size 64x36 -o p.png --report r.json"), folder);
    EXPECT_EQ(r.code, 0) << r.err;
    return Json::parse(file_bytes(folder / "r.json"))["settings"];
}

TEST(Profiles, CountInTheMapOfABundle) {
    const auto folder = fresh_test_folder();
    const ProcessResult r = run_program(
        Words("export boxes --size 64x36 --bundle b.bundle --set light.fit=manual --set light.extent=12 --set "
              "map.resolution=256"),
        folder);
    ASSERT_EQ(r.code, 0) << r.err;
    const Json settings =
        drawn_settings(folder, "b.bundle" + Words("--profile three --set engine.normalBias=0.046875"));
    EXPECT_NEAR(settings["bias.normal"].get<double>(), 0.5, 1e-6) << "texels are 24 m / 256 wide";
}

SI_TEST_IS(Later, Profiles, LetDoubleSidedMaterialsCastWithBothFaces);
TEST(Profiles, LetDoubleSidedMaterialsCastWithBothFaces) {
    const auto folder = fresh_test_folder();
    const std::string key = "object.Table/Teapot.cull";
    const Json by_default = drawn_settings(folder, "teapot" + Words("--profile three"));
    EXPECT_EQ(by_default["caster.cull"], "front");
    EXPECT_EQ(by_default.value(key, ""), "none");
    EXPECT_FALSE(by_default.contains("object.Table/Floor.cull"));
    EXPECT_FALSE(
        drawn_settings(folder, "teapot" + Words("--profile three --set engine.shadowSide=BackSide")).contains(key))
        << "a given side holds for every material";
    EXPECT_FALSE(drawn_settings(folder, "teapot" + Words("--profile three --set caster.cull=front")).contains(key));
    EXPECT_EQ(drawn_settings(folder, "teapot" + Words("--profile babylon")).value(key, ""), "none");
    EXPECT_EQ(drawn_settings(folder, "teapot" + Words("--profile playcanvas"))["caster.cull"], "back");
}

TEST(Profiles, RefuseWhatIsWrongInOneLine) {
    expect_error("render boxes --profile three --set engine.normalBais=1 -o a.png", 2, "did you mean normalBias?");
    expect_error("render boxes --profile three --set engine.normalBias=nan -o a.png", 2, "number from 0 to 1000");
    expect_error("render boxes --profile three --set engine.normalBias=1e30 -o a.png", 2, "number from 0 to 1000");
    expect_error("render boxes --profile three --set engine.normalBias= -o a.png", 2, "number from 0 to 1000");
    expect_error("render boxes --profile unity -o a.png", 2, "it is one of three, babylon");
    expect_error("render boxes --set engine.bias=0 -o a.png", 2, "--profile");
    expect_error("measure boxes --profile urp --set bias.raster_slope=0", 2, "SetGlobalDepthBias");
}

SI_TEST_IS(Later, Profiles, SpeakInTheEnginesParameters);
TEST(Profiles, SpeakInTheEnginesParameters) {
    const Json measured = program_json(
        "measure boxes --profile three --set engine.bias=0 --set engine.shadowSide=DoubleSide --set map.resolution=256 "
        "--size 160x90 --no-time --cures");
    bool named = false;
    for (const Json& row : measured["cures"])
        if (row["engine"].is_object()) {
            named = true;
            EXPECT_EQ(row["engine"]["profile"], "three");
            EXPECT_TRUE(row["engine"]["parameters"].contains("normalBias") ||
                        row["engine"]["parameters"].contains("bias"))
                << row.dump();
            EXPECT_NE(row["engine"]["text"].get<std::string>().find("in three.js: set "), std::string::npos);
        }
    EXPECT_TRUE(named) << measured["cures"].dump();
}

SI_TEST_IS(Later, Profiles, LeaveOutWhatTheEngineLacks);
TEST(Profiles, LeaveOutWhatTheEngineLacks) {
    const Words size = "--size 160x90";
    const Json advised = program_json(
        "advise boxes --profile three --set engine.bias=0 --set engine.shadowSide=DoubleSide --set map.resolution=256" +
        size);
    EXPECT_GT(advised["refused"], 0);
    bool named = false;
    for (const char* const list : {"advice", "tried", "findings"})
        for (const Json& row : advised[list]) {
            ASSERT_TRUE(row.contains("engine")) << row.dump();
            named |= row["engine"].is_object();
            for (const auto& [key, value] : row["settings"].items()) {
                EXPECT_FALSE(key == "bias.kind" && value != "constant") << row.dump();
                EXPECT_FALSE(key == "filter.kernel" && value == "pcss") << row.dump();
                EXPECT_FALSE(key.starts_with("bias.raster")) << row.dump();
            }
        }
    EXPECT_TRUE(named) << advised.dump();
    const ProcessResult text =
        run_program("measure boxes --profile three --set map.resolution=256 --no-time --cures" + size);
    EXPECT_NE(text.out.find("that three.js lacks were not tried"), std::string::npos) << text.out;
}

SI_TEST_IS(Later, Profiles, AreTunedInTheEnginesNumbers);
TEST(Profiles, AreTunedInTheEnginesNumbers) {
    const auto folder = fresh_test_folder();
    const Json urp =
        program_json("tune boxes --profile urp --set map.resolution=512 --size 160x90 -o least.json", folder);
    ASSERT_TRUE(urp["found"].get<bool>());
    for (const Json& row : urp["biases"]) {
        EXPECT_TRUE(row["row"] == "constant" || row["row"] == "normal-offset") << row["row"];
        EXPECT_EQ(row["bias"]["raster_slope"], 2.5) << "hidden bias stays in every trial";
    }
    const Json playcanvas =
        program_json("tune boxes --profile playcanvas --set map.resolution=512 --size 160x90 -o pc.json", folder);
    for (const Json& row : playcanvas["biases"])
        EXPECT_GT(row["bias"]["constant"], 0) << "the hidden 0.0001 of the range, in every trial";
    EXPECT_EQ(urp["engine"]["profile"], "urp");
    EXPECT_TRUE(urp["engine"]["parameters"].contains("shadowDepthBias"));
}

// The first bias has a far larger normal offset than any that is tried, and so a wider map.
SI_TEST_IS(Later, Profiles, CountTunedNumbersInTheTunedMap);
TEST(Profiles, CountTunedNumbersInTheTunedMap) {
    const auto folder = fresh_test_folder();
    const Json tuned = program_json(
        "tune boxes --profile three --set engine.normalBias=0.5 --set map.resolution=512 --size 160x90 -o tuned.json",
        folder)["engine"];
    const Json drawn = program_json("convert tuned.json --to three --angle 45 --size 160x90 --no-time", folder);
    EXPECT_EQ(tuned["texels"], drawn["texels"]);
    EXPECT_NEAR(tuned["width_m"].get<double>(), drawn["width_m"].get<double>(), 1e-6);
    for (const Json& p : drawn["engine"]["parameters"])
        if (tuned["parameters"].contains(p["key"].get<std::string>())) {
            EXPECT_NEAR(tuned["parameters"][p["key"].get<std::string>()]["value"].get<double>(),
                        p["value"].get<double>(), 1e-6)
                << p["key"];
        }
}

}  // namespace
}  // namespace si
