#include "app/editor/preset_requests.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "app/editor/requests.h"
#include "app/session/command_line.h"
#include "renderer/base/error.h"
#include "ui/state/shortcuts.h"

namespace si {

void PresetRequestHandler::start(SessionPlan plan, std::string remark) {
    Arrival arrival{
        .scene_name = plan.scene_name, .file_scene = plan.settings.scene.index, .remark = std::move(remark)};
    if (plan.preset) arrival.guide = note(plan.preset_path, *plan.preset, plan.scene_name);
    arrival.plan = std::move(plan);
    scenes_.load(std::move(arrival));
}

void PresetRequestHandler::open(const std::string& name_or_path) {
    std::error_code error;
    if (name_or_path == state_.files.preset_path && !loader_.is_built_in(name_or_path) &&
        !std::filesystem::exists(name_or_path, error))
        throw Error(fmt::format(
            "{}: nothing is saved there yet. Save it first ({}); from then on {} goes back to what was saved",
            name_or_path, key_text(Command::SavePreset), key_text(Command::RevertPreset)));
    SessionPlan plan = plan_session({.scene = {}, .preset = name_or_path, .sets = {}});
    const std::string& about = plan.preset->about;
    const std::string remark =
        about.empty() ? "Opened " + name_or_path : fmt::format("Opened {}: {}", name_or_path, about);
    const bool has_own_scene = !plan.preset->scene.empty();
    plan.scene_name = scenes_.known_name(plan.scene_name);
    const bool shown = scenes_.is_shown(plan.scene_name, plan.settings.scene.index);
    if (has_own_scene && !shown) return start(std::move(plan), remark);
    if (has_own_scene) scenes_.cancel_loading();  // the preset belongs to the shown scene
    const std::vector<std::string> left_out = scenes_.apply_settings(plan.settings, name_or_path);
    state_.files.guide = note(name_or_path, *plan.preset, plan.scene_name);
    state_.log.add(LogKind::Info, remark);
    for (const std::string& text : left_out) report(state_, text);
}

void PresetRequestHandler::save(const std::string& path, const std::optional<std::string>& about, bool replace) {
    if (path.empty()) throw Error("the preset has no file name; save it as one");
    if (!loader_.save(path, state_.scene_name, state_.settings, about, replace)) {
        state_.files.replace = Replacement{path, about};
        return;
    }
    state_.files.preset_path = path;
    persistence_.note_preset(path);
    state_.log.add(LogKind::Info, "Saved " + path);
}

GuideNote PresetRequestHandler::note(const std::string& name_or_path, Preset preset, const std::string& scene_name) {
    state_.files.hidden_guide.clear();
    if (!loader_.is_built_in(name_or_path)) {
        state_.files.preset_path = name_or_path;
        persistence_.note_preset(name_or_path);
    }
    if (!preset.scene.empty()) preset.scene = scene_name;  // under the editor's name for the scene
    return loader_.register_opened(name_or_path, preset);
}

bool PresetRequestHandler::compare() {
    const Scene* scene = scenes_.scene();
    const bool known = loader_.has_file(state_.files.preset_path);
    const bool unsaved =
        scene && (known ? !loader_.file_holds(state_.files.preset_path, state_.scene_name, state_.settings)
                        : state_.settings != scenes_.original_settings());
    const std::optional<CompareWith> before = comparison_ ? std::optional(comparison_->with) : std::nullopt;
    const bool picture_comparison = state_.comparison.view != ComparisonView::Off && !state_.comparison.reference;
    const bool shown = scene && (state_.tab == BottomTab::Compare || picture_comparison);
    comparison_ =
        shown ? &loader_.compare(state_.compare, base_settings(*scene), state_.scene_name, state_.pinned) : nullptr;
    const std::optional<CompareWith> after = comparison_ ? std::optional(comparison_->with) : std::nullopt;
    return std::exchange(unsaved_, unsaved) != unsaved || before != after;
}

bool PresetRequestHandler::would_be_lost() const {
    if (!unsaved_ || loader_.has_file(state_.files.preset_path)) return unsaved_;
    Settings work = state_.settings;
    work.camera = scenes_.original_settings().camera;
    work.view = scenes_.original_settings().view;
    return work != scenes_.original_settings();
}

void PresetRequestHandler::restore_lost() {
    const Autosave::Lost* lost = persistence_.lost();
    if (!lost) return;
    scenes_.show({.scene_name = lost->preset.scene,
                  .file_scene = lost->preset.settings.scene.index,
                  .settings = lost->preset.settings,
                  .remark = "Restored what was shown when the editor ended",
                  .lost = true});
}

void PresetRequestHandler::fill(EditorFrame& frame) const {
    frame.presets = loader_.entries();
    frame.hard_cases = loader_.hard_cases();
    frame.comparison = comparison_;
    frame.unsaved = unsaved_;
}

}  // namespace si
