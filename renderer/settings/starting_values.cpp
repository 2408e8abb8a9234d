#include "renderer/settings/starting_values.h"

namespace si {

std::span<const StartingValue> starting_values(const Settings& before, const Settings& after) {
    if (before.bias.kind == after.bias.kind) return {};
    return bias_of(after).starts;
}

void set_starting_values(const Settings& before, Settings& after, const std::set<std::string>& held) {
    for (const auto& [key, value] : starting_values(before, after))
        if (!held.contains(std::string(key))) set_setting(after, key, value);
}

std::set<std::string> keys_with_starting_values(const SettingRef& ref) {
    std::set<std::string> keys;
    if (ref.param->key != "bias.kind") return keys;
    for (const Bias& row : biases())
        for (const StartingValue& start : row.starts) keys.emplace(start.key);
    return keys;
}

std::vector<SettingRef> settings_to_set(const Settings& a, const Settings& b) {
    Settings started = b;
    set_starting_values(a, started);
    std::vector<SettingRef> refs = differing_settings(a, b);
    for (const SettingRef& ref : differing_settings(started, b))
        if (get_value(a, ref) == get_value(b, ref)) refs.push_back(ref);
    return refs;
}

}  // namespace si
