// Undo and redo: a stack of whole Settings values. A gesture (a drag, a turn of the wheel) is one step.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "renderer/settings/settings.h"

namespace si {

/// Note about the preset that was opened last: title and description, shown in a strip above the pictures.
struct GuideNote {
    std::string key;  ///< key of a built-in preset, or the file's path; empty: none is open
    std::string title;
    std::string about;  ///< sentence on what to look at
    bool operator==(const GuideNote&) const = default;
};

/// Scene and preset that a step of the undo history belongs to.
struct Place {
    std::string scene;  ///< built-in key or path; empty: any
    GuideNote guide;
};

/// History of settings for undo and redo, with the whole settings of each step.
class History {
public:
    /// Drops all steps of the undo history and begins a new history with `settings`. Call at the start of the program,
    /// and when the program has loaded its first scene.
    void reset(const Settings& settings);
    /// Sets the scene and preset to which the next recorded step of undo belongs. record() also makes a step for a
    /// change of scene alone.
    void set_place(Place place) { present_ = std::move(place); }
    /// Records changed settings as a step of undo. Call once a frame. Consecutive moves of the camera are one step.
    /// @param busy true: a gesture such as a drag is under way and nothing is recorded; all its changes become one step
    /// afterwards
    void record(const Settings& settings, bool busy);
    /// Sets the time of a playing animation (scene.time, seconds) that record() takes as unchanged, so that playing
    /// adds no step of undo each frame. Call commit() when the animation stops.
    void set_time(double time_s);
    /// Adds a change of settings that the program itself made to the present step of undo. For instance, a light that a
    /// file animates gets new settings. Makes no new step. @param before, after settings before and after the change
    void amend_step(const Settings& before, const Settings& after);
    /// Records a step of undo at once, also during a gesture, if `settings` differ from the present step's. Steps that
    /// could be redone are dropped.
    void commit(const Settings& settings);
    /// Returns a name for each step of undo, oldest first: the settings that the step changed, or its scene or preset.
    /// The first step, which changes nothing, is named "the beginning".
    std::vector<std::string> names() const;
    /// Returns the index of the present step of the undo history; 0: the oldest.
    std::size_t index() const { return at_; }
    /// Goes to a step of the undo history and returns the step's settings. @param step the index of the step, clamped
    /// to the existing ones
    const Settings& go_to(std::size_t step);
    /// Returns true if the undo history has a step before the present one.
    bool can_undo() const { return at_ > 0; }
    /// Returns true if the undo history has a step after the present one.
    bool can_redo() const { return at_ + 1 < steps_.size(); }
    /// Goes one step back in the undo history and returns that step's settings. Stays at the first step.
    const Settings& undo();
    /// Goes one step forward in the undo history and returns that step's settings. Stays at the last step.
    const Settings& redo();
    /// Returns the scene and preset of the present step of the undo history.
    const Place& place() const { return steps_[at_].place; }
    /// Returns the settings of the present step of the undo history.
    const Settings& settings() const { return steps_[at_].settings; }
    /// Reverts the last undo(), redo() or go_to(). Call when the scene of the new step could not be loaded.
    void cancel_move();

private:
    static constexpr std::size_t kLimit = 500;
    /// Makes a step of the undo history the present one, and returns its settings. @param step the index of an existing
    /// step
    const Settings& show_step(std::size_t step);

    /// Step of the undo history: settings with their scene and preset.
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
