// The tour of the guided presets (docs/presets.md).
#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/session/command_line.h"
#include "app/session/presets.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

constexpr std::string_view kPresetsIntro =
    "# Guided presets\n\n"
    "Written by `shadow-inspector docs presets -o docs/presets.md` from the presets themselves; do not edit by "
    "hand.\n\n"
    "Each shows one artefact or one remedy, in a view in which it cannot be missed. In the editor: Guided presets in "
    "the\n"
    "top bar, then Page down and Page up to walk through them; the sentence stands above the picture. On the command "
    "line:\n"
    "`render SCENE --preset KEY -o OUT.png`, and `preset diff KEY OTHER` says what sets two apart. What the sentences "
    "claim\n"
    "is counted against ray-traced truth in `tests/hard_cases/guided_presets_test.cpp`.\n";

/// Whether the setting only chooses where one stands.
bool is_view_point(const SettingRef& ref) {
    const std::string key = setting_key(ref);
    return key.starts_with("camera.") || key == "view.frustum";
}

/// What the preset changes of its scene's own settings: "`bias.normal` 0 texels, …".
std::string changes(const Preset& preset) {
    const Settings base = base_settings(load_scene(preset.scene));
    std::string text;
    for (const SettingRef& ref : differing_settings(base, preset.settings)) {
        if (is_view_point(ref)) continue;
        const std::string value = shown_value(preset.settings, *ref.param, get_value(preset.settings, ref));
        text += fmt::format("{}`{}` {}", text.empty() ? "" : ", ", setting_key(ref), value);
    }
    return text.empty() ? "nothing" : text;
}

}  // namespace

std::string presets_page() {
    std::string text(kPresetsIntro), topic;
    for (const BuiltinPreset& p : builtin_presets()) {
        if (p.topic != topic) text += fmt::format("\n## {}\n", topic = p.topic);
        text += fmt::format("\n**{}** (`{}`, scene `{}`)  \n{}  \nSets {}.\n", p.title, p.key, p.scene, p.about,
                            changes(load_preset(p.key)));
    }
    return text;
}

}  // namespace si
