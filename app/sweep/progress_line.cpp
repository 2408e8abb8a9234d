#include "app/sweep/progress_line.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>

#include "app/base/notes.h"

namespace si {
namespace {

using namespace std::chrono_literals;

std::size_t columns_of_terminal() {
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80;
}

/// Formats a duration: "2 h 05 min", "3 min 20 s", "12 s".
std::string duration_text(double seconds) {
    const long s = std::lround(std::max(seconds, 0.0));
    if (s < 60) return fmt::format("{} s", s);
    if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
    return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
}

}  // namespace

std::string progress_text(const SweepProgress& p, const SweepTiming& timing) {
    std::string text =
        p.timing ? fmt::format("times, round {} of at most {}: {}/{}", p.round + 1, timing.rounds, p.done, p.total)
                 : fmt::format("error and cost: {}/{}", p.done, p.total);
    if (p.seconds_left > 0) {
        const bool unknown = !p.timing && timing.on;  // the time of a frame is not known yet
        text += fmt::format(", {} left{}", duration_text(p.seconds_left), unknown ? " and then times" : "");
    }
    return text + "  " + p.current;
}

ProgressLine::ProgressLine() : terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
    if (open_) print_to_stderr("\n");
}

void ProgressLine::show(const SweepProgress& progress, const SweepTiming& timing) {
    show(progress_text(progress, timing), progress.done == progress.total && (!progress.timing || !terminal_));
}

void ProgressLine::show(double share, double seconds_left, const std::string& step) {
    const std::string left = seconds_left >= 1 ? fmt::format(", {} left", duration_text(seconds_left)) : "";
    show(fmt::format("{:3.0f} %{}  {}", 100 * share, left, step), false);
}

void ProgressLine::show(std::string text, bool last) {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_ && !last) return;
    next_ = now + (terminal_ ? 100ms : 10s);
    if (!terminal_) return print_to_stderr(text + "\n");
    text.resize(std::min(text.size(), columns_of_terminal() - 1));
    print_to_stderr(fmt::format("\r{}\x1b[K", text));
    open_ = true;
}

}  // namespace si
