// Report of one view of a scene under several settings: pictures, errors, times, diagnosed pixels, as one HTML page.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/session/session.h"
#include "renderer/measure/measure.h"
#include "renderer/measure/shadow_time.h"

namespace si {

/// Settings that a report compares with others, such as a preset, with their name and the command-line options that
/// give them.
struct ReportSubject {
    std::string name;   ///< preset as it was named, or a word such as "present settings"
    std::string title;  ///< title of the preset; may be empty
    Settings settings;
    std::vector<std::string> options;  ///< words such as "--preset", "acne", "--set", "bias.slope=2"
};

/// Returns a preset as the subject of a report: the preset's shadows, drawn in the view of `shown`, so that all
/// subjects of the report share one view. The returned ReportSubject::options choose the preset and that view on the
/// command line.
/// @param scene posed for `shown` @param options scene, preset and --set of the subject
/// @param notes receives remarks @throws UsageError, Error
ReportSubject preset_subject(const Scene& scene, const Settings& shown, const SessionOptions& options,
                             std::vector<std::string>& notes);

/// Pixel that a report explains: its diagnosis and the drawing of its shadow test.
struct ReportedPixel {
    glm::ivec2 pixel{0};       ///< from the top left
    bool marked = false;       ///< named by the user; else the middle of the largest cluster of a cause
    std::size_t wrong = 0;     ///< pixels of that cluster
    std::string cause;         ///< label of the pixel's cause; empty: the pixel is right
    std::string object;        ///< path of the object; empty: nothing is there
    std::string verdict, fix;  ///< sentences; may be empty
    std::string section;       ///< SVG of the cross-section; empty: none
};

/// Measurements of one set of settings (ReportSubject) for a report: errors, times and diagnosed pixels.
struct ReportedCase {
    Classification classified;
    std::optional<TimeMeasurement> time;  ///< of whole frames
    ShadowTime shadow = {};               ///< time of the shadows; known where `time` is
    std::vector<ReportedPixel> pixels;
};

/// Options of a report that compares settings: pixels to diagnose, and frames to time.
struct PresetReportOptions {
    std::vector<glm::ivec2> pixels;  ///< pixels to diagnose; empty: one of each cause
    bool time = true;
    CostCase cost = kDefaultCost;  ///< kind of frames to time
};

/// Report that compares several sets of settings in one view of a scene: pictures, errors, times and diagnosed pixels.
struct PresetReport {
    std::string scene;    ///< name or path
    std::string command;  ///< command line that writes the report; empty: none does
    std::string version;  ///< of the program
    int width = 0, height = 0;
    CostCase cost = kDefaultCost;
    std::string renderer, clock;
    std::vector<ReportSubject> subjects;
    std::vector<ReportedCase> cases;  ///< one for each subject
    std::optional<ShadowTime> base;   ///< of base_of_costs(), timed in the same turns; nullopt: nothing was timed
};

/// Measures everything that a report shows. First, for each subject, it draws pictures, measures the error of the light
/// that view.light selects, and diagnoses pixels. Then it times all subjects and base_of_costs() (hard kernel, 1024
/// texels) in turns, so that a change of the machine's speed affects all alike.
/// @param scene posed for all subjects; objects that a subject hides are hidden for it alone
/// @param progress receives the share done, 0..1, and the present step @throws Cancelled, Error
PresetReport measure_report(Renderer& renderer, Scene scene, const std::string& scene_name,
                            std::vector<ReportSubject> subjects, glm::ivec2 size, const PresetReportOptions& options,
                            const Workers& workers, const std::function<void(double, const std::string&)>& progress);

/// Formats a report that compares settings as one self-contained HTML page without scripts. All texts are escaped.
std::string preset_report_html(const PresetReport& report);

}  // namespace si
