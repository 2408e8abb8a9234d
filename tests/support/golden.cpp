#include "tests/support/golden.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>

#include "renderer/base/error.h"
#include "renderer/gltf/textures.h"
#include "renderer/reference/reference_picture.h"
#include "renderer/render/reference_frames.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/param.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"
#include "tests/support/source_tree.h"

namespace si::test {
namespace {

constexpr int kWidth = 128, kHeight = 72;

/// Makes a box and a post on a floor, and a sheet above: shadows that touch their casters and shadows that do not.
Scene still_life() {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f}),
              red = add_material(scene, "red", {0.7f, 0.2f, 0.1f});
    add_object(scene, "floor", -1, add_mesh(scene, "floor", make_plane(9, 9), grey));
    add_object(scene, "box", -1, add_mesh(scene, "box", make_box({1.2, 1.2, 1.2}), red),
               moved(-0.7, 0.6, 0.6) * turned(25));
    add_object(scene, "post", -1, add_mesh(scene, "post", make_box({0.25, 2.2, 0.25}), grey), moved(1.3, 1.1, 0.3));
    add_object(scene, "sheet", -1, add_mesh(scene, "sheet", make_plane(1.2, 1.6), grey), moved(0.1, 1.9, -1.3));
    finalise(scene);
    return scene;
}

/// Common settings of a table's pictures, and further settings of single rows.
struct GoldenTable {
    std::string name;
    std::string key;  ///< key of the setting with these rows as choices
    Sets sets;
    std::map<std::string, Sets, std::less<>> rows = {};
};

const std::vector<GoldenTable>& tables() {
    const Sets cascades = {"light.cascades=3", "camera.distance=6", "camera.elevation=12"};
    const Sets pages = {"map.virtual=true", "map.page_size=16", "map.resolution=256"};
    const Sets few_pages = {"map.virtual=true", "map.page_size=16", "map.resolution=256", "map.page_pool=24"};
    const Sets soft = {"filter.kernel=pcss", "light.size=4", "bias.constant=5"};
    const Sets wrong = {"map.resolution=48", "bias.constant=0.2"};
    static const std::vector<GoldenTable> list = {
        {"sources", "light.source", {"view.overlay=visibility", "map.resolution=128"}},
        {"filters",
         "filter.kernel",
         {"view.overlay=visibility", "light.size=4", "bias.constant=5", "filter.exponent=20"},
         {{"evsm2", {"filter.exponent=8"}}, {"evsm4", {"filter.exponent=8"}}}},
        {"biases",
         "bias.kind",
         {"view.overlay=bias-applied", "view.overlay_range=manual", "view.overlay_min=0", "view.overlay_max=3",
          "view.overlay_opacity=0.6", "map.resolution=48", "light.elevation=25", "bias.constant=0.4",
          "bias.slope=1.2"}},
        {"fits", "light.fit", {"view.overlay=light-uv", "map.resolution=48", "camera.distance=5"}},
        {"splits", "light.split",
         [&] {
             Sets sets = cascades;
             sets.insert(sets.end(), {"view.overlay=cascade", "map.resolution=64", "light.split_1=0.2"});
             return sets;
         }()},
        {"formats",
         "map.format",
         {"view.overlay=depth-difference", "view.overlay_range=manual", "view.overlay_min=-0.0001",
          "view.overlay_max=0.0001", "light.elevation=90"}},
        {"moment-formats", "filter.moment_format", {"view.overlay=visibility", "filter.kernel=msm_hamburger"}},
        {"skies", "shading.sky", {"light.elevation=20"}},
        {"curves", "shading.curve", {"shading.exposure=1"}},
        {"sums", "filter.sums", {"view.overlay=visibility", "filter.kernel=savsm"}},
        {"overlays",
         "view.overlay",
         {},
         {{"artefacts", wrong},
          {"truth-difference", wrong},
          {"bias-window", wrong},
          {"page-level", pages},
          {"page-state", few_pages},
          {"taps", soft},
          {"blocker-gap", soft},
          {"penumbra-width", soft},
          {"contact-gap", {"light.contact=0.4"}},
          {"depth-variance", {"filter.kernel=vsm"}},
          {"invalid-moments", {"filter.kernel=vsm", "filter.moment_format=16-bit", "filter.blur=0"}},
          {"cascade", cascades},
          {"outside-map", {"light.fit=manual", "light.extent=2"}}}},
    };
    return list;
}

GoldenPicture picture_of(const GoldenTable& table, const std::string& row, const Sets& sets) {
    GoldenPicture out{table.name, row, table.key, still_life(), texel_settings("hard", 96, 1.5)};
    const auto set = [&](const Sets& of) { set_all(out.settings, of); };
    set({"camera.distance=6.5", "camera.target_y=0.6", "view.overlay_opacity=1", "shading.sky=plain",
         "shading.curve=plain"});
    set(table.sets);
    if (const auto found = table.rows.find(row); found != table.rows.end()) set(found->second);
    set(sets);
    return out;
}

}  // namespace

std::vector<std::string> golden_tables() {
    std::vector<std::string> out;
    for (const GoldenTable& table : tables()) out.push_back(table.name);
    return out;
}

std::vector<GoldenPicture> golden_pictures(const std::string& table) {
    const auto found = std::ranges::find(tables(), table, &GoldenTable::name);
    if (found == tables().end()) throw Error("there is no table of golden pictures named " + table);
    std::vector<GoldenPicture> out;
    for (const Choice& choice : find_setting(found->key)->param->choices()) {
        const std::string row(choice.key);
        if (row != "none" || table == "sources") out.push_back(picture_of(*found, row, {{found->key, row}}));
    }
    if (table == "biases")  // in addition to bias.kind
        for (const Bias& bias : biases()) {
            const std::string row(bias.key);
            if (bias.stage == BiasStage::LookUp) out.push_back(picture_of(*found, row, {"bias.normal=1.5"}));
            if (bias.stage == BiasStage::Raster)
                out.push_back(picture_of(*found, row, {"bias.raster_slope=1.5", "view.overlay=bias-slack"}));
        }
    return out;
}

ByteImage draw_golden(Renderer& renderer, const GoldenPicture& picture) {
    FrameRequest request{.width = kWidth, .height = kHeight};
    ReferenceCache cache;
    return renderer.read_colour(
        render_with_reference(renderer, picture.scene, picture.settings, request, cache).colour);
}

std::filesystem::path golden_folder() {
    return source_tree() / "tests/golden";
}

std::filesystem::path golden_file(const std::filesystem::path& folder, const GoldenPicture& picture) {
    return folder / (picture.name() + ".png");
}

ByteImage read_golden(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) return {};
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    gltf::Image image = gltf::decode_image({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    if (!image.error.empty()) throw Error(fmt::format("{}: {}", file.string(), image.error));
    return {image.width, image.height, std::move(image.rgba)};
}

ByteImage golden_difference(const ByteImage& a, const ByteImage& b) {
    ByteImage out{a.width, a.height, std::vector<std::uint8_t>(a.data.size(), 255)};
    for (std::size_t i = 0; i + 3 < a.data.size(); i += 4) {
        int most = 0;
        for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(int(a.data[i + c]) - int(b.data[i + c])));
        for (std::size_t c = 0; c < 3; ++c) out.data[i + c] = std::uint8_t(std::min(255, 8 * most));
    }
    return out;
}

}  // namespace si::test
