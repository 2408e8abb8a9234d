// Bias in the terms that all engines share: constant, normal offset and polygon offset, in texels. For profiles/, and
// for the head of converted code.
#pragma once

#include <string>
#include <string_view>

#include "renderer/profiles/engine_profile.h"

namespace si {

/// Returns the depth bias in texels that prevents as much acne as a normal offset of one texel, on a surface at an
/// angle to the light.
/// @param by dependence of the offset on the angle
/// @param angle_deg angle between surface normal and light
double offset_equivalent(OffsetBy by, double angle_deg);

/// Bias in terms that all engines share: constant, normal offset and polygon offset, in texels.
struct BiasNumbers {
    double constant_texels = 0;             ///< along the light's axis
    Exactness constant = Exactness::Exact;  ///< EqualAtAngle: the constant stands for a bias that grows with the angle
    std::string constant_note;
    BiasUnit constant_unit = BiasUnit::Texels;  ///< unit in which the engine's constant is equal for all cascades
    double normal_texels = 0;
    OffsetBy normal_by = OffsetBy::Length;    ///< dependence of normal_texels on the angle
    OffsetBy settings_by = OffsetBy::Length;  ///< bias.normal_by of the settings, for settings_normal_texels
    double settings_normal_texels = 0;        ///< normal offset of the settings, before conversion to normal_by
    std::string normal_note;
    double raster_slope = 0, raster_units = 0, raster_clamp = 0;
    MapFormat format = MapFormat::D32F;
    bool reversed_z = false;

    /// Returns the equivalent depth bias of the constant and the normal offset together, in texels: the depth bias that
    /// acts against acne as much as they do.
    double receiver_texels(const MapFacts& facts) const;
    /// Returns the equivalent depth bias of the polygon offset in texels: the depth bias that acts against acne as much
    /// as the offset does.
    double raster_texels(const MapFacts& facts) const;
    /// Returns the equivalent depth bias of constant, normal offset and polygon offset together, in texels: the depth
    /// bias that acts against acne as much as they do.
    double total_texels(const MapFacts& facts) const;
};

/// Converts this program's bias settings to terms that all engines share: constant, normal offset and polygon offset. A
/// slope bias, or a bias computed from the receiver's plane, becomes a constant: its amount at the reference angle
/// between surface normal and light (MapFacts::angle_deg). A normal offset whose length depends on the light's angle
/// becomes one of constant length, equal at the reference angle.
/// @throws Error when the bias is not finite at the reference angle
BiasNumbers bias_numbers(const Settings& settings, const MapFacts& facts);

/// Returns the tangent of the reference angle (MapFacts::angle_deg). At this angle between surface normal and light, a
/// converted bias prevents as much acne as the original.
double tan_angle(const MapFacts& facts);
/// Returns the sine of the reference angle (MapFacts::angle_deg). At this angle between surface normal and light, a
/// converted bias prevents as much acne as the original.
double sin_angle(const MapFacts& facts);
/// Returns the cosine of the reference angle (MapFacts::angle_deg). At this angle between surface normal and light, a
/// converted bias prevents as much acne as the original.
double cos_angle(const MapFacts& facts);

/// Returns the depth bias in texels that equals a polygon offset on a surface at the reference angle to the light
/// (MapFacts::angle_deg).
/// @param slope factor of the polygon offset
/// @param units units of the polygon offset
double raster_equivalent(double slope, double units, const MapFacts& facts);

/// Returns a / b, or 0 where b is so small that it is a rounding error of zero.
double quotient(double a, double b);

/// Remark on a number of the engine that gives no bias at the reference angle: a slope at 0 degrees.
inline constexpr std::string_view kNoBiasAtAngle =
    "without effect at this reference angle, so that no number gives the bias; choose a larger angle";

/// Returns the less exact of two degrees of exactness.
Exactness least_exact(Exactness a, Exactness b);

/// Returns the size of one unit of polygon offset in depth [0,1], by the map's format: 2^-16 for D16, else 2^-24. For
/// float formats this is the depth step from 0.5 to 1.
double raster_unit_depth(MapFormat format);

/// Collector of engine parameter values to which this program's bias is converted.
class EngineOutput {
public:
    /// Creates a collector that adds values of an engine's parameters (those in `profile`) to `to`.
    EngineOutput(const EngineProfile& profile, WrittenValues& to, const MapFacts& facts)
        : profile_(profile), to_(to), facts_(facts) {}
    /// Adds the value of an engine parameter to the result (WrittenValues), clamped to the range that the engine
    /// accepts. Adds a note when clamping changes the value.
    /// @param texels equivalent depth bias of the value
    /// @param literal number that converts this part of the bias alone (ConvertedParameter::literal)
    void put(std::string_view key, double value, Exactness exactness, double texels, double literal,
             std::string note = {});
    /// Adds the value of an engine's normal offset parameter to the result (WrittenValues). Such an offset moves the
    /// look-up by its whole length at any angle between normal and light.
    /// @param key EngineParameter::key
    /// @param value length in the engine's unit
    /// @param bias bias that is converted
    void put_length_offset(std::string_view key, double value, const BiasNumbers& bias);
    /// Adds the value of an engine's slope parameter, the only counterpart of a bias, to the result (WrittenValues).
    /// The value gives the wanted bias at the reference angle (MapFacts::angle_deg).
    /// @param key EngineParameter::key
    /// @param factor polygon offset factor per unit of the value
    /// @param wanted_texels equivalent depth bias that the value should give
    /// @param bias bias that is converted
    void put_slope(std::string_view key, double factor, double wanted_texels, const BiasNumbers& bias);
    /// Records in the result (WrittenValues) that a setting has no counterpart in the engine. Ignores a value of 0,
    /// which needs no counterpart.
    void miss(std::string_view key, double value, std::string reason);
    /// Adds a remark on the conversion to an engine's parameters to the result (WrittenValues), for display.
    void note(std::string text);

private:
    const EngineProfile& profile_;
    WrittenValues& to_;
    const MapFacts& facts_;
};

// Keys of rows of the bias table, for EngineProfile::bias_rows.
inline constexpr std::string_view kConstantAndNormal[] = {"constant", "normal-offset"};
inline constexpr std::string_view kRasterAndNormal[] = {"raster", "normal-offset"};

// Rows of the table of engines and graphics APIs: parameters of their shadows, and conversion to and from settings. One
// function a file.
/// Returns the profile that converts between shadow parameters of three.js and settings of this program.
const EngineProfile& three_profile();
/// Returns the profile that converts between shadow parameters of Babylon.js and settings of this program.
const EngineProfile& babylon_profile();
/// Returns the profile that converts between shadow parameters of PlayCanvas and settings of this program.
const EngineProfile& playcanvas_profile();
/// Returns the profile that converts between shadow parameters of Godot 4 and settings of this program.
const EngineProfile& godot_profile();
/// Returns the profile that converts between shadow parameters of Unity URP with its legacy depth bias and settings of
/// this program.
const EngineProfile& urp_profile();
/// Returns the profile that converts between shadow parameters of Unity URP with its slope-scale depth bias and
/// settings of this program.
const EngineProfile& urp_slope_profile();
/// Returns the profile that converts between shadow parameters of Unity HDRP and settings of this program.
const EngineProfile& hdrp_profile();
/// Returns the profile that converts between shadow parameters of Unreal Engine 5 with cascaded shadow maps and
/// settings of this program.
const EngineProfile& unreal_profile();
/// Returns the profile that converts between shadow parameters of Filament and settings of this program.
const EngineProfile& filament_profile();
/// Returns the profile that converts between shadow parameters of Bevy and settings of this program.
const EngineProfile& bevy_profile();
/// Returns the profile that converts between shadow parameters of O3DE and settings of this program.
const EngineProfile& o3de_profile();
/// Returns the profile that converts between shadow parameters of OpenGL and settings of this program.
const EngineProfile& opengl_profile();
/// Returns the profile that converts between shadow parameters of Vulkan and settings of this program.
const EngineProfile& vulkan_profile();
/// Returns the profile that converts between shadow parameters of Direct3D 12 and settings of this program.
const EngineProfile& d3d12_profile();
/// Returns the profile that converts between shadow parameters of WebGPU and settings of this program.
const EngineProfile& webgpu_profile();
/// Returns the profile that converts between shadow parameters of Godot 3 and settings of this program.
const EngineProfile& godot3_profile();
/// Returns the profile that converts between shadow parameters of OGRE 1.12 and settings of this program.
const EngineProfile& ogre_profile();
/// Returns the profile that converts between shadow parameters of Filament 1.9 and settings of this program.
const EngineProfile& filament19_profile();

}  // namespace si
