// Settings for display: values with units, titles of lights, changes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/settings/overlays.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

std::string with_unit(std::string number, std::string_view unit) {
    if (unit == "deg") return number + "°";
    return unit.empty() ? number : fmt::format("{} {}", number, unit);
}

constexpr int kShownDigits = 5;  ///< significant digits of a number for display
constexpr int kMostDigits = 17;  ///< significant digits that tell any two numbers apart

/// Returns a number without an exponent. @param digits significant digits
std::string decimal_text(double value, int digits) {
    if (!std::isfinite(value)) return fmt::format("{}", value);
    if (value == 0) return "0";
    const int decimals = digits - 1 - int(std::floor(std::log10(std::abs(value))));
    std::string text = fmt::format("{:.{}f}", value, std::max(decimals, 0));
    if (text.find('.') == text.npos) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text;
}

/// Returns a value for display without its unit. @param digits significant digits of numbers
std::string plain_value(const Param& p, const Value& v, int digits = kShownDigits) {
    if (const bool* b = std::get_if<bool>(&v)) return *b ? "on" : "off";
    if (const std::string* text = std::get_if<std::string>(&v)) return text->empty() ? "none" : *text;
    if (p.choices) {
        const auto list = p.choices();
        const auto i = std::size_t(std::get<int>(v));
        if (i < list.size()) return std::string(list[i].label);
    }
    const double* number = std::get_if<double>(&v);
    return number ? decimal_text(*number, digits) : value_text(p, v);
}

bool is_number(const Param& p, const Value& v) {
    return !p.choices && !std::holds_alternative<bool>(v) && !is_text(p);
}

}  // namespace

std::string light_title(const Settings& s, int light) {
    const bool named = light >= 0 && light < kMaxLights && !s.lights[std::size_t(light)].name.empty();
    return fmt::format("Light {}{}", light, named ? fmt::format(" ({})", s.lights[std::size_t(light)].name) : "");
}

std::string_view shown_unit(const Settings& settings, const SettingRef& ref) {
    const Param& p = *ref.param;
    if (p.unit == "lights") return {};  // the label says "Lights", and "1 lights" would be wrong
    if (p.unit == "deg or m")
        return settings.lights[std::size_t(ref.light)].type == LightType::Directional ? "deg" : "m";
    if (p.unit == "overlay's") {
        const int overlay = settings.view.overlay - 1;
        return overlay >= 0 && std::size_t(overlay) < overlays().size() ? overlays()[std::size_t(overlay)].unit : "";
    }
    if (p.unit.find('.') == std::string_view::npos) return p.unit;
    const auto named = find_setting(p.unit);
    if (!named || !named->param->choices) return p.unit;
    const auto choices = named->param->choices();
    const auto index = std::size_t(std::get<int>(get_value(settings, *named)));
    return index < choices.size() ? choices[index].label : std::string_view();
}

std::string shown_value(const Settings& s, const SettingRef& ref, const Value& v) {
    const std::string plain = plain_value(*ref.param, v);
    return is_number(*ref.param, v) ? with_unit(plain, shown_unit(s, ref)) : plain;
}

std::string change_text(const Settings& a, const Settings& b, const SettingRef& ref) {
    const Param& p = *ref.param;
    const Value from = get_value(a, ref), to = get_value(b, ref);
    const bool one_unit = is_number(p, from) && shown_unit(a, ref) == shown_unit(b, ref) && shown_unit(a, ref) != "deg";
    // A change beyond the shown digits gets as many more as tell both values apart.
    int digits = kShownDigits;
    while (digits < kMostDigits && from != to && plain_value(p, from, digits) == plain_value(p, to, digits)) ++digits;
    const auto shown = [&](const Settings& s, const Value& v) {
        const std::string plain = plain_value(p, v, digits);
        return is_number(p, v) ? with_unit(plain, shown_unit(s, ref)) : plain;
    };
    return fmt::format("{} → {}", one_unit ? plain_value(p, from, digits) : shown(a, from), shown(b, to));
}

}  // namespace si
