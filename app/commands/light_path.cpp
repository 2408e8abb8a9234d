#include "app/commands/light_path.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/commands/interruptible.h"
#include "app/context/headless_context.h"
#include "app/report/health_report.h"
#include "app/report/light_path_report.h"
#include "app/report/report.h"
#include "app/session/presets.h"
#include "renderer/base/atomic_file.h"
#include "renderer/base/command_text.h"
#include "renderer/base/error.h"
#include "renderer/base/lengths_text.h"
#include "renderer/base/regular_file.h"

namespace si {
namespace {

namespace fs = std::filesystem;

/// Returns the options of a command line that give the session, each with a space before it.
std::string session_words(const SessionOptions& session) {
    std::string text;
    if (!session.preset.empty()) text += " --preset " + shell_quoted(session.preset);
    if (!session.profile.empty()) text += " --profile " + shell_quoted(session.profile);
    for (const std::string& set : session.sets) text += " --set " + shell_quoted(set);
    return text;
}

std::string path_words(const PathSweepOptions& options) {
    const std::string path =
        options.along.empty() ? " --day " + shell_quoted(options.day) : " --along " + shell_quoted(options.along);
    return fmt::format(
        "{} --steps {} --size {}x{}{}{} -o {}", path, options.steps, options.size.width, options.size.height,
        options.error.empty() ? std::string() : " --error " + shell_quoted(options.error),
        options.timing.on ? fmt::format(" --cost {}", cost_row(options.cost).key) : std::string(" --no-time"),
        shell_quoted(options.output));
}

void print_result(const LightPathReport& report) {
    const Metric& metric = *report.metric;
    const LightPathResult& r = report.measured;
    const std::size_t worst = r.worst(metric);
    fmt::print("{}: {} steps; {}\n", r.path.about, r.steps.size(), metric.label);
    for (std::size_t i = 0; i < r.steps.size(); ++i) {
        const PathStep& step = r.steps[i];
        std::string values;
        for (const auto& [key, value] : step.point.values)
            values += fmt::format("{}{}={}", values.empty() ? "" : " ", key, value);
        fmt::print("  {:<48} {:>9.5f}", values, metric.value(step.error));
        if (step.time) fmt::print("  {:>8} ms", digits_text(step.time->total_ms.median));
        if (step.change) fmt::print("  shimmer {:.5f}", step.change->beyond);
        fmt::print("{}\n", i == worst ? "  worst" : "");
    }
    if (!r.clock.empty()) fmt::print("times by {}\n", r.clock);
}

/// Folder for the files of a path. The folders that had to be made for it are removed again while they are empty.
class PathFolder {
public:
    /// @throws Error when the folder cannot be made
    explicit PathFolder(const fs::path& folder) {
        std::error_code error;
        for (fs::path f = folder; !f.empty() && !fs::exists(f, error); f = f.parent_path()) made_.push_back(f);
        make_folders(folder);
    }
    ~PathFolder() { remove_empty(); }
    PathFolder(const PathFolder&) = delete;
    PathFolder& operator=(const PathFolder&) = delete;

    /// Removes the folders that were made, if nothing was written.
    void remove_empty() const {
        std::error_code error;
        for (const fs::path& folder : made_) fs::remove(folder, error);  // fails if files are in the folder
    }

private:
    std::vector<fs::path> made_;  ///< innermost first
};

/// Throws unless the files of a path were written by this command, or do not exist.
/// @param files path.json first
void require_own_files(const std::array<fs::path, 3>& files) {
    constexpr std::size_t kMostBytes = std::size_t{256} << 20;
    const ReadResult read = read_regular_file(files[0], kMostBytes);
    const std::span<const std::uint8_t> bytes = read.bytes.span();
    const Json json = Json::parse(bytes.begin(), bytes.end(), nullptr, false);
    if (json.is_object() && json.contains("format") && json["format"] == Json(kLightPathFormat)) return;
    for (const fs::path& file : files)
        if (is_taken(file))
            throw Error(
                fmt::format("{}: exists, and no {} says that a path's sweep wrote it; choose another folder, or "
                            "move it away",
                            file.string(), files[0].filename().string()));
}

void run_path(const PathSweepOptions& options) {
    if (!options.vary.empty())
        throw UsageError("--vary: a sweep varies settings, or moves a light by --along or --day; leave one out");
    if (!options.along.empty() && !options.day.empty())
        throw UsageError("--day: --along gives a path already; leave one out");
    if (!options.shard.empty()) throw UsageError("--shard: a path is measured in one run; leave it out");
    if (options.retry) throw UsageError("--retry: a path keeps no failed cases; leave it out");
    if (options.fresh) throw UsageError("--fresh: a path is always measured from its start; leave it out");
    const Metric& metric = tuned_error(options.error);
    if (!options.worst_preset.empty()) require_output(options.worst_preset, "the preset", {".json"});
    const fs::path folder = options.output;
    const std::array<fs::path, 3> files = {folder / "path.json", folder / "path.csv", folder / "path.html"};
    SessionOptions opened = options.session;
    opened.outputs.insert(opened.outputs.end(), files.begin(), files.end());
    const Session session = open_session(opened);
    const LightPath path = options.along.empty() ? day_path(options.day, options.steps, session.settings)
                                                 : straight_path(options.along, options.steps, session.settings);
    const PathFolder made(folder);
    for (const fs::path& file : files) {
        require_regular(file);
        require_writable(file);
    }
    require_own_files(files);
    const HeadlessContext context;
    Renderer renderer;
    const NumberWatch numbers(renderer, session.settings, options.check_numeric);
    LightPathReport report{.scene = session.scene_name,
                           .width = options.size.width,
                           .height = options.size.height,
                           .area = session.settings.truth.area,
                           .renderer = renderer.driver().renderer,
                           .metric = &metric};
    const LightPathOptions timing{.time = options.timing.on, .cost = options.cost};
    const Classification worst_frame =
        interruptible("nothing was written", [&](const Workers& workers, const auto& progress) {
            try {
                report.measured = measure_light_path(renderer, session.scene, session.settings, report.width,
                                                     report.height, path, timing, workers, progress);
                const PathPoint& point = report.measured.steps[report.measured.worst(metric)].point;
                return Measurer(renderer, report.width, report.height, workers)
                    .classify(session.scene, settings_at(session.settings, point));
            } catch (const Cancelled&) {
                made.remove_empty();  // the program ends without destroying objects
                throw;
            }
        });
    const PathPoint& worst = report.measured.steps[report.measured.worst(metric)].point;
    report.worst_picture = worst_frame.picture;
    report.worst_artefacts = worst_frame.artefacts;
    const std::string scene = shell_quoted(session.scene_name), words = session_words(options.session);
    report.command = "shadow-inspector sweep " + scene + words + path_words(options);
    report.worst_command = fmt::format("shadow-inspector edit {}{} {}", scene, words, set_options_text(worst.values));
    write_regular_file(files[0], json_text(light_path_json(report)));
    write_regular_file(files[1], light_path_csv(report));
    write_regular_file(files[2], light_path_html(report));
    if (!options.worst_preset.empty())
        save_preset({"", "",
                     fmt::format("Worst step of {}: {} {:.5f}", path.about, metric.label,
                                 metric.value(report.measured.steps[report.measured.worst(metric)].error)),
                     scene_for_preset(session.scene_name, options.worst_preset), settings_at(session.settings, worst)},
                    options.worst_preset);
    print_result(report);
    if (!options.worst_preset.empty()) print_wrote(options.worst_preset);
    print_wrote(files[2]);
    print_notes(session.notes);
    numbers.require_sound();
}

}  // namespace

void run_path_sweep(const PathSweepOptions& options) {
    if (options.has_path()) return run_path(options);
    if (!options.worst_preset.empty())
        throw UsageError("--worst-preset: only a path has a worst step; add --along or --day");
    if (options.vary.empty())
        throw UsageError("--vary is required, or a path of a light: --along or --day (run with --help for details)");
    run_sweep(options);
}

}  // namespace si
