// Lights added, copied, deleted and reordered: as functions on settings, and by their buttons.
#include "ui/state/light_list.h"

#include <gtest/gtest.h>

#include "tests/ui/ui_harness.h"

namespace si::test {
namespace {

/// Lights with azimuths 10, 20, ...
Settings with_lights(int count) {
    Settings s;
    s.light_count = count;
    for (int i = 0; i < count; ++i) s.lights[std::size_t(i)].azimuth = 10.0 * (i + 1);
    return s;
}

std::vector<double> azimuths(const Settings& s) {
    std::vector<double> out;
    for (int i = 0; i < s.light_count; ++i) out.push_back(s.lights[std::size_t(i)].azimuth);
    return out;
}

TEST(LightList, CopiesStandRightAfterTheirOriginal) {
    Settings s = with_lights(3);
    s.lights[1].cast = false;
    copy_light(s, 1);
    EXPECT_EQ(azimuths(s), (std::vector<double>{10, 20, 20, 30}));
    EXPECT_FALSE(s.lights[2].cast);
    EXPECT_EQ(s.view.light, 2);
    const Settings before = s;
    copy_light(s, 4);
    copy_light(s, -1);
    EXPECT_EQ(s, before) << "there is no such light";
    s = with_lights(kMaxLights);
    copy_light(s, 0);
    add_light(s);
    EXPECT_EQ(s, with_lights(kMaxLights)) << "there is no room";
}

TEST(LightList, DeletedOnesLeaveNoTraceAndTheShownOneStays) {
    Settings s = with_lights(3);
    s.view.light = 2;
    delete_light(s, 0);
    EXPECT_EQ(azimuths(s), (std::vector<double>{20, 30}));
    EXPECT_EQ(s.view.light, 1) << "the same light";
    EXPECT_EQ(s.lights[2], LightSettings());
    delete_light(s, 1);
    EXPECT_EQ(s.view.light, 0);
    delete_light(s, 0);
    EXPECT_EQ(s.light_count, 0);
    delete_light(s, 0);
    EXPECT_EQ(s.light_count, 0);
    add_light(s);
    EXPECT_EQ(azimuths(s), std::vector<double>{LightSettings().azimuth});
}

TEST(LightList, MovesAsFarAsThereAreLights) {
    Settings s = with_lights(4);
    move_light(s, 0, 2);
    EXPECT_EQ(azimuths(s), (std::vector<double>{20, 30, 10, 40}));
    EXPECT_EQ(s.view.light, 2);
    move_light(s, 2, -9);
    EXPECT_EQ(azimuths(s), (std::vector<double>{10, 20, 30, 40}));
    EXPECT_EQ(s.view.light, 0);
}

TEST(LightList, EachChangeIsOneStepOfUndo) {
    UiHarness ui(1280, 900);
    ui.frames(3);
    const Settings one = ui.state.settings;
    const auto step = [&](auto change) {
        change(ui.state.settings);
        ui.frames(2);
        return ui.state.settings;
    };
    const Settings two = step([](Settings& s) { add_light(s); });
    EXPECT_EQ(two.light_count, one.light_count + 1);
    EXPECT_NE(two.lights[1].azimuth, two.lights[0].azimuth) << "another side";
    const Settings three = step([](Settings& s) { copy_light(s, 1); });
    step([](Settings& s) { delete_light(s, 0); });
    EXPECT_EQ(ui.state.history.undo(), three);
    EXPECT_EQ(ui.state.history.undo(), two);
    EXPECT_EQ(ui.state.history.undo(), one);
}

}  // namespace
}  // namespace si::test
