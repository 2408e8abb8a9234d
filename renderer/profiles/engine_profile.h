// Engine profiles: the shadow parameters of other engines, and their conversion into settings of this program and back.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/settings/settings.h"

namespace si {

/// Facts of a shadow map that conversions depend on. Lengths in metres. The defaults are those of the worked example.
struct MapFacts {
    double width_m = 20;       ///< W: width of the map of one cascade
    int texels = 2048;         ///< N: texels across the map of one cascade
    double depth_m = 40;       ///< D: distance from the near to the far plane of the map
    int cascades = 1;          ///< number of cascades of the light
    double angle_deg = 45;     ///< reference angle between the geometric normal and the direction to the light
    double view_m = 10;        ///< distance from the camera, for parameters that scale with it
    double view_fov_deg = 90;  ///< horizontal field of view of the camera, for the same
    MapFormat format = MapFormat::D32F;
    bool reversed_z = false;

    /// Returns the texel size, metres.
    double texel_m() const { return width_m / texels; }
};

/// Checks facts of a map. @throws Error naming the fact that is no finite number in its range
void require_sound(const MapFacts& facts);

/// Degree to which a converted number draws the same shadows.
enum class Exactness {
    Exact,         ///< at every angle of a flat surface
    EqualAtAngle,  ///< at MapFacts::angle_deg only
    Missing,       ///< the other side has no counterpart, and the number is left out
};
/// Keys of the degrees in JSON, by Exactness.
inline constexpr std::string_view kExactnessKeys[] = {"exact", "equal-at-angle", "missing"};

/// Choice of an engine's parameter with named values.
struct EngineChoice {
    std::string_view key;  ///< the engine's name: "PCFShadowMap"
    /// Our assignments, separated by spaces: "filter.kernel=vogel filter.taps=5". Behind "|" follow values for which
    /// the choice is the nearest.
    std::string_view settings;
};

/// Parameter of an engine, under the engine's own name and in its unit.
struct EngineParameter {
    std::string_view key;       ///< "normalBias"
    std::string_view unit;      ///< "m", "texels", "normalised depth"; empty: a plain number
    double standard = 0;        ///< the engine's default; for choices the index
    double min = 0, max = 1e6;  ///< range of values that the engine accepts
    std::string_view meaning;
    std::string_view source;   ///< where the engine's documentation or code says so
    std::string_view setting;  ///< setting that the parameter changes foremost; empty: none
    /// Factor from the engine's number to this program's setting, for parameters that are a setting in another unit. 0:
    /// EngineProfile::read_bias and write_bias convert.
    double scale = 0;
    std::span<const EngineChoice> choices = {};
    bool is_bias = false;  ///< number of the bias, which a search for the best bias varies
    /// Parameter of caster.cull: a given value holds for double-sided materials, too. Its default does not.
    bool holds_for_double_sided = false;
};

/// Setting of this program that a profile sets because the engine cannot turn it off.
struct ForcedSetting {
    std::string_view key, value;
    std::string_view reason;
};

/// Setting or choice of this program that the engine lacks.
struct LackingSetting {
    std::string_view key;    ///< setting
    std::string_view value;  ///< choice; empty: every value but 0 or the first choice
    std::string_view reason;
};

/// Numbers of an engine by parameter key; choices as indices. Parameters that are absent have their default.
using EngineValues = std::map<std::string, double, std::less<>>;

/// Setting of this program with the value that an engine's numbers are converted to.
struct ReadSetting {
    std::string key, value;  ///< as for set_setting()
    Exactness exactness = Exactness::Exact;
    std::string note;
};

/// Engine parameter with the number to which this program's settings were converted.
struct WrittenParameter {
    const EngineParameter* parameter = nullptr;
    double value = 0;  ///< in the engine's unit; for choices the index
    Exactness exactness = Exactness::Exact;
    std::string note;
    /// Number that carries over this part of the bias alone, without regard to hidden bias; else equal to `value`.
    double literal = 0;
    double metres = 0, texels = 0;  ///< equivalent depth bias at the reference angle; 0 for parameters of no bias
};

/// Setting of this program without counterpart in an engine.
struct MissingSetting {
    std::string key, value;
    std::string reason;
};

/// This program's settings as numbers of an engine.
struct WrittenValues {
    std::vector<WrittenParameter> parameters;
    std::vector<MissingSetting> missing;
    std::vector<std::string> notes;
    double wanted_texels = 0;  ///< equivalent depth bias of the settings at the reference angle
    double hidden_texels = 0;  ///< equivalent depth bias that the engine adds by itself
    double given_texels = 0;   ///< equivalent depth bias of the written numbers, hidden bias included

    /// Returns the converted parameter with this key (EngineParameter::key); null if the settings give it no number.
    const WrittenParameter* find(std::string_view key) const;
    /// Returns the written numbers as values for read_engine_values().
    EngineValues values() const;
};

struct BiasNumbers;  // bias_numbers.h
class EngineOutput;  // bias_numbers.h

/// Row of the table of engines. A new engine is one file and one row.
struct EngineProfile {
    std::string_view name, title;
    std::string_view version;  ///< version of the engine whose parameters these are
    std::string_view
        unverified;  ///< what is not verified about the conversions; empty: all is from the engine's source
    std::span<const EngineParameter> parameters = {};
    std::span<const ForcedSetting> forced = {};
    std::span<const LackingSetting> lacking = {};
    /// Keys of the rows of the bias table that the engine has; empty: all, in an own shader.
    std::span<const std::string_view> bias_rows = {};
    /// Dependence of the engine's normal offset on the angle.
    OffsetBy normal_by = OffsetBy::Length;
    /// The cascades of a light share its map: each has half the width if there are several.
    bool cascades_share_map = false;
    /// Constant bias that the engine adds at the look-up by itself, as a share of the depth range.
    double hidden_depth = 0;
    /// Returns the bias that the engine adds by itself, as equivalent depth bias in texels at the reference angle.
    double (*hidden_texels)(const EngineProfile&, const EngineValues&, const MapFacts&) = nullptr;
    /// Converts the engine's bias parameters into settings.
    BiasNumbers (*read_bias)(const EngineProfile&, const EngineValues&, const MapFacts&) = nullptr;
    /// Converts a bias into the engine's parameters. The values are those of the other parameters.
    void (*write_bias)(const BiasNumbers&, const EngineValues&, const MapFacts&, EngineOutput&) = nullptr;
};

/// Returns all engine profiles.
std::span<const EngineProfile> engine_profiles();
/// Returns the profile with a name. @throws UsageError with the nearest name and all names
const EngineProfile& engine_profile(std::string_view name);
/// Returns the parameter of a profile with a key; upper and lower case are equal. @throws UsageError with the nearest
/// key and all keys
const EngineParameter& engine_parameter(const EngineProfile& profile, std::string_view key);
/// Returns the value of a parameter: the given one, else its default. @throws Error for an unknown key
double engine_value(const EngineProfile& profile, const EngineValues& values, std::string_view key);
/// Parses a value of a parameter: a number in its range, true or false, or the name of a choice.
/// @throws UsageError with the allowed values
double parse_engine_value(const EngineProfile& profile, const EngineParameter& parameter, std::string_view text);
/// Formats a value of a parameter: the name of a choice, else the shortest number.
std::string engine_value_text(const EngineParameter& parameter, double value);

/// Converts engine values into this program's settings: the bias always, other parameters only where a value is given.
/// @throws Error for facts or values that are not finite or out of range
std::vector<ReadSetting> read_engine_values(const EngineProfile& profile, const EngineValues& values,
                                            const MapFacts& facts);
/// Converts this program's settings into parameters of the engine. Settings that a profile has forced count as asked
/// for. The bias is converted so that the equivalent depth bias at the reference angle is equal, hidden bias included,
/// and never below 0.
/// @param kept values of engine parameters that no setting gives, such as a project's console variables
/// @throws Error as read_engine_values()
WrittenValues write_engine_values(const EngineProfile& profile, const Settings& settings, const MapFacts& facts,
                                  const EngineValues& kept = {});

/// Sets in place all that the engine cannot turn off. @returns a line for each setting that had another value
std::vector<std::string> apply_forced_settings(const EngineProfile& profile, Settings& settings);
/// Returns the reason why the profile fixes the setting with a key, and at which value; null if it does not.
const ForcedSetting* forced_setting(const EngineProfile& profile, std::string_view key);
/// Returns true when an engine has the bias with a key of the bias table.
bool has_bias_row(const EngineProfile& profile, std::string_view key);
/// Returns a bias with at least what the engine adds by itself.
BiasSettings with_hidden_bias(const EngineProfile& profile, const BiasSettings& bias, const MapFacts& facts);
/// Returns the reason why an engine cannot draw a change of settings: a setting that it fixes or lacks, or a kernel
/// without a counterpart. Empty: it can.
std::string reason_engine_lacks(const EngineProfile& profile, const Settings& before, const Settings& with);
/// Returns the row of LackingSetting for the present value of a setting; null if the engine has that value.
const LackingSetting* lacking_setting(const EngineProfile& profile, const Settings& settings, std::string_view key);

}  // namespace si
