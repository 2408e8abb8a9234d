// --check-numeric of commands that draw many frames: all are searched, and the first with a fault is named.
#pragma once

#include <string>

#include "renderer/render/renderer.h"

namespace si {

/// "KEY=VALUE" of all that differs from the settings `base`, with --set before each; empty: nothing does.
std::string sets_beyond(const Settings& base, const Settings& settings);

/// While it lives, every picture that the renderer draws is searched, but for those that are timed.
class NumberWatch {
public:
    /// @param base settings that the first fault's own are told beyond @param on false: nothing is searched
    NumberWatch(Renderer& renderer, Settings base, bool on);
    ~NumberWatch();
    NumberWatch(const NumberWatch&) = delete;
    NumberWatch& operator=(const NumberWatch&) = delete;

    /// @throws Error that names the first case with a fault, what was found there and where, unless all were sound
    void require_sound() const;

private:
    Renderer& renderer_;
    const Settings base_;
    const bool on_;
    std::string first_;  ///< fault; empty: none
    std::size_t frames_ = 0, unsound_ = 0;
};

}  // namespace si
