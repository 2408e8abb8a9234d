// How far a sweep or search is, on stderr: one line that is rewritten on a terminal, else a line now and then.
#pragma once

#include <chrono>
#include <string>

#include "app/sweep/runner.h"

namespace si {

/// "2 h 05 min", "3 min 20 s", "12 s".
std::string duration_text(double seconds);

/// The line without its end.
std::string progress_text(const SweepProgress& progress, const SweepTiming& timing);

class ProgressLine {
public:
    ProgressLine();
    ~ProgressLine();  ///< ends the line
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    void show(const SweepProgress& progress, const SweepTiming& timing);
    /// @param last must not be left out
    void show(std::string text, bool last);

private:
    bool terminal_ = false, open_ = false;
    std::chrono::steady_clock::time_point next_{};
};

}  // namespace si
