// Tests of `import-capture`: captures in ../shared/captures, the comparison of each map slice, and captures that cannot
// be opened. Tests that need the captures or RenderDoc's module are skipped without them.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/gltf/image_decode.h"
#include "tests/support/missing_reason.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

fs::path captures() {
    return fs::path(SI_SOURCE_DIR) / ".." / "shared" / "captures";
}

bool has_module() {
    return run_shell("/usr/bin/python3 -I -c 'import renderdoc, numpy'").code == 0;
}

/// Numbers of one map slice, from an independent trial that is written in MANIFEST.tsv beside the captures.
struct Slice {
    int draws = 0, instances = 0, masked_draws = 0, skinned_draws = 0;
    int captured_texels = 0;
    double captured_slack = 0;  ///< share by which the count of covered texels may differ: other clear values
};

struct CaptureCase {
    const char* name;  ///< file without extension
    std::vector<Slice> slices;
    bool depth = true;                   ///< the map holds depths: median and 99th percentile are compared
    int not_finite = 0;                  ///< texels without a number, in all slices
    bool camera = true;                  ///< the camera is found and its depth agrees
    bool picture = true;                 ///< the frame has a picture; a frame off screen may have none
    bool shader_bias = false;            ///< the casters' shader moves depths
    std::vector<double> ends = {};       ///< camera depths at which the cascades of the first light end; empty: unknown
    std::optional<int> most_extra = {};  ///< of an independent trial, which missed none
    std::vector<double> constant = {}, normal = {};  ///< bias of the look-up of each light, metres; empty: unknown
    const char* normal_by = "length";                ///< what the light's angle does to the normal offset
    bool compared = true;  ///< maps pass the gate of compare-maps; moments and exponentials do not
};

void PrintTo(const CaptureCase& c, std::ostream* out) {
    *out << c.name;
}

const CaptureCase kCases[] = {
    // Filament's own default is a constant bias of 0.001 m.
    {.name = "filament_csm_gl",
     .slices = {{30, 30, 3, 1, 69571}, {30, 30, 3, 1, 85088}, {30, 30, 3, 1, 51661}, {16, 16, 3, 1, 265845}},
     .ends = {10.7793, 21.4586, 80},
     .constant = {0.001, 0.001},
     .normal = {0.0293, 0},
     .normal_by = "sine"},
    {"filament_csm_zink",
     {{30, 30, 3, 1, 65083}, {30, 30, 3, 1, 82715}, {30, 30, 3, 1, 51661}, {16, 16, 3, 1, 268580}}},
    {.name = "filament_vsm_gl",
     .slices = {{31, 31, 3, 1, 253588, 2e-3},
                {31, 31, 3, 1, 247989, 2e-3},
                {31, 31, 3, 1, 176920, 2e-3},
                {17, 17, 3, 1, 260100}},
     .depth = false,
     .ends = {10.7793, 21.4586, 80},
     .normal = {0.0588, 0},
     .normal_by = "sine",
     .compared = false},
    {"shadow_inspector_zink", {{28, 96, 2, 0, 802590}}, true, 0, true, false},
    {.name = "vtk_shadow_pass",
     .slices = {{4, 4, 0, 0, 238729}, {4, 4, 0, 0, 251187}},
     .depth = false,
     .not_finite = 1,
     .compared = false},
};

class ImportCapture : public testing::TestWithParam<CaptureCase> {};

SI_TESTS_ARE(Frame, ImportCapture);

TEST_P(ImportCapture, RebuildsEachSliceWithinTheGate) {
    const CaptureCase& c = GetParam();
    const fs::path file = captures() / (std::string(c.name) + ".rdc");
    if (!fs::exists(file)) GTEST_SKIP() << test::kMissingReason << "../shared/captures";
    if (!has_module()) GTEST_SKIP() << test::kMissingReason << "python3-renderdoc";
    const fs::path folder = fresh_test_folder();
    const Json summary = program_json({"import-capture", file.string(), "-o", "a.bundle", "--json"}, folder);
    ASSERT_TRUE(summary.contains("gate")) << summary;
    std::vector<Json> maps;
    for (const Json& gate : summary["gate"])
        if (gate.contains("captured_texels")) maps.push_back(gate);
    ASSERT_EQ(maps.size(), c.slices.size());
    int not_finite = 0;
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const Json& map = maps[i];
        const Slice& slice = c.slices[i];
        SCOPED_TRACE(map["name"].get<std::string>());
        std::printf("%s, %s: %d texels, %d missed, %d extra, depth %s\n", c.name,
                    map["name"].get<std::string>().c_str(), map["captured_texels"].get<int>(), map["missed"].get<int>(),
                    map["extra"].get<int>(),
                    map.contains("depth") ? map["depth"].dump().c_str() : map["texels_hold"].dump().c_str());
        EXPECT_EQ(map["draws"], slice.draws);
        EXPECT_EQ(map["instances"], slice.instances);
        EXPECT_EQ(map["masked_draws"], slice.masked_draws);
        EXPECT_EQ(map["post_vertex_draws"], slice.skinned_draws);
        EXPECT_NEAR(map["captured_texels"].get<double>(), slice.captured_texels,
                    slice.captured_slack * slice.captured_texels);
        const double unmasked = map["captured_unmasked_texels"];
        EXPECT_LE(map["missed"].get<double>(), 1e-3 * unmasked);
        EXPECT_LE(map["extra"].get<double>(), 1e-4 * unmasked);
        if (c.most_extra) {
            EXPECT_EQ(map["missed"], 0);
            EXPECT_LE(map["extra"].get<int>(), *c.most_extra);
        }
        EXPECT_TRUE(map["passed"].get<bool>());
        EXPECT_EQ(map.value("shader_bias", false), c.shader_bias);
        if (c.depth && !c.shader_bias) {
            EXPECT_LE(map["depth"]["median_steps"].get<double>(), 1.01);
            EXPECT_LE(map["depth"]["percentile_99_steps"].get<double>(), 4.0);
        }
        if (map["matrix_agreement"].is_number()) {
            EXPECT_LE(map["matrix_agreement"].get<double>(), 1e-4);
        }
        not_finite += map["not_finite"].get<int>();
    }
    EXPECT_EQ(not_finite, c.not_finite);
    if (c.camera) {
        EXPECT_TRUE(summary["gate"].back()["passed"].get<bool>()) << summary["gate"].back();
    }
    for (const char* name : {"frame.json", "scene.glb"}) EXPECT_TRUE(fs::exists(folder / "a.bundle" / name)) << name;
    EXPECT_EQ(fs::exists(folder / "a.bundle/picture.png"), c.picture);
    const Json frame = Json::parse(file_bytes(folder / "a.bundle" / "frame.json"));
    ASSERT_LE(std::max(c.constant.size(), c.normal.size()), frame["lights"].size());
    for (std::size_t i = 0; i < frame["lights"].size(); ++i) {
        const Json bias = frame["lights"][i]["lookup"].value("bias", Json::object());
        EXPECT_EQ(bias.contains("constant"), i < c.constant.size()) << "unknown, not 0: " << bias;
        if (i < c.constant.size()) {
            EXPECT_NEAR(bias["constant"].get<double>(), c.constant[i], 1e-4);
        }
        if (i < c.normal.size()) {
            EXPECT_NEAR(bias["normal"].get<double>(), c.normal[i], 1e-4);
            EXPECT_EQ(bias.value("normal_by", "length"), c.normal_by);
        }
    }
    if (!c.constant.empty()) {
        const Json probed =
            program_json({"probe", "a.bundle", "--size", "640x360", "--pixel", "320,330", "--json"}, folder);
        EXPECT_EQ(probed["lights"][0]["dossier"]["engine_bias"], "known");
    }
    if (c.compared) {
        const ProcessResult compared =
            run_program({"compare-maps", "a.bundle", "--leave-out-masked", "--check"}, folder);
        EXPECT_EQ(compared.code, 0) << compared.out << compared.err;
    }
    const Json& sun = frame["lights"][0];
    for (std::size_t i = 0; i < sun["maps"].size(); ++i) {
        ASSERT_EQ(sun["maps"][i].contains("interval"), !c.ends.empty());
        EXPECT_EQ(sun["maps"][i]["raster"].contains("shift_m"), c.shader_bias);
        if (!c.ends.empty()) {
            EXPECT_NEAR(sun["maps"][i]["interval"][1].get<double>(), c.ends[i], 1e-3);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, ImportCapture, testing::ValuesIn(kCases),
                         [](const auto& each) { return std::string(each.param.name); });

// The project's defaults are splits of 0.1, 0.2 and 0.5 of the way from 0.1 m to 100 m.
const CaptureCase kLargeCases[] = {
    {.name = "godot_platformer",
     .slices = {{263, 1623, 0, 4, 2155296},
                {479, 2647, 0, 10, 967754},
                {487, 2664, 0, 10, 158610},
                {487, 2664, 0, 10, 39838}},
     .shader_bias = true,
     .ends = {10.09, 20.08, 50.05, 100},
     .most_extra = 5,
     .constant = {0},
     .normal = {0}},
};

INSTANTIATE_TEST_SUITE_P(Large, ImportCapture, testing::ValuesIn(kLargeCases),
                         [](const auto& each) { return std::string(each.param.name); });

/// Reads a grey PFM picture, rows from the top. Its first row is the bottom one.
std::vector<float> pfm_values(const fs::path& file, std::size_t width, std::size_t height) {
    const std::string bytes = file_bytes(file);
    std::vector<float> out(width * height);
    if (bytes.size() < out.size() * sizeof(float)) return {};
    const char* data = bytes.data() + bytes.size() - out.size() * sizeof(float);
    for (std::size_t y = 0; y < height; ++y)
        std::memcpy(&out[(height - 1 - y) * width], data + y * width * sizeof(float), width * sizeof(float));
    return out;
}

SI_TESTS_ARE(Frame, ImportCapturePicture);

// The engine's own picture decides: at edges of the sun's shadows on the ground, its light is nearest to the visibility
// that this program derives from the engine's maps and the stated bias. Other offsets are farther.
TEST(ImportCapturePicture, FilamentsSunAgreesBestWithTheStatedOffset) {
    const fs::path file = captures() / "filament_csm_gl.rdc";
    if (!fs::exists(file)) GTEST_SKIP() << test::kMissingReason << "../shared/captures";
    if (!has_module()) GTEST_SKIP() << test::kMissingReason << "python3-renderdoc";
    const fs::path folder = fresh_test_folder();
    ASSERT_EQ(run_program({"import-capture", file.string(), "-o", "a.bundle"}, folder).code, 0);
    const std::string png = file_bytes(folder / "a.bundle/picture.png");
    const gltf::Image picture = gltf::decode_image({reinterpret_cast<const std::uint8_t*>(png.data()), png.size()});
    constexpr int kWidth = 640, kHeight = 360;
    ASSERT_EQ(picture.width, kWidth);
    ASSERT_EQ(picture.height, kHeight);
    const Json frame = Json::parse(file_bytes(folder / "a.bundle/frame.json"));
    glm::dmat4 clip;
    for (int i = 0; i < 16; ++i) clip[i / 4][i % 4] = frame["camera"]["clip_from_world"][i];
    const glm::dmat4 rows = glm::transpose(clip);
    const glm::dmat3 from_clip = glm::inverse(glm::transpose(glm::dmat3(rows[0], rows[1], rows[3])));
    // Spot light and ground of the captured scene, counted from the camera.
    const glm::dvec3 spot(-12, 1, -7), spot_axis = glm::normalize(glm::dvec3(0.4, -1, -0.5));
    constexpr double kGround = -6, kSpotAngle = 0.61, kLastSplit = 21.4;

    struct Point {
        std::size_t pixel;
        double light;  ///< linear
    };
    std::vector<Point> ground;
    std::vector<double> lights;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const glm::dvec3 ray = from_clip * glm::dvec3(2 * (x + 0.5) / kWidth - 1, 1 - 2 * (y + 0.5) / kHeight, 1);
            const double along = kGround / ray.y;
            const glm::dvec3 p = ray * along;
            if (!(along > 0 && along < kLastSplit)) continue;
            if (glm::dot(glm::normalize(p - spot), spot_axis) > std::cos(kSpotAngle)) continue;
            const std::size_t i = std::size_t(y * kWidth + x);
            const int red = picture.rgba[4 * i], green = picture.rgba[4 * i + 1], blue = picture.rgba[4 * i + 2];
            if (std::abs(red - green) >= 25 || green < blue || red < green - 2) continue;  // no grey: another object
            ground.push_back({i, std::pow((red + green + blue) / 765.0, 2.2)});
            lights.push_back(ground.back().light);
        }
    ASSERT_GT(ground.size(), 50'000u);
    std::ranges::sort(lights);
    const double lit = lights[lights.size() / 2];

    const auto visibility = [&](const std::vector<std::string>& sets) {
        Words words("render a.bundle -o v.pfm --size 640x360 --view visibility --set filter.kernel=hw2x2");
        for (const std::string& set : sets) {
            words.push_back("--set");
            words.push_back(set);
        }
        EXPECT_EQ(run_program(words, folder).code, 0);
        return pfm_values(folder / "v.pfm", kWidth, kHeight);
    };
    const std::vector<float> stated = visibility({});
    ASSERT_FALSE(stated.empty());
    std::vector<double> darks;
    for (const Point& p : ground)
        if (stated[p.pixel] == 0) darks.push_back(p.light);
    ASSERT_GT(darks.size(), 300u);
    std::ranges::sort(darks);
    const double dark = darks[darks.size() / 2];
    // Within two pixels of an edge.
    std::vector<Point> edges;
    for (const Point& p : ground) {
        bool near = false;
        for (int dy = -2; dy <= 2; ++dy)
            for (int dx = -2; dx <= 2; ++dx) {
                const long at = long(p.pixel) + dy * kWidth + dx;
                if (at >= 0 && at < long(stated.size())) near |= stated[at] > 0 && stated[at] < 1;
            }
        if (near) edges.push_back(p);
    }
    const auto distance = [&](const std::vector<float>& drawn) {
        double sum = 0;
        for (const Point& p : edges) {
            const double shown = std::clamp((p.light - dark) / (lit - dark), 0.0, 1.0);
            sum += std::pow(shown - double(drawn[p.pixel]), 2);
        }
        return std::sqrt(sum / double(edges.size()));
    };
    const double best = distance(stated);
    std::printf("%zu pixels at edges, as stated %.4f\n", edges.size(), best);
    EXPECT_LT(best, 0.16);  // 0.1537 measured, 0.1598 without an offset
    for (const char* set : {"bias.normal=0", "bias.normal=0.0586", "bias.normal_by=length",
                            "bias.normal_by=one-minus-cosine", "bias.normal_by=sideways"}) {
        const double other = distance(visibility({set}));
        std::printf("%s %.4f\n", set, other);
        EXPECT_LT(best, 0.98 * other) << set;
    }
}

SI_TESTS_ARE(Frame, ImportCaptureList);

TEST(ImportCaptureList, NamesMapsAndKindsOfLight) {
    const fs::path file = captures() / "filament_csm_gl.rdc";
    if (!fs::exists(file)) GTEST_SKIP() << test::kMissingReason << "../shared/captures";
    if (!has_module()) GTEST_SKIP() << test::kMissingReason << "python3-renderdoc";
    const Json list = program_json({"import-capture", file.string(), "--list", "--json"});
    ASSERT_EQ(list.size(), 4u) << list;
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(list[i]["slice"], i);
        EXPECT_EQ(list[i]["format"], "D16");
        EXPECT_EQ(list[i]["light"], i < 3 ? "directional" : "spot or point") << i;
    }
    EXPECT_NEAR(list[3]["centre"][0].get<double>(), -12, 0.01);
    EXPECT_NEAR(list[3]["centre"][1].get<double>(), 1, 0.01);
    EXPECT_NEAR(list[3]["centre"][2].get<double>(), -7, 0.01);
}

TEST(ImportCaptureList, ShowsAMapThatAnEarlierFrameDrew) {
    const fs::path file = captures() / "vtk_baked_map.rdc";
    if (!fs::exists(file)) GTEST_SKIP() << test::kMissingReason << "../shared/captures";
    if (!has_module()) GTEST_SKIP() << test::kMissingReason << "python3-renderdoc";
    const fs::path folder = fresh_test_folder();
    const ProcessResult list = run_program({"import-capture", file.string(), "--list"});
    EXPECT_NE(list.out.find("texels, no caster pass"), std::string::npos) << list.out << list.err;
    const ProcessResult made = run_program({"import-capture", file.string(), "-o", "a.bundle"}, folder);
    EXPECT_EQ(made.code, 0) << made.err;
    const Json frame = Json::parse(file_bytes(folder / "a.bundle" / "frame.json"));
    EXPECT_EQ(frame["lights"].size(), 2u);
    EXPECT_FALSE(frame.contains("scene")) << "the map's own height field is shown";
}

/// Writes an executable script.
void write_script(const fs::path& path, const std::string& text) {
    std::ofstream(path) << "#!/bin/sh\n" << text << "\n";
    ::chmod(path.c_str(), 0755);
}

/// Runs the command on a file that begins as a capture, with another interpreter, and returns what it prints.
ProcessResult with_interpreter(const fs::path& folder, const std::string& script) {
    std::ofstream(folder / "a.rdc") << "RDOC and nothing else";
    write_script(folder / "python", script);
    return run_shell("SI_CAPTURE_PYTHON=\"$PWD/python\" \"$SI\" import-capture a.rdc -o a.bundle", folder);
}

TEST(ImportCaptureErrors, ACrashIsASentenceAndLeavesNothing) {
    const fs::path folder = fresh_test_folder();
    const ProcessResult crashed = with_interpreter(folder, "kill -SEGV $$");
    EXPECT_EQ(crashed.code, 1);
    EXPECT_NE(crashed.err.find("a.rdc: the capture helper crashed (Segmentation fault) while opening"),
              std::string::npos)
        << crashed.err;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2) << "the capture and the script";
    const ProcessResult silent = with_interpreter(folder, "echo no json; exit 0");
    EXPECT_EQ(silent.code, 1);
    EXPECT_NE(silent.err.find("ended without an answer"), std::string::npos) << silent.err;
    const ProcessResult absent =
        run_shell("SI_CAPTURE_PYTHON=/nowhere/python \"$SI\" import-capture a.rdc -o a.bundle", folder);
    EXPECT_NE(absent.err.find("python3-renderdoc"), std::string::npos) << absent.err;
    const ProcessResult module =
        with_interpreter(folder,
                         "echo '{\"error\": \"import-capture needs the Debian package python3-renderdoc; install it\", "
                         "\"place\": \"program\"}'; exit 1");
    EXPECT_EQ(module.code, 1);
    EXPECT_EQ(module.err, "shadow-inspector: import-capture needs the Debian package python3-renderdoc; install it\n");
}

TEST(ImportCaptureErrors, ASignalEndsTheWholeGroup) {
    const fs::path folder = fresh_test_folder();
    std::ofstream(folder / "a.rdc") << "RDOC and nothing else";
    write_script(folder / "python", "sleep 987 & echo $! > sleeper; echo $$ > helper; wait");
    const ProcessResult r = run_shell(
        "SI_CAPTURE_PYTHON=\"$PWD/python\" \"$SI\" import-capture a.rdc -o a.bundle & " +
            signal_once("[ -s helper ]", "TERM") +
            "sleep 0.2; for p in $(cat sleeper helper); do grep -q '^State:.[^Z]' /proc/$p/status 2>/dev/null && echo "
            "alive $p; done; ls",
        folder);
    EXPECT_NE(r.out.find("code 143"), std::string::npos) << r.out << r.err;
    EXPECT_EQ(r.out.find("alive"), std::string::npos) << r.out;
    EXPECT_EQ(r.out.find("bundle"), std::string::npos) << r.out;
}

TEST(ImportCaptureErrors, OtherFilesAreRefused) {
    const fs::path folder = fresh_test_folder();
    std::ofstream(folder / "text.rdc") << "no capture";
    std::ofstream(folder / "empty.rdc");
    std::ofstream(folder / "cut.rdc") << "RDOC" << std::string(200, '\1');
    fs::create_directory(folder / "folder.rdc");
    fs::create_directory(folder / "there.bundle");
    expect_error({"import-capture", "none.rdc", "-o", "a.bundle"}, 1, "none.rdc: cannot be opened", folder);
    expect_error({"import-capture", "text.rdc", "-o", "a.bundle"}, 1, "is no RenderDoc capture", folder);
    expect_error({"import-capture", "empty.rdc", "-o", "a.bundle"}, 1, "is no RenderDoc capture", folder);
    expect_error({"import-capture", "folder.rdc", "-o", "a.bundle"}, 1, "folder.rdc: is no regular file", folder);
    expect_error({"import-capture", "text.rdc"}, 2, "--output is required", folder);
    expect_error({"import-capture", "text.rdc", "-o", "a.zip"}, 2, "must end in .bundle", folder);
    expect_error({"import-capture", "text.rdc", "-o", "there.bundle"}, 1, "there.bundle: exists", folder);
    expect_error({"import-capture", "text.rdc", "-o", "gone/a.bundle"}, 1, "does not exist", folder);
    if (has_module()) {
        expect_error({"import-capture", "cut.rdc", "-o", "a.bundle"}, 1, "cut.rdc: is no whole RenderDoc capture",
                     folder);
    }
    EXPECT_FALSE(fs::exists(folder / "a.bundle"));
}

}  // namespace
}  // namespace si
