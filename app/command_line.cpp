#include "app/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "app/session.h"
#include "renderer/param.h"

namespace si {
namespace {

/// Quoted for a POSIX shell where it needs to be.
std::string shell_word(const std::string& text) {
    const auto plain = [](unsigned char c) {
        return std::isalnum(c) || std::string_view("-_./=+:,@%").find(char(c)) != std::string_view::npos;
    };
    if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace

Settings base_settings(const Scene& scene) {
    Settings s;
    apply_suggested(scene, s);
    return s;
}

std::string command_line(const std::string& scene_name, const Scene& scene, const Settings& settings, int width,
                         int height) {
    const Settings base = base_settings(scene);
    std::string text =
        fmt::format("shadow-inspector render {} -o out.png --size {}x{}", shell_word(scene_name), width, height);
    for (const SettingRef& ref : all_settings(settings)) {
        const Value value = get_value(settings, ref);
        if (value != get_value(base, ref))
            text += " --set " + shell_word(setting_key(ref) + "=" + value_text(*ref.param, value));
    }
    return text;
}

}  // namespace si
