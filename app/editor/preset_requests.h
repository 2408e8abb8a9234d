// Requests about presets and lost sessions, whose settings arrive together with a scene.
#pragma once

#include "app/editor/preset_loader.h"
#include "app/editor/scene_loader.h"

namespace si {

/// Opens, saves and compares presets, and restores a lost session.
class PresetRequestHandler {
public:
    /// The arguments are parts of one editor and outlive this object.
    PresetRequestHandler(EditorState& state, EditorPersistence& memory, SceneLoader& scenes)
        : state_(state), persistence_(memory), scenes_(scenes) {}

    /// Starts to read the plan's scene, to be shown under its settings. @param remark for the log, once it is shown
    void start(SessionPlan plan, std::string remark);
    /// Opens a built-in preset or a file. @throws Error
    void open(const std::string& name_or_path);
    /// Writes the settings into a file, or asks first before another file is replaced (state.files.replace).
    /// @throws Error
    void save(const std::string& path, const std::optional<std::string>& about, bool replace);
    /// Shows the session that a crash has left.
    void restore_lost();
    /// Updates whether the settings are saved, and what they are compared with. Returns true if either has changed.
    bool compare();
    /// Settings that state.compare names, while they are shown; else null.
    const ComparisonFacts* comparison() const { return comparison_; }
    /// Writes presets and comparison into `frame`. Its pointers are valid until the next non-const call.
    void fill(EditorFrame& frame) const;
    /// Returns true if no preset held the settings at the last compare().
    bool unsaved() const { return unsaved_; }
    /// Returns true if unsaved changes are more than moves of the camera.
    bool would_be_lost() const;

private:
    /// Registers an opened preset as the file to save to. Returns its note.
    GuideNote note(const std::string& name_or_path, Preset preset, const std::string& scene_name);

    EditorState& state_;
    EditorPersistence& persistence_;
    SceneLoader& scenes_;
    PresetLoader loader_;
    bool unsaved_ = false;
    const ComparisonFacts* comparison_ = nullptr;
};

}  // namespace si
