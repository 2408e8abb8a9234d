#include "app/capture/capture_bundle.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/capture/helper.h"
#include "renderer/base/error.h"
#include "renderer/base/temporary_folder.h"

namespace si {
namespace {

namespace fs = std::filesystem;

/// Gives a finished folder the name of the output. @throws Error
void keep_capture_bundle(TemporaryFolder& folder, const fs::path& output) {
    std::error_code error;
    fs::permissions(folder.path(),
                    fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read |
                        fs::perms::others_exec,
                    error);
    fs::rename(folder.path(), output, error);
    if (error) throw Error(fmt::format("{}: cannot be written: {}", output.string(), error.message()));
    folder.release();
}

std::string capture_number(const Json& value) {
    return value.is_number() ? fmt::format("{:.3g}", value.get<double>()) : std::string("-");
}

/// Formats a pixel count or position of a region: "1022".
std::string capture_pixels(const Json& value) {
    return value.is_number() ? fmt::format("{:.6g}", value.get<double>()) : std::string("-");
}

}  // namespace

Json list_capture(const fs::path& capture, const CaptureProgress& progress) {
    auto candidates = Json::array();
    run_capture_helper({.capture = capture, .list = true}, {.progress = progress, .line = [&](const Json& line) {
                                                                if (line.contains("candidate"))
                                                                    candidates.push_back(line["candidate"]);
                                                            }});
    return candidates;
}

void require_new_bundle(const fs::path& path) {
    if (path.extension() != ".bundle")
        throw UsageError(fmt::format("{}: the bundle's name must end in .bundle", path.string()));
    if (is_taken(path)) throw Error(fmt::format("{}: exists; remove it or name another", path.string()));
    require_writable(path);
}

Json write_capture_bundle(const fs::path& capture, const std::vector<int>& picks, const fs::path& output,
                          const CaptureProgress& progress) {
    require_new_bundle(output);
    // Unwinding removes what is unfinished.
    TemporaryFolder folder(fs::path(output) += ".new-XXXXXX");
    if (folder.path().empty()) throw Error(fmt::format("{}: cannot be written: {}", output.string(), errno_text()));
    auto summary = Json::object();
    run_capture_helper({.capture = capture, .picks = picks, .output = folder.path()},
                       {.progress = progress, .line = [&](const Json& line) { summary = line; }});
    keep_capture_bundle(folder, output);
    return summary;
}

std::string candidate_text(const Json& c) {
    std::string out = fmt::format("texture {}", c.value("texture", std::uint64_t{0}));
    if (c.contains("slice")) out += fmt::format(", slice {} of {}", c.value("slice", 0), c.value("layers", 1));
    out += fmt::format(", {} x {}", c.value("width", 0), c.value("height", 0));
    if (const auto view = c.find("viewport"); view != c.end() && view->is_array() && view->size() == 4)
        out += fmt::format(" (region {} x {} at {}, {})", capture_pixels((*view)[2]), capture_pixels((*view)[3]),
                           capture_pixels((*view)[0]), capture_pixels((*view)[1]));
    out += fmt::format(", {}", one_line(c.value("format", std::string())));
    out += c.contains("state") ? fmt::format(", {}", one_line(c.value("state", std::string())))
                               : fmt::format(", {} draws", c.value("draws", 0));
    if (c.contains("light")) out += fmt::format(", {}", one_line(c.value("light", std::string())));
    for (const char* member : {"centre", "direction"})
        if (const auto at = c.find(member); at != c.end() && at->is_array() && at->size() == 3)
            out += fmt::format(", {} {} {} {}", member, capture_number((*at)[0]), capture_number((*at)[1]),
                               capture_number((*at)[2]));
    return out;
}

std::string gate_text(const Json& g) {
    const char* verdict = g.value("passed", false) ? "agrees" : "DIFFERS";
    if (!g.contains("captured_texels"))
        return fmt::format("{}: {}: {:.2f} % of {} pixels have the captured depth", g.value("name", std::string()),
                           verdict, 100 * g.value("agree", 0.0), g.value("pixels", 0));
    std::string out =
        fmt::format("{}: {}: {} draws, {} texels, {} missed, {} extra", g.value("name", std::string()), verdict,
                    g.value("draws", 0), g.value("captured_texels", 0), g.value("missed", 0), g.value("extra", 0));
    if (const auto depth = g.find("depth"); depth != g.end() && depth->contains("median_steps"))
        out += fmt::format(", depth off by {} steps (median), {} (99 %)", capture_number((*depth)["median_steps"]),
                           capture_number((*depth)["percentile_99_steps"]));
    if (g.value("shader_bias", false)) out += ", moved by the casters' shader";
    if (const int count = g.value("masked_draws", 0)) out += fmt::format(", {} masked draws", count);
    if (const int count = g.value("post_vertex_draws", 0)) out += fmt::format(", {} skinned draws", count);
    if (const int count = g.value("not_finite", 0)) out += fmt::format(", {} texels NaN or infinite", count);
    return out;
}

std::vector<std::string> capture_notes(const Json& summary) {
    std::vector<std::string> out;
    for (const Json& note : summary.value("notes", Json::array()))
        if (note.is_string()) out.push_back(one_line(note.get<std::string>()));
    return out;
}

}  // namespace si
