#include "app/report/map_report.h"

#include <algorithm>

namespace si {
namespace {

constexpr int kBins = 64;

Json histogram_json(const DepthHistogram& h) {
    return {{"from", h.lo}, {"to", h.hi}, {"counts", h.counts}};
}

}  // namespace

std::optional<MapReport> map_report(Renderer& renderer, const Scene& scene, Settings settings, FrameRequest request) {
    settings.view.map_source = MapSource::Light;
    settings.view.map_channel = 0;
    request.outputs = {.colour = false, .shadow_map = true, .map_coordinates = true, .texels_read = true};
    request.timing = request.force = false;
    const FrameResult frame = renderer.render(scene, settings, request);
    if (!frame.map_view.texture) return std::nullopt;
    const FloatImage coordinates = renderer.read_float(frame.map_coordinates, 4);
    const FloatImage depth = renderer.read_map_view_depth(frame);
    MapReport facts;
    facts.exact_utilisation = exact_utilisation(renderer.read_float(frame.texels_read, 1));
    facts.light = settings.view.light;
    const auto& views = frame.lights[std::size_t(facts.light)].views;
    facts.face = std::clamp(settings.view.face, 0, int(views.size()) - 1);
    facts.size = frame.map_size;
    for (int face = 0; face < int(views.size()); ++face) {
        TexelUsage usage = texel_usage(coordinates, settings, frame.map_size, face);
        facts.utilisations.push_back(usage.utilisation());
        if (face == facts.face) facts.usage = std::move(usage);
    }
    const DepthCurve& curve = frame.map_view_curve;
    facts.depth = depth_statistics(depth, curve);
    facts.raw = depth_histogram(depth, curve, MapView::Raw, kBins, facts.depth.stored_min, facts.depth.stored_max);
    facts.linear =
        depth_histogram(depth, curve, MapView::Linear, kBins, facts.depth.linear_min, facts.depth.linear_max);
    return facts;
}

Json map_report_json(const MapReport& facts) {
    const DepthStatistics& d = facts.depth;
    Json json = {{"light", facts.light},
                 {"face", facts.face},
                 {"resolution", facts.size.longest()},
                 {"utilisation", facts.usage.utilisation()},
                 {"utilisation_exact", facts.exact_utilisation},
                 {"most_pixels_per_texel", facts.usage.max_pixels()},
                 {"drawn_texels", d.drawn},
                 {"empty_texels", d.empty},
                 {"stored_range", {d.stored_min, d.stored_max}},
                 {"linear_range", {d.linear_min, d.linear_max}},
                 {"metres_range", {d.metres_min, d.metres_max}},
                 {"histogram_raw", histogram_json(facts.raw)},
                 {"histogram_linear", histogram_json(facts.linear)}};
    if (facts.utilisations.size() > 1) json["utilisation_of_faces"] = facts.utilisations;
    return json;
}

}  // namespace si
