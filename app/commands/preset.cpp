#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/notes.h"
#include "app/output.h"
#include "renderer/error.h"
#include "renderer/param.h"

namespace si {

void run_preset_check(const std::string& file) {
    const Preset preset = load_preset(file);
    fmt::print("{}: good, {} settings differ from the defaults\n", file, changed_settings(preset.settings).size());
}

void run_preset_show(const std::string& file) {
    const Preset preset = load_preset(file);
    if (!preset.about.empty()) fmt::print("{}\n", preset.about);
    if (!preset.scene.empty()) fmt::print("scene {}\n", preset.scene);
    for (const SettingRef& ref : changed_settings(preset.settings)) {
        const auto idle = idle_reason(preset.settings, ref);
        fmt::print("{} = {}  (default {}){}{}\n", setting_key(ref),
                   value_text(*ref.param, get_value(preset.settings, ref)), value_text(*ref.param, default_value(ref)),
                   idle.empty() ? "" : "  ", idle);
    }
}

void run_preset_save(const SessionOptions& options, const std::string& about, const std::string& output) {
    if (lower_extension(output) != ".json") throw UsageError(fmt::format("{}: a preset must end in .json", output));
    require_writable(output);
    const Session session = open_session(options);
    save_preset({about, session.scene_name, session.settings}, output);
    print_notes(session.notes);
}

}  // namespace si
