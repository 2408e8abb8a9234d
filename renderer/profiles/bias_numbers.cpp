#include "renderer/profiles/bias_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/base/error.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"

namespace si {
namespace {

double radians_of(double degrees) {
    return degrees * std::numbers::pi / 180;
}

/// Converts an amount in bias.unit to texels.
double amount_texels(BiasUnit unit, double amount, const MapFacts& facts) {
    switch (unit) {
        case BiasUnit::Depth:
            return amount * facts.depth_m / facts.texel_m();
        case BiasUnit::Metres:
            return amount / facts.texel_m();
        case BiasUnit::Texels:
            break;
    }
    return amount;
}

}  // namespace

double tan_angle(const MapFacts& facts) {
    return std::tan(radians_of(facts.angle_deg));
}

double sin_angle(const MapFacts& facts) {
    return std::sin(radians_of(facts.angle_deg));
}

double cos_angle(const MapFacts& facts) {
    return std::cos(radians_of(facts.angle_deg));
}

double raster_equivalent(double slope, double units, const MapFacts& facts) {
    return slope * tan_angle(facts) + units * raster_unit_depth(facts.format) * facts.depth_m / facts.texel_m();
}

double quotient(double a, double b) {
    constexpr double kRounding = 1e-9;
    return std::abs(b) > kRounding ? a / b : 0;
}

Exactness least_exact(Exactness a, Exactness b) {
    return std::max(a, b);
}

double offset_equivalent(OffsetBy by, double angle_deg) {
    const double sine = std::sin(radians_of(angle_deg)), cosine = std::cos(radians_of(angle_deg));
    switch (by) {
        case OffsetBy::Sine:
            return sine / cosine;
        case OffsetBy::OneMinusCosine:
            return (1 - cosine) / cosine;
        case OffsetBy::Sideways:
            return sine * sine / cosine;
        case OffsetBy::Length:
            break;
    }
    return 1 / cosine;
}

double raster_unit_depth(MapFormat format) {
    constexpr int kBits16 = 16, kBits24 = 24;
    return std::ldexp(1.0, format == MapFormat::D16 ? -kBits16 : -kBits24);
}

double BiasNumbers::receiver_texels(const MapFacts& facts) const {
    return constant_texels + normal_texels * offset_equivalent(normal_by, facts.angle_deg);
}

double BiasNumbers::raster_texels(const MapFacts& facts) const {
    const double units_texels = raster_units * raster_unit_depth(format) * facts.depth_m / facts.texel_m();
    const double offset = raster_slope * tan_angle(facts) + units_texels;
    return raster_clamp > 0 ? std::min(offset, raster_clamp * facts.depth_m / facts.texel_m()) : offset;
}

double BiasNumbers::total_texels(const MapFacts& facts) const {
    return receiver_texels(facts) + raster_texels(facts);
}

BiasNumbers bias_numbers(const Settings& settings, const MapFacts& facts) {
    const BiasSettings& bias = settings.bias;
    const Bias& row = bias_of(settings);
    BiasNumbers out;
    if (reads_setting(row, "bias.constant")) out.constant_texels = amount_texels(bias.unit, bias.constant, facts);
    if (reads_setting(row, "bias.slope") && bias.slope > 0) {
        const double at_angle = amount_texels(bias.unit, bias.slope * (1 - cos_angle(facts)), facts);
        out.constant_texels = std::max(out.constant_texels, at_angle);
        out.constant = Exactness::EqualAtAngle;
        out.constant_note = "bias.slope grows with the angle; the number is a constant";
    }
    if (row.gives_needed_bias) {
        const double reach = reach_of(settings, 0).bias;
        out.constant_texels += reach * tan_angle(facts);
        out.constant = Exactness::EqualAtAngle;
        out.constant_note = fmt::format(
            "bias.kind {} has no counterpart: the bias that it gives the kernel ({:g} texels "
            "times the tangent of the angle) is taken as a constant",
            row.key, reach);
    }
    const double offset_texels = bias.normal_texels() + bias.normal_metres() / facts.texel_m();
    const double length = offset_equivalent(OffsetBy::Length, facts.angle_deg);
    out.normal_texels = offset_texels * offset_equivalent(bias.normal_by, facts.angle_deg) / length;
    out.settings_by = bias.normal_by;
    out.settings_normal_texels = offset_texels;
    out.raster_slope = bias.raster_slope;
    out.raster_units = bias.raster_units;
    out.raster_clamp = bias.raster_clamp;
    out.format = settings.map.format;
    out.reversed_z = settings.map.reversed_z;
    if (!std::isfinite(out.total_texels(facts)))
        throw Error("bias.*: the bias is not a finite number at the reference angle; choose a smaller angle");
    return out;
}

void EngineOutput::put(std::string_view key, double value, Exactness exactness, double texels, double literal,
                       std::string note) {
    const EngineParameter& parameter = engine_parameter(profile_, key);
    const double accepted = std::clamp(value, parameter.min, parameter.max);
    if (accepted != value) {
        const std::string text =
            fmt::format("{:.6g} is outside of the engine's range, {:g} to {:g}", value, parameter.min, parameter.max);
        note += (note.empty() ? "" : "; ") + text;
        texels = value != 0 ? texels * accepted / value : 0;
        exactness = Exactness::EqualAtAngle;
    }
    to_.parameters.push_back(
        {&parameter, accepted, exactness, std::move(note), literal, texels * facts_.texel_m(), texels});
}

void EngineOutput::put_length_offset(std::string_view key, double value, const BiasNumbers& bias) {
    put(key, value, Exactness::Exact, bias.normal_texels * offset_equivalent(OffsetBy::Length, facts_.angle_deg),
        value);
}

void EngineOutput::put_slope(std::string_view key, double factor, double wanted_texels, const BiasNumbers& bias) {
    const double texels_per_number = factor * tan_angle(facts_);
    const double slope = quotient(wanted_texels, texels_per_number);
    put(key, slope, Exactness::EqualAtAngle, slope * texels_per_number,
        quotient(bias.constant_texels, texels_per_number),
        std::string(slope == 0 && wanted_texels > 0 ? kNoBiasAtAngle : "a slope; a constant has no counterpart"));
}

void EngineOutput::miss(std::string_view key, double value, std::string reason) {
    if (value != 0) to_.missing.push_back({std::string(key), fmt::format("{:.6g}", value), std::move(reason)});
}

void EngineOutput::note(std::string text) {
    to_.notes.push_back(std::move(text));
}

}  // namespace si
