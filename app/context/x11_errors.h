// What becomes of errors that an X server reports.
#pragma once

namespace si {

/// Xlib ends the program at the first error, and some are nobody's fault: a file manager that closes in the middle of a
/// drag leaves messages to a window that is gone. From here on they are told on stderr, and the program goes on.
/// Call after windows are made: GLFW sets Xlib's own handler back when it has made one.
void survive_x_errors();

}  // namespace si
