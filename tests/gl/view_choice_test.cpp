// Compares the view in which the GPU looks a point up with the choice in C++, in double.
#include <algorithm>

#include "renderer/reference/reference_task.h"
#include "renderer/render/reference_frames.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class ViewChoiceTest : public FrameTest {
protected:
    /// Compares both choices at every pixel that reads the map. @return pixels by view
    std::vector<std::size_t> compare(const Scene& scene, const Settings& s) {
        FrameRequest request = small_request({.colour = false, .shadow_map = true, .map_coordinates = true});
        const FrameResult frame = renderer.render(scene, s, request);
        const FloatImage at = renderer.read_float(frame.map_coordinates, 4);
        const ReferenceTask task = reference_task(renderer, scene, s, request, 0);
        const Receivers receivers = reconstruct_receivers(*task.geometry, task.camera, task.ids, task.raster, {});
        const FittedLight& light = frame.lights[0];
        std::vector<std::size_t> pixels(light.views.size());
        for (int y = 0; y < at.height; ++y)
            for (int x = 0; x < at.width; ++x) {
                const Receiver& r = receivers.at(x, y);
                if (!r.hit() || at.at(x, y, 3) == 0) continue;
                const auto view = std::size_t(at.at(x, y, 2));
                ++pixels.at(view);
                // Single precision may differ on the border between two views.
                const double eps = 1e-5 * (frame.camera.focus + glm::distance(r.position_ws, light.position));
                bool same = false;
                for (int i = 0; i < 9 && !same; ++i) {
                    const glm::dvec3 aside = i == 8 ? glm::dvec3(0) : glm::dvec3(i & 1, i >> 1 & 1, i >> 2) - 0.5;
                    same = light.chooser.choose(light.views, r.position_ws + eps * aside).view == view;
                }
                EXPECT_TRUE(same) << x << "," << y << ": view " << view;
            }
        return pixels;
    }
};

SI_TESTS_ARE(Repeated, ViewChoiceTest);
TEST_F(ViewChoiceTest, ShaderAndCpuChooseTheSameFace) {
    Scene scene = load_scene("boxes");
    for (const char* elevation : {"90", "30"})
        for (const Sets& kind : {Sets{"light.type=point"}, {"light.type=spot", "light.cone=250"}}) {
            Settings s = settings_for(scene, kind);
            set_setting(s, "light.elevation", elevation);
            set_setting(s, "light.distance", "4");
            const auto pixels = compare(scene, s);
            ASSERT_EQ(pixels.size(), 6u);
            EXPECT_GE(std::count_if(pixels.begin(), pixels.end(), [](std::size_t n) { return n > 100; }), 3);
        }
}

SI_TEST_IS(Later, ViewChoiceTest, ShaderAndCpuChooseTheSameCascade);
TEST_F(ViewChoiceTest, ShaderAndCpuChooseTheSameCascade) {
    const Scene scene = load_scene("stage");
    for (const char* choice : {"interval", "map"})
        for (const char* blend : {"0", "0.4"})
            for (const Sets& camera : {Sets{},
                                       {"camera.source=manual", "camera.distance=3"},
                                       {"camera.source=manual", "camera.orthographic=true"}}) {
                Settings s = settings_for(
                    scene, {"light.cascades=3", {"light.cascade_choice", choice}, {"light.cascade_blend", blend}});
                set_all(s, camera);
                const auto pixels = compare(scene, s);
                ASSERT_EQ(pixels.size(), 3u);
                EXPECT_GE(std::count_if(pixels.begin(), pixels.end(), [](std::size_t n) { return n > 100; }), 2);
            }
}

SI_TEST_IS(Later, ViewChoiceTest, ShaderAndCpuChooseTheSameClipLevel);
TEST_F(ViewChoiceTest, ShaderAndCpuChooseTheSameClipLevel) {
    const Scene scene = load_scene("stage");
    for (const Sets& camera : {Sets{"light.elevation=90"},
                               {"camera.source=manual", "camera.distance=3"},
                               {"camera.source=manual", "camera.orthographic=true"}}) {
        Settings s = settings_for(scene, {"map.virtual=true", "map.resolution=512"});
        set_all(s, camera);
        const auto pixels = compare(scene, s);
        ASSERT_EQ(pixels.size(), 8u);
        EXPECT_GE(std::count_if(pixels.begin(), pixels.end(), [](std::size_t n) { return n > 100; }), 2);
    }
}

TEST_F(ViewChoiceTest, OneViewIsAlwaysTheFirst) {
    const Scene scene = load_scene("boxes");
    EXPECT_GT(compare(scene, settings_for(scene))[0], 1000u);
}

}  // namespace
}  // namespace si
