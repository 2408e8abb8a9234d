// Dialog that writes a report: the present settings beside the pinned ones and presets, as one HTML page.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ui/panels/presets.h"
#include "ui/panels/tune_controls.h"

namespace si {

/// State of the dialog Report, which writes an HTML page that compares settings.
struct ReportDialog {
    bool asked = false;                ///< opens in the next frame
    bool shown = false;                ///< the dialog is open
    bool pinned = true;                ///< the pinned settings are in the report, if there are any
    bool probed = true;                ///< the probed pixel is diagnosed, if there is one; else one of each cause
    std::vector<std::string> presets;  ///< keys of built-in presets, or paths
    std::string preset_input;          ///< path of a preset while it is being typed
    std::string output = "report.html";
};

/// Data that the dialog Report shows: progress and result of writing an HTML report.
struct ReportFacts {
    std::optional<SearchProgress> writing;  ///< none: no report is being made
    std::string problem;                    ///< why none was written, and what to do; empty: none failed
    std::string wrote;                      ///< path of the last written report; empty: none
    std::string taken;                      ///< path of the last request where a file exists, which may be replaced
};

/// Request to write an HTML report, which compares the present settings with pinned ones and presets.
struct ReportRequest {
    std::string output;  ///< path, .html
    bool pinned = false;
    bool replace = false;  ///< a file that exists may be replaced
    std::vector<std::string> presets;
    std::optional<glm::ivec2> pixel;  ///< pixel to diagnose; none: one of each cause
};

/// Requests of the dialog Report to the application: write an HTML report, or cancel that.
struct ReportRequests {
    std::optional<ReportRequest> write_report;
    bool cancel_report = false;
};

/// Draws the dialog Report, which writes an HTML page that compares settings, while it is open.
/// @param has_pinned true: there are pinned settings @param probed the probed pixel; none: no pixel is probed
void draw_report_dialog(ReportDialog& dialog, const ReportFacts& facts, const PresetsFacts& presets, bool has_pinned,
                        const std::optional<glm::ivec2>& probed, ReportRequests& requests);

}  // namespace si
