#include "renderer/optimisations/map_extents.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "renderer/optimisations/scene_findings.h"
#include "renderer/settings/filters.h"
#include "renderer/view/lights/kernel_reach.h"

namespace si {
namespace {

const VisibleBodies& visible_bodies(FrameState& f, CameraMapReads& known) {
    const std::uint64_t key = f.surfaces_key().value();
    if (known.key == key && known.bodies) return *known.bodies;
    known.bodies = find_visible_bodies(f.scene, f.camera, f.request.height,
                                       [&](std::size_t mesh) { return mesh_clusters(f, mesh); });
    known.key = key;
    return *known.bodies;
}

}  // namespace

bool reads_whole_maps(const FrameState& f) {
    if (f.request.forced.contains(Optimisation::UnreadViews)) return true;
    Outputs more = f.request.outputs;
    more.colour = more.visibility = more.surface_ids = more.overlay = false;
    if (!(more == Outputs{.colour = false}) || f.slabs_shown) return true;
    return std::ranges::any_of(f.panes, [](const FrameState::ShownPane& pane) { return pane.overlay > 0; });
}

void add_unread_texels_part(const FrameState& f, std::string name, PassInfo& info) {
    const std::uint64_t each = std::uint64_t(f.map_size.width) * std::uint64_t(f.map_size.height);
    std::uint64_t left_out = 0;
    for (const MapCells& held : f.drawn_cells_by_layer) {
        std::uint64_t made = 0;
        for (const TexelRect& r : held.texel_rects(f.map_size))
            made += std::uint64_t(r.to.x - r.from.x) * std::uint64_t(r.to.y - r.from.y);
        left_out += each - std::min(made, each);
    }
    if (left_out == 0) return;
    const double share = double(left_out) / double(each * f.drawn_cells_by_layer.size());
    info.parts.push_back({.name = std::move(name),
                          .reason = fmt::format(
                              "no visible surface reads {:.0f} % of the maps' texels: they are skipped", 100.0 * share),
                          .left_out = left_out,
                          .unit = "texels",
                          .by = Optimisation::UnreadViews});
}

NeededMaps find_needed_maps(FrameState& f, std::size_t light, std::uint64_t maps) {
    const FittedLight& fitted = f.gl.fitted[light];
    if (reads_whole_maps(f)) return {std::vector<MapCells>(fitted.views.size(), MapCells::whole()), {}};
    if (f.shades_as_lit(light)) return {std::vector<MapCells>(fitted.views.size()), fitted.empty};
    const Settings& s = f.settings;
    const LookupArea area{.resolution = f.map_size.shortest(),
                          .reach_texels = kernel_reach_in_light(s, fitted, f.map_size).read + s.map.blur_texels,
                          .normal_texels = s.bias.normal_texels(),
                          .normal_m = s.bias.normal_metres(),
                          .wrap = s.map.wrap,
                          .whole_maps = filter_of(s).moments.summed || keeps_mips(s),
                          .reads_border_texels = filter_of(s).samples() == Samples::Moments,
                          .only_lit_points = !f.separate_visibility && s.shading.composition != Composition::DimLit};
    CameraMapReads& known = f.gl.found->seen;
    const VisibleBodies& seen = visible_bodies(f, known);
    CameraMapReads::LightReads& of_light = known.lights[light];
    Key key;
    key.add(known.key).add(maps).add(f.gl.fit_key).add(area.resolution).add(area.reach_texels).add(area.normal_texels);
    key.add(area.normal_m);
    key.add(area.wrap).add(area.whole_maps).add(area.reads_border_texels).add(area.only_lit_points);
    if (of_light.key != key.value()) of_light = {key.value(), needed_maps(fitted, seen, area)};
    return of_light.needed;
}

}  // namespace si
