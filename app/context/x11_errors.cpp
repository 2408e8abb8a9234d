#include "app/context/x11_errors.h"

#include <fmt/format.h>

#include "app/base/notes.h"
// Xlib.h is the last include, because it defines macros.
#include <X11/Xlib.h>

namespace si {
namespace {

int tell_error(Display* display, XErrorEvent* error) {
    char text[128] = {};
    XGetErrorText(display, error->error_code, text, int(sizeof text) - 1);
    print_to_stderr(fmt::format("shadow-inspector: the X server says: {} (request {}.{})\n", text, error->request_code,
                                error->minor_code));
    return 0;
}

}  // namespace

void survive_x_errors() {
    XSetErrorHandler(tell_error);
}

}  // namespace si
