#include "app/session/preset_diff.h"

#include <fmt/format.h>

#include "renderer/base/printable.h"
#include "renderer/settings/idle_reason.h"
#include "ui/widgets/setting_widgets.h"

namespace si {
namespace {

std::string heading(const Settings& settings, const SettingRef& ref) {
    if (ref.param->scope == Scope::Object) return "Object " + ref.object;
    const std::string_view key = ref.param->key;
    return ref.param->scope == Scope::Light ? light_title(settings, ref.light)
                                            : std::string(setting_group_label(key.substr(0, key.find('.'))));
}

std::string scene_text(const std::string& scene) {
    return scene.empty() ? "any" : scene;
}

}  // namespace

std::vector<PresetDifference> preset_differences(const Preset& a, const Preset& b) {
    std::vector<PresetDifference> list;
    if (a.scene != b.scene)
        list.push_back({"Scene", "scene", fmt::format("scene: {} → {}", scene_text(a.scene), scene_text(b.scene)), {}});
    for (const SettingRef& ref : differing_settings(a.settings, b.settings)) {
        PresetDifference d{heading(b.settings, ref), setting_key(ref), {}, {}};
        d.text = fmt::format("{}: {} ({})", d.key, change_text(a.settings, b.settings, ref), ref.param->label);
        const auto idle = idle_reason(a.settings, ref);
        if (!idle.empty() && !idle_reason(b.settings, ref).empty()) d.note = idle;
        list.push_back(std::move(d));
    }
    return list;
}

std::string differences_text(const std::vector<PresetDifference>& differences, const std::string& name_a,
                             const std::string& name_b) {
    if (differences.empty()) return fmt::format("{} and {} are equal\n", name_a, name_b);
    std::string text = fmt::format("{} → {}: {} difference{}\n", name_a, name_b, differences.size(),
                                   differences.size() == 1 ? "" : "s");
    std::string group;
    for (const PresetDifference& d : differences) {
        // Paths and scenes come from a file: control characters are escaped.
        if (d.group != group) text += printable(group = d.group, std::string::npos) + "\n";
        text += fmt::format("  {}{}{}\n", printable(d.text, std::string::npos), d.note.empty() ? "" : "; ", d.note);
    }
    return text;
}

Preset load_preset_or_default(const std::string& name_or_path) {
    return name_or_path == "default" ? Preset{} : load_preset(name_or_path);
}

}  // namespace si
