// Defaults of earlier versions.
#include "renderer/settings/earlier.h"

#include <fmt/format.h>

#include <algorithm>

namespace si {
namespace {

// Rows are only added, never edited.
constexpr EarlierDefault kEarlierDefaults[] = {
    {.version = 2, .key = "bias.kind", .value = "slope"},
    {.version = 2, .key = "bias.constant", .value = "0.1"},
    {.version = 2, .key = "bias.normal", .value = "3"},
};

}  // namespace

std::span<const EarlierDefault>& earlier_defaults() {
    static std::span<const EarlierDefault> rows = kEarlierDefaults;
    return rows;
}

int oldest_settings_version() {
    int oldest = kSettingsVersion;
    for (const EarlierDefault& row : earlier_defaults()) oldest = std::min(oldest, row.version);
    return oldest;
}

std::string readable_versions() {
    const int oldest = oldest_settings_version();
    return oldest == kSettingsVersion ? fmt::format("version {}", kSettingsVersion)
                                      : fmt::format("versions {} to {}", oldest, kSettingsVersion);
}

int configured_light_count(std::span<const SettingValue> values) {
    int lights = Settings().light_count;
    for (const auto& [ref, value] : values) {
        if (ref.param->scope == Scope::Light) lights = std::max(lights, ref.light + 1);
        if (ref.param->key == "light.count") lights = std::max(lights, std::get<int>(value));
    }
    return lights;
}

Settings defaults_of_version(int version, int lights) {
    Settings settings;
    // Rows go from new to old. Of several rows of one setting the oldest one that covers the version is written last.
    const auto rows = earlier_defaults();
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
        if (version > row->version) continue;
        SettingRef ref = *find_setting(row->key);
        const Value value = parse_value(ref, row->value);
        const int count = ref.param->scope == Scope::Light ? std::clamp(lights, 0, kMaxLights) : 1;
        for (ref.light = 0; ref.light < count; ++ref.light) set_value(settings, ref, value);
    }
    return settings;
}

}  // namespace si
