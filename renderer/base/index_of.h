// Enumerators as numbers: for arrays, shaders and files that hold their index, and for steps through all of them.
#pragma once

#include <type_traits>

namespace si {

/// Returns the enumerator's place in its enumeration, from 0.
template <typename E>
requires std::is_enum_v<E>
constexpr int index_of(E enumerator) {
    return static_cast<int>(enumerator);
}

/// Returns the next enumerator; after the last of `count` enumerators, the first.
template <typename E>
requires std::is_enum_v<E>
constexpr E next_of(E enumerator, int count) {
    return static_cast<E>((index_of(enumerator) + 1) % count);
}

}  // namespace si
