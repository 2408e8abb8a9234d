// The scene of one editor: what is being read, what is shown and where it stands in time, and what its settings begin
// with.
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

class SceneLoader {
public:
    /// @param state, memory of the editor, which live longer @param read makes scenes; empty: load_scene()
    /// @param strict what the first scene lacks is an error, and not just left out
    SceneLoader(EditorState& state, EditorPersistence& memory, SceneReader read, bool strict);

    /// The settings before the first scene is there.
    void begin(const Settings& settings);

    /// What is shown; null: nothing yet.
    const Scene* scene() const { return has_scene_ ? &scene_ : nullptr; }
    /// @throws Error why there is no scene, or (strict) what of the options the first one lacks.
    const Scene& require() const;
    /// Why there is none; empty: one is being read, or is there.
    const std::string& problem() const { return problem_; }
    /// Remarks about the first scene.
    const std::vector<std::string>& notes() const { return notes_; }

    /// Reads the scene and then shows it.
    void load(Arrival arrival);
    /// Shows the settings of `arrival` under their scene, which is read unless it is shown already.
    void show(Arrival arrival);
    void cancel_loading();
    /// What was being read will not come: scene.index is again that of what is shown.
    void keep_scene();
    /// Switches to the scene once it is read. Returns whether anything happened.
    bool poll();
    /// Waits for the scene that is being read and switches to it.
    void finish();
    const SceneLoading& loading() const { return loading_; }
    /// An undone or redone step was chosen that nobody follows yet.
    bool has_step() const { return state_.between_steps && !arrival_.step; }
    /// Shows it: its scene is read unless it is shown.
    void follow_step();
    /// The settings name another scene of the file, or another moment, than what is shown.
    bool has_moved() const;
    /// Reads that scene, and moves what is shown to that moment. @throws Error
    void follow_settings();

    /// Whether that is what is shown, of the same scene of its file.
    bool is_shown(const std::string& scene_name, int file_scene) const;
    /// `name`, or what the shown scene is called where that is the same file.
    std::string known_name(const std::string& name) const;
    /// These settings came as a whole, in place of the scene's own. @param what of which to say what the scene lacks
    /// @returns what of them it lacks
    std::vector<std::string> take(const Settings& settings, const std::string& what);
    /// The scene's own settings.
    void reset();
    /// As scene or preset brought them.
    const Settings& given() const { return given_; }

private:
    /// The undone or redone step that waits for its scene will not come.
    void give_up_step();
    void show_scene(Scene loaded, const Arrival& arrival);
    /// What the present scene's settings are when nothing is chosen; program defaults under a preset.
    Settings base_of_scene() const;
    void follow_file_scene();
    void follow_time();
    /// Hides what is to be hidden.
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
    int file_scene_ = -1;  ///< scene.index of what is shown
    int seen_index_ = -1;  ///< scene.index as last acted upon
    Settings given_;
    /// Of scenes as named, under presets by their keys: a step of undo comes back to them.
    std::map<std::pair<std::string, std::string>, Settings> given_at_;
    Arrival arrival_;
    SceneLoading loading_;
};

}  // namespace si
