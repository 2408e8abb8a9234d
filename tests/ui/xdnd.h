// Drag-and-drop source for X11 that drops files on a window, as a file manager does.
#pragma once

#include <chrono>
#include <filesystem>

namespace si::test {

/// Drags `file` over a window and drops it at screen position `x`, `y`, by the XDND protocol, version 5, on $DISPLAY.
/// Returns whether the window accepted the drop and confirmed its end within `patience`, before it was closed.
bool drop_file(unsigned long window, const std::filesystem::path& file, int x, int y,
               std::chrono::seconds patience = std::chrono::minutes(10));

/// Starts a drag over a window and destroys the drag source before the window can answer.
void begin_abandoned_drag(unsigned long window, int x, int y);

}  // namespace si::test
