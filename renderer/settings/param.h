// Table of settings: one row for each setting, and access to settings by dotted key and as text. Sliders, presets,
// --set, sweeps, uniforms, defines and the documentation are loops over these rows.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "renderer/settings/settings.h"

namespace si {

/// Data that the renderer rebuilds after a change of a setting: uniforms, GLSL programs, or render targets.
enum class Cost { Uniform, Program, Target };

/// Reference to a setting of any enumeration type, so that code can read and write it as the index of its choice. Only
/// this class converts settings between enumerators and numbers.
class EnumRef {
public:
    /// Binds the reference to a member of an enumeration type.
    /// @param member outlives the reference
    template <typename E>
    requires std::is_enum_v<E> EnumRef(E* member)  // NOLINT: implicit, as the pointers beside it in FieldRef are
        : member_(member),
          read_([](const void* from) { return static_cast<int>(*static_cast<const E*>(from)); }),
          write_([](void* to, int index) { *static_cast<E*>(to) = static_cast<E>(index); }) {
        static_assert(std::is_same_v<std::underlying_type_t<E>, int>, "an index that is no choice must survive");
    }

    /// Returns the index of the referenced setting's present choice.
    int index() const { return read_(member_); }
    /// Sets the referenced setting to the choice with this index, unchecked: an index without a choice is stored too.
    /// sanitise() repairs it.
    void set_index(int index) const { write_(member_, index); }
    /// Returns the address of the settings member that this object refers to.
    void* address() const { return member_; }

private:
    void* member_;
    int (*read_)(const void*);
    void (*write_)(void*, int);
};

/// Reference to the member that holds a setting: a pointer of the member's type, or an EnumRef.
using FieldRef = std::variant<bool*, int*, double*, std::string*, EnumRef>;

/// Allowed value of a setting with named values, with its key for files, label and help.
struct Choice {
    std::string_view key, label, help;
};

/// Returns the rows of a table of techniques (key, label, help) as choices of a setting, in the table's order.
/// @tparam rows function that returns the table, which must not change after the first call
template <auto rows>
std::span<const Choice> choices_of() {
    static const std::vector<Choice> choices = [] {
        std::vector<Choice> out;
        for (const auto& row : rows()) out.push_back({row.key, row.label, row.help});
        return out;
    }();
    return choices;
}

/// OpenGL feature beyond version 4.5 that a setting needs.
enum class DriverFeature { None, PolygonOffsetClamp };

/// Scope of a setting: one value for the scene, one for each light, or one for each object.
enum class Scope { Scene, Light, Object };

/// Set of the render passes that read a setting directly on the CPU, as bit flags. Settings that shaders read
/// (Param::shader) and settings that change lights or camera are not counted. A pass draws again only if one of its
/// settings changes.
enum class ReadBy : unsigned {
    None = 0,
    Maps = 1 << 0,          ///< passes that draw the shadow maps
    DepthBlur = 1 << 1,     ///< pass of map.blur_texels
    Moments = 1 << 2,       ///< passes that make moments from the maps
    SurfacesSeen = 1 << 3,  ///< pass that stores the visible surfaces
    OneLight = 1 << 4,      ///< passes for the shown light alone
    Compose = 1 << 5,       ///< pass that blends overlays over pictures
    Slabs = 1 << 6,         ///< pass that draws texels of the map into the scene
    MapRange = 1 << 7,      ///< pass that finds the map viewer's range
    MapView = 1 << 8,       ///< pass that draws the map viewer's picture
    Visibility = 1 << 9,    ///< visibility pass
    Blobs = 1 << 10,        ///< pass that draws blobs
    Pages = 1 << 11,        ///< pass that caches pages of virtual maps
    Shading = 1 << 12,      ///< passes that shade the picture
};
/// Joins two sets of render passes that read a setting.
constexpr ReadBy operator|(ReadBy a, ReadBy b) {
    return ReadBy(unsigned(a) | unsigned(b));
}
/// Returns true when the set of passes contains the pass.
constexpr bool is_read_by(ReadBy set, ReadBy pass) {
    return (unsigned(set) & unsigned(pass)) != 0;
}

/// Row of the table of settings: key, member, label, unit, range, help and effects of one setting.
struct Param {
    std::string_view key;  ///< dotted key; "light.X" for settings of each light, "object.X" for settings of each object
    /// Returns a reference to the member that holds the setting: in Settings, in its light `light`, or in the given
    /// ObjectSettings.
    FieldRef (*field)(Settings&, int light, ObjectSettings*) = nullptr;
    std::string_view label, unit;
    double min = 0, max = 1;  ///< range; for texts max is the largest size in bytes of UTF-8
    double slider_max = 0;    ///< end of the slider, while typed values may go up to max; 0: max
    bool logarithmic = false;
    bool zero_is_auto = false;  ///< value 0 lets the program choose
    Cost cost = Cost::Uniform;
    /// Returns the choices of a setting with named values; null for other settings.
    std::span<const Choice> (*choices)() = nullptr;
    /// Returns the values that "*" stands for in a sweep, as texts for --set; null: each choice once.
    std::span<const std::string_view> (*swept)() = nullptr;
    /// Returns the reason why the setting has no effect under `s`; empty if it has an effect. Null: it always has an
    /// effect.
    std::string_view (*idle)(const Settings& s, int light) = nullptr;
    std::string_view help;
    /// Names of the setting in Unity, Unreal, Godot, three.js, Filament, Blender and OpenGL, for the search.
    std::string_view also = {};
    Scope scope = Scope::Scene;
    DriverFeature needs = DriverFeature::None;
    bool map_only = false;        ///< no effect if no light's source is a shadow map (light.source)
    bool animation_only = false;  ///< no effect on scenes without animations
    bool file = false;            ///< text that is a file's path; empty: no file. Results depend on its content
    bool shader = false;          ///< shaders read the setting, as a define (Cost::Program) or in the settings block
    ReadBy read_by = ReadBy::None;
};

/// Returns the table of settings: all rows, in the order of panels, listings and presets.
std::span<const Param> params();

/// Reference to one setting: its table row and, for settings of a light or an object, which light or object.
struct SettingRef {
    const Param* param = nullptr;
    int light = 0;
    std::string object;  ///< node path of the object, for Scope::Object
};

/// Returns the setting with a dotted key; nothing if the key is unknown. Examples: "bias.slope",
/// "light.2.azimuth", "light.azimuth" (light 0), "object.Root/Fence.cull".
std::optional<SettingRef> find_setting(std::string_view key);
/// Returns the canonical dotted key of a setting. Keys of light 0 have no number: "light.azimuth".
std::string setting_key(const SettingRef& ref);
/// Returns the key of a setting of one light, such as "light.2.size".
/// @param light index of the light; light 0 gives "light.size" @param setting the name of a setting of lights, such as
/// "size"
std::string light_setting_key(std::size_t light, std::string_view setting);
/// Returns the setting key nearest to an unknown `key` by edit distance, for "did you mean"; empty if none is near.
std::string nearest_key(std::string_view key);

/// Returns the nearest of `names` to `name` by edit distance, for "did you mean"; empty if none is near.
std::string nearest_name(std::string_view name, std::span<const std::string> names);

/// Value of a setting. A choice is stored as its index, an int.
using Value = std::variant<bool, int, double, std::string>;
/// Returns true when the values of a setting are strings. A string is either a name for people (a light's name), which
/// never changes a picture, or the path of a file (Param::file).
bool is_text(const Param& p);
/// Converts a setting's value to a number: a switch to 0 or 1, a choice to its index, a text to 0.
double numeric_value(const Value& v);
/// Returns the value of the setting `ref` in `s`; for an object without settings of its own the default.
Value get_value(const Settings& s, const SettingRef& ref);
/// Sets the setting `ref` in `s` to a value, without range check (sanitise() checks later). Numbers and switches
/// convert as in C++. Does nothing if one of setting and value is a text and the other is not.
void set_value(Settings& s, const SettingRef& ref, const Value& v);
/// Returns the default value of a setting.
Value default_value(const SettingRef& ref);

/// Converts a setting's value to the text of preset files and of the option --set. A choice becomes its key, a switch
/// "true" or "false", and a number its shortest text that reads back as the same number.
std::string value_text(const Param& p, const Value& v);
/// Parses the text of a setting's value and checks its range. For filter.kernel it also accepts the name of a kernel
/// with its size, such as "pcf5" (sized_kernels.h).
/// @throws UsageError naming the key, the text and the allowed values
Value parse_value(const SettingRef& ref, std::string_view text);
/// Returns the other settings, with their values, that change too when the setting `ref` is set from a text. The name
/// of a kernel with its size ("pcf5") implies filter.size and filter.point. Empty for all other texts.
std::vector<std::pair<SettingRef, Value>> implied_values(const SettingRef& ref, std::string_view text);
/// Sets the setting with the dotted key `key` from a text. Also sets the settings that the text implies
/// (implied_values()), such as filter.size for the kernel "pcf5".
/// @throws UsageError for a bad value, or for an unknown key with the nearest known one
void set_setting(Settings& s, std::string_view key, std::string_view text);
/// Sets several settings in order, as set_setting() does. @param changes pairs of key and text @throws UsageError
void set_settings(Settings& s, const auto& changes) {
    for (const auto& [key, text] : changes) set_setting(s, key, text);
}

/// Returns all settings in `s`, in table order: those of the scene, of lights 0 to 15, and of objects with settings of
/// their own.
std::vector<SettingRef> all_settings(const Settings& s);
/// Returns the settings in `s` that differ from their defaults, in table order.
std::vector<SettingRef> changed_settings(const Settings& s);
/// Returns the settings in which `a` and `b` differ, in table order. An object without settings of its own counts as
/// having the defaults.
std::vector<SettingRef> differing_settings(const Settings& a, const Settings& b);

/// Returns the unit in which a setting's number is displayed under the settings `s`. A unit can depend on other
/// settings: bias has the unit chosen by bias.unit, and light.size is an angle for directional lights and metres for
/// others.
std::string_view shown_unit(const Settings& s, const SettingRef& ref);
/// Formats a setting's value for display: a choice's label, "on" or "off", a number with its unit.
std::string shown_value(const Settings& s, const SettingRef& ref, const Value& v);
/// Returns the title of light number `light` (from 0) for display, with its name if it has one: "Light 1", "Light 1
/// (sun)".
std::string light_title(const Settings& s, int light);
/// Formats the change of one setting from its value in `a` to its value in `b` for display: "0.1 → 0 texels". A unit
/// that both values share is written once.
std::string change_text(const Settings& a, const Settings& b, const SettingRef& ref);

/// Repairs invalid settings in place: numbers that are not finite or out of range, and pairs or cascade splits in
/// reversed order (near above far). Returns one line for display per repair.
std::vector<std::string> sanitise(Settings& s);

}  // namespace si
