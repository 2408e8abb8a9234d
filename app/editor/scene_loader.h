// The scene of one editor: the one that is read, the one that is shown and its time, and the settings it starts with.
#pragma once

#include <exception>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/persistence.h"
#include "app/session/scene_loading.h"
#include "app/session/session.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Settings to apply when a scene is loaded. Without plan and settings, changes made by hand are kept.
struct Arrival {
    std::string scene_name;
    int file_scene = -1;
    std::optional<SessionPlan> plan = {};
    std::optional<Settings> settings = {};  ///< exactly these, with nothing of the scene's own
    GuideNote guide = {};
    std::string remark = {};
    bool step = false;  ///< a step of undo or redo
    bool lost = false;  ///< the session that a crash has left
};

/// Reads scenes in the background and switches the editor to them.
class SceneLoader {
public:
    /// @param state, memory of the editor; outlive this object @param read makes scenes; empty: load_scene()
    /// @param strict an option that the first scene lacks is an error; else it is ignored
    SceneLoader(EditorState& state, EditorPersistence& memory, SceneReader read, bool strict);

    /// Sets the settings that hold until the first scene is loaded.
    void begin(const Settings& settings);

    /// Scene that is shown; null: none yet.
    const Scene* scene() const { return has_scene_ ? &scene_ : nullptr; }
    /// Returns the scene. @throws Error if there is none, or (strict) the first one lacks something of the options
    const Scene& require() const;
    /// Reason why there is no scene; empty: it is loaded, or being read.
    const std::string& problem() const { return problem_; }
    /// Remarks about the first scene.
    const std::vector<std::string>& notes() const { return notes_; }

    /// Starts to read the scene, to be shown by a later poll().
    void load(Arrival arrival);
    /// Shows the settings of `arrival`. Their scene is read first unless it is shown already.
    void show(Arrival arrival);
    /// Cancels the reading; the shown scene stays.
    void cancel_loading();
    /// Sets scene.index back to the shown scene's, after a cancelled or failed reading.
    void keep_scene();
    /// Switches to the scene once it is read. Returns true if anything has happened.
    bool poll();
    /// Waits for the scene that is being read and switches to it.
    void finish();
    const SceneLoading& loading() const { return loading_; }
    /// Returns true if a step of undo or redo waits for follow_step().
    bool has_step() const { return state_.between_steps && !arrival_.step; }
    /// Shows that step. Its scene is read first unless it is shown already.
    void follow_step();
    /// Returns true if the settings name another scene of the file, or another time, than the shown scene has.
    bool has_moved() const;
    /// Reads that scene, or poses the shown one at that time. @throws Error
    void follow_settings();

    /// Returns true if that scene of that file is shown.
    bool is_shown(const std::string& scene_name, int file_scene) const;
    /// Returns the shown scene's name if `name` is the same file, else `name`.
    std::string known_name(const std::string& name) const;
    /// Replaces the scene's own settings. Returns a message for each thing that the settings name and the scene lacks.
    /// @param what source of the settings, for these messages
    std::vector<std::string> take(const Settings& settings, const std::string& what);
    /// Goes back to the scene's own settings.
    void reset();
    /// Settings as the scene or preset brought them.
    const Settings& given() const { return given_; }

private:
    /// Forgets the step of undo or redo that waits for its scene.
    void give_up_step();
    void show_scene(Scene loaded, const Arrival& arrival);
    /// Returns the settings of the scene without any change; program defaults under a preset.
    Settings base_of_scene() const;
    void follow_file_scene();
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
    int file_scene_ = -1;  ///< scene.index of the shown scene
    int seen_index_ = -1;  ///< scene.index as last acted upon
    Settings given_;
    /// Settings that scenes (first) and presets (second, key) have brought, for steps of undo.
    std::map<std::pair<std::string, std::string>, Settings> given_at_;
    Arrival arrival_;
    SceneLoading loading_;
};

}  // namespace si
