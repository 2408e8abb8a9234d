#include "app/editor/frame_import.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

#include "app/base/json_text.h"
#include "app/capture/capture_bundle.h"
#include "app/editor/requests.h"
#include "renderer/base/error.h"
#include "ui/widgets/free_name.h"

namespace si {
namespace {

namespace fs = std::filesystem;

/// Returns a free name for the bundle of a file: beside it if files can be made there, else in the current folder, else
/// in the folder of temporary files.
fs::path proposed_bundle(const fs::path& file) {
    std::error_code error;
    const fs::path whole = fs::absolute(file, error);
    const std::array folders = {whole.parent_path(), fs::current_path(error), fs::temp_directory_path(error)};
    const auto writable =
        std::ranges::find_if(folders, [](const fs::path& folder) { return ::access(folder.c_str(), W_OK) == 0; });
    const fs::path folder = writable != folders.end() ? *writable : folders.back();
    return free_bundle_path(folder, whole.stem().string());
}

/// Returns the file of a light that probably belongs to an image of a map: NAME.json beside it, else light.json.
fs::path proposed_light(const fs::path& image) {
    std::error_code error;
    const fs::path own = fs::path(image).replace_extension(".json"), common = image.parent_path() / "light.json";
    return !fs::exists(own, error) && fs::exists(common, error) ? common : own;
}

/// Returns the progress of a capture's helper as a job's progress, reported where it visibly changes.
template <typename Report>
CaptureProgress capture_progress(const Workers& workers, const Report& report) {
    return [stop = workers.stop, report, percent = -1, shown = std::string()](double share,
                                                                              const std::string& doing) mutable {
        const int now = int(share * 100);
        if (now != percent || doing != shown) report({share, doing});
        percent = now;
        shown = doing;
        return !stop.stop_requested();
    };
}

std::vector<ImportChoice> capture_choices(const Json& candidates) {
    std::vector<ImportChoice> out;
    for (const Json& candidate : candidates)
        out.push_back({.number = candidate.value("number", 0), .text = candidate_text(candidate)});
    return out;
}

/// Returns lines of the log about a written bundle of a capture: comparison of each map, and remarks.
std::vector<LogLine> capture_lines(const Json& summary) {
    std::vector<LogLine> out;
    for (const Json& gate : summary.value("gate", Json::array()))
        out.push_back({gate.value("passed", false) ? LogKind::Info : LogKind::Warning, gate_text(gate)});
    for (const std::string& note : capture_notes(summary)) out.push_back({LogKind::Info, note});
    return out;
}

}  // namespace

void FrameImport::open(const fs::path& path, FrameFileKind kind) {
    end_import();
    file_ = path;
    kind_ = kind;
    if (kind == FrameFileKind::MapImage) {
        step_ = ImportStep::Light;
        state_.import_dialog = {.picks = {},
                                .output = proposed_bundle(path).string(),
                                .light = proposed_light(path).string(),
                                .over_scene = scenes_.scene() != nullptr};
        return;
    }
    if (persistence_.workspace().capture_warned)
        start_reading();
    else
        step_ = ImportStep::Warning;
}

void FrameImport::start_step(ImportStep step, const char* doing, Work::Work work) {
    step_ = step;
    problem_.clear();
    began_ = std::chrono::steady_clock::now();
    job_.start(std::move(work), {0, doing});
}

void FrameImport::start_reading() {
    if (kind_ == FrameFileKind::Capture)
        return start_step(ImportStep::Reading, "opening", [file = file_](const Workers& workers, const auto& report) {
            Made made;
            made.choices = capture_choices(list_capture(file, capture_progress(workers, report)));
            if (made.choices.empty())
                throw Error(
                    fmt::format("{}: no shadow map was found; capture a frame that draws or reads one", file.string()));
            return made;
        });
    const std::string scene = state_.import_dialog.over_scene && scenes_.scene() ? state_.scene_name : std::string();
    start_step(ImportStep::Reading, "comparing the conventions",
               [file = file_, light = fs::path(state_.import_dialog.light), scene,
                choices = file_choices(state_.settings.scene)](const Workers& workers, const auto&) {
                   Made made;
                   made.map = std::make_shared<const MapImport>(read_map_import(file, light, scene, {}, choices));
                   if (workers.stop.stop_requested()) throw Cancelled();
                   made.choices = reading_choices(*made.map);
                   return made;
               });
}

void FrameImport::start_writing() {
    const std::string output = state_.import_dialog.output;
    require_new_bundle(output);
    output_ = output;
    std::vector<int> picks = state_.import_dialog.picks;
    std::ranges::sort(picks);
    if (kind_ == FrameFileKind::MapImage)
        return start_step(ImportStep::Writing, "writing",
                          [map = map_, pick = picks.empty() ? 0 : picks.front(), output](const Workers&, const auto&) {
                              Made made;
                              for (const std::string& line : write_map_import(*map, std::size_t(pick) - 1, output))
                                  made.lines.push_back({LogKind::Info, line});
                              return made;
                          });
    start_step(
        ImportStep::Writing, "opening", [file = file_, picks, output](const Workers& workers, const auto& report) {
            Made made;
            made.lines = capture_lines(write_capture_bundle(file, picks, output, capture_progress(workers, report)));
            return made;
        });
}

bool FrameImport::fulfil(const ImportRequests& requests) {
    if (!step_) return false;
    if (requests.cancel_import) {
        state_.log.add(LogKind::Info, fmt::format("Cancelled: {} was not imported", file_.string()));
        end_import();
        return true;
    }
    const auto try_step = [&](const auto& work) {
        try {
            work();
        } catch (const std::exception& e) {
            problem_ = e.what();
        }
    };
    if (requests.start_import && step_ == ImportStep::Warning) persistence_.note_capture_warning();
    if (requests.start_import) try_step([&] { start_reading(); });
    if (requests.write_import && step_ == ImportStep::Choosing) try_step([&] { start_writing(); });
    return requests.start_import || requests.write_import;
}

void FrameImport::show_choices(Made made) {
    step_ = ImportStep::Choosing;
    choices_ = std::move(made.choices);
    map_ = std::move(made.map);
    ImportDialog& dialog = state_.import_dialog;
    dialog.picks.clear();
    if (kind_ == FrameFileKind::MapImage) {
        // A single best reading is chosen; of several the user takes one.
        const auto fits = [](const ImportChoice& choice) { return choice.usable && choice.fits; };
        if (std::ranges::count_if(choices_, fits) == 1) dialog.picks = {std::ranges::find_if(choices_, fits)->number};
        return;
    }
    for (const ImportChoice& choice : choices_) dialog.picks.push_back(choice.number);
    dialog.output = proposed_bundle(file_).string();
}

bool FrameImport::poll() {
    std::optional<Work::Outcome> outcome = job_.poll();
    if (!outcome) return false;
    if (!step_ || outcome->cancelled) return true;
    if (!outcome->value) {
        const std::string problem = exception_message(outcome->problem);
        if (kind_ == FrameFileKind::MapImage && step_ == ImportStep::Reading) {
            step_ = ImportStep::Light;  // the user may name another file
            problem_ = problem;
            return true;
        }
        end_import();
        report(state_, problem);
        return true;
    }
    if (step_ == ImportStep::Reading) {
        show_choices(std::move(*outcome->value));
        return true;
    }
    const std::string bundle = std::exchange(output_, {});
    end_import();
    for (const LogLine& line : outcome->value->lines) state_.log.add(line.kind, line.text);
    state_.log.add(LogKind::Info, "Wrote " + bundle);
    attempt(state_, [&] { scenes_.load({.scene_name = bundle}); });
    return true;
}

void FrameImport::end_import() {
    job_.cancel();
    step_.reset();
    choices_.clear();
    map_.reset();
    problem_.clear();
}

bool FrameImport::has_news() const {
    if (!step_ || !job_.busy()) return job_.has_news();
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - began_;
    return job_.has_news() || int(passed.count()) != shown_seconds_;
}

std::optional<ImportFacts> FrameImport::facts() const {
    if (!step_) return {};
    ImportFacts out{.step = *step_,
                    .is_capture = kind_ == FrameFileKind::Capture,
                    .file = file_.string(),
                    .choices = choices_,
                    .problem = problem_};
    if (const auto progress = job_.progress()) {
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - began_;
        out.seconds = passed.count();
        shown_seconds_ = int(out.seconds);
        out.doing = progress->doing;
        out.progress = progress->share;
    }
    return out;
}

}  // namespace si
