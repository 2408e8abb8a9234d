// Queue of mouse events. Each frame shows at most one press or release, at the place where it happened. Double clicks
// are decided by the times of the presses, not by the length of frames; an unknown time counts as soon enough.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <glm/glm.hpp>
#include <limits>
#include <optional>

namespace si {

/// Queue of mouse presses, releases and moves between the window and ImGui. Each ImGui frame takes at most one press or
/// release, so that none is lost in a slow frame.
class MouseQueue {
public:
    static constexpr int kButtons = 5;
    static constexpr double kDoubleClickSeconds = 0.3;  ///< limit of the time between the presses of a double click

    /// Time interval in which a mouse event happened, seconds. Events that wait until the window polls have no exact
    /// time.
    struct When {
        double earliest_s = 0, latest_s = 0;
    };
    /// Adds a press or release of a mouse button to the queue, at the present place of the mouse.
    /// @param mods modifiers that are held (GLFW_MOD_*)
    /// @param when interval of time in which the press or release happened
    void button(int button, bool down, int mods, const When& when);
    /// Sets the position of the mouse in the window, in screen coordinates, for the events that follow.
    void move(glm::dvec2 to) { at_ = to; }
    /// Records that the mouse has entered or left the window. Outside the window, its position is unknown unless a
    /// button is held. @param inside true: entered
    void enter(bool inside) { inside_ = inside; }

    /// State of the mouse in one ImGui frame, with at most one new press or release.
    struct Step {
        std::array<bool, kButtons> down{};
        std::optional<glm::dvec2> at;  ///< none: not known
        std::optional<int> mods;       ///< modifiers held at that press or release; none: the present ones
        bool doubles = false;          ///< the press completes a double click
    };
    /// Takes the next press or release from the queue and returns the state of the mouse for the next ImGui frame. If
    /// the mouse must move to a new place first, the press or release follows in a later frame.
    Step next();
    /// Returns the state of the mouse for an ImGui frame in which no button changes. @param at place of the mouse in
    /// that frame; none: unknown
    Step step_without_change(std::optional<glm::dvec2> at);
    /// Returns the place of the mouse after all events that wait in the queue, in screen coordinates. Outside the
    /// window, the place is known only while a button is held, or a press or release waits. A drag can therefore leave
    /// the window. Returns nothing if the place is unknown.
    std::optional<glm::dvec2> last_position() const;
    /// Returns the number of mouse presses and releases that wait for an ImGui frame.
    std::size_t waiting() const { return waiting_.size(); }
    /// Returns true if no mouse press or release waits for an ImGui frame.
    bool empty() const { return waiting_.empty(); }

private:
    /// Press or release of a mouse button that waits in the queue for an ImGui frame.
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
    std::array<bool, kButtons> down_{};     ///< buttons in the last frame
    std::optional<glm::dvec2> at_, shown_;  ///< place at the last event; place in the last frame
    bool inside_ = true;
};

}  // namespace si
