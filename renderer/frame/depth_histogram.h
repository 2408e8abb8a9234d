// What depths an image holds: extremes of what was drawn, and how often each depth occurs.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/frame/frame.h"

namespace si {

/// Extremes over the pixels where something was drawn: finite, and not the clear value of the far plane.
struct DepthStatistics {
    std::uint64_t drawn = 0, empty = 0;     ///< pixels; together all of the image
    double stored_min = 0, stored_max = 0;  ///< as stored; all are 0 when nothing was drawn
    double linear_min = 0, linear_max = 0;  ///< share of the way from the near plane (0) to the far plane (1)
    double metres_min = 0, metres_max = 0;  ///< along the axis
};

/// @param depth one channel as Renderer::read_shadow_map() and read_map_view_depth() give it
DepthStatistics depth_statistics(const FloatImage& depth, const DepthCurve& curve);

/// Counts of drawn pixels in bins of equal width over [lo, hi]; a value on the border of two bins is in the upper one,
/// `hi` itself in the last.
struct DepthHistogram {
    double lo = 0, hi = 1;
    std::vector<std::uint64_t> counts;
    std::uint64_t below = 0, above = 0;  ///< drawn, outside of the range
};

/// @param view raw: stored depths; linear: shares of near..far; bands: depths counted from the near plane
DepthHistogram depth_histogram(const FloatImage& depth, const DepthCurve& curve, MapView view, int bins = 256,
                               double lo = 0, double hi = 1);

/// The value that the map viewer shows of a stored depth, as view.map_black and view.map_white count it.
/// @param row map coordinate v, which counts where the map is warped
double shown_depth(double stored, const DepthCurve& curve, MapView view, double row);

/// Map coordinate v of a row of such an image, whose first is the map's top.
double map_v_of_row(const FloatImage& depth, int y);

}  // namespace si
