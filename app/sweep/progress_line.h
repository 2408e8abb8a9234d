// Progress of a sweep or search on stderr: one rewritten line on a terminal, else a line every 10 seconds.
#pragma once

#include <chrono>
#include <string>

#include "app/sweep/runner.h"

namespace si {

/// Formats the progress of a sweep as one line without line break: phase, steps done, time left and the present case.
std::string progress_text(const SweepProgress& progress, const SweepTiming& timing);

/// Line on stderr that shows the progress of long work. A terminal shows one line that is rewritten; otherwise a line
/// is printed every 10 seconds.
class ProgressLine {
public:
    ProgressLine();
    ~ProgressLine();  ///< ends the line
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    /// Shows the progress of a sweep on this line of the terminal. @param timing options of the sweep, for the number
    /// of rounds
    void show(const SweepProgress& progress, const SweepTiming& timing);
    /// Shows the progress of long work on this line of the terminal. @param share part of the work that is done, 0..1
    /// @param seconds_left estimated time left; 0: not known yet @param step present step, for people
    void show(double share, double seconds_left, const std::string& step);
    /// Shows a text on this line of the terminal, in place of the earlier text.
    /// @param last true: always prints the text; false: skips it if the last one was printed less than 0.1 s ago (10 s
    /// if stderr is no terminal)
    void show(std::string text, bool last);

private:
    bool terminal_ = false, open_ = false;
    std::chrono::steady_clock::time_point next_{};
};

}  // namespace si
