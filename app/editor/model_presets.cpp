// Presets, steps of undo and what a crash left: settings that arrive together with a scene.
#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "app/editor/model.h"
#include "renderer/base/error.h"

namespace si {
namespace {

bool same_scene(const std::string& a, const std::string& b) {
    std::error_code error;
    return a == b || std::filesystem::equivalent(a, b, error);
}

}  // namespace

void EditorModel::load_preset_file(const std::string& name_or_path) {
    SessionPlan plan = plan_session({.scene = {}, .preset = name_or_path, .sets = {}});
    const std::string& about = plan.preset->about;
    const std::string remark =
        about.empty() ? "Opened " + name_or_path : fmt::format("Opened {}: {}", name_or_path, about);
    const bool has_own_scene = !plan.preset->scene.empty();
    if (same_scene(plan.scene_name, state.scene_name)) plan.scene_name = state.scene_name;
    const bool shown = plan.scene_name == state.scene_name && plan.settings.scene.index == file_scene_;
    if (has_own_scene && !shown) return start_loading(std::move(plan), remark);
    if (has_own_scene) cancel_loading();  // it belongs to the scene that is shown
    std::vector<std::string> left_out;
    if (has_scene_) check_objects(scene_, plan.settings, name_or_path, &left_out);
    given_ = state.settings = plan.settings;
    state.guide = note_preset(name_or_path, *plan.preset, plan.scene_name);
    suggests_ = false;
    base_ = base_of_scene();
    state.log.add(LogKind::Info, remark);
    for (const std::string& text : left_out) report(text);
}

void EditorModel::save_preset_file(const std::string& path, const std::optional<std::string>& about, bool replace) {
    if (path.empty()) throw Error("the preset has no file name; save it as one");
    if (!desk_.save(path, state.scene_name, state.settings, about, replace)) {
        state.replace = Replacement{path, about};
        return;
    }
    state.preset_path = path;
    memory_.note_preset(path);
    state.log.add(LogKind::Info, "Saved " + path);
}

GuideNote EditorModel::note_preset(const std::string& name_or_path, Preset preset, const std::string& scene_name) {
    state.hidden_guide.clear();
    if (!desk_.is_built_in(name_or_path)) {
        state.preset_path = name_or_path;
        memory_.note_preset(name_or_path);
    }
    if (!preset.scene.empty()) preset.scene = scene_name;  // as the editor calls it
    return desk_.opened(name_or_path, preset);
}

bool EditorModel::compare() {
    const bool known = desk_.knows(state.preset_path);
    const bool unsaved = has_scene_ && (known ? !desk_.holds(state.preset_path, state.scene_name, state.settings)
                                              : state.settings != given_);
    const std::optional<CompareWith> before = comparison_ ? std::optional(comparison_->with) : std::nullopt;
    const bool against = state.against.view != AgainstView::Off && !state.against.truth;
    const bool shown = has_scene_ && (state.tab == BottomTab::Compare || against);
    comparison_ = shown ? &desk_.compare(state.compare, base_settings(scene_), state.scene_name) : nullptr;
    const std::optional<CompareWith> after = comparison_ ? std::optional(comparison_->with) : std::nullopt;
    return std::exchange(unsaved_, unsaved) != unsaved || before != after;
}

void EditorModel::show(Arrival arrival) {
    if (same_scene(arrival.scene_name, state.scene_name)) arrival.scene_name = state.scene_name;
    const bool same = has_scene_ && arrival.scene_name == state.scene_name && arrival.file_scene == file_scene_;
    if (!same) return start_loading(std::move(arrival));
    cancel_loading();
    std::vector<std::string> left_out;
    state.settings = *arrival.settings;
    check_objects(scene_, state.settings, arrival.scene_name, &left_out);
    state.guide = arrival.guide;
    if (arrival.lost) memory_.forget_lost();
    if (!arrival.remark.empty()) state.log.add(LogKind::Info, arrival.remark);
    for (const std::string& text : left_out) report(text);
}

void EditorModel::restore_lost() {
    const Autosave::Lost* lost = memory_.lost();
    if (!lost) return;
    show({.scene_name = lost->preset.scene,
          .file_scene = lost->preset.settings.scene.index,
          .settings = lost->preset.settings,
          .remark = "Restored what was shown when the editor ended",
          .lost = true});
}

void EditorModel::follow_step() {
    const Place place = state.history.place();
    const Settings settings = state.history.settings();
    show({.scene_name = place.scene,
          .file_scene = settings.scene.index,
          .settings = settings,
          .guide = place.guide,
          .step = true});
}

void EditorModel::keep() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    memory_.follow(state, std::chrono::duration<double>(now).count());
}

}  // namespace si
