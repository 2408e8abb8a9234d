// Bias in the terms that all engines share: constant, normal offset and polygon offset, in texels. Inside of profiles/
// only.
#pragma once

#include <string>
#include <string_view>

#include "renderer/profiles/engine_profile.h"

namespace si {

/// Returns the equivalent depth bias of a normal offset of one texel at an angle, in texels.
double offset_equivalent(OffsetBy by, double angle_deg);

/// Bias in terms that all engines share.
struct BiasNumbers {
    double constant_texels = 0;             ///< along the light's axis
    Exactness constant = Exactness::Exact;  ///< EqualAtAngle: the constant stands for a bias that grows with the angle
    std::string constant_note;
    BiasUnit constant_unit = BiasUnit::Texels;  ///< unit that the engine counts in, which holds for every cascade
    double normal_texels = 0;
    OffsetBy normal_by = OffsetBy::Length;    ///< rule by which normal_texels counts
    OffsetBy settings_by = OffsetBy::Length;  ///< rule of the settings, from which normal_texels may be converted
    double settings_normal_texels = 0;        ///< normal offset of the settings, which counts by settings_by
    std::string normal_note;
    double raster_slope = 0, raster_units = 0, raster_clamp = 0;
    MapFormat format = MapFormat::D32F;
    bool reversed_z = false;

    /// Returns the equivalent depth bias of the constant and the normal offset, in texels.
    double receiver_texels(const MapFacts& facts) const;
    /// Returns the equivalent depth bias of the polygon offset, in texels.
    double raster_texels(const MapFacts& facts) const;
    /// Returns the equivalent depth bias of all terms, in texels.
    double total_texels(const MapFacts& facts) const;
};

/// Returns the bias of settings. A bias that is computed from the receiver's plane counts with the kernel's reach times
/// the tangent of the reference angle. A normal offset by another rule than Length counts as the one by Length that is
/// equal at the reference angle. @throws Error when an amount is not finite
BiasNumbers bias_numbers(const Settings& settings, const MapFacts& facts);

/// Returns the tangent, sine and cosine of the reference angle.
double tan_angle(const MapFacts& facts);
double sin_angle(const MapFacts& facts);
double cos_angle(const MapFacts& facts);

/// Returns the equivalent depth bias of a polygon offset at the reference angle, in texels.
double raster_equivalent(double slope, double units, const MapFacts& facts);

/// Returns a / b, or 0 where b is no more than rounding.
double quotient(double a, double b);

/// Returns the lower of two exactnesses.
Exactness least_exact(Exactness a, Exactness b);

/// Returns the unit of a polygon offset in depth [0,1], by the format: 2^-16, or 2^-24 for D24 and for floats from a
/// half to 1.
double raster_unit_depth(MapFormat format);

/// Receiver of converted numbers.
class EngineOutput {
public:
    /// Receives numbers of a profile's parameters.
    EngineOutput(const EngineProfile& profile, WrittenValues& to, const MapFacts& facts)
        : profile_(profile), to_(to), facts_(facts) {}
    /// Adds a number of the bias, clamped to the range that the engine accepts, with a note when that changes it.
    /// @param texels equivalent depth bias of the number @param literal see WrittenParameter::literal
    void put(std::string_view key, double value, Exactness exactness, double texels, double literal,
             std::string note = {});
    /// Adds a normal offset that acts with its whole length, as normal_texels counts. @param value in the engine's unit
    void put_length_offset(std::string_view key, double value, const BiasNumbers& bias);
    /// Adds a setting without counterpart.
    void miss(std::string_view key, double value, std::string reason);
    /// Adds a remark.
    void note(std::string text);

private:
    const EngineProfile& profile_;
    WrittenValues& to_;
    const MapFacts& facts_;
};

// Rows of the bias table that engines have.
inline constexpr std::string_view kConstantAndNormal[] = {"constant", "normal-offset"};
inline constexpr std::string_view kRasterAndNormal[] = {"raster", "normal-offset"};

// Rows of the table of engines and graphics APIs: parameters of their shadows, and conversion to and from settings. One
// function a file.
const EngineProfile& three_profile();
const EngineProfile& babylon_profile();
const EngineProfile& playcanvas_profile();
const EngineProfile& godot_profile();
const EngineProfile& urp_profile();
const EngineProfile& urp_slope_profile();
const EngineProfile& hdrp_profile();
const EngineProfile& unreal_profile();
const EngineProfile& filament_profile();
const EngineProfile& bevy_profile();
const EngineProfile& o3de_profile();
const EngineProfile& opengl_profile();
const EngineProfile& vulkan_profile();
const EngineProfile& d3d12_profile();
const EngineProfile& webgpu_profile();
const EngineProfile& godot3_profile();
const EngineProfile& ogre_profile();
const EngineProfile& filament19_profile();

}  // namespace si
