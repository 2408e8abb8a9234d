// How far a picture of visibility is from the truth, in numbers. Pure CPU; what the GPU sums up is held against it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/reference/causes.h"
#include "renderer/reference/truth.h"
#include "shaders/shared/judged.h"

namespace si {

/// What the frame found for each pixel of the truth, as shaders/passes/compare.frag.glsl and causes.frag.glsl write it.
struct JudgedPixel {
    enum Bits : std::uint32_t {
        kFalseShadow = shared::FALSE_SHADOW,
        kFalseLight = shared::FALSE_LIGHT,
        kOutside = shared::OUTSIDE,  ///< the map does not hold the surface
        kAnyAcne = shared::ANY_ACNE,
        kWithinNoise = shared::WITHIN_NOISE,  ///< on the other side of one half than the truth, but no further than its
                                              ///< noise explains
        kFaint = shared::FAINT,               ///< wholly lit in truth, and less than that, but not wrong
        kCounts = shared::COUNTS,
        kSeam = shared::SEAM,  ///< Cause::seam
    };
    static constexpr int kAlsoShift = shared::ALSO_SHIFT;
    Artefact artefact = Artefact::None;
    std::uint32_t bits = 0;
    float visibility = 1;
    std::uint32_t also() const { return bits >> kAlsoShift; }  ///< Cause::also
    bool has(Bits b) const { return (bits & b) != 0; }
};

/// The bits of a pixel that counts, but kAnyAcne and kSeam. @param visibility not NaN
std::uint32_t compared_bits(float visibility, const TruePixel& truth, bool outside);

/// A pixel of the truth as causes take it.
TruePixel true_pixel(const Truth& truth, std::size_t i);

/// From what is read back of FrameResult::judged, at the truth's pixels. @param judged two channels, of the truth's
/// size
std::vector<JudgedPixel> judged_pixels(const FloatImage& judged);

/// Whether each pixel and its right (bit 0) or lower (bit 1) neighbour show one surface, so that a contour between them
/// is a shadow's.
std::vector<std::uint8_t> joins_of(const Receivers& receivers);

/// Visibility V against the truth R over the pixels that count (PixelState::Counted), n in number. Shadow is below one
/// half. Fractions are of n, and 0 when n is 0. False shadow and false light are the sums of their causes:
///
///     false_shadow = acne + offset_false_shadow + boundary_false_shadow + outside_false_shadow
///     false_light = bias_false_light + lost_false_light + leak + boundary_false_light + outside_false_light
struct ErrorMetrics {
    std::size_t counted = 0;
    double false_shadow = 0;         ///< #{R >= 1/2 and V < 1/2, beyond the truth's noise} / n
    double false_light = 0;          ///< #{R < 1/2 and V >= 1/2, beyond the truth's noise} / n
    double acne = 0;                 ///< Artefact::Acne / n
    double leak = 0;                 ///< Artefact::Leak / n
    double bias_false_light = 0;     ///< (PeterPanning + PeterPanningOffset) / n
    double lost_false_light = 0;     ///< LostCaster / n
    double offset_false_shadow = 0;  ///< OffsetShadow / n
    /// EdgeAliasing + Undersampled + Penumbra + NoMap of either kind / n; false shadow with Filter.
    double boundary_false_shadow = 0, boundary_false_light = 0;
    double outside_false_shadow = 0, outside_false_light = 0;  ///< OutsideMap of either kind / n
    double any_acne = 0;      ///< #{R = 1, V < 1 - 1e-3, and more bias makes it whole} / n
    double within_noise = 0;  ///< on the other side of one half than R, which is too noisy to call that wrong, / n
    double mae = 0;           ///< sum |V - R| / n
    double rmse = 0;          ///< sqrt(sum (V - R)^2 / n)
    double signed_mean = 0;   ///< sum (V - R) / n: above 0 too light
    double iou = 1;           ///< of the shadows: #{both} / #{either}; 1 when neither has any
    /// Distance between the contours V = 1/2 and R = 1/2 in pixels of the picture, from each pixel of either contour to
    /// the nearest of the other: mean, 95th percentile and largest (Hausdorff). NaN when one has a contour and the
    /// other none, 0 when neither has.
    double boundary_px_mean = 0, boundary_px_p95 = 0, boundary_px_max = 0;
    double outside_map = 0;                           ///< pixels that the map does not hold / n, right or wrong
    std::array<std::size_t, kPixelStates> pixels{};   ///< per PixelState: what was counted, and what not and why
    std::array<std::size_t, kArtefacts> artefacts{};  ///< wrong pixels per cause; None: all others
};

/// @param judged one per pixel of the truth @param joins joins_of(), or empty: all are joined
/// @throws Error when sizes differ
ErrorMetrics error_metrics(const std::vector<JudgedPixel>& judged, const Truth& truth,
                           const std::vector<std::uint8_t>& joins = {});

}  // namespace si
