// Conversion of engine values, and the table of engines.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "renderer/base/did_you_mean.h"
#include "renderer/base/error.h"
#include "renderer/base/finite_number.h"
#include "renderer/base/lower_case.h"
#include "renderer/profiles/bias_numbers.h"
#include "renderer/profiles/engine_profile.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/idle_reason.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// Returns the assignments of a choice, "KEY=VALUE" separated by spaces, as pairs.
std::vector<std::pair<std::string, std::string>> assignments_of(std::string_view text) {
    std::vector<std::pair<std::string, std::string>> out;
    while (!text.empty()) {
        const auto end = std::min(text.find(' '), text.size());
        const std::string_view one = text.substr(0, end);
        const auto equals = one.find('=');
        out.emplace_back(one.substr(0, equals), one.substr(equals + 1));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out;
}

/// Returns the first of the alternatives of a choice, which "|" separates.
std::string_view first_alternative(std::string_view choice) {
    return choice.substr(0, choice.find('|'));
}

/// Returns the setting with a key; for a setting of lights, that of one light. @param light index of the light
std::optional<SettingRef> setting_of_light(std::string_view key, int light) {
    std::optional<SettingRef> ref = find_setting(key);
    if (ref && ref->param->scope == Scope::Light) ref->light = light;
    return ref;
}

/// Returns the setting with a key; for a setting of lights, that of the light which view.light selects.
std::optional<SettingRef> shown_setting(const Settings& settings, std::string_view key) {
    return setting_of_light(key, settings.view.light_index());
}

/// Returns the key of a setting; for a setting of lights, that of the map's light.
std::string key_for_map(std::string_view key, const MapFacts& facts) {
    return setting_key(*setting_of_light(key, facts.light));
}

/// Returns true when settings have all values of one alternative of a choice.
bool has_values(const Settings& settings, std::string_view choice) {
    const auto wanted = assignments_of(choice);
    return !wanted.empty() && std::ranges::all_of(wanted, [&](const auto& pair) {
        const auto ref = shown_setting(settings, pair.first);
        return ref && get_value(settings, *ref) == parse_value(*ref, pair.second);
    });
}

/// Returns the index of the choice with the settings' values, and EqualAtAngle where only a later alternative of a
/// choice has them; -1 without.
std::pair<int, Exactness> choice_for(const Settings& settings, const EngineParameter& parameter) {
    for (const bool is_first : {true, false})
        for (std::size_t i = 0; i < parameter.choices.size(); ++i) {
            std::string_view rest = parameter.choices[i].settings;
            const std::string_view first = first_alternative(rest);
            if (is_first && has_values(settings, first)) return {int(i), Exactness::Exact};
            if (is_first) continue;
            while (rest.find('|') != rest.npos) {
                rest.remove_prefix(rest.find('|') + 1);
                if (has_values(settings, first_alternative(rest))) return {int(i), Exactness::EqualAtAngle};
            }
        }
    return {-1, Exactness::Missing};
}

/// Returns the text of a number that set_setting() reads back without loss.
std::string setting_number_text(double value) {
    return fmt::format("{}", value);
}

/// Checks that values name parameters of the profile and are finite numbers in range. @throws Error
void require_sound(const EngineProfile& profile, const EngineValues& values) {
    for (const auto& [key, value] : values) {
        const EngineParameter& parameter = engine_parameter(profile, key);
        if (!std::isfinite(value) || value < parameter.min || value > parameter.max)
            throw Error(fmt::format("{} {}: {} is not a number from {:g} to {:g}", profile.name, key, value,
                                    parameter.min, parameter.max));
    }
}

/// Adds the settings of parameters that are a setting of ours in another unit, or a choice.
void read_direct(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts,
                 std::vector<ConvertedSetting>& out) {
    for (const auto& [key, value] : values) {
        const EngineParameter& parameter = engine_parameter(profile, key);
        if (!parameter.choices.empty()) {
            const EngineChoice& choice = parameter.choices[std::size_t(value)];
            for (const auto& [setting, text] : assignments_of(first_alternative(choice.settings)))
                out.push_back({key_for_map(setting, facts), text, Exactness::Exact, {}});
        } else if (parameter.scale != 0 && !parameter.is_bias) {
            double number = value * parameter.scale;
            if (parameter.setting == "map.resolution" && profile.cascades_share_map && facts.cascades > 1) number /= 2;
            const auto ref = find_setting(parameter.setting);
            const double fitting = std::clamp(number, ref->param->min, ref->param->max);
            const bool is_whole = std::holds_alternative<int>(get_value(Settings{}, *ref));
            const bool is_switch = std::holds_alternative<bool>(get_value(Settings{}, *ref));
            ConvertedSetting setting{key_for_map(parameter.setting, facts),
                                     is_switch  ? (fitting != 0 ? "true" : "false")
                                     : is_whole ? fmt::format("{}", int(std::lround(fitting)))
                                                : setting_number_text(fitting),
                                     Exactness::Exact,
                                     {}};
            if (fitting != number) setting.note = fmt::format("{:g} is outside of the range of this setting", number);
            out.push_back(std::move(setting));
        }
    }
}

/// Adds the bias settings of a bias in the terms that engines share.
void read_shared_bias(const BiasNumbers& bias, const MapFacts& facts, std::vector<ConvertedSetting>& out) {
    out.push_back({"bias.kind", "constant", Exactness::Exact, {}});
    const auto put_choice = [&](const char* key, auto choice) {
        out.push_back({key, value_text(*find_setting(key)->param, int(choice)), Exactness::Exact, {}});
    };
    put_choice("bias.unit", bias.constant_unit);
    const double metres = bias.constant_texels * facts.texel_m();
    const double constant = bias.constant_unit == BiasUnit::Texels   ? bias.constant_texels
                            : bias.constant_unit == BiasUnit::Metres ? metres
                                                                     : metres / facts.depth_m;
    const auto put = [&](std::string_view key, double value, Exactness exactness, std::string note) {
        const auto ref = find_setting(key);
        const double fitting = std::clamp(value, ref->param->min, ref->param->max);
        if (fitting != value) {
            note = fmt::format("{:.6g} is outside of the range of this setting, {:g} to {:g}", value, ref->param->min,
                               ref->param->max);
            exactness = Exactness::EqualAtAngle;
        }
        out.push_back({std::string(key), setting_number_text(fitting), exactness, std::move(note)});
    };
    put("bias.constant", constant, bias.constant, bias.constant_note);
    put("bias.slope", 0, Exactness::Exact, {});
    put_choice("bias.normal_unit", OffsetUnit::Texels);
    put_choice("bias.normal_by", bias.normal_by);
    put("bias.normal", bias.normal_texels, Exactness::Exact, bias.normal_note);
    put("bias.raster_slope", bias.raster_slope, Exactness::Exact, {});
    put("bias.raster_units", bias.raster_units, Exactness::Exact, {});
    put("bias.raster_clamp", bias.raster_clamp, Exactness::Exact, {});
}

/// Returns true for a setting without effect, and for the light's size under a kernel that does not read it.
bool is_without_effect(const Settings& settings, const SettingRef& ref) {
    if (ref.param->key == "light.size" && !filter_of(settings).reads_light_size) return true;
    return !idle_reason(settings, ref).empty();
}

/// Writes the parameters that are a setting of ours in another unit, or a choice.
void write_direct(const EngineProfile& profile, const Settings& settings, const MapFacts& facts,
                  const EngineValues& kept, WrittenValues& out) {
    for (const EngineParameter& parameter : profile.parameters) {
        if (parameter.is_bias) continue;
        if (kept.contains(parameter.key)) {
            out.parameters.push_back({&parameter, kept.find(parameter.key)->second, Exactness::Exact, "kept"});
        } else if (!parameter.choices.empty()) {
            if (const auto [index, exactness] = choice_for(settings, parameter); index >= 0) {
                out.parameters.push_back({&parameter, double(index), exactness,
                                          exactness == Exactness::Exact ? "" : "the nearest that the engine has"});
                continue;
            }
            const auto ref = shown_setting(settings, parameter.setting);
            if (!ref) continue;
            out.parameters.push_back(
                {&parameter, parameter.standard, Exactness::Missing, "left at the engine's default"});
            out.missing.push_back({setting_key(*ref), value_text(*ref->param, get_value(settings, *ref)),
                                   fmt::format("{} has no such choice", parameter.key)});
        } else if (parameter.scale != 0) {
            const auto ref = shown_setting(settings, parameter.setting);
            const bool is_extent = parameter.setting == "light.extent";
            if (!is_extent && is_without_effect(settings, *ref)) continue;
            double value = (is_extent ? facts.width_m / 2 : numeric_value(get_value(settings, *ref))) / parameter.scale;
            if (parameter.setting == "map.resolution" && profile.cascades_share_map && facts.cascades > 1) value *= 2;
            EngineOutput(profile, out, facts).put(parameter.key, value, Exactness::Exact, 0, value);
        }
    }
}

}  // namespace

const ConvertedParameter* WrittenValues::find(std::string_view key) const {
    const auto found = std::ranges::find_if(parameters, [&](const auto& p) { return p.parameter->key == key; });
    return found == parameters.end() ? nullptr : &*found;
}

EngineValues WrittenValues::values() const {
    EngineValues out;
    for (const ConvertedParameter& p : parameters)
        if (p.exactness != Exactness::Missing) out[std::string(p.parameter->key)] = p.value;
    return out;
}

void require_sound(const MapFacts& facts) {
    const auto require = [](std::string_view name, double value, double min, double max) {
        if (!(value >= min && value <= max))
            throw Error(fmt::format("{} {}: it must be a number from {:g} to {:g}", name, value, min, max));
    };
    constexpr double kMinLength = 1e-6, kMaxLength = 1e9, kMaxAngle = 89.9, kMaxFov = 179;
    require("width of the map", facts.width_m, kMinLength, kMaxLength);
    require("texels of the map", facts.texels, 3, 1 << 20);
    require("depth range of the map", facts.depth_m, kMinLength, kMaxLength);
    require("number of cascades", facts.cascades, 1, kMaxCascades);
    require("reference angle", facts.angle_deg, 0, kMaxAngle);
    require("distance from the camera", facts.view_m, kMinLength, kMaxLength);
    require("field of view", facts.view_fov_deg, 1, kMaxFov);
}

std::span<const EngineProfile> engine_profiles() {
    static const std::array rows{three_profile(),    babylon_profile(),   playcanvas_profile(), godot_profile(),
                                 urp_profile(),      urp_slope_profile(), hdrp_profile(),       unreal_profile(),
                                 filament_profile(), bevy_profile(),      o3de_profile(),       opengl_profile(),
                                 vulkan_profile(),   d3d12_profile(),     webgpu_profile(),     godot3_profile(),
                                 ogre_profile(),     filament19_profile()};
    return rows;
}

const EngineProfile& engine_profile(std::string_view name) {
    for (const EngineProfile& profile : engine_profiles())
        if (profile.name == name) return profile;
    std::vector<std::string> names;
    for (const EngineProfile& profile : engine_profiles()) names.emplace_back(profile.name);
    throw UsageError(fmt::format("profile \"{}\": it is one of {}{}", name, fmt::join(names, ", "),
                                 did_you_mean(nearest_name(lower_ascii(name), names))));
}

const EngineParameter& engine_parameter(const EngineProfile& profile, std::string_view key) {
    const std::string wanted = lower_ascii(key);
    for (const EngineParameter& parameter : profile.parameters)
        if (lower_ascii(parameter.key) == wanted) return parameter;
    std::vector<std::string> keys;
    for (const EngineParameter& parameter : profile.parameters) keys.emplace_back(parameter.key);
    throw UsageError(fmt::format("engine.{}: {} has the parameters {}{}", key, profile.name, fmt::join(keys, ", "),
                                 did_you_mean(nearest_name(std::string(key), keys))));
}

double engine_value(const EngineProfile& profile, const EngineValues& values, std::string_view key) {
    const EngineParameter& parameter = engine_parameter(profile, key);
    const auto found = values.find(parameter.key);
    return found == values.end() ? parameter.standard : found->second;
}

double parse_engine_value(const EngineProfile& profile, const EngineParameter& parameter, std::string_view text) {
    const auto fault = [&](const std::string& allowed, const std::string& hint = {}) {
        return UsageError(fmt::format("engine.{}: \"{}\" is not a value of {} {}; {}{}", parameter.key, text,
                                      profile.name, parameter.key, allowed, hint));
    };
    if (!parameter.choices.empty()) {
        std::vector<std::string> keys;
        for (const EngineChoice& choice : parameter.choices) {
            if (lower_ascii(choice.key) == lower_ascii(text)) return double(keys.size());
            keys.emplace_back(choice.key);
        }
        throw fault(fmt::format("it is one of {}", fmt::join(keys, ", ")),
                    did_you_mean(nearest_name(std::string(text), keys)));
    }
    if (text == "true") return 1;
    if (text == "false") return 0;
    const std::optional<double> value = finite_number(text);
    if (!value || *value < parameter.min || *value > parameter.max)
        throw fault(fmt::format("it is a number from {:g} to {:g}", parameter.min, parameter.max));
    return *value;
}

std::string engine_value_text(const EngineParameter& parameter, double value) {
    if (!parameter.choices.empty())
        return std::string(
            parameter.choices[std::size_t(std::clamp(value, 0.0, double(parameter.choices.size() - 1)))].key);
    return fmt::format("{:.6g}", value);
}

std::vector<ConvertedSetting> read_engine_values(const EngineProfile& profile, const EngineValues& values,
                                                 const MapFacts& facts) {
    require_sound(facts);
    require_sound(profile, values);
    std::vector<ConvertedSetting> out;
    read_direct(profile, values, facts, out);
    if (profile.read_bias) read_shared_bias(profile.read_bias(profile, values, facts), facts, out);
    return out;
}

WrittenValues write_engine_values(const EngineProfile& profile, const Settings& settings, const MapFacts& given_facts,
                                  const EngineValues& kept) {
    require_sound(given_facts);
    MapFacts facts = given_facts;
    facts.format = settings.map.format;
    facts.reversed_z = settings.map.reversed_z;
    require_sound(profile, kept);
    WrittenValues out;
    write_direct(profile, settings, facts, kept, out);
    if (profile.write_bias) {
        const BiasNumbers bias = bias_numbers(settings, facts);
        EngineValues values = out.values();
        for (const auto& [key, value] : kept) values[key] = value;
        out.wanted_texels = bias.total_texels(facts);
        EngineOutput to(profile, out, facts);
        profile.write_bias(bias, values, facts, to);
        for (ConvertedParameter& p : out.parameters) {
            const bool is_converted = bias.settings_by != OffsetBy::Length && bias.settings_by != profile.normal_by;
            if (p.parameter->setting == "bias.normal" && bias.normal_texels != 0 && is_converted)
                p.exactness = least_exact(p.exactness, Exactness::EqualAtAngle);
            out.given_texels += p.texels;
            values[std::string(p.parameter->key)] = p.value;
        }
        out.hidden_texels = profile.hidden_texels ? profile.hidden_texels(profile, values, facts) : 0;
        out.given_texels += out.hidden_texels;
    }
    for (ConvertedParameter& p : out.parameters)
        if (!p.parameter->is_bias) p.literal = p.value;
    for (const LackingSetting& row : profile.lacking) {
        if (lacking_setting(profile, settings, row.key) != &row) continue;
        const auto ref = shown_setting(settings, row.key);
        const std::string key = setting_key(*ref);
        if (std::ranges::find(out.missing, key, &MissingSetting::key) == out.missing.end())
            out.missing.push_back({key, value_text(*ref->param, get_value(settings, *ref)), std::string(row.reason)});
    }
    return out;
}

std::vector<std::string> apply_forced_settings(const EngineProfile& profile, Settings& settings) {
    std::vector<std::string> notes;
    for (const ForcedSetting& forced : profile.forced) {
        const auto ref = shown_setting(settings, forced.key);
        const Value before = get_value(settings, *ref);
        const Value now = parse_value(*ref, forced.value);
        if (before == now) continue;
        if (before != default_value(*ref))
            notes.push_back(fmt::format("{}: {} instead of {}, as {}: {}", forced.key, forced.value,
                                        value_text(*ref->param, before), profile.title, forced.reason));
        set_value(settings, *ref, now);
    }
    return notes;
}

const ForcedSetting* forced_setting(const EngineProfile& profile, std::string_view key) {
    const auto found = std::ranges::find(profile.forced, key, &ForcedSetting::key);
    return found == profile.forced.end() ? nullptr : &*found;
}

bool has_bias_row(const EngineProfile& profile, std::string_view key) {
    return profile.bias_rows.empty() || std::ranges::find(profile.bias_rows, key) != profile.bias_rows.end();
}

BiasSettings with_hidden_bias(const EngineProfile& profile, const BiasSettings& bias, const MapFacts& facts) {
    Settings settings;
    settings.bias = bias;
    for (const ForcedSetting& forced : profile.forced)
        if (forced.key.starts_with("bias.")) set_setting(settings, forced.key, forced.value);
    const double least_m = profile.hidden_depth * facts.depth_m;
    const double per_unit_m = bias.unit == BiasUnit::Texels   ? facts.texel_m()
                              : bias.unit == BiasUnit::Metres ? 1
                                                              : facts.depth_m;
    settings.bias.constant = std::max(settings.bias.constant, least_m / per_unit_m);
    return settings.bias;
}

std::string reason_engine_lacks(const EngineProfile& profile, const Settings& before, const Settings& with) {
    const auto text_of = [](const SettingRef& ref, const Settings& s) {
        return value_text(*ref.param, get_value(s, ref));
    };
    for (const SettingRef& ref : all_settings(with)) {
        if (get_value(before, ref) == get_value(with, ref)) continue;
        const std::string_view key = ref.param->key;
        const std::string change = fmt::format("{} {}", setting_key(ref), text_of(ref, with));
        if (const ForcedSetting* forced = forced_setting(profile, key);
            forced && get_value(with, ref) != parse_value(ref, forced->value))
            return fmt::format("{}: {}", change, forced->reason);
        if (const LackingSetting* lacking = lacking_setting(profile, with, key))
            return fmt::format("{}: {}", change, lacking->reason);
        if (key == "bias.kind" && !has_bias_row(profile, bias_of(with).key))
            return fmt::format("{}: {} has no such bias", change, profile.title);
        if (key != "filter.kernel") continue;
        const auto by_name = std::ranges::find_if(
            profile.parameters, [&](const EngineParameter& p) { return p.setting == key && !p.choices.empty(); });
        if (by_name != profile.parameters.end() && choice_for(with, *by_name).first < 0)
            return fmt::format("{}: {} has no such choice", change, by_name->key);
    }
    return {};
}

const LackingSetting* lacking_setting(const EngineProfile& profile, const Settings& settings, std::string_view key) {
    const auto ref = shown_setting(settings, key);
    if (!ref) return nullptr;
    const std::string value = value_text(*ref->param, get_value(settings, *ref));
    for (const LackingSetting& row : profile.lacking) {
        if (row.key != key) continue;
        const bool is_off = numeric_value(get_value(settings, *ref)) == 0;
        if (row.value.empty() ? !is_off : row.value == value) return &row;
    }
    return nullptr;
}

}  // namespace si
