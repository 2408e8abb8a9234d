// A scene with the settings to look at it, and how they came about.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/session/presets.h"
#include "renderer/gltf/gltf.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

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

/// What the options amount to while there is no scene yet.
struct SessionPlan {
    std::string scene_name;  ///< to be read with load_scene()
    std::optional<Preset> preset;
    std::string preset_path;
    std::vector<std::string> sets;
    Settings settings;  ///< the preset, else program defaults, and `sets` over them
};

/// Finds what is wrong with the options themselves. @throws UsageError, Error (a preset that cannot be read)
SessionPlan plan_session(const SessionOptions& options);

/// Which scene of a file the plan is for.
GltfOptions scene_options(const SessionPlan& plan);

struct ComposedSettings {
    Settings settings;
    std::vector<std::string> notes;  ///< repairs and remarks
};

/// compose_session() for a scene that stands as `moment` says.
ComposedSettings compose_settings(const SessionPlan& plan, const Scene& scene, const SceneSettings& moment,
                                  std::vector<std::string>* left_out = nullptr);

/// Poses the scene and composes the settings: program defaults, then the scene's suggestions or the preset (which holds
/// them already), then the sets. @param left_out gets one line for each thing chosen that the scene lacks, which is
/// then left out; null: it throws. @throws UsageError, Error
Session compose_session(const SessionPlan& plan, Scene scene, std::vector<std::string>* left_out = nullptr);

/// plan_session(), load_scene() and compose_session(). @throws UsageError, Error
Session open_session(const SessionOptions& options);

/// Applies one "KEY=VALUE". @throws UsageError
void apply_set(Settings& settings, const std::string& assignment);

/// Writes the scene's suggested values into `settings`. @throws Error when a suggestion is no setting.
void apply_suggested(const Scene& scene, Settings& settings);

/// Overrides of objects that the scene lacks: removed and told of in `left_out`, or (null) thrown.
/// @param preset the file that they are from; empty: the command line. @throws UsageError, Error
void check_objects(const Scene& scene, Settings& settings, const std::string& preset,
                   std::vector<std::string>* left_out);

/// Node paths of what object.PATH.shown hides.
std::set<std::string> hidden_paths(const Settings& settings);

/// Poses a scene as scene.animation and scene.time say, and places it as scene.distance, direction and scale do. A
/// file without a ground gets one where scene.ground lets it (renderer/scene/ground.h).
/// What is hidden stays so.
/// Returns a remark when there is nothing to pose, else "".
/// @throws UsageError when there is no such animation.
std::string pose_scene(Scene& scene, const SceneSettings& settings);

}  // namespace si
