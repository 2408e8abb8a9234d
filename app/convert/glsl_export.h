// GLSL of the chosen filter kernel and bias, made from the files of shaders/ for use in another program.
#pragma once

#include <string>
#include <vector>

#include "renderer/projection/map_size.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Facts of a light and its shadow maps that become constants in exported GLSL and C++ code.
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
    bool operator==(const LookupFacts&) const = default;
};

/// Returns the facts of a light for exported code, as far as they follow from settings without a scene. The setting
/// view.light selects the light.
LookupFacts lookup_facts(const Settings& settings);
/// Returns the facts of a light that is fitted to a scene, for exported code.
/// @param size texels of its maps @param subpixel_bits bits of the rasteriser's sub-pixel grid (GL_SUBPIXEL_BITS)
LookupFacts lookup_facts(const Settings& settings, const FittedLight& light, MapSize size, int subpixel_bits = 8);

/// Generated GLSL code with remarks on what it leaves out or does in another way.
struct ExportedCode {
    std::string text;
    std::vector<std::string> notes;  ///< what the code leaves out or does otherwise
};

/// Returns the reason why the shadow look-up of these settings cannot be exported as GLSL code; empty: it can.
std::string lookup_export_refusal(const Settings& settings);

/// Generates GLSL code of the shadow look-up for use in another program. The code has one function to call,
/// shadow_visibility(), for the light that view.light selects. Kernel and bias come from shaders/; numbers of the
/// settings become constants. Needs GLSL 4.50; the code has no #version line.
/// @throws Error with lookup_export_refusal()
ExportedCode lookup_glsl(const Settings& settings, const LookupFacts& facts);

/// Generates a C++17 header for use in another program. The header has the shadow settings as constants, and structures
/// for the uniforms of the code of lookup_glsl().
std::string settings_cpp(const Settings& settings, const LookupFacts& facts);

}  // namespace si
