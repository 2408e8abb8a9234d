// A file dropped on a window of an X server, as a file manager drops it.
#pragma once

#include <chrono>
#include <filesystem>

namespace si::test {

/// Drags `file` over the window and lets go at `x`, `y` of the screen (the XDND protocol, version 5, of
/// $DISPLAY). Returns whether the window took the drop and said that it is done with it, within `patience` and before
/// it was closed.
bool drop_file(unsigned long window, const std::filesystem::path& file, int x, int y,
               std::chrono::seconds patience = std::chrono::minutes(10));

/// A drag over the window whose source is gone before the window can answer.
void begin_abandoned_drag(unsigned long window, int x, int y);

}  // namespace si::test
