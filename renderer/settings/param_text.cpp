// Text form of settings (parsing, printing) and the repair of invalid values.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "renderer/base/did_you_mean.h"
#include "renderer/base/error.h"
#include "renderer/base/printable.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/param.h"
#include "renderer/settings/sized_kernels.h"
#include "renderer/settings/splits.h"

namespace si {
namespace {

/// Returns the shortest text that parses back to the same number.
std::string number_text(double v) {
    char buffer[40];
    const auto result = std::to_chars(buffer, buffer + sizeof buffer, v);
    return std::string(buffer, result.ptr);
}

std::string range_text(const Param& p) {
    if (is_text(p)) return fmt::format("a text in UTF-8 of at most {} bytes, without control characters", p.max);
    const std::string unit = p.unit.empty() ? "" : fmt::format(" {}", p.unit);
    return fmt::format("{} to {}{}", number_text(p.min), number_text(p.max), unit);
}

[[noreturn]] void refuse(const SettingRef& ref, std::string_view text, const std::string& why) {
    throw UsageError(fmt::format("{}: \"{}\" {}", setting_key(ref), printable(text, 60), why));
}

std::optional<double> read_number(std::string_view text) {
    double v = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return v;
}

/// Returns the sized kernel that `text` names, where the setting is filter.kernel; else nullptr.
const SizedKernel* sized_kernel_of(const SettingRef& ref, std::string_view text) {
    return ref.param->key == "filter.kernel" ? find_sized_kernel(text) : nullptr;
}

int parse_choice(const SettingRef& ref, std::string_view text) {
    const auto choices = ref.param->choices();
    std::vector<std::string> keys;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        if (choices[i].key == text) return int(i);
        keys.emplace_back(choices[i].key);
    }
    if (const SizedKernel* sized = sized_kernel_of(ref, text)) return parse_choice(ref, sized->kernel);
    refuse(ref, text, fmt::format("is none of {}{}", fmt::join(keys, ", "), did_you_mean(nearest_name(text, keys))));
}

bool parse_bool(const SettingRef& ref, std::string_view text) {
    if (text == "true" || text == "on" || text == "1") return true;
    if (text == "false" || text == "off" || text == "0") return false;
    refuse(ref, text, "is neither true nor false (also on, off, 1, 0)");
}

double parse_number(const SettingRef& ref, std::string_view text, bool whole) {
    const Param& p = *ref.param;
    const auto v = read_number(text);
    if (!v) {
        refuse(ref, text, fmt::format("is not a {}; allowed is {}", whole ? "whole number" : "number", range_text(p)));
    }
    if (!std::isfinite(*v)) refuse(ref, text, fmt::format("is not finite; allowed is {}", range_text(p)));
    if (whole && *v != std::floor(*v)) {
        refuse(ref, text, fmt::format("is not a whole number; allowed is {}", range_text(p)));
    }
    if (*v < p.min || *v > p.max) refuse(ref, text, fmt::format("is out of range; allowed is {}", range_text(p)));
    return *v;
}

/// Returns true when the text has no control characters and is not too long.
bool is_good_text(const Param& p, const std::string& text) {
    return text.size() <= std::size_t(p.max) && printable(text, std::string::npos) == text;
}

std::string parse_text(const SettingRef& ref, std::string_view text) {
    if (!is_good_text(*ref.param, std::string(text)))
        refuse(ref, text, fmt::format("is not allowed; allowed is {}", range_text(*ref.param)));
    return std::string(text);
}

/// Repairs a pair of settings so that lo < hi: swaps a reversed pair, opens an empty range.
/// @param zero_is_automatic 0 stands for a value found later, and the pair is left alone
void repair_pair(Settings& s, const std::string& lo_key, const std::string& hi_key, bool zero_is_automatic,
                 std::vector<std::string>& repairs) {
    const auto lo_ref = *find_setting(lo_key), hi_ref = *find_setting(hi_key);
    const double lo = std::get<double>(get_value(s, lo_ref)), hi = std::get<double>(get_value(s, hi_ref));
    if (lo < hi || (zero_is_automatic && (lo == 0 || hi == 0))) return;
    if (lo > hi) {
        set_value(s, lo_ref, hi);
        set_value(s, hi_ref, lo);
        repairs.push_back(
            fmt::format("{} {} was above {} {}: swapped", lo_key, number_text(lo), hi_key, number_text(hi)));
        return;
    }
    // An empty range is opened upwards if the limit allows it, else downwards.
    const double step = std::max(std::abs(lo), 1.0) * 0.01;
    if (hi + step <= hi_ref.param->max) {
        set_value(s, hi_ref, hi + step);
    } else {
        set_value(s, lo_ref, lo - step);
    }
    repairs.push_back(
        fmt::format("{} and {} were both {}: set {} apart", lo_key, hi_key, number_text(lo), number_text(step)));
}

}  // namespace

std::string value_text(const Param& p, const Value& v) {
    if (const bool* b = std::get_if<bool>(&v)) return *b ? "true" : "false";
    if (const int* i = std::get_if<int>(&v)) {
        if (!p.choices) return std::to_string(*i);
        const auto choices = p.choices();
        return *i >= 0 && std::size_t(*i) < choices.size() ? std::string(choices[std::size_t(*i)].key)
                                                           : std::to_string(*i);
    }
    if (const std::string* text = std::get_if<std::string>(&v)) return *text;
    return number_text(std::get<double>(v));
}

Value parse_value(const SettingRef& ref, std::string_view text) {
    if (ref.param->choices) return parse_choice(ref, text);
    if (is_text(*ref.param)) return parse_text(ref, text);
    const Value kind = default_value(ref);
    if (std::holds_alternative<bool>(kind)) return parse_bool(ref, text);
    if (std::holds_alternative<int>(kind)) return int(parse_number(ref, text, true));
    return parse_number(ref, text, false) + 0.0;  // + 0.0: "-0" is 0
}

std::vector<std::pair<SettingRef, Value>> implied_values(const SettingRef& ref, std::string_view text) {
    const SizedKernel* sized = sized_kernel_of(ref, text);
    if (!sized) return {};
    std::vector<std::pair<SettingRef, Value>> implied = {{*find_setting("filter.size"), sized->size}};
    if (sized->point) implied.emplace_back(*find_setting("filter.point"), *sized->point);
    return implied;
}

void set_setting(Settings& s, std::string_view key, std::string_view text) {
    const auto ref = find_setting(key);
    if (!ref) {
        throw UsageError(fmt::format("\"{}\": unknown setting{}", printable(key), did_you_mean(nearest_key(key))));
    }
    set_value(s, *ref, parse_value(*ref, text));
    for (const auto& [other, value] : implied_values(*ref, text)) set_value(s, other, value);
}

std::vector<std::string> sanitise(Settings& s) {
    std::vector<std::string> repairs;
    for (const SettingRef& ref : all_settings(s)) {
        const Param& p = *ref.param;
        const Value v = get_value(s, ref);
        if (std::holds_alternative<bool>(v)) continue;
        if (const std::string* text = std::get_if<std::string>(&v)) {
            if (is_good_text(p, *text)) continue;
            set_value(s, ref, default_value(ref));
            repairs.push_back(
                fmt::format("{} was \"{}\", not {}: removed", setting_key(ref), printable(*text, 60), range_text(p)));
            continue;
        }
        const auto* i = std::get_if<int>(&v);
        const double x = i ? *i : std::get<double>(v);
        if (x >= p.min && x <= p.max) continue;
        Value repaired = default_value(ref);
        // Choices have no order, so an invalid index becomes the default.
        if (std::isfinite(x) && !p.choices) {
            const double clamped = std::clamp(x, p.min, p.max);
            repaired = i ? Value(int(clamped)) : Value(clamped);
        }
        set_value(s, ref, repaired);
        repairs.push_back(fmt::format("{} was {}, outside of {}: set to {}", setting_key(ref), value_text(p, v),
                                      range_text(p), value_text(p, repaired)));
    }
    for (int i = 0; i < kMaxLights; ++i) {
        const auto& light = s.lights[std::size_t(i)];
        if (!uses_manual_near_far(light)) continue;
        const std::string prefix = i == 0 ? "light." : fmt::format("light.{}.", i);
        repair_pair(s, prefix + "near", prefix + "far", true, repairs);
    }
    repair_splits(s, repairs);
    if (s.camera.source == CameraSource::Manual) {
        repair_pair(s, "camera.near", "camera.far", true, repairs);
    }
    if (s.view.band_low > s.view.band_high) repair_pair(s, "view.band_low", "view.band_high", false, repairs);
    if (s.view.overlay_range == OverlayRange::Manual)
        repair_pair(s, "view.overlay_min", "view.overlay_max", false, repairs);
    return repairs;
}

}  // namespace si
