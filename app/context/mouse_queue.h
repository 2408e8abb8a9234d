// What the mouse did, in the order in which it did it: a frame shows one press or release, at its place, and what is a
// double click is told by when presses arrived, however long frames take: where that cannot be known, in their favour.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <glm/glm.hpp>
#include <limits>
#include <optional>

namespace si {

class MouseQueue {
public:
    static constexpr int kButtons = 5;
    static constexpr double kDoubleClickSeconds = 0.3;  ///< between presses

    /// When an event was made that waited until it was asked for, nobody knows better than between two times.
    struct When {
        double earliest_s = 0, latest_s = 0;
    };
    /// @param mods that are held, as the window system has them
    void button(int button, bool down, int mods, const When& when);
    void move(glm::dvec2 to) { at_ = to; }
    /// The mouse came into the window, or left it: where it is outside nobody says.
    void enter(bool inside) { inside_ = inside; }

    struct Step {
        std::array<bool, kButtons> down{};
        std::optional<glm::dvec2> at;  ///< none: not known
        std::optional<int> mods;       ///< held at that press or release; none: those of now
        bool doubles = false;          ///< the press makes a double click of the one before
    };
    /// What the next frame is to show. Where the place of a press or release is a new one, first the mouse there.
    Step next();
    /// A frame in which the mouse does nothing, and is where it was at something else that waited.
    Step stay(std::optional<glm::dvec2> at);
    /// Where it is after all that waits; none: not known.
    std::optional<glm::dvec2> at() const;
    std::size_t waiting() const { return waiting_.size(); }
    bool empty() const { return waiting_.empty(); }

private:
    struct Change {
        int button = 0, mods = 0;
        bool down = false, doubles = false;
        std::optional<glm::dvec2> at;
    };
    std::deque<Change> waiting_;
    std::array<double, kButtons> pressed_s_ = [] {
        std::array<double, kButtons> never{};
        never.fill(-std::numeric_limits<double>::infinity());
        return never;
    }();
    std::array<bool, kButtons> down_{};     ///< as frames were shown it
    std::optional<glm::dvec2> at_, shown_;  ///< of the last event; of the last frame
    bool inside_ = true;
};

}  // namespace si
