// Shadow maps of a RenderDoc capture, listed or written as a bundle.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/base/json_text.h"
#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/capture/helper.h"
#include "app/commands/commands.h"
#include "app/commands/interruptible.h"
#include "app/report/report.h"
#include "renderer/base/error.h"
#include "renderer/base/temporary_folder.h"

namespace si {
namespace {

namespace fs = std::filesystem;

/// Gives a finished folder the name of the output. @throws Error
void keep_bundle(TemporaryFolder& folder, const fs::path& output) {
    std::error_code error;
    fs::permissions(folder.path(),
                    fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read |
                        fs::perms::others_exec,
                    error);
    fs::rename(folder.path(), output, error);
    if (error) throw Error(fmt::format("{}: cannot be written: {}", output.string(), error.message()));
    folder.release();
}

/// Checks before long work that a new folder can be made at `path`. @throws UsageError, Error
void require_new_bundle(const fs::path& path) {
    if (path.extension() != ".bundle")
        throw UsageError(fmt::format("{}: the bundle's name must end in .bundle", path.string()));
    std::error_code error;
    if (fs::exists(fs::symlink_status(path, error)))
        throw Error(fmt::format("{}: exists; remove it or name another", path.string()));
    require_writable(path);
}

std::string number_text(const Json& value) {
    return value.is_number() ? fmt::format("{:.3g}", value.get<double>()) : std::string("-");
}

/// Formats one candidate for people: "0  texture 242, slice 1, 1024 x 1024, D16, 30 draws, directional".
std::string candidate_line(const Json& c) {
    std::string out = fmt::format("{:3}  texture {}", c.value("number", 0), c.value("texture", std::uint64_t{0}));
    if (c.contains("slice")) out += fmt::format(", slice {} of {}", c.value("slice", 0), c.value("layers", 1));
    out += fmt::format(", {} x {}", c.value("width", 0), c.value("height", 0));
    if (const auto view = c.find("viewport"); view != c.end() && view->is_array() && view->size() == 4)
        out += fmt::format(" (region {} x {} at {}, {})", number_text((*view)[2]), number_text((*view)[3]),
                           number_text((*view)[0]), number_text((*view)[1]));
    out += fmt::format(", {}", one_line(c.value("format", std::string())));
    out += c.contains("state") ? fmt::format(", {}", one_line(c.value("state", std::string())))
                               : fmt::format(", {} draws", c.value("draws", 0));
    if (c.contains("light")) out += fmt::format(", {}", one_line(c.value("light", std::string())));
    for (const char* member : {"centre", "direction"})
        if (const auto at = c.find(member); at != c.end() && at->is_array() && at->size() == 3)
            out += fmt::format(", {} {} {} {}", member, number_text((*at)[0]), number_text((*at)[1]),
                               number_text((*at)[2]));
    return out;
}

/// Formats what the comparison of a map with its casters found.
std::string gate_line(const Json& g) {
    const char* verdict = g.value("passed", false) ? "agrees" : "DIFFERS";
    if (!g.contains("captured_texels"))
        return fmt::format("{}: {}: {:.2f} % of {} pixels have the captured depth", g.value("name", std::string()),
                           verdict, 100 * g.value("agree", 0.0), g.value("pixels", 0));
    std::string out =
        fmt::format("{}: {}: {} draws, {} texels, {} missed, {} extra", g.value("name", std::string()), verdict,
                    g.value("draws", 0), g.value("captured_texels", 0), g.value("missed", 0), g.value("extra", 0));
    if (const auto depth = g.find("depth"); depth != g.end() && depth->contains("median_steps"))
        out += fmt::format(", depth off by {} steps (median), {} (99 %)", number_text((*depth)["median_steps"]),
                           number_text((*depth)["percentile_99_steps"]));
    if (g.value("shader_bias", false)) out += ", moved by the casters' shader";
    if (const int count = g.value("masked_draws", 0)) out += fmt::format(", {} masked draws", count);
    if (const int count = g.value("post_vertex_draws", 0)) out += fmt::format(", {} skinned draws", count);
    if (const int count = g.value("not_finite", 0)) out += fmt::format(", {} texels NaN or infinite", count);
    return out;
}

}  // namespace

void run_import_capture(const ImportCaptureOptions& options) {
    if (!options.list) {
        if (options.output.empty()) throw UsageError("--output is required, or --list");
        require_new_bundle(options.output);
    }
    const CaptureRequest request{.capture = options.capture, .list = options.list, .picks = options.picks};
    auto lines = Json::array();
    const auto run = [&](CaptureRequest work, bool write) {
        interruptible("nothing was written", [&](const Workers& workers, const auto& report) {
            const CaptureReports reports{.progress =
                                             [&](double share, const std::string& label) {
                                                 // A capture that cannot be opened gets one line.
                                                 share > 0 ? report(share, label) : workers.progress(0);
                                                 return !workers.stop.stop_requested();
                                             },
                                         .line = [&](const Json& line) { lines.push_back(line); }};
            // Unwinding removes what is unfinished: a signal ends the program later.
            std::optional<TemporaryFolder> bundle;
            if (write) {
                work.output = bundle.emplace(options.output + ".new-XXXXXX").path();
                if (work.output.empty())
                    throw Error(fmt::format("{}: cannot be written: {}", options.output, errno_text()));
            }
            run_capture_helper(work, reports);
            if (bundle) keep_bundle(*bundle, options.output);
            return 0;
        });
    };
    if (options.list) {
        run(request, false);
        auto candidates = Json::array();
        for (const Json& line : lines)
            if (line.contains("candidate")) candidates.push_back(line["candidate"]);
        if (options.json) {
            fmt::print("{}", json_text(candidates));
            return;
        }
        for (const Json& candidate : candidates) fmt::print("{}\n", candidate_line(candidate));
        return;
    }
    run(request, true);
    const Json summary = lines.empty() ? Json::object() : lines.back();
    if (options.json) {
        fmt::print("{}", json_text(summary));
        return;
    }
    for (const Json& gate : summary.value("gate", Json::array())) fmt::print("{}\n", gate_line(gate));
    print_wrote(options.output);
    std::vector<std::string> notes;
    for (const Json& note : summary.value("notes", Json::array()))
        if (note.is_string()) notes.push_back(one_line(note.get<std::string>()));
    print_notes(notes);
}

}  // namespace si
