// What somebody does who hits keys and buttons at random, made from a seed alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace si::test {

/// A line each, as it is written down and played again:
///
///     xdotool mousemove 100 200 click 1     what xdotool is to do
///     drop 3 100 200                        the file of this number let go there
///     size 640 480                          of the window
///     pause 40                              milliseconds
///
/// Never asks the editor to end, but may meet its menu's entry for that.
/// @param files how many there are to drop
std::vector<std::string> monkey_events(std::uint32_t seed, int count, std::size_t files);

/// Makes files to be dropped: scenes, presets, and what is neither. @returns them, in an order that is always the same
std::vector<std::filesystem::path> monkey_files(const std::filesystem::path& folder);

}  // namespace si::test
