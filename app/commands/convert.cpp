// Settings of a preset as code of an engine or a language.
#include "app/commands/convert.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/commands/interruptible.h"
#include "app/context/headless_context.h"
#include "app/convert/conversion.h"
#include "app/report/report.h"
#include "app/session/session.h"
#include "renderer/base/error.h"
#include "renderer/base/printable.h"
#include "renderer/measure/measure.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// Checks that the light to convert exists. @throws Error
void require_light(const Settings& settings) {
    if (settings.view.light < settings.light_count) return;
    throw Error(fmt::format("view.light {}: the lights are 0 to {}; choose one of them", settings.view.light,
                            settings.light_count - 1));
}

/// Takes maps, angle, error and time from a scene.
void measure_scene(const ConvertOptions& options, const Session& session, ConversionInput& in,
                   std::vector<std::string>& notes) {
    in.scene = printable(session.scene_name, std::string::npos);
    in.settings = session.settings;
    interruptible("nothing was written", [&](const Workers& workers, const auto& report) {
        const HeadlessContext context;
        Renderer renderer;
        Settings tilt = session.settings;
        set_setting(tilt, "view.overlay", "n-dot-l");
        const FrameRequest request{.width = options.size.width,
                                   .height = options.size.height,
                                   .outputs = {.colour = false, .visibility = true, .overlay = true}};
        report(0.1, "tilt of lit pixels");
        const FrameResult frame = renderer.render(session.scene, tilt, request);
        const FittedLight& light = frame.lights.at(std::size_t(session.settings.view.light));
        if (!light.casts)
            throw Error(fmt::format("{}: light {} has no shadow map: {}; give another scene, or --no-scene",
                                    printable(session.scene_name), session.settings.view.light, light.reason));
        in.lookup = lookup_facts(session.settings, light, frame.map_size, renderer.driver().subpixel_bits);
        in.facts = facts_of_light(session.settings, light, frame.map_size, in.maps);
        in.facts_source = "as the scene's map is fitted";
        const auto angle =
            reference_angle_deg(renderer.read_float(frame.overlay, 4), renderer.read_float(frame.visibility, 1));
        in.facts.angle_deg = angle.value_or(in.facts.angle_deg);
        in.angle_source = angle ? "95 % of the scene's lit pixels are tilted less" : "no pixel of the scene is lit";
        report(0.2, "error");
        Measurer measurer(renderer, options.size.width, options.size.height, workers);
        const Classification classified = measurer.classify(session.scene, session.settings);
        ConvertedMeasure measure{.scene = in.scene,
                                 .width = options.size.width,
                                 .height = options.size.height,
                                 .area = session.settings.truth.area,
                                 .mae = classified.error.mae,
                                 .driver = renderer.driver().renderer};
        measure.wrong = classified.error.false_shadow + classified.error.false_light;
        measure.acne_px = classified.error.artefacts[std::size_t(Artefact::Acne)];
        if (options.time) {
            report(0.6, "time");
            const TimeMeasurement time = measurer.time(session.scene, session.settings, options.cost);
            measure.frame_ms = time.total_ms.median;
            measure.clock = time.clock;
        }
        in.measure = std::move(measure);
        notes.insert(notes.end(), classified.notes.begin(), classified.notes.end());
        return 0;
    });
}

}  // namespace

void run_convert(const ConvertOptions& options) {
    const ConvertTarget& target = convert_target(options.target);
    if (!options.output.empty()) {
        require_no_input(std::vector<std::filesystem::path>{options.output},
                         std::vector<std::filesystem::path>{options.session.preset, options.session.scene});
        require_writable(options.output);
    }
    SessionOptions opened = options.session;
    // The reference is hard, whatever the preset says, unless --area or --set follows.
    opened.sets.insert(opened.sets.begin(), "truth.area=false");
    if (!options.output.empty()) opened.outputs.emplace_back(options.output);
    const SessionPlan plan = plan_session(opened);
    ConversionInput in{.preset = printable(options.session.preset, std::string::npos),
                       .title = plan.preset->title,
                       .settings = plan.settings};
    std::vector<std::string> notes;
    in.lookup = lookup_facts(plan.settings);
    in.facts = facts_of_settings(plan.settings, in.facts_source);
    in.angle_source = "without a scene";
    if (options.use_scene && (!options.session.scene.empty() || !plan.preset->scene.empty())) {
        const Session session = open_session(opened);
        require_light(session.settings);
        notes = session.notes;
        measure_scene(options, session, in, notes);
    }
    require_light(in.settings);
    if (options.angle_deg) {
        in.facts.angle_deg = *options.angle_deg;
        in.angle_source = "by --angle";
    }
    const Conversion made = convert_settings(target, in);
    const std::string text = options.json ? json_text(made.json) : made.text;
    if (options.output.empty()) {
        fmt::print("{}", text);
    } else {
        write_file(options.output, text);
        print_wrote(options.output);
    }
    notes.insert(notes.end(), made.notes.begin(), made.notes.end());
    print_notes(notes);
}

}  // namespace si
