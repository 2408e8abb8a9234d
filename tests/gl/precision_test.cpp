// Compares precision errors of the shaders with a second computation in double and with the expected rounding.
#include "renderer/reference/precision.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/session/session.h"
#include "renderer/measure/pipelines.h"
#include "renderer/measure/shimmer.h"
#include "renderer/scene/placement.h"
#include "renderer/settings/overlays.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"

namespace si::test {
namespace {

constexpr int kWidth = 96, kHeight = 64;

/// Returns hard_settings() for the scene, with scene and camera moved away.
Settings settings_at(Scene& scene, double distance, LightType type = LightType::Directional) {
    Settings s = hard_settings();
    s.lights[0].type = type;
    SceneSettings away = s.scene;
    away.distance = distance;
    pose_scene(scene, away);
    carry_settings(s, s.scene, away);
    s.scene = away;
    return s;
}

// The test recomputes each pixel from its ray's hit to the map, without the product's code.
TEST(PrecisionTest, EqualsASecondComputation) {
    for (const LightType type : kLightTypes)
        for (const double distance : {0.0, 1e5}) {
            Scene scene = floor_and_box();
            Settings s = settings_at(scene, distance, type);
            s.map.origin = MapOrigin::World;
            s.bias.normal = 0;
            const FrameResult frame = hard_renderer().render(
                scene, s,
                {.width = kWidth, .height = kHeight, .outputs = {.map_coordinates = true, .precision = true}});
            ASSERT_TRUE(frame.precision);
            const FloatImage coordinates = hard_renderer().read_float(frame.map_coordinates, 4);
            const RayReference rays(scene);
            int compared = 0;
            for (const auto& [x, y, hit] : pixel_hits(rays, frame.camera, kWidth, kHeight, 5, 2)) {
                const float told = frame.precision->error.at(x, y, 0);
                if (std::isnan(told) || coordinates.at(x, y, 3) == 0) continue;
                const LightView& view = frame.lights[0].views[std::size_t(coordinates.at(x, y, 2))];
                const glm::dvec2 looked_up(coordinates.at(x, y, 0), coordinates.at(x, y, 1));
                const double texels =
                    glm::distance(glm::dvec2(uvdw(view, hit.position)), looked_up) * frame.map_resolution;
                // At a triangle's edge a pixel's ray may miss the triangle whose rounded corners cover the pixel.
                if (texels > 50 && told < 50) continue;
                EXPECT_NEAR(told, texels, 2e-3 * texels + 2e-4) << int(type) << " " << x << "," << y;
                ++compared;
            }
            EXPECT_GT(compared, 20) << int(type);
        }
}

// Relative to a near point, errors are small everywhere. Relative to the world origin, they equal the rounding of a
// position to 24 bits, in texels.
TEST(PrecisionTest, RelativeToTheWorldOriginEqualsTheRoundingError) {
    for (const double distance : {0.0, 1e3, 1e5, 1e7}) {
        Scene scene = floor_and_box();
        const Settings s = settings_at(scene, distance);
        const std::vector<PipelineError> ways = compare_pipelines(hard_renderer(), scene, s, kWidth, kHeight);
        ASSERT_EQ(ways.size(), 4u);
        for (const PipelineError& e : ways) {
            EXPECT_GT(e.pixels, 250u);
            if (e.origin == MapOrigin::Near) {
                EXPECT_LT(e.texels.median, 0.01) << distance;
                EXPECT_LT(e.texels.p99, 0.1) << distance;
                EXPECT_EQ(e.flips, 0u) << distance;
                continue;
            }
            const FittedLight light = fit_lights(scene, s)[0];
            const double texel = light.views[0].texel_size(1, s.map.resolution);
            const double rounding = std::exp2(std::floor(std::log2(std::max(distance, 1e-3))) - 24) / texel;
            if (distance < 1e3) continue;
            EXPECT_GT(e.texels.median, 0.1 * rounding) << distance;
            EXPECT_LT(e.texels.median, 10 * rounding) << distance;
            if (distance >= 1e7) {
                EXPECT_GT(e.flips, 50u);
            }
        }
    }
}

// Scales by powers of ten add rounding only.
TEST(PrecisionTest, IsTheSameAtEveryScale) {
    for (const double scale : {1e-3, 1.0, 1e6}) {
        Scene scene = floor_and_box();
        Settings s = hard_settings();
        SceneSettings sized = s.scene;
        sized.scale = scale;
        pose_scene(scene, sized);
        carry_settings(s, s.scene, sized);
        s.scene = sized;
        const PipelineError e = compare_pipelines(hard_renderer(), scene, s, kWidth, kHeight)[0];
        EXPECT_LT(e.texels.median, 0.002) << scale;
        EXPECT_LT(e.ulps.median, 4) << scale;
    }
}

TEST(PrecisionTest, OverlaysShowTheNumbers) {
    Scene scene = floor_and_box();
    Settings s = settings_at(scene, 1e4);
    s.map.origin = MapOrigin::World;
    for (const auto& [key, channel] : {std::pair{"precision-texels", 0}, {"precision-ulps", 1}}) {
        const auto row = std::find_if(overlays().begin(), overlays().end(),
                                      [wanted = std::string_view(key)](const Overlay& o) { return o.key == wanted; });
        s.view.overlay = int(row - overlays().begin()) + 1;
        const FrameResult frame = hard_renderer().render(
            scene, s,
            {.width = kWidth, .height = kHeight, .outputs = {.colour = false, .overlay = true, .precision = true}});
        ASSERT_TRUE(frame.precision);
        const FloatImage values = hard_renderer().read_float(frame.overlay, 1);
        int shown = 0;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const float told = frame.precision->error.at(x, y, channel);
                if (std::isnan(told)) continue;
                ASSERT_EQ(values.at(x, y), told) << key;
                ++shown;
            }
        EXPECT_GT(shown, 250) << key;
    }
}

// The numbers are computed only on request, and once.
TEST(PrecisionTest, IsComputedOnlyWhenEnabled) {
    Scene scene = floor_and_box();
    const Settings s = hard_settings();
    FrameRequest request{.width = kWidth, .height = kHeight};
    const char* const name = "single-precision errors";
    Renderer& renderer = hard_renderer();
    EXPECT_EQ(renderer.render(scene, s, request).pass(name)->state, PassState::Skipped);
    request.outputs.precision = true;
    EXPECT_EQ(renderer.render(scene, s, request).pass(name)->state, PassState::Drawn);
    EXPECT_EQ(renderer.render(scene, s, request).pass(name)->state, PassState::Cached);
}

/// Returns cascades over the visible part of a wide floor with a box.
Settings shimmer_settings(bool snap) {
    Settings s = hard_settings();
    s.lights[0].fit = LightFit::Stabilised;
    s.lights[0].snap = snap;
    set_all(s, {"light.cascades=2", "camera.distance=6", "map.resolution=128"});
    return s;
}

TEST(ShimmerTest, CountsShimmeringPixelsOnlyWithoutTexelSnapping) {
    const Scene scene = floor_and_box(60);
    const ShimmerOptions options{.steps = 6, .step_texels = 0.3};
    const Shimmer snapped = measure_shimmer(hard_renderer(), scene, shimmer_settings(true), kWidth, kHeight, options);
    const Shimmer free = measure_shimmer(hard_renderer(), scene, shimmer_settings(false), kWidth, kHeight, options);
    EXPECT_EQ(snapped.max_flips, 0u);
    EXPECT_EQ(snapped.flipping_pixels, 0u);
    EXPECT_GT(free.flips_a_step, 1);
    EXPECT_GT(free.change, 0);
    ASSERT_EQ(free.flips.size(), 6u);
    double sum = 0;
    for (const float flips : free.flips_of.data) sum += flips;
    std::size_t told = 0;
    for (const std::size_t flips : free.flips) told += flips;
    EXPECT_EQ(sum, double(told));
    EXPECT_NEAR(free.flips_a_step, double(told) / 6, 1e-9);
    EXPECT_GT(free.places, free.flipping_pixels);
}

TEST(ShimmerTest, IsZeroForFixedMapsAndPositiveForTurningLights) {
    const Scene scene = floor_and_box();
    const Settings s = hard_settings();
    Renderer& renderer = hard_renderer();
    for (const ShimmerMotion still : {ShimmerMotion::CameraMoves, ShimmerMotion::CameraTurns})
        EXPECT_EQ(measure_shimmer(renderer, scene, s, kWidth, kHeight, {.motion = still, .steps = 3}).change, 0);
    const Shimmer turned = measure_shimmer(renderer, scene, s, kWidth, kHeight,
                                           {.motion = ShimmerMotion::LightTurns, .steps = 3, .step_texels = 2});
    EXPECT_GT(turned.change, 0);
    Settings dark = s;
    dark.lights[0].cast = false;
    EXPECT_THROW(measure_shimmer(renderer, scene, dark, kWidth, kHeight, {}), Error);
}

TEST(StretchTest, MultipliesTheDepthRange) {
    const Scene scene = floor_and_box();
    for (const LightType type : kLightTypes) {
        Settings s = hard_settings();
        s.lights[0].type = type;
        const DepthCurve before = fit_lights(scene, s)[0].views[0].curve;
        s.lights[0].stretch = 100;
        const DepthCurve after = fit_lights(scene, s)[0].views[0].curve;
        if (type == LightType::Directional) {
            EXPECT_NEAR(after.far - after.near, 100 * (before.far - before.near), 1e-6);
            EXPECT_NEAR(after.far + after.near, before.far + before.near, 1e-6);
        } else {
            EXPECT_NEAR(after.near, before.near / 100, 1e-9);
            EXPECT_NEAR(after.far, before.far * 100, 1e-6);
        }
    }
}

}  // namespace
}  // namespace si::test
