// Measurement of a scene for a conversion: maps, reference angle, error and time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/convert/conversion.h"
#include "renderer/advise/trial.h"

namespace si {

/// Measurements in a drawn scene that a conversion of shadow settings to code needs or states: map sizes, reference
/// angle, error and time.
struct MeasuredConversion {
    LookupFacts lookup;
    MapFacts facts;  ///< of the light's first map, with the default reference angle
    std::vector<ConvertedMap> maps;
    std::optional<double> angle_deg;  ///< reference_angle_deg(); none: no pixel is lit
    ConvertedMeasure measure;
    std::vector<std::string> notes;  ///< of the comparison with the reference
};

/// Draws and measures a scene for a conversion to code of the shadow settings of the light that view.light selects.
/// @param tools renderer, scene and picture size @param scene_name name of the scene for comments in the code
/// @param timed kind of frames to time; none: no time @throws Cancelled; Error when the light has no map
MeasuredConversion measure_conversion(const SearchTools& tools, const Settings& settings, const std::string& scene_name,
                                      std::optional<CostCase> timed);

/// Returns the origin of the reference angle between normal and light (MeasuredConversion::angle_deg), for the comment
/// at the head of converted code: "95 % of the scene's lit pixels are tilted less".
std::string angle_source(const MeasuredConversion& measured);

}  // namespace si
