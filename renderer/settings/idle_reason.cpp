// Reasons why a setting has no effect.
#include "renderer/settings/idle_reason.h"

#include "renderer/settings/owners.h"
#include "renderer/settings/sources.h"

namespace si {

std::string_view idle_reason(const Settings& s, const SettingRef& ref) {
    if (ref.param->scope == Scope::Light && ref.light >= s.light_count) return "without effect: the light is off";
    if (ref.param->map_only && no_source_is_map(s))
        return "without effect: no light's shadows come from a map (light.source)";
    if (const std::string_view reason = unused_setting_reason(s, ref); !reason.empty()) return reason;
    return ref.param->idle ? ref.param->idle(s, ref.light) : std::string_view();
}

}  // namespace si
