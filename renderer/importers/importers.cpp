#include "renderer/importers/importers.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "renderer/base/lower_case.h"
#include "renderer/bundle/bundle_files.h"
#include "renderer/importers/assimp.h"
#include "renderer/importers/bundle.h"

namespace si {
namespace {

constexpr std::string_view kGltf[] = {".gltf", ".glb", ".vrm"};
constexpr std::string_view kBundle[] = {".bundle", ".zip"};
constexpr std::string_view kObj[] = {".obj"};
constexpr std::string_view kFbx[] = {".fbx"};
constexpr std::string_view kCollada[] = {".dae", ".zae"};
constexpr std::string_view kPly[] = {".ply"};
constexpr std::string_view kStl[] = {".stl"};
constexpr std::string_view k3ds[] = {".3ds"};
constexpr std::string_view kX3d[] = {".x3d"};
constexpr std::string_view kOff[] = {".off"};
constexpr std::string_view kX[] = {".x"};
// Of these only .ac has been compared with a glTF twin.
constexpr std::string_view kOthers[] = {".3mf", ".ac",  ".amf", ".ase",  ".b3d", ".blend", ".cob",     ".dxf",
                                        ".hmp", ".ifc", ".iqm", ".irr",  ".lwo", ".lws",   ".lxo",     ".md2",
                                        ".md3", ".mdc", ".mdl", ".ms3d", ".nff", ".ogex",  ".md5mesh", ".pmx",
                                        ".q3o", ".sib", ".smd", ".ter",  ".xgl"};
constexpr std::string_view kOthersLabel = "others by Assimp";

constexpr Importer kImporters[] = {
    {"glTF", kGltf, load_gltf},    {"bundle", kBundle, load_bundle},      {"OBJ", kObj, load_by_assimp},
    {"FBX", kFbx, load_by_assimp}, {"COLLADA", kCollada, load_by_assimp}, {"PLY", kPly, load_by_assimp},
    {"STL", kStl, load_by_assimp}, {"3DS", k3ds, load_by_assimp},         {"X3D", kX3d, load_by_assimp},
    {"OFF", kOff, load_by_assimp}, {"DirectX X", kX, load_by_assimp},     {kOthersLabel, kOthers, load_by_assimp},
};

constexpr std::string_view kCapture[] = {".rdc"};
constexpr std::string_view kMapImage[] = {".pfm", ".exr", ".png", ".raw"};

constexpr FrameFile kFrameFiles[] = {
    {"RenderDoc capture", kCapture, FrameFileKind::Capture, "import-capture FILE -o NAME.bundle"},
    {"image of a map", kMapImage, FrameFileKind::MapImage, "import-map FILE --light LIGHT.json -o NAME.bundle"},
};

}  // namespace

std::span<const Importer> importers() {
    return kImporters;
}

const Importer* find_importer(const std::filesystem::path& path) {
    // Also the folder of a bundle, with and without a slash at its end, and its frame.json.
    const std::string extension = is_bundle_path(path) ? ".bundle" : lower_extension(path);
    for (const Importer& importer : kImporters)
        if (std::ranges::find(importer.extensions, extension) != importer.extensions.end()) return &importer;
    return nullptr;
}

std::string importer_labels() {
    std::vector<std::string_view> labels;
    for (const Importer& importer : kImporters) labels.push_back(importer.label);
    return fmt::format("{}", fmt::join(labels, ", "));
}

std::string importer_extensions() {
    std::vector<std::string_view> extensions;
    for (const Importer& importer : kImporters)
        if (importer.label != kOthersLabel)
            extensions.insert(extensions.end(), importer.extensions.begin(), importer.extensions.end());
    extensions.push_back(kOthersLabel);
    return fmt::format("{}", fmt::join(extensions, ", "));
}

std::span<const FrameFile> frame_files() {
    return kFrameFiles;
}

const FrameFile* find_frame_file(const std::filesystem::path& path) {
    const std::string extension = lower_extension(path);
    for (const FrameFile& row : kFrameFiles)
        if (std::ranges::find(row.extensions, extension) != row.extensions.end()) return &row;
    return nullptr;
}

}  // namespace si
