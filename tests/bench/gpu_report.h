// Report of driver choices: times of alternative ways to draw on the driver at hand.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace si {

/// Scope of a GPU report: rounds, picture size and choices.
struct GpuReportOptions {
    int rounds = 15;                   ///< timed rounds of both ways
    int width = 1280, height = 720;    ///< picture size, pixels
    std::vector<std::string> choices;  ///< prefixes of the keys of measured choices; empty: all
};

/// Writes a JSON file with the driver, the calibration of its clock, and for each choice the alternating times of both
/// ways. @throws Error when the file cannot be written or there is no OpenGL 4.5, UsageError for an unknown choice
void write_gpu_report(const std::filesystem::path& file, const GpuReportOptions& options);

}  // namespace si
