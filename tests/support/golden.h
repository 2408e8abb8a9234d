// A small picture of every row of every table of techniques, as it was drawn once: what the tests know by heart, where
// they know no closed form. tests/golden holds them, tests/tools/draw_golden.cpp makes them anew.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/render/renderer.h"

namespace si::test {

struct GoldenPicture {
    std::string table, row;
    Scene scene;
    Settings settings;
    std::string name() const { return table + "-" + row; }
};

/// "filters", "biases", ...: all that golden_pictures() takes.
std::vector<std::string> golden_tables();

/// Of each row of a table one. @throws Error where there is no such table
std::vector<GoldenPicture> golden_pictures(const std::string& table);

/// 128 x 72 pixels: the visibility, or what else shows the row best.
ByteImage draw_golden(Renderer& renderer, const GoldenPicture& picture);

/// Where the pictures are kept, and the file of one.
std::filesystem::path golden_folder();
std::filesystem::path golden_file(const std::filesystem::path& folder, const GoldenPicture& picture);

/// @returns an empty image where there is no such file. @throws Error where it is no picture
ByteImage read_golden(const std::filesystem::path& file);

/// Grey, and brighter where two pictures of one size differ more.
ByteImage golden_difference(const ByteImage& a, const ByteImage& b);

}  // namespace si::test
