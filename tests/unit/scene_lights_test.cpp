// Tests of a file's lights as settings: positions, directions, cones and colours are preserved by the fit.
#include "renderer/scene/scene_lights.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "app/session/session.h"
#include "renderer/gltf/gltf.h"
#include "renderer/settings/param.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/box_scene.h"

namespace si {
namespace {

Scene lit_scene(const std::vector<SceneLight>& lights) {
    Scene scene = test::box_scene({{glm::dvec3(-3, 0, -1), glm::dvec3(7, 4, 5)}}, {1000, -20, 3});
    scene.lights = lights;
    suggest_lights(scene);
    return scene;
}

SceneLight light_of(LightType type, const glm::dvec3& position, const glm::dvec3& towards) {
    SceneLight light;
    light.type = type;
    const glm::dvec3 up = std::abs(glm::normalize(towards).y) > 0.99 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    // Nodes may be scaled: only position and direction count.
    light.world =
        glm::inverse(glm::lookAt(position, position + towards, up)) * glm::scale(glm::dmat4(1), glm::dvec3(3));
    return light;
}

void expect_light_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    EXPECT_LE(glm::distance(a, b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " / " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(SceneLights, PositionsAndDirectionsRoundTrip) {
    const glm::dvec3 centre = lit_scene({}).bounds.centre();
    const glm::dvec3 places[] = {
        {1001, -15, 6}, centre, centre + glm::dvec3(0, 1e-9, 0), {-5e4, 3e3, 1}, {1002, 9e5, 3}};
    const glm::dvec3 directions[] = {{0, -1, 0}, {0, 1, 0}, {1, -2, 3}, {-1, 0, 0}, {1e-9, -1, 1e-9}, {0.3, 0.1, -2}};
    for (const LightType type : {LightType::Directional, LightType::Spot, LightType::Point})
        for (const glm::dvec3& place : places)
            for (const glm::dvec3& direction : directions) {
                const Scene scene = lit_scene({light_of(type, place, direction)});
                const Settings s = base_settings(scene);
                ASSERT_EQ(s.light_count, 1);
                const FittedLight fitted = fit_lights(scene, s).at(0);
                EXPECT_EQ(fitted.type, type);
                if (type != LightType::Directional)
                    expect_light_near(fitted.position, place, 1e-9 + 1e-14 * glm::length(place));
                if (type != LightType::Point)
                    expect_light_near(fitted.to_light, glm::normalize(glm::dvec3(scene.lights[0].world[2])), 1e-14);
            }
}

TEST(SceneLights, ConesColoursAndBrightnessRatiosRoundTrip) {
    SceneLight spot = light_of(LightType::Spot, {1000, 0, 0}, {0, -1, 0});
    spot.outer_cone_rad = 0.5;
    spot.inner_cone_rad = 0.2;
    spot.colour = {4, 2, 0};
    spot.intensity = 10;
    SceneLight weak = light_of(LightType::Point, {1000, 0, 0}, {0, -1, 0});
    weak.intensity = 4;
    SceneLight sun = light_of(LightType::Directional, {0, 0, 0}, {0, -1, 0.1});
    sun.intensity = 100000;
    const Scene scene = lit_scene({spot, weak, sun});
    const Settings s = base_settings(scene);
    ASSERT_EQ(s.light_count, 3);
    const auto fitted = fit_lights(scene, s);
    EXPECT_NEAR(fitted[0].cos_cone_outer, std::cos(0.5), 1e-12);
    EXPECT_NEAR(fitted[0].cos_cone_inner, std::cos(0.2), 1e-12);
    expect_light_near(fitted[0].radiance / fitted[1].radiance.x, glm::dvec3(10, 5, 0), 1e-9);
    EXPECT_EQ(s.lights[2].intensity, 1);
}

TEST(SceneLights, RangesRoundTripThroughAFile) {
    SceneLight ranged = light_of(LightType::Spot, {1000, 0, 0}, {0, -1, 0});
    ranged.range = 12.5;
    SceneLight endless = light_of(LightType::Point, {1000, 0, 0}, {0, -1, 0});
    SceneLight vast = endless;
    vast.range = 1e30;
    SceneLight sun = light_of(LightType::Directional, {0, 0, 0}, {0, -1, 0.1});
    sun.range = 3;  // ignored for this type
    const Scene scene = lit_scene({ranged, endless, vast, sun});
    const auto file = std::filesystem::path(SI_TEST_OUTPUT_DIR) / "ranges.glb";
    save_gltf(scene, file);
    for (const Scene& lit : {scene, load_gltf(file)}) {
        const Settings s = base_settings(lit);
        const std::vector<FittedLight> fitted = fit_lights(lit, s);
        ASSERT_EQ(fitted.size(), 4u);
        EXPECT_EQ(fitted[0].range_m, 12.5);
        for (int i = 1; i < 4; ++i) EXPECT_EQ(fitted[std::size_t(i)].range_m, 0) << i;
    }
}

TEST(SceneLights, KeepAnyName) {
    std::vector<SceneLight> lights(5, light_of(LightType::Point, {1, 2, 3}, {0, -1, 0}));
    lights[1].name = "Küchenlampe";
    lights[2].name = std::string(10'000, 'n');
    lights[3].name = "\x1b[2J\n\xff\u202e";
    for (int i = 0; i < 43; ++i) lights[4].name += 'n';
    lights[4].name += "\U0001f4a1\u202e\u202e";
    Settings s = base_settings(lit_scene(lights));
    EXPECT_EQ(s.lights[0].name, "");
    EXPECT_EQ(s.lights[1].name, "Küchenlampe");
    EXPECT_EQ(s.lights[2].name, std::string(44, 'n') + "…");
    EXPECT_EQ(s.lights[3].name, "\\x1b[2J\\x0a\\xff\\u202e");
    EXPECT_TRUE(sanitise(s).empty());
}

TEST(SceneLights, TheirNumberIsBounded) {
    const Scene scene = lit_scene(std::vector<SceneLight>(20, light_of(LightType::Point, {1, 2, 3}, {0, -1, 0})));
    const Settings s = base_settings(scene);
    EXPECT_EQ(s.light_count, kMaxLights);
}

TEST(SceneLights, PositionsOutsideTheRangeAreAccepted) {
    const Scene scene = lit_scene({light_of(LightType::Spot, {1e12, 0, 0}, {1, 0, 0})});
    EXPECT_NO_THROW(base_settings(scene));
}

}  // namespace
}  // namespace si
