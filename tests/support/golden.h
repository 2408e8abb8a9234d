// Golden pictures: a small picture of each row of each table of techniques, drawn once and looked at by a person.
// tests/golden holds them, tests/tools/draw_golden.cpp draws them again.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/render/renderer.h"

namespace si::test {

/// A row of a table, with the scene and the settings that show it.
struct GoldenPicture {
    std::string table, row;
    std::string setting;  ///< key of the setting whose choices are the table's rows: "filter.kernel"
    Scene scene;
    Settings settings;
    std::string name() const { return table + "-" + row; }      ///< "filters-tent3", the file's name
    std::string choice() const { return setting + "=" + row; }  ///< "filter.kernel=tent3"
};

/// Returns the names of the tables: "filters", "biases", ...
std::vector<std::string> golden_tables();

/// Returns one picture for each row of a table. @throws Error where there is no such table
std::vector<GoldenPicture> golden_pictures(const std::string& table);

/// Draws the picture: 128 x 72 pixels of the visibility, or of the view that shows the row best.
ByteImage draw_golden(Renderer& renderer, const GoldenPicture& picture);

/// Returns tests/golden of source_tree().
std::filesystem::path golden_folder();
/// Returns the file of a picture in a folder.
std::filesystem::path golden_file(const std::filesystem::path& folder, const GoldenPicture& picture);

/// @returns an empty image where there is no such file. @throws Error where it is no picture
ByteImage read_golden(const std::filesystem::path& file);

/// Grey, and brighter where two pictures of one size differ more.
ByteImage golden_difference(const ByteImage& a, const ByteImage& b);

}  // namespace si::test
