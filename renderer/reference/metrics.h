// Error metrics of visibility against the ray-traced reference. CPU code, with which tests compare the GPU's sums.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/frame/causes.h"
#include "renderer/reference/reference.h"
#include "shaders/shared/classified.h"

namespace si {

/// Result of comparing one pixel's shadow with the reference: flags, cause of its error and visibility, as the shaders
/// compare.frag.glsl and causes.frag.glsl write them.
struct ClassifiedPixel {
    /// Flags of a pixel that was compared with the reference: false shadow, false light, acne and others.
    enum Bits : std::uint32_t {
        kFalseShadow = shared::FALSE_SHADOW,
        kFalseLight = shared::FALSE_LIGHT,
        kOutside = shared::OUTSIDE,  ///< the map does not cover the surface
        kAnyAcne = shared::ANY_ACNE,
        kWithinNoise = shared::WITHIN_NOISE,  ///< on the other side of 0.5 than the reference, but within its noise
        kFaint = shared::FAINT,               ///< fully lit in the reference, darker in the picture, but not wrong
        kCounts = shared::COUNTS,
        kSeam = shared::SEAM,  ///< taps reach beyond the map's sides: Cause::seam
    };
    static constexpr int kAlsoShift = shared::ALSO_SHIFT;
    Artefact artefact = Artefact::None;
    std::uint32_t bits = 0;
    float visibility = 1;
    bool any_leak = false;  ///< light in the umbra: umbra_of() is 1, and `visibility` exceeds VISIBLE_ERROR
    /// Returns further causes of the pixel's error: bits as in Cause::also.
    std::uint32_t also() const { return bits >> kAlsoShift; }
    /// Returns true when the classified pixel has flag `b`.
    bool has(Bits b) const { return (bits & b) != 0; }
    /// Returns true for a pixel in false shadow or false light, whether or not its cause is known.
    bool is_wrong() const { return has(kFalseShadow) || has(kFalseLight); }
};

/// Compares the visibility of a counted pixel (PixelState::Counted) with the reference. Returns flags of the
/// enumeration ClassifiedPixel::Bits, all but kAnyAcne and kSeam.
/// @param visibility visibility in the picture, not NaN
/// @param outside true: the shadow map does not cover the surface
std::uint32_t compared_bits(float visibility, const ReferencePixel& reference, bool outside);

/// Returns reference visibility and noise of one pixel, to which a picture's visibility is compared.
/// @param i index of the pixel, top row first
ReferencePixel reference_pixel(const Reference& reference, std::size_t i);

/// Decodes the class of each pixel, with the cause of its error, from the image FrameResult::classified, read back from
/// the GPU.
/// @param classified image of two channels, one texel for each pixel of the reference (ReferenceOptions::step)
std::vector<ClassifiedPixel> classified_pixels(const FloatImage& classified);

/// Error metrics of a picture's visibility V against the reference R over the n counted pixels (PixelState::Counted).
/// metrics() has a row that describes each number. A visibility below 0.5 is shadow. Fractions are relative to n, and 0
/// when n is 0. False shadow and false light are the sums of their parts. `flip` compares pictures over all pixels.
struct ErrorMetrics {
    std::size_t counted = 0;
    double false_shadow = 0, false_light = 0, acne = 0, leak = 0, light_bleeding = 0, bias_false_light = 0,
           lost_false_light = 0, offset_false_shadow = 0, contact_false_shadow = 0, boundary_false_shadow = 0,
           boundary_false_light = 0, outside_false_shadow = 0, outside_false_light = 0, any_acne = 0, visible_acne = 0,
           any_leak = 0, within_noise = 0, mae = 0, rmse = 0, signed_mean = 0, iou = 1, boundary_px_mean = 0,
           boundary_px_p95 = 0, boundary_px_max = 0, outside_map = 0, flip = std::numeric_limits<double>::quiet_NaN();
    std::array<std::size_t, kPixelStates> pixels{};   ///< per PixelState
    std::size_t ground_pixels = 0;                    ///< counted pixels on the ground disc under a model
    std::array<std::size_t, kArtefacts> artefacts{};  ///< wrong pixels per cause; None: all other pixels
    std::size_t without_cause = 0;                    ///< wrong pixels whose causes were not looked for
};

/// Direction in which the value of an error metric improves.
enum class Better {
    Less,
    NearZero,  ///< for signed metrics
    More,      ///< larger is better, 1 is best
    Neither,   ///< neither direction is better
};

/// Returns the distance of an error metric's value from the ideal value, which is 0, or 1 for Better::More. Less is
/// better. NaN for Better::Neither.
double distance_from_best(Better better, double value);

inline constexpr std::string_view kShareOfPixels = "share of pixels", kOfVisibility = "of visibility";
/// Error metric: its key, unit, formula and value. JSON, tables, plots, searches and the documentation are generated
/// from the table metrics().
struct Metric {
    std::string_view key;  ///< path of its field within `error` in JSON, such as "artefacts.filter"
    std::string_view label;
    std::string_view unit = kShareOfPixels;  ///< kShareOfPixels, kOfVisibility, "px" or none
    std::string_view help;                   ///< a sentence
    std::string_view formula;                ///< V: visibility by the map, R: by the reference, n: counted pixels
    std::string_view paper = {};
    double ErrorMetrics::*member = nullptr;  ///< field with the value; null: value() counts pixels by `causes`
    Better better = Better::Less;
    std::string_view part_of = {};  ///< key of the metric of which this is a summand
    std::string_view part = {};     ///< label below the metric `part_of`
    /// Kind of wrong pixels that a metric counts, as a fraction of all counted pixels: false shadow (Dark), false light
    /// (Bright), or both (Wrong). Only pixels with a cause in `causes` count. Otherwise: the metric is computed in
    /// another way.
    enum class Counts { Otherwise, Dark, Bright, Wrong };
    Counts counts = Counts::Otherwise;
    std::uint32_t causes = 0;  ///< bits 1 << Artefact; Artefact::None: wrong pixels without a cause; see kAllCauses
    bool rare = false;         ///< panels and printed tables omit the metric while it is 0
    bool cpu_only = false;     ///< needs rays or contours, which the GPU's sums cannot provide: NaN in LiveError
    bool of_pictures = false;  ///< compares pictures, see MeasuredError::pictures: NaN where none were drawn

    /// Returns the value of this error metric in a measurement.
    double value(const ErrorMetrics& m) const;
};

/// Metric::causes of metrics that count wrong pixels of any cause, or of none.
inline constexpr std::uint32_t kAllCauses = (1u << kArtefacts) - 1;

/// Returns the table of error metrics; the first is the default of searches and plots.
std::span<const Metric> metrics();
/// Returns the error metric with this key; null: there is none.
const Metric* find_metric(std::string_view key);

/// Sums over the counted pixels of a picture, from which metrics_of() computes error metrics. The GPU computes the sums
/// by tile (shaders/passes/error_tiles.frag.glsl).
struct PixelSums {
    std::array<double, kArtefacts> dark{}, bright{};  ///< false shadow, false light by cause; None: no cause
    double outside = 0, any_acne = 0, visible_acne = 0, any_leak = 0, within_noise = 0;
    double absolute = 0, squares = 0, sum = 0;  ///< sums of |V - R|, its square, V - R
    double both = 0, either = 0;                ///< pixels in shadow by V and R, and by at least one of them
};

/// Computes the error metrics of a picture from sums over its pixels. boundary_px_* are NaN, as sums do not give them.
/// @param reference reference with which the pixels were compared
ErrorMetrics metrics_of(const PixelSums& sums, const Reference& reference);

/// Computes error metrics from classified pixels and their reference.
/// @param classified the class of each pixel of the reference
/// @param receivers surface points of the reference's pixels: a change between lit and dark is a shadow edge only
/// between neighbours that show the same surface. Null: all neighbours count as one surface.
/// @throws Error when sizes differ
ErrorMetrics error_metrics(const std::vector<ClassifiedPixel>& classified, const Reference& reference,
                           const Receivers* receivers = nullptr);

}  // namespace si
