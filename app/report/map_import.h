// Image of one shadow map of another engine with the readings that its convention may have, and the bundle of one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/bundle/conventions.h"
#include "renderer/bundle/light_file.h"
#include "renderer/scene/scene.h"
#include "ui/panels/import_dialog.h"

namespace si {

/// Image of a map with its light, the scene that it is compared with, and the readings by their fit.
struct MapImport {
    LightFile light;
    std::string image_file;  ///< name of the image in the bundle
    std::string bytes;       ///< of the image's file
    std::optional<Scene> scene;
    ConventionFits fits;
    std::vector<std::filesystem::path> inputs;  ///< files that were read, which no output may replace
    /// Returns true where the light has view and projection, whose product may be taken in two orders.
    bool has_pair() const;
};

/// Reads an image of a map and its light, and compares all readings with a scene.
/// @param scene built-in key or path; empty: only range and consistency can tell readings apart
/// @param file scene of the file, up axis and unit @throws Error
MapImport read_map_import(const std::filesystem::path& image, const std::filesystem::path& light,
                          const std::string& scene, const FileChoices& file = {});

/// Returns the readings as the dialog lists them, the best first. Numbers are rows of the list, from 1.
std::vector<ImportChoice> reading_choices(const MapImport& map);

/// Writes the bundle of one reading, whole or not at all. Returns remarks about it.
/// @param index of MapImport::fits @throws Error for a refused reading, or where the bundle would replace an input
std::vector<std::string> write_map_import(const MapImport& map, std::size_t index, const std::filesystem::path& output);

}  // namespace si
