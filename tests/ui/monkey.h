// Random input for the editor's window, reproducible from a seed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace si::test {

/// Returns `count` random events. Each is a line, as logged and replayed:
///
///     xdotool mousemove 100 200 click 1     command for xdotool
///     drop 3 100 200                        drop of file number 3 at a position
///     size 640 480                          size of the window
///     pause 40                              milliseconds
///
/// No event closes the editor directly, but clicks may reach the menu entry for it.
/// @param files number of files that can be dropped
std::vector<std::string> monkey_events(std::uint32_t seed, int count, std::size_t files);

/// Makes files to drop: scenes, presets and other files. Returns their paths in a fixed order.
std::vector<std::filesystem::path> monkey_files(const std::filesystem::path& folder);

}  // namespace si::test
