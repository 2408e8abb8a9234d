// Session: a scene with its settings, composed from a preset, the scene's suggestions and --set.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "app/session/engine_session.h"
#include "app/session/presets.h"
#include "renderer/gltf/gltf.h"
#include "renderer/profiles/engine_wording.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

namespace si {

/// Scene, preset, engine profile and settings, as the user gave them on the command line.
struct SessionOptions {
    std::string scene;              ///< built-in key or path; empty: the preset's scene, else the default scene
    std::string preset;             ///< built-in key or path; empty: none
    std::vector<std::string> sets;  ///< "KEY=VALUE", applied in order after everything else
    /// Files that the command writes. open_session() throws UsageError if scene or preset is read from one of them.
    std::vector<std::filesystem::path> outputs = {};
    /// Engine profile whose limits and parameters apply (`list profiles`); empty: none. `sets` may then name parameters
    /// of the engine: "engine.PARAMETER=VALUE".
    std::string profile = {};
};

/// Loaded and posed scene with its settings, composed from preset, scene and --set. Commands and the editor work on a
/// session.
struct Session {
    std::string scene_name;  ///< name or path given to load_scene()
    Scene scene;
    Settings settings;
    std::vector<std::string> notes;  ///< remarks about the scene, one line each
    EngineWording engine = {};       ///< engine whose parameters texts name; without a profile: none
};

/// Checked options of a session (a scene with its settings). The preset is read already, the scene is not.
struct SessionPlan {
    std::string scene_name;  ///< for load_scene()
    std::optional<Preset> preset;
    std::string preset_path;
    std::vector<std::string> sets;
    Settings settings;          ///< the preset or the program's defaults, with `sets` applied
    EngineSession engine = {};  ///< profile, and values in the engine's parameters
};

/// Checks the scene, preset and settings that the command line gives, and reads the preset but not the scene.
/// @throws UsageError; Error for an unreadable preset
SessionPlan plan_session(const SessionOptions& options);

/// Returns the name of a preset's scene for load_scene(). A path is relative to the preset's folder if the file exists
/// there, else to the working directory. Empty if the preset names no scene.
/// @param preset_path path of the preset's file, or key of a built-in preset
std::string scene_of_preset(const Preset& preset, const std::string& preset_path);
/// Returns the scene's name to store in a preset's file: a key of a built-in scene, a relative path if the scene is
/// below the preset's folder, else an absolute path. The preset then loads from any working directory.
/// @param scene_name name for load_scene() @param preset_path path of the preset's file
std::string scene_for_preset(const std::string& scene_name, const std::filesystem::path& preset_path);

/// Returns the options with which load_scene() reads the scene of a session plan: the scene inside the file, its up
/// axis and unit.
GltfOptions scene_options(const SessionPlan& plan);

/// Settings of a scene, composed from defaults, preset and --set, with the notes made meanwhile.
struct ComposedSettings {
    Settings settings;
    std::vector<std::string> notes;  ///< repairs and remarks
};

/// Composes the settings of a scene that is already posed: program defaults, then the preset or the scene's
/// suggestions, then --set.
/// @param pose animation, time and placement of the scene
/// @param left_out receives one line for each chosen object or camera that the scene lacks; null: throws instead
/// @throws UsageError, Error
ComposedSettings compose_settings(const SessionPlan& plan, const Scene& scene, const SceneSettings& pose,
                                  std::vector<std::string>* left_out = nullptr);

/// Sets animation, time and placement of a loaded scene (pose_scene()), and composes its settings: program defaults,
/// then the preset or the scene's suggestions, then --set.
/// @param left_out receives one line for each chosen thing that the scene lacks (an object, a camera), which is then
/// ignored; null: throws instead @throws UsageError, Error
Session compose_session(const SessionPlan& plan, Scene scene, std::vector<std::string>* left_out = nullptr);

/// Checks that a command writes no file that it reads: neither a file of the scene nor the preset.
/// @param preset path of the preset; empty: none @throws UsageError
void require_outputs_not_read(std::span<const std::filesystem::path> outputs, const Scene& scene,
                              const std::string& preset);

/// Opens a session (a scene with its settings) for a command: checks the options, loads the scene, poses it and
/// composes its settings.
/// @throws UsageError, Error
Session open_session(const SessionOptions& options);

/// Changes one setting by an assignment "KEY=VALUE" of --set, and the settings that the value implies
/// (implied_values()). Unlike in apply_sets(), a new bias.kind does not set its starting values (bias settings that it
/// brings along). @throws UsageError
void apply_set(Settings& settings, const std::string& assignment);
/// Changes settings by all assignments "KEY=VALUE" of --set, in order. An assignment that changes bias.kind also sets
/// the starting values of the new kind (bias settings that it brings along). If another assignment names one of these
/// settings, before or after, the value of that assignment counts.
/// @throws UsageError
void apply_sets(Settings& settings, std::span<const std::string> assignments);
/// Returns the keys of the settings that assignments "KEY=VALUE" of --set change, with those that a value implies.
/// @throws UsageError
std::set<std::string> assigned_keys(std::span<const std::string> assignments);

/// Returns the settings with which a scene opens without preset and --set: the program's defaults, then the values that
/// the scene suggests. @throws Error when a suggestion names no setting
Settings base_settings(const Scene& scene);

/// Removes settings of objects (object.PATH.*) that the scene lacks.
/// @param preset preset of these settings, for messages; empty: they come from the command line
/// @param left_out receives one line for each removed object; null: throws instead @throws UsageError, Error
void check_objects(const Scene& scene, Settings& settings, const std::string& preset,
                   std::vector<std::string>* left_out);

/// Returns the node paths of the objects that settings hide (object.PATH.shown is false).
std::set<std::string> hidden_paths(const Settings& settings);

/// Poses a scene at scene.animation and scene.time and places it by scene.distance, scene.direction and scene.scale. A
/// scene that is loaded from a file and has no ground gets one if scene.ground allows it (renderer/scene/ground.h).
/// Hidden objects stay hidden.
/// @returns a note when there is nothing to animate, else "" @throws UsageError for an unknown animation
std::string pose_scene(Scene& scene, const SceneSettings& settings);

}  // namespace si
