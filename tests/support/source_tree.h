// Finds the source tree whose pages and pictures the tests compare.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace si::test {

/// Returns the root of the source tree: $SI_SOURCE_TREE where it is set, else the tree that the tests are built from.
/// The test of the recipes follows a recipe in a copy of the tree and points the other tests there.
inline std::filesystem::path source_tree() {
    const char* copy = std::getenv("SI_SOURCE_TREE");
    return copy && *copy ? copy : SI_SOURCE_DIR;
}

}  // namespace si::test
