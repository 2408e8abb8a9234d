#include "renderer/bundle/engine_bias.h"

#include <fmt/format.h>

#include "renderer/bundle/imported_maps.h"

namespace si {

bool is_same_look_up_bias(const BiasSettings& a, const BiasSettings& b) {
    return a.kind == b.kind && a.unit == b.unit && a.constant == b.constant && a.slope == b.slope &&
           a.plane_clamp == b.plane_clamp && a.normal == b.normal && a.normal_source == b.normal_source &&
           (a.normal == 0 || (a.normal_unit == b.normal_unit && a.normal_by == b.normal_by));
}

EngineBias engine_bias(const ImportedMaps* maps, const Settings& settings) {
    if (!maps || !maps->has_images()) return EngineBias::Own;
    switch (settings.map.bundle_bias) {
        case BundleBiasSource::Entered:
            return EngineBias::Entered;
        case BundleBiasSource::Unknown:
            return EngineBias::Unknown;
        case BundleBiasSource::File:
            break;
    }
    if (!maps->bias_known) return EngineBias::Unknown;
    return !maps->bias || is_same_look_up_bias(*maps->bias, settings.bias) ? EngineBias::File : EngineBias::Changed;
}

std::string engine_bias_remark(const ImportedMaps* maps, const Settings& settings, int light) {
    switch (engine_bias(maps, settings)) {
        case EngineBias::Unknown:
            return fmt::format(
                "light {}: the bias with which the engine reads its map is unknown; wrong pixels are those of this "
                "program under bias.*, not the engine's; set bias.* to the engine's values and map.bundle_bias to "
                "entered, or state lookup.bias in the bundle",
                light);
        case EngineBias::Changed:
            return fmt::format(
                "light {}: bias.* are not the bias that the bundle states for its map; wrong pixels are those of this "
                "program under bias.*, not the engine's",
                light);
        case EngineBias::Own:
        case EngineBias::File:
        case EngineBias::Entered:
            break;
    }
    return {};
}

}  // namespace si
