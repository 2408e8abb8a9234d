// Scenes of one editor: the scene that is being read, the shown scene with its time, and the settings that the shown
// scene began with.
#pragma once

#include <exception>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "app/editor/persistence.h"
#include "app/editor/scene_watch.h"
#include "app/session/scene_loading.h"
#include "app/session/session.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Scene to load, with the settings to apply once it is loaded: those of a session plan (preset and --set), or exact
/// ones. With neither, the settings that the user changed are kept.
struct Arrival {
    std::string scene_name;
    FileChoices file = {};
    std::optional<SessionPlan> plan = {};
    std::optional<Settings> settings = {};  ///< exact settings; the scene's suggested settings are not added
    GuideNote guide = {};
    std::string remark = {};
    bool step = false;  ///< true: a step of undo or redo shows the scene
    bool lost = false;  ///< true: restores the session that a crash has left
    /// Request to read the shown scene's changed files again; settings, camera and selection stay.
    bool reload = false;
    double aspect = 1;  ///< with `reload`: width / height of the picture, needed to keep its camera
    /// Function that is called once the scene is loaded and shown; empty: none.
    std::function<void()> when_shown = {};
};

/// Owner of the editor's scene: reads scenes in the background, shows a scene once it is loaded, and poses the shown
/// scene by its settings.
class SceneLoader {
public:
    /// Makes a loader without a scene. @param state, memory parts of the editor, which must outlive this object
    /// @param read reads scenes; empty: load_scene()
    /// @param strict true: an object or camera that the options name and the scene loaded first lacks is an error;
    /// false: the log reports it
    SceneLoader(EditorState& state, EditorPersistence& memory, SceneReader read, bool strict);

    /// Sets the settings that the editor shows before the first scene is loaded, and starts the undo history with them.
    void set_initial_settings(const Settings& settings);

    /// Returns the scene that is shown; null: none yet.
    const Scene* scene() const { return has_scene_ ? &scene_ : nullptr; }
    /// Returns the shown scene, for work that needs one. @throws Error if there is none, for example because its
    /// loading has failed. With the constructor's `strict`, loading also fails if the scene loaded first lacks an
    /// object or camera that the options name
    const Scene& require() const;
    /// Returns the reason why there is no scene; empty: it is loaded, or being read.
    const std::string& problem() const { return problem_; }
    /// Returns the remarks about the scene that was loaded first.
    const std::vector<std::string>& notes() const { return notes_; }

    /// Starts to load a scene in the background, and cancels an earlier loading. A later poll() shows the scene.
    void load(Arrival arrival);
    /// Shows a scene with exact settings (Arrival::settings must be set). Loads the scene first unless it is shown
    /// already.
    void show(Arrival arrival);
    /// Starts to read the shown scene's files again, after another program has saved them. A later poll() shows the new
    /// version; a failure keeps the shown one.
    /// @param aspect width / height of the picture, needed to keep the picture's camera @throws Error for a built-in
    /// scene
    void reload(double aspect);
    /// Checks whether the shown scene's files were saved again. Does nothing while a scene is being loaded. Returns
    /// true if files_changed() now returns another value than before. @param now_s time of a steady clock, seconds
    bool follow_files(double now_s) { return !loading_.busy() && watch_.update(now_s); }
    /// Returns true if the shown scene's files were saved again since they were read.
    bool files_changed() const { return watch_.changed(); }
    /// Ignores the present changes of the files: files_changed() returns false until they are saved once more.
    void keep_scene() { watch_.accept(); }
    /// Cancels the loading of a scene and logs that; the shown scene stays. Does nothing if no scene is being loaded.
    void cancel_loading();
    /// Resets the settings that choose how the scene's file is read (scene.index, scene.up, scene.unit) to those of the
    /// shown scene. Call after a loading was cancelled or has failed.
    void reset_file_choices();
    /// Shows a scene that was loaded in the background; the reason of a failed loading goes to the log. Call once a
    /// frame. Returns true if a loading has ended or failed.
    bool poll();
    /// Waits until no scene is being loaded, and shows the loaded scene.
    void finish();
    const SceneLoading& loading() const { return loading_; }
    /// Returns true if a step of undo or redo, which belongs to another scene, waits for show_undo_step().
    bool undo_step_waits() const { return state_.between_steps && !arrival_.step; }
    /// Shows a step of undo or redo that belongs to another scene than the shown one. The same file, read with another
    /// scene.index, scene.up or scene.unit, is another scene too. Loads the scene first unless it is shown already.
    void show_undo_step();
    /// Returns true if the shown scene does not match its settings: scene.* (scene of the file, time, placement) or
    /// those of objects. follow_scene_settings() then updates the scene.
    bool scene_settings_changed() const;
    /// Makes the shown scene match its settings, scene.* and those of objects. Reads the file again in the background
    /// if scene.index, scene.up or scene.unit has changed, else poses the shown scene. @throws Error
    void follow_scene_settings();

    /// Returns true if the editor shows this scene. @param file scene index, up axis and unit with which the file is
    /// read
    bool is_shown(const std::string& scene_name, const FileChoices& file) const {
        return has_scene_ && scene_name == state_.scene_name && file == file_;
    }
    /// Returns the shown scene's name if `name` is another path of the same file, else `name`. Scenes are compared by
    /// this name, so that a shown file is not loaded again.
    std::string known_name(const std::string& name) const;
    /// Replaces all settings by those of a preset for the shown scene. Returns a message for each object or camera that
    /// the settings name and the scene lacks. @param what name of the preset, for these messages
    std::vector<std::string> apply_settings(const Settings& settings, const std::string& what);
    /// Resets all settings to the shown scene's own ones, and closes the note of the open preset.
    void reset();
    /// Returns the settings that the scene or preset began with, without changes by the user.
    const Settings& original_settings() const { return given_; }

private:
    /// Gives up the step of undo or redo that waits for its scene. The history goes back to the step shown before.
    void drop_undo_step();
    /// Replaces the shown scene by the version that was read again. Settings, camera and selection stay.
    /// @param loaded the new version @throws Error if its files have changed meanwhile
    void show_reloaded(Scene loaded, const Arrival& arrival);
    /// Makes a loaded scene the shown one, and applies the settings that `arrival` brings. Resets the probe and the
    /// selection of the scene before.
    void show_scene(Scene loaded, const Arrival& arrival);
    /// Returns the settings that count as unchanged in the shown scene or a new version of it: the scene's suggested
    /// settings, or the program's defaults under a preset.
    Settings base_of(const Scene& scene) const { return suggests_ ? base_settings(scene) : base_; }
    /// Reads the scene's file again in the background, after a change of scene.index, scene.up or scene.unit. If the
    /// shown scene was read with these values already, only cancels the loading under way.
    void follow_file_choices();
    /// Poses the shown scene by its settings scene.* (time, animation, placement), and updates settings of lights that
    /// the file animates.
    void follow_time();
    /// Hides or shows the scene's objects by their settings (object.PATH.shown).
    void follow_objects();

    EditorState& state_;
    EditorPersistence& persistence_;
    Scene scene_;
    bool has_scene_ = false;
    bool suggests_ = true;  ///< the settings began with the scene's suggestions, not with a preset
    bool strict_ = false;
    std::exception_ptr failure_;
    std::string problem_;
    std::vector<std::string> notes_;
    Settings base_;
    SceneSettings posed_;
    std::map<std::string, ObjectSettings> followed_objects_;
    FileChoices file_;       ///< scene.index, scene.up and scene.unit of the shown scene
    FileChoices seen_file_;  ///< scene.index, scene.up and scene.unit as last acted upon
    Settings given_;
    /// Original settings by scene name, preset key and file choices, for steps of undo that return to the scene.
    std::map<std::tuple<std::string, std::string, FileChoices>, Settings> given_at_;
    Arrival arrival_;
    SceneLoading loading_;
    SceneWatch watch_;
};

}  // namespace si
