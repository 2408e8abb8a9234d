// How far the truth about shadows stays as it is around each pixel, measured across the light.
//
//     ShadowRuns runs = shadow_runs(truth, receivers, camera, raster, query, {});
//     runs.run_m.at(x, y) < texel_m;   // the lit or dark strip that the pixel lies in is narrower than a texel
#pragma once

#include <vector>

#include "renderer/reference/truth.h"

namespace si {

/// In metres across the light, of the hard truth, along the two axes of the light's map (right and up). Infinite where
/// nothing is found within kRunReach pixels of the truth, or before the surface ends in the picture.
struct ShadowRuns {
    /// The least texel that is too wide here: wider than the run of equal truth that the pixel lies in, or reaching
    /// from it across a neighbouring run that is narrower than itself (a thin bar's shadow beside a lit pixel).
    FloatImage run_m;
    FloatImage edge_m;  ///< to the nearest change of the truth along either axis
};

/// Pixels of the truth on either side. A texel that is wider in the picture than this has no narrower run.
inline constexpr int kRunReach = 64;

/// Found on the surface that the camera sees, from pixel to pixel, also behind what stands before it, so that no ray is
/// traced and a part of a picture that reaches kRunReach beyond a pixel gives the very numbers of the whole.
/// @param raster of the picture that the truth's pixels are of
/// @param query that the truth answers; without views everything is infinite
/// @throws Cancelled
ShadowRuns shadow_runs(const Reference& reference, const Receivers& receivers, const Camera& camera,
                       const PixelRaster& raster, const ReferenceQuery& query, const Workers& workers);

}  // namespace si
