// Tests of drawn files: sizes, values, and equal bytes for equal settings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "renderer/settings/settings.h"
#include "tests/support/golden.h"
#include "tests/support/process.h"
#include "tests/support/text.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class Pictures : public testing::Test {
protected:
    std::string render(const Words& more, const std::string& file) {
        const ProcessResult r = run_program(Words{"render", "-o", file} + more, folder_);
        EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_EQ(r.out, "");
        return r.code == 0 ? file_bytes(folder_ / file) : "";
    }

    const fs::path folder_ = fresh_test_folder();
};

/// Returns width and height from the header of a PNG (PNG specification, 11.2.2 IHDR).
std::pair<unsigned, unsigned> png_size(const std::string& bytes) {
    if (bytes.size() < 24 || bytes.compare(0, 8, "\x89PNG\r\n\x1a\n") != 0) return {0, 0};
    const auto word = [&](std::size_t at) {
        unsigned v = 0;
        for (std::size_t i = 0; i < 4; ++i) v = v << 8 | static_cast<unsigned char>(bytes[at + i]);
        return v;
    };
    return {word(16), word(20)};
}

struct Floats {
    int width = 0, height = 0;
    std::vector<float> values;  // bottom row first
};

Floats read_pfm(const std::string& bytes) {
    std::istringstream in(bytes);
    std::string magic;
    double scale = 0;
    Floats f;
    in >> magic >> f.width >> f.height >> scale;
    in.get();
    EXPECT_EQ(magic, "Pf");
    EXPECT_EQ(scale, -1);
    f.values.resize(std::size_t(f.width) * std::size_t(f.height));
    const auto at = std::size_t(in.tellg());
    EXPECT_EQ(bytes.size() - at, f.values.size() * sizeof(float));
    std::memcpy(f.values.data(), bytes.data() + at, std::min(bytes.size() - at, f.values.size() * sizeof(float)));
    return f;
}

const Words kSmall = "boxes --size 96x64 --set map.resolution=256";

SI_TEST_IS(Slow, Pictures, EveryViewHasTheRequestedSize);
TEST_F(Pictures, EveryViewHasTheRequestedSize) {
    const Json views = program_json("list views");
    ASSERT_GE(views.size(), 10u);
    for (const Json& view : views) {
        const std::string key = view["key"];
        SCOPED_TRACE(key);
        const unsigned size = key == "shadow-map" ? 256 : 0;
        const auto expected = size ? std::pair(size, size) : std::pair(96u, 64u);
        EXPECT_EQ(png_size(render(kSmall + Words{"--view", key}, key + ".png")), expected);
        if (!view["scalar"]) continue;
        const Floats f = read_pfm(render(kSmall + Words{"--view", key}, key + ".pfm"));
        EXPECT_EQ(std::pair(unsigned(f.width), unsigned(f.height)), expected);
        const auto [lo, hi] = std::minmax_element(f.values.begin(), f.values.end(), [](float a, float b) {
            return (std::isnan(a) ? 0 : a) < (std::isnan(b) ? 0 : b);
        });
        if (key != "non-finite") {
            EXPECT_NE(*lo, *hi) << "one flat value";
        }
    }
}

TEST_F(Pictures, ViewsDiffer) {
    const std::string shaded = render(kSmall, "shaded.png");
    EXPECT_NE(shaded, render(kSmall + "--view visibility", "visibility.png"));
    EXPECT_NE(shaded, render(kSmall + "--view depth-difference", "difference.png"));
    EXPECT_NE(shaded, render(kSmall + "--set light.azimuth=100", "moved.png"));
    // Setting and view of one overlay give the same picture; requested by name the plain picture has no overlay.
    const Words overlay = kSmall + "--set view.overlay=n-dot-l";
    EXPECT_EQ(render(overlay, "a.png"), render(kSmall + "--view n-dot-l", "b.png"));
    EXPECT_EQ(render(overlay + "--view shaded", "c.png"), shaded);
}

TEST_F(Pictures, VisibilityLiesBetweenShadowAndLight) {
    const Floats f = read_pfm(render(kSmall + "--view visibility", "v.pfm"));
    EXPECT_TRUE(std::all_of(f.values.begin(), f.values.end(), [](float v) { return v >= 0 && v <= 1; }));
    const auto dark = std::count_if(f.values.begin(), f.values.end(), [](float v) { return v < 0.1f; });
    const auto lit = std::count_if(f.values.begin(), f.values.end(), [](float v) { return v > 0.9f; });
    EXPECT_GT(dark, 50);
    EXPECT_GT(lit, 500);
}

TEST_F(Pictures, LinearShadowMapIsInMetres) {
    const Words spot = kSmall + "--view shadow-map --set light.type=spot";
    const Floats raw = read_pfm(render(spot + "--set view.map=raw --report r.json", "raw.pfm"));
    const Floats metres = read_pfm(render(spot + "--set view.map=linear", "metres.pfm"));
    const Json range = Json::parse(file_bytes(folder_ / "r.json"))["fit"][0]["depth_range_m"];
    const double near = range[0], far = range[1];
    ASSERT_EQ(raw.values.size(), metres.values.size());
    std::size_t filled = 0;
    for (std::size_t i = 0; i < raw.values.size(); ++i) {
        ASSERT_TRUE(raw.values[i] >= 0 && raw.values[i] <= 1);
        const double expected = near * far / (far - raw.values[i] * (far - near));
        ASSERT_NEAR(metres.values[i], expected, 1e-3 * expected);
        filled += raw.values[i] < 1;
    }
    EXPECT_GT(filled, 100u);
}

TEST_F(Pictures, CameraDepthIsReversedOrInMetres) {
    const Words depth =
        kSmall + "--view camera-depth --set camera.source=manual --set camera.near=1 --set camera.far=8";
    const Floats raw = read_pfm(render(depth + "--set view.map=raw", "raw.pfm"));
    const Floats metres = read_pfm(render(depth + "--set view.map=linear", "metres.pfm"));
    std::size_t drawn = 0;
    for (std::size_t i = 0; i < raw.values.size(); ++i) {
        ASSERT_NEAR(metres.values[i], 8 / (1 + raw.values[i] * 7), 1e-4);
        drawn += raw.values[i] > 0;
    }
    EXPECT_GT(drawn, 1000u);
    EXPECT_LT(drawn, raw.values.size()) << "beyond 8 m nothing is drawn";
}

TEST_F(Pictures, ProbeNamesAPixelOfThePictureWithPanes) {
    const Words panes = "probe boxes --size 322x182 --set view.panes=four --set view.overlay=n-dot-l --pixel";
    const Json below = program_json(panes + "242,152");  // pixel 80,60 of the pane at 162,92
    const Json alone = program_json("probe boxes --size 160x90 --pixel 80,60");
    EXPECT_EQ(below["x"], 242);
    EXPECT_EQ(below["position_ws"], alone["position_ws"]);
    expect_error(panes + "160,20", 2, "between two panes");
}

SI_TEST_IS(Later, Pictures, ReportHoldsContentsAndReadShareOfTheMap);
TEST_F(Pictures, ReportHoldsContentsAndReadShareOfTheMap) {
    const auto report = [&](const Words& more) {
        render(kSmall + "--report r.json" + more, "a.png");
        return Json::parse(file_bytes(folder_ / "r.json"))["shadow_map"];
    };
    const Json wide = report({});
    const double share = wide["utilisation"];
    EXPECT_GT(share, 0.05);
    EXPECT_LT(share, 1);
    EXPECT_EQ(wide["resolution"], 256);
    EXPECT_EQ(wide["drawn_texels"].get<int>() + wide["empty_texels"].get<int>(), 256 * 256);
    EXPECT_LT(wide["stored_range"][0], wide["stored_range"][1]);
    for (const char* histogram : {"histogram_raw", "histogram_linear"}) {
        int sum = 0;
        for (const Json& count : wide[histogram]["counts"]) sum += count.get<int>();
        EXPECT_EQ(sum, wide["drawn_texels"]) << histogram;
    }
    // A wider kernel reads a larger share, a finer map is read less.
    EXPECT_GT(report("--set filter.kernel=pcf9")["utilisation"], share);
    EXPECT_LT(report("--set map.resolution=1024")["utilisation"], share);
    const Json point = report("--set light.type=point --set view.face=3");
    ASSERT_EQ(point["utilisation_of_faces"].size(), 6u);
    EXPECT_EQ(point["utilisation_of_faces"][3], point["utilisation"]);
    EXPECT_EQ(point["face"], 3);
    EXPECT_TRUE(report("--set light.cast=false").is_null());
}

SI_TEST_IS(Later, Pictures, SamePresetGivesTheSameBytes);
TEST_F(Pictures, SamePresetGivesTheSameBytes) {
    const ProcessResult saved = run_program(
        "preset save stage -o p.json --set filter.kernel=pcf5 --set bias.slope=2 --about" + Words{"wide kernel"},
        folder_);
    ASSERT_EQ(saved.code, 0) << saved.err;
    EXPECT_EQ(run_program("preset check p.json", folder_).code, 0);
    const Words small = "stage --size 96x64";
    const std::string preset = render(small + "--preset p.json", "a.png");
    EXPECT_EQ(preset, render(small + "--preset p.json", "b.png"));
    // Suggestions of the scene are part of the preset, so that later changes of the scene do not affect it.
    EXPECT_EQ(preset, render(small + "--set filter.kernel=pcf5 --set bias.slope=2", "c.png"));
    EXPECT_NE(preset, render(small, "d.png"));
    EXPECT_NE(preset, render(small + "--preset p.json --set light.azimuth=0", "e.png"));
}

TEST_F(Pictures, PresetIsNotMixedWithSuggestionsOfTheScene) {
    // The stage suggests another azimuth; set to the program's default the preset does not mention it.
    const Words azimuth = "--set light.azimuth=" + Json(Settings{}.lights[0].azimuth).dump();
    ASSERT_EQ(run_program("preset save stage -o p.json" + azimuth, folder_).code, 0);
    EXPECT_FALSE(Json::parse(file_bytes(folder_ / "p.json"))["settings"].contains("light.azimuth"));
    const Words small = "stage --size 96x64";
    const std::string picture = render(small + "--preset p.json", "a.png");
    EXPECT_EQ(picture, render(small + azimuth, "b.png"));
    EXPECT_NE(picture, render(small, "c.png"));
}

SI_TEST_IS(Later, Pictures, ExportedSceneIsTheSameScene);
TEST_F(Pictures, ExportedSceneIsTheSameScene) {
    ASSERT_EQ(run_program("export boxes -o boxes.glb", folder_).code, 0);
    render("boxes --size 32x32 --report a.json", "a.png");
    render("boxes.glb --size 32x32 --report b.json", "b.png");
    const Json a = Json::parse(file_bytes(folder_ / "a.json"))["scene"];
    const Json b = Json::parse(file_bytes(folder_ / "b.json"))["scene"];
    EXPECT_EQ(a["triangles"], b["triangles"]);
    for (const char* end : {"min", "max"}) {
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(a["bounds"][end][i].get<double>(), b["bounds"][end][i].get<double>(), 1e-5);
        }
    }
}

SI_TEST_IS(Later, Pictures, EditorIsDrawnWithoutADisplay);
TEST_F(Pictures, EditorIsDrawnWithoutADisplay) {
    // The top bar has its background colour in both themes.
    const auto ground = [&](const char* theme) {
        const ProcessResult drawn =
            run_program(Words("edit boxes --headless --screenshot t.png --size 640x360 --theme") + theme, folder_);
        EXPECT_EQ(drawn.code, 0) << drawn.err;
        EXPECT_EQ(png_size(file_bytes(folder_ / "t.png")), std::pair(640u, 360u));
        return int(test::read_golden(folder_ / "t.png").data[4 * (640 + 1)]);
    };
    EXPECT_LT(ground("dark"), 80);
    EXPECT_GT(ground("light"), 170);
}

SI_TEST_IS(Later, Pictures, WithoutACommandOrDisplayEverythingIsDrawn);
TEST_F(Pictures, WithoutACommandOrDisplayEverythingIsDrawn) {
    const ProcessResult r = run_program({}, folder_);
    ASSERT_EQ(r.code, 0) << r.err;
    for (const char* name : {"editor.png", "scene.png", "shadow-map.png", "visibility.png"})
        EXPECT_GT(png_size(file_bytes(folder_ / "out" / name)).first, 0u) << name;
    EXPECT_EQ(test::lacking(r.out, {"no display", "shadow map 0", "triangles", "the picture reads"}), "");
}

TEST_F(Pictures, EveryRepairIsReported) {
    expect_error("render boxes -o a.png --size 32x32 --set light.fit=manual --set light.near=50 --set light.far=2", 0,
                 "note: light.near 50 was above light.far 2", folder_);
}

}  // namespace
}  // namespace si
