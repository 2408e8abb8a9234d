// Widths of shadows and lit gaps around each pixel, measured across the light direction. From them follows the map
// resolution that a pixel needs.
//
//     ShadowRuns runs = shadow_runs(truth, receivers, camera, raster, query, {});
//     runs.run_m.at(x, y) < texel_m;   // the lit or dark strip that the pixel lies in is narrower than a texel
#pragma once

#include <vector>

#include "renderer/reference/reference.h"

namespace si {

/// Widths of the lit or shadowed stretch (run) around each pixel, which tell how narrow a shadow map's texels have to
/// be. Widths are in metres perpendicular to the light's rays, along the two axes of the light's map. Lit and shadowed
/// are as in the reference of a light without size. A width is infinite where the reference does not change within
/// kRunReach pixels, or up to the end of the surface.
struct ShadowRuns {
    /// Limit of the texel width for the pixel. A wider texel exceeds the pixel's own run, or reaches from the pixel
    /// across a narrower neighbouring run (such as a thin bar's shadow next to a lit pixel).
    FloatImage run_m;
    FloatImage edge_m;  ///< distance to the nearest change of the reference along either axis
};

/// Search distance for the ends of a run (lit or shadowed stretch of a surface), in pixels of the reference on either
/// side. The width of a longer run counts as infinite.
inline constexpr int kRunReach = 64;

/// Measures the widths of lit and shadowed stretches in a reference, from pixel to pixel along the surface that the
/// camera sees. Continues behind objects that occlude a part of the surface. Traces no rays. A part of a picture gives
/// the same numbers as the whole if it extends kRunReach pixels around a pixel.
/// @param raster pixels of the picture that the reference samples
/// @param query query from which the reference was traced. Widths are measured along the axes of ReferenceQuery::views,
/// and are infinite without views.
/// @throws Cancelled
ShadowRuns shadow_runs(const Reference& reference, const Receivers& receivers, const Camera& camera,
                       const PixelRaster& raster, const ReferenceQuery& query, const Workers& workers);

/// Returns true when shadow_runs() gives equal widths for two references of the same camera and receivers, so that they
/// need not be measured again. This holds if the same pixels are lit and the maps have the same axes. Depth range,
/// extent and resolution of the maps, and cascades of a light with parallel rays, do not matter.
bool have_same_runs(const Reference& a, const ReferenceQuery& query_a, const Reference& b,
                    const ReferenceQuery& query_b);

}  // namespace si
