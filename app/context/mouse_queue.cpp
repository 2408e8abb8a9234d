#include "app/context/mouse_queue.h"

#include <algorithm>

namespace si {

void MouseQueue::button(int button, bool down, int mods, const When& when) {
    if (button < 0 || button >= kButtons) return;
    Change change{.button = button, .mods = mods, .down = down, .at = at_};
    if (down) {
        double& before_s = pressed_s_[std::size_t(button)];
        change.doubles = when.earliest_s - before_s < kDoubleClickSeconds;
        before_s = when.latest_s;
    }
    waiting_.push_back(change);
}

MouseQueue::Step MouseQueue::next() {
    Step step{.down = down_};
    if (waiting_.empty()) {
        step.at = last_position();
    } else {
        const Change& change = waiting_.front();
        step.at = change.at;
        step.mods = change.mods;
        if (!change.at || change.at == shown_) {
            down_[std::size_t(change.button)] = change.down;
            step.down = down_;
            step.doubles = change.doubles;
            waiting_.pop_front();
        }
    }
    shown_ = step.at;
    return step;
}

MouseQueue::Step MouseQueue::step_without_change(std::optional<glm::dvec2> at) {
    shown_ = at;
    return {.down = down_, .at = at};
}

std::optional<glm::dvec2> MouseQueue::last_position() const {
    const bool held = !waiting_.empty() || std::ranges::any_of(down_, [](bool down) { return down; });
    return inside_ || held ? at_ : std::nullopt;
}

}  // namespace si
