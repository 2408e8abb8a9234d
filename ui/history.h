// Undo and redo: a stack of whole Settings values. A gesture (a drag, a turn of the wheel) is one step.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/settings.h"

namespace si {

class History {
public:
    /// Starts over from `settings` (a new scene or the start of the program).
    void reset(const Settings& settings);
    /// Call once a frame. While `busy` (a gesture is under way) nothing is recorded; afterwards whatever a person
    /// changed since the last step becomes one step.
    void observe(const Settings& settings, bool busy);
    /// The playing clock moved scene.time: no step, until commit().
    void tick(double time_s);
    /// Settings followed others by themselves (lights that a file animates): part of the step that made them, never one
    /// of their own.
    void follow(const Settings& before, const Settings& after);
    /// Records a step when anything at all differs from the last one.
    void commit(const Settings& settings);
    bool can_undo() const { return at_ > 0; }
    bool can_redo() const { return at_ + 1 < steps_.size(); }
    /// The neighbouring value; the present one at either end.
    const Settings& undo();
    const Settings& redo();

private:
    static constexpr std::size_t kLimit = 500;
    const Settings& move_to(std::size_t step);

    std::vector<Settings> steps_{Settings{}};
    std::size_t at_ = 0;
    Settings untouched_;  ///< what the settings are if nobody touched them since the last step
};

}  // namespace si
