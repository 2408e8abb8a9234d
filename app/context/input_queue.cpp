#include "app/context/input_queue.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace si {
namespace {

/// Returns the GLFW_MOD_* bit of a modifier key; 0 for other keys.
int modifier_of(int key) {
    static constexpr int kModifiers[] = {GLFW_MOD_SHIFT, GLFW_MOD_CONTROL, GLFW_MOD_ALT, GLFW_MOD_SUPER};
    // Keys are numbered in this order: the four on the left, then the four on the right.
    if (key < GLFW_KEY_LEFT_SHIFT || key > GLFW_KEY_RIGHT_SUPER) return 0;
    return kModifiers[(key - GLFW_KEY_LEFT_SHIFT) % 4];
}

}  // namespace

void InputQueue::button(int button, bool down, int mods, const MouseQueue::When& when) {
    const std::size_t before = mouse_.waiting();
    mouse_.button(button, down, mods, when);
    if (mouse_.waiting() > before) waiting_.push_back({.kind = Kind::Button});
}

void InputQueue::key(const Key& key) {
    if (key.key < 0 || std::size_t(key.key) >= kKeys) return;
    waiting_.push_back({.kind = Kind::Key, .at = mouse_.last_position(), .key = key});
}

void InputQueue::character(unsigned code) {
    if (!waiting_.empty()) {
        Event& last = waiting_.back();
        const bool types = last.kind == Kind::Key && last.key.down && !last.character &&
                           modifier_of(last.key.key) == 0 && !(last.key.mods & (GLFW_MOD_CONTROL | GLFW_MOD_ALT));
        if (types) {
            last.character = code;
            return;
        }
    }
    waiting_.push_back({.kind = Kind::Character, .at = mouse_.last_position(), .character = code});
}

bool InputQueue::key_can_join(const Run& run, const Event& event) const {
    const auto& [key, mods, down] = event.key;
    const int modifier = modifier_of(key);
    if (modifier == GLFW_MOD_SHIFT && typing_ && !run.pressed && !run.wheeled)
        return true;  // typed characters include Shift
    if (!down) {
        if (modifier == 0) return true;
        // A press carries its Ctrl and Shift; a modifier pressed alone needs a step of its own.
        if (run.pressed) return (modifier & (GLFW_MOD_CONTROL | GLFW_MOD_SHIFT) & run.mods) != 0;
        return !run.typed && !run.wheeled && !run.down[std::size_t(key)];
    }
    if (run.pressed || run.typed || run.wheeled) return false;
    return !shown_[std::size_t(key)] || held_[std::size_t(key)];  // a pressed key must be shown as up first
}

bool InputQueue::can_join(const Run& run, const Event& event) const {
    if (event.kind == Kind::Button) return false;
    if (is_text(event)) return !run.pressed && !run.wheeled && !run.command && !run.left_alt;
    const bool points = !typing_ || event.kind == Kind::Wheel;  // keys go to the text field, wherever the mouse is
    if (points && event.at != run.at) return false;
    if (event.kind == Kind::Wheel) return !run.pressed && !run.typed;
    return key_can_join(run, event);
}

void InputQueue::add_to_step(Run& run, const Event& event) {
    run.at = event.at;
    if (event.character) strokes_.characters.push_back(*event.character);
    if (is_text(event)) run.typed = true;
    if (event.kind == Kind::Wheel) {
        strokes_.wheel += event.wheel;
        run.wheeled = true;
    }
    if (event.kind != Kind::Key) return;
    const std::size_t key = std::size_t(event.key.key);
    const int modifier = modifier_of(event.key.key);
    strokes_.keys.push_back(event.key);
    held_[key] = event.key.down;
    const bool other_than_shift = modifier != 0 && modifier != GLFW_MOD_SHIFT;
    if (event.key.down) {
        run.down[key] = true;
        run.command |= other_than_shift;
        if (modifier == 0 && !is_text(event)) {
            run.pressed = true;
            run.mods = event.key.mods;
        }
    } else {
        run.left_alt |= other_than_shift && modifier != GLFW_MOD_CONTROL;
    }
}

MouseQueue::Step InputQueue::next() {
    strokes_ = {};
    if (waiting_.empty() || waiting_.front().kind == Kind::Button) {
        const std::size_t before = mouse_.waiting();
        const MouseQueue::Step step = mouse_.next();
        if (mouse_.waiting() < before) waiting_.pop_front();
        shown_ = held_;
        return step;
    }
    Run run{.at = waiting_.front().at};
    while (!waiting_.empty() && can_join(run, waiting_.front())) {
        add_to_step(run, waiting_.front());
        waiting_.pop_front();
    }
    shown_ = held_ | run.down;
    return mouse_.step_without_change(run.at);
}

}  // namespace si
