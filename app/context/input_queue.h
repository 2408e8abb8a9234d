// Queue of mouse and key events that feeds ImGui in steps. ImGui loses the order of events within one frame, so each
// event that acts on a widget gets a frame of its own, however many events arrived during a slow frame.
#pragma once

#include <bitset>
#include <cstddef>
#include <deque>
#include <glm/glm.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "app/context/mouse_queue.h"

namespace si {

/// Queue between the window and ImGui. The window's callbacks add mouse and key events. Each ImGui frame takes one
/// step: as many events as ImGui can handle without losing their order.
class InputQueue {
public:
    static constexpr std::size_t kKeys = 512;  ///< size of ImGui's key table

    /// Press or release of a key on the keyboard.
    struct Key {
        int key = 0;   ///< GLFW_KEY_*
        int mods = 0;  ///< GLFW_MOD_*
        bool down = false;
    };
    /// Key presses and releases, typed characters and wheel movement that one ImGui frame receives.
    struct Strokes {
        std::vector<Key> keys;  ///< a key that also goes up in this step counts as held during it
        std::vector<unsigned> characters;
        glm::dvec2 wheel{0};
    };

    /// Adds a press or release of a mouse button to the queue of input events.
    /// @param mods modifiers that are held (GLFW_MOD_*)
    /// @param when interval of time in which the press or release happened
    void button(int button, bool down, int mods, const MouseQueue::When& when);
    /// Sets the position of the mouse in the window, in screen coordinates, for the events that follow.
    void move(glm::dvec2 to) { mouse_.move(to); }
    /// Records that the mouse has entered or left the window. @param inside true: entered
    void enter(bool inside) { mouse_.enter(inside); }
    /// Adds a turn of the mouse wheel to the queue. @param by notches, horizontal and vertical
    void wheel(glm::dvec2 by) { waiting_.push_back({.kind = Kind::Wheel, .at = mouse_.last_position(), .wheel = by}); }
    /// Adds a press or release of a key to the queue of input events.
    void key(const Key& key);
    /// Adds a typed character to the queue of input events. It belongs to the text key that was pressed right before.
    /// @param code Unicode code point
    void character(unsigned code);
    /// Sets whether a text field has the focus. Text keys then only type, and any number of them fits into one ImGui
    /// frame.
    void typing(bool typing) { typing_ = typing; }

    /// Takes the events for the next ImGui frame from the queue. Returns the state of the mouse in that frame;
    /// take_strokes() returns keys, characters and wheel.
    MouseQueue::Step next();
    /// Returns keys, characters and wheel movement for the ImGui frame that next() began; empty when called again.
    Strokes take_strokes() { return std::exchange(strokes_, {}); }
    /// Returns true if no input event waits for an ImGui frame.
    bool empty() const { return waiting_.empty(); }
    /// Returns true if the key is held after the events that next() took last. @param key GLFW_KEY_*
    bool is_down(int key) const { return key >= 0 && std::size_t(key) < kKeys && held_[std::size_t(key)]; }

private:
    enum class Kind { Button, Key, Character, Wheel };
    /// Input event (mouse button, key, character or wheel) that waits in the queue for an ImGui frame.
    struct Event {
        Kind kind = Kind::Button;           ///< Button: details are in the queue of `mouse_`
        std::optional<glm::dvec2> at;       ///< place of the mouse
        Key key;                            ///< for Kind::Key
        std::optional<unsigned> character;  ///< for Kind::Character, and for a text key
        glm::dvec2 wheel{0};
    };
    /// Summary of the input events that the next ImGui frame has received so far. It decides whether one more event may
    /// join them.
    struct Run {
        std::optional<glm::dvec2> at;  ///< the mouse
        bool pressed = false, typed = false, wheeled = false;
        bool command = false;   ///< Ctrl, Alt or Super went down
        bool left_alt = false;  ///< Alt or Super went up: ImGui enters a menu, unless text was typed
        int mods = 0;           ///< modifiers of the key that was pressed
        std::bitset<kKeys> down;
    };
    /// Returns true for a key event that types a character into the focused text field.
    bool is_text(const Event& event) const { return event.kind == Kind::Character || (typing_ && event.character); }
    /// Returns true if ImGui keeps the order of an input event and the earlier events of `run` within one frame. The
    /// event may then share their frame.
    bool can_join(const Run& run, const Event& event) const;
    /// Returns true if ImGui keeps the order of a key event and the earlier events of `run` within one frame. The event
    /// may then share their frame.
    bool key_can_join(const Run& run, const Event& event) const;
    /// Adds an input event to those that the next ImGui frame receives, and updates their summary `run`.
    void add_to_step(Run& run, const Event& event);

    MouseQueue mouse_;
    std::deque<Event> waiting_;
    Strokes strokes_;
    std::bitset<kKeys> held_, shown_;  ///< keys that are held after the last step; keys shown as held during that step
    bool typing_ = false;
};

}  // namespace si
