// Child process that opens a RenderDoc capture: a Python program over Debian's module for RenderDoc.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/base/json_text.h"

namespace si {

/// Request to the capture helper, a child process that opens a RenderDoc capture: list the capture's shadow maps, or
/// write some of them as a bundle.
struct CaptureRequest {
    std::filesystem::path capture;
    bool list = false;             ///< list candidates and write nothing
    std::vector<int> picks;        ///< numbers of candidates to write; empty: all
    std::filesystem::path output;  ///< folder that receives the bundle's files; not used with `list`
};

/// Limits of memory and time for the capture helper, a child process that opens a RenderDoc capture.
struct CaptureLimits {
    std::size_t memory_bytes = std::size_t{8} << 30;  ///< address space
    int seconds = 600;                                ///< wall time
};

/// Functions that receive progress and results from the capture helper, a child process. Both run on the calling
/// thread.
struct CaptureReports {
    /// Receives the share 0..1 that is done and a label, at least every 50 ms. Returning false ends the helper.
    std::function<bool(double, const std::string&)> progress;
    /// Receives each shadow map of the list (member `candidate`), or the summary of the written bundle (member `done`).
    std::function<void(const Json&)> line;
};

/// Opens a capture in a child process and waits for its end. The child replays the capture's commands, which runs its
/// shaders. The child has a process group of its own, which is killed on an error, on a stop and when this process
/// dies.
/// @throws Error one sentence: a missing package, an unreadable capture, a crash, a limit
/// @throws Cancelled where `progress` returns false
void run_capture_helper(const CaptureRequest& request, const CaptureReports& reports, const CaptureLimits& limits = {});

}  // namespace si
