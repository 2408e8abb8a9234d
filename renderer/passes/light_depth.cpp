// The scene's depth as each light sees it.
#include "renderer/passes/light_depth.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "renderer/optimisations/map_extents.h"
#include "renderer/passes/caster_content.h"
#include "renderer/passes/casters.h"
#include "renderer/passes/compared_maps.h"
#include "renderer/passes/pages.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/map_storage.h"
#include "renderer/software/llvmpipe_queue.h"

namespace si {
namespace {

std::string_view type_name(LightType type) {
    return type == LightType::Directional ? "directional" : type == LightType::Spot ? "spot" : "point";
}

/// @returns whether what they held is lost
bool ensure_maps(const FrameState& f, gl::Target& maps, std::string_view label) {
    return maps.ensure(label, f.map_format(), f.map_resolution, f.map_resolution, f.map_layers());
}

/// @param map one of `t`
/// @param emptied nothing is drawn into it
SkippedCasters draw_view(FrameState& f, DrawnMaps& t, const gl::Target& map, const FittedLight& light,
                         const LightView& view, int layer, PassInfo& info, const CasterChoice& which = {},
                         bool emptied = false) {
    if (map.layers == 0) layer = -1;  // a plain texture
    const bool colour = is_colour(f.settings.map.format);
    if (colour)
        t.depth.ensure("depth beside the colour map", GL_DEPTH_COMPONENT32F, f.map_resolution, f.map_resolution);
    else
        t.depth = {};
    const gl::Framebuffer into = colour ? gl::make_framebuffer("shadow map", &map, &t.depth, layer)
                                        : gl::make_framebuffer("shadow map", nullptr, &map, -1, layer);
    if (f.driver.software) gl::limit_pending_draws();
    if (!emptied) return draw_casters(f, into, &map == &t.unfiltered, light, view, info, which);
    clear_casters(f, into.id(), view.curve.convention);
    return {};
}

std::string name_of_view(const FittedLight& light, std::size_t view, std::size_t number) {
    const std::string name = view_name(light.chooser.choice, view, light.views.size());
    return fmt::format("{} of light {}", name.empty() ? "map" : name, number);
}

/// Draws one of a light's views, and says what was left out of it.
SkippedCasters draw_part(FrameState& f, DrawnMaps& t, std::size_t light, std::size_t view, const MapCells& called,
                         PassInfo& info) {
    const FittedLight& l = f.gl.fitted[light];
    const std::uint64_t draws = info.draws, triangles = info.triangles;
    const SkippedCasters spared =
        draw_view(f, t, t.maps, l, l.views[view], f.first_view[light] + int(view), info, {.called = &called},
                  f.request.emptied == MapOfLight{int(light), int(view)});
    PartInfo part{.name = name_of_view(l, view, light), .state = PassState::Drawn};
    part.draws = info.draws - draws;
    part.triangles = info.triangles - triangles;
    part.left_out = spared.beside + spared.unread;
    part.unit = "casters";
    if (spared.beside > 0) part.by = Optimisation::Casters;
    if (spared.unread > 0) part.by = Optimisation::Views;
    const char* plural = spared.unread == 1 ? "" : "s";
    const char* cover = spared.unread == 1 ? "covers" : "cover";
    if (spared.unread == 0)
        part.reason = part.draws == 0 ? "no caster lies in it: it is only cleared" : "its casters are drawn";
    else if (part.draws == 0)
        part.reason = fmt::format("it is only cleared: {} caster{} {} nothing that the camera can read", spared.unread,
                                  plural, cover);
    else
        part.reason = fmt::format("its casters are drawn, but for {} that {} nothing that the camera can read",
                                  spared.unread, cover);
    info.parts.push_back(std::move(part));
    return spared;
}

/// A view that is not drawn.
PartInfo left_part(const FrameState& f, std::size_t light, std::size_t view, bool kept) {
    PartInfo part{.name = name_of_view(f.gl.fitted[light], view, light)};
    part.state = kept ? PassState::Cached : PassState::Skipped;
    part.reason = kept ? "what is called for of it was drawn before"
                       : "nothing that the camera sees is looked up in it: it is not drawn";
    if (!kept) part.by = Optimisation::Views;
    return part;
}

/// @param closed casters, each counted once a view
PartInfo back_faces_part(const FrameState& f, std::size_t light, std::uint64_t closed) {
    PartInfo part{.name = fmt::format("back faces in maps of light {}", light)};
    const bool forced = f.request.forced.contains(Optimisation::BackFaces);
    part.by = Optimisation::BackFaces;
    part.state = forced ? PassState::Drawn : PassState::Skipped;
    part.reason =
        fmt::format("{} closed caster{} drawn by {}", closed, closed == 1 ? " is" : "s are",
                    forced ? "both their faces, which is forced" : "front faces alone, which hide the back ones");
    return part;
}

/// @param bare casters, each counted once a view
PartInfo fragments_part(std::size_t light, std::uint64_t bare) {
    PartInfo part{.name = fmt::format("fragments in maps of light {}", light), .unit = "fragment shaders"};
    part.by = Optimisation::Fragments;
    part.left_out = bare;
    part.reason = fmt::format("{} caster{} drawn without a fragment shader: no side is seen edge-on", bare,
                              bare == 1 ? " is" : "s are");
    return part;
}

}  // namespace

namespace {

/// What a frame draws of a light's views, and what they then hold.
struct MapWork {
    std::vector<MapCells> holds;
    std::vector<bool> drawn;
    std::string uncalled;  ///< why nothing of them is called for

    /// @param held what they hold, where that is of this very map; else empty
    MapWork(NeededMaps called, const std::vector<MapCells>& held) : uncalled(std::move(called.uncalled)) {
        const bool kept = held.size() == called.views.size();
        for (std::size_t v = 0; v < called.views.size(); ++v) {
            const bool enough = kept && held[v].holds(called.views[v]);
            drawn.push_back(!enough && !called.views[v].empty());
            // One that is drawn again is drawn whole: a camera that goes on moving pays for each map once.
            holds.push_back(enough ? held[v] : kept && !called.views[v].empty() ? MapCells::whole() : called.views[v]);
        }
    }
    bool draws() const { return std::ranges::find(drawn, true) != drawn.end(); }
};

bool all_whole(const std::vector<MapCells>& regions) {
    return std::ranges::all_of(regions, [](const MapCells& r) { return r.is_whole(); });
}

/// Of all that a light's maps depend on but what casts into them.
Key light_views_key(const FrameState& f, std::size_t light) {
    const FittedLight& l = f.gl.fitted[light];
    Key key = f.with_settings({}, ReadBy::Maps);
    key.add(f.map_layers()).add(f.request.forced.value());
    for (const LightView& v : l.views)
        key.add(v.clip_from_relative(l.map_origin))
            .add(v.curve.convention.zero_to_one)
            .add(v.clamps_near)
            .add(v.curve.convention.reversed);
    if (f.request.emptied && f.request.emptied->light == int(light)) key.add("emptied").add(f.request.emptied->view);
    return key.add(l.map_origin).add(f.first_view[light]).add(f.gl.programs.source().generation());
}

Key light_maps_key(const FrameState& f, std::size_t light) {
    return light_views_key(f, light).add(f.geometry_key);
}

void clear_layers(const FrameState& f, const gl::Target& maps) {
    const float far_depth = f.settings.map.reversed_z ? 0.f : 1.f;
    glClearTexImage(maps.texture.id(), 0, gl::single_channel_format(maps.format), GL_FLOAT, &far_depth);
}

/// How the maps of one light are drawn, by what of its casters rests.
struct StaticWork {
    StaticCasters::Draws draws = StaticCasters::Draws::All;
    std::string reason;                       ///< why all are drawn, where some moved
    std::vector<bool> static_casters, moved;  ///< by instance, unless all are drawn
    std::uint64_t count = 0;                  ///< of those that rest
};

/// Why no map of what rests is made, whatever moves. Empty: there may be one.
std::string why_none_rests(const FrameState& f) {
    if (is_colour(f.settings.map.format))
        return "map.format keeps colours: the depths that what moves would be tested against are not kept";
    const double texels = double(f.map_resolution) * f.map_resolution * f.view_count;
    if ((kept_texel_bytes(f.settings) + 4) * texels > kMapBudgetBytes)
        return "a second map of what rests would take more than the 2 GiB that maps may";
    return {};
}

StaticWork choose_static(const FrameState& f, std::size_t light, StaticOfLight& known) {
    using Draws = StaticCasters::Draws;
    StaticWork work;
    const std::uint64_t views = light_views_key(f, light).value(), geometry = f.geometry_key.value();
    const bool moved = known.geometry != 0 && known.geometry != geometry;
    const std::uint64_t views_before = std::exchange(known.views, views);
    known.geometry = geometry;
    if (f.request.forced.contains(Optimisation::Static))
        work.reason = "all are drawn, which is forced";
    else if (moved)
        work.reason = why_none_rests(f);
    if (f.request.force || f.request.emptied || !work.reason.empty()) {
        known.casters.forget();
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
        work.draws = known.casters.choose(views, weighed_casters(content.of, triangles), reason);
        work.reason = views == views_before ? reason : "its views changed with what moved, and with them every texel";
    } else if (views != views_before) {
        known.casters.forget();
    } else if (known.casters.keeps(views)) {
        work.draws = Draws::Moved;
    }
    if (work.draws == Draws::All) return work;
    for (const std::uint64_t of : caster_content(f).of) {
        work.static_casters.push_back(of != 0 && known.casters.rests(of));
        work.moved.push_back(of != 0 && !work.static_casters.back());
        work.count += work.static_casters.back();
    }
    return work;
}

PartInfo static_part(const FrameState& f, std::size_t light, const StaticWork& work) {
    using Draws = StaticCasters::Draws;
    PartInfo part{.name = fmt::format("casters at rest in maps of light {}", light), .unit = "casters"};
    part.by = Optimisation::Static;
    if (f.request.forced.contains(Optimisation::Static)) part.state = PassState::Drawn;
    part.reason = work.reason;
    if (work.draws == Draws::All) return part;
    part.state = work.draws == Draws::Anew ? PassState::Drawn : PassState::Cached;
    if (work.draws == Draws::Moved) part.left_out = work.count;
    part.reason =
        work.draws == Draws::Anew
            ? fmt::format("{} that did not move are drawn into a map of their own, and what moved over it", work.count)
            : "they are kept in a map of their own, and what moves is drawn over it";
    return part;
}

void copy_texels(const gl::Target& from, const gl::Target& to, int layer, const MapCells& cells) {
    const GLenum target = from.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
    for (const TexelRect& r : cells.texels(from.width))
        glCopyImageSubData(from.texture.id(), target, 0, r.from.x, r.from.y, layer, to.texture.id(), target, 0,
                           r.from.x, r.from.y, layer, r.to.x - r.from.x, r.to.y - r.from.y, 1);
}

/// Draws one of a light's views as a copy of what rests with what moved over it.
/// @param of what the light's map is made of so far
SkippedCasters draw_over_static(FrameState& f, DrawnMaps& t, std::size_t light, std::size_t view,
                                const MapCells& called, const StaticWork& work, StaticView& of, PassInfo& info) {
    const FittedLight& l = f.gl.fitted[light];
    const int layer = f.first_view[light] + int(view);
    const std::uint64_t draws = info.draws, triangles = info.triangles;
    SkippedCasters spared;
    const bool kept = of.drawn && of.holds.holds(called);
    if (!kept) {
        // One that is drawn again is drawn whole: what is called for goes with what moves.
        of.holds = of.drawn ? MapCells::whole() : called;
        of.below = false;
        spared = draw_view(f, t, t.static_casters, l, l.views[view], layer, info,
                           {.called = &of.holds, .only = &work.static_casters});
        of.drawn = true;
    }
    copy_texels(t.static_casters, t.maps, layer, of.below ? of.over : MapCells::whole());
    of.over = {};
    of.below = true;
    const SkippedCasters over = draw_view(f, t, t.maps, l, l.views[view], layer, info,
                                          {.called = &called, .only = &work.moved, .over = true, .covered = &of.over});
    PartInfo part{.name = name_of_view(l, view, light), .state = PassState::Drawn};
    part.draws = info.draws - draws;
    part.triangles = info.triangles - triangles;
    if (kept) part.by = Optimisation::Static;
    part.reason = !kept             ? "what rests in it is drawn apart, and what moved over it"
                  : part.draws == 0 ? "what rests in it is kept, and nothing that moves covers what is called for"
                                    : "what rests in it is kept, and what moves is drawn over it";
    info.parts.push_back(std::move(part));
    spared.closed += over.closed;
    spared.bare += over.bare;
    return spared;
}

void draw_maps_of(FrameState& f, DrawnMaps& t, std::size_t i, const MapWork& work, PassInfo& info) {
    const bool lost = ensure_maps(f, t.maps, "shadow maps");
    if (lost) {
        t.keys = {};
        clear_layers(f, t.maps);
        t.at_rest = {};
    }
    // A light that is not in this frame would take its layers for kept.
    for (std::size_t other = 0; other < t.keys.size(); ++other)
        if (other >= f.gl.fitted.size() || !f.gl.fitted[other].casts) {
            t.keys[other] = 0;
            t.at_rest[other] = {};
        }
    t.held[i].clear();
    const FittedLight& l = f.gl.fitted[i];
    StaticOfLight rest = std::exchange(t.at_rest[i], {});  // of what an exception leaves nothing is known
    const StaticWork static_casters = choose_static(f, i, rest);
    const bool apart = static_casters.draws != StaticCasters::Draws::All;
    if (apart && ensure_maps(f, t.static_casters, "casters at rest")) {
        for (StaticOfLight& other : t.at_rest) other.casters.views.clear();
        rest.casters.views.clear();
    }
    std::vector<StaticView>& views = rest.casters.views;
    views.resize(apart ? l.views.size() : 0);
    std::uint64_t closed = 0, bare = 0;
    const auto count = [&](const SkippedCasters& spared) {
        closed += spared.closed;
        bare += spared.bare;
    };
    for (std::size_t v = 0; v < l.views.size(); ++v) {
        if (!work.drawn[v] && !(lost && !work.holds[v].empty()))
            info.parts.push_back(left_part(f, i, v, !work.holds[v].empty()));
        else if (apart)
            count(draw_over_static(f, t, i, v, work.holds[v], static_casters, views[v], info));
        else
            count(draw_part(f, t, i, v, work.holds[v], info));
    }
    t.held[i] = work.holds;
    if (apart || !static_casters.reason.empty()) info.parts.push_back(static_part(f, i, static_casters));
    t.at_rest[i] = std::move(rest);
    if (closed > 0) info.parts.push_back(back_faces_part(f, i, closed));
    if (bare > 0) info.parts.push_back(fragments_part(i, bare));
    if (!work.uncalled.empty()) {
        info.state = PassState::Skipped;
        info.reason = work.uncalled;
        return;
    }
    const auto& batches = f.gl.scene->batches();
    const bool masks =
        std::any_of(batches.begin(), batches.end(), [](const Batch& b) { return b.cast && b.masked && !b.blend; });
    info.reason += masks ? "; masked materials bring their alpha test" : "; no masked material, so no alpha variant";
}

/// Whether some light's map still is one over which what moves may be drawn.
bool keeps_static(const FrameState& f, const DrawnMaps& t) {
    for (std::size_t i = 0; !f.paged && i < f.gl.fitted.size(); ++i)
        if (f.gl.fitted[i].casts && t.at_rest[i].casters.keeps(light_views_key(f, i).value())) return true;
    return false;
}

}  // namespace

void LightDepthPasses::declare(FrameState& f) {
    f.layers_held.assign(std::size_t(f.view_count), MapCells::whole());
    DrawnMaps& t = maps_;
    if (!keeps_static(f, t)) f.plan.release([&t] { t.static_casters = {}; });
    if (f.paged) return;
    f.plan.place(Result::DrawnMaps, {&t.maps, shared::UNIT_SHADOW_MAP, &f.gl.map_nearest});
    std::vector<ResultRef> writes = {Result::DrawnMaps};
    if (!f.blurs_depths()) {
        writes.push_back(Result::ShadowMaps);
        place_compared_maps(f, t.maps);
    }
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i) {
        const FittedLight& light = f.gl.fitted[i];
        Pass pass;
        pass.name = fmt::format("shadow map {} ({})", i, type_name(light.type));
        pass.category = PassCategory::Maps;
        pass.light = int(i);
        pass.writes = writes;
        pass.idle_reason = "nothing samples a shadow map";
        if (!light.casts) {
            pass.unneeded = light.reason;
            f.plan.add(std::move(pass));
            continue;
        }
        pass.key = light_maps_key(f, i).value();
        pass.cached = &t.keys[i];
        const bool kept = !f.request.force && t.keys[i] == pass.key;
        MapWork work = kept && all_whole(t.held[i])
                           ? MapWork({t.held[i], {}}, t.held[i])
                           : MapWork(needed_maps_of(f, i, pass.key), kept ? t.held[i] : std::vector<MapCells>());
        pass.lacks = kept && work.draws();
        if (kept) pass.unneeded = work.uncalled;
        for (std::size_t v = 0; v < work.holds.size(); ++v) {
            f.layers_held[std::size_t(f.first_view[i]) + v] = work.holds[v];
            work.holds[v].add_to(f.maps_extent);
        }
        f.maps_are_whole &= all_whole(work.holds);
        pass.run = [&f, &t, i, work = std::move(work)](PassInfo& info) { draw_maps_of(f, t, i, work, info); };
        f.plan.add(std::move(pass));
    }
    if (f.gl.fitted.empty())
        f.plan.add({.name = "shadow maps",
                    .category = PassCategory::Maps,
                    .writes = std::move(writes),
                    .unneeded = "there are no lights"});
}

void UnfilteredMapPass::declare(FrameState& f) {
    DrawnMaps& t = light_depth_.maps();
    Pass pass;
    pass.name = "unfiltered map";
    pass.category = PassCategory::Tool;
    pass.reads = {Result::DrawnMaps};
    pass.writes = {Result::UnfilteredMap};
    pass.idle_reason = "nothing asks what is wrong";
    if (f.paged) return pages_.declare_unfiltered(f, std::move(pass));
    const bool own = f.view_count > 0 && f.draws_unfiltered();
    f.plan.place(Result::UnfilteredMap,
                 {own ? &t.unfiltered : &t.maps, shared::UNIT_UNFILTERED_MAP, &f.gl.map_nearest});
    if (!own) {
        pass.unneeded = f.view_count == 0 ? "no light has a shadow map"
                                          : "the map as drawn is it: no polygon offset, no mask with mip levels";
        if (f.view_count > 0) f.plan.release([&t] { t.unfiltered = {}; });
    } else {
        pass.key = Key().add("unfiltered").value();
        pass.cached = &t.unfiltered.key;
        pass.run = [this, &f](PassInfo& info) { run(f, info); };
    }
    f.plan.add(std::move(pass));
}

void UnfilteredMapPass::run(FrameState& f, PassInfo& info) {
    DrawnMaps& t = light_depth_.maps();
    ensure_maps(f, t.unfiltered, "unfiltered shadow maps");
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i) {
        const FittedLight& l = f.gl.fitted[i];
        for (std::size_t v = 0; l.casts && v < l.views.size(); ++v)
            draw_view(f, t, t.unfiltered, l, l.views[v], f.first_view[i] + int(v), info);
    }
}

}  // namespace si
