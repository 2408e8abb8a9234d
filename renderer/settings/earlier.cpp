#include "renderer/settings/earlier.h"

#include <algorithm>

namespace si {
namespace {

// Never edited, only added to: a default that changes puts what it was here.
constexpr EarlierDefault kEarlierDefaults[] = {
    {.version = 1, .key = "light.fit", .value = "scene"},
    {.version = 1, .key = "scene.ground", .value = "off"},
};

}  // namespace

std::span<const EarlierDefault> earlier_defaults() {
    return kEarlierDefaults;
}

int lights_of(std::span<const SettingValue> values) {
    int lights = Settings().light_count;
    for (const auto& [ref, value] : values) {
        if (ref.param->scope == Scope::Light) lights = std::max(lights, ref.light + 1);
        if (ref.param->key == "light.count") lights = std::max(lights, std::get<int>(value));
    }
    return lights;
}

Settings defaults_of_version(int version, int lights) {
    Settings settings;
    // From the newest change back to the oldest, so that of several of one setting the one that the version had stays.
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
