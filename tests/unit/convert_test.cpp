// Tests of conversions into code: the worked example of each engine, hostile texts, and the preprocessor.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <regex>
#include <string>

#include "app/convert/conversion.h"
#include "app/convert/glsl_preprocessor.h"
#include "renderer/base/error.h"
#include "renderer/settings/param.h"
#include "renderer/settings/sources.h"
#include "tests/support/error_text.h"
#include "tests/support/process.h"
#include "tests/support/sets.h"
#include "tests/support/text.h"

namespace si {
namespace {

/// Settings of the worked example: 1.5 texels of constant bias, 1 texel of normal offset.
Settings worked_settings(const Sets& more = {}) {
    Settings s =
        settings_with(Settings{}, {"bias.kind=constant", "bias.unit=texels", "bias.constant=1.5", "bias.normal=1",
                                   "map.resolution=2048", "filter.kernel=hard", "light.extent=10",
                                   "light.near_far=manual", "light.near=0", "light.far=40"});
    set_all(s, more);
    return s;
}

ConversionInput worked_input(const Sets& more = {}) {
    ConversionInput in{.preset = "worked", .settings = worked_settings(more)};
    in.lookup = lookup_facts(in.settings);
    in.facts = facts_of_settings(in.settings, in.facts_source);
    in.angle_source = "by --angle";
    return in;
}

Conversion worked_conversion(std::string_view target, const Sets& more = {}) {
    return convert_settings(convert_target(target), worked_input(more));
}

/// Returns the number behind `before` in the code part of a conversion; NaN without it.
double number_behind(const Conversion& made, const std::string& before) {
    const std::string code = made.json["code"];
    const std::size_t at = code.find(before);
    if (at == code.npos) return std::nan("");
    return std::strtod(code.c_str() + at + before.size(), nullptr);
}

/// Number that the code of a target has behind a text.
struct WorkedNumber {
    const char *target, *before;
    double value;
    Sets more = {};
};

TEST(Convert, EachTargetPrintsTheWorkedExample) {
    const double slope = 1.5 + std::sqrt(2.0);  // equivalent depth bias of both at 45 degrees, texels
    const Sets d24{"map.format=d24"}, medium{"filter.kernel=tent", "filter.size=5"};
    const WorkedNumber numbers[] = {
        {"three", "shadow.bias = ", -0.000366211},
        {"three", "shadow.normalBias = ", 0.00976563},
        {"three", "right: ", 10},
        {"three", "far: NEAR + ", 40},
        {"babylon", "gen.bias = ", 0.000366211},
        {"babylon", "gen.bias = ", 0.000732422, medium},
        {"babylon", "gen.normalBias = ", 0.0138107},
        {"babylon", "light.shadowFrustumSize = ", 20},
        {"playcanvas", "light.normalOffsetBias = ", 0.00977},
        {"playcanvas", "light.shadowBias = ", 0.109},
        {"godot", "light.shadow_normal_bias = ", 1},
        {"godot", "light.shadow_bias = ", 0.0539},
        {"godot", "light.shadow_bias = ", 0.0269, {"filter.kernel=vogel", "filter.taps=4"}},
        {"urp", "light.shadowBias = ", 0.166, medium},
        {"urp", "light.shadowBias = ", 0.414},
        {"urp-slope", "light.shadowBias = ", 0.233, medium},
        {"hdrp", "hd.slopeBias = ", 0.3 - 0.0625 / 5},  // less the hidden bias, 1/65536 of D
        {"hdrp", "hd.normalBias = ", 0.7071},
        {"unreal", "ShadowBias = ", slope / 5},
        {"filament", "options.constantBias = ", 0.01466},
        {"filament", "options.normalBias = ", 2.83},
        {"filament", "options.polygonOffsetSlope = ", 0},
        {"bevy", "shadow_depth_bias: ", 0.0146484},
        {"bevy", "shadow_normal_bias: ", 0.7071},
        {"d3d12", "DepthBias = ", 6144, d24},
        {"opengl", "shader_normal_offset_m = ", 0.0097656},
        {"opengl", "shader_depth_bias = ", 3.66211e-4},
        {"webgpu", "depthBias: ", 6144, d24},
    };
    for (const WorkedNumber& n : numbers) {
        const Conversion made = worked_conversion(n.target, n.more);
        EXPECT_NEAR(number_behind(made, n.before), n.value, 0.006 * std::abs(n.value))
            << n.target << ": " << n.before << "\n"
            << made.text;
    }
}

TEST(Convert, FloatsOfCHaveAPoint) {
    const std::regex without_point("[^.0-9e-][0-9]+f\\b");
    for (const char* target : {"opengl", "vulkan", "d3d12", "ogre", "o3de"}) {
        const std::string code = worked_conversion(target, {"bias.constant=0", "bias.normal=0"}).json["code"];
        EXPECT_FALSE(std::regex_search(code, without_point)) << code;
        EXPECT_NE(code.find("0.0f"), std::string::npos) << code;
    }
}

TEST(Convert, FloatsOfRustHaveAPoint) {
    const std::string code = worked_conversion("bevy", {"bias.constant=0", "bias.normal=0"}).json["code"];
    EXPECT_EQ(test::lacking(code, {"shadow_depth_bias: 0.0,", "shadow_normal_bias: 0.0,"}), "");
}

TEST(Convert, TheCodeHasTheNumbersOfTheHead) {
    const auto expect_code = [](const char* target, const Sets& sets, std::initializer_list<std::string_view> parts) {
        const std::string code = worked_conversion(target, sets).json["code"];
        EXPECT_EQ(test::lacking(code, parts), "") << target;
    };
    const Sets many{"light.cascades=8", "map.resolution=4096"};
    expect_code("filament", many, {"options.mapSize = 2048;", "options.shadowCascades = 4;"});
    expect_code("filament19", many, {"options.mapSize = 2048;", "options.shadowCascades = 4;"});
    expect_code("playcanvas", many, {"shadowResolution = 8192;", "numCascades = 4;"});
    expect_code("o3de", many, {"Shadowmap size 2048", "Cascade count 4"});
    expect_code("urp", {"light.cascades=6", "map.resolution=8192"},
                {"main light shadow resolution 8192", "cascade count 4"});
    expect_code("bevy", many, {"size: 4096", "num_cascades: 8, overlap_proportion: 0.1"});
    expect_code("godot", {"light.cascades=3"}, {"SHADOW_PARALLEL_4_SPLITS", "directional_shadow/size = 4096"});
    expect_code("godot", {"light.cascades=2"}, {"SHADOW_PARALLEL_2_SPLITS", "directional_shadow/size = 4096"});
    expect_code("godot", {}, {"SHADOW_ORTHOGONAL", "directional_shadow/size = 2048"});
    expect_code("godot3", {"light.cascades=4", "caster.cull=front"},
                {"DirectionalLight.SHADOW_PARALLEL_4_SPLITS", "directional_shadow/size = 4096",
                 "shadow_reverse_cull_face = true", "filter_mode = Disabled"});
}

TEST(Convert, TheHeadCountsTheBiasInItsUnits) {
    const auto expect_term = [](const Sets& sets, std::string_view term) {
        const std::string text = worked_conversion("three", sets).text;
        EXPECT_EQ(test::lacking(text, {term}), "");
    };
    expect_term({"bias.normal_unit=metres", "bias.normal=0.02"}, "normal offset: 2.89631 texels");
    expect_term({"bias.normal=2", "bias.normal_by=sine"}, "normal offset: 2 texels");
    expect_term({"bias.raster_units=1024", "map.format=d24"}, "polygon offset: 0.25 texels");
    expect_term({"bias.raster_slope=8", "bias.raster_clamp=0.001"}, "polygon offset: 4.096 texels");
}

TEST(Convert, TheHeadNamesTheNumberWithoutRegardToHiddenBias) {
    const Sets medium{"filter.kernel=tent", "filter.size=5"};
    EXPECT_NE(worked_conversion("urp", medium).text.find("0.6 without regard to hidden bias"), std::string::npos);
    EXPECT_NE(worked_conversion("hdrp").text.find("0.3 without regard to hidden bias"), std::string::npos);
    EXPECT_NE(worked_conversion("three").text.find("adds by itself: 0 texels"), std::string::npos);
}

TEST(Convert, EveryTargetSaysWhatItsNumbersDependOn) {
    for (const ConvertTarget& target : convert_targets()) {
        const Conversion made = worked_conversion(target.name);
        EXPECT_NE(made.text.find("W 20 m, N 2048 texels, D 40 m"), std::string::npos) << target.name;
        EXPECT_NE(made.text.find("reference angle 45 degrees"), std::string::npos) << target.name;
        EXPECT_EQ(made.json["target"], target.name);
        const bool unsure = target.code && !engine_profile(target.name).unverified.empty();
        const std::string mark = fmt::format("\n{} not verified: ", target.comment);
        EXPECT_EQ(made.text.find(mark) != std::string::npos, unsure) << made.text;
        EXPECT_EQ(made.text.find("hidden bias") != std::string::npos, target.code != nullptr) << target.name;
    }
    EXPECT_NE(worked_conversion("unreal").text.find("not verified"), std::string::npos);
}

/// Returns the lines of a text that are neither empty nor begin with the mark of a comment.
std::vector<std::string> code_lines(const std::string& text, std::string_view mark) {
    std::vector<std::string> out;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (!line.empty() && !line.starts_with(mark)) out.push_back(line);
    return out;
}

TEST(Convert, TextsOfFilesNeverLeaveTheirComment) {
    const std::string hostile[] = {"a\nsystem(\"rm\");",
                                   "a\r\nb",
                                   "*/ evil(); /*",
                                   "// // //",
                                   "end\\",
                                   "end\\ ",
                                   "?"
                                   "?/\nb",
                                   "a\xe2\x80\xa8"
                                   "evil();",
                                   "a\xe2\x80\xa9"
                                   "b",
                                   "\x01\x1b[31m",
                                   "a\xc2\x85"
                                   "b",
                                   std::string("a\0b", 3),
                                   "\xff\xfe",
                                   "a\xe2\x80\xae"
                                   "b",
                                   "\\u000aevil()",
                                   "]]> --> --"};
    for (const ConvertTarget& target : convert_targets()) {
        const std::vector<std::string> plain = code_lines(worked_conversion(target.name).text, target.comment);
        for (const std::string& text : hostile) {
            ConversionInput in = worked_input();
            in.preset = in.title = in.scene = text;
            const std::string made = convert_settings(target, in).text;
            EXPECT_EQ(code_lines(made, target.comment), plain) << target.name << " with " << text;
            const std::string head = made.substr(0, made.find("\n\n"));
            for (const char* bad : {"*/",
                                    "?"
                                    "?",
                                    "\\", "\xe2\x80\xa8", "\xe2\x80\xa9", "\xc2\x85", "\x1b", "\r"})
                EXPECT_EQ(head.find(bad), std::string::npos) << target.name << " has " << bad;
            std::istringstream lines(head);
            for (std::string line; std::getline(lines, line);)
                EXPECT_EQ(line.find("//", 2), std::string::npos) << target.name << ": " << line;
        }
    }
}

TEST(Convert, AnUnknownTargetNamesTheNearest) {
    const auto unknown = [](const char* name) { return test::error_text([&] { convert_target(name); }); };
    EXPECT_NE(unknown("tree").find("did you mean three?"), std::string::npos) << unknown("tree");
    EXPECT_NE(unknown("babilon").find("did you mean babylon?"), std::string::npos);
    EXPECT_NE(unknown("nothing at all").find("godot"), std::string::npos);
}

TEST(Convert, SaysWhyALookUpCannotBeExported) {
    for (const Source& source : sources()) {
        const Settings s = worked_settings({{"light.source", std::string(source.key)}});
        EXPECT_EQ(lookup_export_refusal(s).empty(), source.needs.map) << source.key;
    }
    EXPECT_NE(lookup_export_refusal(worked_settings({"map.virtual=true"})).find("set map.virtual to false"),
              std::string::npos);
    EXPECT_NE(lookup_export_refusal(worked_settings({"light.cast=false"})).find("light.cast"), std::string::npos);
    EXPECT_THROW(worked_conversion("glsl", {"map.virtual=true"}), Error);
}

TEST(Convert, CppCompiles) {
    if (std::system("c++ --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "there is no compiler c++";
    const auto folder = fresh_test_folder();
    const Sets cases[] = {{}, {"light.type=point"}, {"light.cascades=4"}, {"bias.kind=slope", "filter.kernel=pcss"}};
    int number = 0;
    for (const Sets& sets : cases) {
        const std::string name = fmt::format("settings{}", number++);
        std::ofstream(folder / (name + ".h")) << worked_conversion("cpp", sets).text;
        std::ofstream(folder / (name + ".cpp")) << "#include \"" << name << ".h\"\n"
                                                << "static_assert(shadow::map_resolution == 2048);\n"
                                                << "static_assert(sizeof(shadow::View) == 19 * sizeof(float));\n";
        const std::string command =
            fmt::format("cd '{}' && c++ -std=c++17 -Wall -Wextra -Werror -fsyntax-only {}.cpp", folder.string(), name);
        EXPECT_EQ(std::system(command.c_str()), 0) << name;
    }
}

TEST(Convert, TheReferenceAngleIsTheTiltThatFewLitPixelsExceed) {
    FloatImage cosines{.width = 100, .height = 1, .channels = 4}, visibility{.width = 100, .height = 1};
    for (int i = 0; i < 100; ++i) {
        const float angle = float(i) * 3.14159265f / 200;  // 0 to 89.1 degrees
        cosines.data.insert(cosines.data.end(), {std::cos(angle), 0, 0, 1});
        visibility.data.push_back(1);
    }
    EXPECT_NEAR(reference_angle_deg(cosines, visibility).value(), 0.95 * 90, 1);
    for (int i = 50; i < 100; ++i) visibility.data[std::size_t(i)] = 0;
    EXPECT_NEAR(reference_angle_deg(cosines, visibility).value(), 0.95 * 45, 1);
    visibility.data.assign(100, 0);
    EXPECT_FALSE(reference_angle_deg(cosines, visibility));
}

TEST(GlslPreprocessor, CarriesOutDirectivesAndMacros) {
    const auto processed = [](std::string_view text) {
        const gl::Define defines[] = {{"A", "2"}, {"B", "A"}};
        return preprocess_glsl(text, defines);
    };
    EXPECT_EQ(processed("#if A == 2 && !defined(C)\nx\n#else\ny\n#endif\n"), "x\n");
    EXPECT_EQ(processed("#if (A + 1) * 2 > 6 || B != 2\nx\n#elif defined(A)\ny\n#endif\n"), "y\n");
    EXPECT_EQ(processed("#ifdef C\nx\n#ifdef A\ny\n#endif\n#else\nz\n#endif\n"), "z\n");
    EXPECT_EQ(processed("#define F(a, b) (a * b)\nF(B, f(1, 2)) F A1\n"), "(2 * f(1, 2)) F A1\n");
    EXPECT_EQ(processed("#define M \\\n 1\nM // A stays\n"), "1 // A stays\n");
    EXPECT_EQ(processed("float f = 1e-2;\n"), "float f = 1e-2;\n");
    EXPECT_THROW(processed("#if A\n"), Error);
    EXPECT_THROW(processed("#endif\n"), Error);
}

TEST(GlslPreprocessor, KeepsWhatTheRootsNeed) {
    const std::string text =
        "const int ONE = 1, TWO = 2;  // numbers\nstruct S {\n    int a;\n};\n// Head of a file.\n\n/// Adds.\n"
        "S add(S s) { return S(s.a + TWO); }\nuniform float unused[2];\nint other() { return 3; }\n";
    const std::string roots[] = {"add"};
    EXPECT_EQ(used_glsl(text, roots),
              "const int ONE = 1, TWO = 2;  // numbers\n\nstruct S {\n    int a;\n};\n\n/// Adds.\nS add(S s) { return "
              "S(s.a + "
              "TWO); }\n\n");
    EXPECT_TRUE(names_in_code("a // b\n", "a"));
    EXPECT_FALSE(names_in_code("a // b\n", "b"));
}

}  // namespace
}  // namespace si
