// What can be counted of the sentences of the guided presets, by the presets' keys.
#pragma once

#include <map>
#include <string>

namespace si::test {

using Claims = std::map<std::string, void (*)()>;

/// Bias, culling, resolution and filters.
const Claims& guided_surface_claims();
/// The borders of the map, near and far, how depth is stored and shown.
const Claims& guided_map_claims();

}  // namespace si::test
