#include "ui/state/history.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/settings/param.h"

namespace si {
namespace {

/// Returns the owner of a changed setting: "Tower: ", "Light 2: ".
std::string whose(const Settings& settings, const SettingRef& ref) {
    if (!ref.object.empty()) return ref.object.substr(ref.object.rfind('/') + 1) + ": ";
    if (ref.param->scope == Scope::Light && settings.light_count > 1) return light_title(settings, ref.light) + ": ";
    return {};
}

}  // namespace

void History::reset(const Settings& settings) {
    steps_.assign(1, {settings, present_});
    at_ = before_ = 0;
    untouched_ = settings;
}

void History::record(const Settings& settings, bool busy) {
    if (busy) return;
    Place& here = steps_[at_].place;
    if (here.scene.empty()) here = present_;
    if (settings != untouched_ || present_.scene != here.scene)
        commit(settings);
    else
        here.guide = present_.guide;
}

void History::set_time(double time_s) {
    untouched_.scene.time = time_s;
}

void History::amend_step(const Settings& before, const Settings& after) {
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
    Settings moved = steps_[at_].settings;
    moved.camera = settings.camera;
    const bool looks = moved == settings && present_.scene == steps_[at_].place.scene;
    steps_.resize(at_ + 1);
    if (looks && steps_[at_].looks) {
        steps_[at_].settings = settings;
        steps_[at_].place = present_;
        return;
    }
    steps_.push_back({settings, present_, looks});
    if (steps_.size() > kLimit) steps_.erase(steps_.begin());
    at_ = before_ = steps_.size() - 1;
}

const Settings& History::show_step(std::size_t step) {
    before_ = at_;
    at_ = step;
    untouched_ = steps_[at_].settings;
    return steps_[at_].settings;
}

const Settings& History::undo() {
    return show_step(can_undo() ? at_ - 1 : at_);
}

const Settings& History::redo() {
    return show_step(can_redo() ? at_ + 1 : at_);
}

const Settings& History::go_to(std::size_t step) {
    return show_step(std::min(step, steps_.size() - 1));
}

std::vector<std::string> History::names() const {
    std::vector<std::string> out{"the beginning"};
    for (std::size_t i = 1; i < steps_.size(); ++i) {
        const Step &before = steps_[i - 1], &after = steps_[i];
        if (const GuideNote& guide = after.place.guide; guide.key != before.place.guide.key && !guide.title.empty()) {
            out.push_back(guide.title);
        } else if (after.place.scene != before.place.scene) {
            out.push_back(after.place.scene);
        } else if (after.looks) {
            out.emplace_back("camera");
        } else {
            const std::vector<SettingRef> changed = differing_settings(before.settings, after.settings);
            std::string name = changed.empty()
                                   ? std::string("nothing")
                                   : fmt::format("{}{} {}", whose(after.settings, changed[0]), changed[0].param->label,
                                                 change_text(before.settings, after.settings, changed[0]));
            if (changed.size() > 1) name += fmt::format(", {} more", changed.size() - 1);
            out.push_back(std::move(name));
        }
    }
    return out;
}

void History::cancel_move() {
    show_step(before_);
}

}  // namespace si
