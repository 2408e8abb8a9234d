// What became of an editor's session, as JSON for whoever tries it out: what the driver complained of, which numbers
// were none, errors that were told, and memory by its holders over time (edit --report).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/held.h"
#include "ui/state/log.h"

namespace si {

class SessionReport {
public:
    /// @param path empty: none is written
    explicit SessionReport(std::filesystem::path path) : path_(std::move(path)) {}

    void note_driver(const std::string& message);
    /// The first stays.
    void note_unsound(std::string_view what) {
        if (unsound_.empty()) unsound_ = what;
    }
    /// A frame of the editor was shown.
    void note_frame() { ++frames_; }
    const std::string& unsound() const { return unsound_; }
    /// Now and then, with the errors that the log has, takes the process's memory down and writes the report. @param
    /// now_s grows steadily @throws Error
    void follow(double now_s, const Log& log);
    /// It cannot be written.
    void give_up() { path_.clear(); }
    /// The end. @throws Error
    void write(const Log& log);

private:
    struct Sample {
        double seconds = 0;
        MemoryReport memory;
    };
    void sample(double now_s);

    std::filesystem::path path_;
    std::string unsound_;
    std::vector<std::string> driver_;
    std::size_t frames_ = 0, driver_count_ = 0;
    std::vector<Sample> samples_;
    double began_s_ = -1, due_s_ = 0, every_s_ = 2;
};

}  // namespace si
