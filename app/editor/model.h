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

/// Editor without its window: state, scene, frames and background work. The window and the headless editor draw it by
/// draw_editor(). Needs a current OpenGL context all its life.
class EditorModel {
public:
    /// Makes the editor and starts to read its first scene (EditorOptions::session). @param read reads scenes; empty:
    /// load_scene()
    /// @param thread options of the drawing thread; without a context maker, frames are drawn on the calling thread
    /// @throws UsageError, Error for faulty options
    explicit EditorModel(const EditorOptions& options, SceneReader read = {}, FrameThread thread = {});

    EditorState state;
    bool has_desktop_dialog =
        false;            ///< the caller can show the desktop's file dialog (EditorRequests::open_desktop_dialog)
    bool smooths = true;  ///< a picture that stays the same gets more samples per pixel, if view.smooth is on

    /// Returns the data that draw_editor() shows. Pointers in the data stay valid until the next fulfil().
    EditorFrame facts() const;
    /// Performs the actions that panels requested in draw_editor(), and draws the scene if anything has changed. Errors
    /// go to the log. Call once a frame. Returns true if the editor has to be drawn again.
    bool fulfil(const EditorRequests& requests);
    /// Opens a file by its extension: a preset (.json), a scene, or a frame of another engine, which becomes a bundle
    /// first (FrameImport). Scenes are read in the background, and a later fulfil() shows them. Errors go to the log.
    void open(const std::filesystem::path& path);
    /// Saves the settings as a preset in the file that the user chose in the desktop's file dialog. The editor asks
    /// before it replaces a file that it has neither opened nor saved. Errors go to the log.
    void save_as(const std::filesystem::path& path);
    /// Writes a screenshot of the window, or of a part, as a PNG file into the folder of the preset file, and copies it
    /// to the clipboard. Errors go to the log.
    /// @param request the part of the window, in ImGui's units
    /// @param window picture of the window, top row first
    /// @param pixels number of pixels of `window` per unit of ImGui
    void save_shot(const ShotRequest& request, const ByteImage& window, float pixels);
    /// Draws the cross-section of the probed pixel's shadow test (cut along the light ray), with verdict and legend, in
    /// a readable size and writes it to a file. Returns false and does nothing if `request` is for another kind of
    /// screenshot, or no cross-section is shown.
    bool save_drawing(const ShotRequest& request, ImGuiSession& imgui);
    /// Checks whether other programs have saved the scene's files. Call regularly, also while nothing is drawn. Returns
    /// true if the editor has to be drawn again. @param now_s time of a steady clock, seconds
    bool follow_scene_files(double now_s) { return scenes_.follow_files(now_s); }
    /// Checks at the present time whether other programs have saved the scene's files. Call regularly, also while
    /// nothing is drawn. Returns true if the editor has to be drawn again.
    bool follow_scene_files();
    /// Reads changed shader files again. Returns true if shader files have changed since the last drawn frame, so that
    /// the scene has to be drawn again.
    bool poll_shaders() { return frames_.poll_shaders(); }
    /// Returns true while a scene is read or imported, or the thread of a cancelled loading has not ended yet.
    bool loading() const { return scenes_.loading().busy() || import_.busy(); }
    /// Returns true if the next fulfil() will have a loaded scene, or the progress of loading has changed.
    bool loading_moved() const { return scenes_.loading().has_news() || import_.has_news(); }
    /// Returns true if the progress of drawing the scene's first picture has changed since the last call.
    bool drawing_moved() { return frames_.first_picture_moved(); }
    /// Returns true while background work runs: measurements, exports, reports, preset pictures, or the diagnosis of
    /// the probed pixel.
    bool measuring() const {
        return work_.busy() || export_.busy() || report_.busy() || presets_.pictures().busy() ||
               frames_.facts().readings.tracing_probe;
    }
    /// Returns true if the next fulfil() will have results or progress of the work that measuring() lists.
    bool measuring_moved() const {
        return work_.has_news() || export_.has_news() || report_.has_news() || presets_.pictures().has_new_pictures() ||
               frames_.probe_moved();
    }
    /// Waits until the background work that measuring() lists has ended.
    void finish_measuring() const {
        work_.finish();
        export_.finish();
        report_.finish();
        presets_.pictures().wait();
        frames_.finish_probe();
    }
    /// Returns true while a frame is drawn, or ray-traced references, light maps or saved errors are computed for it.
    bool tracing() const { return frames_.tracing(); }
    /// Returns true if the next fulfil() will have a drawn frame, or results or progress of ray tracing.
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
    /// Returns the background compilation of shaders; null: frames are drawn on the calling thread.
    const ShaderWarmup* warmup() const { return frames_.warmup(); }
    /// Waits for the scene that is being read and switches to it.
    void finish_loading() {
        frames_.wait();
        import_.finish();
        scenes_.finish();
    }
    /// Checks that a scene is loaded. @throws Error if not. An editor without a window also throws if the scene loaded
    /// first lacks an object or camera that the options name
    void require_scene() const { scenes_.require(); }
    /// Returns the remarks about the scene that the editor loaded first.
    const std::vector<std::string>& notes() const { return scenes_.notes(); }
    /// Writes autosave, workspace (layout, recent files) and session report to disk, each when it is due. Call
    /// regularly, also while nothing is drawn.
    void write_when_due();
    /// Writes autosave, workspace and session report to disk at once. Call before the program ends without end(), for
    /// example when the X server is lost. Errors go to the log.
    void save_before_crash();
    /// Remembers the window's size and whether it is maximised, for the next start.
    /// @param width, height pixels divided by the monitor's content scale
    void note_window_size(int width, int height, bool maximised) { persistence_.note_window(width, height, maximised); }
    /// Writes the workspace and the session report. Call when the editor ends. The next start offers settings that were
    /// not saved.
    void end() {
        persistence_.end(state, presets_.would_be_lost());
        session_.write(state.log);
    }
    /// Returns the session report (`edit --report`): driver messages, invalid numbers, errors and memory.
    SessionReport& session() { return session_; }

private:
    /// Starts to load a scene. A file that holds a frame of another engine is imported as a bundle first. @param name
    /// key of a built-in scene, or path @throws Error
    void open_scene(const std::string& name);
    /// Exports the shown frame as a picture, a depth map or a bundle. The editor asks before it replaces an existing
    /// file.
    /// @param replace true: the user has agreed to replace the file @throws Error
    void export_file(const ExportRequest& wanted, bool replace);
    /// Returns the view that an export draws: the shaded picture, or the depth map that the map viewer shows.
    View shown_view(ExportKind kind) const;
    /// Copies to the clipboard a command line of this program that draws the present picture.
    void copy_command_line();
    /// Returns the cross-section of the probed pixel's shadow test (cut along the light ray) for the shown light
    /// (view.light); null: there is none.
    const Section* shown_section() const;
    /// Returns the size of the scene picture in the last drawn frame, pixels.
    glm::ivec2 picture_size() const;

    /// Samples the memory use of this process twice a second while a panel shows it. @param wanted true: a panel shows
    /// it
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
