// Tests of scripted motions: each frame differs from the previous one, and nothing else moves.
#include "renderer/measure/frame_costs.h"

#include <gtest/gtest.h>

#include "renderer/base/error.h"
#include "renderer/scenes/builtin.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/light_fit.h"

namespace si {
namespace {

std::vector<Settings> motion(const Scene& scene, const Settings& s, CostCase cost) {
    return scripted_frames(scene, s, 16.0 / 9.0, cost);
}

TEST(FrameCosts, ForcedFramesChangeNothing) {
    const Scene scene = load_scene("boxes");
    EXPECT_EQ(motion(scene, Settings{}, CostCase::Forced), std::vector<Settings>{Settings{}});
}

TEST(FrameCosts, CameraFramesMoveOnlyTheCamera) {
    const Scene scene = load_scene("boxes");
    for (const CameraSource source : {CameraSource::Automatic, CameraSource::Manual, CameraSource::Light}) {
        Settings s;
        s.camera.source = source;
        s.camera.azimuth = 359.9;
        const std::vector<Settings> frames = motion(scene, s, CostCase::Camera);
        ASSERT_GT(frames.size(), 1u);
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const Settings& next = frames[(i + 1) % frames.size()];
            EXPECT_NE(make_camera(scene, frames[i], 1.5).eye, make_camera(scene, next, 1.5).eye);
            Settings other = next;
            other.camera = s.camera;
            EXPECT_EQ(other, s);
            const Camera a = make_camera(scene, frames[i], 1.5), b = make_camera(scene, next, 1.5);
            EXPECT_NEAR(glm::dot(a.axes[2], b.axes[2]), 1, 1e-4) << "by half a degree";
            EXPECT_GE(frames[i].camera.azimuth, -360);
            EXPECT_LE(frames[i].camera.azimuth, 360);
        }
    }
}

TEST(FrameCosts, LightFramesMoveTheLightInEveryFrame) {
    const Scene scene = load_scene("boxes");
    for (const double elevation : {90.0, 45.0, 0.0, -30.0, -90.0})
        for (const LightType type : {LightType::Directional, LightType::Spot}) {
            Settings s;
            s.light_count = 2;
            s.view.light = 1;
            s.lights[1].type = type;
            s.lights[1].elevation = elevation;
            const std::vector<Settings> frames = motion(scene, s, CostCase::Light);
            ASSERT_GT(frames.size(), 1u);
            for (std::size_t i = 0; i < frames.size(); ++i) {
                const auto at = [&](std::size_t k) {
                    const PlacedLight light = place_lights(scene, frames[k % frames.size()]).lights[1];
                    return std::pair(light.to_light, light.position);
                };
                EXPECT_NE(at(i), at(i + 1)) << elevation;
                EXPECT_LE(std::abs(frames[i].lights[1].elevation), 90);
                EXPECT_EQ(frames[i].lights[0], s.lights[0]);
                EXPECT_EQ(frames[i].camera, s.camera);
            }
        }
}

TEST(FrameCosts, CameraInTheLightViewStays) {
    const Scene scene = load_scene("boxes");
    Settings s;
    s.camera.source = CameraSource::Light;
    const std::vector<Settings> frames = motion(scene, s, CostCase::Light);
    for (const Settings& f : frames) EXPECT_EQ(make_camera(scene, f, 1.5).eye, make_camera(scene, frames[0], 1.5).eye);
}

TEST(FrameCosts, AreNamedByKey) {
    for (std::size_t i = 0; i < cost_cases().size(); ++i) EXPECT_EQ(parse_cost(cost_cases()[i].key), CostCase(i));
    EXPECT_THROW(parse_cost("soon"), Error);
    EXPECT_EQ(kDefaultCost, CostCase::Camera);
}

}  // namespace
}  // namespace si
