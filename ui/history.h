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
    /// Call once a frame. While `busy` (a gesture is under way) nothing is recorded; afterwards whatever differs
    /// from the last recorded value becomes one step.
    void observe(const Settings& settings, bool busy);
    bool can_undo() const { return at_ > 0; }
    bool can_redo() const { return at_ + 1 < steps_.size(); }
    /// The neighbouring value; the present one at either end.
    const Settings& undo();
    const Settings& redo();

private:
    static constexpr std::size_t kLimit = 500;
    std::vector<Settings> steps_{Settings{}};
    std::size_t at_ = 0;
};

}  // namespace si
