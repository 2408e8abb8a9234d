// Errors of a picture against limits, for continuous integration.
#include "app/commands/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/base/exit_code.h"
#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/capture/capture_bundle.h"
#include "app/commands/interruptible.h"
#include "app/context/headless_context.h"
#include "app/report/check.h"
#include "app/report/measure_json.h"
#include "app/report/report.h"
#include "app/report/shown_engine_bias.h"
#include "renderer/base/lower_case.h"
#include "renderer/base/regular_file.h"
#include "renderer/base/temporary_folder.h"
#include "renderer/measure/measure.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxJunitBytes = std::size_t{16} << 20;  ///< of an older report that is replaced

/// Measured picture with all that is reported of it.
struct CheckedFrame {
    CheckedPicture picture;
    ErrorMetrics error;
    double noise = 0;  ///< of the reference
    EngineBias bias = EngineBias::Own;
    Json driver;
    std::vector<CheckFinding> findings;
    std::vector<std::string> notes;
    double seconds = 0;
};

/// Function that receives the share 0..1 of the work that is done, and a label.
using CheckProgress = std::function<void(double, const std::string&)>;

CheckLimits limits_of(const CheckOptions& options) {
    CheckLimits out{.error = options.max_error, .metric = &checked_error(options.error)};
    if (!options.max_acne.empty()) out.acne = parse_pixel_limit(options.max_acne, "--max-acne");
    if (!options.max_wrong.empty()) out.wrong = parse_pixel_limit(options.max_wrong, "--max-wrong");
    if (!options.tolerance.empty()) out.tolerance = parse_pixel_limit(options.tolerance, "--tolerance");
    if (!out.acne && !out.wrong && !out.error && options.baseline.empty() && options.write_baseline.empty())
        throw UsageError(
            "check: no limit is given; give --max-acne, --max-wrong, --max-error or --baseline, or write a baseline "
            "by --write-baseline");
    if (out.tolerance && options.baseline.empty())
        throw UsageError("--tolerance: is of a baseline; give --baseline FILE, too");
    if (!options.error.empty() && !out.error && options.baseline.empty())
        throw UsageError("--error: is the error that --max-error or --baseline limits; give one of them, too");
    return out;
}

/// Checks before long work that the files can be written and replace no input. @throws UsageError, Error
void require_check_outputs(const CheckOptions& options) {
    if (!options.junit.empty()) require_writable(options.junit);
    if (!options.write_baseline.empty()) require_output(options.write_baseline, "a baseline", {".json"});
    require_distinct(options.junit, "--junit", options.write_baseline, "--write-baseline");
    require_outputs_not_read(std::vector<fs::path>{options.junit, options.write_baseline},
                             std::vector<fs::path>{options.session.scene, options.session.preset, options.baseline});
}

/// Replaces each place of a text that says `from` by `to`.
std::string with_name(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

/// Opens the bundle of a capture. Remarks and errors name the capture, since the bundle does not stay.
/// @throws UsageError, Error
Session open_bundle_of(const std::string& capture, const SessionOptions& bundle) {
    try {
        Session session = open_session(bundle);
        for (std::string& note : session.notes) note = with_name(note, bundle.scene, capture);
        return session;
    } catch (const UsageError& e) {
        throw UsageError(with_name(e.what(), bundle.scene, capture));
    } catch (const Cancelled&) {
        throw;
    } catch (const Error& e) {
        throw Error(with_name(e.what(), bundle.scene, capture));
    }
}

/// Opens the session of the options. A capture becomes a bundle in `folder` first.
Session open_checked_session(const CheckOptions& options, std::optional<TemporaryFolder>& folder,
                             const Workers& workers, const CheckProgress& report, std::vector<std::string>& notes) {
    SessionOptions session = options.session;
    // The reference is hard, whatever a preset says, unless --area or --set follows.
    session.sets.insert(session.sets.begin(), "truth.area=false");
    if (lower_extension(session.scene) == ".rdc") {
        folder.emplace(make_temporary_folder("shadow-inspector-check"));
        const fs::path bundle = folder->path() / "capture.bundle";
        const Json summary =
            write_capture_bundle(session.scene, {}, bundle, [&](double share, const std::string& label) {
                // A capture that cannot be opened gets one line.
                share > 0 ? report(0.5 * share, label) : workers.progress(0);
                return !workers.stop.stop_requested();
            });
        for (const Json& gate : summary.value("gate", Json::array()))
            if (!gate.value("passed", false)) notes.push_back(one_line(gate_text(gate)));
        session.scene = bundle.string();
        return open_bundle_of(options.session.scene, session);
    }
    return open_session(session);
}

std::string driver_name(const DriverInfo& driver) {
    return fmt::format("{}, {}, {}", driver.vendor, driver.renderer, driver.version);
}

CheckedFrame checked_frame(const CheckOptions& options, const CheckLimits& limits, const Workers& workers,
                           const CheckProgress& report) {
    const auto began = std::chrono::steady_clock::now();
    CheckedFrame out;
    std::optional<CheckBaseline> baseline;
    if (!options.baseline.empty())
        baseline = parse_check_baseline(read_text_file(options.baseline), options.baseline, *limits.metric);
    std::optional<TemporaryFolder> folder;  // outlives the session, whose maps may be read late
    const Session session = open_checked_session(options, folder, workers, report, out.notes);
    const HeadlessContext context;
    Renderer renderer;
    out.picture = {.width = options.size.width,
                   .height = options.size.height,
                   .light = session.settings.view.light,
                   .area = session.settings.truth.area,
                   .driver = driver_name(renderer.driver()),
                   .meaning = kErrorMeaning};
    if (baseline)
        for (std::string& remark : require_same_conditions(*baseline, out.picture, limits.tolerance.has_value()))
            out.notes.push_back(std::move(remark));
    Measurer measurer(renderer, options.size.width, options.size.height, workers);
    const Classification classified = measurer.classify(session.scene, session.settings);
    out.error = classified.error;
    out.noise = classified.reference->noise;
    out.bias = shown_engine_bias(session.settings, classified.lights);
    out.driver = driver_json(renderer.driver());
    out.findings = check_findings(classified.error, limits, baseline ? &*baseline : nullptr);
    out.notes.insert(out.notes.end(), session.notes.begin(), session.notes.end());
    out.notes.insert(out.notes.end(), classified.notes.begin(), classified.notes.end());
    out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return out;
}

/// Writes a report of a picture that could not be checked. A file that is no earlier report stays: it may be a file of
/// the scene, which was not read.
void write_check_error(const CheckOptions& options, const std::string& message) {
    if (options.junit.empty()) return;
    if (is_taken(options.junit) && !is_check_junit(read_regular_file(options.junit, kMaxJunitBytes).bytes.text()))
        return;
    write_file(options.junit, check_junit_error(options.session.scene, one_line(message)));
}

Json checked_json(const CheckOptions& options, const CheckedFrame& frame) {
    Json json = {{"format", "shadow-inspector-check"},
                 {"version", 1},
                 {"scene", options.session.scene},
                 {"width", frame.picture.width},
                 {"height", frame.picture.height},
                 {"light", frame.picture.light},
                 {"area", frame.picture.area},
                 {"passed", all_passed(frame.findings)},
                 {"checks", check_findings_json(frame.findings)},
                 {"baseline", options.baseline.empty() ? Json() : Json(options.baseline)},
                 {"engine_bias", engine_bias_key(frame.bias)},
                 {"engine_bias_from", engine_bias_source_json(frame.bias)},
                 {"error", error_json(frame.error, frame.noise)},
                 {"driver", frame.driver}};
    return json;
}

}  // namespace

void run_check(const CheckOptions& options) {
    const CheckLimits limits = limits_of(options);
    require_check_outputs(options);
    CheckedFrame frame;
    try {
        frame = interruptible("nothing was written", [&](const Workers& workers, const auto& report) {
            return checked_frame(options, limits, workers, report);
        });
    } catch (const UsageError&) {
        throw;
    } catch (const std::exception& e) {
        write_check_error(options, e.what());
        throw;
    }
    const bool passed = all_passed(frame.findings);
    if (!options.junit.empty())
        write_file(options.junit,
                   check_junit(options.session.scene, frame.picture.driver, frame.findings, frame.seconds));
    // A picture beyond its limits is no measure for others.
    if (!options.write_baseline.empty() && passed)
        write_file(options.write_baseline,
                   json_text(check_baseline_json(options.session.scene, frame.picture, frame.error, frame.noise)));
    if (options.json) {
        fmt::print("{}", json_text(checked_json(options, frame)));
    } else {
        for (const CheckFinding& finding : frame.findings) fmt::print("{}\n", one_line(finding.text));
        if (frame.bias != EngineBias::Own) fmt::print("the engine's bias: {}\n", engine_bias_text(frame.bias));
        if (!options.write_baseline.empty() && passed) print_wrote(options.write_baseline);
    }
    print_notes(frame.notes);
    if (passed) return;
    const auto exceeded = std::ranges::count(frame.findings, false, &CheckFinding::passed);
    throw LimitExceeded(fmt::format("{}: {} of {} limits {} exceeded", options.session.scene, exceeded,
                                    frame.findings.size(), exceeded == 1 ? "is" : "are"));
}

}  // namespace si
