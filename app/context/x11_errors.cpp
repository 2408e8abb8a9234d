#include "app/context/x11_errors.h"

#include <X11/Xlib.h>
#include <fmt/format.h>

#include <cstdio>

namespace si {
namespace {

int tell(Display* display, XErrorEvent* error) {
    char text[128] = {};
    XGetErrorText(display, error->error_code, text, int(sizeof text) - 1);
    fmt::print(stderr, "shadow-inspector: the X server says: {} (request {}.{})\n", text, error->request_code,
               error->minor_code);
    return 0;
}

}  // namespace

void survive_x_errors() {
    XSetErrorHandler(tell);
}

}  // namespace si
