#include "renderer/importers/frame_files.h"

#include <algorithm>

#include "renderer/base/lower_case.h"

namespace si {
namespace {

constexpr std::string_view kCapture[] = {".rdc"};
constexpr std::string_view kMapImage[] = {".pfm", ".exr", ".png", ".raw"};

constexpr FrameFile kFrameFiles[] = {
    {"RenderDoc capture", kCapture, FrameFileKind::Capture, "import-capture FILE -o NAME.bundle"},
    {"image of a map", kMapImage, FrameFileKind::MapImage, "import-map FILE --light LIGHT.json -o NAME.bundle"},
};

}  // namespace

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
