// Handling of errors reported by the X server, and of its end.
#pragma once

#include <functional>
#include <string>

namespace si {

/// Installs handlers that print errors of the X server to stderr instead of ending the program. Some errors are
/// harmless, such as those after a file manager that closed during a drag. When the X server itself ends, the program
/// prints a sentence and ends with exit code 1. Call after creating windows, since GLFW restores Xlib's own handler.
/// @param window X11 id of the program's window; 0: it has none
void survive_x_errors(unsigned long window);
/// Returns true when the X server has reported that the program's window does not exist any more.
bool x_window_is_gone();

/// Guard that saves the user's work if the X server ends while the guard exists.
class XServerGuard {
public:
    /// Sets the function that saves the user's work when the X server ends.
    /// @param save called once, on the thread that made this guard unless that thread hangs; may not use the window. It
    /// returns a clause for the program's last message: "the next start offers the unsaved settings"
    explicit XServerGuard(std::function<std::string()> save);
    ~XServerGuard();
    XServerGuard(const XServerGuard&) = delete;
    XServerGuard& operator=(const XServerGuard&) = delete;
};

}  // namespace si
