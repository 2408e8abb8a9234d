// Helpers of the files of settings rows (rows_*.cpp): macros that bind a row to its member, and a count of members,
// which checks at compile time that every member has a row.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "renderer/settings/param.h"

namespace si {

// Rows of the settings table by topic; params() joins them.

/// Returns the rows of the settings table (params()) that concern shadow maps: map.*, caster.*, bias.*, filter.*.
std::vector<Param> shadow_rows();
/// Returns the rows of the settings table (params()) that concern lights: light.count and light.*.
std::vector<Param> light_rows();
/// Returns the rows of the settings table (params()) that concern shadows without a map: volumes.*, contact.*, blob.*,
/// light_map.*.
std::vector<Param> source_rows();
/// Returns the rows of the settings table (params()) that concern picture, camera and scene: shading.*, camera.*,
/// scene.*.
std::vector<Param> picture_rows();
/// Returns the rows of the settings table (params()) that concern map viewer, panes and overlays: view.*.
std::vector<Param> view_rows();
/// Returns the rows of the settings table (params()) that concern the ray-traced reference and single objects: truth.*,
/// object.*.
std::vector<Param> reference_rows();

namespace rows {

// Each macro makes the key from the C++ path, so that key and member always agree.
#define SI_FIELD(path) .key = #path, .field = [](Settings& s, int, ObjectSettings*) -> FieldRef { return &s.path; }
#define SI_LIGHT_FIELD(name) \
    .key = "light." #name,   \
    .field = [](Settings& s, int light, ObjectSettings*) -> FieldRef { return &s.lights[std::size_t(light)].name; }
#define SI_OBJECT_FIELD(name) \
    .key = "object." #name, .field = [](Settings&, int, ObjectSettings* object) -> FieldRef { return &object->name; }
#define SI_CHOICES(array) .choices = []() -> std::span<const Choice> { return array; }
#define SI_IDLE(condition, reason)                                                               \
    .idle = []([[maybe_unused]] const Settings& s, [[maybe_unused]] int i) -> std::string_view { \
        return (condition) ? std::string_view(reason) : std::string_view();                      \
    }

/// Returns the settings rows of several lists as one list.
template <std::size_t... N>
std::vector<Param> joined(const std::array<Param, N>&... lists) {
    std::vector<Param> all;
    (all.insert(all.end(), lists.begin(), lists.end()), ...);
    return all;
}

/// Returns rows of the settings table with their scope (scene, light or object) set to `scope`.
template <std::size_t N>
constexpr std::array<Param, N> with_scope(std::array<Param, N> list, Scope scope) {
    for (Param& p : list) p.scope = scope;
    return list;
}

/// Returns rows of the settings table, marked as settings that only shadow maps read (Param::map_only).
template <std::size_t N>
constexpr std::array<Param, N> only_of_maps(std::array<Param, N> list) {
    for (Param& p : list) p.map_only = true;
    return list;
}

/// Placeholder that converts to any type, used to count the members of an aggregate at compile time.
struct AnyValue {
    template <class T>
    constexpr operator T() const;  // NOLINT: never defined, only its type matters
};

/// Returns true when the aggregate T accepts sizeof...(I) initialisers.
template <class T, std::size_t... I>
constexpr bool is_initialisable(std::index_sequence<I...>) {
    return requires {
        T{(void(I), AnyValue{})...};
    };
}

/// Returns the number of members of an aggregate: the length of the longest list of initialisers that it accepts.
template <class T, std::size_t N = 64>
constexpr std::size_t member_count() {
    if constexpr (is_initialisable<T>(std::make_index_sequence<N>{})) {
        return N;
    } else {
        return member_count<T, N - 1>();
    }
}

}  // namespace rows
}  // namespace si
