// Tests of the input queue: mouse and keys reach frames in order, in as few frames as possible.
#include "app/context/input_queue.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace si {
namespace {

struct InputStep {
    MouseQueue::Step mouse;
    InputQueue::Strokes strokes;
    std::string text() const { return {strokes.characters.begin(), strokes.characters.end()}; }
    bool presses(int key) const {
        return std::ranges::any_of(strokes.keys, [&](const auto& k) { return k.key == key && k.down; });
    }
    bool releases(int key) const {
        return std::ranges::any_of(strokes.keys, [&](const auto& k) { return k.key == key && !k.down; });
    }
};

struct InputQueueTest : testing::Test {
    InputQueue queue;
    InputQueueTest() { queue.move({10, 20}); }

    void down(int key, int mods = 0) { queue.key({key, mods, true}); }
    void up(int key, int mods = 0) { queue.key({key, mods, false}); }
    void tap(int key, int mods = 0) {
        down(key, mods);
        up(key, mods);
    }
    void type(const std::string& text) {
        for (const char c : text) {
            const int key = c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c;
            down(key);
            queue.character(unsigned(c));
            up(key);
        }
    }
    void control(int key) {
        down(GLFW_KEY_LEFT_CONTROL);
        tap(key, GLFW_MOD_CONTROL);
        up(GLFW_KEY_LEFT_CONTROL, GLFW_MOD_CONTROL);
    }
    InputStep next() {
        InputStep step{.mouse = queue.next(), .strokes = {}};
        step.strokes = queue.take_strokes();
        return step;
    }
    std::vector<InputStep> steps() {
        std::vector<InputStep> all;
        while (!queue.empty() && all.size() < 100) all.push_back(next());
        EXPECT_TRUE(queue.empty()) << "it comes to no end";
        return all;
    }
};

TEST_F(InputQueueTest, TextAfterControlAKeepsItsOrder) {
    queue.typing(true);
    control('A');
    type("depth bias");
    const auto all = steps();
    ASSERT_EQ(all.size(), 2u);
    EXPECT_TRUE(all[0].presses('A') && all[0].presses(GLFW_KEY_LEFT_CONTROL));
    EXPECT_EQ(all[0].text(), "");
    EXPECT_EQ(all[1].text(), "depth bias");
    EXPECT_FALSE(all[1].presses(GLFW_KEY_LEFT_CONTROL) || queue.is_down(GLFW_KEY_LEFT_CONTROL));
}

TEST_F(InputQueueTest, TypedTextIsOneStepInAField) {
    queue.typing(true);
    down(GLFW_KEY_LEFT_SHIFT);
    down('H', GLFW_MOD_SHIFT);
    queue.character('H');
    up('H', GLFW_MOD_SHIFT);
    up(GLFW_KEY_LEFT_SHIFT, GLFW_MOD_SHIFT);
    type("el");
    queue.move({300, 300});  // ignored by fields
    type("lo");
    down('X');
    queue.character('x');
    queue.character('x');
    queue.character('x');                               // key repeat
    down('Y'), queue.character('y'), up('X'), up('Y');  // the next key before the last is released
    const auto all = steps();
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].text(), "Helloxxxy");
    EXPECT_FALSE(queue.is_down('X'));
}

TEST_F(InputQueueTest, EditingKeyKeepsItsOrderAmongLetters) {
    queue.typing(true);
    type("ab");
    tap(GLFW_KEY_BACKSPACE);
    tap(GLFW_KEY_BACKSPACE);
    type("c");
    tap(GLFW_KEY_ENTER);
    std::string received;
    for (const InputStep& step : steps()) {
        received += step.text();
        for (const auto& [key, sign] : {std::pair{GLFW_KEY_BACKSPACE, '<'}, {GLFW_KEY_ENTER, '!'}}) {
            if (!step.presses(key)) continue;
            EXPECT_EQ(step.text(), "");
            received += sign;
        }
        received += '|';
    }
    EXPECT_EQ(received, "ab|<||<|c|!|") << "between two presses of a key it is seen to be up";
}

TEST_F(InputQueueTest, PressedModifierDelaysTextUntilReleased) {
    queue.typing(true);
    type("a");
    down(GLFW_KEY_LEFT_CONTROL);
    up(GLFW_KEY_LEFT_CONTROL, GLFW_MOD_CONTROL);
    type("b");
    const auto all = steps();
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].text(), "a");
    EXPECT_TRUE(all[1].presses(GLFW_KEY_LEFT_CONTROL));
    EXPECT_FALSE(all[1].releases(GLFW_KEY_LEFT_CONTROL)) << "ImGui would never see it";
    EXPECT_EQ(all[2].text(), "b") << "ImGui drops what is typed under Ctrl";
    EXPECT_TRUE(all[2].releases(GLFW_KEY_LEFT_CONTROL));
}

TEST_F(InputQueueTest, AltIsHeldForItsKeyAndItsReleaseIsAStep) {
    queue.typing(true);
    down(GLFW_KEY_LEFT_ALT);
    tap('H', GLFW_MOD_ALT);
    up(GLFW_KEY_LEFT_ALT, GLFW_MOD_ALT);
    type("a");
    const auto all = steps();
    ASSERT_EQ(all.size(), 3u);
    EXPECT_TRUE(all[0].presses('H') && all[0].presses(GLFW_KEY_LEFT_ALT));
    EXPECT_FALSE(all[0].releases(GLFW_KEY_LEFT_ALT));
    EXPECT_TRUE(all[1].releases(GLFW_KEY_LEFT_ALT));
    EXPECT_EQ(all[1].text(), "");
    EXPECT_EQ(all[2].text(), "a");
}

TEST_F(InputQueueTest, EachKeyIsAStepOutsideFields) {
    type("fll");
    std::string received;
    for (const InputStep& step : steps()) {
        int presses = 0;
        for (const auto& key : step.strokes.keys) presses += key.down;
        EXPECT_LE(presses, 1);
        EXPECT_EQ(step.text().size(), std::size_t(presses)) << "a character comes with its key";
        received += step.text() + '|';
    }
    EXPECT_EQ(received, "f|l||l|");
}

TEST_F(InputQueueTest, MouseAndKeysDoNotOvertakeEachOther) {
    queue.next();
    type("f");
    queue.move({50, 60});
    queue.button(0, true, 0, {1, 1});
    queue.button(0, false, 0, {1, 1});
    type("ab");
    queue.button(1, true, 0, {2, 2});
    const auto first = next();
    EXPECT_EQ(first.text(), "f");
    EXPECT_EQ(first.mouse.at, glm::dvec2(10, 20)) << "where the mouse was then";
    EXPECT_FALSE(first.mouse.down[0]);
    const auto there = next(), pressed = next(), released = next();
    for (const InputStep& step : {there, pressed, released}) EXPECT_TRUE(step.strokes.keys.empty());
    EXPECT_EQ(there.mouse.at, glm::dvec2(50, 60));
    EXPECT_FALSE(there.mouse.down[0]);
    EXPECT_TRUE(pressed.mouse.down[0]);
    EXPECT_FALSE(released.mouse.down[0]);
    queue.typing(true);  // the click went into a field
    const auto typed = next();
    EXPECT_EQ(typed.text(), "ab");
    EXPECT_FALSE(typed.mouse.down[1]);
    EXPECT_FALSE(typed.mouse.mods);
    EXPECT_TRUE(next().mouse.down[1]);
    EXPECT_TRUE(queue.empty());
}

TEST_F(InputQueueTest, HeldButtonStaysHeldDuringKeys) {
    queue.next();
    queue.button(1, true, 0, {1, 1});
    next();
    down('W');
    const auto step = next();
    EXPECT_TRUE(step.mouse.down[1]);
    EXPECT_TRUE(step.presses('W'));
    EXPECT_TRUE(queue.is_down('W'));
    EXPECT_TRUE(next().strokes.keys.empty());
    EXPECT_TRUE(queue.is_down('W'));
    up('W');
    EXPECT_TRUE(next().releases('W'));
    EXPECT_FALSE(queue.is_down('W'));
}

TEST_F(InputQueueTest, WheelTurnsWithTheModifiersOfItsTime) {
    down(GLFW_KEY_LEFT_CONTROL);
    queue.wheel({0, 1});
    queue.wheel({0, 2});
    up(GLFW_KEY_LEFT_CONTROL, GLFW_MOD_CONTROL);
    queue.wheel({0, -1});
    queue.move({99, 99});
    queue.wheel({0, -1});
    const auto all = steps();
    ASSERT_EQ(all.size(), 3u);
    EXPECT_TRUE(all[0].presses(GLFW_KEY_LEFT_CONTROL) && !all[0].releases(GLFW_KEY_LEFT_CONTROL));
    EXPECT_EQ(all[0].strokes.wheel, glm::dvec2(0, 3));
    EXPECT_TRUE(all[1].releases(GLFW_KEY_LEFT_CONTROL));
    EXPECT_EQ(all[1].strokes.wheel, glm::dvec2(0, -1));
    EXPECT_EQ(all[1].mouse.at, glm::dvec2(10, 20));
    EXPECT_EQ(all[2].mouse.at, glm::dvec2(99, 99));
}

TEST_F(InputQueueTest, UnknownKeysAreNoSteps) {
    queue.key({GLFW_KEY_UNKNOWN, 0, true});
    queue.button(7, true, 0, {1, 1});
    EXPECT_TRUE(queue.empty());
    EXPECT_FALSE(queue.is_down(GLFW_KEY_UNKNOWN));
}

}  // namespace
}  // namespace si
