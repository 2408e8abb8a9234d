// Requests about presets and lost sessions, whose settings arrive together with a scene.
#pragma once

#include <map>
#include <optional>

#include "app/editor/preset_pictures.h"
#include "app/editor/scene_loader.h"

namespace si {

/// Handler of the panels' requests about presets: open, save, compare, and restore the session that a crash has left.
/// Knows the built-in presets and the files that the editor has opened or saved.
class PresetRequestHandler {
public:
    /// Makes a handler that knows the built-in presets.
    /// @param state, memory, scenes parts of the editor, which must outlive this object
    PresetRequestHandler(EditorState& state, EditorPersistence& memory, SceneLoader& scenes);

    /// Starts to load the scene of a session plan (checked command-line options or preset). The scene is then shown
    /// with the plan's settings. @param remark line for the log once the scene is shown; empty: none
    void start(SessionPlan plan, std::string remark);
    /// Opens a preset: applies its settings, and first loads its scene unless that is shown already.
    /// @param name_or_path key of a built-in preset, or path of a preset file @throws Error
    void open(const std::string& name_or_path);
    /// Writes the present settings to a preset file. The editor asks before it replaces a file that it has neither
    /// opened nor saved (state.files.replace).
    /// @param about description to store in the preset; none: the description that the file has
    /// @param replace true: replaces any file without asking
    /// @throws Error
    void save(const std::string& path, const std::optional<std::string>& about, bool replace);
    /// Restores the session that a crash has left: loads its scene and settings. Does nothing if there is none.
    void restore_lost();
    /// Marks the present settings as unsaved if they differ from those opened or saved last. While a comparison is
    /// shown, also loads the settings that state.compare chooses. Call once a frame. Returns true if the mark or the
    /// compared settings have changed.
    bool update_comparisons();
    /// Returns the loaded settings that the present ones are compared with (state.compare); null while no comparison is
    /// shown.
    const ComparisonFacts* comparison() const { return shows_comparison_ && comparison_ ? &*comparison_ : nullptr; }
    /// Writes the built-in presets, the compared settings and the mark of unsaved settings into `frame`, the data that
    /// panels show. Pointers in `frame` stay valid until the next non-const call.
    void fill(EditorFrame& frame) const;
    /// Updates the small pictures of presets in the gallery, which a background job draws. Needs the window's OpenGL
    /// context. Returns true if there are new pictures.
    /// @param wanted keys of presets without a picture, the most urgent first
    bool update_pictures(std::span<const std::string> wanted);
    const PresetPictures& pictures() const { return pictures_; }
    /// Returns true if quitting would lose unsaved settings. Changes of camera and view alone count only while a preset
    /// file is open.
    bool would_be_lost() const;

private:
    /// Registers an opened preset; call once its scene is shown. A preset file becomes the file that saving writes, and
    /// enters the recent files; a built-in preset does neither.
    /// @param scene_name name of the preset's scene, as the editor knows it
    void note_opened(const std::string& name_or_path, Preset preset, const std::string& scene_name);
    /// Returns true if the key names a preset that ships with the program: a guided one (with a sentence on what to
    /// look at) or a hard case.
    bool is_built_in(const std::string& key) const;
    /// Returns the contents of the preset file that saving writes (state.files.preset_path). Returns null if this
    /// editor has neither opened nor saved the file.
    const Preset* known_file() const;
    /// Loads the settings that state.compare chooses for comparison: those of a preset, the pinned ones, a search's
    /// proposal or the defaults. A preset file is read at its first use, and again after save(). @param scene the shown
    /// scene
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
