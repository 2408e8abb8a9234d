// Finds the source tree whose pages and pictures the tests compare.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace si::test {

/// Returns the root of the source tree: $SI_SOURCE_TREE where it is set, else the tree that the tests are built from.
/// The test of the recipes follows a recipe in a copy of the tree and points the other tests there.
inline std::filesystem::path source_tree() {
    const char* copy = std::getenv("SI_SOURCE_TREE");
    return copy && *copy ? copy : SI_SOURCE_DIR;
}

/// Returns the files below folders of the tree that the tests are built from.
/// @param folders paths from the tree's root @param extensions with their dots, such as ".h"
inline std::vector<std::filesystem::path> source_files(std::initializer_list<std::string_view> folders,
                                                       std::initializer_list<std::string_view> extensions) {
    std::vector<std::filesystem::path> out;
    for (const std::string_view folder : folders)
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(std::filesystem::path(SI_SOURCE_DIR) / folder))
            if (std::ranges::find(extensions, entry.path().extension().string()) != extensions.end())
                out.push_back(entry.path());
    return out;
}

}  // namespace si::test
