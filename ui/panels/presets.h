// Facts and requests about presets, scenes and the session that a crash has left.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "ui/widgets/export_kind.h"

namespace si {

/// Built-in preset as lists show it: key, title, topic and description.
struct PresetEntry {
    std::string key;
    std::string title;
    std::string topic;  ///< heading that it is listed under
    std::string about;  ///< sentence on what to look at
};

/// Session that a crash has left, as the panel shows it when it offers to restore the session.
struct LostFacts {
    std::string scene;
    std::string when;  ///< age in words: "3 minutes ago"
};

/// Existing file that saving or exporting replaces once the user agrees.
struct Replacement {
    std::string path;
    std::optional<std::string> about = {};    ///< sentence to save in the preset
    std::optional<ExportKind> exported = {};  ///< the frame is exported there; none: the preset is saved
};

/// Data that menus and panels show about presets, recent files and the lost session.
struct PresetsFacts {
    std::span<const PresetEntry> presets, hard_cases;            ///< two sequences, each in its order
    std::span<const std::string> recent_scenes, recent_presets;  ///< paths, the newest first
    bool scene_saved = false;  ///< another program has saved the shown scene's files since they were read
    bool unsaved = false;      ///< state.files.preset_path does not hold the present settings
    std::optional<LostFacts> lost;
};

/// Requests to the application: scenes and presets to load, save or restore.
struct PresetRequests {
    std::optional<std::string> load_scene;   ///< key of a built-in scene, or path of a file
    std::optional<std::string> load_preset;  ///< key of a built-in preset, or path of a file
    std::optional<std::string> save_preset;  ///< path
    std::optional<std::string> open_file;    ///< path of a scene or a preset, by its extension
    std::optional<std::string> save_about;   ///< sentence to save in the preset
    bool replace = false;                    ///< save over a file that was neither opened nor saved before
    bool restore_lost = false;               ///< show the session that a crash has left
    bool discard_lost = false;               ///< delete it
    bool reset_all = false;                  ///< go back to the scene's own settings
    bool cancel_load = false;                ///< keep the scene that is shown
    bool reload_scene = false;               ///< read the shown scene's files again
    bool keep_scene = false;                 ///< do not offer that until they change once more
};

/// Draws the popup `id` of presets by topic, while it is open. @param open key of the preset that is open
void draw_presets_menu(const char* id, std::span<const PresetEntry> presets, const std::string& open,
                       PresetRequests& requests);
/// Returns the width of the popup of presets, pixels.
float presets_menu_width();

}  // namespace si
