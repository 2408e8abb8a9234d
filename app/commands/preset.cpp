#include <fmt/format.h>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/report/report.h"
#include "app/session/preset_diff.h"
#include "app/session/setting_json.h"
#include "renderer/base/error.h"
#include "renderer/base/printable.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/idle_reason.h"
#include "renderer/settings/param.h"

namespace si {

void run_preset_check(const PresetOptions& options) {
    const std::string& file = options.file;
    const SessionPlan plan = plan_session({.scene = {}, .preset = file, .sets = {}});
    const Preset& preset = *plan.preset;
    std::vector<std::string> notes;
    if (!preset.scene.empty()) {
        try {
            notes = compose_session(plan, load_scene(plan.scene_name, scene_options(plan))).notes;
        } catch (const Error& e) {  // a fault of the preset's scene is a fault of the file, not of the command line
            throw Error(fmt::format("{}: its scene: {}", file, e.what()));
        }
    }
    fmt::print("{}: good, {} settings differ from the defaults\n", printable(file, std::string::npos),
               changed_settings(preset.settings).size());
    print_notes(notes);
}

void run_preset_show(const PresetOptions& options) {
    const Preset preset = load_preset(options.file);
    // The file's text goes to a terminal: control characters are escaped.
    const auto shown = [](const std::string& text) { return printable(text, std::string::npos); };
    if (!preset.title.empty())
        fmt::print("{}{}\n", preset.topic.empty() ? "" : shown(preset.topic) + ": ", shown(preset.title));
    if (!preset.about.empty()) fmt::print("{}\n", shown(preset.about));
    if (!preset.scene.empty()) fmt::print("scene {}\n", shown(preset.scene));
    for (const SettingRef& ref : changed_settings(preset.settings)) {
        const auto idle = idle_reason(preset.settings, ref);
        fmt::print("{} = {}  (default {}){}{}\n", shown(setting_key(ref)),
                   value_text(*ref.param, get_value(preset.settings, ref)), value_text(*ref.param, default_value(ref)),
                   idle.empty() ? "" : "  ", idle);
    }
}

void run_preset_diff(const PresetOptions& options) {
    const std::string &before = options.file, &after = options.other_file;
    const Preset a = load_preset_or_default(before), b = load_preset_or_default(after);
    const std::vector<PresetDifference> differences = preset_differences(a, b);
    if (!options.json) {
        fmt::print("{}", differences_text(differences, before, after));
        return;
    }
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const PresetDifference& d : differences) {
        nlohmann::ordered_json row{{"key", d.key}, {"group", d.group}};
        if (const auto ref = find_setting(d.key)) {
            row["before"] = setting_to_json(*ref, get_value(a.settings, *ref));
            row["after"] = setting_to_json(*ref, get_value(b.settings, *ref));
        } else {
            row["before"] = a.scene;
            row["after"] = b.scene;
        }
        row["text"] = d.text;
        row["without_effect"] = d.note;
        list.push_back(std::move(row));
    }
    fmt::print("{}", json_text({{"a", before}, {"b", after}, {"equal", list.empty()}, {"differences", list}}));
}

void run_preset_save(const PresetOptions& options) {
    require_output(options.output, "a preset", {".json"});
    const Session session = open_session(options.session);
    save_preset({options.title, options.topic, options.about, scene_for_preset(session.scene_name, options.output),
                 session.settings},
                options.output);
    print_notes(session.notes);
}

}  // namespace si
