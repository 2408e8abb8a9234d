// Requests about presets and lost sessions, whose settings arrive together with a scene.
#pragma once

#include <map>
#include <optional>

#include "app/editor/preset_pictures.h"
#include "app/editor/scene_loader.h"

namespace si {

/// Handler of requests that open, save and compare presets, or restore the session that a crash has left. Knows the
/// built-in presets and the files that the editor has opened or saved.
class PresetRequestHandler {
public:
    /// @param state, memory, scenes the parts of one editor; outlive this object
    PresetRequestHandler(EditorState& state, EditorPersistence& memory, SceneLoader& scenes);

    /// Starts to load the plan's scene, to be shown with the plan's settings. @param remark line for the log, once the
    /// scene is shown
    void start(SessionPlan plan, std::string remark);
    /// Opens a built-in preset or a preset file, and starts to load its scene. @throws Error
    void open(const std::string& name_or_path);
    /// Writes the present settings into a preset file. A file that this editor has neither opened nor saved is not
    /// replaced: a question opens instead (state.files.replace).
    /// @param about sentence to store; none: the old one
    /// @param replace true: replaces any file, without a question
    /// @throws Error
    void save(const std::string& path, const std::optional<std::string>& about, bool replace);
    /// Restores the session that a crash has left: loads its scene and settings.
    void restore_lost();
    /// Compares the present settings with those opened or saved last, and updates the mark of unsaved settings. While a
    /// comparison is shown, also loads the settings that state.compare names. Returns true if the mark, or the choice
    /// of settings to compare with, has changed.
    bool compare();
    /// Returns the settings that state.compare names, while they are shown; else null.
    const ComparisonFacts* comparison() const { return shows_comparison_ && comparison_ ? &*comparison_ : nullptr; }
    /// Writes the lists of presets and the comparison into `frame`. Pointers in it stay valid until the next non-const
    /// call.
    void fill(EditorFrame& frame) const;
    /// Draws small pictures of presets that the gallery shows, in the background. Returns true if there are new ones.
    /// Needs the window's OpenGL context. @param wanted see PresetRequests::want_pictures
    bool update_pictures(std::span<const std::string> wanted);
    const PresetPictures& pictures() const { return pictures_; }
    /// Returns true if quitting would lose unsaved changes other than moves of the camera.
    bool would_be_lost() const;

private:
    /// Registers an opened preset: a preset file becomes the file that saving writes and enters the recent files; a
    /// built-in preset does neither. Returns the preset's title and description for the editor to show.
    GuideNote note(const std::string& name_or_path, Preset preset, const std::string& scene_name);
    /// Returns true if the key names a guided preset or hard case that ships with the program.
    bool is_built_in(const std::string& key) const;
    /// Returns the preset of the file that saving writes, as this editor opened or saved it; null: it did neither.
    const Preset* known_file() const;
    /// Loads the settings that state.compare names. Reads a preset's file at its first use, and again after save().
    /// @param scene the shown scene
    void load_comparison(const Scene& scene);

    EditorState& state_;
    EditorPersistence& persistence_;
    SceneLoader& scenes_;
    std::vector<PresetEntry> entries_;     ///< guided presets that ship with the program, in order
    std::vector<PresetEntry> hard_cases_;  ///< hard cases that ship with the program, by number
    std::map<std::string, Preset> files_;  ///< opened or saved presets by absolute path
    bool unsaved_ = false;
    std::optional<ComparisonFacts> comparison_;  ///< kept while it is not shown, so that its file is read once
    bool shows_comparison_ = false;
    PresetPictures pictures_;
};

}  // namespace si
