#include "app/report/frame_bundle.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "app/base/output.h"
#include "renderer/base/error.h"
#include "renderer/bundle/bundle_json.h"
#include "renderer/bundle/given_maps.h"
#include "renderer/bundle/map_image_exr.h"
#include "renderer/gltf/gltf.h"
#include "renderer/projection/view_of_matrix.h"
#include "renderer/scene/ground.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/paging.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

constexpr const char* kScene = "scene.glb";
constexpr const char* kPicture = "picture.png";

glm::dmat4 pose_of(const glm::dmat3& axes, const glm::dvec3& eye) {
    glm::dmat4 out(axes);
    out[3] = glm::dvec4(eye, 1);
    return out;
}

BundleDepthFormat depth_format(MapFormat format) {
    switch (format) {
        case MapFormat::D16:
            return BundleDepthFormat::D16;
        case MapFormat::D24:
            return BundleDepthFormat::D24;
        case MapFormat::D32F:
            return BundleDepthFormat::D32F;
        case MapFormat::Colour:
        case MapFormat::Linear:
        case MapFormat::Linear16:
            return BundleDepthFormat::R32F;
    }
    return BundleDepthFormat::D32F;
}

/// Returns the settings by which the frame reads back, as texts by key: all but those of the scene, of files, and of a
/// bundle that the frame itself reads.
std::map<std::string, std::string> settings_of_frame(const Settings& settings) {
    std::map<std::string, std::string> out;
    for (const SettingRef& ref : all_settings(settings)) {
        const bool is_ground = ref.param->key == "scene.ground";
        if (ref.param->file || ref.param->key.starts_with("map.bundle") ||
            (ref.param->key.starts_with("scene.") && !is_ground))
            continue;
        if (ref.param->scope == Scope::Light && ref.light >= settings.light_count) continue;
        out[setting_key(ref)] = value_text(*ref.param, get_value(settings, ref));
    }
    return out;
}

BundleLookup lookup_of(const Settings& s) {
    BundleLookup out;
    const Bias& bias = bias_of(s);
    const bool is_plain = reads_setting(bias, "bias.constant") || reads_setting(bias, "bias.slope");
    if (is_plain) {
        out.bias.constant = reads_setting(bias, "bias.constant") ? s.bias.constant : 0;
        out.bias.slope = reads_setting(bias, "bias.slope") ? s.bias.slope : 0;
    }
    out.bias.normal = s.bias.normal;
    out.bias.units = {s.bias.unit, s.bias.unit,
                      s.bias.normal_unit == OffsetUnit::Texels ? BiasUnit::Texels : BiasUnit::Metres};
    out.bias.normal_by = s.bias.normal_by;
    out.kernel = std::string(filter_of(s).key);
    const bool equal = s.map.compare == Compare::LessEqual;
    out.compare = s.map.reversed_z ? (equal ? BundleCompare::GreaterEqual : BundleCompare::Greater)
                                   : (equal ? BundleCompare::LessEqual : BundleCompare::Less);
    if (s.map.wrap == MapWrap::Border) out.wrap = BundleWrap::Border;
    if (s.map.wrap == MapWrap::Clamp) out.wrap = BundleWrap::Clamp;
    if (s.map.wrap == MapWrap::Repeat) out.wrap = BundleWrap::Repeat;
    return out;
}

/// @param raster raster state with which the map was drawn; null: as the settings say
BundleMap map_of(const LightView& view, const Settings& s, const CasterRaster* raster) {
    BundleMap out;
    out.image.first_row = FirstRow::Bottom;
    out.clip.world_from_view = pose_of(view.axes, view.eye);
    out.clip.projection = view.projection;
    out.depth.convention = view.curve.convention;
    out.depth.format = depth_format(s.map.format);
    out.depth.planes_m = {view.curve.near, view.curve.far};
    out.depth.warp = view.curve.warp;
    // OpenGL takes the opposite sign for reversed depth, which recedes by lower values.
    const auto as_drawn = [&](double amount) {
        return view.curve.convention.reversed && amount != 0 ? -amount : amount;
    };
    out.raster.offset_factor = as_drawn(s.bias.raster_slope);
    out.raster.offset_units = as_drawn(s.bias.raster_units);
    out.raster.offset_clamp = as_drawn(s.bias.raster_clamp);
    out.raster.cull = s.caster.cull;
    if (raster) {
        out.raster.offset_factor = raster->offset_factor;
        out.raster.offset_units = raster->offset_units;
        out.raster.offset_clamp = raster->offset_clamp;
        if (raster->cull) out.raster.cull = raster->cull;
    }
    if (view.caster_shift.moves()) {
        out.raster.shift_m = view.caster_shift.all_m;
        out.raster.grazing_shift_m = view.caster_shift.grazing_m;
    }
    // The winding in the map of faces that are counter-clockwise as seen from the light.
    out.raster.front = is_mirrored(view) ? BundleFront::Cw : BundleFront::Ccw;
    out.raster.depth_clamp = view.clamps_near;
    return out;
}

/// Sets the limits between which the maps of a light are chosen.
void set_spans(BundleLight& out, const ViewChooser& chooser) {
    for (std::size_t i = 0; i < chooser.spans.size(); ++i) {
        const ViewSpan& span = chooser.spans[i];
        if (chooser.choice == ViewChoice::Map) out.maps[i].edge = {span.blends_from, span.ends};
        if (chooser.choice != ViewChoice::Interval) continue;
        // A blend begins where the next interval does.
        const double from = i > 0 ? chooser.spans[i - 1].blends_from : 0;
        out.maps[i].interval = {from, span.ends};
    }
}

/// @param given the light's given or redrawn maps; null: the program's own
BundleLight light_of(const FittedLight& light, const LightSettings& own, const Settings& s, const ImportedMaps* given) {
    BundleLight out;
    out.name = own.name;
    out.type = light.type;
    out.direction = -light.to_light;
    if (light.type != LightType::Directional) out.position = light.position;
    if (light.type == LightType::Spot) out.cone_deg = own.cone;
    if (!light.casts) return out;
    out.choice = light.chooser.choice;
    out.closed = light.closed;
    for (std::size_t v = 0; v < light.views.size(); ++v)
        out.maps.push_back(map_of(light.views[v], s, given && v < given->raster.size() ? &given->raster[v] : nullptr));
    set_spans(out, light.chooser);
    out.lookup = lookup_of(s);
    return out;
}

}  // namespace

Scene written_scene(const Scene& shown) {
    Scene out = shown;
    hide_objects(out, {});
    remove_ground(out);
    return out;
}

BundleContents frame_bundle(Renderer& renderer, const Scene& shown, const Settings& settings, FrameRequest request,
                            MapFile maps) {
    if (draws_pages(settings)) throw Error("map.virtual: a bundle holds whole maps; set map.virtual to false");
    request.outputs.colour = request.outputs.shadow_map = true;
    request.with_look = false;
    const FrameResult frame = renderer.render(shown, settings, request);
    const Camera& camera = frame.camera;
    Bundle bundle;
    bundle.made_by = "Shadow Inspector";
    bundle.scene = kScene;
    bundle.picture = kPicture;
    bundle.camera =
        BundleCamera{{.world_from_view = pose_of(camera.axes, camera.eye), .projection = camera.projection()},
                     request.width,
                     request.height,
                     camera.curve.convention};
    bundle.settings = settings_of_frame(settings);
    if (shown.file_scenes.empty()) bundle.settings["scene.ground"] = "off";  // built-in scenes get no ground
    const bool for_other_camera = request.map_camera && request.map_camera->camera != camera;
    BundleContents out;
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
        const FittedLight& light = frame.lights[i];
        if (light.casts && light.chooser.choice == ViewChoice::Interval && for_other_camera)
            throw Error(
                fmt::format("light {}: its cascades are chosen by depth along the frozen camera, and a bundle holds "
                            "the picture's camera alone; release the frozen camera, or set light.cascade_choice to map",
                            i));
        bundle.lights.push_back(light_of(light, settings.lights[i], settings,
                                         i < frame.imported.size() ? frame.imported[i].get() : nullptr));
        for (std::size_t v = 0; v < bundle.lights.back().maps.size(); ++v) {
            BundleImage& image = bundle.lights.back().maps[v].image;
            const FloatImage map = renderer.read_shadow_map(frame, int(i), int(v));
            const bool exr = maps == MapFile::Exr;
            image.file = fmt::format("maps/light{}-{}.{}", i, v, exr ? "exr" : "pfm");
            image.first_row = exr ? FirstRow::Top : FirstRow::Bottom;
            out[image.file] = exr ? exr_bytes(map) : pfm_bytes(map);
        }
    }
    if (out.empty())
        throw Error(fmt::format(
            "{}: no light has a shadow map in this frame; set light.cast, light.on and light.source", shown.name));
    out[kPicture] = png_bytes(renderer.read_colour(frame.colour));
    Scene written = written_scene(shown);
    written.suggested.clear();
    out[kScene] = glb_bytes(written);
    std::string text = format_bundle(bundle);
    parse_bundle(text, kFrameJson);  // throws, so that no bundle that cannot be read replaces another one
    out[std::string(kFrameJson)] = std::move(text);
    return out;
}

void require_other_bundle(const std::string& bundle, const Scene& scene, const Settings& settings) {
    std::vector<std::filesystem::path> read;
    for (const StampedFile& file : scene.files) read.push_back(file.path);
    if (const std::string& given = settings.map.bundle; !given.empty()) {
        const auto maps = given_maps(given);
        for (const StampedFile& file : maps->files) read.push_back(file.path);
    }
    require_bundle_not_read(bundle, read);
}

}  // namespace si
