// Scenes of one editor: the scene that is being read, the shown scene with its time, and the settings that the shown
// scene began with.
#pragma once

#include <exception>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/persistence.h"
#include "app/editor/scene_watch.h"
#include "app/session/scene_loading.h"
#include "app/session/session.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Scene to load, with what to apply once it is loaded: the settings of a session plan (preset and --set), or exactly
/// given settings. With neither, the settings that the user changed are kept.
struct Arrival {
    std::string scene_name;
    FileChoices file = {};
    std::optional<SessionPlan> plan = {};
    std::optional<Settings> settings = {};  ///< exact settings; the scene's suggested settings are not added
    GuideNote guide = {};
    std::string remark = {};
    bool step = false;  ///< a step of undo or redo
    bool lost = false;  ///< the session that a crash has left
    /// The shown scene again, from its changed files: settings, camera and selection stay.
    bool reload = false;
    double aspect = 1;  ///< with `reload`: width / height of the picture, whose camera stays
};

/// Loader of scenes in the background; switches the editor to a scene once it is loaded, and poses the shown scene.
class SceneLoader {
public:
    /// Makes a loader without a scene. @param state, memory parts of the editor; outlive this object @param read reads
    /// scenes; empty: load_scene() @param strict true: options that the first scene lacks are errors; false: ignored
    SceneLoader(EditorState& state, EditorPersistence& memory, SceneReader read, bool strict);

    /// Sets the settings that the editor shows before the first scene is loaded, and starts the history with them.
    void set_initial_settings(const Settings& settings);

    /// Returns the scene that is shown; null: none yet.
    const Scene* scene() const { return has_scene_ ? &scene_ : nullptr; }
    /// Returns the shown scene. @throws Error if there is none. With `strict` (see the constructor), also if the first
    /// scene lacks something that the command line names
    const Scene& require() const;
    /// Returns the reason why there is no scene; empty: it is loaded, or being read.
    const std::string& problem() const { return problem_; }
    /// Returns the remarks about the first scene.
    const std::vector<std::string>& notes() const { return notes_; }

    /// Starts to load a scene in the background. A later poll() shows it.
    void load(Arrival arrival);
    /// Shows the scene and settings of `arrival`. Loads the scene first unless it is shown already.
    void show(Arrival arrival);
    /// Starts to read the shown scene's files again. A later poll() shows them; a failure keeps the shown scene.
    /// @param aspect width / height of the picture
    void reload(double aspect);
    /// Looks whether the shown scene's files were saved again. Returns true if files_changed() is another one than
    /// before. @param now_s time of a steady clock, seconds
    bool follow_files(double now_s) { return !loading_.busy() && watch_.update(now_s); }
    /// Returns true if the shown scene's files were saved again since they were read.
    bool files_changed() const { return watch_.changed(); }
    /// Keeps the shown scene until its files change once more.
    void keep_scene() { watch_.accept(); }
    /// Cancels the loading of a scene; the shown scene stays.
    void cancel_loading();
    /// Resets scene.index, scene.up and scene.unit to those of the shown scene, after a cancelled or failed loading.
    void reset_file_choices();
    /// Switches the editor to a scene whose loading has ended. Returns true if a loading has ended or failed.
    bool poll();
    /// Waits for the scene that is being loaded and switches the editor to it.
    void finish();
    const SceneLoading& loading() const { return loading_; }
    /// Returns true if a step of undo or redo waits for show_undo_step().
    bool undo_step_waits() const { return state_.between_steps && !arrival_.step; }
    /// Shows the step of undo or redo that waits for its scene. Loads the scene first unless it is shown already.
    void show_undo_step();
    /// Returns true if scene.* (scene of the file, time, placement) or settings of objects differ from those of the
    /// shown scene.
    bool scene_settings_changed() const;
    /// Makes the shown scene match scene.* and the settings of objects. Reads the file again if
    /// scene.index, scene.up or scene.unit has changed, else poses the shown scene. @throws Error
    void follow_scene_settings();

    /// Returns true if the editor shows this scene. @param file scene of the file, up axis and unit
    bool is_shown(const std::string& scene_name, const FileChoices& file) const {
        return has_scene_ && scene_name == state_.scene_name && file == file_;
    }
    /// Returns the name under which the editor knows a scene: the shown scene's name if `name` is another path of the
    /// same file, else `name`. Compare scenes by this name, so that a shown file is not loaded again.
    std::string known_name(const std::string& name) const;
    /// Replaces the settings that the scene started with. Returns a message for each object or camera that the settings
    /// name and the scene lacks. @param what source of the settings, for these messages
    std::vector<std::string> apply_settings(const Settings& settings, const std::string& what);
    /// Resets all settings to those that the scene or preset started with.
    void reset();
    /// Returns the settings that the scene or preset began with, without changes by the user.
    const Settings& original_settings() const { return given_; }

private:
    /// Drops the step of undo or redo that waits for its scene, and stays at the present step.
    void drop_undo_step();
    /// Makes the scene that was read again the shown one. @throws Error if its files have changed meanwhile
    void show_reloaded(Scene loaded, const Arrival& arrival);
    /// Makes a loaded scene the shown one, and applies the settings that arrived with it.
    void show_scene(Scene loaded, const Arrival& arrival);
    /// Returns the settings of the scene without any change; program defaults under a preset.
    Settings base_of_scene() const { return suggests_ ? base_settings(scene_) : Settings{}; }
    /// Starts to read the file as scene.index, scene.up and scene.unit say, unless the shown scene was read with these
    /// values. Then it cancels a loading under way. Called when one of them has changed.
    void follow_file_choices();
    /// Poses the shown scene by scene.* (time, animation, placement), and updates settings of lights that the file
    /// animates.
    void follow_time();
    /// Applies object settings (shown, cast, receive, culling) to the scene.
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
    FileChoices seen_file_;  ///< the same settings as last acted upon
    Settings given_;
    /// Settings that scenes (first) and presets (second, key) have brought, for steps of undo.
    std::map<std::pair<std::string, std::string>, Settings> given_at_;
    Arrival arrival_;
    SceneLoading loading_;
    SceneWatch watch_;
};

}  // namespace si
