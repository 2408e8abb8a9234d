// Report of an editor's session as JSON (edit --report): driver messages, faulty numbers, errors, and memory over time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/held_memory.h"
#include "ui/state/log.h"

namespace si {

/// Report of an editor's session as a JSON file (`edit --report`): collects driver messages, invalid numbers (NaN,
/// infinite, out of range), errors and memory, and writes the file at intervals.
class SessionReport {
public:
    /// Begins a session report. @param path file of the report; empty: none is written
    explicit SessionReport(std::filesystem::path path) : path_(std::move(path)) {}

    /// Adds a message of the OpenGL driver to the session report.
    void note_driver(const std::string& message);
    /// Keeps the description of the first invalid number (NaN, infinite, out of range) for the session report; ignores
    /// later ones.
    void note_unsound(std::string_view what) {
        if (unsound_.empty()) unsound_ = what;
    }
    /// Counts a frame of the editor for the session report.
    void note_frame() { ++frames_; }
    /// Counts ray-traced references for the session report: each trace that begins, or begins again.
    /// @param progress progress of the trace under way, 0..1; none: no rays are traced
    void note_tracing(std::optional<double> progress) {
        if (progress && (!tracing_ || *progress < *tracing_)) ++traces_;
        tracing_ = progress;
    }
    const std::string& unsound() const { return unsound_; }
    /// Samples the process's memory and writes the session report, if the interval since the last write has passed.
    /// Call regularly. @param now_s time of a steady clock, seconds @param log the editor's log, whose errors go into
    /// the report @throws Error
    void write_when_due(double now_s, const Log& log);
    /// Stops writing the session report. Call when a write has failed.
    void stop_writing() { path_.clear(); }
    /// Writes the session report to the file given to the constructor; does nothing without one. @param log the
    /// editor's log, whose errors go into the report @throws Error
    void write(const Log& log);

private:
    /// Memory use of the process at one time, for the session report.
    struct Sample {
        double seconds = 0;
        MemoryReport memory;
    };
    /// Adds a sample of the process's memory use to the session report. At 200 samples drops every second one, and
    /// doubles the interval. @param now_s time of a steady clock, seconds
    void sample(double now_s);

    std::filesystem::path path_;
    std::string unsound_;
    std::vector<std::string> driver_;
    std::size_t frames_ = 0, traces_ = 0, driver_count_ = 0;
    std::optional<double> tracing_;  ///< progress of the last noted trace
    std::vector<Sample> samples_;
    double began_s_ = -1, due_s_ = 0, every_s_ = 2;
};

}  // namespace si
