#include <fmt/format.h>

#include <cmath>

#include "app/commands/commands.h"
#include "app/headless_context.h"
#include "app/notes.h"
#include "app/output.h"
#include "app/report.h"
#include "renderer/error.h"
#include "renderer/reference/error_task.h"

namespace si {
namespace {

using Json = nlohmann::ordered_json;

Json number(double v) {
    return std::isfinite(v) ? Json(v) : Json(nullptr);
}

Json error_json(const ErrorMetrics& m) {
    static constexpr const char* kStates[] = {"counted", "background", "faces_away", "outside_cone", "not_receiving"};
    static constexpr const char* kNames[] = {"none", "acne", "peter_panning", "leak", "edge_aliasing", "outside_map",
                                             "lost_caster"};
    static_assert(std::size(kStates) == kPixelStates && std::size(kNames) == kArtefacts);
    Json json = {{"false_shadow", m.false_shadow},
                 {"false_light", m.false_light},
                 {"acne", m.acne},
                 {"leak", m.leak},
                 {"boundary_false_shadow", m.boundary_false_shadow},
                 {"boundary_false_light", m.boundary_false_light},
                 {"outside_false_shadow", m.outside_false_shadow},
                 {"outside_false_light", m.outside_false_light},
                 {"any_acne", m.any_acne},
                 {"mae", m.mae},
                 {"rmse", m.rmse},
                 {"signed_mean", m.signed_mean},
                 {"iou", m.iou},
                 {"boundary_px_mean", number(m.boundary_px_mean)},
                 {"boundary_px_p95", number(m.boundary_px_p95)},
                 {"boundary_px_max", number(m.boundary_px_max)},
                 {"outside_map", m.outside_map}};
    for (std::size_t i = 0; i < kPixelStates; ++i) json["pixels"][kStates[i]] = m.pixels[i];
    for (std::size_t i = 0; i < kArtefacts; ++i) json["artefacts"][kNames[i]] = m.artefacts[i];
    return json;
}

void print_error(const ErrorMetrics& m) {
    fmt::print("{} pixels compared with the ray-traced truth\n", m.counted);
    const auto share = [](const char* name, double v, const char* about) {
        fmt::print("  {:<22} {:>9.4f} %   {}\n", name, 100 * v, about);
    };
    share("false shadow", m.false_shadow, "dark though lit");
    share("  acne", m.acne, "of it away from true edges: surfaces that shadow themselves");
    share("  at edges", m.boundary_false_shadow, "of it within the kernel's reach of a true edge");
    share("false light", m.false_light, "lit though dark");
    share("  leak", m.leak, "of it away from true edges: peter-panning, lost casters, leaks");
    share("  at edges", m.boundary_false_light, "of it within the kernel's reach of a true edge");
    share("any acne", m.any_acne, "fully lit in truth and at all darker, away from true edges");
    share("outside the map", m.outside_map, "surfaces that the map does not hold");
    fmt::print("  mean |V - truth| {:.5f}, root mean square {:.5f}, mean {:+.5f}, overlap of the shadows {:.4f}\n", m.mae,
               m.rmse, m.signed_mean, m.iou);
    fmt::print("  edges are off by {:.3f} px on average, {:.3f} px for 95 %, {:.3f} px at most\n", m.boundary_px_mean,
               m.boundary_px_p95, m.boundary_px_max);
}

}  // namespace

void run_measure(const MeasureOptions& options) {
    const Session session = open_session(options.session);
    const HeadlessContext context;
    Renderer renderer;
    const int light = session.settings.view.light;
    const FrameRequest request{.width = options.size.width, .height = options.size.height};
    TruthCache cache;
    const ErrorTask task = error_task(renderer, session.scene, session.settings, request, light, options.truth);
    const MeasuredError measured = measure_error(task, cache);
    if (options.json) {
        Json json = {{"format", "shadow-inspector-measurement"}, {"version", 1},
                     {"light", light},                           {"width", request.width},
                     {"height", request.height},                 {"map_resolution", task.truth.map_resolution},
                     {"area", options.truth.area}};
        json["error"] = error_json(measured.metrics);
        fmt::print("{}", json_text(json));
    } else {
        print_error(measured.metrics);
    }
    print_notes(session.notes);
}

}  // namespace si
