// Tests of cascade ends under each way to divide the camera's depth, and of the order of manual splits.
#include "renderer/settings/splits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/settings/idle_reason.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/cascades/cascades.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/box_scene.h"
#include "tests/support/sets.h"

namespace si {
namespace {

struct Divided {
    std::vector<double> ends;
    DepthSpan all;
    std::vector<std::string> notes;
};

/// Makes boxes in front of a camera that looks along -z, and returns the cascade borders of a sun.
Divided divided(const LightSettings& light, const glm::dvec3& at = glm::dvec3(0), bool orthographic = false) {
    Settings s;
    s.camera = orbiting_camera(at, 0, 0, 10);
    s.camera.orthographic = orthographic;
    const Scene scene = test::box_scene({{at + glm::dvec3(-1, -1, 0), at + glm::dvec3(1, 1, 2)},
                                         {at + glm::dvec3(-1, -1, -190), at + glm::dvec3(1, 1, -188)}});
    const Camera camera = make_camera(scene, s, 1);
    s.lights[0] = light;
    const FittedLight fitted = fit_lights(scene, s, &camera)[0];
    Divided out;
    for (const ViewSpan& span : fitted.chooser.spans) out.ends.push_back(span.ends);
    const SceneShape shape = scene_shape(scene, s);
    out.all = *visible_depths(camera, shape.boxes, shape.box_receives);
    out.notes = fitted.notes;
    return out;
}

TEST(Splits, AreTheClosedFormsOfTheirRows) {
    for (const glm::dvec3& at : {glm::dvec3(0), glm::dvec3(3e4, 5, -115)})
        for (const int count : {2, 5, 8})
            for (const Split split : {Split::Uniform, Split::Logarithmic, Split::Practical, Split::Manual}) {
                LightSettings light;
                light.cascades = count;
                light.split = split;
                light.split_lambda = 0.3;
                const Divided d = divided(light, at);
                ASSERT_EQ(d.ends.size(), std::size_t(count));
                EXPECT_NEAR(d.all.from_m, 8, 1e-6);
                EXPECT_NEAR(d.all.to_m, 200, 1e-6);
                for (int i = 0; i < count; ++i) {
                    const double share = (i + 1.0) / count, even = 8 + 192 * share, ratio = 8 * std::pow(25, share);
                    const double by_hand = i + 1 < count ? 8 + 192 * manual_splits(light)[std::size_t(i)] : 200;
                    const double wanted = split == Split::Uniform       ? even
                                          : split == Split::Logarithmic ? ratio
                                          : split == Split::Practical   ? 0.3 * ratio + 0.7 * even
                                                                        : by_hand;
                    EXPECT_NEAR(d.ends[std::size_t(i)], wanted, 1e-6 * wanted) << int(split) << " " << i;
                }
            }
}

TEST(Splits, OrthographicSplitsAreEvenWithANote) {
    LightSettings light;
    light.cascades = 4;
    light.split = Split::Logarithmic;
    const Divided d = divided(light, glm::dvec3(0), true);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(d.ends[std::size_t(i)], 8 + 48 * (i + 1), 1e-6);
    ASSERT_EQ(d.notes.size(), 1u);
    EXPECT_NE(d.notes[0].find("evenly"), std::string::npos);
    light.split = Split::Practical;
    EXPECT_TRUE(divided(light, glm::dvec3(0), true).notes.empty());
}

TEST(Splits, MovingOnePushesItsNeighbours) {
    Settings s;
    const auto drag = [&](const char* key, double to) {
        const SettingRef ref = *find_setting(key);
        set_value(s, ref, to);
        push_splits(s, ref);
        return manual_splits(s.lights[std::size_t(ref.light)]);
    };
    EXPECT_EQ(drag("light.2.split_2", 0.65), (std::array{0.07, 0.65, 0.65, 0.65, 0.7, 0.8, 0.9}));
    EXPECT_EQ(drag("light.2.split_6", 0.1), (std::array{0.07, 0.1, 0.1, 0.1, 0.1, 0.1, 0.9}));
    EXPECT_EQ(drag("light.2.split_7", 0.), (std::array{0., 0., 0., 0., 0., 0., 0.}));
    EXPECT_EQ(manual_splits(s.lights[0]), manual_splits(LightSettings())) << "another light's stay";
    const Settings before = s;
    push_splits(s, *find_setting("light.split_lambda"));
    EXPECT_EQ(s, before);
}

TEST(Splits, UnorderedSplitsAreRepairedWithANote) {
    Settings s;
    set_setting(s, "light.cascades", "4");
    set_setting(s, "light.split_1", "0.5");  // behind the second, 0.2, and the third, 0.45
    Settings unused = s;
    EXPECT_TRUE(sanitise(unused).empty()) << "they do not divide";
    EXPECT_EQ(unused, s);
    set_setting(s, "light.split", "manual");
    const std::vector<std::string> notes = sanitise(s);
    ASSERT_EQ(notes.size(), 2u);
    EXPECT_EQ(notes[0], "light.split_2 0.2 lies before light.split_1 0.5: moved up to it");
    EXPECT_EQ(manual_splits(s.lights[0]), (std::array{0.5, 0.5, 0.5, 0.6, 0.7, 0.8, 0.9}));
    EXPECT_TRUE(sanitise(s).empty());
    // Equal splits leave an interval of no depth, which nothing looks up.
    const Divided d = divided(s.lights[0]);
    EXPECT_TRUE(std::ranges::is_sorted(d.ends));
}

TEST(Splits, ShowOnlySettingsOfTheirRow) {
    Settings s;
    set_setting(s, "light.cascades", "3");
    const auto idle = [&](const char* key) { return idle_reason(s, *find_setting(key)); };
    EXPECT_EQ(idle("light.split_lambda"), "");
    EXPECT_NE(idle("light.split_1"), "");
    set_setting(s, "light.split", "manual");
    EXPECT_NE(idle("light.split_lambda"), "");
    EXPECT_EQ(idle("light.split_1"), "");
    EXPECT_EQ(idle("light.split_2"), "");
    EXPECT_NE(idle("light.split_3"), "") << "three cascades have two borders";
}

}  // namespace
}  // namespace si
