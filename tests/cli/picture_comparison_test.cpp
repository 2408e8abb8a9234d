// Tests of picture comparison on the command line: with the reference, with presets, and overlays that need the
// reference.
#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/support/process.h"

namespace si {
namespace {

using Json = nlohmann::json;

struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
    const std::uint8_t* at(int x, int y) const { return &rgb[std::size_t(y * width + x) * 3]; }
};

const Words kDrawn =
    "boxes --size 160x90 --set filter.kernel=hard --set bias.kind=constant --set bias.constant=0 --set bias.normal=0";

class PictureComparison : public testing::Test {
protected:
    std::string draw(const std::string& file, const Words& more) {
        const Words arguments = "render" + kDrawn + "--set view.frustum=false -o" + Words{file} + more;
        const ProcessResult r = run_program(arguments, folder_);
        EXPECT_EQ(r.code, 0) << r.err;
        return r.out;
    }
    Picture picture(const std::string& file) {
        Picture p;
        int channels = 0;
        std::uint8_t* data = stbi_load((folder_ / file).c_str(), &p.width, &p.height, &channels, 3);
        EXPECT_TRUE(data) << file;
        if (data) p.rgb.assign(data, data + p.width * p.height * 3);
        stbi_image_free(data);
        return p;
    }
    static bool same(const Picture& a, int ax, const Picture& b, int bx, int columns) {
        for (int y = 0; y < b.height; ++y)
            if (std::memcmp(a.at(ax, y), b.at(bx, y), std::size_t(columns) * 3) != 0) return false;
        return true;
    }
    const std::filesystem::path folder_ = fresh_test_folder();
};

TEST_F(PictureComparison, ReferenceIsDrawnSideBySideSwipedAndAsADifference) {
    draw("plain.png", {});
    const std::string said = draw("beside.png", "--against truth --report r.json");
    EXPECT_TRUE(said.starts_with("mean |A - B| 0.")) << said;
    const Picture plain = picture("plain.png"), beside = picture("beside.png");
    ASSERT_EQ(beside.width, 2 * 160 + 2);
    ASSERT_EQ(beside.height, 90);
    EXPECT_TRUE(same(beside, 0, plain, 0, 160)) << "A is what is drawn without --against";
    draw("swiped.png", "--against truth --swipe 0.25");
    const Picture swipe_image = picture("swiped.png");
    ASSERT_EQ(swipe_image.width, 160);
    EXPECT_TRUE(same(swipe_image, 0, plain, 0, 39));
    EXPECT_TRUE(same(swipe_image, 41, beside, 162 + 41, 119));
    EXPECT_FALSE(same(beside, 162, plain, 0, 160)) << "without bias the map is far from true";

    draw("difference.png", "--against truth --difference");
    const Picture difference = picture("difference.png");
    double sum = 0;
    for (int y = 0; y < 90; ++y)
        for (int i = 0; i < 160 * 3; ++i) {
            const int d = std::abs(int(plain.at(0, y)[i]) - int(beside.at(162, y)[i]));
            EXPECT_EQ(int(difference.at(0, y)[i]), std::min(2 * d, 255));
            sum += d;
        }
    const Json report = Json::parse(file_bytes(folder_ / "r.json"));
    EXPECT_EQ(report["against"]["what"], "truth");
    EXPECT_NEAR(report["against"]["mean_difference"], sum / (255.0 * 160 * 90 * 3), 1e-9);
}

TEST_F(PictureComparison, PresetIsDrawnUnderTheSameCamera) {
    const ProcessResult saved = run_program(
        "preset save boxes -o p.json --set light.azimuth=100 --set camera.source=manual --set camera.distance=3",
        folder_);
    ASSERT_EQ(saved.code, 0) << saved.err;
    draw("plain.png", {});
    draw("against.png", "--against p.json");
    const ProcessResult own = run_program(
        "render boxes -o own.png --size 160x90 --preset p.json --set camera.source=auto --set view.frustum=false",
        folder_);
    ASSERT_EQ(own.code, 0) << own.err;
    const Picture both = picture("against.png");
    EXPECT_TRUE(same(both, 0, picture("plain.png"), 0, 160));
    EXPECT_TRUE(same(both, 162, picture("own.png"), 0, 160)) << "its light and bias, our camera";
}

TEST_F(PictureComparison, BothPicturesAreDrawnWithoutOverlaysAndSlabs) {
    draw("plain.png", "--view shaded");
    draw("against.png", "--against truth --set view.overlay=n-dot-l --set view.slabs=stored");
    EXPECT_TRUE(same(picture("against.png"), 0, picture("plain.png"), 0, 160));
}

TEST_F(PictureComparison, PresetHidesItsObjectsAndFollowsTheScale) {
    const Words kSaved[] = {"--set object.Boxes/Floor.shown=false", "--set light.type=spot --set light.distance=9"};
    const Words kShown[] = {Words{}, Words("--set scene.scale=10")};
    for (int i = 0; i < 2; ++i) {
        const ProcessResult saved = run_program("preset save boxes -o p.json" + kSaved[i], folder_);
        ASSERT_EQ(saved.code, 0) << saved.err;
        const ProcessResult both =
            run_program("render boxes --size 160x90 --against p.json -o both.png" + kShown[i], folder_);
        ASSERT_EQ(both.code, 0) << both.err;
        EXPECT_FALSE(both.out.starts_with("mean |A - B| 0.000000")) << both.out;
        const ProcessResult own =
            run_program("render boxes --size 160x90 --preset p.json -o own.png" + kShown[i], folder_);
        ASSERT_EQ(own.code, 0) << own.err;
        EXPECT_TRUE(same(picture("both.png"), 162, picture("own.png"), 0, 160)) << testing::PrintToString(kSaved[i]);
    }
}

TEST_F(PictureComparison, OverlaysOfTheReferenceTraceIt) {
    draw("artefacts.png", "--set view.overlay=artefacts");
    const Picture p = picture("artefacts.png");
    int acne = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            const std::uint8_t* c = p.at(x, y);
            acne += std::abs(c[0] - 213) < 2 && std::abs(c[1] - 94) < 2 && c[2] < 2;
        }
    const Json error = program_json("measure --no-time" + kDrawn)["error"];
    EXPECT_GT(acne, 500);
    EXPECT_EQ(acne, error["artefacts"]["acne"].get<int>());

    draw("d.pfm", "--view truth-difference");
    const std::string bytes = file_bytes(folder_ / "d.pfm");
    const std::size_t head = std::string("Pf\n160 90\n-1.0\n").size();
    ASSERT_EQ(bytes.size(), head + 160 * 90 * 4);
    double sum = 0;
    int counted = 0;
    for (std::size_t i = 0; i < 160 * 90; ++i) {
        float v;
        std::memcpy(&v, &bytes[head + 4 * i], 4);
        if (std::isfinite(v)) {
            sum += v;
            ++counted;
        }
    }
    EXPECT_EQ(counted, error["pixels"]["counted"].get<int>());
    EXPECT_NEAR(sum / counted, error["signed_mean"], 1e-6);
}

}  // namespace
}  // namespace si
