// Has the editor's frames drawn: on the calling thread, or on one with an OpenGL context of its own, which is waited
// for only briefly. Then the last picture stays, with its numbers, until the next one is there, and whatever a driver
// does before it draws (it makes programs at the first draw) holds nobody up.
#pragma once

#include <epoxy/gl.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/context/thread_context.h"
#include "app/editor/frame_loop.h"
#include "app/editor/session_report.h"
#include "renderer/frame/pass_progress.h"

namespace si {

/// How long a frame is waited for: shorter ones are shown at once.
inline constexpr std::chrono::milliseconds kFramePatience{40};

/// A thread for frames. Without a context there is none.
struct FrameThread {
    ThreadContextMaker context;       ///< beside the one that is current where the desk is made
    std::function<void()> wake = {};  ///< called on that thread when a frame is done that nobody waits for
    std::chrono::milliseconds patience = kFramePatience;
};

/// All calls from one thread, whose OpenGL context stays the same.
class FrameDesk {
public:
    /// @param state, session of the editor, which live longer @throws Error when there is no OpenGL for the thread
    FrameDesk(EditorState& state, FrameThread thread, SessionReport& session);
    ~FrameDesk();

    /// A frame is being drawn: the scene must stay as it is, and facts() are of the one before.
    bool under_way() const;
    /// The same, or it was not taken yet.
    bool busy() const;
    /// Takes the frame that is done: facts, and remarks into the log. Returns whether the editor now shows something
    /// else.
    bool poll();
    /// Draws what changed, unless a frame is under way. Returns as poll() does.
    /// @param scene stays as it is while under_way() @param comparison what state.compare names; null: not known
    bool update(const Scene& scene, const EditorActions& actions, const ComparisonFacts* comparison);
    /// Until none is under way.
    void wait() const;
    /// There is no scene.
    void clear();
    /// Nothing is drawn for a while: gives memory back, unless a frame is under way.
    void rest();

    const FrameFacts& facts() const { return facts_; }
    /// How far the first picture is; nothing where there is one, or none is being drawn.
    std::optional<DrawingFacts> first_picture() const;
    /// first_picture() says something else than at the last call.
    bool first_picture_moved();
    void save_map(const Scene& scene, const std::string& path);
    /// Whether shader files were saved since the last frame.
    bool poll_shaders() { return !under_way() && loop_->poll_shaders(); }

    /// Rays of the picture are being traced, or it is drawn; poll() or update() has news of it.
    bool tracing() const { return busy() || loop_->tracing(); }
    bool tracing_moved() const { return !under_way() && (busy() || loop_->tracing_moved()); }
    void finish_tracing() const {
        wait();
        loop_->finish_tracing();
    }
    /// The truth of the probed pixel is sought.
    bool probe_moved() const { return !under_way() && loop_->probe_moved(); }
    void finish_probe() const {
        wait();
        loop_->finish_probe();
    }
    /// Null: nothing is foreseen.
    const Rehearsals* rehearsals() const { return loop_->rehearsals(); }

private:
    class Hand;
    class Copies;
    void call(const std::function<void()>& work);
    /// Has the next facts name copies, or say why there are none.
    void stand_in(GLsync shown);

    EditorState& state_;
    SessionReport& session_;
    const std::chrono::milliseconds patience_;
    FrameFacts facts_;
    PassProgress progress_;
    PassProgress::State seen_progress_;
    // The thread's while a frame is under way.
    std::unique_ptr<FrameLoop> loop_;
    std::unique_ptr<Copies> copies_;
    FrameFacts next_facts_;
    FrameNews news_;
    EditorActions missed_;        ///< wishes made while a frame was under way, which are made once
    std::unique_ptr<Hand> hand_;  ///< last: ends before what it uses
};

}  // namespace si
