// Settings for display: values with units, titles of lights, changes.
#include <fmt/format.h>

#include <array>
#include <charconv>

#include "renderer/settings/overlays.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

std::string with_unit(std::string number, std::string_view unit) {
    if (unit == "deg") return number + "°";
    return unit.empty() ? number : fmt::format("{} {}", number, unit);
}

/// Returns a value for display without its unit.
std::string plain_value(const Param& p, const Value& v) {
    if (const bool* b = std::get_if<bool>(&v)) return *b ? "on" : "off";
    if (const std::string* text = std::get_if<std::string>(&v)) return text->empty() ? "none" : *text;
    if (p.choices) {
        const auto list = p.choices();
        const auto i = std::size_t(std::get<int>(v));
        if (i < list.size()) return std::string(list[i].label);
    }
    std::string text = value_text(p, v);
    const double* number = std::get_if<double>(&v);
    if (!number || text.find('e') == text.npos) return text;
    std::array<char, 400> digits;  // enough for the smallest double
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), *number, std::chars_format::fixed);
    return end.ec == std::errc() ? std::string(digits.data(), end.ptr) : text;
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
    return fmt::format("{} → {}", one_unit ? plain_value(p, from) : shown_value(a, ref, from), shown_value(b, ref, to));
}

}  // namespace si
