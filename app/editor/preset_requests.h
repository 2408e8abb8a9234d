// Requests about presets and lost sessions, whose settings arrive together with a scene.
#pragma once

#include "app/editor/preset_loader.h"
#include "app/editor/scene_loader.h"

namespace si {

/// Handler of requests that open, save and compare presets, or restore the session that a crash has left.
class PresetRequestHandler {
public:
    /// @param state, memory, scenes the parts of one editor; outlive this object
    PresetRequestHandler(EditorState& state, EditorPersistence& memory, SceneLoader& scenes)
        : state_(state), persistence_(memory), scenes_(scenes) {}

    /// Starts to load the plan's scene, to be shown with the plan's settings. @param remark line for the log, once the
    /// scene is shown
    void start(SessionPlan plan, std::string remark);
    /// Opens a built-in preset or a preset file, and starts to load its scene. @throws Error
    void open(const std::string& name_or_path);
    /// Writes the present settings into a preset file. Opens a question (state.files.replace) before it replaces a
    /// file of others. @param about sentence to store; none: the old one @throws Error
    void save(const std::string& path, const std::optional<std::string>& about, bool replace);
    /// Restores the session that a crash has left: loads its scene and settings.
    void restore_lost();
    /// Updates the mark of unsaved settings and the settings to compare with. Returns true if either has changed.
    bool compare();
    /// Settings that state.compare names, while they are shown; else null.
    const ComparisonFacts* comparison() const { return comparison_; }
    /// Writes the lists of presets and the comparison into `frame`. Pointers in it stay valid until the next non-const
    /// call.
    void fill(EditorFrame& frame) const;
    /// Returns true if no preset held the settings at the last compare().
    bool unsaved() const { return unsaved_; }
    /// Returns true if quitting would lose unsaved changes other than moves of the camera.
    bool would_be_lost() const;

private:
    /// Registers an opened preset: a preset file becomes the file that saving writes and enters the recent files; a
    /// built-in preset does neither. Returns the preset's title and description for the editor to show.
    GuideNote note(const std::string& name_or_path, Preset preset, const std::string& scene_name);

    EditorState& state_;
    EditorPersistence& persistence_;
    SceneLoader& scenes_;
    PresetLoader loader_;
    bool unsaved_ = false;
    const ComparisonFacts* comparison_ = nullptr;
};

}  // namespace si
