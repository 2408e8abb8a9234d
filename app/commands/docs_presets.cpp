// The tours of the guided presets (docs/presets.md) and of the hard cases (docs/hard-cases.md).
#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/session/command_line.h"
#include "app/session/presets.h"
#include "renderer/scenes/builtin.h"
#include "renderer/scenes/hard_cases.h"
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

constexpr std::string_view kHardCasesIntro =
    "# Hard cases\n\n"
    "Written by `shadow-inspector docs hard-cases -o docs/hard-cases.md` from the table in "
    "`renderer/scenes/hard_cases.cpp`; do not\nedit by hand.\n\n"
    "Corners in which shadow maps break. Each is a small scene and a preset of one name: in the editor, *Hard cases* "
    "in "
    "the top bar,\nthen Page down and Page up; on the command line, `render hard/NAME -o OUT.png`, or the name "
    "wherever "
    "a preset may stand. Where a\nsetting brings the fault back, `hard/NAME` shows it and `hard/NAME-fixed` what mends "
    "it. The tests `HardCase<number>` hold each\nmeasure to its limit, show that the fault is there without the "
    "remedy, and write what came out into [stability.md](stability.md).\n\n"
    "Everywhere, not only at home: the same tests draw, trace and judge each case also 100 m to 10,000 km from the "
    "world's origin, on and\noff the grid that shaders count from, at scales of 1/1000 to 1,000,000, mirrored, and "
    "with its light exactly along every axis. Where the\nscale is a power of two and the shift a whole number of grid "
    "steps (32 times the scale, for scenes of this size), pictures, truths and\ncauses are the same bytes, as long "
    "as a double resolves the place to a billionth of the scene's radius: to 9,000,000 radii, which is\n45,000 km for "
    "a scene of 10 m and 45 km for one of 1 cm. Farther away the places of light and camera, which are world "
    "coordinates,\nhave fewer bits than home gives them: at up to 3\u00b710\u2079 radii visibility differs by last "
    "bits "
    "(6\u00b710\u207b\u2075, and 1.1\u00b710\u207b\u2074 where moments are stored in\n16 bits), no edge moves, and "
    "rays "
    "within a plane meet it otherwise in at most 4 of 6,912 pixels. Everywhere else at most 0.05 % of a\ncase's pixels "
    "differ (0.15 % of one picture's), all at edges, and 99 % of the wrong ones have the same cause; 98 % in case 27, "
    "where a row of\ntexels hangs on what positions are rounded by. With the faults it is the same, but that those of "
    "cases 4, 22, 24, 25 and 27 are rounding itself\nand meet other pixels elsewhere. Nothing is asked where a double "
    "resolves less than a millionth of the radius. Each placement is drawn\nby itself, and pairs of placements "
    "together; all of them with all others, some 800 a case, under the label `long`.\n";

/// Whether the setting only chooses where one stands.
bool is_view_point(const SettingRef& ref) {
    const std::string key = setting_key(ref);
    return key.starts_with("camera.") || key == "view.frustum";
}

/// What the preset changes of other settings: "`bias.normal` 0 texels, …".
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
        text += fmt::format("Measured: {}. At most {:.4g} ({}): {}. Without the remedy: {}; at least {:.4g}.\n\n",
                            c.measure, c.limit, c.unit, c.why, c.without, c.shown);
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
