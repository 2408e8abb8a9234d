#include "app/base/interrupt.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>

namespace si {
namespace {

volatile std::sig_atomic_t g_signal = 0;

void note(int signal) {
    g_signal = signal;
}

void handle(int signal, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = handler == note ? int(SA_RESETHAND | SA_RESTART) : 0;
    sigemptyset(&action.sa_mask);
    ::sigaction(signal, &action, nullptr);
}

/// Installs a handler for each signal that requests a stop. A SIGHUP that `nohup` ignores stays ignored.
void handle_all(void (*handler)(int)) {
    for (const int signal : {SIGINT, SIGTERM}) handle(signal, handler);
    struct sigaction present {};
    ::sigaction(SIGHUP, nullptr, &present);
    if (present.sa_handler != SIG_IGN) handle(SIGHUP, handler);
}

}  // namespace

InterruptGuard::InterruptGuard() {
    g_signal = 0;
    handle_all(note);
}

InterruptGuard::~InterruptGuard() {
    handle_all(SIG_DFL);
}

bool InterruptGuard::stop_requested() const {
    return was_interrupted();
}

bool was_interrupted() {
    return g_signal != 0;
}

void InterruptGuard::end() {
    std::fflush(nullptr);
    const int signal = g_signal ? int(g_signal) : SIGINT;
    handle(signal, SIG_DFL);
    std::raise(signal);
    std::_Exit(128 + signal);  // the signal is blocked
}

}  // namespace si
