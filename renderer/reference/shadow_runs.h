// How far the truth about shadows stays as it is around each pixel, measured across the light.
//
//     ShadowRuns runs = shadow_runs(truth, receivers, camera, raster, emitter, views, {});
//     runs.run_m.at(x, y) < texel_m;   // the lit or dark strip that the pixel lies in is narrower than a texel
#pragma once

#include <vector>

#include "renderer/reference/truth.h"

namespace si {

/// In metres across the light, of the hard truth, along the two axes of the light's map (right and up). Infinite where
/// nothing is found within kRunReach pixels of the truth, or before the surface ends in the picture; 0 is never found.
struct ShadowRuns {
    FloatImage run_m;   ///< length of the shorter of the two runs of equal truth through the pixel
    FloatImage edge_m;  ///< to the nearest change of the truth along either axis
};

/// Pixels of the truth on either side. A texel that is wider in the picture than this has no narrower run.
inline constexpr int kRunReach = 64;

/// Found on the surface that the camera sees, from pixel to neighbouring pixel, so that no ray is traced and a part of a
/// picture that reaches kRunReach beyond a pixel gives the very numbers of the whole.
/// @param raster of the picture that the truth's pixels are of
/// @param views of the light's map; empty: everything is infinite
/// @throws Cancelled
ShadowRuns shadow_runs(const Truth& truth, const Receivers& receivers, const Camera& camera, const PixelRaster& raster,
                       const Emitter& emitter, const std::vector<LightView>& views, const Workers& workers);

}  // namespace si
