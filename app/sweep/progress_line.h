// Progress of a sweep or search on stderr: one rewritten line on a terminal, else a line every few seconds.
#pragma once

#include <chrono>
#include <string>

#include "app/sweep/runner.h"

namespace si {

/// Formats the progress of a sweep as one line without line break.
std::string progress_text(const SweepProgress& progress, const SweepTiming& timing);

/// Line on stderr that shows the progress of long work: rewritten on a terminal, else printed every few seconds.
class ProgressLine {
public:
    ProgressLine();
    ~ProgressLine();  ///< ends the line
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    /// Shows the progress of a sweep on the line.
    void show(const SweepProgress& progress, const SweepTiming& timing);
    /// Shows the share of work that is done, 0..1, the estimated time left and the present step.
    /// @param seconds_left 0: not known yet
    void show(double share, double seconds_left, const std::string& step);
    /// Shows a text on the progress line, in place of the one before. @param last true: prints the text always; false:
    /// skips the text if the last print was very recent
    void show(std::string text, bool last);

private:
    bool terminal_ = false, open_ = false;
    std::chrono::steady_clock::time_point next_{};
};

}  // namespace si
