// Tests several overlays at once: each pane equals a picture of its overlay alone.
#include <stb/stb_image.h>

#include <algorithm>
#include <cmath>

#include "app/report/views.h"
#include "renderer/frame/value_range.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/process.h"

namespace si {
namespace {

class PanesTest : public FrameTest {
protected:
    FrameResult frame(const Scene& scene, const Sets& extra) {
        FrameRequest request = small_request({.overlay = true});
        return renderer.render(scene, settings_for(scene, extra), request);
    }
};

TEST_F(PanesTest, EachPaneIsThePictureOfItsOverlay) {
    const Scene scene = load_scene("stage");
    const char* const overlays_shown[] = {"visibility", "none", "light-uv", "depth-difference"};
    const FrameResult f = frame(scene, {"view.panes=four",
                                        {"view.overlay", overlays_shown[0]},
                                        {"view.overlay_2", overlays_shown[1]},
                                        {"view.overlay_3", overlays_shown[2]},
                                        {"view.overlay_4", overlays_shown[3]}});
    ASSERT_EQ(f.panes.size(), 4u);
    std::vector<ByteImage> pictures;
    std::vector<FloatImage> values(4);
    for (std::size_t i = 0; i < 4; ++i) {
        pictures.push_back(renderer.read_colour(f.panes[i].picture));
        if (f.panes[i].values.texture) values[i] = renderer.read_float(f.panes[i].values, 4);
    }
    EXPECT_EQ(f.panes[0].picture.texture, f.colour.texture);
    EXPECT_EQ(f.panes[0].values.texture, f.overlay.texture);
    EXPECT_EQ(f.panes[1].values.texture, 0u);
    for (std::size_t i = 0; i < 4; ++i) {
        // The visibility overlay needs visibility as a separate pass, for all panes.
        const FrameResult alone =
            frame(scene, {{"view.overlay", overlays_shown[i]}, "shading.separate_visibility=true"});
        ASSERT_EQ(alone.panes.size(), 1u);
        EXPECT_EQ(f.panes[i].overlay, alone.panes[0].overlay);
        EXPECT_EQ(pictures[i], renderer.read_colour(alone.colour)) << overlays_shown[i];
        EXPECT_EQ(f.panes[i].overlay_min, alone.overlay_min);
        EXPECT_EQ(f.panes[i].overlay_max, alone.overlay_max);
        if (!alone.overlay.texture) continue;
        const FloatImage expected = renderer.read_float(alone.overlay, 4);
        for (std::size_t k = 0; k < expected.data.size(); ++k)
            ASSERT_TRUE(values[i].data[k] == expected.data[k] ||
                        (std::isnan(values[i].data[k]) && std::isnan(expected.data[k])))
                << overlays_shown[i];
    }
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_GT(different_pixels(pictures[i], pictures[k]), 100u) << i << " " << k;
}

TEST_F(PanesTest, PanesOfOneOverlayShareItsImages) {
    const Scene scene = load_scene("boxes");
    const FrameResult f = frame(scene, {"view.panes=two", "view.overlay=n-dot-l", "view.overlay_2=n-dot-l"});
    ASSERT_EQ(f.panes.size(), 2u);
    EXPECT_EQ(f.panes[0].picture.texture, f.panes[1].picture.texture);
    EXPECT_EQ(std::count_if(f.passes.begin(), f.passes.end(),
                            [](const PassInfo& p) {
                                return p.name.starts_with("overlay values") && p.state == PassState::Drawn;
                            }),
              1);
}

TEST_F(PanesTest, ManualRangesHoldForTheFirstPanesOverlayOnly) {
    const Scene scene = load_scene("boxes");
    const FrameResult f = frame(
        scene, {"view.panes=four", "view.overlay=own-depth", "view.overlay_2=bias-applied", "view.overlay_3=own-depth",
                "view.overlay_range=manual", "view.overlay_min=0.25", "view.overlay_max=0.75"});
    const auto range = [&](std::size_t i) { return std::pair(f.panes[i].overlay_min, f.panes[i].overlay_max); };
    EXPECT_EQ(range(0), std::pair(0.25f, 0.75f));
    EXPECT_EQ(range(1), std::pair(0.0f, 5.0f));
    EXPECT_EQ(range(2), std::pair(0.25f, 0.75f));
}

TEST_F(PanesTest, FittedRangesFollowThePicture) {
    const Scene scene = load_scene("boxes");
    Sets settings = {"view.overlay=own-depth", "view.overlay_range=fitted"};
    const FrameResult f = frame(scene, settings);
    const auto expected = fitted_range(renderer.read_float(f.overlay, 4), false);
    ASSERT_TRUE(expected);
    EXPECT_EQ(f.overlay_min, expected->min);
    EXPECT_EQ(f.overlay_max, expected->max);
    EXPECT_GT(f.overlay_min, 0.01f) << "the boxes do not fill the whole range of depth";
    // The picture equals one with these numbers as manual settings.
    const ByteImage fitted = renderer.read_colour(f.colour);
    Settings manual = settings_for(scene, {"view.overlay=own-depth", "view.overlay_range=manual"});
    manual.view.overlay_min = expected->min;
    manual.view.overlay_max = expected->max;
    EXPECT_EQ(fitted, picture(scene, manual));
    // The picture changes once the values change.
    settings.push_back("light.elevation=80");
    EXPECT_NE(frame(scene, settings).overlay_min, f.overlay_min);
    // The range is symmetric where zero is the middle of the scale.
    settings[0].second = "depth-difference";
    const FrameResult difference = frame(scene, settings);
    EXPECT_EQ(difference.overlay_min, -difference.overlay_max);
    EXPECT_GT(difference.overlay_max, 0);
}

TEST_F(PanesTest, AFileHoldsAllPanesSideBySide) {
    const Scene scene = load_scene("boxes");
    const auto folder = fresh_test_folder();
    for (const char* panes : {"one", "two", "four"}) {
        const Settings s = settings_for(scene, {{"view.panes", panes},
                                                "view.overlay=n-dot-l",
                                                "view.overlay_2=light-uv",
                                                "view.overlay_4=normals",
                                                "view.slabs=stored"});
        const std::string path = (folder / (std::string(panes) + ".png")).string();
        const FrameRequest request{.width = 323, .height = 181};
        write_view(renderer, scene, s, request, find_view("shaded"), path);
        int width = 0, height = 0;
        const std::unique_ptr<stbi_uc, void (*)(void*)> whole(stbi_load(path.c_str(), &width, &height, nullptr, 4),
                                                              stbi_image_free);
        ASSERT_TRUE(whole) << path;
        ASSERT_EQ(glm::ivec2(width, height), glm::ivec2(323, 181)) << "the requested size is that of the whole picture";
        const PaneGrid grid = picture_grid(s, width, height);
        const FrameResult f = renderer.render(scene, s, {.width = grid.width, .height = grid.height});
        EXPECT_DOUBLE_EQ(f.camera.aspect, double(grid.width) / grid.height);
        ASSERT_EQ(int(f.panes.size()), grid.count());
        for (int i = 0; i < grid.count(); ++i) {
            const ByteImage pane = renderer.read_colour(f.panes[std::size_t(i)].picture);
            const glm::ivec2 corner = grid.corner(i);
            for (int y = 0; y < pane.height; ++y)
                for (int x = 0; x < pane.width; ++x)
                    for (int c = 0; c < 3; ++c)
                        ASSERT_EQ(whole.get()[((corner.y + y) * width + corner.x + x) * 4 + c],
                                  pane.data[std::size_t((y * pane.width + x) * 4 + c)])
                            << panes << " pane " << i << " at " << x << "," << y;
        }
    }
}

}  // namespace
}  // namespace si
