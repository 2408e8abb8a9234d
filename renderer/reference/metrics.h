// How far a picture of visibility is from the truth, in numbers. Pure CPU; the oracle of whatever computes them quicker.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/reference/truth.h"

namespace si {

/// What is wrong with a pixel, and why.
enum class Artefact : std::uint8_t {
    None,          ///< right, or not counted
    Acne,          ///< dark though lit, where no true edge is near: the surface shadows itself
    PeterPanning,  ///< lit though dark: the bias is larger than the gap to the surface that the map stores
    Leak,          ///< lit though dark, for another reason, where no true edge is near
    EdgeAliasing,  ///< wrong within the kernel's reach of a true edge
    OutsideMap,    ///< the map does not hold this surface (right or wrong)
    LostCaster,    ///< lit though dark: culling or the near plane left out of the map what casts here
};
inline constexpr std::size_t kArtefacts = 7;

/// What is known of each pixel beside its two visibilities. Empty vectors mean: nothing of the kind anywhere.
struct PixelFacts {
    std::vector<std::uint8_t> outside_map;  ///< 1: beyond the map's sides or far plane, or behind the light
    /// Chebyshev distance, in texels, from the kernel's footprint centre to the nearest texel centre where the same
    /// surface is lit and the pixel's dark, or the reverse; infinite when none is within the kernel's reach. Needed
    /// where the two visibilities differ. See edge_distances().
    std::vector<float> edge_texels;
    /// How much nearer to the light the bias moves the pixel, in metres along its light ray. Needed as above.
    std::vector<float> bias_m;
    /// Whether the pixel and its right (bit 0) or lower (bit 1) neighbour show one surface, so that a contour between
    /// them is a shadow's. Empty: all do.
    std::vector<std::uint8_t> joins;
};

/// Visibility V against the truth R over the pixels that count (PixelState::Counted), n in number. Shadow is below one
/// half. Fractions are of n, and 0 when n is 0.
struct ErrorMetrics {
    std::size_t counted = 0;
    double false_shadow = 0;  ///< #{R >= 1/2 and V < 1/2} / n
    double false_light = 0;   ///< #{R < 1/2 and V >= 1/2} / n
    double acne = 0;          ///< false shadow inside the map, away from true edges
    double leak = 0;          ///< false light inside the map, away from true edges (peter-panning, lost casters, leaks)
    double boundary_false_shadow = 0, boundary_false_light = 0;  ///< inside the map, near true edges
    double outside_false_shadow = 0, outside_false_light = 0;    ///< outside of the map
    double any_acne = 0;      ///< #{R = 1, no true edge near, inside the map, V < 1 - 1e-3} / n
    double mae = 0;           ///< sum |V - R| / n
    double rmse = 0;          ///< sqrt(sum (V - R)^2 / n)
    double signed_mean = 0;   ///< sum (V - R) / n: above 0 too light
    double iou = 1;           ///< of the shadows: #{both} / #{either}; 1 when neither has any
    /// Distance between the contours V = 1/2 and R = 1/2 in pixels of the picture, from each pixel of either contour to the nearest of
    /// the other: mean, 95th percentile and largest (Hausdorff). NaN when one has a contour and the other none, 0 when
    /// neither has.
    double boundary_px_mean = 0, boundary_px_p95 = 0, boundary_px_max = 0;
    double outside_map = 0;   ///< pixels outside of the map / n, right or wrong
    std::array<std::size_t, kPixelStates> pixels{};   ///< per PixelState: what was counted, and what not and why
    std::array<std::size_t, kArtefacts> artefacts{};  ///< pixels per Artefact
};

/// Below this difference of visibility a pixel counts as right.
inline constexpr double kRightVisibility = 1e-3;

/// @param measured visibility, one channel, the truth's size. @throws Error when sizes differ
/// @param artefacts if not null, gets one per pixel
ErrorMetrics error_metrics(const FloatImage& measured, const Truth& truth, const PixelFacts& facts,
                           std::vector<Artefact>* artefacts = nullptr);

}  // namespace si
