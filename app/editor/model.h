// The editor without its window: its parts, and the fulfilment of the panels' requests.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/context/imgui_session.h"
#include "app/editor/background_work.h"
#include "app/editor/bundle_export.h"
#include "app/editor/conversion_preview.h"
#include "app/editor/editor.h"
#include "app/editor/frame_import.h"
#include "app/editor/frame_loader.h"
#include "app/editor/persistence.h"
#include "app/editor/preset_requests.h"
#include "app/editor/report_export.h"
#include "app/editor/scene_loader.h"
#include "app/editor/session_report.h"
#include "app/report/views.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Editor without its window: state, scene, frames and background work. Needs a current OpenGL context all its life.
class EditorModel {
public:
    /// Starts to read the first scene. @param read makes scenes; empty: load_scene()
    /// @param thread thread that draws frames; none: the calling one @throws UsageError, Error for faulty options
    explicit EditorModel(const EditorOptions& options, SceneReader read = {}, FrameThread thread = {});

    EditorState state;
    bool has_desktop_dialog =
        false;            ///< the caller can show the desktop's file dialog (EditorRequests::open_desktop_dialog)
    bool smooths = true;  ///< static pictures get more samples per pixel, if view.smooth is on

    /// Returns the facts that draw_editor() shows. Pointers in them stay valid until the next fulfil().
    EditorFrame facts() const;
    /// Fulfils the requests that panels made in draw_editor(), and draws the scene if anything has changed. Returns
    /// true if the editor has to be drawn again. Errors go to the log.
    bool fulfil(const EditorRequests& requests);
    /// Opens a file that was dropped on the window: a preset (.json), a scene, or a frame of another engine, which
    /// becomes a bundle first (FrameImport). Reads a scene in the background; a later fulfil() switches to it. Errors
    /// go to the log.
    void open(const std::filesystem::path& path);
    /// Saves the settings as a preset in the file that the user chose in the desktop's file dialog. Before it replaces
    /// a file that this editor has neither opened nor saved, the editor opens its own question and waits for the
    /// answer. Errors go to the log.
    void save_as(const std::filesystem::path& path);
    /// Writes a screenshot of the window or a part of it into a file. Errors go to the log.
    /// @param window picture of the window, top row first @param pixels its pixels per unit of the screen
    void save_shot(const ShotRequest& request, const ByteImage& window, float pixels);
    /// Writes the probed pixel's cross-section with verdict and legend into a file, drawn in a readable size. Does
    /// nothing and returns false if the request is for another kind of screenshot, or no cross-section is shown.
    bool save_drawing(const ShotRequest& request, ImGuiSession& imgui);
    /// Looks whether other programs have saved the scene's files. Call regularly, also while nothing is drawn. Returns
    /// true if the editor has to be drawn again. @param now_s time of a steady clock, seconds
    bool follow_scene_files(double now_s) { return scenes_.follow_files(now_s); }
    /// Looks for saved scene files like the function above, at the present time.
    bool follow_scene_files();
    /// Returns true if shader files have been saved since the last frame.
    bool poll_shaders() { return frames_.poll_shaders(); }
    /// Returns true while a scene is read or imported, or the thread of a cancelled one has not ended.
    bool loading() const { return scenes_.loading().busy() || import_.busy(); }
    /// Returns true if the next fulfil() has a loaded scene, or the progress of loading has changed.
    bool loading_moved() const { return scenes_.loading().moved() || import_.moved(); }
    /// Returns true if the progress of the first picture has changed.
    bool drawing_moved() { return frames_.first_picture_moved(); }
    /// Returns true while something is measured in the background.
    bool measuring() const {
        return work_.busy() || export_.busy() || report_.busy() || presets_.pictures().busy() ||
               frames_.facts().readings.tracing_probe;
    }
    /// Returns true if the next fulfil() has results of a background measurement.
    bool measuring_moved() const {
        return work_.moved() || export_.moved() || report_.moved() || presets_.pictures().moved() ||
               frames_.probe_moved();
    }
    /// Waits until nothing is being measured.
    void finish_measuring() const {
        work_.finish();
        export_.finish();
        report_.finish();
        presets_.pictures().wait();
        frames_.finish_probe();
    }
    /// Returns true while rays are traced, or errors are computed from them.
    bool tracing() const { return frames_.tracing(); }
    /// Returns true if the next fulfil() has traced rays, or the progress of tracing has changed.
    bool tracing_moved() const { return frames_.tracing_moved(); }
    void finish_tracing() const { frames_.finish_tracing(); }
    /// Releases memory that only further drawing would need. Call when nothing has happened for a while.
    void release_unused_memory() { frames_.release_unused_memory(); }
    /// Returns true while something is read, measured or traced in the background.
    bool busy() const { return loading() || measuring() || tracing(); }
    /// Returns true while a frame is drawn and the last picture is still shown.
    bool drawing() const { return frames_.busy(); }
    /// Waits for the frame that is being drawn. Returns true if the editor has to be drawn again.
    bool finish_drawing() {
        frames_.wait();
        return frames_.poll();
    }
    /// Returns the background compilation of shaders; null without a thread for frames.
    const ShaderWarmup* warmup() const { return frames_.warmup(); }
    /// Waits for the scene that is being read and switches to it.
    void finish_loading() {
        frames_.wait();
        import_.finish();
        scenes_.finish();
    }
    /// Checks that there is a scene. @throws Error if not. An editor without a window also throws if the first scene
    /// lacks something that the options name
    void require_scene() const { scenes_.require(); }
    /// Returns the remarks about the first scene.
    const std::vector<std::string>& notes() const { return scenes_.notes(); }
    /// Writes autosave, workspace and session report, each when it is due. Call regularly, also while nothing is drawn.
    void write_when_due();
    /// Writes autosave, workspace and session report at once, before an unclean end. Errors go to the log.
    void save_before_crash();
    /// Remembers the window's size (screen coordinates at scale 1).
    void note_window_size(int width, int height, bool maximised) { persistence_.note_window(width, height, maximised); }
    /// Writes workspace and report at the end. Settings that no preset holds are offered at the next start.
    void end() {
        persistence_.end(state, presets_.would_be_lost());
        session_.write(state.log);
    }
    /// Returns the session report (`edit --report`).
    SessionReport& session() { return session_; }

private:
    /// Opens a scene, or begins to import a file that becomes a bundle. @param name built-in key or path @throws Error
    void open_scene(const std::string& name);
    /// Exports the shown frame. A file that exists is asked for first. @param replace the user has agreed @throws Error
    void export_file(const ExportRequest& wanted, bool replace);
    /// Returns the view that is exported as a kind of file: the picture, or the shown depth map.
    View shown_view(ExportKind kind) const;
    /// Copies a command line that draws the present picture to the clipboard.
    void copy_command_line();
    /// Returns the probed pixel's cross-section for view.light; null: there is none.
    const Section* shown_section() const;
    /// Returns the size of the scene's picture, pixels.
    glm::ivec2 picture_size() const;

    /// Samples the process's memory at intervals. @param wanted a panel shows the memory
    void follow_memory(bool wanted);

    const bool check_numeric_;
    const bool offers_pictures_;  ///< screenshots go to the clipboard, too
    SessionReport session_;
    std::optional<MemoryReport> held_;
    double held_at_s_ = 0;
    EditorPersistence persistence_;
    SceneLoader scenes_;
    PresetRequestHandler presets_;
    FrameLoader frames_;
    BackgroundWork work_;
    FrameImport import_;
    BundleExport export_;
    ReportExport report_;
    ConversionPreview conversion_;
};

}  // namespace si
