// Changes that need another map than an engine's, tried on the program's own map from the same light.
#pragma once

#include <string>
#include <string_view>

#include "renderer/advise/trial.h"

namespace si {

/// Remark on a change that is tried on the program's own map.
inline constexpr std::string_view kTriedOnOwnMap = "tried on the inspector's own map from the same light";

/// Shadow maps that this program draws for a light with imported ones, with the same matrices, viewports and raster
/// state. Changes that an imported image cannot show are tried on these maps, if they agree with the imported ones
/// within limits (MapGate).
struct OwnMap {
    Settings settings;        ///< present settings with map.bundle_maps=drawn
    MeasuredSettings before;  ///< measurement under `settings`; unknown if why_not is not empty
    std::string why_not;      ///< reason why the own maps cannot replace the imported ones; empty: they can
};

/// Draws this program's own shadow maps for a light with imported ones, and compares them with the imported maps.
/// Measures a frame with the drawn maps if all maps of the light agree within limits (MapGate). Else, and after an
/// error, OwnMap::why_not has the reason.
/// @param base settings whose map.bundle gives the imported maps
/// @param before frame measured under `base`
/// @throws Cancelled
OwnMap own_map_of(const SearchTools& tools, const Settings& base, const MeasuredSettings& before,
                  const TrialMeter& meter);

/// Draws a candidate (setting change to try) on the program's own maps, and compares it with the present settings on
/// these maps. Trial::changes are the changes from `base`. Leaves the candidate undrawn if own maps cannot show the
/// change either. Also leaves it undrawn if the watched pixel is right on the imported map and wrong on the own map, or
/// the reverse.
/// @param before measured under `base` @param pixel index of a pixel to watch, top row first
/// @param needs_causes as in try_candidate()
Trial try_on_own_map(const Settings& base, const MeasuredSettings& before, const OwnMap& own, Candidate candidate,
                     const TrialMeter& meter, std::optional<std::size_t> pixel = {},
                     const NeedsCauses& needs_causes = {});

}  // namespace si
