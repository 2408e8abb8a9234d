// Widths of shadows and lit gaps around each pixel, measured across the light direction. From them follows the map
// resolution that a pixel needs.
//
//     ShadowRuns runs = shadow_runs(truth, receivers, camera, raster, query, {});
//     runs.run_m.at(x, y) < texel_m;   // the lit or dark strip that the pixel lies in is narrower than a texel
#pragma once

#include <vector>

#include "renderer/reference/reference.h"

namespace si {

/// Widths of the lit or shadowed stretches around each pixel, in metres perpendicular to the light's rays, along the
/// two axes of the light's map. Lit and in shadow are those of the reference for a light without size. Infinite where
/// the reference does not change within kRunReach pixels, or up to the end of the surface.
struct ShadowRuns {
    /// Smallest texel that is too wide for the pixel: wider than the pixel's own run, or spanning from it across a
    /// narrower neighbouring run (a thin bar's shadow next to a lit pixel).
    FloatImage run_m;
    FloatImage edge_m;  ///< distance to the nearest change of the reference along either axis
};

/// Search distance for shadow runs, in pixels of the reference on either side. Texels wider than this in the picture
/// find no narrower run.
inline constexpr int kRunReach = 64;

/// Measures shadow runs from pixel to pixel on the surface that the camera sees, also where something occludes part of
/// it. Traces no rays. A part of a picture gives the same numbers as the whole where the part extends kRunReach around
/// a pixel.
/// @param raster the pixels of the picture that the reference samples
/// @param query query that the reference answers; without views everything is infinite
/// @throws Cancelled
ShadowRuns shadow_runs(const Reference& reference, const Receivers& receivers, const Camera& camera,
                       const PixelRaster& raster, const ReferenceQuery& query, const Workers& workers);

/// Returns true when shadow_runs() of two references is certainly equal, for the same camera and receivers: lit and in
/// shadow are the same pixels, and the maps have the same axes. Depth range, extent and resolution of the maps, and
/// cascades of a light with parallel rays, do not matter.
bool have_same_runs(const Reference& a, const ReferenceQuery& query_a, const Reference& b,
                    const ReferenceQuery& query_b);

}  // namespace si
