// What the files of settings rows share: the macros that tie a row to its member, and the count of members that
// proves no member is without a row.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "renderer/settings/param.h"

namespace si {

std::span<const Param> map_rows();
std::span<const Param> bias_rows();
std::span<const Param> light_rows();
std::span<const Param> volume_rows();
std::span<const Param> contact_rows();
std::span<const Param> blob_rows();
std::span<const Param> light_map_rows();
std::span<const Param> shading_rows();
std::span<const Param> camera_rows();
std::span<const Param> scene_rows();
std::span<const Param> view_rows();
std::span<const Param> reference_rows();
std::span<const Param> object_rows();

namespace rows {

// The key is the C++ path, so that the two cannot drift apart.
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

template <class E>
constexpr int at(E e) {
    return static_cast<int>(e);
}

template <std::size_t N>
constexpr std::array<Param, N> with_scope(std::array<Param, N> list, Scope scope) {
    for (Param& p : list) p.scope = scope;
    return list;
}

/// Rows that only shadow maps read.
template <std::size_t N>
constexpr std::array<Param, N> of_map(std::array<Param, N> list) {
    for (Param& p : list) p.of_map = true;
    return list;
}

struct Any {
    template <class T>
    constexpr operator T() const;  // NOLINT: never defined, only its type matters
};

template <class T, std::size_t... I>
constexpr bool takes(std::index_sequence<I...>) {
    return requires {
        T{(void(I), Any{})...};
    };
}

/// Number of members of an aggregate: the longest list of initialisers it accepts.
template <class T, std::size_t N = 64>
constexpr std::size_t members() {
    if constexpr (takes<T>(std::make_index_sequence<N>{})) {
        return N;
    } else {
        return members<T, N - 1>();
    }
}

}  // namespace rows
}  // namespace si
