// Knowledge of the bias with which an engine reads its own shadow map, and the source of that knowledge.
#pragma once

#include <string>
#include <string_view>

#include "renderer/settings/settings.h"

namespace si {

struct ImportedMaps;

/// State of knowledge about the bias with which an engine reads its own shadow map, and its source.
enum class EngineBias {
    Own,      ///< the map is no engine's: this program draws it
    File,     ///< bias.* are the engine's bias, as its bundle states it
    Entered,  ///< bias.* are the engine's bias, as somebody has entered it (map.bundle_bias)
    Changed,  ///< the bundle states the engine's bias, and bias.* are another one
    Unknown,  ///< nobody knows it; it is never taken as 0
};

/// Returns whether the bias with which an engine reads its maps is known, and from which source.
/// @param maps imported maps of one light; null, or without images: this program draws the maps
EngineBias engine_bias(const ImportedMaps* maps, const Settings& settings);

/// Returns true when two bias settings shift the shadow look-up equally. Polygon offset, which acts while maps are
/// drawn, may differ.
bool is_same_look_up_bias(const BiasSettings& a, const BiasSettings& b);

/// Returns true when bias.* are the engine's, so that verdicts speak of the engine's pixel.
constexpr bool is_known(EngineBias bias) {
    return bias == EngineBias::File || bias == EngineBias::Entered;
}

/// Returns the name of this knowledge in JSON: "own", "known", "changed" or "unknown".
constexpr std::string_view engine_bias_key(EngineBias bias) {
    return bias == EngineBias::Own       ? "own"
           : is_known(bias)              ? "known"
           : bias == EngineBias::Changed ? "changed"
                                         : "unknown";
}

/// Returns the name in JSON of the source of the engine's bias: "file" or "entered"; empty: nobody states it, or the
/// map is no engine's.
constexpr std::string_view engine_bias_source_key(EngineBias bias) {
    return bias == EngineBias::Entered                               ? "entered"
           : bias == EngineBias::File || bias == EngineBias::Changed ? "file"
                                                                     : "";
}

/// Returns this knowledge in words, such as "as entered"; empty for this program's own map.
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

/// Returns a sentence which warns that the engine's bias of a light's maps is unknown or changed, so that wrong pixels
/// are not those of the engine. Empty when it is known, or when this program draws the maps.
/// @param maps imported maps of the light; null: this program draws the maps
/// @param light index of light.*
std::string engine_bias_remark(const ImportedMaps* maps, const Settings& settings, int light);

}  // namespace si
