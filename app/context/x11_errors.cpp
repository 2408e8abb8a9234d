#include "app/context/x11_errors.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <thread>
#include <utility>

#include "app/base/notes.h"
// Xlib.h is the last include, because it defines macros.
#include <X11/Xlib.h>

namespace si {
namespace {

/// Keeper of the user's work, with the thread that may call it.
struct Keeper {
    std::function<std::string()> save;
    std::thread::id thread;
};
Keeper g_keeper;

int tell_error(Display* display, XErrorEvent* error) {
    char text[128] = {};
    XGetErrorText(display, error->error_code, text, int(sizeof text) - 1);
    print_to_stderr(fmt::format("shadow-inspector: the X server says: {} (request {}.{})\n", text, error->request_code,
                                error->minor_code));
    return 0;
}

/// Ends the program: Xlib allows no return. Threads that still draw make an orderly end impossible.
int end_without_server(Display*) {
    if (g_keeper.save && std::this_thread::get_id() != g_keeper.thread)
        std::this_thread::sleep_for(std::chrono::seconds(5));  // the keeper's thread finds the server gone, too
    std::string kept;
    if (const auto save = std::exchange(g_keeper.save, nullptr)) try {
            kept = save();
        } catch (const std::exception& e) {
            kept = e.what();
        }
    print_to_stderr(
        fmt::format("shadow-inspector: the X server has ended{}{}\n", kept.empty() ? "" : "; ", one_line(kept)));
    std::_Exit(EXIT_FAILURE);
}

}  // namespace

void survive_x_errors() {
    XSetErrorHandler(tell_error);
    XSetIOErrorHandler(end_without_server);
}

XServerGuard::XServerGuard(std::function<std::string()> save) {
    g_keeper = {std::move(save), std::this_thread::get_id()};
}

XServerGuard::~XServerGuard() {
    g_keeper = {};
}

}  // namespace si
