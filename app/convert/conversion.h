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

/// Width and depth range (metres) and texels across of one shadow map (cascade or face) of the light whose settings are
/// converted to code.
struct ConvertedMap {
    double width_m = 0, depth_m = 0;
    int texels = 0;
    bool operator==(const ConvertedMap&) const = default;
};

/// Error and frame time that were measured with the converted settings, for the comment at the head of the code.
struct ConvertedMeasure {
    std::string scene;
    int width = 0, height = 0;  ///< of the picture, pixels
    bool area = false;          ///< compared with the reference of an area light
    double wrong = 0, mae = 0;  ///< share of wrong pixels; mean error of visibility
    std::size_t acne_px = 0;
    std::optional<double> frame_ms;
    std::string driver, clock;
    bool operator==(const ConvertedMeasure&) const = default;
};

/// Input of a conversion of shadow settings into code of another program. Its texts may come from untrusted files.
struct ConversionInput {
    std::string preset, title, scene;  ///< empty texts: none
    Settings settings;
    LookupFacts lookup;
    MapFacts facts;  ///< of the light's first map
    /// Origin of map width W and depth range D, for the comment in the code: "as the scene's map is fitted".
    std::string facts_source;
    std::string angle_source;        ///< origin of the reference angle, for the same comment: angle_source()
    std::vector<ConvertedMap> maps;  ///< by view; empty: no scene
    std::optional<ConvertedMeasure> measure;
    bool operator==(const ConversionInput&) const = default;
};

/// Result of a conversion of shadow settings into code of another program: the code, the same facts as JSON, and
/// remarks.
struct Conversion {
    std::string text;                ///< head and code
    nlohmann::ordered_json json;     ///< the same as data
    std::vector<std::string> notes;  ///< for the user, one line each
};

/// Estimates width W and depth range D of a shadow map, metres, from settings alone, for conversions without a scene.
/// The setting view.light selects the light. W comes from light.extent, and D from light.near and light.far, if they
/// are set by hand. Otherwise W and D have the defaults of MapFacts.
/// @param[out] source origin of W and D, for the comment in the code: "by light.extent, light.near and light.far"
MapFacts facts_of_settings(const Settings& settings, std::string& source);
/// Lists width, depth range and texels of all shadow maps of a light, for the comment at the head of converted code.
/// @param size texels of each map
std::vector<ConvertedMap> converted_maps(const Settings& settings, const FittedLight& light, MapSize size);

/// Returns the reference angle for conversions to an engine's parameters, degrees. For 95 % of the lit pixels the angle
/// between normal and light is at most this large. The result is at most 89; nullopt without a lit pixel.
/// @param cosines values of the overlay n-dot-l, four numbers a pixel @param visibility one number a pixel
std::optional<double> reference_angle_deg(const FloatImage& cosines, const FloatImage& visibility);

/// Converts shadow settings into code for another engine, a graphics API or a language. A comment at the head of the
/// code names what each number depends on. @throws Error, UsageError saying what to do
Conversion convert_settings(const ConvertTarget& target, const ConversionInput& input);

}  // namespace si
