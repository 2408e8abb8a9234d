// GLSL of the chosen filter kernel and bias, made from the files of shaders/ for use in another program.
#pragma once

#include <string>
#include <vector>

#include "renderer/projection/map_size.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Facts of a light and its maps that exported code has as constants.
struct LookupFacts {
    LightType type = LightType::Directional;
    ViewChoice choice = ViewChoice::One;
    int views = 1;
    bool perspective = false, warped = false, stretched = false;
    bool closed = false;  ///< FittedLight::closed
    bool blends = false;  ///< two cascades are blended
    MapSize size{2048};
    double light_size = 0;  ///< PlacedLight::size
    Reach reach;            ///< of the kernel under this light
    int subpixel_bits = 8;  ///< of the rasteriser that draws the map
};

/// Returns the facts of light view.light that follow from settings alone.
LookupFacts lookup_facts(const Settings& settings);
/// Returns the facts of a fitted light. @param size texels of its maps
LookupFacts lookup_facts(const Settings& settings, const FittedLight& light, MapSize size, int subpixel_bits = 8);

/// Generated code with remarks.
struct ExportedCode {
    std::string text;
    std::vector<std::string> notes;  ///< what the code leaves out or does otherwise
};

/// Returns the reason why a look-up under these settings cannot be exported as code; empty: it can.
std::string lookup_export_refusal(const Settings& settings);

/// Generates a self-contained GLSL text with the function shadow_visibility() for light view.light: kernel and bias
/// from shaders/ with the numbers of the settings as constants. Needs GLSL 4.50; the text has no #version line.
/// @throws Error with lookup_export_refusal()
ExportedCode lookup_glsl(const Settings& settings, const LookupFacts& facts);

/// Generates a C++17 header with the shadow settings as constants and the structure of the uniforms of lookup_glsl().
std::string settings_cpp(const Settings& settings, const LookupFacts& facts);

}  // namespace si
