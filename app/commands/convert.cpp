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
#include "app/convert/measured_conversion.h"
#include "app/report/report.h"
#include "app/session/session.h"
#include "renderer/base/error.h"
#include "renderer/base/printable.h"

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
    const MeasuredConversion measured =
        interruptible("nothing was written", [&](const Workers& workers, const auto& report) {
            const HeadlessContext context;
            Renderer renderer;
            ReferenceCache cache;
            return measure_conversion(
                {renderer, session.scene, options.size.width, options.size.height, cache, workers, report},
                session.settings, session.scene_name, options.time ? std::optional(options.cost) : std::nullopt);
        });
    in.lookup = measured.lookup;
    in.facts = measured.facts;
    in.maps = measured.maps;
    in.facts_source = "as the scene's map is fitted";
    in.facts.angle_deg = measured.angle_deg.value_or(in.facts.angle_deg);
    in.angle_source = angle_source(measured);
    in.measure = measured.measure;
    notes.insert(notes.end(), measured.notes.begin(), measured.notes.end());
}

}  // namespace

void run_convert(const ConvertOptions& options) {
    const ConvertTarget& target = convert_target(options.target);
    if (!options.output.empty()) {
        require_outputs_not_read(std::vector<std::filesystem::path>{options.output},
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
