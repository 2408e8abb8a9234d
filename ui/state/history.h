// Undo and redo: a stack of whole Settings values. A gesture (a drag, a turn of the wheel) is one step.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "renderer/settings/settings.h"

namespace si {

/// What the preset that was opened last says to people.
struct GuideNote {
    std::string key;  ///< of a built-in preset, or the file's path; empty: none is open
    std::string title, about;
    bool operator==(const GuideNote&) const = default;
};

/// What settings belong to.
struct Place {
    std::string scene;  ///< built-in key or path; empty: any
    GuideNote guide;
};

class History {
public:
    /// Starts over from `settings` (a new scene or the start of the program).
    void reset(const Settings& settings);
    /// What the settings of the next step belong to. Another scene is a step of its own.
    void set_place(Place place) { present_ = std::move(place); }
    /// Call once a frame. While `busy` (a gesture is under way) nothing is recorded; afterwards whatever a person
    /// changed since the last step becomes one step. Moves of the camera in a row are one.
    void observe(const Settings& settings, bool busy);
    /// The playing clock moved scene.time: no step, until commit().
    void tick(double time_s);
    /// Settings followed others by themselves (lights that a file animates): part of the step that made them, never one
    /// of their own.
    void follow(const Settings& before, const Settings& after);
    /// Records a step when anything at all differs from the last one.
    void commit(const Settings& settings);
    /// What each step changed, the first being the beginning, and which of them is shown.
    std::vector<std::string> names() const;
    std::size_t at() const { return at_; }
    /// That step, clamped to those there are.
    const Settings& go(std::size_t step);
    bool can_undo() const { return at_ > 0; }
    bool can_redo() const { return at_ + 1 < steps_.size(); }
    /// The neighbouring value; the present one at either end.
    const Settings& undo();
    const Settings& redo();
    /// What the last step that was recorded, undone or redone belongs to, and its settings.
    const Place& place() const { return steps_[at_].place; }
    const Settings& settings() const { return steps_[at_].settings; }
    /// The last undo or redo did not come about: stands where it stood before.
    void stay();

private:
    static constexpr std::size_t kLimit = 500;
    const Settings& move_to(std::size_t step);

    struct Step {
        Settings settings;
        Place place;
        bool looks = false;  ///< only the camera moved: the next such move is the same step
    };
    std::vector<Step> steps_{Step{}};
    std::size_t at_ = 0, before_ = 0;  ///< before_: of the last undo or redo
    Place present_;
    Settings untouched_;  ///< what the settings are if nobody touched them since the last step
};

}  // namespace si
