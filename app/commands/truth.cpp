#include <fmt/format.h>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/context/headless_context.h"
#include "app/report/health_report.h"
#include "app/report/measure_json.h"
#include "app/report/report.h"
#include "app/report/views.h"
#include "renderer/base/error.h"
#include "renderer/reference/reference_task.h"
#include "renderer/render/reference_frames.h"

namespace si {
namespace {

nlohmann::ordered_json reference_json(const TracedReference& traced, const ReferenceTask& task, int light) {
    const Reference& t = *traced.reference;
    const auto pixels = [&](PixelState s) { return t.pixels[std::size_t(s)]; };
    double sum = 0, hard = 0;
    for (std::size_t i = 0; i < t.state.size(); ++i)
        if (t.state[i] == PixelState::Counted) {
            sum += t.visibility.data[i];
            hard += t.hard().data[i];
        }
    nlohmann::ordered_json json = {{"format", "shadow-inspector-truth"},
                                   {"version", 1},
                                   {"light", light},
                                   {"width", t.width},
                                   {"height", t.height},
                                   {"area", task.query.options.area},
                                   {"light_size", task.query.emitter.size},
                                   {"as_rasterised", task.query.options.as_rasterised},
                                   {"triangles", traced.scene->triangle_count()},
                                   {"instances", traced.scene->instance_count()},
                                   {"pixels",
                                    {{"counted", t.counted()},
                                     {"background", pixels(PixelState::Background)},
                                     {"faces_away", pixels(PixelState::FacesAway)},
                                     {"outside_cone", pixels(PixelState::OutsideCone)},
                                     {"not_receiving", pixels(PixelState::NotReceiving)},
                                     {"beyond_range", pixels(PixelState::BeyondRange)},
                                     {"shadow_terminator", pixels(PixelState::ShadowTerminator)},
                                     {"ground", t.on_ground}}},
                                   {"rays", t.rays}};
    json["visibility_mean"] = t.counted() ? nlohmann::ordered_json(sum / double(t.counted())) : nullptr;
    json["hard_visibility_mean"] = t.counted() ? nlohmann::ordered_json(hard / double(t.counted())) : nullptr;
    if (task.query.options.area) {
        json["partly_lit"] = t.partial;
        json["samples"] = task.query.options.samples;
        const nlohmann::ordered_json quality = reference_quality_json(t);
        for (const char* key : {"noise", "noise_unknown_px", "samples_used"}) json[key] = quality[key];
    }
    json["time_ms"] = {{"build", traced.build_ms}, {"place", traced.place_ms}, {"trace", traced.trace_ms}};
    return json;
}

/// Checks that all visibilities are within 0..1. @throws Error that names the first faulty pixel
void require_valid_visibility(const FloatImage& visibility) {
    for (std::size_t i = 0; i < visibility.data.size(); ++i)
        if (const float v = visibility.data[i]; !(v >= 0 && v <= 1)) {
            const auto width = std::size_t(visibility.width);
            throw Error(
                fmt::format("--check-numeric: the traced visibility is {} at pixel {}, {}", v, i % width, i / width));
        }
}

}  // namespace

void run_reference(const ReferenceCommandOptions& options) {
    check_view_file({.key = "truth", .scalar = true}, options.output);
    require_writable(options.output);
    if (!options.report.empty()) require_writable(options.report);
    require_distinct(options.output, "-o", options.report, "--report");
    const Session session = open_session(options.session);
    const HeadlessContext context;
    Renderer renderer;
    const int light = session.settings.view.light;
    const FrameRequest request{.width = options.size.width, .height = options.size.height};
    ReferenceOptions wanted = reference_options(session.settings);
    wanted.as_rasterised = options.as_rasterised;
    const ReferenceTask task = reference_task(renderer, session.scene, session.settings, request, light, wanted);
    ReferenceCache cache;
    const TracedReference traced = cache.trace(task, workers_with_progress(options.threads));
    const FloatImage& picture = traced.reference->visibility;
    write_scalar_image(options.output, picture);
    if (!options.report.empty()) write_file(options.report, json_text(reference_json(traced, task, light)));
    print_notes(session.notes);
    if (options.check_numeric) {
        require_valid_visibility(picture);
        require_sound(*search_numbers(renderer, session.scene, session.settings, request));
    }
}

}  // namespace si
