// What can be counted of the sentences of the guided presets, by the presets' keys.
#pragma once

#include <map>
#include <string>

#include "renderer/reference/metrics.h"

namespace si::test {

using Claims = std::map<std::string, void (*)()>;

/// Pixels of a cause, of those that count.
inline double share(const ErrorMetrics& e, Artefact cause) {
    return double(e.artefacts[std::size_t(cause)]) / double(e.counted);
}

/// Bias, culling, resolution and filters.
const Claims& guided_surface_claims();
/// Kernels that sample, and penumbrae.
const Claims& guided_soft_claims();
/// The borders of the map, near and far, how depth is stored and shown.
const Claims& guided_map_claims();
/// Kernels that read averages of functions of depth.
const Claims& guided_moment_claims();
/// Cascades, and how maps follow the camera.
const Claims& guided_view_claims();

}  // namespace si::test
