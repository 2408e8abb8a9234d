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

/// Returns the word that options use for one part of a shadow map's convention, such as "rows" for MatrixOrder::Rows;
/// "?" if the table lacks it. @param table pairs of word and value, such as kMatrixKeys
template <typename Table, typename T>
std::string_view convention_word(const Table& table, const T& value) {
    for (const auto& [key, own] : table)
        if (own == value) return key;
    return "?";
}

/// Shadow map of another engine to be imported: its image, its light, and the scene. The map may be read under several
/// conventions; `fits` ranks them.
struct MapImport {
    LightFile light;
    std::string image_file;       ///< name of the image in the bundle
    std::string bytes;            ///< of the image's file
    int width = 0, height = 0;    ///< of the image, texels
    std::optional<FirstRow> row;  ///< assumed first row; nullopt: known, or found by the scene
    std::optional<Scene> scene;
    ConventionFits fits;
    std::vector<std::filesystem::path> inputs;  ///< files that were read, which no output may replace
    /// Returns true if the light has separate view and projection matrices, so that the order of their product may be
    /// unknown.
    bool has_pair() const;
};

/// Reads a shadow map's image and its light, tries all conventions under which the map may be read, and compares each
/// with a scene.
/// @param scene built-in key or path; empty: only range and consistency can tell conventions apart
/// @param stated parts of the convention that the user states, which go before those that the file `light` states
/// @param file choices for the scene's file: index of its scene, up axis and unit @throws Error
MapImport read_map_import(const std::filesystem::path& image, const std::filesystem::path& light,
                          const std::string& scene, const KnownConvention& stated = {}, const FileChoices& file = {});

/// Formats a convention for reading a shadow map as options of the command `import-map`: "--depth-range 0..1 ...".
/// @param has_pair true: the light has separate view and projection matrices. The text then has --product, the order in
/// which they are multiplied.
std::string convention_options(const Convention& convention, bool has_pair);
/// Formats axes, mirroring and length unit of a light's file (JSON with the light of an imported map) in a few words.
/// Example: "z up, x mirrored, 0.01", where 0.01 is the unit. Returns "the scene's" if all three equal those of the
/// scene.
std::string axes_words(const LightAxes& axes);

/// Lists the conventions under which an imported shadow map may be read, for the import dialog. The best fit comes
/// first. ImportChoice::number is the place in the list, from 1.
/// @throws Error if the light's matrix fits none of them
std::vector<ImportChoice> reading_choices(const MapImport& map);

/// Writes an imported shadow map, read under one convention, as a bundle (the files of one frame). The bundle appears
/// whole or not at all. Returns remarks for the user.
/// @param index index of the convention in MapImport::fits @param output bundle to write
/// @throws Error for a refused convention, or if the bundle would replace an input
std::vector<std::string> write_map_import(const MapImport& map, std::size_t index, const std::filesystem::path& output);

}  // namespace si
