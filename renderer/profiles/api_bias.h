// Profiles of graphics APIs, which all have the polygon offset of OpenGL under other names. Inside of profiles/ only.
#pragma once

#include <array>

#include "renderer/profiles/bias_numbers.h"

namespace si {

/// Names of the polygon offset of an API, and where they are from.
struct ApiNames {
    std::string_view factor, units, clamp;
    std::string_view source;
    bool whole_units = false;  ///< units are integers
};

/// Returns the parameters of an API: its polygon offset, and two numbers of an own shader.
std::array<EngineParameter, 5> api_parameters(const ApiNames& names);

/// Converts the polygon offset of an API and the numbers of an own shader into a bias.
BiasNumbers read_api_bias(const ApiNames& names, const EngineProfile& profile, const EngineValues& values,
                          const MapFacts& facts);
/// Converts a bias into a polygon offset, and into numbers of an own shader where no offset gives it. A constant goes
/// into the units of formats with equal steps.
void write_api_bias(const ApiNames& names, const BiasNumbers& bias, const MapFacts& facts, EngineOutput& to);

/// Returns the profile of an API. @tparam kNames names of its polygon offset
/// @param head row with name, title, version and what is not verified
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
