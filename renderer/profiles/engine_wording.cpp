#include "renderer/profiles/engine_wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/base/error.h"
#include "renderer/base/lower_case.h"
#include "renderer/profiles/bias_numbers.h"

namespace si {

std::vector<ConvertedParameter> EngineWording::changed(
    std::span<const std::pair<std::string, std::string>> changes) const {
    std::vector<ConvertedParameter> out;
    if (!profile || !profile->write_bias) return out;
    Settings after = settings;
    set_settings(after, changes);
    MapFacts facts_after = facts;
    // Another resolution leaves the map as wide as it is, up to the margin of a normal offset.
    if (after.map.resolution != settings.map.resolution && after.map.bundle.empty())
        facts_after.texels = std::max(after.map.resolution, kMinMapTexels);
    const WrittenValues before = write_engine_values(*profile, settings, facts);
    for (const ConvertedParameter& now : write_engine_values(*profile, after, facts_after).parameters) {
        if (!now.parameter->is_bias) continue;
        const ConvertedParameter* old = before.find(now.parameter->key);
        constexpr double kShownDigits = 1e-3;
        if (!old || std::abs(old->value - now.value) > kShownDigits * std::abs(now.value)) out.push_back(now);
    }
    return out;
}

std::string EngineWording::text(std::span<const std::pair<std::string, std::string>> changes) const {
    std::string out;
    for (const ConvertedParameter& p : changed(changes))
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

double engine_bias_texels(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    if (!profile.read_bias) throw Error(fmt::format("{}: no conversion is known", profile.name));
    Settings settings;
    for (const ConvertedSetting& setting : read_engine_values(profile, values, facts))
        set_setting(settings, setting.key, setting.value);
    return bias_numbers(settings, facts).total_texels(facts);
}

namespace {

/// Formats the equivalent of an engine's number: "0.02 = 2.05 texels = 0.02 m at W 20 m, N 2048, D 40 m, 45 degrees".
std::string conversion_text(const EngineProfile& profile, const EngineParameter& parameter) {
    if (!profile.read_bias || !parameter.is_bias) return {};
    const MapFacts facts;
    EngineValues none;
    for (const EngineParameter& other : profile.parameters)
        if (other.is_bias) none[std::string(other.key)] = std::max(0.0, other.min);
    EngineValues one = none;
    // The number of the example: its default, or one where the default is none.
    const double number = parameter.standard != 0 ? parameter.standard
                          : parameter.min < 0     ? -0.0005
                          : parameter.max < 1     ? parameter.max
                                                  : 0.02;
    one[std::string(parameter.key)] = number;
    const double texels = engine_bias_texels(profile, one, facts) - engine_bias_texels(profile, none, facts);
    if (texels == 0) return {};
    return fmt::format(" {:g} = {:.3g} texels = {:.3g} m at W {:g} m, N {}, D {:g} m, {:g} degrees", number, texels,
                       texels * facts.texel_m(), facts.width_m, facts.texels, facts.depth_m, facts.angle_deg);
}

}  // namespace

std::vector<std::string> engine_names_of(const SettingRef& ref, std::string_view name, const EngineProfile* only) {
    std::vector<std::string> out;
    for (const EngineProfile& profile : engine_profiles()) {
        if (only && profile.name != only->name) continue;
        for (const EngineParameter& parameter : profile.parameters)
            if (parameter.setting == ref.param->key &&
                (name.empty() || lower_ascii(parameter.key) == lower_ascii(name)))
                out.push_back(fmt::format("{} {}{}: {}{}", profile.title, parameter.key,
                                          parameter.unit.empty() ? "" : fmt::format(" ({})", parameter.unit),
                                          parameter.meaning, conversion_text(profile, parameter)));
    }
    return out;
}

}  // namespace si
