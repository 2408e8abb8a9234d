// Draws the editor's frames on the calling thread, or on one with an OpenGL context of its own. The editor waits for
// that thread only briefly: the last picture stays, with its numbers, until the next one is there. A driver that
// compiles shaders at the first draw does not block the window.
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
#include "renderer/render/pass_progress.h"

namespace si {

/// Time that the editor waits for a frame. Frames that take less are shown at once.
inline constexpr std::chrono::milliseconds kFramePatience{40};

/// Thread that draws frames. Without a context there is none, and the calling thread draws.
struct FrameThread {
    ThreadContextMaker context;  ///< shares objects with the context that is current at construction
    std::function<void()> wake =
        {};  ///< called on that thread when a frame is done after the editor has stopped waiting
    std::chrono::milliseconds patience = kFramePatience;
};

/// Scheduler of the editor's frames. All calls come from one thread, whose OpenGL context stays the same.
class FrameLoader {
public:
    /// @param state, session of the editor; outlive this object @throws Error if the thread gets no OpenGL context
    FrameLoader(EditorState& state, FrameThread thread, SessionReport& session);
    ~FrameLoader();

    /// Returns true while a frame is being drawn. The scene must not change, and facts() are of the frame before.
    bool under_way() const;
    /// Returns true while a frame is being drawn, or is done and waits for poll().
    bool busy() const;
    /// Takes the facts of a frame that is done; its remarks go to the log. Returns true if the editor now shows
    /// something else.
    bool poll();
    /// Draws a frame if anything has changed, unless one is under way. Returns as poll() does.
    /// @param scene must not change while under_way() @param comparison settings that state.compare names; null: not
    /// known
    bool update(const Scene& scene, const EditorRequests& requests, const ComparisonFacts* comparison);
    /// Waits until no frame is under way.
    void wait() const;
    /// Drops the frame and its facts, when there is no scene.
    void clear();
    /// Releases memory that only further drawing would need, unless a frame is under way.
    void rest();

    const FrameFacts& facts() const { return facts_; }
    /// Returns the progress of the first picture; nothing if there is a picture, or none is being drawn.
    std::optional<DrawingFacts> first_picture() const;
    /// Returns true if first_picture() has changed since the last call.
    bool first_picture_moved();
    /// Writes the shown shadow map into a file. @throws Error
    void save_map(const Scene& scene, const std::string& path);
    /// Returns true if shader files have been saved since the last frame.
    bool poll_shaders() { return !under_way() && loop_->poll_shaders(); }

    /// Returns true while a frame is drawn, or rays of the picture are traced.
    bool tracing() const { return busy() || loop_->tracing(); }
    /// Returns true if poll() or update() has news of that work.
    bool tracing_moved() const { return !under_way() && (busy() || loop_->tracing_moved()); }
    /// Waits for that work.
    void finish_tracing() const {
        wait();
        loop_->finish_tracing();
    }
    /// Returns true if update() has the diagnosis of the probed pixel.
    bool probe_moved() const { return !under_way() && loop_->probe_moved(); }
    /// Waits for that diagnosis.
    void finish_probe() const {
        wait();
        loop_->finish_probe();
    }
    /// Background compilation of shaders; null: switched off.
    const ShaderWarmup* warmup() const { return loop_->warmup(); }

private:
    class DrawThread;
    class Copies;
    /// Runs `work` on the drawing thread and waits for it. @throws what the work throws
    void call(const std::function<void()>& work);
    /// Replaces the images of the next facts by copies. On a failure the facts hold the reason instead.
    void show_copies(GLsync shown);

    EditorState& state_;
    SessionReport& session_;
    const std::chrono::milliseconds patience_;
    FrameFacts facts_;
    PassProgress progress_;
    PassProgress::State seen_progress_;
    // Used by the drawing thread only, while a frame is under way.
    std::unique_ptr<FrameLoop> loop_;
    std::unique_ptr<Copies> copies_;
    FrameFacts next_facts_;
    FrameNews news_;
    EditorRequests missed_;                    ///< one-time requests that came while a frame was under way
    std::unique_ptr<DrawThread> draw_thread_;  ///< last: ends before what it uses
};

}  // namespace si
