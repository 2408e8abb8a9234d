// Table of importers: the file formats that can be opened, and the function that reads each. Table of files of other
// engines that become a bundle before they are opened.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "renderer/gltf/gltf.h"
#include "renderer/scene/scene.h"

namespace si {

/// Importer of a file format for scenes: its name for people, its extensions and its loader. Row of importers().
struct Importer {
    std::string_view label;                                                        ///< "glTF"
    std::span<const std::string_view> extensions;                                  ///< lower case, with the dot: ".glb"
    Scene (*load)(const std::filesystem::path& path, const GltfOptions& options);  ///< throws Error, as load_gltf()
};

/// Returns the table of importers, one for each format of scene files, in the order in which texts list them.
std::span<const Importer> importers();

/// Returns the importer of a scene file by its extension, in upper or lower case; null: no importer reads such files.
const Importer* find_importer(const std::filesystem::path& path);

/// Returns the names of all file formats that can be opened as a scene: "glTF, OBJ, FBX, others by Assimp".
std::string importer_labels();

/// Returns the extensions of the most common scene files, and a note on others: ".gltf, .glb, .obj, others by Assimp".
std::string importer_extensions();

/// Kind of a file from another engine: the capture of a frame, or the image of a shadow map.
enum class FrameFileKind { Capture, MapImage };

/// Kind of file with another engine's frame, such as a RenderDoc capture: its name for people, extensions, and a
/// command. The command converts the file to a bundle (one frame of an engine as files) before it is opened.
struct FrameFile {
    std::string_view label;                        ///< "RenderDoc capture"
    std::span<const std::string_view> extensions;  ///< lower case, with the dot: ".rdc"
    FrameFileKind kind = FrameFileKind::Capture;
    std::string_view command;  ///< command line that makes the bundle, with FILE for the file
};

/// Returns the table of the kinds of files that hold another engine's frame, such as RenderDoc captures. A command
/// converts such a file to a bundle (one frame of an engine as files) before it is opened.
std::span<const FrameFile> frame_files();

/// Returns the row of frame_files() for a file, by its extension in upper or lower case; null: the table has no such
/// extension.
const FrameFile* find_frame_file(const std::filesystem::path& path);

}  // namespace si
