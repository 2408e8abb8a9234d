// Image of one shadow map of another engine with the readings that its convention may have, and the bundle of one.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/bundle/conventions.h"
#include "renderer/bundle/light_file.h"
#include "renderer/scene/scene.h"
#include "ui/panels/import_dialog.h"

namespace si {

// Words of the options that choose a reading: the conventions (Convention) that the file is taken to follow.
inline constexpr std::array<std::pair<std::string_view, MatrixOrder>, 2> kMatrixKeys{
    {{"columns", MatrixOrder::Columns}, {"rows", MatrixOrder::Rows}}};
inline constexpr std::array<std::pair<std::string_view, ProductOrder>, 2> kProductKeys{
    {{"projection-view", ProductOrder::ProjectionView}, {"view-projection", ProductOrder::ViewProjection}}};
inline constexpr std::array<std::pair<std::string_view, MirroredAxis>, 4> kMirroredKeys{
    {{"none", MirroredAxis::None}, {"x", MirroredAxis::X}, {"y", MirroredAxis::Y}, {"z", MirroredAxis::Z}}};

/// Returns the word of a part of a reading. @param table pairs of word and value, such as bundle::kUpKeys
template <typename Table, typename T>
std::string_view convention_word(const Table& table, const T& value) {
    for (const auto& [key, own] : table)
        if (own == value) return key;
    return "?";
}

/// Image of a map with its light, the scene that it is compared with, and the readings by their fit.
struct MapImport {
    LightFile light;
    std::string image_file;       ///< name of the image in the bundle
    std::string bytes;            ///< of the image's file
    int width = 0, height = 0;    ///< of the image, texels
    std::optional<FirstRow> row;  ///< first row as taken without a scene, which nobody states
    std::optional<Scene> scene;
    ConventionFits fits;
    std::vector<std::filesystem::path> inputs;  ///< files that were read, which no output may replace
    /// Returns true where the light has view and projection, whose product may be taken in two orders.
    bool has_pair() const;
};

/// Reads an image of a map and its light, and compares all readings with a scene.
/// @param scene built-in key or path; empty: only range and consistency can tell readings apart
/// @param stated parts that the user states, which go before those of the light's file
/// @param file scene of the file, up axis and unit @throws Error
MapImport read_map_import(const std::filesystem::path& image, const std::filesystem::path& light,
                          const std::string& scene, const KnownConvention& stated = {}, const FileChoices& file = {});

/// Returns the options of the command `import-map` that choose a reading.
/// @param has_pair true where the light has view and projection, so that the order of their product is an option too
std::string convention_options(const Convention& convention, bool has_pair);
/// Returns axes, hand and unit in a few words: "z up, x mirrored, 0.01".
std::string axes_words(const LightAxes& axes);

/// Returns the readings as the dialog lists them, the best first. Numbers are rows of the list, from 1.
/// @throws Error where all are refused
std::vector<ImportChoice> reading_choices(const MapImport& map);

/// Writes the bundle of a map under one reading (Convention), whole or not at all. Returns remarks about the bundle.
/// @param index number of the reading in MapImport::fits, from 0
/// @throws Error for a refused reading, or where the bundle would replace an input
std::vector<std::string> write_map_import(const MapImport& map, std::size_t index, const std::filesystem::path& output);

}  // namespace si
