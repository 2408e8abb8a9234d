// Engine profiles: the shadow parameters of other engines, and their conversion into settings of this program and back.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/settings/settings.h"

namespace si {

/// Width of the smallest map whose texels the engines' formulas can count, texels.
inline constexpr int kMinMapTexels = 3;

/// Facts of a shadow map on which conversions between settings and engine parameters depend. Lengths are in metres. The
/// defaults are those of the documentation's example.
struct MapFacts {
    double width_m = 20;       ///< W: width of the map of one cascade
    int texels = 2048;         ///< N: texels across the map of one cascade
    double depth_m = 40;       ///< D: distance from the near to the far plane of the map
    int cascades = 1;          ///< number of cascades of the light
    double angle_deg = 45;     ///< reference angle between the geometric normal and the direction to the light
    double view_m = 10;        ///< distance from the camera, for parameters that scale with it
    double view_fov_deg = 90;  ///< horizontal field of view of the camera, for such parameters
    MapFormat format = MapFormat::D32F;
    bool reversed_z = false;
    int light = 0;  ///< light of the map, whose settings light.* are converted

    /// Returns the texel size, metres.
    double texel_m() const { return width_m / texels; }
    bool operator==(const MapFacts&) const = default;
};

/// Checks the facts of a shadow map before engine parameters are converted.
/// @throws Error naming the first fact that is not a finite number in its range
void require_sound(const MapFacts& facts);

/// Degree to which a converted bias or setting draws the same shadows in the other program.
enum class Exactness {
    Exact,         ///< at every angle of a flat surface
    EqualAtAngle,  ///< bias: at MapFacts::angle_deg only; other numbers: approximately
    Missing,       ///< the other side has no counterpart, and the number is left out
};
/// Keys of the degrees of exactness in JSON, by Exactness.
inline constexpr std::string_view kExactnessKeys[] = {"exact", "equal-at-angle", "missing"};

/// Named value of an engine's parameter, with the settings of this program that it stands for.
struct EngineChoice {
    std::string_view key;  ///< the engine's name: "PCFShadowMap"
    /// Settings of this program with values, separated by spaces: "filter.kernel=vogel filter.taps=5". After "|" follow
    /// alternatives, for which this choice is the nearest that the engine has.
    std::string_view settings;
};

/// Shadow parameter of an engine, under the engine's own name and in its unit.
struct EngineParameter {
    std::string_view key;       ///< "normalBias"
    std::string_view unit;      ///< "m", "texels", "normalised depth"; empty: a plain number
    double standard = 0;        ///< the engine's default; for choices the index
    double min = 0, max = 1e6;  ///< range of values that the engine accepts
    std::string_view meaning;
    std::string_view source;   ///< place in the engine's documentation or code
    std::string_view setting;  ///< main setting that the parameter changes; empty: none
    /// Factor that converts the engine's number to the value of `setting`. 0: no factor converts it; for the bias see
    /// EngineProfile::read_bias and write_bias.
    double scale = 0;
    std::span<const EngineChoice> choices = {};
    bool is_bias = false;  ///< parameter of the bias, which a search for the best bias varies
    /// For parameters of caster.cull. True: a given value applies to double-sided materials too, but the default does
    /// not.
    bool holds_for_double_sided = false;
};

/// Setting that has one fixed value under an engine profile, because the engine cannot turn the feature off.
struct ForcedSetting {
    std::string_view key, value;
    std::string_view reason;
};

/// Setting of this program, or one of its values, that the engine lacks.
struct LackingSetting {
    std::string_view key;    ///< setting
    std::string_view value;  ///< choice; empty: every value but 0 or the first choice
    std::string_view reason;
};

/// Values of an engine's parameters by parameter key; choices as indices. Absent parameters have their default.
using EngineValues = std::map<std::string, double, std::less<>>;

/// Setting of this program, with the value to which an engine's parameters were converted.
struct ConvertedSetting {
    std::string key, value;  ///< as for set_setting()
    Exactness exactness = Exactness::Exact;
    std::string note;
};

/// Parameter of an engine, with the value to which this program's settings were converted.
struct ConvertedParameter {
    const EngineParameter* parameter = nullptr;
    double value = 0;  ///< in the engine's unit; for choices the index
    Exactness exactness = Exactness::Exact;
    std::string note;
    /// Number that converts this part of the bias alone, without regard to bias that the engine adds by itself. Equal
    /// to `value` for parameters other than the bias.
    double literal = 0;
    double metres = 0, texels = 0;  ///< equivalent depth bias at the reference angle; 0 for parameters of no bias
};

/// Setting of this program that has no counterpart in an engine, with its value and the reason.
struct MissingSetting {
    std::string key, value;
    std::string reason;
};

/// Result of converting this program's settings to the parameters of an engine.
struct WrittenValues {
    std::vector<ConvertedParameter> parameters;
    std::vector<MissingSetting> missing;
    std::vector<std::string> notes;
    double wanted_texels = 0;  ///< equivalent depth bias of the settings at the reference angle
    double hidden_texels = 0;  ///< equivalent depth bias that the engine adds by itself
    double given_texels = 0;   ///< equivalent depth bias of the written numbers, hidden bias included

    /// Returns the converted parameter of the engine with this key (EngineParameter::key); null if the settings give it
    /// no value.
    const ConvertedParameter* find(std::string_view key) const;
    /// Returns the converted values by parameter key, as read_engine_values() takes them. Parameters without a
    /// counterpart are left out.
    EngineValues values() const;
};

/// Bias in terms that all engines share, defined in bias_numbers.h.
struct BiasNumbers;
/// Collector of the parameter values of an engine, defined in bias_numbers.h.
class EngineOutput;

/// Profile of an engine or graphics API: its shadow parameters, what it fixes or lacks, and the conversion to and from
/// settings of this program. A new engine is one file and one row of the table.
struct EngineProfile {
    std::string_view name, title;
    std::string_view version;  ///< version of the engine whose parameters these are
    std::string_view
        unverified;  ///< what is not verified about the conversions; empty: all is from the engine's source
    std::span<const EngineParameter> parameters = {};
    std::span<const ForcedSetting> forced = {};
    std::span<const LackingSetting> lacking = {};
    /// Keys of the rows of the bias table that the engine has; empty: all, in an application's own shader.
    std::span<const std::string_view> bias_rows = {};
    /// Dependence of the engine's normal offset on the angle.
    OffsetBy normal_by = OffsetBy::Length;
    /// True: the cascades of a light share one map. If there are several, each gets half the map's width.
    bool cascades_share_map = false;
    /// Constant bias that the engine adds at the look-up by itself, as a share of the depth range.
    double hidden_depth = 0;
    /// Returns the bias that the engine adds by itself, as equivalent depth bias in texels at the reference angle.
    double (*hidden_texels)(const EngineProfile&, const EngineValues&, const MapFacts&) = nullptr;
    /// Converts the engine's bias parameters to terms that all engines share: constant, normal offset and polygon
    /// offset.
    BiasNumbers (*read_bias)(const EngineProfile&, const EngineValues&, const MapFacts&) = nullptr;
    /// Converts a bias to the engine's parameters, and adds them to the EngineOutput. EngineValues has the other
    /// parameters.
    void (*write_bias)(const BiasNumbers&, const EngineValues&, const MapFacts&, EngineOutput&) = nullptr;
};

/// Returns the profiles of all known engines and graphics APIs.
std::span<const EngineProfile> engine_profiles();
/// Finds an engine profile by its name. @throws UsageError with the nearest name and all names
const EngineProfile& engine_profile(std::string_view name);
/// Finds a parameter of an engine by the parameter's key, ignoring case. @throws UsageError with the nearest key and
/// all keys
const EngineParameter& engine_parameter(const EngineProfile& profile, std::string_view key);
/// Returns the value of an engine's parameter: that in `values`, or else its default. @throws Error for an unknown key
double engine_value(const EngineProfile& profile, const EngineValues& values, std::string_view key);
/// Parses the value of an engine's parameter: a number in its range, true or false, or the name of a choice. A choice
/// gives its index.
/// @throws UsageError with the allowed values
double parse_engine_value(const EngineProfile& profile, const EngineParameter& parameter, std::string_view text);
/// Formats the value of an engine's parameter: the name of a choice, or else a number of up to six significant digits.
std::string engine_value_text(const EngineParameter& parameter, double value);

/// Converts parameter values of an engine to settings of this program. The bias is always converted, with defaults for
/// absent values; other parameters only where a value is given.
/// @throws Error for facts or values that are not finite or out of range
std::vector<ConvertedSetting> read_engine_values(const EngineProfile& profile, const EngineValues& values,
                                                 const MapFacts& facts);
/// Converts this program's settings into parameters of the engine. The equivalent depth bias at the reference angle
/// stays equal, with the bias that the engine adds by itself. Numbers are not lowered below 0 to make up for that bias.
/// Bias from apply_forced_settings() counts like any other bias in `settings`.
/// @param facts `format`, `reversed_z` and `light` are ignored: `settings` give them
/// @param kept values of engine parameters that no setting gives, such as a project's console variables
/// @throws Error as read_engine_values()
WrittenValues write_engine_values(const EngineProfile& profile, const Settings& settings, const MapFacts& facts,
                                  const EngineValues& kept = {});

/// Applies EngineProfile::forced to the settings. These are settings for which the engine has one value only, which its
/// users cannot change. Returns a line for people about each changed setting that was not at its default.
std::vector<std::string> apply_forced_settings(const EngineProfile& profile, Settings& settings);
/// Returns the only value that an engine has for a setting, with the reason; null if the engine has a choice of values.
/// @param key setting key without a light's index
const ForcedSetting* forced_setting(const EngineProfile& profile, std::string_view key);
/// Returns true when an engine has a kind of bias. @param key key of a row of the bias table, such as "normal-offset"
bool has_bias_row(const EngineProfile& profile, std::string_view key);
/// Returns bias settings with the bias that the engine adds by itself and cannot turn off. Sets the bias settings for
/// which the engine has one value only, and raises the constant to at least EngineProfile::hidden_depth.
BiasSettings with_hidden_bias(const EngineProfile& profile, const BiasSettings& bias, const MapFacts& facts);
/// Returns the reason why an engine cannot draw a change of settings. The engine has another value only
/// (EngineProfile::forced), or lacks the setting, the kernel or the kind of bias. Empty: it can draw the change.
/// @param before present settings
/// @param with changed settings
std::string reason_engine_lacks(const EngineProfile& profile, const Settings& before, const Settings& with);
/// Returns the profile's entry for a setting whose present value the engine lacks; null if the engine has the value.
/// @param key key of the setting
const LackingSetting* lacking_setting(const EngineProfile& profile, const Settings& settings, std::string_view key);

}  // namespace si
