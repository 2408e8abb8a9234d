// Shadow maps of a RenderDoc capture, listed or written as a bundle.
#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "app/base/json_text.h"
#include "app/base/notes.h"
#include "app/capture/capture_bundle.h"
#include "app/commands/commands.h"
#include "app/commands/interruptible.h"
#include "app/report/report.h"
#include "renderer/base/error.h"

namespace si {
namespace {

/// Runs work on a capture with a progress line that Ctrl+C can stop. Returns what the work does.
template <class Work>
Json with_progress(const Work& work) {
    return interruptible("nothing was written", [&](const Workers& workers, const auto& report) {
        return work([&](double share, const std::string& label) {
            // A capture that cannot be opened gets one line.
            share > 0 ? report(share, label) : workers.progress(0);
            return !workers.stop.stop_requested();
        });
    });
}

}  // namespace

void run_import_capture(const ImportCaptureOptions& options) {
    if (options.list) {
        const Json candidates =
            with_progress([&](const CaptureProgress& progress) { return list_capture(options.capture, progress); });
        if (options.json) {
            fmt::print("{}", json_text(candidates));
            return;
        }
        for (const Json& candidate : candidates)
            fmt::print("{:3}  {}\n", candidate.value("number", 0), candidate_text(candidate));
        return;
    }
    if (options.output.empty()) throw UsageError("--output is required, or --list");
    require_new_bundle(options.output);
    const Json summary = with_progress([&](const CaptureProgress& progress) {
        return write_capture_bundle(options.capture, options.picks, options.output, progress);
    });
    if (options.json) {
        fmt::print("{}", json_text(summary));
        return;
    }
    for (const Json& gate : summary.value("gate", Json::array())) fmt::print("{}\n", gate_text(gate));
    print_wrote(options.output);
    print_notes(capture_notes(summary));
}

}  // namespace si
