#include "app/editor/report_export.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "app/base/output.h"
#include "app/base/time_left.h"
#include "app/context/headless_context.h"
#include "app/report/picture_comparison.h"
#include "app/report/preset_report.h"
#include "app/session/command_line.h"
#include "renderer/base/error.h"
#include "renderer/base/printable.h"

namespace si {
namespace {

/// Returns a subject that no preset gives: its options set everything that differs from the scene's own settings.
ReportSubject unnamed_subject(const char* name, const std::string& scene_name, const Scene& scene,
                              const Settings& settings) {
    ReportSubject out{.name = name, .title = {}, .settings = settings, .options = {}};
    for (const std::string& set : session_plan(scene_name, scene, settings).sets) {
        out.options.emplace_back("--set");
        out.options.push_back(set);
    }
    return out;
}

}  // namespace

void ReportExport::start(const Scene& scene, glm::ivec2 size, const ReportRequest& request) {
    problem_.clear();
    wrote_.clear();
    taken_.clear();
    try {
        const std::vector<std::filesystem::path> outputs{request.output};
        require_output(request.output, "the report", {".html"});
        require_outputs_not_read(outputs, scene, state_.files.preset_path);
        require_outputs_not_read(outputs,
                                 std::vector<std::filesystem::path>(request.presets.begin(), request.presets.end()));
        std::error_code error;
        if (!request.replace && std::filesystem::exists(std::filesystem::symlink_status(request.output, error))) {
            taken_ = request.output;
            problem_ =
                fmt::format("{}: the file exists; press Replace, or choose another name", printable(request.output));
            return;
        }
        const std::string& name = state_.scene_name;
        std::vector<ReportSubject> subjects{unnamed_subject("present settings", name, scene, state_.settings)};
        if (request.pinned && state_.pinned)
            subjects.push_back(unnamed_subject("pinned settings A", name, scene,
                                               settings_with_shadows_of(state_.settings, state_.pinned->settings)));
        std::vector<std::string> notes;
        for (const std::string& preset : request.presets)
            subjects.push_back(
                preset_subject(scene, state_.settings, {.scene = name, .preset = preset, .sets = {}}, notes));
        for (const std::string& note : notes) state_.log.add(LogKind::Warning, note);
        PresetReportOptions options;
        if (request.pixel) options.pixels.push_back(*request.pixel);
        path_ = request.output;
        job_.start(
            [shown = std::make_shared<const Scene>(scene), name, subjects = std::move(subjects),
             size = glm::max(size, 1), options](const Workers& workers, const auto& report) {
                const HeadlessContext context;
                Renderer renderer;
                const TimeLeft left;
                PresetReport made = measure_report(renderer, *shown, name, subjects, size, options, workers,
                                                   [&](double share, const std::string& about) {
                                                       report({about, share, left.seconds(share)});
                                                   });
                made.version = SI_VERSION;
                return preset_report_html(made);
            },
            {"the present settings", 0});
    } catch (const Error& e) {
        problem_ = e.what();
    }
}

bool ReportExport::poll() {
    auto outcome = job_.poll();
    if (!outcome) return false;
    if (outcome->cancelled) {
        problem_ = fmt::format("Cancelled; {} was not written", printable(path_));
        return true;
    }
    try {
        if (outcome->problem) std::rethrow_exception(outcome->problem);
        write_regular_file(path_, *outcome->value);
        wrote_ = printable(path_);
        state_.log.add(LogKind::Info, "Wrote " + path_);
    } catch (const std::exception& e) {
        problem_ = e.what();
        state_.log.add(LogKind::Error, e.what());
    }
    return true;
}

ReportFacts ReportExport::facts() const {
    return {.writing = job_.progress(), .problem = problem_, .wrote = wrote_, .taken = taken_};
}

}  // namespace si
