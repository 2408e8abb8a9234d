// Tests of the mouse queue: mouse events in frames of any duration.
#include "app/context/mouse_queue.h"

#include <gtest/gtest.h>

#include <vector>

namespace si {
namespace {

/// Returns every step until the queue is empty.
std::vector<MouseQueue::Step> steps_of(MouseQueue& mouse) {
    std::vector<MouseQueue::Step> steps;
    while (!mouse.empty()) steps.push_back(mouse.next());
    return steps;
}

int presses(const std::vector<MouseQueue::Step>& steps) {
    int n = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) n += steps[i].down[0] && (i == 0 || !steps[i - 1].down[0]);
    return n;
}

TEST(MouseQueue, DoubleClickDuringASlowFrameIsRecognised) {
    MouseQueue mouse;
    mouse.move({10, 20});
    mouse.next();
    // A frame took from 1.0 to 1.7 s, and all events are queued after it.
    for (int click = 0; click < 2; ++click) {
        mouse.button(0, true, 0, {1.0, 1.7});
        mouse.button(0, false, 0, {1.0, 1.7});
    }
    const auto steps = steps_of(mouse);
    EXPECT_EQ(presses(steps), 2) << "none is lost";
    ASSERT_EQ(steps.size(), 4u);
    EXPECT_FALSE(steps[0].doubles);
    EXPECT_TRUE(steps[2].doubles);
    EXPECT_FALSE(steps[3].down[0]);
}

TEST(MouseQueue, SlowFrameBetweenPressesKeepsTheDoubleClick) {
    MouseQueue mouse;
    mouse.move({10, 20});
    mouse.next();
    mouse.button(0, true, 0, {1.0, 1.0});
    EXPECT_FALSE(mouse.next().doubles);
    mouse.button(0, false, 0, {1.0, 1.7});
    mouse.button(0, true, 0, {1.0, 1.7});
    mouse.next();
    EXPECT_TRUE(mouse.next().doubles);
}

TEST(MouseQueue, TwoSlowClicksAreNoDoubleClick) {
    MouseQueue mouse;
    mouse.move({10, 20});
    mouse.next();
    for (const double s : {1.0, 1.6}) {  // frames of 200 ms
        mouse.button(0, true, 0, {s - 0.2, s});
        mouse.button(0, false, 0, {s, s + 0.2});
    }
    for (const auto& step : steps_of(mouse)) EXPECT_FALSE(step.doubles);
    mouse.button(1, true, 0, {1.65, 1.7});
    EXPECT_FALSE(mouse.next().doubles) << "another button";
}

TEST(MouseQueue, EachPressHasItsOwnPosition) {
    MouseQueue mouse;
    mouse.move({10, 10});
    mouse.button(0, true, 2, {1, 1});
    mouse.move({300, 40});
    mouse.button(0, false, 0, {1, 1});
    mouse.move({500, 500});
    std::vector<MouseQueue::Step> steps = steps_of(mouse);
    ASSERT_EQ(steps.size(), 4u);
    EXPECT_FALSE(steps[0].down[0]) << "first the mouse is there";
    EXPECT_EQ(steps[1].at, glm::dvec2(10, 10));
    EXPECT_TRUE(steps[1].down[0]);
    EXPECT_EQ(steps[1].mods, 2);
    EXPECT_EQ(steps[2].at, glm::dvec2(300, 40));
    EXPECT_TRUE(steps[2].down[0]) << "a drag: held while it moves";
    EXPECT_EQ(steps[3].at, glm::dvec2(300, 40));
    EXPECT_FALSE(steps[3].down[0]);
    const MouseQueue::Step after = mouse.next();
    EXPECT_EQ(after.at, glm::dvec2(500, 500));
    EXPECT_FALSE(after.mods);
}

TEST(MouseQueue, PositionOutsideTheWindowIsUnknown) {
    MouseQueue mouse;
    EXPECT_FALSE(mouse.next().at);
    mouse.move({5, 5});
    EXPECT_TRUE(mouse.next().at);
    mouse.enter(false);
    EXPECT_FALSE(mouse.next().at);
    mouse.button(7, true, 0, {1, 1});
    EXPECT_TRUE(mouse.empty()) << "a button that ImGui does not know";
}

}  // namespace
}  // namespace si
