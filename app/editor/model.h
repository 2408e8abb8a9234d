// What stands behind the editor's panels: its parts, and the wishes that each of them fulfils.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "app/context/imgui_session.h"
#include "app/editor/background_work.h"
#include "app/editor/editor.h"
#include "app/editor/frame_desk.h"
#include "app/editor/memory.h"
#include "app/editor/preset_work.h"
#include "app/editor/scene_desk.h"
#include "app/editor/session_report.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Needs a current OpenGL context all its life.
class EditorModel {
public:
    /// Starts to read the first scene. `read` makes scenes; empty: load_scene(). @throws UsageError, Error for what is
    /// wrong with the options themselves. @param thread that frames are drawn on; none: this one
    explicit EditorModel(const EditorOptions& options, SceneReader read = {}, FrameThread thread = {});

    EditorState state;
    bool asks_desktop = false;  ///< whoever calls can show the desktop's dialog for files: EditorActions::ask_desktop
    bool smooths = true;        ///< a picture that rests is made smooth, where view.smooth wishes it

    /// What draw_editor() is told. Valid until the next fulfil().
    EditorFrame facts() const;
    /// Does what the editor asked for and draws the scene when anything changed. Returns whether the next frame of the
    /// editor looks different. Errors go to the log.
    bool fulfil(const EditorActions& actions);
    /// A file dropped on the window: a preset (.json) or a scene. A scene is read in the background; a later fulfil()
    /// switches to it. Errors go to the log.
    void open(const std::filesystem::path& path);
    /// Saves the preset under a name that the desktop's dialog gave it. A file that was neither opened nor saved before
    /// is asked for once more. Errors go to the log.
    void save_as(const std::filesystem::path& path);
    /// Writes what was wished for out of a picture of the window that this frame drew. Errors go to the log.
    /// @param window top row first @param pixels of it per unit of the screen
    void save_shot(const ShotWish& wish, const ByteImage& window, float pixels);
    /// Writes the probe's drawing with its verdict and legend, where that was wished for: small in the panel, it is
    /// drawn anew. Returns whether it was.
    bool save_drawing(const ShotWish& wish, ImGuiSession& imgui);
    /// Whether shader files were saved since the last frame.
    bool poll_shaders() { return frames_.poll_shaders(); }
    /// A scene is being read, or the thread of a cancelled one has not ended yet.
    bool loading() const { return scenes_.loading().busy(); }
    /// Whether the next fulfil() has news of it, or its progress is to be drawn anew.
    bool loading_moved() const { return scenes_.loading().moved(); }
    bool drawing_moved() { return frames_.first_picture_moved(); }
    /// Something is being measured in the background.
    bool measuring() const { return work_.busy() || frames_.facts().readings.tracing_probe; }
    /// Whether the next fulfil() has news of it.
    bool measuring_moved() const { return work_.moved() || frames_.probe_moved(); }
    /// Waits until nothing is being measured.
    void finish_measuring() const {
        work_.finish();
        frames_.finish_probe();
    }
    /// Rays are being traced, or something is made of them.
    bool tracing() const { return frames_.tracing(); }
    /// Whether the next fulfil() has news of it, or its progress is to be drawn anew.
    bool tracing_moved() const { return frames_.tracing_moved(); }
    void finish_tracing() const { frames_.finish_tracing(); }
    /// Nothing was asked for during a while.
    void rest() { frames_.rest(); }
    /// Something is read, measured or traced in the background.
    bool busy() const { return loading() || measuring() || tracing(); }
    /// The picture shown stays while the wanted one is drawn.
    bool drawing() const { return frames_.busy(); }
    /// Waits for it. Returns whether the next frame of the editor looks different.
    bool finish_drawing() { return frames_.wait(), frames_.poll(); }
    /// Null without a thread for frames.
    const Rehearsals* rehearsals() const { return frames_.rehearsals(); }
    /// Waits for the scene that is being read and switches to it.
    void finish_loading() {
        frames_.wait();
        scenes_.finish();
    }
    /// @throws Error why there is no scene, or (headless) what of the options the first one lacks.
    void require_scene() const { scenes_.require(); }
    /// Remarks about the first scene.
    const std::vector<std::string>& notes() const { return scenes_.notes(); }
    /// Call now and then, also while nothing is drawn: keeps what a crash would lose.
    void keep();
    /// At once, before an end that is not clean.
    void keep_now() { memory_.follow(state, std::numeric_limits<double>::infinity()); }
    /// The window has this size in screen coordinates at scale 1.
    void keep_window(int width, int height, bool maximised) { memory_.note_window(width, height, maximised); }
    /// The end: what no preset holds is kept and offered again.
    void end() {
        memory_.end(state, presets_.would_be_lost());
        session_.write(state.log);
    }
    /// What became of this session.
    SessionReport& session() { return session_; }

private:
    void copy_command_line();
    /// Of the probed pixel, under view.light; null: there is none.
    const Section* classified_section() const;
    /// Of the scene, in pixels.
    glm::ivec2 picture_size() const;

    /// Asks who holds memory, while a panel shows it; not at every frame.
    void follow_memory(bool wanted);

    const bool check_numeric_;
    const bool offers_pictures_;  ///< screenshots to the clipboard, too
    SessionReport session_;
    std::optional<MemoryFacts> held_;
    double held_at_s_ = 0;
    EditorMemory memory_;
    SceneDesk scenes_;
    PresetWork presets_;
    FrameDesk frames_;
    BackgroundWork work_;
};

}  // namespace si
