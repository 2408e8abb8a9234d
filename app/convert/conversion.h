// Settings as code of another program, with a head that says what the numbers depend on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/base/json_text.h"
#include "app/convert/glsl_export.h"
#include "app/convert/targets.h"
#include "renderer/base/float_image.h"

namespace si {

/// Map of one view of the converted light.
struct ConvertedMap {
    double width_m = 0, depth_m = 0;
    int texels = 0;
};

/// Measured error and time of the converted settings.
struct ConvertedMeasure {
    std::string scene;
    int width = 0, height = 0;  ///< of the picture, pixels
    bool area = false;          ///< compared with a light of a size
    double wrong = 0, mae = 0;  ///< share of wrong pixels; mean error of visibility
    std::size_t acne_px = 0;
    std::optional<double> frame_ms;
    std::string driver, clock;
    bool operator==(const ConvertedMeasure&) const = default;
};

/// Input of a conversion. Texts may come from files and be hostile.
struct ConversionInput {
    std::string preset, title, scene;  ///< empty texts: none
    Settings settings;
    LookupFacts lookup;
    MapFacts facts;                  ///< of the light's first map
    std::string facts_source;        ///< where W, D come from, a clause
    std::string angle_source;        ///< where the reference angle comes from, a clause
    std::vector<ConvertedMap> maps;  ///< by view; empty: no scene
    std::optional<ConvertedMeasure> measure;
};

/// Result of a conversion.
struct Conversion {
    std::string text;                ///< head and code
    nlohmann::ordered_json json;     ///< the same as data
    std::vector<std::string> notes;  ///< for the user, one line each
};

/// Returns width W and depth range D of the map of view.light, metres, from settings alone. W comes from light.extent,
/// D from light.near and light.far, where these are set by hand; else the defaults of MapFacts are assumed.
/// @param[out] source where the numbers come from, a clause
MapFacts facts_of_settings(const Settings& settings, std::string& source);
/// Lists the maps of a fitted light, as map_facts() has them. @param size texels of each
std::vector<ConvertedMap> converted_maps(const Settings& settings, const FittedLight& light, MapSize size);

/// Returns the angle between normal and light that 95 % of the lit pixels do not exceed, degrees; nullopt without a lit
/// pixel. @param cosines values of the overlay n-dot-l, four numbers a pixel @param visibility one number a pixel
std::optional<double> reference_angle_deg(const FloatImage& cosines, const FloatImage& visibility);

/// Converts settings into code for a target. @throws Error, UsageError saying what to do
Conversion convert_settings(const ConvertTarget& target, const ConversionInput& input);

}  // namespace si
