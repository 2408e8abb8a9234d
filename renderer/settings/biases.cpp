// Rows of the table of biases, and their closed forms.
#include "renderer/settings/biases.h"

#include <algorithm>

namespace si {
namespace {

/// Converts an amount in bias.unit to depth-buffer units.
double unit_depth(const BiasSettings& bias, const BiasInput& b, double amount) {
    if (bias.unit == BiasUnit::Depth) return amount;
    return b.curve.depth_change_towards_light(b.z, bias.unit == BiasUnit::Texels ? amount * b.texel_m : amount);
}

double constant_bias(const BiasSettings& bias, const BiasInput& b) {
    return unit_depth(bias, b, bias.constant);
}

double slope_bias(const BiasSettings& bias, const BiasInput& b) {
    return unit_depth(bias, b, slope_amount(bias, b.n_dot_l));
}

double receiver_plane_bias(const BiasSettings& bias, const BiasInput& b) {
    return unit_depth(bias, b, bias.constant) + b.least_per_texel;
}

double receiver_plane_by_derivatives_bias(const BiasSettings& bias, const BiasInput& b) {
    const double error = b.in_map ? std::abs(b.per_texel.x) + std::abs(b.per_texel.y) : 0;
    return receiver_plane_bias(bias, b) + error;
}

double bend_remainder(const BiasInput& b) {
    constexpr double kSlopeShare = 0.125;
    if (!b.in_map) return 0;
    return b.curve.depth_change_towards_light(b.z, b.texel_m) +
           kSlopeShare * (std::abs(b.per_texel.x) + std::abs(b.per_texel.y));
}

double receiver_plane_remainder_bias(const BiasSettings& bias, const BiasInput& b) {
    return receiver_plane_bias(bias, b) + 0.5 * bend_remainder(b);
}

double adaptive_bias(const BiasSettings&, const BiasInput& b) {
    return b.least_common;
}

/// Returns the normal offset before bias.normal_by, metres.
double whole_offset(const BiasSettings& bias, double texel_m) {
    return bias.normal_unit == OffsetUnit::Texels ? bias.normal * texel_m : bias.normal;
}

double offset_length(const BiasSettings& bias, const BiasInput& b) {
    const double whole = whole_offset(bias, b.texel_m);
    switch (bias.normal_by) {
        case OffsetBy::Length:
            break;
        case OffsetBy::Sine:
        case OffsetBy::Sideways:
            return whole * std::sqrt(std::max(1 - b.n_dot_l * b.n_dot_l, 0.0));
        case OffsetBy::OneMinusCosine:
            return whole * (1 - std::clamp(b.n_dot_l, 0.0, 1.0));
    }
    return whole;
}

double raster_offset(const BiasSettings& bias, const BiasInput& b) {
    const double by_slope = bias.raster_slope != 0 ? bias.raster_slope * b.polygon.slope(b.per_texel)
                                                   : 0;  // infinite for a plane edge-on to the light
    const double offset = by_slope + bias.raster_units * b.polygon.unit(b.quantum);
    return bias.raster_clamp > 0 ? std::min(offset, bias.raster_clamp) : offset;
}

constexpr std::string_view kConstantSettings[] = {"bias.constant", "bias.unit"};
constexpr std::string_view kSlopeSettings[] = {"bias.constant", "bias.unit", "bias.slope"};
constexpr std::string_view kPlaneSettings[] = {"bias.constant", "bias.unit", "bias.plane_clamp"};
constexpr std::string_view kNormalSettings[] = {"bias.normal", "bias.normal_unit", "bias.normal_by"};
constexpr std::string_view kRasterSettings[] = {"bias.raster_slope", "bias.raster_units", "bias.raster_clamp"};

// A normal offset of three texels prevents acne on a plane at any angle under the default kernel:
// h >= kappa*sqrt(2)*sin(theta) with kappa = 2 (bias/theory.h). The constant covers quantisation.
constexpr StartingValue kStartsOfNumbers[] = {
    {"bias.unit", "texels"}, {"bias.constant", "0.1"}, {"bias.normal", "3"}, {"bias.normal_unit", "texels"}};
// Rows that compute the needed bias themselves need no number beside it.
constexpr StartingValue kStartsOfNeededBias[] = {{"bias.constant", "0"}, {"bias.normal", "0"}};

constexpr Bias kBiases[] = {
    {.key = "slope",
     .label = "Slope over constant",
     .help = "The lectures' bias: max(slope bias * (1 - N·L), constant bias), with N·L the cosine between surface "
             "normal and light. The compared depth is the same for all texels of the kernel.",
     .file = "biases/slope.glsl",
     .settings = kSlopeSettings,
     .starts = kStartsOfNumbers,
     .amount = slope_bias},
    {.key = "constant",
     .label = "Constant",
     .help = "bias.constant alone, at any angle of the light.",
     .paper = "Williams: Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978",
     .file = "biases/constant.glsl",
     .settings = kConstantSettings,
     .starts = kStartsOfNumbers,
     .amount = constant_bias},
    {.key = "receiver-plane",
     .label = "Receiver plane",
     .help = "Every texel is compared with the depth that the receiver's own plane has at the texel's centre, from the "
             "triangle's normal and without screen derivatives: no acne on planes at any angle and under any kernel, "
             "with only as much bias as rounding needs. bias.constant is added. Where a kernel reaches over an inner "
             "edge, the plane continues behind the surface there, which turns dark.",
     .paper = "Isidoro: Shadow Mapping: GPU-based Tips and Techniques, GDC 2006 (by screen derivatives)",
     .file = "biases/receiver_plane.glsl",
     .settings = kPlaneSettings,
     .starts = kStartsOfNeededBias,
     .per_texel = true,
     .gives_needed_bias = true,
     .amount = receiver_plane_bias},
    {.key = "receiver-plane-derivatives",
     .label = "Receiver plane by derivatives",
     .help = "The receiver's plane as in engines: from the surface's steps between neighbouring pixels. Rounding in "
             "single precision tilts it, so a texel of its slope is added (engines call this the fractional sampling "
             "error). bias.plane_clamp limits it in grazing light.",
     .paper = "Isidoro: Shadow Mapping: GPU-based Tips and Techniques, GDC 2006",
     .file = "biases/receiver_plane_derivatives.glsl",
     .settings = kPlaneSettings,
     .starts = kStartsOfNeededBias,
     .per_texel = true,
     .gives_needed_bias = true,
     .by_derivatives = true,
     .amount = receiver_plane_by_derivatives_bias},
    {.key = "receiver-plane-remainder",
     .label = "Receiver plane and remainder",
     .help = "The receiver's plane at every texel, minus what a plane does not know: the next triangle may rise above "
             "it. The remainder is a texel's width along the light's axis, and an eighth of the plane's slope, for "
             "each texel of distance and for half a texel at the look-up. A plane that falls away from the light is "
             "not followed. Bent meshes and inner corners have little acne. Casters nearer to a surface than the "
             "remainder are lost. It costs a square root a texel.",
     .paper = "own formula; the plane: Isidoro, Shadow Mapping: GPU-based Tips and Techniques, GDC 2006",
     .file = "biases/receiver_plane_remainder.glsl",
     .settings = kPlaneSettings,
     .starts = kStartsOfNeededBias,
     .per_texel = true,
     .gives_needed_bias = true,
     .amount = receiver_plane_remainder_bias,
     .remainder = bend_remainder},
    {.key = "adaptive",
     .label = "Automatic (adaptive)",
     .help = "Exactly the bias that the pixel's plane needs under this kernel, format and resolution, in closed form: "
             "no acne on planes and no number to set. The overlay contact-gap and the probe show the price, a lit "
             "strip beside casters. Normal offset and polygon offset are still added and are not needed.",
     .paper = "Dou, Yan, Kerzner, Dai, Wyman: Adaptive Depth Bias for Shadow Maps, JCGT 3(4), 2014",
     .file = "biases/adaptive.glsl",
     .starts = kStartsOfNeededBias,
     .gives_needed_bias = true,
     .amount = adaptive_bias},
    {.key = "normal-offset",
     .label = "Normal offset",
     .help = "bias.normal: shifts the point of the look-up along its normal, by bias.normal_by. It is added to "
             "bias.kind.",
     .paper = "Holbert: Saying Goodbye to Shadow Acne, GDC 2011",
     .file = "biases/normal_offset.glsl",
     .stage = BiasStage::LookUp,
     .settings = kNormalSettings,
     .amount = offset_length},
    {.key = "raster",
     .label = "Polygon offset",
     .help = "bias.raster_*: stored depths recede while the map is drawn, by the slope of the triangle and by steps of "
             "the format. It is added to bias.kind.",
     .paper = "OpenGL 4.5 core, 14.6.5 Depth Offset",
     .file = "biases/raster.glsl",
     .stage = BiasStage::Raster,
     .settings = kRasterSettings,
     .amount = raster_offset},
};

/// Returns the rows of stage Compare, which bias.kind chooses from.
std::span<const Bias> kinds() {
    const auto end = std::ranges::find_if(kBiases, [](const Bias& b) { return b.stage != BiasStage::Compare; });
    return {std::begin(kBiases), end};
}

bool lists(const Bias& row, std::string_view key) {
    return std::ranges::find(row.settings, key) != row.settings.end();
}

}  // namespace

glm::dvec3 normal_offset(const BiasSettings& bias, const glm::dvec3& normal, const glm::dvec3& to_light,
                         double texel_m) {
    const double whole = whole_offset(bias, texel_m), along = glm::dot(normal, to_light);
    switch (bias.normal_by) {
        case OffsetBy::Length:
            break;
        case OffsetBy::Sine:
            return normal * (whole * glm::length(glm::cross(normal, to_light)));
        case OffsetBy::OneMinusCosine:
            return normal * (whole * (1 - std::clamp(along, 0.0, 1.0)));
        case OffsetBy::Sideways:
            return (normal - along * to_light) * whole;
    }
    return normal * whole;
}

double slope_amount(const BiasSettings& bias, double n_dot_l) {
    return std::max(bias.slope * (1 - std::clamp(n_dot_l, 0.0, 1.0)), bias.constant);
}

int default_bias() {
    static const int row = int(std::ranges::find(kBiases, "adaptive", &Bias::key) - std::begin(kBiases));
    return row;
}

std::span<const Bias> biases() {
    return kBiases;
}

std::span<const Choice> bias_choices() {
    return choices_of<kinds>();
}

const Bias& bias_of(const Settings& settings) {
    return kinds()[std::size_t(std::clamp(settings.bias.kind, 0, int(kinds().size()) - 1))];
}

const Bias& bias_of_stage(BiasStage stage) {
    return *std::ranges::find(kBiases, stage, &Bias::stage);
}

bool reads_setting(const Bias& row, std::string_view key) {
    return lists(row, key) || std::ranges::none_of(kBiases, [&](const Bias& b) { return lists(b, key); });
}

}  // namespace si
