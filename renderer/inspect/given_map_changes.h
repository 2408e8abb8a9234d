// Settings that cannot change a shadow map that is given as an image.
#pragma once

#include <string_view>

namespace si {

/// Reason why a change of settings is not tried on an imported shadow map (an engine's image).
inline constexpr std::string_view kNeedsAnotherMap = "needs another map from the engine";

/// Returns true when a setting acts only while a shadow map is fitted or drawn: resolution, format, fit, culling,
/// polygon offset. Such a setting changes nothing on an imported map, which is given as an image.
/// @param key key as for find_setting(), such as "light.0.fit"
bool acts_while_drawing(std::string_view key);

/// Returns true when a setting changes a map that this program draws in place of an imported map, with the same view
/// (map.bundle_maps).
/// @param key key of a setting for which acts_while_drawing() is true
bool acts_on_redrawn_map(std::string_view key);

}  // namespace si
