// What stands behind the editor's panels: scene, settings, renderer and the last frame's facts.
#pragma once

#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/against.h"
#include "app/editor/cures.h"
#include "app/editor/editor.h"
#include "app/editor/memory.h"
#include "app/editor/preset_desk.h"
#include "app/editor/readings.h"
#include "app/editor/sweep.h"
#include "app/editor/truth.h"
#include "app/editor/tuner.h"
#include "app/session/command_line.h"
#include "app/session/scene_loading.h"
#include "app/session/session.h"
#include "renderer/frame/renderer.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Needs a current OpenGL context all its life.
class EditorModel {
public:
    /// Starts to read the first scene. `read` makes scenes; empty: load_scene(). @throws UsageError, Error for what is
    /// wrong with the options themselves.
    explicit EditorModel(const EditorOptions& options, SceneReader read = {});

    EditorState state;

    /// What draw_editor() is told. Valid until the next fulfil().
    EditorFrame facts() const;
    /// Does what the editor asked for and draws the scene when anything changed. Returns whether the next frame of the
    /// editor looks different. Errors go to the log.
    bool fulfil(const EditorActions& actions);
    /// A file dropped on the window: a preset (.json) or a scene. A scene is read in the background; a later fulfil()
    /// switches to it. Errors go to the log.
    void open(const std::filesystem::path& path);
    /// Whether shader files were saved since the last frame.
    bool poll_shaders();
    /// A scene is being read, or the thread of a cancelled one has not ended yet.
    bool loading() const { return loading_.busy(); }
    /// Whether the next fulfil() has news of it, or its progress is to be drawn anew.
    bool loading_moved() const;
    /// Something is being measured in the background.
    bool measuring() const { return sweep_.busy() || readings_.tracing() || tuner_.running() || cures_.running(); }
    /// Whether the next fulfil() has news of it.
    bool measuring_moved() const { return sweep_.moved() || readings_.has_news() || tuner_.moved() || cures_.moved(); }
    /// Waits until nothing is being measured.
    void finish_measuring() { sweep_.wait(), readings_.finish_tracing(), tuner_.wait(), cures_.wait(); }
    /// Rays are being traced, or something is made of them.
    bool tracing() const { return truth_.busy(); }
    /// Whether the next fulfil() has news of it, or its progress is to be drawn anew.
    bool tracing_moved() const { return truth_.moved(); }
    void finish_tracing() const { truth_.wait(); }
    /// Waits for the scene that is being read and switches to it.
    void finish_loading();
    /// @throws Error why there is no scene, or (headless) what of the options the first one lacks.
    void require_scene() const;
    /// Remarks about the first scene.
    const std::vector<std::string>& notes() const { return notes_; }
    /// Call now and then, also while nothing is drawn: keeps what a crash would lose.
    void keep();
    /// The window has this size in screen coordinates at scale 1.
    void keep_window(int width, int height, bool maximised) { memory_.note_window(width, height, maximised); }
    /// The clean end: nothing is left to restore.
    void end() { memory_.end(state); }

private:
    /// What to do with a scene once it is there. Without plan and settings, what was changed by hand is kept.
    struct Arrival {
        std::string scene_name;
        int file_scene = -1;
        std::optional<SessionPlan> plan = {};
        std::optional<Settings> settings = {};  ///< just these
        GuideNote guide = {};
        std::string remark = {};
        bool step = false;  ///< undone or redone
        bool lost = false;  ///< what a crash left
    };
    void start_loading(Arrival arrival);
    void start_loading(SessionPlan plan, std::string remark);
    /// Shows the settings of `arrival` under their scene, which is read unless it is shown already.
    void show(Arrival arrival);
    void cancel_loading();
    /// The undone or redone step that waits for its scene will not come.
    void give_up_step();
    void follow_step();
    void restore_lost();
    /// A preset was opened: what it says, and its file as the one to save to.
    GuideNote note_preset(const std::string& name_or_path, Preset preset, const std::string& scene_name);
    /// What was being read will not come: scene.index is again that of what is shown.
    void keep_scene();
    /// Switches to the scene once it is read. Returns whether anything happened.
    bool poll_loading();
    void show_scene(Scene loaded, const Arrival& arrival);
    /// What the present scene's settings are when nothing is chosen; program defaults under a preset.
    Settings base_of_scene() const;
    /// Reads the scene of the file that scene.index chooses.
    void follow_file_scene();
    void load_preset_file(const std::string& name_or_path);
    void save_preset_file(const std::string& path, const std::optional<std::string>& about, bool replace);
    /// What the panels are told of presets. Returns whether it changed.
    bool compare();
    /// Moves the scene to the moment that the settings name, and what it suggests along with it.
    void follow_time();
    /// Sweeps, and the present settings' place among their cases. Returns whether there are news.
    bool follow_measuring(const EditorActions& actions);
    void take_sweep_base();
    bool draw_scene(const EditorActions& actions);
    /// Traces and compares what is shown. Returns whether the editor now shows something else.
    bool follow_truth(const EditorActions& actions, bool drawn);
    void save_map(const std::string& path);
    void start_tuning(const TuneWish& wish);
    void start_cures(const CureWish& wish);
    bool poll_cures();
    /// Takes over what a search found. Returns whether it ended.
    bool poll_tuning();
    void report(const std::string& error);

    Renderer renderer_;
    Scene scene_;
    bool has_scene_ = false;
    bool suggests_ = true;  ///< the settings began with the scene's suggestions, not with a preset
    bool strict_ = false;   ///< what the first scene lacks is an error, and not just left out
    std::exception_ptr failure_;
    std::vector<std::string> notes_;
    Settings base_;
    SceneSettings posed_;
    int file_scene_ = -1;  ///< scene.index of what is shown
    int seen_index_ = -1;  ///< scene.index as last acted upon
    PresetDesk desk_;
    Settings given_;  ///< as scene or preset brought them
    bool unsaved_ = false;
    const ComparisonFacts* comparison_ = nullptr;
    EditorMemory memory_;
    SceneLoading loading_;
    Arrival arrival_;

    FrameRequest request_;
    Settings drawn_settings_;
    std::uint64_t drawn_scene_ = 0;
    bool drawn_ = false, shaders_changed_ = false;
    FrameResult result_;
    std::string problem_, shader_log_;
    EditorReadings readings_;
    EditorSweep sweep_;
    EditorTuner tuner_;
    std::optional<TuningOutcome> tuned_;  ///< the last that tried families of biases
    EditorCures cures_;
    EditorTruth truth_;
    EditorAgainst against_;
};

}  // namespace si
