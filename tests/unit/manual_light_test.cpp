// Tests of manual lights: the numbers of a fit, set by hand, give the same maps.
#include "renderer/view/fits/manual_light.h"

#include <gtest/gtest.h>

#include "renderer/base/index_of.h"
#include "renderer/scenes/builtin.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/box_scene.h"

namespace si {
namespace {

/// Returns the largest difference of the two views' clip space positions over the corners of the second one's map, as a
/// share of the map's size and depth range.
double clip_space_difference(const LightView& a, const LightView& b) {
    double most = 0;
    for (int i = 0; i < 8; ++i) {
        const double z = i & 4 ? b.curve.far : b.curve.near, half = b.half_extent() * (b.curve.perspective ? z : 1.0);
        const glm::dvec3 p = b.eye + b.axes * glm::dvec3(i & 1 ? half : -half, i & 2 ? half : -half, -z);
        for (const LightView* v : {&a, &b}) EXPECT_GT((v->clip_from_relative(p) * glm::dvec4(0, 0, 0, 1)).w, 0);
        const glm::dvec4 pa = a.clip_from_relative(p) * glm::dvec4(0, 0, 0, 1);
        const glm::dvec4 pb = b.clip_from_relative(p) * glm::dvec4(0, 0, 0, 1);
        for (int k = 0; k < 3; ++k) most = std::max(most, std::abs(pa[k] / pa.w - pb[k] / pb.w));
    }
    return most;
}

std::vector<Settings> lights_to_try() {
    std::vector<Settings> all;
    for (const LightType type : {LightType::Directional, LightType::Spot, LightType::Point})
        for (const LightProjection projection :
             {LightProjection::Automatic, LightProjection::Orthographic, LightProjection::Perspective})
            for (const double cone : {3.0, 60.0, 200.0})
                for (const double distance : {0.0, 0.3, 40.0})
                    for (const double elevation : {45.0, 90.0, -10.0}) {
                        if (type != LightType::Spot && cone != 60.0) continue;
                        Settings s;
                        LightSettings& l = s.lights[0];
                        l.type = type;
                        l.projection = projection;
                        l.cone = cone;
                        l.distance = distance;
                        l.elevation = elevation;
                        l.target_x = 0.7;
                        l.target_z = -2;
                        all.push_back(s);
                        l.fit = LightFit::Scene;
                        all.push_back(s);
                        l.fit = LightFit::Manual;  // zeros select the fit's values
                        all.push_back(s);
                        l.near = 0.25;
                        all.push_back(s);
                    }
    return all;
}

TEST(ManualLight, GivesTheMapsOfTheFit) {
    std::vector<Scene> scenes;
    scenes.push_back(load_scene("stage"));
    scenes.push_back(test::box_scene({{{-4, 0, -1}, {9, 3, 5}}, {{20, 0, 0}, {21, 9, 1}}}, {1e4, 0, -300}));
    int tried = 0;
    for (const Scene& scene : scenes)
        for (const Settings& automatic : lights_to_try()) {
            const FittedLight before = fit_lights(scene, automatic)[0];
            Settings by_hand = automatic;
            by_hand.lights[0] = manual_light(automatic.lights[0], before);
            const LightSettings& l = by_hand.lights[0];
            EXPECT_EQ(l.fit, LightFit::Manual);
            EXPECT_GT(l.distance, 0);
            EXPECT_GE(l.near, 0);
            EXPECT_EQ(l.azimuth, automatic.lights[0].azimuth);
            const FittedLight after = fit_lights(scene, by_hand)[0];
            ASSERT_EQ(after.views.size(), before.views.size());
            for (std::size_t i = 0; i < after.views.size(); ++i)
                EXPECT_LT(clip_space_difference(after.views[i], before.views[i]), 1e-9)
                    << "type " << index_of(l.type) << " projection " << index_of(l.projection) << " cone " << l.cone
                    << " distance " << automatic.lights[0].distance << " elevation " << l.elevation;
            EXPECT_EQ(manual_light(l, after), l) << "a light by hand stays as it is";
            ++tried;
        }
    EXPECT_GT(tried, 200);
}

TEST(ManualLight, FarIsKeptWhenTheSceneShrinks) {
    Scene scene = test::box_scene({{{-4, 0, -4}, {4, 1, 4}}, {{0, 8, 0}, {1, 9, 1}}});
    Settings s;
    const FittedLight before = fit_lights(scene, s)[0];
    s.lights[0] = manual_light(s.lights[0], before);
    scene.objects.pop_back();
    const FittedLight after = fit_lights(scene, s)[0];
    EXPECT_NEAR(after.views[0].half_extent(), before.views[0].half_extent(), 1e-9);
    EXPECT_NEAR(after.views[0].curve.near, before.views[0].curve.near, 1e-9);
    EXPECT_NEAR(after.views[0].curve.far, before.views[0].curve.far, 1e-9);
}

}  // namespace
}  // namespace si
