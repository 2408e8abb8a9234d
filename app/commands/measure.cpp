#include "renderer/measure/measure.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "app/base/notes.h"
#include "app/commands/commands.h"
#include "app/commands/interruptible.h"
#include "app/context/headless_context.h"
#include "app/report/fixes_json.h"
#include "app/report/health_report.h"
#include "app/report/measure_json.h"
#include "app/report/report.h"
#include "app/report/shown_engine_bias.h"
#include "renderer/base/lengths_text.h"
#include "renderer/inspect/lost_casters.h"
#include "renderer/reference/artefact_picture.h"

namespace si {
namespace {

void print_metric(const Metric& metric, const ErrorMetrics& m, std::string_view label) {
    const double value = metric.value(m);
    if (metric.rare && !(value > 0)) return;
    const bool share = metric.unit == kShareOfPixels;
    const std::string number = share                               ? fmt::format("{:.4f} %", 100 * value)
                               : metric.better == Better::NearZero ? fmt::format("{:+.5f}", value)
                                                                   : fmt::format("{:.5f}", value);
    fmt::print("  {:<24} {:>11}{}   {}\n", label, number, metric.unit == "px" ? " px" : "", metric.help);
}

void print_error(const ErrorMetrics& m, const Reference& reference) {
    const std::string noise = noise_text(reference);
    const std::string ground =
        m.ground_pixels > 0 ? fmt::format(", {} of them on the ground under the model", m.ground_pixels) : "";
    fmt::print("{} pixels compared with the ray-traced reference{}{}\n", m.counted,
               noise.empty() ? "" : " (" + noise + ")", ground);
    for (const Metric& metric : metrics()) {
        if (!metric.part_of.empty() || metric.unit != kShareOfPixels) continue;
        print_metric(metric, m, metric.label);
        for (const Metric& part : metrics())
            if (part.part_of == metric.key) print_metric(part, m, "  " + std::string(part.part));
    }
    if (const std::size_t n = m.pixels[std::size_t(PixelState::ShadowTerminator)]; n > 0)
        fmt::print(
            "  {} more are not compared: shadow terminator, a triangle that faces away and a smooth normal that "
            "does not; no bias cures it\n",
            n);
    fmt::print("  pixels by cause:");
    const char* comma = "";
    for (const ArtefactStyle& style : artefact_styles())
        if (const std::size_t pixels = m.artefacts[std::size_t(style.artefact)]; pixels > 0)
            fmt::print("{} {} {}", std::exchange(comma, ","), style.label, pixels);
    fmt::print("{}\n", *comma ? "" : " none is wrong");
    for (const Metric& metric : metrics())
        if (metric.member && metric.unit != kShareOfPixels && !std::isnan(metric.value(m)))
            print_metric(metric, m, metric.label);
    if (std::isnan(m.boundary_px_mean)) fmt::print("  only one of the two pictures has an edge\n");
}

void print_time_and_cost(const std::optional<TimeMeasurement>& time, const WorkCost& cost) {
    if (time) {
        const Spread& t = time->total_ms;
        fmt::print(
            "{} {} a frame {}{} within this run ({} to {}: 95 % interval of the median of {} frames in {} "
            "bursts over {:.1f} s, {}; 95 % of frames below {}; {})\n",
            digits_text(t.median), time_unit(time->clock), cost_row(time->cost).when,
            time->wall_ms ? fmt::format(" ({} ms of wall time)", digits_text(time->wall_ms->median)) : "",
            digits_text(t.median_low), digits_text(t.median_high), t.samples, t.bursts, time->seconds,
            time->settled ? "settled" : "not settled", digits_text(t.p95), time->clock);
        for (const PassTime& pass : time->passes)
            fmt::print("  {:<32} {:>9} ms   95 % below {}\n", pass.name, digits_text(pass.gpu_ms.median),
                       digits_text(pass.gpu_ms.p95));
    }
    fmt::print("{} taps a pixel and light, {} texels ({} bytes) of maps, {} draws, {} triangles\n", cost.taps_per_pixel,
               cost.map_texels, cost.map_bytes, cost.draws, cost.triangles);
}

}  // namespace

void run_measure(const MeasureOptions& options) {
    const Session session = open_session(options.session);
    const HeadlessContext context;
    Renderer renderer;
    Measurer measurer(renderer, options.size.width, options.size.height);
    const Classification classified = measurer.classify(session.scene, session.settings);
    std::optional<TimeMeasurement> time;
    if (options.time) time = measurer.time(session.scene, session.settings, options.cost);
    std::optional<FixTable> fixes;
    if (options.fixes) {
        fixes = interruptible("nothing was tried", [&](const Workers& workers, const auto& report) {
            return find_fixes({renderer, session.scene, options.size.width, options.size.height, measurer.references(),
                               workers, report, session.engine.profile},
                              session.settings, {.time = options.time});
        });
    }
    std::shared_ptr<const NumericHealth> health;
    if (options.check_numeric)
        health = search_numbers(renderer, session.scene, session.settings,
                                {.width = options.size.width, .height = options.size.height});
    const auto light = std::size_t(session.settings.view.light_index());
    const EngineBias bias = shown_engine_bias(session.settings, classified.lights);
    const std::vector<LostCaster> lost = light < classified.lights.size()
                                             ? lost_casters(session.scene, session.settings, classified.lights[light])
                                             : std::vector<LostCaster>();
    if (options.json) {
        Json json = {{"format", "shadow-inspector-measurement"},
                     {"version", 1},
                     {"light", session.settings.view.light},
                     {"width", options.size.width},
                     {"height", options.size.height},
                     {"map_resolution", classified.map_resolution},
                     {"area", session.settings.truth.area}};
        json["error"] = error_json(classified.error, classified.reference->noise);
        json["engine_bias"] = engine_bias_key(bias);
        json["engine_bias_from"] = engine_bias_source_json(bias);
        json["truth"] = reference_quality_json(*classified.reference);
        json["lost_casters"] = lost_casters_json(session.scene, lost);
        json["time"] = time ? time_json(*time) : Json();
        if (time) {
            json["time"]["seconds"] = time->seconds;
            json["time"]["within"] = "this run";
        }
        json["cost"] = cost_json(classified.cost);
        if (classified.pages) json["pages"] = pages_json(*classified.pages);
        json["cures"] = fixes ? fixes_json(*fixes, session.engine) : Json();
        json["cures_stopped"] = fixes ? Json(fixes->stopped) : Json();
        json["numeric_health"] = health ? health_json(*health) : Json();
        json["driver"] = driver_json(renderer.driver());
        fmt::print("{}", json_text(json));
    } else {
        print_error(classified.error, *classified.reference);
        if (bias != EngineBias::Own) fmt::print("the engine's bias: {}\n", engine_bias_text(bias));
        print_time_and_cost(time, classified.cost);
        if (classified.pages) fmt::print("{}\n", page_facts_text(*classified.pages));
        if (fixes) print_fixes(*fixes, fixes->rows.size(), session.engine);
        if (health && health->sound()) fmt::print("{}\n", health_text(*health));
    }
    print_notes(session.notes);
    print_notes(classified.notes);
    print_notes(lost_caster_remarks(session.scene, lost, int(light)));
    if (health) require_sound(*health);
    end_if_interrupted("not everything was tried");
}

}  // namespace si
