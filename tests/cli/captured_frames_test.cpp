// Captures that the tests make themselves: frames of a small OpenGL program with known matrices and states, over two
// drivers (one of them gives a capture of Vulkan), and frames of this project's renderer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/missing_reason.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

#ifndef SI_CAPTURE_PROGRAMS
#define SI_CAPTURE_PROGRAMS ""
#endif

namespace si {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Numbers of a product of two float matrices, relative to the largest.
constexpr double kMatrixError = 1e-6;
// Matrices that follow from positions after the vertex shader alone.
constexpr double kFittedMatrixError = 2e-5;

/// Returns the name of a package that captures need and that is missing, or an empty text.
std::string captured_lacks(bool over_zink) {
    if (std::string(SI_CAPTURE_PROGRAMS).empty()) return "librenderdoc-dev";
    if (run_shell("/usr/bin/python3 -I -c 'import renderdoc, numpy'").code != 0) return "python3-renderdoc";
    if (run_shell("LD_PRELOAD=librenderdoc.so /bin/true 2>&1 | grep -q librenderdoc").code == 0) return "librenderdoc";
    if (over_zink && run_shell("ls /usr/share/vulkan/icd.d/lvp_icd.*.json").code != 0) return "mesa-vulkan-drivers";
    return "";
}

glm::dmat4 captured_matrix(const Json& columns) {
    glm::dmat4 out;
    for (int i = 0; i < 16; ++i) out[i / 4][i % 4] = columns[std::size_t(i)];
    return out;
}

double captured_largest(const glm::dmat4& m) {
    double largest = 0;
    for (int i = 0; i < 16; ++i) largest = std::max(largest, std::abs(m[i / 4][i % 4]));
    return largest;
}

/// Returns the largest difference of two matrices, relative to the largest number.
double captured_difference(const glm::dmat4& a, const glm::dmat4& b) {
    return captured_largest(a - b) / captured_largest(b);
}

/// Returns the same of two projective matrices, whose common scale means nothing.
double captured_projective(const glm::dmat4& a, const glm::dmat4& b) {
    const auto scaled = [](const glm::dmat4& m) {
        return m * (1 / glm::length(glm::dvec4(m[0][3], m[1][3], m[2][3], m[3][3])));
    };
    return captured_difference(scaled(a), scaled(b));
}

glm::dmat4 captured_clip(const Json& view) {
    if (view.contains("clip_from_world")) return captured_matrix(view["clip_from_world"]);
    return captured_matrix(view["projection"]) * glm::inverse(captured_matrix(view["world_from_view"]));
}

/// Returns the matrices of all nodes of a .glb file without a hierarchy.
std::vector<glm::dmat4> captured_nodes(const fs::path& path) {
    const std::string bytes = file_bytes(path);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    std::vector<glm::dmat4> out;
    const Json model = Json::parse(bytes.substr(20, length));
    for (const Json& node : model["nodes"])
        out.push_back(node.contains("matrix") ? captured_matrix(node["matrix"]) : glm::dmat4(1));
    return out;
}

/// Returns the first channel of an image of a bundle, bottom row first.
std::vector<float> captured_texels(const fs::path& bundle, const Json& image) {
    const std::string bytes = file_bytes(bundle / image["file"].get<std::string>());
    EXPECT_EQ(image["first_row"], "bottom");
    std::vector<float> out;
    if (image["file"].get<std::string>().ends_with(".pfm")) {
        // Three lines, and floats.
        std::size_t at = 0;
        for (int line = 0; line < 3; ++line) at = bytes.find('\n', at) + 1;
        out.resize((bytes.size() - at) / sizeof(float));
        std::memcpy(out.data(), bytes.data() + at, out.size() * sizeof(float));
        return out;
    }
    const std::string format = image["format"];
    const std::size_t channels = image.value("channels", 1);
    const std::size_t size = format == "u16" ? 2 : 4;
    for (std::size_t at = 0; at + size * channels <= bytes.size(); at += size * channels) {
        if (format == "f32") {
            float value = 0;
            std::memcpy(&value, bytes.data() + at, sizeof value);
            out.push_back(value);
        } else {
            std::uint32_t value = 0;
            std::memcpy(&value, bytes.data() + at, size);
            out.push_back(float(value / (format == "u16" ? 65535.0 : 16777215.0)));
        }
    }
    return out;
}

/// Returns the largest difference of two images, or nothing where their sizes differ.
std::optional<float> captured_texel_difference(const std::vector<float>& a, const std::vector<float>& b) {
    if (a.size() != b.size() || a.empty()) return std::nullopt;
    float largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

std::vector<Json> captured_maps(const Json& frame) {
    std::vector<Json> out;
    for (const Json& light : frame["lights"])
        for (const Json& map : light["maps"]) out.push_back(map);
    return out;
}

void expect_gate_passes(const Json& summary) {
    ASSERT_TRUE(summary.contains("gate")) << summary;
    for (const Json& gate : summary["gate"]) {
        SCOPED_TRACE(gate.dump());
        EXPECT_TRUE(gate["passed"].get<bool>());
        if (gate.contains("agree")) {
            EXPECT_GE(gate["agree"].get<double>(), 0.995);
        }
        if (!gate.contains("captured_texels")) continue;
        const double covered = gate["captured_unmasked_texels"];
        EXPECT_LE(gate["missed"].get<double>(), 1e-3 * covered);
        EXPECT_LE(gate["extra"].get<double>(), 1e-4 * covered);
        if (gate.contains("depth") && gate["depth"].contains("median_steps")) {
            EXPECT_LE(gate["depth"]["median_steps"].get<double>(), 1.001);
            EXPECT_LE(gate["depth"]["percentile_99_steps"].get<double>(), 4.001);
        }
        if (gate["matrix_agreement"].is_number()) {
            EXPECT_LE(gate["matrix_agreement"].get<double>(), 1e-4);
        }
    }
}

/// One frame of draw_captured.
struct CapturedCase {
    const char* variant;
    bool over_zink = false;
    bool fitted = false;  ///< no constant holds a world matrix: the world is the object space of one object
};

void PrintTo(const CapturedCase& c, std::ostream* out) {
    *out << c.variant << (c.over_zink ? " over zink" : "");
}

const CapturedCase kCaptured[] = {
    {"directional"},
    {"spot"},
    {"point-cube"},
    {"point-layers"},
    {"point-skips"},
    {"point-misses"},
    {"layers-miss"},
    {"point-distance"},
    {"point-colour"},
    {"spot-and-point"},
    {"atlas"},
    {"front-culling"},
    {"clockwise"},
    {"mirrored"},
    {"one-matrix", false, true},
    {"one-matrix-spot", false, true},
    {"no-compare"},
    {"depth-clamp"},
    {"offset"},
    {"offset-float"},
    {"reversed"},
    {"far-away"},
    {"block"},
    {"directional", true},
    {"layers-miss", true},
    {"point-distance", true},
    {"clockwise", true},
    {"one-matrix", true, true},
    {"offset", true},
    {"reversed", true},
};

/// Returns the matrix that takes the known world to the imported one, if it takes every object to a node.
std::optional<glm::dmat4> captured_world(const std::vector<glm::dmat4>& nodes, const Json& truth, bool fitted) {
    std::vector<glm::dmat4> worlds;
    // The ground is flat. Its positions may be in the world already.
    for (const Json& object : truth["objects"])
        if (object["name"] != "Ground") worlds.push_back(captured_matrix(object["world"]));
    std::vector<glm::dmat4> choices = {glm::dmat4(1)};
    if (fitted) choices.clear();
    for (const glm::dmat4& world : worlds)
        if (fitted) choices.push_back(glm::inverse(world));
    for (const glm::dmat4& choice : choices) {
        const bool all = std::all_of(worlds.begin(), worlds.end(), [&](const glm::dmat4& world) {
            return std::any_of(nodes.begin(), nodes.end(), [&](const glm::dmat4& node) {
                return captured_difference(node, choice * world) < (fitted ? kFittedMatrixError : kMatrixError);
            });
        });
        if (all) return choice;
    }
    return std::nullopt;
}

class CapturedFrame : public testing::TestWithParam<CapturedCase> {};

SI_TESTS_ARE(Frame, CapturedFrame);

TEST_P(CapturedFrame, HasTheKnownMapsMatricesAndStates) {
    const CapturedCase& c = GetParam();
    if (const std::string package = captured_lacks(c.over_zink); !package.empty())
        GTEST_SKIP() << test::kMissingReason << package;
    const fs::path folder = fresh_test_folder();
    const std::string program = "'" + std::string(SI_CAPTURE_PROGRAMS) + "/draw_captured' " + c.variant + " .";
    const ProcessResult drawn =
        run_shell(c.over_zink ? "ENABLE_VULKAN_RENDERDOC_CAPTURE=1 '" SI_SOURCE_DIR "/scripts/on_zink.sh' " + program
                              : "LD_PRELOAD=librenderdoc.so " + program,
                  folder);
    ASSERT_EQ(drawn.code, 0) << drawn.err;
    ASSERT_TRUE(fs::exists(folder / "frame_capture.rdc")) << drawn.out << drawn.err;
    const Json summary = program_json({"import-capture", "frame_capture.rdc", "-o", "a.bundle", "--json"}, folder);
    expect_gate_passes(summary);
    const Json truth = Json::parse(file_bytes(folder / "truth.json"));
    const Json frame = Json::parse(file_bytes(folder / "a.bundle/frame.json"));

    const std::vector<glm::dmat4> nodes = captured_nodes(folder / "a.bundle/scene.glb");
    EXPECT_EQ(nodes.size(), truth["objects"].size());
    const std::optional<glm::dmat4> world = captured_world(nodes, truth, c.fitted);
    ASSERT_TRUE(world) << "the objects lie elsewhere";
    // Angles of the world are those of the scene: three columns of one length, at right angles.
    const glm::dmat3 axes(*world);
    const glm::dmat3 square = glm::transpose(axes) * axes;
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(square[i / 3][i % 3] / square[0][0], i % 4 == 0 ? 1 : 0, 1e-4);
    const double error = c.fitted ? kFittedMatrixError : kMatrixError;
    EXPECT_LT(captured_projective(captured_clip(frame["camera"]) * *world, captured_matrix(truth["camera"])), error);

    ASSERT_EQ(frame["lights"].size(), truth["lights"].size());
    for (std::size_t i = 0; i < truth["lights"].size(); ++i) {
        const Json &light = frame["lights"][i], &known = truth["lights"][i];
        EXPECT_EQ(light["type"], known["type"]);
        const bool is_sun = known["type"] == "directional";
        const Json& place = known[is_sun ? "direction" : "position"];
        glm::dvec3 expected = glm::dvec3(*world * glm::dvec4(place[0], place[1], place[2], is_sun ? 0 : 1));
        if (is_sun) expected = glm::normalize(expected);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(light[is_sun ? "direction" : "position"][std::size_t(axis)].get<double>(), expected[axis],
                        1e-4 * (1 + glm::length(expected)));
        const std::string compare = truth["maps"][0]["compare"];
        EXPECT_EQ(light["lookup"].value("compare", ""), compare);
        EXPECT_FALSE(light["lookup"].contains("bias")) << "unknown, not 0";
    }

    const std::vector<Json> maps = captured_maps(frame);
    ASSERT_EQ(maps.size(), truth["maps"].size());
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const Json &map = maps[i], &known = truth["maps"][i];
        SCOPED_TRACE("slice " + known["slice"].dump());
        EXPECT_LT(captured_projective(captured_clip(map) * *world, captured_matrix(known["clip_from_world"])), error);
        EXPECT_EQ(map["depth"]["range"], known["range"]);
        EXPECT_EQ(map["depth"]["reversed"], known["reversed"]);
        const Json& raster = map["raster"];
        EXPECT_EQ(raster["cull"], known["cull"]);
        EXPECT_EQ(raster["front"], known["mirrored"].get<bool>() ? "cw" : "ccw");
        EXPECT_EQ(raster["depth_clamp"], known["depth_clamp"]);
        EXPECT_EQ(raster["offset_factor"], known["offset_factor"]);
        // Zink asks Vulkan for two units where OpenGL says one.
        EXPECT_EQ(raster["offset_units"].get<double>(), known["offset_units"].get<double>() * (c.over_zink ? 2 : 1));
        if (map["extras"].contains("front_in_engine")) {
            EXPECT_EQ(map["extras"]["front_in_engine"], known["front"]);
        }
        const std::string stored = map["depth"]["stored"];
        EXPECT_EQ(stored.starts_with("distance") ? "distance" : stored, known["stored"]);
        if (stored == "distance-share") {
            EXPECT_NEAR(map["depth"]["range_m"].get<double>(), 20, 1e-3);
        }
        std::vector<float> texels(256 * 256);
        const std::string bytes = file_bytes(folder / ("truth_" + std::to_string(i) + ".raw"));
        ASSERT_EQ(bytes.size(), texels.size() * sizeof(float));
        std::memcpy(texels.data(), bytes.data(), bytes.size());
        const auto difference = captured_texel_difference(captured_texels(folder / "a.bundle", map["image"]), texels);
        ASSERT_TRUE(difference);
        // Integers become floats in two ways.
        EXPECT_LE(*difference, 6e-8);
    }
    if (c.variant == std::string("mirrored")) {
        const ProcessResult compared = run_program("compare-maps a.bundle --check", folder);
        EXPECT_EQ(compared.code, 0) << compared.out << compared.err;
    }
}

INSTANTIATE_TEST_SUITE_P(All, CapturedFrame, testing::ValuesIn(kCaptured), [](const auto& each) {
    std::string name = each.param.variant;
    std::replace(name.begin(), name.end(), '-', '_');
    return name + (each.param.over_zink ? "_over_zink" : "");
});

/// One frame of this project's renderer.
struct OwnFrame {
    const char* name;
    const char* scene;
    std::vector<std::string> sets;
};

void PrintTo(const OwnFrame& c, std::ostream* out) {
    *out << c.name;
}

const OwnFrame kOwnFrames[] = {
    {"sun", "boxes", {"caster.cull=back"}},
    {"cascades", "boxes", {"caster.cull=back", "light.cascades=3", "light.fit=view"}},
    {"spot", "figures", {"caster.cull=back", "light.type=spot"}},
    {"point", "boxes", {"caster.cull=back", "light.type=point"}},
    {"offset", "stage", {"caster.cull=back", "map.format=d16", "bias.raster_slope=2", "bias.raster_units=4"}},
    {"reversed", "boxes", {"caster.cull=front", "map.format=d24", "map.reversed_z=true"}},
};

class CapturedOwnFrame : public testing::TestWithParam<OwnFrame> {};

SI_TESTS_ARE(Frame, CapturedOwnFrame);

TEST_P(CapturedOwnFrame, EqualsItsExportedBundle) {
    if (const std::string package = captured_lacks(false); !package.empty())
        GTEST_SKIP() << test::kMissingReason << package;
    const OwnFrame& c = GetParam();
    const fs::path folder = fresh_test_folder();
    Words words = {"export", c.scene, "--bundle", "own.bundle", "--size", "320x180", "--set", "map.resolution=256"};
    std::string sets = " map.resolution=256";
    for (const std::string& set : c.sets) {
        words.push_back("--set");
        words.push_back(set);
        sets += " " + set;
    }
    const ProcessResult exported = run_program(words, folder);
    ASSERT_EQ(exported.code, 0) << exported.err;
    const ProcessResult drawn = run_shell(
        "LD_PRELOAD=librenderdoc.so '" + std::string(SI_CAPTURE_PROGRAMS) + "/capture_scene' . " + c.scene + sets,
        folder);
    ASSERT_EQ(drawn.code, 0) << drawn.err;
    const Json summary = program_json({"import-capture", "frame_capture.rdc", "-o", "a.bundle", "--json"}, folder);
    expect_gate_passes(summary);

    const Json frame = Json::parse(file_bytes(folder / "a.bundle/frame.json"));
    const Json own = Json::parse(file_bytes(folder / "own.bundle/frame.json"));
    ASSERT_EQ(frame["lights"].size(), own["lights"].size());
    for (std::size_t i = 0; i < own["lights"].size(); ++i)
        EXPECT_EQ(frame["lights"][i]["type"], own["lights"][i]["type"]);
    EXPECT_LT(captured_projective(captured_clip(frame["camera"]), captured_clip(own["camera"])), kMatrixError);
    const std::vector<Json> maps = captured_maps(frame), known = captured_maps(own);
    ASSERT_EQ(maps.size(), known.size());
    for (std::size_t i = 0; i < maps.size(); ++i) {
        SCOPED_TRACE("map " + std::to_string(i));
        EXPECT_LT(captured_projective(captured_clip(maps[i]), captured_clip(known[i])), kMatrixError);
        const Json &depth = maps[i]["depth"], &known_depth = known[i]["depth"];
        EXPECT_EQ(depth["range"], known_depth["range"]);
        EXPECT_EQ(depth["reversed"].get<bool>(), known_depth.value("reversed", false));
        EXPECT_EQ(depth["format"].get<std::string>(), known_depth.value("format", "d32f"));
        // Double-sided casters alone are drawn into a face with single planes.
        if (maps[i]["raster"]["cull"] != "none") {
            EXPECT_EQ(maps[i]["raster"]["cull"], known[i]["raster"]["cull"]);
        }
        for (const char* key : {"offset_factor", "offset_units", "offset_clamp", "depth_clamp"})
            EXPECT_EQ(maps[i]["raster"][key], known[i]["raster"][key]) << key;
        const auto difference = captured_texel_difference(captured_texels(folder / "a.bundle", maps[i]["image"]),
                                                          captured_texels(folder / "own.bundle", known[i]["image"]));
        ASSERT_TRUE(difference);
        EXPECT_LE(*difference, 6e-8);
    }
}

INSTANTIATE_TEST_SUITE_P(All, CapturedOwnFrame, testing::ValuesIn(kOwnFrames),
                         [](const auto& each) { return std::string(each.param.name); });

SI_TESTS_ARE(Frame, CapturedVerdicts);

/// Verdicts on the imported frame, with the bias that its look-up has, are those on the exported one.
TEST(CapturedVerdicts, EqualThoseOfTheExportedFrame) {
    if (const std::string package = captured_lacks(false); !package.empty())
        GTEST_SKIP() << test::kMissingReason << package;
    const fs::path folder = fresh_test_folder();
    const std::vector<std::string> look_up = {"bias.kind=constant", "bias.unit=metres", "bias.constant=0.02",
                                              "bias.normal=0", "filter.kernel=hard"};
    Words exports = {"export",  "boxes", "--bundle",           "own.bundle", "--size",
                     "320x180", "--set", "map.resolution=256", "--set",      "caster.cull=back"};
    Words measure;
    std::string sets = " map.resolution=256 caster.cull=back";
    for (const std::string& set : look_up) {
        for (Words* words : {&exports, &measure}) {
            words->push_back("--set");
            words->push_back(set);
        }
        sets += " " + set;
    }
    ASSERT_EQ(run_program(exports, folder).code, 0);
    const ProcessResult drawn = run_shell(
        "LD_PRELOAD=librenderdoc.so '" + std::string(SI_CAPTURE_PROGRAMS) + "/capture_scene' . boxes" + sets, folder);
    ASSERT_EQ(drawn.code, 0) << drawn.err;
    program_json({"import-capture", "frame_capture.rdc", "-o", "a.bundle", "--json"}, folder);
    // The bias is read from the settings in the shader's buffer, digit by digit.
    const Json frame = Json::parse(file_bytes(folder / "a.bundle/frame.json"));
    const Json bias = {{"constant", 0.02}, {"slope", 0}, {"normal", 0.0}, {"units", "metres, metres, texels"}};
    EXPECT_EQ(frame["lights"][0]["lookup"].value("bias", Json()), bias);
    const Words size = {"--size", "160x90", "--json"};
    const Json imported = program_json(Words{"measure", "a.bundle"} + size + measure, folder);
    const Json known = program_json(Words{"measure", "own.bundle"} + size + measure, folder);
    EXPECT_EQ(imported["error"]["pixels"], known["error"]["pixels"]);
    // Matrices that were read from floats differ in the last digit, which moves a pixel at an edge of acne.
    for (const auto& [key, count] : known["error"]["artefacts"].items())
        EXPECT_NEAR(imported["error"]["artefacts"][key].get<int>(), count.get<int>(), 2) << key;
    EXPECT_GT(known["error"]["artefacts"]["acne"].get<int>(), 50) << "a frame without wrong pixels shows nothing";
}

}  // namespace
}  // namespace si
