#include "renderer/profiles/engine_wording.h"

#include <fmt/format.h>

#include <cmath>

#include "renderer/base/lower_case.h"

namespace si {

std::vector<WrittenParameter> EngineWording::changed(
    const std::vector<std::pair<std::string, std::string>>& changes) const {
    std::vector<WrittenParameter> out;
    if (!profile || !profile->write_bias) return out;
    Settings after = settings;
    set_settings(after, changes);
    const WrittenValues before = write_engine_values(*profile, settings, facts);
    for (const WrittenParameter& now : write_engine_values(*profile, after, facts).parameters) {
        if (!now.parameter->is_bias) continue;
        const WrittenParameter* old = before.find(now.parameter->key);
        constexpr double kShownDigits = 1e-3;
        if (!old || std::abs(old->value - now.value) > kShownDigits * std::abs(now.value)) out.push_back(now);
    }
    return out;
}

std::string EngineWording::text(const std::vector<std::pair<std::string, std::string>>& changes) const {
    std::string out;
    for (const WrittenParameter& p : changed(changes))
        out += fmt::format(
            "{}{} to {:.2g}{}", out.empty() ? "set " : ", ", p.parameter->key, p.value,
            p.exactness == Exactness::EqualAtAngle ? fmt::format(" (equal at {:g} degrees)", facts.angle_deg) : "");
    return out.empty() ? out : fmt::format("in {}: {}", profile->title, out);
}

bool engine_name_matches(const SettingRef& ref, std::string_view text) {
    if (text.empty()) return false;
    const std::string wanted = lower_ascii(text);
    for (const EngineProfile& profile : engine_profiles())
        for (const EngineParameter& parameter : profile.parameters)
            if (parameter.setting == ref.param->key && lower_ascii(parameter.key) == wanted) return true;
    return false;
}

std::vector<std::string> engine_names_of(const SettingRef& ref) {
    std::vector<std::string> out;
    for (const EngineProfile& profile : engine_profiles())
        for (const EngineParameter& parameter : profile.parameters)
            if (parameter.setting == ref.param->key)
                out.push_back(fmt::format("{} {}{}{}: {}", profile.title, parameter.key,
                                          parameter.unit.empty() ? "" : ", ", parameter.unit, parameter.meaning));
    return out;
}

}  // namespace si
