// Presets opened, saved and compared with in one editor, and what a crash left: settings that arrive together with a
// scene.
#pragma once

#include "app/editor/preset_loader.h"
#include "app/editor/scene_loader.h"

namespace si {

class PresetRequestHandler {
public:
    /// All of the editor, which live longer.
    PresetRequestHandler(EditorState& state, EditorPersistence& memory, SceneLoader& scenes)
        : state_(state), persistence_(memory), scenes_(scenes) {}

    /// Reads the scene of the plan and shows it under its settings. @param remark for the log, once it is shown
    void start(SessionPlan plan, std::string remark);
    /// @throws Error
    void open(const std::string& name_or_path);
    void save(const std::string& path, const std::optional<std::string>& about, bool replace);
    void restore_lost();
    /// Finds out whether the present state is saved, and what it is compared with. Returns whether either changed.
    bool compare();
    /// What state.compare names, while that is shown.
    const ComparisonFacts* comparison() const { return comparison_; }
    void fill(EditorFrame& frame) const;
    /// No preset held what was shown when compare() was called last.
    bool unsaved() const { return unsaved_; }
    /// Of what is unsaved, whether it is more than where one looks.
    bool would_be_lost() const;

private:
    /// A preset was opened: what it says, and its file as the one to save to.
    GuideNote note(const std::string& name_or_path, Preset preset, const std::string& scene_name);

    EditorState& state_;
    EditorPersistence& persistence_;
    SceneLoader& scenes_;
    PresetLoader loader_;
    bool unsaved_ = false;
    const ComparisonFacts* comparison_ = nullptr;
};

}  // namespace si
