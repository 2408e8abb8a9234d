// Profiles of graphics APIs, which all have the polygon offset of OpenGL under other names. Inside of profiles/ only.
#pragma once

#include <array>

#include "renderer/profiles/bias_numbers.h"

namespace si {

/// Names of the polygon offset parameters in a graphics API, and the document that they are from.
struct ApiNames {
    std::string_view factor, units, clamp;
    std::string_view source;
    bool whole_units = false;  ///< units are integers
};

/// Returns the bias parameters of a graphics API as an engine profile lists them: three of the polygon offset, and the
/// depth bias and normal offset of an application's own shader.
std::array<EngineParameter, 5> api_parameters(const ApiNames& names);

/// Converts the bias parameters of a graphics API (polygon offset, and numbers of an application's own shader) to the
/// bias terms that all engines share (constant, normal offset and polygon offset).
BiasNumbers read_api_bias(const ApiNames& names, const EngineProfile& profile, const EngineValues& values,
                          const MapFacts& facts);
/// Converts a bias in the terms that all engines share (constant, normal offset and polygon offset) to the bias
/// parameters of a graphics API. A constant becomes polygon offset units for formats with equal depth steps; otherwise
/// it becomes a number for the application's own shader.
/// @param to receives the numbers
void write_api_bias(const ApiNames& names, const BiasNumbers& bias, const MapFacts& facts, EngineOutput& to);

/// Returns the profile of a graphics API: `head` with bias parameters and conversions added.
/// @tparam kNames names of the API's polygon offset parameters
/// @param head profile with name, title, version and what is not verified
template <const ApiNames& kNames>
EngineProfile api_profile(EngineProfile head) {
    static const std::array kParameters = api_parameters(kNames);
    head.parameters = kParameters;
    head.read_bias = [](const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
        return read_api_bias(kNames, profile, values, facts);
    };
    head.write_bias = [](const BiasNumbers& bias, const EngineValues&, const MapFacts& facts, EngineOutput& to) {
        write_api_bias(kNames, bias, facts, to);
    };
    return head;
}

}  // namespace si
