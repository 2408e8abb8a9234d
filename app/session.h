// A scene with the settings to look at it, and how they came about.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/presets.h"
#include "renderer/scene.h"
#include "renderer/settings.h"

namespace si {

struct SessionOptions {
    std::string scene;              ///< built-in key or path; empty: the preset's scene, else the default one
    std::string preset;             ///< built-in key or path; empty: none
    std::vector<std::string> sets;  ///< "KEY=VALUE", applied in order after everything else
};

struct Session {
    std::string scene_name;  ///< what load_scene() was given
    Scene scene;
    Settings settings;
    std::vector<std::string> notes;  ///< remarks about the scene, one line each
};

/// Applies one "KEY=VALUE". @throws UsageError
void apply_set(Settings& settings, const std::string& assignment);

/// Writes the scene's suggested values into `settings`. @throws Error when a suggestion is no setting.
void apply_suggested(const Scene& scene, Settings& settings);

/// Poses a scene as scene.animation and scene.time say. Returns a remark when they have no effect, else "".
/// @throws UsageError when there is no such animation.
std::string pose_scene(Scene& scene, const SceneSettings& settings);

/// @throws Error when an object override names a node that the scene lacks; it names the nearest.
void check_objects(const Scene& scene, const Settings& settings);

/// Program defaults, then the scene's suggestions or the preset (which holds them already), then `sets`.
/// What is wrong with the options is found before the scene is loaded. @throws UsageError, Error
Session open_session(const SessionOptions& options);

}  // namespace si
