#include "app/editor/preset_requests.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/base/absolute_path.h"
#include "app/editor/requests.h"
#include "renderer/base/error.h"
#include "ui/state/shortcuts.h"

namespace si {
namespace {

namespace fs = std::filesystem;

}  // namespace

PresetRequestHandler::PresetRequestHandler(EditorState& state, EditorPersistence& memory, SceneLoader& scenes)
    : state_(state), persistence_(memory), scenes_(scenes) {
    for (const BuiltinPreset& p : builtin_presets()) entries_.push_back({p.key, p.title, p.topic, p.about});
    for (const BuiltinPreset& p : hard_case_presets()) hard_cases_.push_back({p.key, p.title, p.topic, p.about});
}

void PresetRequestHandler::start(SessionPlan plan, std::string remark) {
    Arrival arrival{
        .scene_name = plan.scene_name, .file = file_choices(plan.settings.scene), .remark = std::move(remark)};
    if (plan.preset) {
        arrival.guide = {plan.preset_path, plan.preset->title, plan.preset->about};
        arrival.when_shown = [this, path = plan.preset_path, preset = *plan.preset, scene = plan.scene_name] {
            note_opened(path, preset, scene);
        };
    } else if (const auto hard = std::ranges::find(hard_cases_, plan.scene_name, &PresetEntry::key);
               hard != hard_cases_.end()) {
        arrival.guide = {hard->key, hard->title, hard->about};  // a hard case is a scene, too
    }
    arrival.plan = std::move(plan);
    scenes_.load(std::move(arrival));
}

void PresetRequestHandler::open(const std::string& name_or_path) {
    std::error_code error;
    if (name_or_path == state_.files.preset_path && !is_built_in(name_or_path) && !fs::exists(name_or_path, error))
        throw Error(fmt::format(
            "{}: nothing is saved there yet. Save it first ({}); from then on {} goes back to what was saved",
            name_or_path, key_text(Command::SavePreset), key_text(Command::RevertPreset)));
    SessionPlan plan = plan_session({.scene = {}, .preset = name_or_path, .sets = {}});
    const std::string& about = plan.preset->about;
    const std::string remark =
        about.empty() ? "Opened " + name_or_path : fmt::format("Opened {}: {}", name_or_path, about);
    const bool has_own_scene = !plan.preset->scene.empty();
    plan.scene_name = scenes_.known_name(plan.scene_name);
    const bool shown = scenes_.is_shown(plan.scene_name, file_choices(plan.settings.scene));
    if (has_own_scene && !shown) return start(std::move(plan), remark);
    if (has_own_scene) scenes_.cancel_loading();  // the preset belongs to the shown scene
    const std::vector<std::string> left_out = scenes_.apply_settings(plan.settings, name_or_path);
    note_opened(name_or_path, *plan.preset, plan.scene_name);
    state_.files.guide = {name_or_path, plan.preset->title, about};
    state_.log.add(LogKind::Info, remark);
    for (const std::string& text : left_out) report(state_, text);
}

void PresetRequestHandler::save(const std::string& path, const std::optional<std::string>& about, bool replace) {
    if (path.empty()) throw Error("the preset has no file name; save it as one");
    const std::string key = absolute_path(path).string();
    std::error_code error;
    if (!replace && !files_.contains(key) && fs::is_regular_file(path, error)) {
        state_.files.replace = Replacement{path, about};
        return;
    }
    if (const Scene* scene = scenes_.scene()) require_outputs_not_read(std::vector<fs::path>{path}, *scene, {});
    // A file that was opened keeps its title, topic and sentence.
    Preset preset = files_.contains(key) ? files_.at(key) : Preset{};
    if (about) preset.about = *about;
    preset.scene = scene_for_preset(state_.scene_name, path);
    preset.settings = state_.settings;
    save_preset(preset, path);
    preset.scene = state_.scene_name;  // under the editor's name for the scene
    files_[key] = preset;
    if (comparison_ && comparison_->with.kind == CompareKind::Preset) comparison_.reset();
    state_.files.preset_path = path;
    persistence_.note_preset(path);
    state_.log.add(LogKind::Info, "Saved " + path);
}

void PresetRequestHandler::note_opened(const std::string& name_or_path, Preset preset, const std::string& scene_name) {
    state_.files.hidden_guide.clear();
    if (is_built_in(name_or_path)) return;
    if (!preset.scene.empty()) preset.scene = scene_name;  // under the editor's name for the scene
    state_.files.preset_path = name_or_path;
    persistence_.note_preset(name_or_path);
    files_[absolute_path(name_or_path).string()] = std::move(preset);
}

bool PresetRequestHandler::is_built_in(const std::string& key) const {
    const auto named = [&](const PresetEntry& p) { return p.key == key; };
    return std::ranges::any_of(entries_, named) || std::ranges::any_of(hard_cases_, named);
}

const Preset* PresetRequestHandler::known_file() const {
    const auto it = files_.find(absolute_path(state_.files.preset_path).string());
    return it == files_.end() ? nullptr : &it->second;
}

void PresetRequestHandler::load_comparison(const Scene& scene) {
    const CompareWith& with = state_.compare;
    if (with.kind == CompareKind::Preset && comparison_ && comparison_->with == with) {
        // The file of the compared scene may have been opened under another path since.
        if (comparison_->scene != state_.scene_name) comparison_->scene = scenes_.known_name(comparison_->scene);
        return;
    }
    comparison_ = {with, {}, {}, {}};
    const auto compare_with = [&](const auto& other) {
        comparison_->settings = other.settings;
        comparison_->scene = other.scene;
    };
    try {
        if (with.kind == CompareKind::Preset) {
            Preset preset = load_preset(with.preset);
            preset.scene = scenes_.known_name(scene_of_preset(preset, with.preset));
            compare_with(preset);
        } else if (with.kind == CompareKind::Pinned && state_.pinned) {
            compare_with(*state_.pinned);
        } else if (with.kind == CompareKind::Tried && state_.tried) {
            compare_with(*state_.tried);
        } else if (with.kind == CompareKind::Tried) {
            throw Error("Nothing is tried; Auto bias tries every kind of bias");
        } else if (with.kind == CompareKind::Pinned) {
            throw Error(
                fmt::format("Nothing is pinned; {} pins the present settings as A", key_text(Command::PinSettings)));
        } else if (with.kind != CompareKind::Defaults) {
            compare_with(Preset{.scene = state_.scene_name, .settings = base_settings(scene)});
        }
    } catch (const std::exception& e) {
        comparison_->problem = e.what();
    }
}

bool PresetRequestHandler::update_comparisons() {
    const Scene* scene = scenes_.scene();
    const Preset* known = known_file();
    const bool unsaved = scene && (known ? known->settings != state_.settings ||
                                               (!known->scene.empty() && known->scene != state_.scene_name)
                                         : state_.settings != scenes_.original_settings());
    const auto compared = [&] { return comparison() ? std::optional(comparison()->with) : std::nullopt; };
    const std::optional<CompareWith> before = compared();
    const bool picture_comparison = state_.comparison.view != ComparisonView::Off && !state_.comparison.reference;
    shows_comparison_ = scene && (state_.shows(Page::Compare) || picture_comparison);
    if (shows_comparison_) load_comparison(*scene);
    return std::exchange(unsaved_, unsaved) != unsaved || before != compared();
}

bool PresetRequestHandler::would_be_lost() const {
    if (!unsaved_ || known_file()) return unsaved_;
    Settings work = state_.settings;
    work.camera = scenes_.original_settings().camera;
    work.view = scenes_.original_settings().view;
    return work != scenes_.original_settings();
}

void PresetRequestHandler::restore_lost() {
    const Autosave::Lost* lost = persistence_.lost();
    if (!lost) return;
    scenes_.show({.scene_name = lost->preset.scene,
                  .file = file_choices(lost->preset.settings.scene),
                  .settings = lost->preset.settings,
                  .remark = "Restored what was shown when the editor ended",
                  .lost = true});
}

bool PresetRequestHandler::update_pictures(std::span<const std::string> wanted) {
    if (!pictures_.update(wanted)) return false;
    for (auto* entries : {&entries_, &hard_cases_})
        for (PresetEntry& entry : *entries) entry.picture = pictures_.texture(entry.key);
    return true;
}

void PresetRequestHandler::fill(EditorFrame& frame) const {
    frame.presets = entries_;
    frame.hard_cases = hard_cases_;
    frame.comparison = comparison();
    frame.unsaved = unsaved_;
}

}  // namespace si
