// LDR-FLIP: difference of two pictures as a person sees it who alternates between them at the same place.
//
//     const Flip flip = flip_difference(picture, other);
//     flip.mean, flip.map.at(x, y)
#pragma once

#include "renderer/base/workers.h"
#include "renderer/frame/frame.h"

namespace si {

/// Pixels per degree of visual angle, seen at 0.7 m from a monitor that is 0.7 m and 3840 pixels wide (Andersson et al.
/// 2020, section 4).
inline constexpr double kFlipPixelsPerDegree = 67.0206;
/// Range to which flip_difference() clamps its pixels per degree of visual angle. The width of its filters grows with
/// this number.
inline constexpr double kMinPixelsPerDegree = 1, kMaxPixelsPerDegree = 500;

/// Perceived difference of two pictures by the metric FLIP, 0 (none) to 1 (largest): for each pixel, mean and maximum.
struct Flip {
    FloatImage map;  ///< one number a pixel, top row first
    double mean = 0, max = 0;
};

/// Computes LDR-FLIP of two sRGB pictures of equal size; alpha is ignored. Symmetric in both pictures.
/// Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference Evaluator for Alternating
/// Images", HPG 2020, section 4.
/// @param pixels_per_degree pixels per degree of visual angle, clamped to [kMinPixelsPerDegree, kMaxPixelsPerDegree]
/// @throws Error when the sizes differ; Cancelled
Flip flip_difference(const ByteImage& a, const ByteImage& b, double pixels_per_degree = kFlipPixelsPerDegree,
                     const Workers& workers = {});

/// Draws the FLIP difference of two pictures as an image in the sequential colour scale of the overlays: 0 is dark
/// blue, 1 is yellow.
/// @param map difference by pixel, 0 to 1 (Flip::map)
ByteImage flip_picture(const FloatImage& map);

}  // namespace si
