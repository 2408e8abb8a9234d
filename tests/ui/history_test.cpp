// Tests of undo and redo of gestures, and of the log.
#include "ui/state/history.h"

#include <gtest/gtest.h>

#include "renderer/settings/param.h"
#include "ui/state/log.h"

namespace si {
namespace {

Settings with_bias(double constant) {
    Settings s;
    s.bias.constant = constant;
    return s;
}

TEST(History, GestureIsOneStep) {
    History h;
    h.reset(with_bias(1));
    h.record(with_bias(2), true);
    h.record(with_bias(3), true);
    h.record(with_bias(4), false);
    h.record(with_bias(4), false);
    EXPECT_EQ(h.undo().bias.constant, 1);
    EXPECT_FALSE(h.can_undo());
    EXPECT_EQ(h.redo().bias.constant, 4);
    EXPECT_FALSE(h.can_redo());
}

TEST(History, SuccessiveCameraMovesAreOneStepAndStepsHaveNames) {
    History h;
    Settings s = with_bias(1);
    h.set_place({"boxes", {}});
    h.reset(s);
    for (int i = 0; i < 5; ++i) {
        s.camera.azimuth += 10;
        h.record(s, false);
    }
    s.bias.constant = 2;
    h.record(s, false);
    s.camera.distance = 7;
    h.record(s, false);
    s.filter.size = 5;
    s.map.resolution = 512;
    h.record(s, false);
    const std::vector<std::string> names = h.names();
    ASSERT_EQ(names.size(), 5u);
    EXPECT_EQ(names[1], "camera");
    EXPECT_EQ(names[2], "Constant bias 1 → 2 texels");
    EXPECT_EQ(names[3], "camera");
    EXPECT_NE(names[4].find(", 1 more"), std::string::npos) << names[4];
    Settings more = s;
    more.light_count = 3;
    more.lights[2].elevation = 20;
    h.record(more, false);
    set_setting(more, "light.2.elevation", "30");
    h.record(more, false);
    set_setting(more, "object.Boxes/Tower.cast", "false");
    h.record(more, false);
    EXPECT_EQ(h.names()[6], "Light 2: Elevation 20° → 30°");
    EXPECT_EQ(h.names()[7], "Tower: Casts on → off");
    h.go_to(4);
    EXPECT_EQ(h.index(), 4u);
    EXPECT_EQ(h.go_to(1).camera.azimuth, with_bias(1).camera.azimuth + 50);
    EXPECT_EQ(h.undo(), with_bias(1));
    EXPECT_EQ(h.go_to(99), more);
}

TEST(History, NoteWithoutAChangeBelongsToTheCurrentStep) {
    History h;
    Settings s;
    h.set_place({"boxes", {}});
    h.reset(s);
    h.set_place({"boxes", {"acne", "Shadow acne", "Look."}});
    h.record(s, false);  // a preset equal to the shown settings
    EXPECT_EQ(h.place().guide.key, "acne");
    EXPECT_FALSE(h.can_undo());
    h.set_place({"boxes", {}});
    s.map.resolution = 64;
    h.record(s, false);
    h.undo();
    EXPECT_EQ(h.place().guide.key, "acne");
}

TEST(History, FailedUndoKeepsItsPosition) {
    History h;
    const Settings first;
    Settings second;
    second.map.resolution = 64;
    h.reset(first);
    h.record(second, false);
    h.undo();
    h.cancel_move();
    EXPECT_EQ(h.settings(), second);
    EXPECT_TRUE(h.can_undo());
    EXPECT_FALSE(h.can_redo());
}

TEST(History, ConsequentChangesBelongToTheStepThatCausedThem) {
    History h;
    const Settings first;
    Settings followed, changed;
    followed.lights[0].azimuth = 12;
    changed = followed;
    changed.map.resolution = 64;
    h.reset(first);
    h.amend_step(first, followed);
    h.record(followed, false);
    EXPECT_FALSE(h.can_undo()) << "nobody changed anything";
    h.record(changed, false);
    EXPECT_EQ(h.undo(), followed);
}

TEST(History, ChangeAfterUndoDropsUndoneSteps) {
    History h;
    h.reset(with_bias(1));
    h.record(with_bias(2), false);
    h.record(with_bias(3), false);
    h.undo();
    h.record(with_bias(9), false);
    EXPECT_FALSE(h.can_redo());
    EXPECT_EQ(h.undo().bias.constant, 2);
    EXPECT_EQ(h.undo().bias.constant, 1);
    EXPECT_EQ(h.undo().bias.constant, 1) << "the oldest value stays";
}

TEST(History, IsBoundedAndKeepsTheNewest) {
    History h;
    h.reset(with_bias(0));
    for (int i = 1; i <= 2000; ++i) h.record(with_bias(i), false);
    int steps = 0;
    while (h.can_undo()) {
        h.undo();
        ++steps;
    }
    EXPECT_GT(steps, 100);
    EXPECT_LT(steps, 1000);
    while (h.can_redo()) h.redo();
    h.record(with_bias(2000), false);
    EXPECT_FALSE(h.can_redo());
}

TEST(Log, CountsRepeatsAndUnseenErrors) {
    Log log;
    log.add(LogKind::Error, "no such file");
    log.add(LogKind::Error, "no such file");
    log.add(LogKind::Info, "saved");
    ASSERT_EQ(log.lines().size(), 2u);
    EXPECT_EQ(log.lines()[0].count, 2);
    EXPECT_EQ(log.unseen_errors(), 2);
    log.mark_seen();
    EXPECT_EQ(log.unseen_errors(), 0);
}

}  // namespace
}  // namespace si
