#include "app/editor/preset_loader.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/editor/persistence.h"
#include "renderer/scenes/builtin.h"
#include "ui/state/shortcuts.h"

namespace si {
namespace {

namespace fs = std::filesystem;

/// Returns the scene's name to store in a preset file: a relative path if the scene is below the preset's folder, else
/// an absolute one, so that the preset loads from any working directory.
std::string scene_for(const fs::path& preset, const std::string& scene) {
    if (is_builtin_scene(scene)) return scene;
    const std::string file = whole_path(scene);
    const fs::path relative = fs::path(file).lexically_relative(fs::path(whole_path(preset)).parent_path());
    return relative.empty() || *relative.begin() == ".." ? file : relative.string();
}

}  // namespace

PresetLoader::PresetLoader() {
    for (const BuiltinPreset& p : builtin_presets()) entries_.push_back({p.key, p.title, p.topic, p.about});
    for (const BuiltinPreset& p : hard_case_presets()) hard_cases_.push_back({p.key, p.title, p.topic, p.about});
}

bool PresetLoader::is_built_in(const std::string& key) const {
    const auto named = [&](const PresetEntry& p) { return p.key == key; };
    return std::ranges::any_of(entries_, named) || std::ranges::any_of(hard_cases_, named);
}

GuideNote PresetLoader::register_opened(const std::string& name_or_path, const Preset& preset) {
    if (!is_built_in(name_or_path)) files_[whole_path(name_or_path)] = preset;
    return {name_or_path, preset.title, preset.about};
}

bool PresetLoader::save(const fs::path& path, const std::string& scene, const Settings& settings,
                        const std::optional<std::string>& about, bool replace) {
    const std::string key = whole_path(path);
    std::error_code error;
    if (!replace && !files_.contains(key) && fs::is_regular_file(path, error)) return false;
    Preset preset = files_.contains(key) ? files_.at(key) : Preset{};
    if (about) preset.about = *about;
    preset.scene = scene_for(path, scene);
    preset.settings = settings;
    save_preset(preset, path);
    preset.scene = scene;  // under the editor's name for the scene
    files_[key] = preset;
    if (comparison_ && comparison_->with.kind == CompareKind::Preset) comparison_.reset();
    return true;
}

bool PresetLoader::has_file(const std::string& path) const {
    return files_.contains(whole_path(path));
}

bool PresetLoader::file_holds(const std::string& path, const std::string& scene, const Settings& settings) const {
    const auto it = files_.find(whole_path(path));
    return it != files_.end() && it->second.settings == settings &&
           (it->second.scene.empty() || it->second.scene == scene);
}

const ComparisonFacts& PresetLoader::compare(const CompareWith& with, const Settings& base, const std::string& scene,
                                             const std::optional<PinnedSettings>& pinned) {
    if (with.kind == CompareKind::Pinned) {
        comparison_ = {with, {}, {}, {}};
        if (pinned) {
            comparison_->settings = pinned->settings;
            comparison_->scene = pinned->scene;
        } else
            comparison_->problem =
                fmt::format("Nothing is pinned; {} pins the present settings as A", key_text(Command::PinSettings));
    } else if (with.kind != CompareKind::Preset) {
        const bool defaults = with.kind == CompareKind::Defaults;
        comparison_ = {with, defaults ? Settings{} : base, defaults ? std::string() : scene, {}};
    } else if (!comparison_ || comparison_->with != with) {
        comparison_ = {with, {}, {}, {}};
        try {
            const Preset preset = load_preset(with.preset);
            comparison_->settings = preset.settings;
            comparison_->scene = preset.scene;
        } catch (const std::exception& e) {
            comparison_->problem = e.what();
        }
    }
    return *comparison_;
}

}  // namespace si
