// Presets and scenes as the editor lists, opens and saves them, and what a crash left.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace si {

/// A preset that ships with the program.
struct PresetEntry {
    std::string key, title, topic, about;
};

/// What a crash left behind.
struct LostFacts {
    std::string scene, when;  ///< "3 minutes ago"
};

/// A file that exists and is to be replaced, once a person agrees.
struct Replacement {
    std::string path;
    std::optional<std::string> about;
};

struct PresetsFacts {
    std::span<const PresetEntry> presets, hard_cases;            ///< two walks, each in its order
    std::span<const std::string> recent_scenes, recent_presets;  ///< paths, the newest first
    bool unsaved = false;  ///< state.files.preset_path does not hold the present settings
    std::optional<LostFacts> lost;
};

struct PresetRequests {
    std::optional<std::string> load_scene, load_preset, save_preset;
    std::optional<std::string> open_file;   ///< a scene or a preset, by its extension
    std::optional<std::string> save_about;  ///< the sentence to save along
    bool replace = false;                   ///< save over a file that was neither opened nor saved before
    bool restore_lost = false, discard_lost = false;
    bool reset_all = false;    ///< to the scene's own settings
    bool cancel_load = false;  ///< keep the scene that is shown
};

}  // namespace si
