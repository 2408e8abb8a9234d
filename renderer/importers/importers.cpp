#include "renderer/importers/importers.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "renderer/base/lower_case.h"

namespace si {
namespace {

constexpr std::string_view kGltf[] = {".gltf", ".glb", ".vrm"};

constexpr Importer kImporters[] = {
    {"glTF", kGltf, load_gltf},
};

}  // namespace

std::span<const Importer> importers() {
    return kImporters;
}

const Importer* find_importer(const std::filesystem::path& path) {
    const std::string extension = lower_extension(path);
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
        extensions.insert(extensions.end(), importer.extensions.begin(), importer.extensions.end());
    return fmt::format("{}", fmt::join(extensions, ", "));
}

}  // namespace si
