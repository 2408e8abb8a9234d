// Pages of the guided presets (docs/presets.md) and of the hard cases (docs/hard-cases.md).
#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/session/presets.h"
#include "app/session/session.h"
#include "renderer/scenes/builtin.h"
#include "renderer/scenes/hard_cases.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

constexpr std::string_view kPresetsIntro =
    "# Guided presets\n"
    "\n"
    "Printed by `shadow-inspector docs presets -o docs/presets.md` from the presets. Do not edit it by hand.\n"
    "\n"
    "Each preset shows one artefact or one fix, from a camera that makes it obvious. "
    "`tests/hard_cases/guided_presets_test.cpp` measures what each sentence claims against the ray-traced reference.\n"
    "\n"
    "- In the editor, open *Guided presets* in the top bar. PageDown and PageUp walk through them, and the sentence "
    "stands above the picture.\n"
    "- On the command line, `render SCENE --preset KEY -o OUT.png` draws one, and `preset diff KEY OTHER` prints what "
    "differs between two.\n";

constexpr std::string_view kHardCasesIntro =
    "# Hard cases\n"
    "\n"
    "Printed by `shadow-inspector docs hard-cases -o docs/hard-cases.md` from the table in "
    "`renderer/scenes/hard_cases.cpp`. Do not edit it by hand.\n"
    "\n"
    "A hard case is a corner in which shadow maps break. Each is a small scene and a preset of the same name.\n"
    "\n"
    "- In the editor, open *Hard cases* in the top bar. PageDown and PageUp walk through them.\n"
    "- On the command line, `render hard/NAME -o OUT.png` draws one. The name stands wherever a scene or a preset may "
    "stand.\n"
    "- Where a setting brings the fault back, `hard/NAME` shows the fault and `hard/NAME-fixed` the fix.\n"
    "\n"
    "The tests `HardCase<number>` compare each measure with its limit and show the fault without the fix. They write "
    "their values into [lab/stability.md](lab/stability.md).\n"
    "\n"
    "## Placements\n"
    "\n"
    "The same tests draw, trace and classify each case in other places. Each placement is tested alone and in pairs. "
    "The label `long` runs all combinations, some 800 a case. Cases whose maps an engine gives stay in their place.\n"
    "\n"
    "| placement | range |\n"
    "|---|---|\n"
    "| distance from the world's origin | 100 m to 10,000 km, on and off the grid that shaders count from |\n"
    "| scale | 1/1000 to 1,000,000 |\n"
    "| mirrored | along one axis |\n"
    "| light | exactly along every axis |\n"
    "\n"
    "Pictures, references and causes are the same bytes if the scale is a power of two and the shift is a whole number "
    "of grid steps. A step is 32 times the scale for scenes of this size. This holds up to 9,000,000 scene radii, "
    "where a double resolves a billionth of the radius.\n"
    "\n"
    "| elsewhere | difference |\n"
    "|---|---|\n"
    "| up to 3·10⁹ radii | visibility differs by 6·10⁻⁵ (1.1·10⁻⁴ with moments in 16 bits), and no edge moves |\n"
    "| rays within a plane | they meet it differently in at most 4 of 6,912 pixels |\n"
    "| other scales and shifts | at most 0.05 % of pixels differ (0.15 % of one picture's), all at edges |\n"
    "| causes of wrong pixels | 99 % are the same, 98 % in case 27 |\n"
    "| faults of cases 4, 22, 24, 25 and 27 | they are rounding itself, and meet other pixels |\n"
    "\n"
    "Nothing is tested where a double resolves less than a millionth of the radius.\n";

/// Returns true if the setting only changes the point of view.
bool is_view_point(const SettingRef& ref) {
    const std::string key = setting_key(ref);
    return key.starts_with("camera.") || key == "view.frustum";
}

/// Formats the other settings that the preset changes: "`bias.normal` 0 texels, …".
std::string changes(const Preset& preset, const Settings& base) {
    std::string text;
    for (const SettingRef& ref : differing_settings(base, preset.settings)) {
        if (is_view_point(ref)) continue;
        const std::string value = shown_value(preset.settings, ref, get_value(preset.settings, ref));
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
                            changes(load_preset(p.key), base_settings(load_scene(p.scene))));
    }
    return text;
}

std::string hard_cases_page() {
    std::string text(kHardCasesIntro);
    for (const HardCase& c : hard_cases()) {
        text += fmt::format("\n## {}. {}\n\n{} {}\n\n", c.number, c.title, c.fault, c.fix);
        text += fmt::format(
            "| measured | at most | reason | without the fix |\n|---|---|---|---|\n"
            "| {} | {:.4g} ({}) | {} | {}: at least {:.4g} |\n\n",
            markdown_cell(c.measure), c.limit, c.unit, markdown_cell(c.limit_reason), markdown_cell(c.fault_measure),
            c.min_fault);
        for (const bool fixed : {false, true}) {
            const HardCaseView view{&c, fixed};
            if (!fixed && c.broken.empty()) continue;
            text += fmt::format("`{}` sets {}.{}\n", view.name(), changes(load_preset(view.name()), Settings()),
                                fixed ? "" : "  ");
        }
    }
    return text;
}

}  // namespace si
