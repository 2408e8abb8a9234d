// Passes that draw the shadow maps: the scene's depth from each light.
#include "renderer/passes/light_depth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "renderer/bundle/imported_maps.h"
#include "renderer/frame/read_images.h"
#include "renderer/frame/requested_maps.h"
#include "renderer/optimisations/map_extents.h"
#include "renderer/passes/caster_findings.h"
#include "renderer/passes/casters.h"
#include "renderer/passes/pages.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/map_storage.h"
#include "renderer/software/llvmpipe_queue.h"

namespace si {
namespace {

/// Resizes the map textures where needed.
/// @return true when their contents are lost
bool ensure_maps(const FrameState& f, gl::Target& maps, std::string_view label) {
    return maps.ensure(label, f.map_format(), f.map_size.width, f.map_size.height, f.map_layers());
}

/// Draws the casters of one view into one layer of a map texture.
/// @param map one of the textures in `t`
/// @param emptied draws no caster
SkippedCasters draw_view(FrameState& f, DrawnMaps& t, const gl::Target& map, const FittedLight& light,
                         const LightView& view, int layer, PassInfo& info, const CasterChoice& choice = {},
                         bool emptied = false) {
    if (map.layers == 0) layer = -1;  // a plain texture
    const bool colour = is_colour(f.settings.map.format);
    if (colour)
        t.depth.ensure("depth of the colour map", GL_DEPTH_COMPONENT32F, f.map_size.width, f.map_size.height);
    else
        t.depth = {};
    const gl::Framebuffer into = colour ? gl::make_framebuffer("shadow map", &map, &t.depth, layer)
                                        : gl::make_framebuffer("shadow map", nullptr, &map, -1, layer);
    if (f.driver.software) gl::limit_pending_draws();
    if (!emptied) return draw_casters(f, into, &map == &t.unfiltered, light, view, info, choice);
    clear_casters(f, into.id(), view.curve.convention);
    return {};
}

std::string name_of_view(const FittedLight& light, std::size_t view, std::size_t number) {
    const std::string name = view_name(light.chooser.choice, view, light.views.size());
    return fmt::format("{} of light {}", name.empty() ? "map" : name, number);
}

/// Draws one of a light's views, and reports its skipped casters.
SkippedCasters draw_part(FrameState& f, DrawnMaps& t, std::size_t light, std::size_t view, const MapCells& called,
                         PassInfo& info) {
    const FittedLight& l = f.gl.fitted[light];
    const std::uint64_t draws = info.draws, triangles = info.triangles;
    const SkippedCasters skipped = draw_view(f, t, t.maps, l, l.views[view], f.first_view[light] + int(view), info,
                                             {.needed = &called, .raster = requested_raster(f.request, light, view)},
                                             f.request.emptied == MapOfLight{int(light), int(view)});
    PartInfo part{.name = name_of_view(l, view, light), .state = PassState::Drawn};
    part.draws = info.draws - draws;
    part.triangles = info.triangles - triangles;
    part.left_out = skipped.outside_map + skipped.unread;
    part.unit = "casters";
    if (skipped.outside_map > 0) part.by = Optimisation::CasterCulling;
    if (skipped.unread > 0) part.by = Optimisation::UnreadViews;
    const char* plural = skipped.unread == 1 ? "" : "s";
    const char* cover = skipped.unread == 1 ? "covers" : "cover";
    if (skipped.unread == 0)
        part.reason = part.draws == 0 ? "cleared only: no caster lies in the map" : "casters drawn";
    else if (part.draws == 0)
        part.reason = fmt::format("cleared only: {} caster{} {} no texel that the camera's picture reads",
                                  skipped.unread, plural, cover);
    else
        part.reason = fmt::format("casters drawn, except {} that {} no texel that the camera's picture reads",
                                  skipped.unread, cover);
    info.parts.push_back(std::move(part));
    return skipped;
}

/// Returns the report on a view that this frame does not draw.
/// @param kept its needed texels are cached
PartInfo undrawn_part(const FrameState& f, std::size_t light, std::size_t view, bool kept) {
    return {.name = name_of_view(f.gl.fitted[light], view, light),
            .state = kept ? PassState::Cached : PassState::Skipped,
            .reason = kept ? "the needed texels were drawn in an earlier frame"
                           : "not drawn: no surface that the camera sees looks up this map",
            .by = kept ? std::nullopt : std::optional(Optimisation::UnreadViews)};
}

/// Returns the report on skipped back faces.
/// @param closed casters, counted once for each view
PartInfo back_faces_part(const FrameState& f, std::size_t light, std::uint64_t closed) {
    const bool forced = f.request.forced.contains(Optimisation::CasterBackFaces);
    return {.name = fmt::format("back faces in maps of light {}", light),
            .state = forced ? PassState::Drawn : PassState::Skipped,
            .reason = fmt::format("{} closed caster{} drawn with {}", closed, closed == 1 ? " is" : "s are",
                                  forced ? "both faces (forced)" : "front faces alone: front faces hide back faces"),
            .by = Optimisation::CasterBackFaces};
}

/// Returns the report on skipped fragment shaders.
/// @param bare casters, counted once for each view
PartInfo fragments_part(std::size_t light, std::uint64_t bare) {
    return {.name = fmt::format("fragments in maps of light {}", light),
            .reason = fmt::format("{} caster{} drawn without a fragment shader: no side is edge-on to the light", bare,
                                  bare == 1 ? " is" : "s are"),
            .left_out = bare,
            .unit = "fragment shaders",
            .by = Optimisation::CasterFragments};
}

/// Cells that a frame draws of each view of a light, and cells valid afterwards.
struct MapPlan {
    std::vector<MapCells> drawn_cells;
    std::vector<bool> drawn;
    std::string unneeded_reason;  ///< reason why no cell is needed; empty: some are

    /// @param held valid cells of the light's current maps; empty if outdated
    MapPlan(NeededMaps called, const std::vector<MapCells>& held) : unneeded_reason(std::move(called.unneeded_reason)) {
        const bool kept = held.size() == called.views.size();
        for (std::size_t v = 0; v < called.views.size(); ++v) {
            const bool enough = kept && held[v].contains(called.views[v]);
            drawn.push_back(!enough && !called.views[v].empty());
            // A view that needs more cells is drawn whole, so that a moving camera pays for each map once.
            drawn_cells.push_back(enough                             ? held[v]
                                  : kept && !called.views[v].empty() ? MapCells::whole()
                                                                     : called.views[v]);
        }
    }
    bool draws() const { return std::ranges::find(drawn, true) != drawn.end(); }
};

bool all_whole(const std::vector<MapCells>& regions) {
    return std::ranges::all_of(regions, [](const MapCells& r) { return r.is_whole(); });
}

/// Returns the key of everything a light's maps depend on, except its casters.
/// @param settings the frame's, or those of the unfiltered map
Key light_views_key(const FrameState& f, std::size_t light, const Settings& settings) {
    const FittedLight& l = f.gl.fitted[light];
    Key key = FrameState::with_settings({}, ReadBy::Maps, settings);
    key.add(f.map_layers()).add(f.request.forced.value());
    for (const LightView& v : l.views)
        key.add(v.clip_from_relative(l.map_origin))
            .add(v.curve.convention.zero_to_one)
            .add(v.clamps_near)
            .add(v.curve.convention.reversed);
    if (f.request.emptied && f.request.emptied->light == int(light)) key.add("emptied").add(f.request.emptied->view);
    if (const ImportedMaps* given = requested_maps(f.request, light)) key.add("given").add(given->key);
    key.add(f.map_size.sides());
    return key.add(l.map_origin).add(f.first_view[light]).add(f.gl.programs.source().generation());
}

/// Way to draw the maps of one light, given its static and moving casters.
struct StaticPlan {
    StaticCasters::Draws draws = StaticCasters::Draws::All;
    std::string reason;                       ///< reason why all casters are drawn although only some moved
    std::vector<bool> static_casters, moved;  ///< by instance; empty if all casters are drawn
    std::uint64_t count = 0;                  ///< number of static casters
};

/// Returns the reason why no map of static casters is possible; empty: it is possible.
std::string why_no_static_map(const FrameState& f) {
    if (is_colour(f.settings.map.format))
        return "map.format is a colour format, which keeps no depths to test moving casters against";
    const double texels = double(f.map_size.width) * f.map_size.height * f.view_count;
    if ((stored_texel_bytes(f.settings) + 4) * texels > kMapBudgetBytes)
        return "a second map for static casters would exceed the limit of 2 GiB for all maps";
    return {};
}

StaticPlan choose_static(const FrameState& f, std::size_t light, StaticMapState& known) {
    using Draws = StaticCasters::Draws;
    StaticPlan work;
    const std::uint64_t views = light_views_key(f, light, f.settings).value(), geometry = f.geometry_key.value();
    const bool moved = known.geometry != 0 && known.geometry != geometry;
    const std::uint64_t views_before = std::exchange(known.views, views);
    known.geometry = geometry;
    if (f.request.forced.contains(Optimisation::StaticCasterCache))
        work.reason = "all casters are drawn (forced)";
    else if (moved)
        work.reason = why_no_static_map(f);
    if (f.request.force || f.request.emptied || !work.reason.empty()) {
        known.casters.reset();
        if (!moved) work.reason.clear();
        return work;
    }
    if (moved) {
        const CasterContent& content = caster_content(f);
        const auto& order = f.gl.scene->instance_objects();
        std::vector<std::uint64_t> triangles;
        for (const std::uint32_t object : order)
            triangles.push_back(f.scene.meshes[std::size_t(f.scene.objects[object].mesh)].indices.size() / 3);
        std::string_view reason;
        work.draws = known.casters.choose(views, group_by_content(content.of, triangles), reason);
        work.reason = views == views_before
                          ? reason
                          : "the light's views changed with the moving casters, and with them every texel";
    } else if (views != views_before) {
        known.casters.reset();
    } else if (known.casters.has_cache_for(views)) {
        work.draws = Draws::MovingOnly;
    }
    if (work.draws == Draws::All) return work;
    for (const std::uint64_t of : caster_content(f).of) {
        work.static_casters.push_back(of != 0 && known.casters.is_static(of));
        work.moved.push_back(of != 0 && !work.static_casters.back());
        work.count += work.static_casters.back();
    }
    return work;
}

PartInfo static_part(const FrameState& f, std::size_t light, const StaticPlan& work) {
    using Draws = StaticCasters::Draws;
    PartInfo part{.name = fmt::format("static casters in maps of light {}", light), .unit = "casters"};
    part.by = Optimisation::StaticCasterCache;
    if (f.request.forced.contains(Optimisation::StaticCasterCache)) part.state = PassState::Drawn;
    part.reason = work.reason;
    if (work.draws == Draws::All) return part;
    part.state = work.draws == Draws::StaticAndMoving ? PassState::Drawn : PassState::Cached;
    if (work.draws == Draws::MovingOnly) part.left_out = work.count;
    part.reason =
        work.draws == Draws::StaticAndMoving
            ? fmt::format("{} static casters are drawn into a map of their own, and moving casters over a copy of it",
                          work.count)
            : "static casters are cached in a map of their own; moving casters are drawn over a copy of it";
    return part;
}

void copy_texels(const gl::Target& from, const gl::Target& to, int layer, const MapCells& cells) {
    const GLenum target = from.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
    for (const TexelRect& r : cells.texel_rects({from.width, from.height}))
        glCopyImageSubData(from.texture.id(), target, 0, r.from.x, r.from.y, layer, to.texture.id(), target, 0,
                           r.from.x, r.from.y, layer, r.to.x - r.from.x, r.to.y - r.from.y, 1);
}

/// Draws one of a light's views as a copy of its static map with the moving casters over it.
/// @param[in,out] of state of the view's static map
SkippedCasters draw_over_static(FrameState& f, DrawnMaps& t, std::size_t light, std::size_t view,
                                const MapCells& called, const StaticPlan& work, StaticView& of, PassInfo& info) {
    const FittedLight& l = f.gl.fitted[light];
    const int layer = f.first_view[light] + int(view);
    const std::uint64_t draws = info.draws, triangles = info.triangles;
    const CasterRaster* const raster = requested_raster(f.request, light, view);
    SkippedCasters skipped;
    const bool kept = of.cached && of.cached_cells.contains(called);
    if (!kept) {
        // A static map that needs more cells is drawn whole, as needed cells follow the moving casters.
        of.cached_cells = of.cached ? MapCells::whole() : called;
        of.is_copy = false;
        skipped = draw_view(f, t, t.static_casters, l, l.views[view], layer, info,
                            {.needed = &of.cached_cells, .only = &work.static_casters, .raster = raster});
        of.cached = true;
    }
    copy_texels(t.static_casters, t.maps, layer, of.is_copy ? of.moving_cells : MapCells::whole());
    of.moving_cells = {};
    of.is_copy = true;
    const SkippedCasters over = draw_view(f, t, t.maps, l, l.views[view], layer, info,
                                          {.needed = &called,
                                           .only = &work.moved,
                                           .keeps_contents = true,
                                           .covered = &of.moving_cells,
                                           .raster = raster});
    PartInfo part{.name = name_of_view(l, view, light), .state = PassState::Drawn};
    part.draws = info.draws - draws;
    part.triangles = info.triangles - triangles;
    if (kept) part.by = Optimisation::StaticCasterCache;
    part.reason = !kept             ? "static casters drawn into their own map, moving casters over a copy of it"
                  : part.draws == 0 ? "static casters are cached, and no moving caster covers a needed texel"
                                    : "static casters are cached; moving casters are drawn over a copy of their map";
    info.parts.push_back(std::move(part));
    skipped.front_faces_only += over.front_faces_only;
    skipped.without_shader += over.without_shader;
    return skipped;
}

/// Copies numbers into one layer of a map texture.
/// @param type of the numbers, for glTextureSubImage2D()
void upload_layer(const gl::Target& map, int layer, GLenum type, const void* rows) {
    const GLenum format = gl::single_channel_format(map.format);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (map.layers > 0)
        glTextureSubImage3D(map.texture.id(), 0, 0, 0, layer, map.width, map.height, 1, format, type, rows);
    else
        glTextureSubImage2D(map.texture.id(), 0, 0, 0, map.width, map.height, format, type, rows);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

/// Copies a given image into one layer of a map texture. Depths are rounded to the steps of 16 bits here, since drivers
/// may truncate them.
void upload_view(const gl::Target& map, int layer, const FloatImage& image) {
    std::vector<float> rows = image.data;
    flip_rows(rows, image.width, image.height, 1);
    if (map.format != GL_DEPTH_COMPONENT16) return upload_layer(map, layer, GL_FLOAT, rows.data());
    std::vector<std::uint16_t> steps;
    for (const float depth : rows)
        steps.push_back(std::uint16_t(std::lround(std::clamp(double(depth), 0.0, 1.0) * 0xffff)));
    upload_layer(map, layer, GL_UNSIGNED_SHORT, steps.data());
}

/// Copies the given images of a light into its maps.
void import_maps_of(const FrameState& f, DrawnMaps& t, std::size_t i, const ImportedMaps& given, PassInfo& info) {
    const FittedLight& l = f.gl.fitted[i];
    for (std::size_t v = 0; v < l.views.size(); ++v) {
        upload_view(t.maps, f.first_view[i] + int(v), given.images[v]);
        info.parts.push_back({.name = name_of_view(l, v, i),
                              .state = PassState::Drawn,
                              .reason = "imported: the image is given, no caster is drawn"});
    }
    t.drawn_cells[i].assign(l.views.size(), MapCells::whole());
    info.reason = "imported";
}

void draw_maps_of(FrameState& f, DrawnMaps& t, std::size_t i, const MapPlan& work, PassInfo& info) {
    const bool lost = ensure_maps(f, t.maps, "shadow maps");
    if (lost) {
        t.keys = {};
        const float far_depth = f.settings.map.reversed_z ? 0.f : 1.f;
        glClearTexImage(t.maps.texture.id(), 0, gl::single_channel_format(t.maps.format), GL_FLOAT, &far_depth);
        t.static_states = {};
    }
    // Keys of lights absent from this frame are cleared, so that they do not count as cached when they return.
    for (std::size_t other = 0; other < t.keys.size(); ++other)
        if (other >= f.gl.fitted.size() || !f.gl.fitted[other].casts) {
            t.keys[other] = 0;
            t.static_states[other] = {};
        }
    t.drawn_cells[i].clear();
    if (const ImportedMaps* given = f.imported(i)) {
        t.static_states[i] = {};
        return import_maps_of(f, t, i, *given, info);
    }
    const FittedLight& l = f.gl.fitted[i];
    StaticMapState rest = std::exchange(t.static_states[i], {});  // an exception leaves the state cleared
    const StaticPlan static_casters = choose_static(f, i, rest);
    const bool apart = static_casters.draws != StaticCasters::Draws::All;
    if (apart && ensure_maps(f, t.static_casters, "static casters")) {
        for (StaticMapState& other : t.static_states) other.casters.views.clear();
        rest.casters.views.clear();
    }
    std::vector<StaticView>& views = rest.casters.views;
    views.resize(apart ? l.views.size() : 0);
    std::uint64_t closed = 0, bare = 0;
    const auto count = [&](const SkippedCasters& skipped) {
        closed += skipped.front_faces_only;
        bare += skipped.without_shader;
    };
    for (std::size_t v = 0; v < l.views.size(); ++v) {
        if (!work.drawn[v] && !(lost && !work.drawn_cells[v].empty()))
            info.parts.push_back(undrawn_part(f, i, v, !work.drawn_cells[v].empty()));
        else if (apart)
            count(draw_over_static(f, t, i, v, work.drawn_cells[v], static_casters, views[v], info));
        else
            count(draw_part(f, t, i, v, work.drawn_cells[v], info));
    }
    t.drawn_cells[i] = work.drawn_cells;
    if (apart || !static_casters.reason.empty()) info.parts.push_back(static_part(f, i, static_casters));
    t.static_states[i] = std::move(rest);
    if (closed > 0) info.parts.push_back(back_faces_part(f, i, closed));
    if (bare > 0) info.parts.push_back(fragments_part(i, bare));
    if (!work.unneeded_reason.empty()) {
        info.state = PassState::Skipped;
        info.reason = work.unneeded_reason;
        return;
    }
    const auto& batches = f.gl.scene->batches();
    const bool masks =
        std::any_of(batches.begin(), batches.end(), [](const Batch& b) { return b.cast && b.masked && !b.blend; });
    info.reason +=
        masks ? "; masked materials are drawn with their alpha test" : "; no masked material, so no alpha variant";
}

/// Returns the key of the unfiltered maps, which no polygon offset moves.
Key unfiltered_key(const FrameState& f) {
    Settings settings = f.settings;
    settings.bias.raster_slope = settings.bias.raster_units = 0;
    Key key;
    key.add("unfiltered").add(f.geometry_key.value());
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i)
        if (f.gl.fitted[i].casts) key.add(i).add(light_views_key(f, i, settings).value());
    return key;
}

/// Returns true when some light's static map is still valid.
bool keeps_static(const FrameState& f, const DrawnMaps& t) {
    for (std::size_t i = 0; !f.paged && i < f.gl.fitted.size(); ++i)
        if (f.gl.fitted[i].casts && t.static_states[i].casters.has_cache_for(light_views_key(f, i, f.settings).value()))
            return true;
    return false;
}

}  // namespace

void LightDepthPasses::declare(FrameState& f) {
    f.drawn_cells_by_layer.assign(std::size_t(f.view_count), MapCells::whole());
    DrawnMaps& t = maps_;
    if (!keeps_static(f, t)) f.plan.release_later([&t] { t.static_casters = {}; });
    if (f.paged) return;
    f.plan.place_result(Result::DrawnMaps, {&t.maps, shared::UNIT_SHADOW_MAP, &f.gl.map_nearest});
    std::vector<ResultRef> writes = {Result::DrawnMaps};
    if (!f.blurs_depths()) {
        writes.push_back(Result::ShadowMaps);
        f.place_compared_maps(t.maps);
    }
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i) {
        const FittedLight& light = f.gl.fitted[i];
        Pass pass{.name = fmt::format("shadow map {} ({})", i, kLightTypeKeys[std::size_t(light.type)]),
                  .category = PassCategory::Maps,
                  .light = int(i),
                  .writes = writes,
                  .idle_reason = "no pass samples a shadow map"};
        if (!light.casts) {
            f.plan.skip_pass(std::move(pass), light.reason);
            continue;
        }
        // The upload of a given map stands for no work of the engine.
        if (f.imported(i)) pass.category = PassCategory::Tool;
        Key key = light_views_key(f, i, f.settings);
        if (!f.imported(i)) key.add(f.geometry_key);
        pass.key = key.value();
        pass.cached = &t.keys[i];
        const bool kept = !f.request.force && t.keys[i] == pass.key;
        const std::vector<MapCells> all(light.views.size(), MapCells::whole());
        MapPlan work =
            f.imported(i) ? MapPlan({all, {}}, kept ? t.drawn_cells[i] : std::vector<MapCells>())
            : kept && all_whole(t.drawn_cells[i])
                ? MapPlan({t.drawn_cells[i], {}}, t.drawn_cells[i])
                : MapPlan(find_needed_maps(f, i, pass.key), kept ? t.drawn_cells[i] : std::vector<MapCells>());
        pass.is_incomplete = kept && work.draws();
        if (kept) pass.unneeded = work.unneeded_reason;
        for (std::size_t v = 0; v < work.drawn_cells.size(); ++v) {
            f.drawn_cells_by_layer[std::size_t(f.first_view[i]) + v] = work.drawn_cells[v];
            work.drawn_cells[v].add_to(f.maps_extent);
        }
        f.maps_are_whole &= all_whole(work.drawn_cells);
        pass.run = [&f, &t, i, work = std::move(work)](PassInfo& info) { draw_maps_of(f, t, i, work, info); };
        f.plan.add_pass(std::move(pass));
    }
    if (f.gl.fitted.empty())
        f.plan.add_pass({.name = "shadow maps",
                         .category = PassCategory::Maps,
                         .writes = std::move(writes),
                         .unneeded = "there are no lights"});
}

void UnfilteredMapPass::declare(FrameState& f) {
    DrawnMaps& t = light_depth_.maps();
    Pass pass{.name = "unfiltered map",
              .category = PassCategory::Tool,
              .reads = {Result::DrawnMaps},
              .writes = {Result::UnfilteredMap},
              .idle_reason = "no output shows wrong pixels"};
    if (f.paged) return pages_.declare_unfiltered(f, std::move(pass));
    const bool own = f.view_count > 0 && f.needs_unfiltered_map();
    f.plan.place_result(Result::UnfilteredMap,
                        {own ? &t.unfiltered : &t.maps, shared::UNIT_UNFILTERED_MAP, &f.gl.map_nearest});
    if (!own) {
        pass.unneeded = f.view_count == 0 ? "no light has a shadow map"
                                          : "equal to the map as drawn: no polygon offset, no mask with mip levels";
        if (f.view_count > 0) f.plan.release_later([&t] { t.unfiltered = {}; });
    } else {
        pass.reads.clear();  // the map is drawn anew, and is kept when only polygon offset moves the others
        pass.key = unfiltered_key(f).value();
        pass.cached = &t.unfiltered.key;
        pass.run = [this, &f](PassInfo& info) { run(f, info); };
    }
    f.plan.add_pass(std::move(pass));
}

void UnfilteredMapPass::run(FrameState& f, PassInfo& info) {
    DrawnMaps& t = light_depth_.maps();
    ensure_maps(f, t.unfiltered, "unfiltered shadow maps");
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i) {
        const FittedLight& l = f.gl.fitted[i];
        const ImportedMaps* given = f.imported(i);
        for (std::size_t v = 0; l.casts && v < l.views.size(); ++v)
            if (given)
                upload_view(t.unfiltered, f.first_view[i] + int(v), given->images[v]);
            else
                draw_view(f, t, t.unfiltered, l, l.views[v], f.first_view[i] + int(v), info,
                          {.raster = requested_raster(f.request, i, v)});
    }
}

}  // namespace si
