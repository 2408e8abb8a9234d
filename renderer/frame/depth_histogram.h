// Statistics and histograms of depth images.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/frame/frame.h"

namespace si {

/// Smallest and largest depth of a depth image, over drawn pixels only. A drawn pixel is finite and differs from the
/// clear value of the far plane.
struct DepthStatistics {
    std::uint64_t drawn = 0, empty = 0;     ///< pixel counts; their sum is the image's size
    double stored_min = 0, stored_max = 0;  ///< as stored; all are 0 when nothing was drawn
    double linear_min = 0, linear_max = 0;  ///< share of the way from the near plane (0) to the far plane (1)
    double metres_min = 0, metres_max = 0;  ///< distances along the view axis
};

/// Returns the smallest and largest depth of a depth image's drawn pixels in three units: as stored, as share of the
/// way from near to far plane, and in metres.
/// @param depth one channel, from Renderer::read_shadow_map() or read_map_view_depth()
/// @param curve mapping from distance to stored depth
DepthStatistics depth_statistics(const FloatImage& depth, const DepthCurve& curve);

/// Histogram of the depths of a depth image's drawn pixels, in bins of equal width over [lo, hi]. A value on the border
/// of two bins is in the upper one; `hi` is in the last.
struct DepthHistogram {
    double lo = 0, hi = 1;
    std::vector<std::uint64_t> counts;
    std::uint64_t below = 0, above = 0;  ///< drawn pixels outside the range
};

/// Counts the depths of a depth image's drawn pixels in bins of equal width over [lo, hi], for the histogram of the map
/// viewer.
/// @param view unit of lo and hi. Raw: stored depths. Linear: shares of the way from near to far plane. Bands: stored
/// depths, inverted for reversed depth
/// @param bins number of bins
DepthHistogram depth_histogram(const FloatImage& depth, const DepthCurve& curve, MapView view, int bins = 256,
                               double lo = 0, double hi = 1);

/// Converts a stored depth to the scale of the map viewer, in which view.map_black and view.map_white are given.
/// @param view scale: stored depth, share of the way from near to far plane (Linear), or depth that grows with distance
/// (Bands)
/// @param row map coordinate v in [0, 1]; matters for warped maps only
double shown_depth(double stored, const DepthCurve& curve, MapView view, double row);

/// Returns the map coordinate v in [0, 1] at the middle of row `y` of a depth image that was read back. Row 0 is the
/// top of the map.
double map_v_of_row(const FloatImage& depth, int y);

}  // namespace si
