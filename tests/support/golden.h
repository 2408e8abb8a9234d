// Draws and reads golden pictures: one reviewed picture per row of each table of techniques. tests/golden holds the
// files and tests/tools/draw_golden.cpp draws them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/render/renderer.h"

namespace si::test {

/// Scene and settings that show one row of a table of techniques.
struct GoldenPicture {
    std::string table;    ///< name of the table: "filters"
    std::string row;      ///< key of the row: "tent3"
    std::string setting;  ///< key of the setting with these rows as choices: "filter.kernel"
    Scene scene;
    Settings settings;
    /// Returns the picture's file name without its ending: "filters-tent3".
    std::string name() const { return table + "-" + row; }
    /// Returns the setting with its value: "filter.kernel=tent3".
    std::string choice() const { return setting + "=" + row; }
};

/// Returns the names of all tables that have golden pictures: "filters", "biases", ...
std::vector<std::string> golden_tables();

/// Returns the golden pictures of a table, one per row, with their scenes and settings.
/// @throws Error if there is no such table
std::vector<GoldenPicture> golden_pictures(const std::string& table);

/// Draws a golden picture: 128 x 72 pixels of the visibility, or of the view that shows the row best.
ByteImage draw_golden(Renderer& renderer, const GoldenPicture& picture);

/// Returns the folder of the golden pictures: tests/golden in source_tree().
std::filesystem::path golden_folder();
/// Returns the path of a golden picture's file in a folder.
std::filesystem::path golden_file(const std::filesystem::path& folder, const GoldenPicture& picture);

/// Reads the file of a golden picture.
/// @returns an empty image if there is no such file
/// @throws Error if the file is not a picture
ByteImage read_golden(const std::filesystem::path& file);

/// Draws a grey picture of the differences between two pictures of equal size. Larger differences are brighter.
ByteImage golden_difference(const ByteImage& a, const ByteImage& b);

}  // namespace si::test
