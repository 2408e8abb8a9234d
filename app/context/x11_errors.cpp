#include "app/context/x11_errors.h"

#include <fmt/format.h>

#include <atomic>
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
std::atomic<unsigned long> g_window = 0;
std::atomic<bool> g_window_is_gone = false;

int tell_error(Display* display, XErrorEvent* error) {
    // Another client may destroy the window. Errors about other windows are harmless.
    if (g_window != 0 && error->resourceid == g_window &&
        (error->error_code == BadWindow || error->error_code == BadDrawable))
        g_window_is_gone = true;
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

void survive_x_errors(unsigned long window) {
    g_window = window;
    g_window_is_gone = false;
    XSetErrorHandler(tell_error);
    XSetIOErrorHandler(end_without_server);
}

bool x_window_is_gone() {
    return g_window_is_gone;
}

XServerGuard::XServerGuard(std::function<std::string()> save) {
    g_keeper = {std::move(save), std::this_thread::get_id()};
}

XServerGuard::~XServerGuard() {
    g_keeper = {};
}

}  // namespace si
