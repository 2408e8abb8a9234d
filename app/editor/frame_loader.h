// Draws the editor's frames on the calling thread, or on a drawing thread with an OpenGL context of its own. The editor
// waits for the drawing thread only briefly: the last picture stays, with its numbers, until the next picture is
// finished. A driver that compiles shaders at the first draw does not block the window.
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

/// Longest time that the editor waits for the drawing thread to finish a frame. A slower frame is shown later.
inline constexpr std::chrono::milliseconds kFramePatience{40};

/// Options of the thread that draws the editor's frames. Without a context, frames are drawn on the calling thread.
struct FrameThread {
    ThreadContextMaker context;  ///< makes the thread's context, which shares the editor's objects; empty: no thread
    std::function<void()> wake =
        {};  ///< called on the drawing thread when it finishes a frame that the editor no longer waits for
    std::chrono::milliseconds patience = kFramePatience;
};

/// Renderer of the editor's frames on a thread of its own, so that a slow frame does not block the window. update()
/// starts a frame, and poll() fetches its data. Make all calls from one thread with one OpenGL context.
class FrameLoader {
public:
    /// Makes the renderer and, if `thread` has a context maker, the drawing thread.
    /// @param state, session parts of the editor, which must outlive this object
    /// @throws Error if the thread gets no OpenGL context
    FrameLoader(EditorState& state, FrameThread thread, SessionReport& session);
    ~FrameLoader();

    /// Returns true while the drawing thread draws a frame. Meanwhile the scene must not change, and facts() describe
    /// the frame before.
    bool under_way() const;
    /// Returns true while a frame is being drawn, or a finished frame waits for poll().
    bool busy() const;
    /// Fetches the data of a finished frame from the drawing thread, and logs the frame's errors and remarks. Call once
    /// a frame of the window. Returns true if the editor has to be drawn again.
    bool poll();
    /// Starts to draw a frame if anything has changed and no frame is under way. Waits briefly for the frame
    /// (FrameThread::patience). Returns true if the editor has to be drawn again.
    /// @param scene must not change while under_way()
    /// @param comparison settings to compare the picture with (state.compare); null: not loaded yet
    bool update(const Scene& scene, const EditorRequests& requests, const ComparisonFacts* comparison);
    /// Waits until the drawing thread has finished the frame under way.
    void wait() const;
    /// Drops the last drawn frame and its data. Call while the editor shows no scene.
    void clear();
    /// Releases memory that is needed only to draw further frames. Does nothing while a frame is under way. Call when
    /// the editor is idle.
    void release_unused_memory();

    const FrameFacts& facts() const { return facts_; }
    /// Returns the progress of drawing a scene's first picture, for the progress bar. Returns nothing if a picture is
    /// shown already, or none is being drawn.
    std::optional<DrawingFacts> first_picture() const;
    /// Returns true if the progress of drawing a scene's first picture has changed since the last call.
    bool first_picture_moved();
    /// Draws a view of the shown frame (the picture, or a depth map) into a file, in the format of its extension.
    /// @throws Error
    void save_view(const Scene& scene, const View& view, const std::string& path);
    /// Reads changed shader files again. Returns true if shader files have changed since the last drawn frame, so that
    /// the scene has to be drawn again. Does nothing and returns false while a frame is under way.
    bool poll_shaders() { return !under_way() && loop_->poll_shaders(); }

    /// Returns true while a frame is drawn, or ray-traced references, light maps or saved errors are computed for it.
    bool tracing() const { return busy() || loop_->reference().busy(); }
    /// Returns true if a finished frame waits for poll(), or the next update() will have new results or progress of ray
    /// tracing.
    bool tracing_moved() const { return !under_way() && (busy() || loop_->reference().has_news()); }
    /// Waits until the frame under way is drawn, and all ray tracing for it has ended.
    void finish_tracing() const {
        wait();
        loop_->reference().wait();
    }
    /// Returns true if the next update() will have the diagnosis of the probed pixel.
    bool probe_moved() const { return !under_way() && loop_->read_back().has_news(); }
    /// Waits until the next update() can diagnose the probed pixel.
    void finish_probe() const {
        wait();
        loop_->read_back().finish_tracing();
    }
    /// Returns the background compilation of shaders; null: switched off.
    const ShaderWarmup* warmup() const { return loop_->warmup(); }

private:
    class DrawThread;
    class Copies;
    /// Runs a function on the drawing thread, which owns the renderer, and waits until the function has returned. A
    /// frame under way is finished first. @throws the function's exceptions
    void call(const std::function<void()>& work);
    /// Replaces the images of a finished frame by copies, which the window shows while the next frame overwrites the
    /// originals. If copying fails, the frame has no picture, and FrameFacts::problem states the reason.
    /// @param shown fence that is signalled when the window no longer uses earlier copies, which are then overwritten
    void show_copies(GLsync shown);

    EditorState& state_;
    SessionReport& session_;
    const std::chrono::milliseconds patience_;
    FrameFacts facts_;
    PassProgress progress_;
    PassProgress::State seen_progress_;
    // Used by the drawing thread only, while a frame is under way.
    std::unique_ptr<FrameLoop> loop_;
    std::unique_ptr<Copies> frame_copies_;
    FrameFacts next_facts_;
    FrameNews news_;
    EditorRequests missed_;                    ///< one-time requests that came while a frame was under way
    std::unique_ptr<DrawThread> draw_thread_;  ///< declared last, so that its thread ends first
};

}  // namespace si
