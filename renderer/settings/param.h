// The rows that describe each setting, and text access to settings by dotted key. Sliders, presets, --set,
// sweeps, uniforms, defines and the documentation are loops over these rows.
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

/// What a change of the setting makes the renderer rebuild.
enum class Cost { Uniform, Program, Target };

/// Reference to a member of any enumeration, read and written as the index of its choice. The only place where
/// settings turn from enumerators into numbers and back.
class EnumRef {
public:
    /// @param member outlives the reference
    template <typename E>
    requires std::is_enum_v<E> EnumRef(E* member)  // NOLINT: implicit, as the pointers beside it in FieldRef are
        : member_(member),
          read_([](const void* from) { return static_cast<int>(*static_cast<const E*>(from)); }),
          write_([](void* to, int index) { *static_cast<E*>(to) = static_cast<E>(index); }) {
        static_assert(std::is_same_v<std::underlying_type_t<E>, int>, "an index that is no choice must survive");
    }

    int index() const { return read_(member_); }
    /// Writes the index as it is: no choice may stand there (see sanitise()).
    void set_index(int index) const { write_(member_, index); }
    void* address() const { return member_; }

private:
    void* member_;
    int (*read_)(const void*);
    void (*write_)(void*, int);
};

/// Reference to one member of Settings.
using FieldRef = std::variant<bool*, int*, double*, std::string*, EnumRef>;

struct Choice {
    std::string_view key, label, help;
};

/// What of a driver a setting needs beyond OpenGL 4.5.
enum class DriverFeature { None, PolygonOffsetClamp };

enum class Scope { Scene, Light, Object };

/// Passes that read a setting themselves: not by what shaders see of it (Param::shader), nor by what lights and camera
/// are made of it. What they draw is kept while these stay as they are.
enum class ReadBy : unsigned {
    None = 0,
    Maps = 1 << 0,          ///< that draw the shadow maps
    DepthBlur = 1 << 1,     ///< map.blur_texels
    Moments = 1 << 2,       ///< that make them of the maps
    SurfacesSeen = 1 << 3,  ///< that keep the surfaces
    OneLight = 1 << 4,      ///< that speak of one light alone
    Compose = 1 << 5,       ///< that lay overlays over pictures
    Slabs = 1 << 6,         ///< that draw texels into the scene
    MapRange = 1 << 7,      ///< that find the map viewer's range
    MapView = 1 << 8,       ///< that draw its picture
    Visibility = 1 << 9,    ///< the pass of that name
    Blobs = 1 << 10,        ///< that draw them
    Pages = 1 << 11,        ///< that keep pages of virtual maps
    Shading = 1 << 12,      ///< that shade the picture
};
constexpr ReadBy operator|(ReadBy a, ReadBy b) {
    return ReadBy(unsigned(a) | unsigned(b));
}
constexpr bool is_read_by(ReadBy set, ReadBy pass) {
    return (unsigned(set) & unsigned(pass)) != 0;
}

struct Param {
    std::string_view key;  ///< dotted; per-light rows read "light.X", per-object rows "object.X"
    FieldRef (*field)(Settings&, int light, ObjectSettings*) = nullptr;
    std::string_view label, unit;
    double min = 0, max = 1;  ///< of a text max is the most bytes in UTF-8
    double slider_max = 0;    ///< where its slider ends; what is typed may go on to max. 0: at max
    bool logarithmic = false;
    bool zero_is_auto = false;  ///< at 0 the program chooses
    Cost cost = Cost::Uniform;
    std::span<const Choice> (*choices)() = nullptr;
    /// What "*" stands for in a sweep, as --set takes it; without it each choice once.
    std::span<const std::string_view> (*swept)() = nullptr;
    /// Why the setting is without effect under `s`; empty when it acts.
    std::string_view (*idle)(const Settings& s, int light) = nullptr;
    std::string_view help;
    /// What Unity, Unreal, Godot, three.js, Filament, Blender and OpenGL call it, for the search.
    std::string_view also = {};
    Scope scope = Scope::Scene;
    DriverFeature needs = DriverFeature::None;
    bool of_map = false;          ///< without effect where no light's shadows come from a map (light.source)
    bool animation_only = false;  ///< without effect on scenes without animations
    bool shader = false;          ///< the shaders see it, as a define (Cost::Program) or in the settings block
    ReadBy read_by = ReadBy::None;
};

std::span<const Param> params();

/// One setting of one Settings value: a row, and for per-light and per-object rows whose.
struct SettingRef {
    const Param* param = nullptr;
    int light = 0;
    std::string object;  ///< node path for Scope::Object
};

/// Finds the setting of a dotted key ("bias.slope", "light.2.azimuth", "light.azimuth", "object.Root/Fence.cull").
std::optional<SettingRef> find_setting(std::string_view key);
/// The canonical dotted key of a setting ("light.azimuth" is light 0).
std::string setting_key(const SettingRef& ref);
/// The known key most like `key`, by edit distance.
std::string nearest_key(std::string_view key);

/// The nearest of `names` to `name` by edit distance; empty when there are none.
std::string nearest_name(std::string_view name, std::span<const std::string> names);

using Value = std::variant<bool, int, double, std::string>;  ///< choices are int
/// A row whose values are texts for people, which nothing is drawn by.
bool is_text(const Param& p);
/// Of switches 0 or 1, of choices their number, of texts 0.
double numeric_value(const Value& v);
Value get_value(const Settings& s, const SettingRef& ref);
/// Writes a value as it is, without range checks (sanitise() guards the renderer). Numbers convert as C++ does; a text
/// is never a number, nor the reverse: then nothing is written.
void set_value(Settings& s, const SettingRef& ref, const Value& v);
Value default_value(const SettingRef& ref);

/// The value as presets and --set write it: choice keys, true/false, shortest round-trip numbers, texts as they are.
std::string value_text(const Param& p, const Value& v);
/// Parses and range-checks a value; of filter.kernel, a sized kernel's name too (sized_kernels.h).
/// @throws UsageError naming the key, the value and what is allowed
Value parse_value(const SettingRef& ref, std::string_view text);
/// Returns the values of other settings that a text implies: filter.size and filter.point of a sized kernel's name.
std::vector<std::pair<SettingRef, Value>> implied_values(const SettingRef& ref, std::string_view text);
/// Sets the setting `key` to the value that `text` names, and the settings that it implies.
/// @throws UsageError; of an unknown key it names the nearest one
void set_setting(Settings& s, std::string_view key, std::string_view text);

/// Every setting that `s` has (lights 0..15, objects with an override), in table order.
std::vector<SettingRef> all_settings(const Settings& s);
/// The settings that differ from their defaults, in table order.
std::vector<SettingRef> changed_settings(const Settings& s);
/// The settings in which the two differ, in table order; a missing object override counts as its defaults.
std::vector<SettingRef> differing_settings(const Settings& a, const Settings& b);

/// What a number of this setting counts in under `s`; a unit that names another setting is that setting's choice, and
/// the size of a light is an angle where its rays are parallel.
std::string_view shown_unit(const Settings& s, const SettingRef& ref);
/// The value for people: a choice's label, on or off, a number with its unit.
std::string shown_value(const Settings& s, const SettingRef& ref, const Value& v);
/// "Light 1", and its name where it has one: "Light 1 (key)".
std::string light_title(const Settings& s, int light);
/// "0.1 → 0 texels": from what `a` has to what `b` has, the unit once where it is the same.
std::string change_text(const Settings& a, const Settings& b, const SettingRef& ref);

/// Clamps non-finite, out-of-range and reversed values in place. Returns one line per repair.
std::vector<std::string> sanitise(Settings& s);

}  // namespace si
