// Bias of graphics APIs, which all have the polygon offset of OpenGL under other names. Inside of profiles/ only.
#pragma once

#include "renderer/profiles/bias_numbers.h"

namespace si {

/// Names of the polygon offset of an API.
struct ApiNames {
    std::string_view factor, units, clamp;
    bool whole_units = false;  ///< units are integers
};

/// Converts the polygon offset of an API and the numbers of an own shader into a bias.
BiasNumbers read_api_bias(const ApiNames& names, const EngineProfile& profile, const EngineValues& values,
                          const MapFacts& facts);
/// Converts a bias into a polygon offset, and into numbers of an own shader where no offset gives it. A constant goes
/// into the units of formats with equal steps.
void write_api_bias(const ApiNames& names, const BiasNumbers& bias, const MapFacts& facts, EngineOutput& to);

}  // namespace si
