// Imported maps beside the maps that this program draws from the same light.
#include <fmt/format.h>

#include <filesystem>
#include <utility>
#include <vector>

#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/commands/interruptible.h"
#include "app/context/headless_context.h"
#include "app/report/map_comparison_report.h"
#include "app/report/report.h"
#include "renderer/advise/least_bias.h"
#include "renderer/base/error.h"
#include "renderer/render/renderer.h"

namespace si {
namespace {

/// Returns the imported maps of a session by light; empty: it has none.
std::vector<std::shared_ptr<const ImportedMaps>> imported_maps_of(Renderer& renderer, const Session& session) {
    const FrameRequest request{.width = 16, .height = 16, .outputs = {.colour = false, .shadow_map = true}};
    return renderer.render(session.scene, session.settings, request).imported;
}

/// Returns the lights to compare: the one that the options name, or all with imported maps.
std::vector<int> lights_of(const CompareMapsOptions& options,
                           const std::vector<std::shared_ptr<const ImportedMaps>>& maps) {
    if (options.light) return {*options.light};
    std::vector<int> out;
    for (std::size_t i = 0; i < maps.size(); ++i)
        if (maps[i] && maps[i]->has_images() && maps[i]->views) out.push_back(int(i));
    return out;
}

}  // namespace

void run_compare_maps(const CompareMapsOptions& options) {
    if (!options.output.empty()) require_output(options.output, "the picture of differences", {".png"});
    Session session = open_session(options.session);
    session.settings.map.bundle_maps = BundleMaps::Given;  // drawn ones are compared with themselves
    const HeadlessContext context;
    Renderer renderer;
    const auto given = imported_maps_of(renderer, session);
    const std::vector<int> lights = lights_of(options, given);
    if (lights.empty())
        throw Error(
            fmt::format("{}: it has no imported maps; name a bundle, or set map.bundle to one", options.session.scene));
    const MapCompareOptions how{.border_texels = options.border_texels, .leaves_out_masked = options.leave_out_masked};
    std::vector<ComparedMap> all;
    std::vector<MapBias> biases;
    interruptible("nothing was written", [&](const Workers& workers, const auto& report) {
        for (std::size_t i = 0; i < lights.size(); ++i) {
            report(double(i) / double(lights.size()), fmt::format("light {}", lights[i]));
            for (ComparedMap& map :
                 compare_imported_maps(renderer, session.scene, session.settings, given, lights[i], how, workers))
                all.push_back(std::move(map));
            biases.push_back(map_bias(renderer, session.scene, session.settings, given, lights[i],
                                      {options.size.width, options.size.height}, workers));
        }
        return 0;
    });
    if (!options.output.empty()) write_png(options.output, map_comparison_sheet(all));
    if (options.json) {
        const Json json = {{"format", "shadow-inspector-map-comparison"},
                           {"version", 1},
                           {"passed", all_pass_gate(all)},
                           {"maps", map_comparison_json(all)},
                           {"bias", json_list(biases, map_bias_json)}};
        fmt::print("{}", json_text(json));
    } else {
        fmt::print("{}", map_comparison_text(all));
        for (const MapBias& bias : biases) fmt::print("\n{}", map_bias_text(bias));
    }
    if (options.check && !all_pass_gate(all)) throw Error("some maps fail the gate (--check)");
}

}  // namespace si
