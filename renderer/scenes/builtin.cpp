#include "renderer/scenes/builtin.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "renderer/base/did_you_mean.h"
#include "renderer/base/error.h"
#include "renderer/base/lower_case.h"
#include "renderer/base/printable.h"
#include "renderer/importers/importers.h"
#include "renderer/scenes/hard_cases.h"
#include "renderer/scenes/makers.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

constexpr BuiltinScene kScenes[] = {
    {"stage", "Stage",
     "Fence, leaves, single-plane wall, ramp, distant box and a figure: acne, peter-panning and aliasing at once",
     make_stage_scene},
    {"boxes", "Floor and boxes", "Boxes that stand on, hover over and lean against a floor", make_boxes_scene},
    {"teapot", "Teapot", "Newell's teapot from its Bezier patches on a floor: curved, self-shadowing, open at the lid",
     make_teapot_scene},
    {"plane", "Plane from 1 m to 100 m",
     "One striped plane across the picture, from 1 m at its bottom to 100 m at its top: how depth values share the "
     "range",
     make_plane_scene},
    {"landscape", "Landscape", "Two kilometres of hills, trees and a village: too large for one shadow map",
     make_landscape_scene},
    {"figures", "Figures", "Three jointed figures among simple objects", make_figures_scene},
    {"relief", "Relief", "Flat surfaces whose cobbles are a normal map only: bias along normals the map does not know",
     make_relief_scene},
};

}  // namespace

std::span<const BuiltinScene> builtin_scenes() {
    return kScenes;
}

bool is_builtin_scene(std::string_view name) {
    return std::ranges::find(kScenes, name, &BuiltinScene::key) != std::end(kScenes) || find_hard_case(name);
}

Scene load_scene(std::string_view name_or_path, const GltfOptions& options) {
    std::vector<std::string> keys;
    for (const BuiltinScene& row : kScenes) {
        if (row.key == name_or_path) return row.make();
        keys.emplace_back(row.key);
    }
    if (name_or_path.starts_with(kHardPrefix)) {
        if (const auto view = find_hard_case(name_or_path)) return view->scene();
        for (const HardCaseView& view : hard_case_views()) keys.push_back(view.name());
    }
    const std::filesystem::path path{std::string(name_or_path)};
    if (const Importer* importer = find_importer(path)) return importer->load(path, options);
    if (const FrameFile* row = find_frame_file(path))
        throw UsageError(fmt::format("cannot open '{}': files that end in {} become a bundle first, by {}",
                                     printable(name_or_path), lower_extension(path), row->command));
    if (path.has_extension())
        throw UsageError(fmt::format("cannot open '{}': files that end in {} are not read; models end in {}",
                                     printable(name_or_path), printable(path.extension().string()),
                                     importer_extensions()));
    throw UsageError(fmt::format("no scene '{}': there is no built-in one of that name, and models end in {}{}",
                                 printable(name_or_path), importer_extensions(),
                                 did_you_mean(nearest_name(name_or_path, keys))));
}

}  // namespace si
