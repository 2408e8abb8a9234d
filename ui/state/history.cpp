#include "ui/state/history.h"

#include "renderer/settings/param.h"

namespace si {

void History::reset(const Settings& settings) {
    steps_.assign(1, {settings, present_});
    at_ = before_ = 0;
    untouched_ = settings;
}

void History::observe(const Settings& settings, bool busy) {
    if (busy) return;
    Place& here = steps_[at_].place;
    if (here.scene.empty()) here = present_;
    if (settings != untouched_ || present_.scene != here.scene)
        commit(settings);
    else
        here.guide = present_.guide;
}

void History::tick(double time_s) {
    untouched_.scene.time = time_s;
}

void History::follow(const Settings& before, const Settings& after) {
    if (steps_[at_].settings == before) steps_[at_].settings = after;
    for (const SettingRef& ref : all_settings(after))
        if (const Value value = get_value(after, ref); value != get_value(before, ref))
            set_value(untouched_, ref, value);
}

void History::commit(const Settings& settings) {
    untouched_ = settings;
    if (Step& here = steps_[at_]; settings == here.settings && present_.scene == here.place.scene) {
        here.place = present_;
        return;
    }
    steps_.resize(at_ + 1);
    steps_.push_back({settings, present_});
    if (steps_.size() > kLimit) steps_.erase(steps_.begin());
    at_ = before_ = steps_.size() - 1;
}

const Settings& History::move_to(std::size_t step) {
    before_ = at_;
    at_ = step;
    untouched_ = steps_[at_].settings;
    return steps_[at_].settings;
}

const Settings& History::undo() {
    return move_to(can_undo() ? at_ - 1 : at_);
}

const Settings& History::redo() {
    return move_to(can_redo() ? at_ + 1 : at_);
}

void History::stay() {
    move_to(before_);
}

}  // namespace si
