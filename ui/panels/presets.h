// Facts and requests about presets, scenes and the session that a crash has left.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ui/widgets/export_kind.h"

namespace si {

/// Built-in preset as lists show it: key, title, topic and description.
struct PresetEntry {
    std::string key;
    std::string title;
    std::string topic;     ///< heading that it is listed under
    std::string about;     ///< sentence on what to look at
    unsigned picture = 0;  ///< texture of its small picture, bottom row first; 0: not drawn yet
};

/// State of the gallery of presets: the search text and the chosen topic.
struct GalleryPanel {
    std::string search;  ///< words that listed presets have
    std::string topic;   ///< heading of the listed presets; empty: all
};

/// Facts about an unsaved session that a crash has left, for the question whether to restore it.
struct LostFacts {
    std::string scene;
    std::string when;  ///< age in words: "3 minutes ago"
};

/// Existing file that saving or exporting replaces once the user agrees.
struct Replacement {
    std::string path;
    std::optional<std::string> about = {};    ///< sentence to save in the preset
    std::optional<ExportKind> exported = {};  ///< the frame is exported there; none: the preset is saved
    bool errors = false;                      ///< the errors are saved there, instead of the preset
};

/// Data that menus and panels show about presets, recent files and the session that a crash has left.
struct PresetsFacts {
    std::span<const PresetEntry> presets, hard_cases;            ///< two sequences, each in its order
    std::span<const std::string> recent_scenes, recent_presets;  ///< paths, the newest first
    bool scene_saved = false;  ///< another program has saved the shown scene's files since they were read
    bool unsaved = false;      ///< state.files.preset_path does not hold the present settings
    std::optional<LostFacts> lost;
};

/// Requests of menus and panels to the application: scenes and presets to load, save or restore.
struct PresetRequests {
    std::optional<std::string> load_scene;   ///< key of a built-in scene, or path of a file
    std::optional<std::string> load_preset;  ///< key of a built-in preset, or path of a file
    std::optional<std::string> save_preset;  ///< path
    std::optional<std::string> open_file;    ///< path of a scene or a preset, by its extension
    std::optional<std::string> save_about;   ///< sentence to save in the preset
    bool replace = false;                    ///< the user agrees to replace an existing file
    bool restore_lost = false;               ///< show the session that a crash has left
    bool discard_lost = false;               ///< delete that session
    bool reset_all = false;                  ///< go back to the scene's own settings
    bool cancel_load = false;                ///< keep the scene that is shown
    bool reload_scene = false;               ///< read the shown scene's files again
    bool keep_scene = false;                 ///< offer `reload_scene` only after the next change of the files
    std::vector<std::string> want_pictures;  ///< keys of presets on the screen that have no picture yet
};

/// Draws the gallery of presets as an ImGui popup while it is open: cards with picture, title and sentence, by topic,
/// with a search field. A hard case is beside its fix.
/// @param id ImGui id of the popup @param open key of the preset in use, which is highlighted
void draw_gallery(const char* id, GalleryPanel& panel, std::span<const PresetEntry> presets, const std::string& open,
                  PresetRequests& requests);
/// Returns the width of the gallery of presets, pixels.
float gallery_width();

}  // namespace si
