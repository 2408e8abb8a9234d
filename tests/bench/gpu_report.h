// What the program believes about drivers, measured on the one at hand.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace si {

struct GpuReportOptions {
    int rounds = 15;                   ///< of both ways in turn
    int width = 1280, height = 720;    ///< of the pictures
    std::vector<std::string> choices;  ///< what the keys of those wanted begin with; empty: all
};

/// Writes one JSON file: the driver, how its clock was calibrated, and for each choice the times of both ways in turn.
/// @throws Error when the file cannot be written or there is no OpenGL 4.5, UsageError for a choice that there is not
void write_gpu_report(const std::filesystem::path& file, const GpuReportOptions& options);

}  // namespace si
