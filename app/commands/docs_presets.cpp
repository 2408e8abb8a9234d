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
    "- In the editor, open *Guided presets* in the top bar. The keys PageDown and PageUp walk through the presets. The "
    "description of the shown preset stands above the picture.\n"
    "- On the command line, `shadow-inspector render SCENE --preset KEY -o OUT.png` draws the preset `KEY`. The "
    "command `shadow-inspector preset diff KEY OTHER` prints what differs between two presets.\n";

constexpr std::string_view kHardCasesIntro =
    "# Hard cases\n"
    "\n"
    "Printed by `shadow-inspector docs hard-cases -o docs/hard-cases.md` from the table in "
    "`renderer/scenes/hard_cases.cpp`. Do not edit it by hand.\n"
    "\n"
    "A hard case is a corner in which shadow maps break. Each is a small scene and a preset of the same name.\n"
    "\n"
    "- In the editor, open *Hard cases* in the top bar. The keys PageDown and PageUp walk through the cases.\n"
    "- On the command line, `shadow-inspector render hard/NAME -o OUT.png` draws the case `NAME`. Every command that "
    "takes a scene or a preset also takes `hard/NAME`.\n"
    "- Some cases have a setting that brings the fault back. For these cases `hard/NAME` shows the fault, "
    "and `hard/NAME-fixed` shows the fix.\n"
    "\n"
    "The tests `HardCase<number>` compare each measure with its limit and show the fault without the fix. They write "
    "their values into [lab/stability.md](lab/stability.md).\n"
    "\n"
    "## Placements\n"
    "\n"
    "The tests of the hard cases also draw, trace and classify each case at other placements: far from the origin, "
    "scaled, mirrored and under other lights. Each placement is tested alone. Further tests combine placements, so "
    "that every possible pair of them occurs with at least one case. The test label `long` runs all combinations, some "
    "800 for each case. Cases with maps from an engine are not moved.\n"
    "\n"
    "| placement | range |\n"
    "|---|---|\n"
    "| distance from the world's origin | 100 m to 10,000 km, on and off the grid that shaders count from |\n"
    "| scale | 1/1000 to 1,000,000 |\n"
    "| mirrored | along one axis |\n"
    "| light | exactly along every axis |\n"
    "\n"
    "Scaling and shifting a scene leaves the picture, the ray-traced reference and the causes of wrong pixels "
    "unchanged byte by byte if the scale is a power of two and the shift a whole number of grid steps. For the scenes "
    "of these tests, a grid step is 32 m times the scale. This holds up to a distance of 9,000,000 scene radii. Double "
    "precision resolves a billionth of the radius there.\n"
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

/// Formats the other settings that the preset changes: "`bias.normal` = 0 texels, …".
std::string changes(const Preset& preset, const Settings& base) {
    std::string text;
    for (const SettingRef& ref : differing_settings(base, preset.settings)) {
        if (is_view_point(ref)) continue;
        const std::string value = shown_value(preset.settings, ref, get_value(preset.settings, ref));
        text += fmt::format("{}`{}` = {}", text.empty() ? "" : ", ", setting_key(ref), value);
    }
    return text.empty() ? "nothing" : text;
}

}  // namespace

std::string presets_page() {
    std::string text(kPresetsIntro), topic;
    for (const BuiltinPreset& p : builtin_presets()) {
        if (p.topic != topic) text += fmt::format("\n## {}\n", topic = p.topic);
        text += fmt::format("\n**{}** (preset `{}`, scene `{}`)  \n{}  \nThe preset sets {}.\n", p.title, p.key,
                            p.scene, p.about, changes(load_preset(p.key), base_settings(load_scene(p.scene))));
    }
    return text;
}

std::string hard_cases_page() {
    std::string text(kHardCasesIntro);
    for (const HardCase& c : hard_cases()) {
        text += fmt::format("\n## {}. {}\n\n{} Fix: {}\n\n", c.number, c.title, c.fault, c.fix);
        text += fmt::format(
            "| measured | at most | reason | without the fix |\n|---|---|---|---|\n"
            "| {} | {:.4g} ({}) | {} | {}: at least {:.4g} |\n\n",
            markdown_cell(c.measure), c.limit, c.unit, markdown_cell(c.limit_reason), markdown_cell(c.fault_measure),
            c.min_fault);
        for (const bool fixed : {false, true}) {
            const HardCaseView view{&c, fixed};
            if (!fixed && c.broken.empty()) continue;
            text += fmt::format("The preset `{}` sets {}.{}\n", view.name(),
                                changes(load_preset(view.name()), Settings()), fixed ? "" : "  ");
        }
    }
    return text;
}

}  // namespace si
