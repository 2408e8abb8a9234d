// Preparation of a frame: repaired settings, camera, fitted lights, map layout.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "renderer/base/error.h"
#include "renderer/base/index_of.h"
#include "renderer/base/poisson_disk.h"
#include "renderer/bundle/engine_bias.h"
#include "renderer/bundle/imported_maps.h"
#include "renderer/bundle/redrawn_maps.h"
#include "renderer/frame/blocks.h"
#include "renderer/frame/driver.h"
#include "renderer/frame/settings_block.h"
#include "renderer/optimisations/lookup_optimisations.h"
#include "renderer/optimisations/scene_findings.h"
#include "renderer/passes/camera_images.h"
#include "renderer/passes/caster_findings.h"
#include "renderer/projection/projection.h"
#include "renderer/reference/light_map.h"
#include "renderer/reference/reference_picture.h"
#include "renderer/render/polygon_offset.h"
#include "renderer/render/renderer_impl.h"
#include "renderer/scene/placement.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/depth_compare.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/idle_reason.h"
#include "renderer/settings/map_storage.h"
#include "renderer/settings/paging.h"
#include "renderer/settings/param.h"
#include "renderer/settings/sources.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/light_fit.h"
#include "renderer/view/fits/near_far.h"

namespace si {
namespace {

/// Returns the key of everything place_lights() and fit_maps() read, except the camera.
Key lights_as_placed_key(const FrameState& f) {
    Key key;
    key.add(f.scene.id).add(f.settings.light_count).add(f.settings.map.resolution).add(f.settings.map.reversed_z);
    key.add(f.settings.map.format).add(face_margin_texels(f.settings)).add(f.settings.map.origin);
    for (const Param& p : params())
        if (p.scope == Scope::Light && !is_text(p))
            for (int i = 0; i < std::min(f.settings.light_count, kMaxLights); ++i)
                add_value(key, f.settings, {&p, i, {}});
    const BiasSettings& b = f.settings.bias;
    key.add(b.normal_metres()).add(whole_reach_texels(f.settings));
    // The fit adds an offset in metres to the kernel's reach once it knows the width of texels.
    if (b.normal_metres() != 0) key.add(reach_of(f.settings).edge).add(lookup_reach_texels(f.settings));
    for (int i = 0; i < f.settings.light_count; ++i)
        if (f.settings.lights[std::size_t(i)].near_far == NearFar::Pancaking)
            key.add(b.unit).add(b.constant).add(b.slope).add(lookup_reach_texels(f.settings));
    key.add(draws_pages(f.settings)).add(page_texels(f.settings));
    key.add(f.settings.map.virtual_levels).add(f.settings.map.virtual_bias);
    for (const auto& [path, o] : f.settings.objects) key.add(path).add(o.cull).add(o.cast).add(o.receive);
    for (int i = 0; i < f.settings.light_count; ++i) {
        const FitRow& fit = fit_row(f.settings.lights[std::size_t(i)].fit);
        if (fit.narrows) key.add(fit_margin_texels(f.settings, f.settings.map.resolution));
        if (fit.warps) key.add(b.normal);
    }
    return key;
}

/// Returns true when `reads` is true for some light.
bool any_fit(const Settings& settings, bool (*reads)(const Settings&, int)) {
    for (int i = 0; i < settings.light_count; ++i)
        if (reads(settings, i)) return true;
    return false;
}

/// Adds position, direction, projection and planes of a camera to `key`.
void add_camera(Key& key, const Camera& c) {
    key.add(c.eye).add(c.axes[0]).add(c.axes[1]).add(c.axes[2]).add(c.orthographic).add(c.fov_y_rad).add(c.height);
    key.add(c.aspect).add(c.curve.near).add(c.curve.far);
}

/// Notes a light of the settings that stands elsewhere than the one whose maps are given.
void note_moved_light(FittedLight& light, std::size_t i) {
    constexpr double kDegrees = 0.5;
    const LightView& view = light.views.front();
    const bool parallel = light.type == LightType::Directional;
    const double away = glm::distance(light.position, view.eye);
    const bool is_moved = parallel ? glm::dot(light.to_light, view.axes[2]) < std::cos(glm::radians(kDegrees))
                                   : away > 1e-3 * (view.curve.far + light.distance_m);
    if (is_moved && view.curve.perspective != parallel)
        light.notes.push_back(fmt::format(
            "light {} {} than the one whose map is given: shading and reference follow the settings, and the "
            "map stays",
            i, parallel ? "shines in another direction" : "has another place"));
}

/// Replaces the views of lights whose maps come with views of their own, and marks all whose maps are images.
void take_imported_views(FrameState& f, std::vector<FittedLight>& fitted) {
    for (std::size_t i = 0; i < fitted.size(); ++i) {
        FittedLight& light = fitted[i];
        const auto& given = i < f.request.imported.size() ? f.request.imported[i] : nullptr;
        light.provider = MapProvider::Drawn;
        if (!given) continue;
        if (given->views && f.settings.lights[i].cast && source_of(f.settings, int(i)).needs.map) {
            // The maps may hold casters that the scene lacks.
            light.shadowed = light.casts = true;
            light.reason.clear();
            light.views = given->views->views;
            light.chooser = given->views->chooser;
            light.closed = given->views->closed;
            light.empty.clear();
            light.clipped_casters = 0;
            light.limits = {};
        }
        if (!light.casts) continue;
        light.provider = given->has_images() ? MapProvider::Imported : MapProvider::Drawn;
        if (given->views) note_moved_light(light, i);
        for (const LightView& view : light.views)
            if (view.curve.convention.reversed != f.settings.map.reversed_z)
                throw Error(fmt::format("light {}: its imported map has {}reversed depth; set map.reversed_z to {}", i,
                                        view.curve.convention.reversed ? "" : "no ",
                                        view.curve.convention.reversed ? "true" : "false"));
        if (given->has_images() && light.views.size() != given->images.size())
            throw Error(fmt::format("light {} has {} views and {} imported maps; give a map for each view", i,
                                    light.views.size(), given->images.size()));
    }
}

/// Places the lights, builds the camera, which may look through a light, and fits the maps. Maps are fitted again for a
/// moving camera only where a fit reads the camera.
void fit(FrameState& f) {
    Resources& r = f.gl;
    Key key = lights_as_placed_key(f);
    if (key.value() != r.as_placed_key) {
        r.placed = place_lights(f.scene, f.settings);
        r.fitted_without_camera = fit_maps(r.placed, f.scene, f.settings, nullptr, f.driver.max_texture_size);
        r.as_placed_key = key.value();
    }
    f.camera = make_camera(f.scene, f.settings, double(f.request.width) / f.request.height, r.fitted_without_camera);
    const bool camera = any_fit(f.settings, fit_reads_camera);
    const MapCamera own{f.camera, any_fit(f.settings, fit_reads_measured_depths) ? r.seen.span : std::nullopt};
    const MapCamera& maps = f.request.map_camera ? *f.request.map_camera : own;
    if (camera) {
        add_camera(key, maps.camera);
        key.add(lookup_reach_texels(f.settings));
        if (draws_pages(f.settings)) key.add(f.request.height);
        if (maps.seen_m) key.add(maps.seen_m->from_m).add(maps.seen_m->to_m);
    }
    for (const auto& given : f.request.imported) key.add(given ? given->key : 0);
    if (key.value() != r.fit_key) {
        r.fitted = camera ? fit_maps(r.placed, f.scene, f.settings, &maps.camera, f.driver.max_texture_size,
                                     maps.seen_m, f.request.height)
                          : r.fitted_without_camera;
        r.fit_key = 0;  // an exception leaves nothing fitted
        take_imported_views(f, r.fitted);
        r.fit_key = key.value();
    }
    f.view_count = 0;
    f.first_view.clear();
    for (const FittedLight& light : f.gl.fitted) {
        f.first_view.push_back(f.view_count);
        if (light.casts) f.view_count += int(light.views.size());
    }
}

/// Notes when view.face exceeds the shown light's maps; the last map is then shown. A light with one map ignores
/// view.face.
void note_shown_view(FrameState& f) {
    const auto shown = std::size_t(std::max(f.settings.view.light, 0));
    if (shown >= f.gl.fitted.size()) return;
    const FittedLight& light = f.gl.fitted[shown];
    const std::size_t count = light.views.size();
    if (count > 1 && f.settings.view.face >= int(count))
        f.notes.push_back(fmt::format("view.face {}: light {} has maps 0 to {}; the last is shown, {}",
                                      f.settings.view.face, shown, count - 1,
                                      view_name(light.chooser.choice, count - 1, count)));
}

/// Builds camera and lights at the requested resolution, then halves it until all maps fit into memory.
/// @param limit resolution limit after the driver ran out of memory; null: none
void fit_within_memory(FrameState& f, const RendererImpl::ReducedResolution* limit) {
    int& n = f.settings.map.resolution;
    MapSize wanted = draws_pages(f.settings) ? MapSize(n) : f.request.map_size.value_or(MapSize(n));
    bool given = false, sized = false;
    for (const auto& maps : f.request.imported) {
        if (!maps) continue;
        if (sized && !(maps->size() == wanted))
            throw Error(fmt::format("imported maps are {}×{} and {}×{}; the maps of all lights need one size",
                                    wanted.width, wanted.height, maps->size().width, maps->size().height));
        wanted = maps->size();
        sized = true;
        given |= maps->has_images() || f.settings.map.bundle_maps == BundleMaps::Given;
    }
    n = wanted.longest();
    const int asked = n;
    if (given && n > f.driver.max_texture_size)
        throw Error(fmt::format("the imported map of {}×{} texels exceeds the driver's limit of {} a side",
                                wanted.width, wanted.height, f.driver.max_texture_size));
    n = std::clamp(n, 1, f.driver.max_texture_size);
    if (n != asked)
        f.notes.push_back(fmt::format("map.resolution {} exceeds the driver's limit; {} is used", asked, n));
    if (!given && limit && limit->max < n) {
        f.notes.push_back(fmt::format("maps of {0}² are used in place of {1}²: {2}", limit->max, n, limit->why));
        n = limit->max;
    }
    fit(f);
    const int before = n;
    const double bytes = stored_texel_bytes(f.settings);
    while (!given && !draws_pages(f.settings) && n > 1 && bytes * n * n * std::max(f.view_count, 1) > kMapBudgetBytes)
        n /= 2;
    if (n != before) {
        f.notes.push_back(
            fmt::format("{} shadow map images of {}² need more than 2 GiB; {}² is used", f.view_count, before, n));
        fit(f);
    }
    f.map_size = {std::max(1, int(std::int64_t(wanted.width) * n / asked)),
                  std::max(1, int(std::int64_t(wanted.height) * n / asked))};
    f.map_size_is_given = given;
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i) {
        const FittedLight& light = f.gl.fitted[i];
        f.notes.insert(f.notes.end(), light.notes.begin(), light.notes.end());
        if (std::string remark = engine_bias_remark(f.imported(i), f.settings, int(i)); !remark.empty())
            f.notes.push_back(std::move(remark));
    }
    note_shown_view(f);
}

/// Replaces settings that only drawn maps can have, with a note for each change.
void adapt_to_imported_maps(FrameState& f) {
    if (std::ranges::none_of(f.request.imported, [](const auto& maps) { return maps != nullptr; })) return;
    MapSettings& map = f.settings.map;
    if (draws_pages(f.settings)) {
        f.notes.push_back("map.virtual: imported maps are whole; the maps are not virtual");
        map.paged = false;
    }
    if (holds_distances(map.format)) {
        f.notes.push_back("map.format: imported maps hold depths; d32f is used");
        map.format = MapFormat::D32F;
    }
    if (map.samples > 1) {
        f.notes.push_back("map.samples: imported maps have one sample a texel");
        map.samples = 1;
    }
}

/// Limits the kernel's moment settings to the abilities of driver and format, with a note for each change.
void clamp_moment_settings(FrameState& f) {
    const Filter& filter = filter_of(f.settings);
    if (filter.samples() != Samples::Moments) return;
    FilterSettings& s = f.settings.filter;
    const double most = safe_exponent(f.settings);
    for (const auto& [key, value] :
         {std::pair{"filter.exponent", &s.exponent}, {"filter.negative_exponent", &s.negative_exponent}}) {
        if (!owns_setting(filter, key) || *value <= most) continue;
        f.notes.push_back(fmt::format("{} {:g}: {} moments overflow beyond {:g}, which is used", key, *value,
                                      s.moment_format == MomentFormat::Bits32 ? "32-bit" : "16-bit", most));
        *value = most;
    }
    if (owns_setting(filter, "filter.anisotropy") && s.mips && s.anisotropy > f.driver.max_anisotropy) {
        f.notes.push_back(fmt::format("filter.anisotropy {} exceeds the driver's limit; {:g} is used", s.anisotropy,
                                      f.driver.max_anisotropy));
        s.anisotropy = int(f.driver.max_anisotropy);
    }
    int& samples = f.settings.map.samples;
    if (samples < 2 || f.settings.map.blur_texels > 0) return;
    int used = f.driver.map_samples.empty() ? 1 : f.driver.map_samples.front();
    for (const int count : f.driver.map_samples)
        if (count >= samples) used = count;
    if (used != samples)
        f.notes.push_back(
            fmt::format("map.samples {}: the driver does not support this count for depth textures; {} {} used",
                        samples, used, used == 1 ? "is" : "are"));
    samples = used;
}

/// Returns the size of the maps as GLSL: sides and size in texels, and the size as shares of the longer side.
std::string map_size_constants(MapSize size) {
    if (size.is_square())
        return "#define MAP_SIDES ivec2(map_resolution)\n#define MAP_SIZE vec2(map_resolution)\n"
               "#define MAP_SHAPE vec2(1.0)\n";
    return fmt::format(
        "#define MAP_SIDES ivec2({0}, {1})\n#define MAP_SIZE vec2({0}, {1})\n"
        "#define MAP_SHAPE (vec2({0}, {1}) / float(map_resolution))\n",
        size.width, size.height);
}

/// Returns facts about the lights as GLSL constants; arrays have at least one element, as GLSL has no empty arrays.
std::string light_constants(const FrameState& f) {
    const std::size_t count = f.gl.fitted.size();
    const auto array = [&](std::string_view name, auto value) {
        std::string out = fmt::format("const int {}[{}] = int[](", name, std::max<std::size_t>(count, 1));
        for (std::size_t i = 0; i < std::max<std::size_t>(count, 1); ++i)
            out += fmt::format("{}{}", i ? ", " : "", i < count ? value(i) : 0);
        return out + ");\n";
    };
    const auto& lights = f.gl.fitted;
    // Written out for each light, as a loop that is not unrolled would index uniforms per pixel.
    std::string each = "#define EACH_LIGHT(DO)", shining = "\n#define EACH_SHINING_LIGHT(DO)";
    for (std::size_t i = 0; i < count; ++i) {
        each += fmt::format(" DO({})", i);
        if (f.may_light_picture(i)) shining += fmt::format(" DO({})", i);
    }
    each += shining;
    return each + "\n" + array("LIGHT_TYPE", [&](std::size_t i) { return index_of(lights[i].type); }) +
           array("LIGHT_RANGED", [&](std::size_t i) { return int(lights[i].range_m > 0); }) +
           array("LIGHT_CASTS", [&](std::size_t i) { return int(lights[i].casts); }) +
           array("LIGHT_FIRST_VIEW", [&](std::size_t i) { return f.first_view[i]; }) +
           array("LIGHT_VIEWS", [&](std::size_t i) { return lights[i].casts ? int(lights[i].views.size()) : 0; }) +
           array("LIGHT_CLOSED", [&](std::size_t i) { return int(lights[i].casts && lights[i].closed); }) +
           array("LIGHT_CHOICE", [&](std::size_t i) { return lights[i].casts ? int(lights[i].chooser.choice) : 0; }) +
           array("LIGHT_EMPTY", [&](std::size_t i) { return int(f.shades_as_lit(i)); }) +
           array("LIGHT_WARPED",
                 [&](std::size_t i) { return int(lights[i].casts && lights[i].derives_texels(f.map_size)); }) +
           array("LIGHT_STRETCHED",
                 [&](std::size_t i) {
                     return int(lights[i].casts && lights[i].is_perspective() && lights[i].is_stretched(f.map_size));
                 }) +
           array("LIGHT_PERSPECTIVE",
                 [&](std::size_t i) { return int(lights[i].casts && lights[i].is_perspective()); });
}

bool needs_surface_flags(const FrameState& f) {
    for (const auto& [path, object] : f.settings.objects)
        if (!object.receive) return true;
    return std::any_of(f.scene.materials.begin(), f.scene.materials.end(), [](const Material& m) { return m.unlit; });
}

/// Returns k where the exponent is 2^k; 0 for other exponents.
int squarings(double exponent) {
    const int k = std::ilogb(exponent);
    return std::ldexp(1.0, k) == exponent ? k : 0;
}

/// Adds defines for the used parts of the light model, so that shaders skip factors of 0 or 1. A CPU rasteriser gathers
/// each uniform number again for every eight pixels.
void add_shading_defines(FrameState& f) {
    const ShadingSettings& s = f.settings.shading;
    const bool grey = std::all_of(f.gl.fitted.begin(), f.gl.fitted.end(), [](const FittedLight& light) {
        return light.radiance.r == light.radiance.g && light.radiance.r == light.radiance.b;
    });
    f.defines.push_back({"CAMERA_PARALLEL", f.camera.orthographic ? "1" : "0"});
    f.defines.push_back({"LIGHTS_GREY", grey ? "1" : "0"});
    f.defines.push_back({"SHADES_HIGHLIGHT", s.specular != 0 ? "1" : "0"});
    f.defines.push_back({"SHININESS_SQUARINGS", std::to_string(squarings(s.shininess))});
}

void choose_kernel(FrameState& f) {
    const Filter& filter = filter_of(f.settings);
    f.filter_sampler = uses_sampler(f.settings);
    if (f.settings.filter.method == FilterMethod::Sampler && !f.filter_sampler)
        f.notes.push_back(
            draws_pages(f.settings) ? "filter.method sampler cannot find pages of map.virtual; gather is used"
            : is_colour(f.settings.map.format)
                ? "filter.method sampler cannot compare a colour map; gather is used"
                : fmt::format("filter.method sampler compares 2x2 texels with one depth, and bias.kind {} "
                              "has one for each; gather is used",
                              bias_of(f.settings).key));
    for (const char* key : {"filter.taps", "filter.blocker_taps"}) {
        const SettingRef ref = *find_setting(key);
        const int taps = std::get<int>(get_value(f.settings, ref));
        if (idle_reason(f.settings, ref).empty() && disk_point_count(filter, f.settings, taps) < taps)
            f.notes.push_back(
                fmt::format("{} {}: the Poisson table has {} samples, all of which are used", key, taps, kDiskTable));
    }
    f.defines = settings_defines(f.settings);
    f.defines.push_back({"KERNEL_SIZE", std::to_string(taps_across(filter, f.settings))});
    f.defines.push_back({"SUBPIXEL_BITS", std::to_string(f.driver.subpixel_bits)});
    f.defines.push_back({"FILTER_SAMPLER", f.filter_sampler ? "1" : "0"});
    f.defines.push_back({"SAMPLER_BILINEAR", is_bilinear(filter, f.settings) ? "1" : "0"});
    f.defines.push_back({"COMPARE_BY_HAND", draws_pages(f.settings) ? "1" : "0"});
    f.defines.push_back({"MOMENTS_SUMMED", filter.moments.summed ? "1" : "0"});
    const bool integers = f.settings.filter.moment_format == MomentFormat::Bits16;
    f.defines.push_back({"MOMENTS_QUANTISED", filter.moments.quantised && integers ? "1" : "0"});
    f.defines.push_back({"MAP_LAYERS", std::to_string(f.view_count)});
    f.paged = draws_pages(f.settings) && f.view_count > 0;
    f.defines.push_back({"MAP_IS_COLOUR", is_colour(f.settings.map.format) ? "1" : "0"});
    f.defines.push_back({"MAP_HOLDS_DISTANCES", holds_distances(f.settings.map.format) ? "1" : "0"});
    f.defines.push_back({"MAP_PAGED", f.paged ? "1" : "0"});
    f.defines.push_back({"PAGE_SIZE", std::to_string(page_texels(f.settings))});
    const bool blend = std::any_of(f.gl.fitted.begin(), f.gl.fitted.end(), [](const FittedLight& light) {
        const auto blends = [](const ViewSpan& s) { return s.blends_from < s.ends; };
        return light.casts && std::any_of(light.chooser.spans.begin(), light.chooser.spans.end(), blends);
    });
    f.defines.push_back({"VIEWS_BLEND", blend ? "1" : "0"});
    if (f.gl.scene->coloured()) f.defines.push_back({"VERTEX_COLOURS", "1"});
    const Bias& bias = bias_of(f.settings);
    f.defines.push_back({"BIAS_PER_TEXEL", compares_per_texel(f.settings) ? "1" : "0"});
    f.defines.push_back({"BIAS_HAS_REMAINDER", compares_per_texel(f.settings) && bias.remainder ? "1" : "0"});
    f.defines.push_back({"BIAS_READS_PLANE", bias.gives_needed_bias ? "1" : "0"});
    f.defines.push_back({"BIAS_BY_DERIVATIVES", bias.by_derivatives ? "1" : "0"});
    f.defines.push_back({"BIAS_NORMAL_OFFSET", f.settings.bias.normal != 0 ? "1" : "0"});
    f.defines.push_back({"BIAS_SLOPED", f.settings.bias.slope != 0 ? "1" : "0"});
    add_shading_defines(f);
    for (gl::Define& d : lookup_optimisation_defines(f)) f.defines.push_back(std::move(d));
    f.preamble = blocks_glsl(f.blocks_as_images()) + map_size_constants(f.map_size) + light_constants(f);
    f.surface_flags = needs_surface_flags(f);
    const auto& batches = f.gl.scene->batches();
    f.mask_levels = std::any_of(batches.begin(), batches.end(), [&](const Batch& b) {
        const bool masked = b.masked || (b.blend && f.settings.caster.blend == BlendCasters::Mask);
        return b.cast && masked && b.texture != b.finest_texture;
    });
}

/// Finds the ray-traced reference that the frame needs, and whether the request has it.
void find_reference(FrameState& f) {
    const Outputs& o = f.request.outputs;
    bool asked = o.error || o.true_colour || o.classified || o.compared || o.evidence;
    if (o.colour || o.overlay) asked |= any_pane_shows(f.settings.view, &Overlay::reads_reference);
    if (!asked) return;
    const int light = f.settings.view.light;
    f.reference.key =
        reference_key(f.scene, f.settings, f.camera, f.request.width, f.request.height, f.gl.fitted, light,
                      f.request.reference && f.request.reference->options ? *f.request.reference->options
                                                                          : reference_options(f.settings));
    if (f.reference.key == 0) {
        f.notes.push_back("there is no light to trace a reference for");
        return;
    }
    const ReferencePicture* reference = f.request.reference.get();
    f.reference.met = reference && reference->key == f.reference.key;
    if (f.reference.met) f.reference_content = reference->version;
}

/// Finds the ray-traced visibility that lights need, and what of it the request has.
void find_traced(FrameState& f) {
    const std::size_t count = f.gl.fitted.size();
    f.traced_pictures.assign(count, nullptr);
    for (std::size_t i = 0; i < count; ++i) {
        if (!f.gl.fitted[i].shadowed || !source_of(f.settings, int(i)).needs.reference) continue;
        f.traced.resize(count);
        ReferenceNeed& need = f.traced[i];
        need.key = reference_key(f.scene, f.settings, f.camera, f.request.width, f.request.height, f.gl.fitted, int(i),
                                 reference_options(f.settings));
        const auto is_it = [&](const auto& reference) { return reference && reference->key == need.key; };
        if (i < f.request.traced.size() && is_it(f.request.traced[i]))
            f.traced_pictures[i] = f.request.traced[i].get();
        else if (is_it(f.request.reference))
            f.traced_pictures[i] = f.request.reference.get();
        need.met = f.traced_pictures[i] != nullptr;
        if (need.met)
            f.lights_key.add(i).add(f.traced_pictures[i]->version);
        else
            f.notes.push_back(
                fmt::format("light {} has no shadow yet: its source is {}, and no rays are traced for this view", i,
                            source_of(f.settings, int(i)).key));
    }
}

/// Finds the light maps that lights need, and which of them the request has.
void find_light_maps(FrameState& f) {
    const std::size_t count = f.gl.fitted.size();
    f.light_map_of_light.assign(count, nullptr);
    if (!any_source_needs(f.settings, &SourceNeeds::light_map)) return;
    int& side = f.settings.light_map.resolution;
    if (side > f.driver.max_texture_size) {
        f.notes.push_back(fmt::format("light_map.resolution {} exceeds the driver's limit; {} is used", side,
                                      f.driver.max_texture_size));
        side = f.driver.max_texture_size;
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (!f.gl.fitted[i].shadowed || !source_of(f.settings, int(i)).needs.light_map) continue;
        f.light_maps.resize(count);
        LightMapNeed& need = f.light_maps[i];
        need.key = light_map_key(f.scene, f.settings, f.gl.fitted, int(i));
        need.resolution = side;
        const LightMap* map = i < f.request.light_maps.size() ? f.request.light_maps[i].get() : nullptr;
        need.met = map && map->key == need.key;
        if (!need.met) {
            f.notes.push_back(
                fmt::format("light {} has no shadow yet: its source is {}, and none was baked for this scene, pose and "
                            "light",
                            i, source_of(f.settings, int(i)).key));
            continue;
        }
        f.light_map_of_light[i] = map;
        f.lights_key.add(i).add(map->version);
        need.bytes = map->texels.size();
        need.rays = map->rays;
        need.texels_per_metre = map->layout->texels_per_metre;
        need.charts = map->layout->charts.size();
        need.bake_ms = map->bake_ms;
        need.from_disk = map->from_disk;
        if (!map->remark.empty()) f.notes.push_back(map->remark);
    }
}

/// Lists the panes and the inputs of their overlays.
void arrange_panes(FrameState& f) {
    std::vector<int> shown;
    for (const int overlay : pane_overlays(f.settings.view)) {
        const bool lacks = overlay > 0 && overlays()[std::size_t(overlay - 1)].reads_reference && !f.reference.met;
        shown.push_back(lacks ? 0 : overlay);
        const int slot = int(std::ranges::find(shown, shown.back()) - shown.begin());
        f.panes.push_back({shown.back(), slot, lacks});
    }
    f.slabs_shown = f.settings.view.slabs != Slabs::None && f.shown_view();
}

/// Decides about the look of the picture. Pictures that are compared with the reference are plain.
void choose_look(FrameState& f) {
    const bool compared = f.request.outputs.true_colour || any_pane_shows(f.settings.view, &Overlay::reads_flip);
    f.studio = f.request.with_look && f.settings.view.look == Look::Studio && !compared;
}

/// Returns the reason why visibility is drawn into a texture of its own; empty: shading evaluates it.
std::string why_separate_visibility(const FrameState& f) {
    const Outputs& o = f.request.outputs;
    if (f.settings.shading.separate_visibility) return "shading.separate_visibility is on";
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i) {
        const Source& source = source_of(f.settings, int(i));
        if (f.has_contact_shadows(i))
            return fmt::format("contact shadows darken it ({})", light_setting_key(i, "contact"));
        if (f.gl.fitted[i].shadowed && !source.fused)
            return fmt::format("{} is {}, which shading cannot evaluate itself", light_setting_key(i, "source"),
                               source.key);
    }
    for (const FrameState::ShownPane& pane : f.panes)
        if (const Overlay* row = pane.row();
            row && (row->reads_visibility || row->reads_reference) && (o.overlay || o.colour))
            return fmt::format("overlay {} reads it", row->key);
    if (f.reference.met && (o.error || o.classified || o.compared || o.true_colour))
        return "it is compared with the reference";
    const bool requested = o.visibility || o.health || f.request.forced.contains(Optimisation::FusedVisibility);
    return requested ? "it is requested" : "";
}

std::uint64_t next_number() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

}  // namespace

RendererImpl::RendererImpl() : driver(query_driver()), number(next_number()) {
    resources.found = std::make_shared<SceneFindings>();
    resources.caster_findings = std::make_shared<CasterFindings>();
    resources.empty_vao = gl::VertexArray::create("no vertices");
    resources.map_nearest = gl::Sampler::create("shadow map, nearest");
    resources.map_compare = gl::Sampler::create("shadow map, comparison");
    resources.map_blended = gl::Sampler::create("shadow map, blended");
}

void RendererImpl::take_bundle_maps(FrameState& f) {
    const std::string& path = f.settings.map.bundle;
    if (path.empty()) bundle = {};
    if (path.empty() || !f.request.imported.empty() || !any_source_needs(f.settings, &SourceNeeds::map)) return;
    std::shared_ptr<const GivenMaps> given = given_maps(path);
    if (given != bundle.given || bundle.placement != f.scene.placement) {
        bundle = {std::move(given), f.scene.placement, {}};
        for (const auto& maps : bundle.given->lights) bundle.lights.push_back(placed_maps(maps, bundle.placement));
    }
    f.request.imported = bundle.lights;
    if (f.settings.map.bundle_maps == BundleMaps::Drawn)
        for (auto& maps : f.request.imported)
            if (maps) maps = redrawn_maps(*maps, f.settings, first_raster(bundle.given->bundle));
    f.notes.insert(f.notes.end(), bundle.given->notes.begin(), bundle.given->notes.end());
}

gl::PassClock& RendererImpl::pass_clock() {
    if (!clock) {
        clock = std::make_unique<gl::PassClock>(driver.software);
        driver.clock = gl::name(clock->kind());
        driver.query_share = clock->query_share();
    }
    return *clock;
}

void RendererImpl::calibrate_offset(MapFormat map_format) {
    PolygonOffset& offset = driver.offset[std::size_t(map_format)];
    if (!offset.measured) offset = measure_polygon_offset(map_format);
}

FrameState RendererImpl::prepare_frame(const Scene& scene, const Settings& settings, const FrameRequest& request) {
    FrameState f = derive_frame_state(scene, settings, request);
    if (!any_fit(f.settings, fit_reads_measured_depths)) return f;
    if (request.map_camera) {
        if (!request.map_camera->seen_m)
            f.notes.push_back(
                "light.depth_bounds sdsm: visible depths of the maps' camera are not measured; "
                "object boxes are used");
        return f;
    }
    VisibleDepths& seen = resources.seen;
    const std::uint64_t key = f.surfaces_key().value();
    if (seen.key == key && !request.force) {
        seen.info.state = PassState::Cached;
        seen.info.reason = "the visible surfaces are unchanged";
        seen.info.cpu_ms = seen.info.gpu_ms = seen.info.wall_ms = 0;
        f.seen_m = seen.span;
        return f;
    }
    upload_blocks(f);
    gl::PassClock* const timer = request.timing ? &pass_clock() : nullptr;
    if (timer) {
        timer->reset();
        timer->begin();
    }
    seen.span = measure_visible_depths(f, seen.info);
    if (timer) {
        const std::size_t slot = timer->end();
        seen.info.gpu_ms = timer->milliseconds(slot);
        seen.info.wall_ms = timer->wall_ms(slot);
    }
    seen.key = key;
    FrameState measured = derive_frame_state(scene, settings, request);
    measured.camera_depth_renewed = true;  // once a frame, even if forced
    measured.seen_m = seen.span;
    return measured;
}

FrameState RendererImpl::derive_frame_state(const Scene& scene, const Settings& settings, const FrameRequest& request) {
    if (!repaired || !(repaired->given == settings)) {
        repaired = Repaired{settings, settings, {}};
        repaired->notes = sanitise(repaired->settings);
    }
    FrameState f{.scene = scene, .settings = repaired->settings, .request = request, .gl = resources, .driver = driver};
    f.notes = repaired->notes;
    take_bundle_maps(f);
    adapt_to_imported_maps(f);
    clamp_moment_settings(f);
    if (reduced_resolution && reduced_resolution->requested != settings.map.resolution) reduced_resolution.reset();
    fit_within_memory(f, reduced_resolution ? &*reduced_resolution : nullptr);
    if (f.settings.bias.raster_slope != 0 || f.settings.bias.raster_units != 0) calibrate_offset(f.settings.map.format);
    if (f.settings.bias.raster_clamp != 0 && !driver.polygon_offset_clamp)
        f.notes.push_back(
            "bias.raster_clamp needs GL_EXT_polygon_offset_clamp, which this driver lacks; it is ignored");

    if (f.settings.camera.source == CameraSource::Light && resources.fitted.empty())
        f.notes.push_back("camera.source light: there is no light to look through; the automatic camera is used");
    f.origin = shader_origin(f.settings, f.camera.origin());
    if (!resources.scene || (resources.scene->scene_id() != scene.id && !resources.scene->adopt_if_compatible(scene)))
        resources.scene = std::make_unique<SceneGpu>(scene, driver.anisotropy, std::move(resources.scene));
    resources.scene->update_batches(scene, f.settings);

    f.geometry_key = resources.scene->key();
    f.camera_key.add(f.camera.clip_from_relative(f.origin)).add(f.origin).add(request.width).add(request.height);
    resources.found->seen_objects.arrange(f);
    f.lights_key.add(resources.fit_key).add(f.map_size.sides()).add(request.forced.value());
    f.lights_key.add(draws_pages(f.settings)).add(page_texels(f.settings));
    add_shader_settings(f.lights_key, f.settings);
    find_traced(f);
    find_light_maps(f);
    find_reference(f);
    arrange_panes(f);
    choose_look(f);
    f.separate_visibility_reason = why_separate_visibility(f);
    f.separate_visibility = !f.separate_visibility_reason.empty();
    choose_kernel(f);
    return f;
}

}  // namespace si
