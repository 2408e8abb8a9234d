#include "ui/history.h"

namespace si {

void History::reset(const Settings& settings) {
    steps_.assign(1, settings);
    at_ = 0;
}

void History::observe(const Settings& settings, bool busy) {
    if (busy || settings == steps_[at_]) return;
    steps_.resize(at_ + 1);
    steps_.push_back(settings);
    if (steps_.size() > kLimit) steps_.erase(steps_.begin());
    at_ = steps_.size() - 1;
}

const Settings& History::undo() {
    if (can_undo()) --at_;
    return steps_[at_];
}

const Settings& History::redo() {
    if (can_redo()) ++at_;
    return steps_[at_];
}

}  // namespace si
