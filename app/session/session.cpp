#include "app/session/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/base/absolute_path.h"
#include "app/base/output.h"
#include "renderer/base/did_you_mean.h"
#include "renderer/base/error.h"
#include "renderer/scene/animation.h"
#include "renderer/scene/extreme_points.h"
#include "renderer/scene/ground.h"
#include "renderer/scene/placement.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/idle_reason.h"
#include "renderer/settings/param.h"
#include "renderer/settings/starting_values.h"

namespace si {
namespace {

namespace fs = std::filesystem;

/// Returns true if the plan names this scene.
bool is_one_scene(const std::string& scene, const SessionPlan& plan) {
    std::error_code error;
    return scene == plan.scene_name || fs::equivalent(scene, plan.scene_name, error);
}

/// Splits an assignment "KEY=VALUE" of --set. @throws UsageError
std::pair<std::string, std::string> key_and_value(const std::string& assignment) {
    // The last '=' separates: node paths may contain '=', values never do.
    const auto equals = assignment.rfind('=');
    if (equals == std::string::npos)
        throw UsageError(fmt::format("--set \"{}\": must be KEY=VALUE, such as bias.slope=2", assignment));
    return {assignment.substr(0, equals), assignment.substr(equals + 1)};
}

/// Formats the indices of `count` things: "0", "0 to 5".
std::string indices(int count) {
    return count == 1 ? "0" : fmt::format("0 to {}", count - 1);
}

/// @throws UsageError when the scene lacks the chosen camera; with `left_out`, the first one is chosen instead.
void check_camera(const Scene& scene, CameraSettings& camera, std::vector<std::string>* left_out) {
    const int count = int(scene.cameras.size());
    if (camera.index <= 0 || camera.index < count) return;
    const std::string text =
        fmt::format("camera.index {}: {} has {} camera{}; {}", camera.index, scene.name, count, count == 1 ? "" : "s",
                    count == 0 ? "leave it out" : fmt::format("choose {}, or -1 to show everything", indices(count)));
    if (!left_out) throw UsageError(text);
    left_out->push_back(text);
    camera.index = 0;
}

}  // namespace

std::string scene_of_preset(const Preset& preset, const std::string& preset_path) {
    if (preset.scene.empty() || is_builtin_scene(preset.scene)) return preset.scene;
    std::error_code error;
    const fs::path in_folder = fs::path(preset_path).parent_path() / preset.scene;
    return fs::exists(in_folder, error) ? in_folder.string() : preset.scene;
}

std::string scene_for_preset(const std::string& scene_name, const fs::path& preset_path) {
    if (is_builtin_scene(scene_name)) return scene_name;
    const fs::path file = absolute_path(scene_name);
    const fs::path relative = file.lexically_relative(absolute_path(preset_path).parent_path());
    return relative.empty() || *relative.begin() == ".." ? file.string() : relative.string();
}

GltfOptions scene_options(const SessionPlan& plan) {
    return {.file = file_choices(plan.settings.scene)};
}

void check_objects(const Scene& scene, Settings& settings, const std::string& preset,
                   std::vector<std::string>* left_out) {
    if (settings.objects.empty()) return;
    std::vector<std::string> paths;
    for (const Node& node : scene.nodes) paths.push_back(node.path);
    std::erase_if(settings.objects, [&](const auto& entry) {
        const std::string& path = entry.first;
        if (std::find(paths.begin(), paths.end(), path) != paths.end()) return false;
        const std::string text =
            fmt::format("object.{}: {} has no such node{}", path, scene.name, did_you_mean(nearest_name(path, paths)));
        if (left_out)
            left_out->push_back(text);
        else if (preset.empty())
            throw UsageError(text);
        else
            throw Error(fmt::format("{}: {}", preset, text));
        return true;
    });
}

void apply_set(Settings& settings, const std::string& assignment) {
    const auto [key, value] = key_and_value(assignment);
    set_setting(settings, key, value);
}

std::set<std::string> assigned_keys(std::span<const std::string> assignments) {
    std::set<std::string> keys;
    for (const std::string& assignment : assignments) {
        const auto [key, value] = key_and_value(assignment);
        const auto ref = find_setting(key);
        if (!ref) continue;
        keys.insert(setting_key(*ref));
        for (const auto& [implied, unused] : implied_values(*ref, value)) keys.insert(setting_key(implied));
    }
    return keys;
}

void apply_sets(Settings& settings, std::span<const std::string> assignments) {
    const Settings before = settings;
    for (const std::string& assignment : assignments) apply_set(settings, assignment);
    set_starting_values(before, settings, assigned_keys(assignments));
}

Settings base_settings(const Scene& scene) {
    Settings settings;
    try {
        set_settings(settings, scene.suggested);
    } catch (const UsageError& e) {
        throw Error(fmt::format("{}: its suggested settings: {}", scene.name, e.what()));
    }
    return settings;
}

std::set<std::string> hidden_paths(const Settings& settings) {
    std::set<std::string> hidden;
    for (const auto& [path, own] : settings.objects)
        if (!own.shown) hidden.insert(path);
    return hidden;
}

std::string pose_scene(Scene& scene, const SceneSettings& settings) {
    std::set<std::string> hidden;
    for (const HiddenObject& h : scene.hidden) hidden.insert(scene.nodes[std::size_t(h.object.node)].path);
    hide_objects(scene, {});  // the ground is the last object
    std::string remark;
    const bool grounded = settings.ground == Ground::Auto && !scene.file_scenes.empty();
    if (!grounded) remove_ground(scene);
    if (!scene.rig || scene.rig->animations.empty()) {
        if (settings.animation != SceneSettings{}.animation || settings.time != SceneSettings{}.time ||
            settings.fit_animation)
            remark = fmt::format(
                "{} has no animation: scene.animation, scene.time and scene.fit_animation have no effect", scene.name);
    } else {
        const int count = int(scene.rig->animations.size());
        if (settings.animation < -1 || settings.animation >= count)
            throw UsageError(
                fmt::format("scene.animation {}: {} has {} animation{}; choose {}, or -1 for the rest pose",
                            settings.animation, scene.name, count, count == 1 ? "" : "s", indices(count)));
        // Bounds and animation are known before the lights of a file are placed.
        measure_animation_bounds(scene, settings.fit_animation ? settings.animation : -1);
        // Ground and camera are set before posing, so that they do not depend on scene.time.
        if (scene.framed.empty() || (grounded && scene.ground_bounds.empty() && !scene.has_floor)) {
            pose(scene, 0, 0);
            store_framing_points(scene);
            if (grounded) add_ground(scene);
        }
        pose(scene, settings.animation, settings.time);
    }
    const bool moves = scene.rig && !scene.rig->animations.empty();
    if (scene.framed.empty() && !scene.file_scenes.empty() && !moves) store_framing_points(scene);
    if (grounded) add_ground(scene);
    if (const glm::dmat4 placement = placement_of(settings); placement != scene.placement) place(scene, placement);
    hide_objects(scene, hidden);
    return remark;
}

SessionPlan plan_session(const SessionOptions& options) {
    SessionPlan plan;
    plan.sets = options.sets;
    plan.engine = take_engine_sets(options.profile, plan.sets);
    Settings trial;  // checked before the preset is read, so that a wrong --set is reported first
    apply_sets(trial, plan.sets);
    plan.scene_name = options.scene;
    if (!options.preset.empty()) {
        plan.preset = load_preset(options.preset);
        plan.preset_path = options.preset;
        if (plan.scene_name.empty()) plan.scene_name = scene_of_preset(*plan.preset, options.preset);
    }
    if (plan.scene_name.empty()) plan.scene_name = std::string(builtin_scenes().front().key);
    if (plan.preset) plan.settings = plan.preset->settings;
    apply_sets(plan.settings, plan.sets);
    return plan;
}

namespace {

/// Adds a note for each `--set` that changes a setting without effect.
void add_idle_notes(const std::vector<std::string>& sets, const Settings& settings, std::vector<std::string>& notes) {
    for (const std::string& assignment : sets) {
        const std::string key = assignment.substr(0, assignment.rfind('='));
        const std::optional<SettingRef> ref = find_setting(key);
        if (!ref || get_value(settings, *ref) == default_value(*ref)) continue;
        if (const std::string_view reason = idle_reason(settings, *ref); !reason.empty())
            notes.push_back(fmt::format("{}: {}", key, reason));
    }
}

}  // namespace

ComposedSettings compose_settings(const SessionPlan& plan, const Scene& scene, const SceneSettings& moment,
                                  std::vector<std::string>* left_out) {
    ComposedSettings out;
    bool another = false;  // the preset was saved with a camera
    if (plan.preset) {
        out.settings = plan.preset->settings;
        const std::string& saved_with = plan.preset->scene;
        another = !saved_with.empty() && !is_one_scene(scene_of_preset(*plan.preset, plan.preset_path), plan);
        check_objects(scene, out.settings,
                      another ? fmt::format("{}, saved with {}", plan.preset_path, saved_with) : plan.preset_path,
                      left_out);
    } else {
        out.settings = base_settings(scene);
    }
    carry_settings(out.settings, out.settings.scene, moment);
    apply_sets(out.settings, plan.sets);
    out.settings.scene = moment;
    check_objects(scene, out.settings, {}, left_out);
    check_camera(scene, out.settings.camera, left_out);
    out.notes = sanitise(out.settings);
    const std::vector<std::string> engine_notes =
        apply_engine(plan.engine, scene, plan.preset.has_value(), plan.sets, out.settings);
    out.notes.insert(out.notes.end(), engine_notes.begin(), engine_notes.end());
    const auto by_hand = [](const Settings& settings) { return settings.camera.source == CameraSource::Manual; };
    if (another && by_hand(plan.preset->settings) && by_hand(out.settings))
        out.notes.push_back(
            fmt::format("{} was saved with the scene {}, where its camera stood: camera.source=auto shows all of {}",
                        plan.preset_path, plan.preset->scene, scene.name));
    if (file_choices(moment) != FileChoices{} && scene.file_scenes.empty())
        out.notes.push_back(
            fmt::format("{} is no file: scene.index, scene.up and scene.unit have no effect", scene.name));
    return out;
}

Session compose_session(const SessionPlan& plan, Scene scene, std::vector<std::string>* left_out) {
    // The pose comes first, because suggested settings depend on positions.
    SceneSettings moment = plan.settings.scene;
    std::string remark;
    try {
        remark = pose_scene(scene, moment);
    } catch (const UsageError& e) {
        if (!left_out) throw;
        left_out->push_back(e.what());
        moment.animation = SceneSettings{}.animation;
        moment.time = SceneSettings{}.time;
        pose_scene(scene, moment);
    }
    ComposedSettings composed = compose_settings(plan, scene, moment, left_out);
    add_idle_notes(plan.sets, composed.settings, composed.notes);
    hide_objects(scene, hidden_paths(composed.settings));
    if (!remark.empty()) composed.notes.push_back(remark);
    for (const std::string& warning : scene.warnings)
        composed.notes.push_back(fmt::format("{}: {}", plan.scene_name, warning));
    EngineWording engine;
    if (plan.engine.profile) {
        engine = {plan.engine.profile, map_facts(scene, composed.settings), composed.settings};
        engine.facts.angle_deg = plan.engine.angle_deg.value_or(MapFacts{}.angle_deg);
    }
    return {plan.scene_name, std::move(scene), std::move(composed.settings), std::move(composed.notes),
            std::move(engine)};
}

void require_outputs_not_read(std::span<const fs::path> outputs, const Scene& scene, const std::string& preset) {
    std::vector<fs::path> inputs{preset};
    for (const StampedFile& file : scene.files) inputs.push_back(file.path);
    require_outputs_not_read(outputs, inputs);
}

Session open_session(const SessionOptions& options) {
    const SessionPlan plan = plan_session(options);
    Scene scene = load_scene(plan.scene_name, scene_options(plan));
    require_outputs_not_read(options.outputs, scene, plan.preset_path);
    return compose_session(plan, std::move(scene));
}

}  // namespace si
