// Undo and redo: a stack of whole Settings values. A gesture (a drag, a turn of the wheel) is one step.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "renderer/settings/settings.h"

namespace si {

/// Note of the preset that was opened last.
struct GuideNote {
    std::string key;  ///< key of a built-in preset, or the file's path; empty: none is open
    std::string title;
    std::string about;  ///< sentence on what to look at
    bool operator==(const GuideNote&) const = default;
};

/// Scene and preset that settings belong to.
struct Place {
    std::string scene;  ///< built-in key or path; empty: any
    GuideNote guide;
};

/// Stack of settings, one entry a step.
class History {
public:
    /// Starts over from `settings` (a new scene or the start of the program).
    void reset(const Settings& settings);
    /// Sets the scene and preset of the next step. Another scene is a step of its own.
    void set_place(Place place) { present_ = std::move(place); }
    /// Records changes of the settings. While `busy` (a gesture is under way) nothing is recorded; afterwards all
    /// changes since the last step become one step. Moves of the camera in a row are one step. Call once a frame.
    void observe(const Settings& settings, bool busy);
    /// Takes over scene.time from the playing clock without a step. commit() makes one.
    void tick(double time_s);
    /// Adds a change that the program has made by itself (lights that a file animates) to the last step.
    void follow(const Settings& before, const Settings& after);
    /// Records a step if anything differs from the last one.
    void commit(const Settings& settings);
    /// Returns the name of each step: the settings that it has changed. The first is the beginning.
    std::vector<std::string> names() const;
    /// Index of the step that is shown.
    std::size_t at() const { return at_; }
    /// Goes to a step, clamped to the existing ones. Returns its settings.
    const Settings& go(std::size_t step);
    bool can_undo() const { return at_ > 0; }
    bool can_redo() const { return at_ + 1 < steps_.size(); }
    /// Goes one step back. Returns its settings; the present ones at the beginning.
    const Settings& undo();
    /// Goes one step forward. Returns its settings; the present ones at the end.
    const Settings& redo();
    /// Scene and preset of the step that is shown.
    const Place& place() const { return steps_[at_].place; }
    /// Settings of the step that is shown.
    const Settings& settings() const { return steps_[at_].settings; }
    /// Takes back the last undo or redo, after its scene could not be loaded.
    void stay();

private:
    static constexpr std::size_t kLimit = 500;
    const Settings& move_to(std::size_t step);

    struct Step {
        Settings settings;
        Place place;
        bool looks = false;  ///< only the camera moved; the next such move joins this step
    };
    std::vector<Step> steps_{Step{}};
    std::size_t at_ = 0;
    std::size_t before_ = 0;  ///< at_ before the last undo or redo
    Place present_;
    Settings untouched_;  ///< settings after the last step, with the program's own changes since
};

}  // namespace si
