// What mouse and keys did, in the order in which they did it, as steps for ImGui: in a frame it tells no order, so that
// what acts on a widget gets one of its own, however many events a slow frame left behind.
#pragma once

#include <bitset>
#include <cstddef>
#include <deque>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "app/context/mouse_queue.h"

namespace si {

class InputQueue {
public:
    static constexpr std::size_t kKeys = 512;  ///< as many as ImGui has

    struct Key {
        int key = 0;   ///< GLFW_KEY_*
        int mods = 0;  ///< GLFW_MOD_*
        bool down = false;
    };
    /// What a step tells beside the mouse's place and buttons.
    struct Strokes {
        std::vector<Key> keys;  ///< one that also goes up is to be seen held during the step
        std::vector<unsigned> characters;
        glm::dvec2 wheel{0};
    };

    void button(int button, bool down, int mods, const MouseQueue::When& when);
    void move(glm::dvec2 to) { mouse_.move(to); }
    void enter(bool inside) { mouse_.enter(inside); }
    void wheel(glm::dvec2 by);
    void key(const Key& key);
    /// It belongs to the key that went down right before, if that is one that types.
    void character(unsigned code);
    /// Whether a field takes what is typed: keys that type then do nothing else, and any number of them makes a step.
    void typing(bool typing) { typing_ = typing; }

    /// Goes on to the next step. @returns the mouse in it
    MouseQueue::Step next();
    /// The rest of that step; once.
    Strokes take_strokes();
    bool empty() const { return waiting_.empty(); }
    /// Held after the step.
    bool is_down(int key) const { return key >= 0 && std::size_t(key) < kKeys && held_[std::size_t(key)]; }

private:
    enum class Kind { Button, Key, Character, Wheel };
    struct Event {
        Kind kind = Kind::Button;           ///< a button's change is the next that the mouse's queue holds
        std::optional<glm::dvec2> at;       ///< the mouse
        Key key;                            ///< of a key
        std::optional<unsigned> character;  ///< of a character, or of a key that types
        glm::dvec2 wheel{0};
    };
    /// What is in a step already.
    struct Run {
        std::optional<glm::dvec2> at;  ///< the mouse
        bool pressed = false, typed = false, wheeled = false;
        bool command = false;   ///< Ctrl, Alt or Super went down
        bool left_alt = false;  ///< Alt or Super went up: ImGui enters a menu, unless something is typed
        int mods = 0;           ///< of what was pressed
        std::bitset<kKeys> down;
    };
    bool is_text(const Event& event) const;
    bool joins(const Run& run, const Event& event) const;
    bool key_joins(const Run& run, const Event& event) const;
    void show(Run& run, const Event& event);

    MouseQueue mouse_;
    std::deque<Event> waiting_;
    Strokes strokes_;
    std::bitset<kKeys> held_, shown_;  ///< after the last step; during it
    bool typing_ = false;
};

}  // namespace si
