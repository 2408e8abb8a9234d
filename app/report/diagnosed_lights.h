// Diagnoses of a probed pixel for all lights of a scene.
#pragma once

#include <vector>

#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/reference/reference_scene.h"

namespace si {

/// Diagnoses the shadow of every light at a probed pixel: whether the pixel is right, the cause of an error, and a fix.
/// Returns one diagnosis per light of the probe.
/// @param casters ray-tracing hierarchy over the probed scene
std::vector<PixelDiagnosis> diagnose_lights(const Probe& probe, const Scene& scene, const Settings& settings,
                                            const DriverInfo& driver, const ReferenceScene& casters);

}  // namespace si
