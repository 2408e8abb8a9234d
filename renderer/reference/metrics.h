// How far a picture of visibility is from the truth, in numbers. Pure CPU; what the GPU sums up is held against it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/reference/causes.h"
#include "renderer/reference/truth.h"
#include "shaders/shared/classified.h"

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
std::uint32_t compared_bits(float visibility, const TruePixel& reference, bool outside);

/// A pixel of the truth as causes take it.
TruePixel true_pixel(const Reference& reference, std::size_t i);

/// From what is read back of FrameResult::judged, at the truth's pixels. @param judged two channels, of the truth's
/// size
std::vector<JudgedPixel> classified_pixels(const FloatImage& classified);

/// Whether each pixel and its right (bit 0) or lower (bit 1) neighbour show one surface, so that a contour between them
/// is a shadow's.
std::vector<std::uint8_t> joins_of(const Receivers& receivers);

/// Visibility V against the truth R over the pixels that count (PixelState::Counted), n in number. Shadow is below one
/// half. Fractions are of n, and 0 when n is 0. What each number is, metrics() says: it has a row for each of these.
/// False shadow and false light are the sums of their parts.
struct ErrorMetrics {
    std::size_t counted = 0;
    double false_shadow = 0, false_light = 0, acne = 0, leak = 0, bias_false_light = 0, lost_false_light = 0,
           offset_false_shadow = 0, contact_false_shadow = 0, boundary_false_shadow = 0, boundary_false_light = 0,
           outside_false_shadow = 0, outside_false_light = 0, any_acne = 0, within_noise = 0, mae = 0, rmse = 0,
           signed_mean = 0, iou = 1, boundary_px_mean = 0, boundary_px_p95 = 0, boundary_px_max = 0, outside_map = 0;
    std::array<std::size_t, kPixelStates> pixels{};   ///< per PixelState: what was counted, and what not and why
    std::size_t ground_pixels = 0;                    ///< of the counted: on the ground under a model
    std::array<std::size_t, kArtefacts> artefacts{};  ///< wrong pixels per cause; None: all others
};

/// What is better of two values of a metric.
enum class Better {
    Less,
    NearZero,  ///< of signed ones
    More,      ///< at most 1
    Neither,   ///< a fact, no quality
};

/// How far a value is from the best, where less is better; NaN with Better::Neither.
double shortfall(Better better, double value);

/// A number that says how wrong a picture's shadows are. A row is all that JSON, tables, plots, searches and the page
/// of metrics know of it.
struct Metric {
    std::string_view key;  ///< field of `error` in JSON, its objects' fields after a dot
    std::string_view label;
    std::string_view unit;     ///< kShareOfPixels, kOfVisibility, "px" or none
    std::string_view help;     ///< a sentence
    std::string_view formula;  ///< V: visibility by the map, R: by the truth, n: pixels that count
    std::string_view paper = {};
    double ErrorMetrics::*member = nullptr;  ///< none: counts wrong pixels by `causes`
    Better better = Better::Less;
    std::string_view part_of = {};  ///< key of the sum that it is a part of
    std::string_view part = {};     ///< what it is called below that sum
    /// Which wrong pixels by `causes` it is the share of.
    enum class Counts { Otherwise, Dark, Bright, Wrong };
    Counts counts = Counts::Otherwise;
    std::uint32_t causes = 0;  ///< of those: bits 1 << Artefact; with Artefact::None wrong ones without a cause, too
    bool rare = false;         ///< for people only where it is not 0
    bool contours = false;     ///< between contours, which a frame's own sums cannot tell: NaN in LiveError

    double value(const ErrorMetrics& m) const;
};
inline constexpr std::string_view kShareOfPixels = "share of pixels", kOfVisibility = "of visibility";

/// All metrics; the first is what searches and plots begin with.
std::span<const Metric> metrics();
const Metric* find_metric(std::string_view key);

/// What is counted and summed over the pixels that count; the frame has it of tiles
/// (shaders/passes/error_tiles.frag.glsl).
struct PixelSums {
    std::array<double, kArtefacts> dark{}, bright{};  ///< false shadow and false light by cause; None: without one
    double outside = 0, any_acne = 0, within_noise = 0;
    double absolute = 0, squares = 0, sum = 0;  ///< of |V - R|, its square, V - R
    double both = 0, either = 0;                ///< in shadow by V and R, by one of them
};

/// All but boundary_px_*, which are NaN.
ErrorMetrics metrics_of(const PixelSums& sums, const Reference& reference);

/// @param judged one per pixel of the truth @param joins joins_of(), or empty: all are joined
/// @throws Error when sizes differ
ErrorMetrics error_metrics(const std::vector<JudgedPixel>& classified, const Reference& reference,
                           const std::vector<std::uint8_t>& joins = {});

}  // namespace si
