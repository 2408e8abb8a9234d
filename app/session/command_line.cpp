#include "app/session/command_line.h"

#include <fmt/format.h>

#include "renderer/base/command_text.h"
#include "renderer/scene/placement.h"
#include "renderer/settings/param.h"
#include "renderer/settings/starting_values.h"

namespace si {

SessionPlan session_plan(const std::string& scene_name, const Scene& scene, const Settings& settings) {
    SessionPlan plan{.scene_name = scene_name, .preset = {}, .preset_path = {}, .sets = {}, .settings = {}};
    // compose_settings() scales all lengths that no assignment names.
    Settings base = base_settings(scene);
    carry_settings(base, base.scene, settings.scene);
    for (const SettingRef& ref : settings_to_set(base, settings)) {
        plan.sets.push_back(setting_key(ref) + "=" + value_text(*ref.param, get_value(settings, ref)));
        apply_set(plan.settings, plan.sets.back());
    }
    return plan;
}

std::string command_line(const std::string& scene_name, const Scene& scene, const Settings& settings, int width,
                         int height) {
    std::string text =
        fmt::format("shadow-inspector render {} -o out.png --size {}x{}", shell_quoted(scene_name), width, height);
    for (const std::string& set : session_plan(scene_name, scene, settings).sets) text += " --set " + shell_quoted(set);
    return text;
}

}  // namespace si
