#include "app/commands/report.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/commands/interruptible.h"
#include "app/context/headless_context.h"
#include "app/report/preset_report.h"
#include "renderer/base/command_text.h"

namespace si {
namespace {

std::string command_of(const ReportOptions& options, const std::string& scene) {
    std::string text = "shadow-inspector report " + shell_quoted(scene);
    for (const std::string& preset : options.presets) text += " --preset " + shell_quoted(preset);
    for (const std::string& set : options.session.sets) text += " --set " + shell_quoted(set);
    for (const std::string& pixel : options.pixels) text += " --pixel " + shell_quoted(pixel);
    text += fmt::format(" --size {}x{}", options.size.width, options.size.height);
    text += options.time ? fmt::format(" --cost {}", cost_row(options.cost).key) : std::string(" --no-time");
    return text + " -o " + shell_quoted(options.output);
}

}  // namespace

void run_report(const ReportOptions& options) {
    require_output(options.output, "the report", {".html"});
    PresetReportOptions what{.pixels = {}, .time = options.time, .cost = options.cost};
    for (const std::string& text : options.pixels) {
        const auto [x, y] = parse_pixel(text, options.size);
        what.pixels.emplace_back(x, y);
    }
    require_outputs_not_read(std::vector<std::filesystem::path>{options.output},
                             std::vector<std::filesystem::path>(options.presets.begin(), options.presets.end()));
    SessionOptions first = options.session;
    first.preset = options.presets.front();
    Session session = open_session(first);
    std::vector<std::string> notes = session.notes, repeated;
    std::vector<ReportSubject> subjects;
    for (const std::string& preset : options.presets) {
        SessionOptions given = first;
        given.preset = preset;
        given.scene = session.scene_name;
        subjects.push_back(preset_subject(session.scene, session.settings, given, subjects.empty() ? repeated : notes));
    }
    const HeadlessContext context;
    Renderer renderer;
    PresetReport report =
        interruptible(options.output + " was not written", [&](const Workers& workers, const auto& progress) {
            return measure_report(renderer, std::move(session.scene), session.scene_name, std::move(subjects),
                                  {options.size.width, options.size.height}, what, workers, progress);
        });
    report.command = command_of(options, session.scene_name);
    report.version = SI_VERSION;
    write_file(options.output, preset_report_html(report));
    print_wrote(options.output);
    print_notes(notes);
}

}  // namespace si
