// What the program believes about drivers, measured on the one at hand.
#pragma once

#include <filesystem>

namespace si {

/// Writes one JSON file: the driver, how its clock was calibrated, and for each choice the times of both ways in turn.
/// @throws Error when the file cannot be written or there is no OpenGL 4.5
void write_gpu_report(const std::filesystem::path& file, int rounds);

}  // namespace si
