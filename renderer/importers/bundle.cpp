#include "renderer/importers/bundle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <utility>

#include "renderer/base/angles.h"
#include "renderer/base/error.h"
#include "renderer/base/printable.h"
#include "renderer/bundle/conventions.h"
#include "renderer/bundle/drawn_casters.h"
#include "renderer/bundle/given_maps.h"
#include "renderer/bundle/height_field.h"
#include "renderer/projection/camera_of_matrix.h"
#include "renderer/scene/scene_lights.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

namespace fs = std::filesystem;

/// Suggestions of a scene that a bundle makes, each a valid value of a setting.
class Suggestions {
public:
    Suggestions(Scene& scene, std::string file) : scene_(scene), file_(std::move(file)) {}

    /// Suggests a value; one that its setting does not take becomes a warning.
    void add(const std::string& key, const std::string& value) {
        try {
            Settings unused;
            set_setting(unused, key, value);
            std::erase_if(scene_.suggested, [&](const auto& row) { return row.first == key; });
            scene_.suggested.emplace_back(key, value);
        } catch (const UsageError& error) {
            warn(fmt::format("{}; it stays as it is", error.what()));
        }
    }
    void add(const std::string& key, double value) { add(key, fmt::format("{}", value)); }
    /// Suggests a value that the bundle states for a place; one that its setting does not take is an error.
    void require(const std::string& place, const std::string& key, const std::string& value) {
        try {
            Settings unused;
            set_setting(unused, key, value);
        } catch (const UsageError& error) {
            throw Error(fmt::format("{}: {}: {}", file_, printable(place), error.what()));
        }
        add(key, value);
    }
    void warn(const std::string& sentence) { scene_.warnings.push_back(sentence); }

private:
    Scene& scene_;
    std::string file_;
};

/// Calls `work` with each map of a bundle.
template <typename Work>
void for_each_map(const Bundle& bundle, const Work& work) {
    for (const BundleLight& light : bundle.lights)
        for (const BundleMap& map : light.maps) work(map);
}

/// Returns the first value that some map has, and whether all maps have the same.
template <typename T, typename Member>
std::pair<std::optional<T>, bool> shared_value(const Bundle& bundle, const Member& member) {
    std::optional<T> first;
    bool same = true, any = false;
    for_each_map(bundle, [&](const BundleMap& map) {
        const std::optional<T> value = member(map);
        if (!any) first = value;
        same = same && value == first;
        any = true;
    });
    return {first, same};
}

SceneCamera scene_camera_of(const BundleCamera& camera, const glm::dmat4& world, std::vector<std::string>& warnings) {
    const MatrixCamera found = camera_of_matrix(camera.clip.matrix() * glm::inverse(world), camera.depth);
    SceneCamera out;
    out.name = "picture";
    out.world = glm::dmat4(found.axes);
    out.world[3] = glm::dvec4(found.eye, 1);
    out.home = out.world;
    out.orthographic = found.orthographic;
    out.fov_y_deg = found.fov_y_rad() / kDegree;
    const glm::dvec2 size = found.hi - found.lo;
    out.height = size.y;
    out.near = found.orthographic ? 0 : found.near;
    out.far = found.orthographic ? 0 : found.far;
    if (found.is_off_axis())
        warnings.push_back("camera: its projection is off the axis; the picture's camera is the nearest symmetric one");
    const double aspect = double(camera.width) / camera.height;
    if (std::abs(size.x / size.y - aspect) > 0.01 * aspect)
        warnings.push_back(fmt::format(
            "camera: pixels of the engine's picture are {:.3g} times as wide as high; they are drawn square",
            size.x / size.y / aspect));
    return out;
}

/// Returns the view from which the place of a light follows; the default for a light without a map.
LightView first_view_of(const ImportedMaps* maps) {
    return maps ? maps->views->views.front() : LightView();
}

SceneLight scene_light_of(const BundleLight& light, const ImportedMaps* maps, const glm::dmat4& world) {
    const LightView view = first_view_of(maps);
    SceneLight out;
    out.name = light.name;
    out.type = light.type;
    const glm::dvec3 shines = light.direction ? glm::dmat3(world) * *light.direction : glm::dvec3(-view.axes[2]);
    const glm::dvec3 back = -glm::normalize(shines);
    const glm::dvec3 aside = std::abs(back.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(aside, back));
    out.world = glm::dmat4(glm::dmat3(right, glm::cross(back, right), back));
    out.world[3] = glm::dvec4(light.position ? glm::dvec3(world * glm::dvec4(*light.position, 1)) : view.eye, 1);
    if (light.type == LightType::Spot) {
        const glm::dvec2 half = view.half_extents();
        const double from_map = view.curve.perspective ? std::atan(std::min(half.x, half.y)) : 45 * kDegree;
        out.outer_cone_rad = light.cone_deg ? 0.5 * *light.cone_deg * kDegree : from_map;
        out.inner_cone_rad = 0.9 * out.outer_cone_rad;
    }
    return out;
}

/// Returns an amount of polygon offset as bias.raster_* count it: above 0 is away from the light.
std::optional<double> away_from_light(const BundleMap& map, const std::optional<double>& as_drawn) {
    if (!as_drawn || *as_drawn == 0 || !map.depth.convention.reversed) return as_drawn;
    return -*as_drawn;
}

void suggest_map_settings(const Bundle& b, const GivenMaps& maps, Suggestions& to) {
    const auto [reversed, same_direction] =
        shared_value<bool>(b, [](const BundleMap& m) { return std::optional(m.depth.convention.reversed); });
    if (!same_direction) throw Error("some maps have reversed depth and others have not; give bundles of their own");
    to.add("map.reversed_z", *reversed ? "true" : "false");
    const auto [format, same_format] =
        shared_value<BundleDepthFormat>(b, [](const BundleMap& m) { return std::optional(m.depth.format); });
    to.add("map.format", *format == BundleDepthFormat::D16   ? "d16"
                         : *format == BundleDepthFormat::D24 ? "d24"
                                                             : "d32f");
    if (!same_format) to.warn("the maps have several formats; map.format is that of the first");
    if (*format == BundleDepthFormat::R16F)
        to.warn("depth.format r16f has no counterpart: map.format is d32f, whose steps are finer");
    const auto with_map = std::ranges::find_if(maps.lights, [](const auto& light) { return light != nullptr; });
    to.add("map.resolution", fmt::format("{}", (*with_map)->size().longest()));
    const auto shared = [&](const char* key, const char* name, const auto& member) {
        using T = typename std::invoke_result_t<decltype(member), const BundleMap&>::value_type;
        const auto [value, same] = shared_value<T>(b, member);
        if (!same) to.warn(fmt::format("the maps differ in raster.{}; {} is that of the first", name, key));
        return value;
    };
    if (const auto v = shared("bias.raster_slope", "offset_factor",
                              [](const BundleMap& m) { return away_from_light(m, m.raster.offset_factor); }))
        to.add("bias.raster_slope", *v);
    if (const auto v = shared("bias.raster_units", "offset_units",
                              [](const BundleMap& m) { return away_from_light(m, m.raster.offset_units); }))
        to.add("bias.raster_units", *v);
    if (const auto v = shared("bias.raster_clamp", "offset_clamp",
                              [](const BundleMap& m) { return away_from_light(m, m.raster.offset_clamp); }))
        to.add("bias.raster_clamp", *v);
    if (const auto v = shared("caster.cull", "cull", [](const BundleMap& m) { return m.raster.cull; }))
        to.add("caster.cull", *v == Cull::None ? "none" : *v == Cull::Back ? "back" : "front");
}

/// Suggests that casters of double-sided materials keep both faces, as engines draw them, where maps cull others.
/// Settings of the bundle that state the culling, as those of exported frames do, count instead.
void suggest_double_sided(const Bundle& b, const Scene& scene, Suggestions& to) {
    const auto culls = [](const BundleMap& map) { return map.raster.cull && *map.raster.cull != Cull::None; };
    if (b.settings.contains("caster.cull") ||
        std::ranges::none_of(b.lights, [&](const BundleLight& l) { return std::ranges::any_of(l.maps, culls); }))
        return;
    for (const Object& object : scene.objects) {
        const int material = scene.meshes[std::size_t(object.mesh)].material;
        if (material < 0 || !scene.materials[std::size_t(material)].double_sided) continue;
        to.add("object." + scene.nodes[std::size_t(object.node)].path + ".cull", "none");
    }
}

/// @param in_settings the settings of the bundle state the bias
void suggest_bias(const BundleBias& bias, const std::string& place, bool in_settings, Suggestions& to) {
    constexpr std::string_view kUnits[] = {"depth", "texels", "metres"};
    const auto unit_key = [&](BiasUnit unit) {
        return std::string(kUnits[unit == BiasUnit::Depth ? 0 : unit == BiasUnit::Texels ? 1 : 2]);
    };
    if (bias.constant || bias.slope) {
        // The kind brings starting values along, so it comes first.
        to.add("bias.kind", bias.slope ? "slope" : "constant");
        to.add("bias.unit", unit_key(bias.constant ? bias.units[0] : bias.units[1]));
        to.add("bias.constant", bias.constant.value_or(0));
        if (bias.slope && bias.constant && bias.units[0] != bias.units[1])
            to.warn(fmt::format("{}.bias: constant and slope have different units; bias.slope is left out", place));
        else if (bias.slope)
            to.add("bias.slope", *bias.slope);
    }
    if (bias.normal) {
        const auto settings = normal_offset_settings(bias);
        for (const auto& [key, value] : settings) to.add(std::string(key), value);
        if (settings.empty())
            to.warn(fmt::format("{}.bias: a normal offset in depth is no length; set bias.normal by hand", place));
    }
    std::vector<std::string_view> unknown;
    if (!bias.constant) unknown.push_back("constant");
    if (!bias.slope) unknown.push_back("slope");
    if (!bias.normal) unknown.push_back("normal");
    if (!unknown.empty() && !in_settings)
        to.warn(
            fmt::format("{}.bias: {} {} unknown, and not 0; set bias.* to the engine's values and map.bundle_bias to "
                        "entered before you rely on a verdict",
                        place, fmt::join(unknown, ", "), unknown.size() == 1 ? "is" : "are"));
}

/// Suggests that a comparison blends 2x2 texels, or takes one, as the engine's sampler does.
/// @param linear the sampler's filter is linear @param kernel key of the kernel, valid; nullopt: unknown
void suggest_filter(bool linear, const std::optional<std::string>& kernel, Suggestions& to) {
    to.add("filter.bilinear", linear ? "true" : "false");
    to.add("filter.point", linear ? "false" : "true");
    if (!kernel) return;
    // Kernels of one comparison have no setting for that: each is a row of the table.
    const auto is_single = [](const Filter& row) { return row.square() && row.size == 1; };
    Settings chosen;
    set_setting(chosen, "filter.kernel", *kernel);
    if (!is_single(filter_of(chosen)) || filter_of(chosen).bilinear == linear) return;
    for (const Filter& row : filters())
        if (is_single(row) && row.bilinear == linear) return to.add("filter.kernel", std::string(row.key));
}

void suggest_lookup(const Bundle& b, Suggestions& to) {
    const auto first =
        std::size_t(std::ranges::find_if(b.lights, [](const BundleLight& light) { return !light.maps.empty(); }) -
                    b.lights.begin());
    const BundleLookup& l = b.lights[first].lookup;
    const std::string place = fmt::format("lights[{}].lookup", first);
    for (std::size_t i = first + 1; i < b.lights.size(); ++i)
        if (!b.lights[i].maps.empty() && !(b.lights[i].lookup == l)) {
            to.warn("the lights differ in their look-up; the settings are those of the first light");
            break;
        }
    if (l.kernel)
        to.require(place + ".kernel", "filter.kernel", *l.kernel);
    else
        to.warn(place + ".kernel: the kernel is unknown; choose the nearest at filter.kernel");
    if (l.filter) suggest_filter(*l.filter == BundleFilter::Linear, l.kernel, to);
    if (l.compare) {
        const bool greater = *l.compare == BundleCompare::Greater || *l.compare == BundleCompare::GreaterEqual;
        const bool equal = *l.compare == BundleCompare::LessEqual || *l.compare == BundleCompare::GreaterEqual;
        to.add("map.compare", equal ? "lequal" : "less");
        if (greater != b.lights[first].maps.front().depth.convention.reversed)
            to.warn(place + ".compare: it suits the other direction of depth; check depth.reversed of the maps");
    }
    if (l.wrap)
        to.add("map.wrap", *l.wrap == BundleWrap::Border  ? "border"
                           : *l.wrap == BundleWrap::Clamp ? "clamp"
                                                          : "repeat");
    suggest_bias(l.bias, place, settings_state_bias(b), to);
}

/// Lets nodes that no map holds cast no shadow, where all maps list what was drawn.
void suggest_casters_drawn(const Bundle& b, const Scene& scene, Suggestions& to) {
    std::set<std::string> drawn;
    bool all_known = true;
    for_each_map(b, [&](const BundleMap& map) {
        all_known = all_known && map.drawn;
        if (map.drawn) drawn.insert(map.drawn->begin(), map.drawn->end());
    });
    if (!all_known) return;
    const DrawnCasters casters = drawn_casters(scene, drawn);
    for (const std::string& path : casters.left_out) to.add(fmt::format("object.{}.cast", path), "false");
    if (casters.unknown > 0)
        to.warn(fmt::format("drawn: {} of {} names are no node with triangles of the scene", casters.unknown,
                            drawn.size()));
}

void suggest_cascades(const Bundle& b, Suggestions& to) {
    for (std::size_t i = 0; i < b.lights.size(); ++i) {
        const BundleLight& light = b.lights[i];
        if (light.maps.empty()) to.add(light_setting_key(i, "cast"), "false");
        const ViewChoice choice = choice_of(light);
        if (light.type != LightType::Directional || light.maps.size() < 2) continue;
        to.add(light_setting_key(i, "cascades"),
               fmt::format("{}", std::min<std::size_t>(light.maps.size(), kMaxCascades)));
        to.add(light_setting_key(i, "cascade_choice"), choice == ViewChoice::Map ? "map" : "interval");
        to.add(light_setting_key(i, "fit"), "view");
    }
}

/// Reads a file that the scene's glTF file names. @param scene path of the glTF file in the bundle
ReadResult read_beside(BundleFiles& files, const std::string& scene, const std::string& name, std::size_t max_bytes) {
    try {
        const fs::path folder = fs::path(scene).parent_path();
        const std::vector<std::byte> bytes = files.read((folder / name).lexically_normal().generic_string(), max_bytes);
        ReadResult out{Bytes(bytes.size()), {}};
        if (!bytes.empty()) std::memcpy(out.bytes.data.get(), bytes.data(), bytes.size());
        return out;
    } catch (const Error& error) {
        return {{}, fmt::format("cannot be read: {}", error.what())};
    }
}

/// Returns the surface that the first map of a bundle shows. @param file name of frame.json, for messages
Scene surface_of_first_map(const GivenMaps& maps, const std::string& file) {
    for (std::size_t i = 0; i < maps.lights.size(); ++i) {
        if (!maps.lights[i]) continue;
        const BundleDepthFormat format = maps.bundle.lights[i].maps.front().depth.format;
        try {
            return height_field_scene(maps.lights[i]->views->views.front(), maps.lights[i]->images.front(),
                                      {.depth_step = depth_step(format)});
        } catch (const Error& error) {
            throw Error(fmt::format("{}: lights[{}].maps[0]: {}", file, i, error.what()));
        }
    }
    throw Error(fmt::format("{}: the bundle has neither scene nor map; name a .glb or .gltf file as scene", file));
}

/// Loads the scene of a bundle, in metres, y up.
Scene load_bundle_scene(BundleFiles& files, const Bundle& b, const GltfOptions& options) {
    const std::vector<std::byte> bytes = files.read(b.scene, options.max_file_bytes);
    GltfOptions inner = options;
    inner.file = {.scene = options.file.scene};
    inner.world = world_from_engine(b.world);
    inner.read_file = [&](const std::string& name, std::size_t max_bytes) {
        return read_beside(files, b.scene, name, max_bytes);
    };
    return load_gltf_bytes({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, files.label(b.scene),
                           inner);
}

}  // namespace

Scene load_bundle(const fs::path& path, const GltfOptions& options) {
    BundleFiles files(path);
    const std::shared_ptr<const GivenMaps> maps = given_maps(path);
    const Bundle& b = maps->bundle;
    const std::string file = files.label(kFrameJson);
    const glm::dmat4 world = world_from_engine(b.world);
    Scene scene = b.scene.empty() ? surface_of_first_map(*maps, file) : load_bundle_scene(files, b, options);
    scene.name = path.string();
    scene.about =
        fmt::format("Frame{}; {}", b.made_by.empty() ? "" : " written by " + printable(b.made_by, 120), scene.about);
    scene.files = maps->files;
    for (StampedFile& read : files.files_read())
        if (std::ranges::find(scene.files, read.path, &StampedFile::path) == scene.files.end())
            scene.files.push_back(std::move(read));
    if (options.file.up != UpAxis::File || options.file.unit > 0)
        scene.warnings.push_back("scene.up and scene.unit have no effect: the bundle states its world");
    scene.warnings.insert(scene.warnings.end(), maps->notes.begin(), maps->notes.end());
    for (const std::string& note : b.notes) scene.warnings.push_back("note of the writer: " + printable(note, 500));

    // Exported scenes suggest lights of their own.
    std::erase_if(scene.suggested, [](const auto& row) { return row.first.starts_with("light."); });
    scene.lights.clear();
    for (std::size_t i = 0; i < b.lights.size(); ++i)
        scene.lights.push_back(scene_light_of(b.lights[i], maps->lights[i].get(), world));
    suggest_lights(scene);
    scene.lights.clear();
    Suggestions to(scene, file);
    // A bundle of this program says which camera of the scene it shows, and that the scene stands on a ground.
    const auto ground = b.settings.find("scene.ground");
    if (ground == b.settings.end() || ground->second != "auto") scene.file_scenes.clear();
    const bool shows_picture = b.camera && !b.settings.contains("camera.index");
    try {
        if (shows_picture)
            scene.cameras.insert(scene.cameras.begin(), scene_camera_of(*b.camera, world, scene.warnings));
        suggest_map_settings(b, *maps, to);
    } catch (const Error& error) {
        throw Error(fmt::format("{}: {}", file, error.what()));
    }
    suggest_cascades(b, to);
    suggest_lookup(b, to);
    suggest_casters_drawn(b, scene, to);
    suggest_double_sided(b, scene, to);
    for (const auto& [key, value] : b.settings) {
        const auto ref = find_setting(key);
        if (ref && ref->param->file)
            throw Error(fmt::format("{}: settings.{}: a bundle names no file of a setting; remove it", file, key));
        to.require("settings." + key, key, value);
    }
    std::error_code error;
    const fs::path whole = fs::absolute(path, error);
    to.add("map.bundle", (error ? path : whole).lexically_normal().string());
    return scene;
}

}  // namespace si
