#include "app/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "renderer/animation.h"
#include "renderer/error.h"
#include "renderer/param.h"
#include "renderer/scenes/builtin.h"

namespace si {
namespace {

namespace fs = std::filesystem;

/// The scene a preset was made for: a relative path counts from here, else from the preset's folder.
std::string scene_of_preset(const Preset& preset, const std::string& preset_path) {
    std::error_code error;
    if (preset.scene.empty() || fs::exists(preset.scene, error)) return preset.scene;
    const fs::path beside = fs::path(preset_path).parent_path() / preset.scene;
    return fs::exists(beside, error) ? beside.string() : preset.scene;
}

}  // namespace

void apply_set(Settings& settings, const std::string& assignment) {
    // Node paths may hold '='; values never do.
    const auto equals = assignment.rfind('=');
    if (equals == std::string::npos) {
        throw UsageError(fmt::format("--set \"{}\": KEY=VALUE is wanted, such as bias.slope=2", assignment));
    }
    set_setting(settings, assignment.substr(0, equals), assignment.substr(equals + 1));
}

void apply_suggested(const Scene& scene, Settings& settings) {
    for (const auto& [key, value] : scene.suggested) {
        try {
            set_setting(settings, key, value);
        } catch (const UsageError& e) {
            throw Error(fmt::format("{}: its suggested settings: {}", scene.name, e.what()));
        }
    }
}

void check_objects(const Scene& scene, const Settings& settings) {
    if (settings.objects.empty()) return;
    std::vector<std::string> paths;
    for (const Node& node : scene.nodes) paths.push_back(node.path);
    for (const auto& [path, object] : settings.objects) {
        if (std::find(paths.begin(), paths.end(), path) != paths.end()) continue;
        const std::string nearest = nearest_name(path, paths);
        throw UsageError(fmt::format("object.{}: {} has no such node{}", path, scene.name,
                                     nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest)));
    }
}

std::string pose_scene(Scene& scene, const SceneSettings& settings) {
    if (!scene.rig || scene.rig->animations.empty()) {
        return settings == SceneSettings{}
                   ? ""
                   : fmt::format("{} has no animation: scene.animation and scene.time have no effect", scene.name);
    }
    const int count = int(scene.rig->animations.size());
    if (settings.animation < -1 || settings.animation >= count) {
        throw UsageError(
            fmt::format("scene.animation {}: {} has {} animation{}; choose 0 to {}, or -1 for the rest pose",
                        settings.animation, scene.name, count, count == 1 ? "" : "s", count - 1));
    }
    pose(scene, settings.animation, settings.time);
    return "";
}

Session open_session(const SessionOptions& options) {
    Settings trial;
    for (const std::string& assignment : options.sets) apply_set(trial, assignment);
    std::optional<Preset> preset;
    if (!options.preset.empty()) preset = load_preset(options.preset);

    Session session;
    session.scene_name = options.scene;
    if (session.scene_name.empty() && preset) session.scene_name = scene_of_preset(*preset, options.preset);
    if (session.scene_name.empty()) session.scene_name = std::string(builtin_scenes().front().key);
    session.scene = load_scene(session.scene_name);
    // First of all, since what the scene suggests depends on where things are.
    Settings moment = preset ? preset->settings : Settings{};
    for (const std::string& assignment : options.sets) apply_set(moment, assignment);
    const std::string remark = pose_scene(session.scene, moment.scene);
    if (preset) {
        session.settings = preset->settings;
        try {
            check_objects(session.scene, session.settings);
        } catch (const UsageError& e) {
            throw Error(fmt::format("{}: {}", options.preset, e.what()));
        }
    } else {
        apply_suggested(session.scene, session.settings);
    }
    for (const std::string& assignment : options.sets) apply_set(session.settings, assignment);
    check_objects(session.scene, session.settings);
    session.notes = sanitise(session.settings);
    if (!remark.empty()) session.notes.push_back(remark);
    for (const std::string& warning : session.scene.warnings) {
        session.notes.push_back(fmt::format("{}: {}", session.scene_name, warning));
    }
    return session;
}

}  // namespace si
