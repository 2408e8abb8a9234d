// Settings that cannot change a shadow map that is given as an image.
#pragma once

#include <string_view>

namespace si {

/// Reason why a change of settings is not tried on an imported map.
inline constexpr std::string_view kNeedsAnotherMap = "needs another map from the engine";

/// Returns true when a setting acts only while a map is fitted or drawn, so that it changes no imported map: its
/// resolution, format, fit, culling and polygon offset.
/// @param key key as for find_setting(), such as "light.0.fit"
bool acts_while_drawing(std::string_view key);

/// Returns true when a setting acts on a map that is drawn again with an imported map's view (map.bundle_maps).
/// @param key key of a setting that acts while a map is fitted or drawn
bool acts_on_redrawn_map(std::string_view key);

}  // namespace si
