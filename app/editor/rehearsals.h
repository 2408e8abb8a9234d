// Makes the programs of a frame before it is drawn, on a thread with an OpenGL context of its own, so that the editor
// shows the last picture meanwhile and then draws the new one without a hitch. What one context of a driver has made,
// another finds in the driver's cache of shaders; where there is none, a frame waits for its programs as before.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <set>
#include <thread>

#include "renderer/frame/renderer.h"

namespace si {

/// A frame whose programs are wanted.
struct Rehearsal {
    std::uint64_t key = 0;               ///< Renderer::programs_key()
    std::shared_ptr<const Scene> scene;  ///< stand_in() of the frame's
    Settings settings;
    FrameRequest request;
    bool probe = false;  ///< its programs for probed pixels too
};

class Rehearsals {
public:
    Rehearsals();
    /// Waits for the one under way.
    ~Rehearsals();

    /// In place of what was wanted and has not begun: a frame waits for it.
    void want(Rehearsal rehearsal);
    /// When nothing was wanted for a while: no frame waits for it.
    void foresee(Rehearsal rehearsal);
    /// Programs of that key were made: here, or by who draws.
    bool knows(std::uint64_t key) const;
    /// A frame waits for them.
    bool is_wanted(std::uint64_t key) const;
    /// Nothing is waited for any more. @param key of programs that were made; 0: none
    void learn(std::uint64_t key);
    /// Those of another scene or other shader files are no longer those meant.
    void forget();

    /// A frame waits.
    bool busy() const;
    /// Since the last knows(), a wanted one was done.
    bool moved() const;
    /// Until none is wanted.
    void wait() const;
    /// Until none is wanted or foreseen.
    void wait_for_all() const;
    /// How many were carried out.
    std::size_t done() const;

private:
    struct Stage;
    /// One thread carries out what is wanted, one what is foreseen, as that may take seconds.
    void run(const std::stop_token& end, bool foreseen);
    std::unique_ptr<Rehearsal> take_wanted(const std::stop_token& end);
    std::unique_ptr<Rehearsal> take_foreseen(const std::stop_token& end);

    mutable std::mutex mutex_;
    mutable std::condition_variable_any changed_;
    std::unique_ptr<Rehearsal> wanted_;
    std::deque<Rehearsal> foreseen_;
    std::uint64_t waited_for_ = 0;  ///< key of what a frame waits for; 0: none
    std::set<std::uint64_t> known_;
    std::uint64_t age_ = 0;  ///< counts forget()
    std::size_t done_ = 0, asked_ = 0;
    int working_ = 0;  ///< threads
    mutable bool moved_ = false;
    std::jthread wanting_, foreseeing_;  ///< last: end before what they use
};

}  // namespace si
