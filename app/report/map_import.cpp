#include "app/report/map_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "renderer/base/error.h"
#include "renderer/base/lower_case.h"
#include "renderer/base/printable.h"
#include "renderer/base/regular_file.h"
#include "renderer/bundle/bundle_files.h"
#include "renderer/bundle/bundle_json.h"
#include "renderer/bundle/bundle_members.h"
#include "renderer/bundle/given_maps.h"
#include "renderer/bundle/map_image.h"
#include "renderer/gltf/gltf.h"
#include "renderer/importers/importers.h"
#include "renderer/projection/view_of_matrix.h"
#include "renderer/reference/first_surface.h"
#include "renderer/scene/ground.h"
#include "renderer/scenes/builtin.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxImageBytes = std::size_t{2} << 30;
constexpr std::size_t kMaxReadings = 48;

/// Formats a reading for a list: "range 0..1, reversed, first row bottom, matrix in columns, stored depth".
std::string reading_text(const Convention& c, bool has_pair) {
    std::string out =
        fmt::format("range {}{}, first row {}, matrix in {}", convention_word(bundle::kRangeKeys, c.depth.zero_to_one),
                    c.depth.reversed ? ", reversed" : "", convention_word(bundle::kFirstRowKeys, c.first_row),
                    convention_word(kMatrixKeys, c.matrix));
    if (has_pair) out += c.product == ProductOrder::ProjectionView ? ", projection × view" : ", view × projection";
    out += fmt::format(", stored {}", convention_word(bundle::kStoredKeys, c.stored));
    return c.axes == LightAxes() ? out : fmt::format("{}, light in {}", out, axes_words(c.axes));
}

/// Returns known parts with those that the user states in their place.
KnownConvention with_stated(KnownConvention known, const KnownConvention& stated) {
    const auto take = [](auto& part, const auto& own) {
        if (own) part = own;
    };
    take(known.zero_to_one, stated.zero_to_one);
    take(known.reversed, stated.reversed);
    take(known.first_row, stated.first_row);
    take(known.matrix, stated.matrix);
    take(known.product, stated.product);
    take(known.stored, stated.stored);
    take(known.up, stated.up);
    take(known.mirrored, stated.mirrored);
    take(known.unit, stated.unit);
    return known;
}

/// Returns the surfaces of a scene that maps are compared with.
FirstCasters surfaces_of(const Scene& scene, const glm::dmat4& world) {
    Scene placed = scene;
    if (world != glm::dmat4(1)) place(placed, world);
    const auto geometry = std::make_shared<const ReferenceGeometry>(placed, Settings());
    const auto rays = std::make_shared<const ReferenceScene>(geometry, workers_with_progress());
    return [rays](std::span<const MapRay> map_rays) {
        std::vector<LightRaySegment> segments;
        for (const MapRay& ray : map_rays) segments.push_back({ray.from_ws, ray.to_ws});
        return first_caster_distances(*rays, segments);
    };
}

}  // namespace

bool MapImport::has_pair() const {
    const BundleMatrix& clip = light.bundle.lights.front().maps.front().clip;
    return clip.view && clip.projection;
}

std::string axes_words(const LightAxes& axes) {
    if (axes == LightAxes()) return "the scene's";
    std::string out = fmt::format("{} up", convention_word(bundle::kUpKeys, axes.up));
    if (axes.mirrored != MirroredAxis::None)
        out += fmt::format(", {} mirrored", convention_word(kMirroredKeys, axes.mirrored));
    if (axes.unit != 1) out += fmt::format(", {:.6g}", axes.unit);
    return out;
}

std::string convention_options(const Convention& c, bool has_pair) {
    std::string out =
        fmt::format("--depth-range {} --reversed {} --first-row {} --matrix {} --stored {}",
                    convention_word(bundle::kRangeKeys, c.depth.zero_to_one), c.depth.reversed,
                    convention_word(bundle::kFirstRowKeys, c.first_row), convention_word(kMatrixKeys, c.matrix),
                    convention_word(bundle::kStoredKeys, c.stored));
    if (has_pair) out += fmt::format(" --product {}", convention_word(kProductKeys, c.product));
    if (c.axes == LightAxes()) return out;
    return out + fmt::format(" --up {} --mirrored {} --unit {:.10g}", convention_word(bundle::kUpKeys, c.axes.up),
                             convention_word(kMirroredKeys, c.axes.mirrored), c.axes.unit);
}

MapImport read_map_import(const fs::path& image_path, const fs::path& light_path, const std::string& scene_name,
                          const KnownConvention& stated, const FileChoices& file) {
    const FrameFile* const kind = find_frame_file(image_path);
    if (!kind || kind->kind != FrameFileKind::MapImage)
        throw Error(fmt::format("{}: is no image of a map; name a .pfm, .exr, .png or .raw file",
                                printable(image_path.string())));
    MapImport out;
    out.inputs = {image_path, light_path};
    out.image_file = "map" + lower_extension(image_path);
    out.light = parse_light_file(read_text_file(light_path), light_path.string(), out.image_file);
    BundleLight& own = out.light.bundle.lights.front();
    const ReadResult bytes = read_regular_file(image_path, kMaxImageBytes);
    if (!bytes.error.empty())
        throw Error(
            fmt::format("{}: {}; name a .pfm, .exr, .png or .raw file", printable(image_path.string()), bytes.error));
    out.bytes = bytes.bytes.text();
    const BundleImage& layout = own.maps.front().image;
    const FloatImage image = decode_map_image(image_path.string(), std::as_bytes(bytes.bytes.span()),
                                              {layout.width, layout.height, layout.channels, layout.format});
    out.width = image.width;
    out.height = image.height;
    for (const BundleMap& map : own.maps)
        if (map.image.channel >= image.channels)
            throw Error(fmt::format("{}: image.channel: channel {} is read, and {} has {}; count from 0",
                                    printable(light_path.string()), map.image.channel, printable(image_path.string()),
                                    image.channels));
    KnownConvention known = with_stated(out.light.known, stated);
    if (scene_name.empty() && !known.first_row) {
        own.maps.front().image.first_row.reset();
        known.first_row = out.row = first_row_of(own.maps.front().image);
    }
    const glm::dmat4 world = world_from_engine(out.light.bundle.world);
    FirstCasters casters;
    if (!scene_name.empty()) {
        GltfOptions options;
        options.file = file;
        out.scene = load_scene(scene_name, options);
        for (const StampedFile& read : out.scene->files) out.inputs.emplace_back(read.path);
        remove_ground(*out.scene);
        casters = surfaces_of(*out.scene, world);
    }
    out.fits = fit_conventions(own, out.light.type_known, world, image, known, casters);
    return out;
}

std::vector<ImportChoice> reading_choices(const MapImport& map) {
    if (std::ranges::none_of(map.fits.fits, [](const ConventionFit& fit) { return fit.refusal.empty(); }))
        throw Error(fmt::format("{}: no reading of the matrix is that of the light: {}",
                                printable(map.inputs.at(1).string()),
                                map.fits.fits.empty() ? "there is none" : map.fits.fits.front().refusal));
    std::vector<ImportChoice> out;
    for (std::size_t i = 0; i < map.fits.fits.size() && out.size() < kMaxReadings; ++i) {
        const ConventionFit& fit = map.fits.fits[i];
        ImportChoice choice{.number = int(i) + 1,
                            .text = reading_text(fit.convention, map.has_pair()),
                            .fits = i < map.fits.equal,
                            .usable = fit.refusal.empty()};
        if (choice.usable) {
            choice.fit = fit_sentence(fit, map.fits.over_scene);
            if (!fit.known) choice.fit += "; it contradicts the light's file";
        } else {
            choice.fit = fit.refusal;
        }
        out.push_back(std::move(choice));
    }
    return out;
}

std::vector<std::string> write_map_import(const MapImport& map, std::size_t index, const fs::path& output) {
    if (index >= map.fits.fits.size()) throw Error("no reading of the map is chosen; choose one of the list");
    const ConventionFit& fit = map.fits.fits[index];
    if (!fit.refusal.empty()) throw Error(fit.refusal);
    require_bundle_name(output.string());
    require_outputs_not_read(std::vector<fs::path>{output}, map.inputs);
    require_bundle_not_read(output, map.inputs);
    Bundle bundle = map.light.bundle;
    BundleLight& own = bundle.lights.front();
    own = with_convention(own, fit.convention);
    if (!map.light.type_known) {
        const BundleMap& first = own.maps.front();
        const glm::dmat4 world = world_from_engine(bundle.world);
        const LightView view = view_of_matrix(first.clip.matrix() * glm::inverse(world), first.depth.convention);
        own.type = view.curve.perspective ? LightType::Spot : LightType::Directional;
    }
    bundle.made_by = "import-map";
    const std::string taken = fmt::format("{}: {}", convention_options(fit.convention, map.has_pair()),
                                          fit_sentence(fit, map.fits.over_scene));
    bundle.notes.push_back(taken);
    BundleContents contents;
    contents[map.image_file] = map.bytes;
    std::vector<std::string> notes = {taken};
    if (map.scene) {
        Scene scene = *map.scene;
        bundle.scene = "scene.glb";
        scene.suggested.clear();
        contents[bundle.scene] = glb_bytes(scene);
        for (const std::string& note : export_notes(scene)) notes.push_back(note);
    }
    contents[std::string(kFrameJson)] = format_bundle(bundle);
    write_bundle_files(contents, output);
    return notes;
}

}  // namespace si
