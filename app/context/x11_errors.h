// Handling of errors reported by the X server.
#pragma once

namespace si {

/// Prints X errors to stderr instead of ending the program. Some are harmless: a file manager that closes during a drag
/// leaves messages to a window that is gone. Call after creating windows, since GLFW restores Xlib's own handler.
void survive_x_errors();

}  // namespace si
