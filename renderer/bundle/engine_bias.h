// Knowledge of the bias with which an engine reads its own shadow map, and the source of that knowledge.
#pragma once

#include <string>
#include <string_view>

#include "renderer/settings/settings.h"

namespace si {

struct ImportedMaps;

/// State of knowledge about the bias with which an engine reads its own shadow map: known from its bundle or from the
/// user, changed by the settings, or unknown.
enum class EngineBias {
    Own,      ///< no engine drew the map: this program draws it
    File,     ///< the settings bias.* are the engine's bias, as its bundle states it
    Entered,  ///< the settings bias.* are the engine's bias, as the user has entered it (map.bundle_bias)
    Changed,  ///< the settings bias.* differ from the engine's bias, which the bundle states
    Unknown,  ///< the engine's bias is unknown; it is never taken as 0
};

/// Returns whether the bias with which an engine reads its maps is known, and from which source.
/// @param maps imported maps of one light; null, or without images: this program draws the maps
EngineBias engine_bias(const ImportedMaps* maps, const Settings& settings);

/// Returns true when two bias settings shift the shadow look-up equally. Polygon offset, which acts while maps are
/// drawn, may differ.
bool is_same_look_up_bias(const BiasSettings& a, const BiasSettings& b);

/// Returns true when the settings bias.* are the engine's bias, so that verdicts on pixels hold for the engine's
/// picture.
constexpr bool is_known(EngineBias bias) {
    return bias == EngineBias::File || bias == EngineBias::Entered;
}

/// Returns the JSON name of a state of knowledge about an engine's bias: "own", "known", "changed" or "unknown".
constexpr std::string_view engine_bias_key(EngineBias bias) {
    return bias == EngineBias::Own       ? "own"
           : is_known(bias)              ? "known"
           : bias == EngineBias::Changed ? "changed"
                                         : "unknown";
}

/// Returns the JSON name of the source of an engine's bias: "file" or "entered"; empty if the bias is unknown, or if
/// this program draws the map.
constexpr std::string_view engine_bias_source_key(EngineBias bias) {
    return bias == EngineBias::Entered                               ? "entered"
           : bias == EngineBias::File || bias == EngineBias::Changed ? "file"
                                                                     : "";
}

/// Returns words for a state of knowledge about an engine's bias, such as "as the bundle states it"; empty if this
/// program draws the map.
constexpr std::string_view engine_bias_text(EngineBias bias) {
    switch (bias) {
        case EngineBias::Own:
            return "";
        case EngineBias::File:
            return "as the bundle states it";
        case EngineBias::Entered:
            return "as entered (map.bundle_bias)";
        case EngineBias::Changed:
            return "stated by the bundle, and bias.* are another one";
        case EngineBias::Unknown:
            return "unknown";
    }
    return "";
}

/// Returns a sentence which warns that the engine's bias of a light's maps is unknown, or differs from the settings
/// bias.*. Wrong pixels are then not those of the engine. Empty when the bias is known, or when this program draws the
/// maps.
/// @param maps imported maps of the light; null: this program draws the maps
/// @param light index of the light in the settings light.*
std::string engine_bias_remark(const ImportedMaps* maps, const Settings& settings, int light);

}  // namespace si
