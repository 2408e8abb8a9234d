#include "app/capture/helper.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "renderer/base/embedded.h"
#include "renderer/base/error.h"
#include "renderer/base/temporary_folder.h"
#include "renderer/base/workers.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kPython = "/usr/bin/python3";
constexpr std::string_view kProgramFolder = "assets/capture/";
constexpr std::size_t kMaxLineBytes = std::size_t{16} << 20;
constexpr std::array<char, 4> kCaptureMagic = {'R', 'D', 'O', 'C'};

/// Interpreter of the helper. SI_CAPTURE_PYTHON replaces it, so that tests can run one that crashes.
std::string interpreter() {
    const char* replaced = std::getenv("SI_CAPTURE_PYTHON");
    return replaced && *replaced ? replaced : kPython;
}

/// Checks that a file is regular and begins as captures of RenderDoc do. @throws Error
void require_capture(const fs::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0)
        throw Error(fmt::format("{}: cannot be opened: {}; name a capture, .rdc", path.string(), errno_text()));
    struct stat facts {};
    std::array<char, 4> magic{};
    const bool regular = ::fstat(file, &facts) == 0 && S_ISREG(facts.st_mode);
    const bool whole = regular && ::read(file, magic.data(), magic.size()) == ssize_t(magic.size());
    ::close(file);
    if (!regular) throw Error(fmt::format("{}: is no regular file; name a capture, .rdc", path.string()));
    if (!whole || magic != kCaptureMagic)
        throw Error(fmt::format("{}: is no RenderDoc capture; name a file that RenderDoc wrote, .rdc", path.string()));
}

/// Environment of the helper: replay without a window, no settings of another Python, no files in the user's folders.
std::vector<std::string> environment(const fs::path& home) {
    constexpr std::array<std::string_view, 7> kLeftOut = {
        "DISPLAY=", "WAYLAND_DISPLAY=", "EGL_PLATFORM=", "PYTHON", "HOME=", "XDG_", "TMPDIR="};
    std::vector<std::string> out;
    for (char** at = environ; *at; ++at) {
        const std::string_view entry = *at;
        bool kept = true;
        for (const std::string_view start : kLeftOut) kept = kept && !entry.starts_with(start);
        if (kept) out.emplace_back(entry);
    }
    out.push_back("EGL_PLATFORM=surfaceless");
    out.push_back("HOME=" + home.string());
    out.push_back("TMPDIR=" + home.string());
    return out;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> out;
    for (std::string& text : texts) out.push_back(text.data());
    out.push_back(nullptr);
    return out;
}

/// Running child with the pipe that its standard output fills. Its group is killed at the end of the scope.
class Child {
public:
    Child(std::vector<std::string> words, std::vector<std::string> variables, const CaptureLimits& limits) {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0)
            throw Error(fmt::format("the capture helper cannot be started: {}", errno_text()));
        const std::vector<char*> arguments = pointers(words), environment_words = pointers(variables);
        const pid_t parent = ::getpid();
        pid_ = ::fork();
        if (pid_ == 0) run(arguments, environment_words, ends[1], parent, limits);
        ::close(ends[1]);
        pipe_ = ends[0];
        if (pid_ < 0) {
            const std::string why = errno_text();
            ::close(pipe_);
            throw Error(fmt::format("the capture helper cannot be started: {}", why));
        }
        ::setpgid(pid_, pid_);
    }
    ~Child() {
        ::close(pipe_);
        end();
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    int pipe() const { return pipe_; }

    /// Kills what is left of the group, waits for the child and returns its status.
    int end(bool kill = true) {
        if (pid_ <= 0) return status_;
        if (kill) ::kill(-pid_, SIGKILL);
        while (::waitpid(pid_, &status_, 0) < 0 && errno == EINTR) {
        }
        ::kill(-pid_, SIGKILL);
        pid_ = 0;
        return status_;
    }

private:
    /// Becomes the helper. Only calls that are safe after fork() in a program with threads.
    [[noreturn]] static void run(const std::vector<char*>& arguments, const std::vector<char*>& variables, int output,
                                 pid_t parent, const CaptureLimits& limits) {
        ::setpgid(0, 0);
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent) ::_exit(126);
        const rlimit memory{limits.memory_bytes, limits.memory_bytes};
        const rlimit no_core{0, 0};
        ::setrlimit(RLIMIT_AS, &memory);
        ::setrlimit(RLIMIT_CORE, &no_core);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_DFL);
        const int null = ::open("/dev/null", O_RDWR);
        ::dup2(null, 0);
        ::dup2(output, 1);
        ::dup2(null, 2);
        ::execve(arguments[0], arguments.data(), variables.data());
        ::_exit(127);
    }

    pid_t pid_ = 0;
    int pipe_ = -1;
    int status_ = 0;
};

/// State of one run, which lines of the helper change.
struct Progress {
    double share = 0;
    std::string label = "opening";
    std::string error;
    bool done = false;
};

/// Reads one line of the helper. Lines that are no JSON objects come from libraries and are ignored.
void take_line(std::string_view text, const CaptureRequest& request, const CaptureReports& reports, Progress& state) {
    const Json line = Json::parse(text, nullptr, false);
    if (!line.is_object()) return;
    if (const auto at = line.find("error"); at != line.end() && at->is_string()) {
        const std::string sentence = one_line(at->get<std::string>());
        const bool of_program = line.value("place", std::string()) == "program";
        state.error = of_program ? sentence : fmt::format("{}: {}", request.capture.string(), sentence);
    } else if (line.contains("progress") && line["progress"].is_number()) {
        state.share = line["progress"].get<double>();
        state.label = one_line(line.value("label", std::string()));
    } else {
        state.done = state.done || line.contains("done");
        reports.line(line);
    }
}

/// Returns why a helper ended without an answer.
std::string ending(const CaptureRequest& request, int status, const Progress& state) {
    if (WIFSIGNALED(status))
        return fmt::format(
            "{}: the capture helper crashed ({}) while {}; capture the frame again, or open it on another driver",
            request.capture.string(), ::strsignal(WTERMSIG(status)), state.label);
    if (WEXITSTATUS(status) == 127)
        return fmt::format(
            "import-capture needs {} and the Debian packages python3-renderdoc and python3-numpy; install them",
            kPython);
    return fmt::format("{}: the capture helper ended without an answer while {}; capture the frame again",
                       request.capture.string(), state.label);
}

}  // namespace

void run_capture_helper(const CaptureRequest& request, const CaptureReports& reports, const CaptureLimits& limits) {
    require_capture(request.capture);
    const TemporaryFolder folder = make_temporary_folder("shadow-inspector-capture");
    for (const EmbeddedFile& file : embedded_files())
        if (file.path.starts_with(kProgramFolder))
            write_file(folder.path() / file.path.substr(kProgramFolder.size()), file.text);
    std::vector<std::string> words = {interpreter(), "-I", "-B", (folder.path() / "import_capture.py").string(),
                                      fs::absolute(request.capture).string()};
    if (request.list) words.push_back("--list");
    for (const int pick : request.picks) words.push_back(fmt::format("--pick={}", pick));
    if (!request.list) words.push_back("--output=" + fs::absolute(request.output).string());

    Child child(std::move(words), environment(folder.path()), limits);
    const Clock::time_point end = Clock::now() + std::chrono::seconds(limits.seconds);
    Progress state;
    std::string pending;
    std::array<char, 1 << 16> block{};
    for (;;) {
        if (!reports.progress(state.share, state.label)) throw Cancelled();
        if (Clock::now() > end)
            throw Error(fmt::format("{}: the capture helper took longer than {} minutes; capture a smaller frame",
                                    request.capture.string(), limits.seconds / 60));
        pollfd waiting{child.pipe(), POLLIN, 0};
        const int ready = ::poll(&waiting, 1, 50);
        if (ready <= 0) continue;
        const ssize_t got = ::read(child.pipe(), block.data(), block.size());
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        pending.append(block.data(), std::size_t(got));
        std::size_t from = 0;
        for (std::size_t at; (at = pending.find('\n', from)) != std::string::npos; from = at + 1)
            take_line(std::string_view(pending).substr(from, at - from), request, reports, state);
        pending.erase(0, from);
        if (pending.size() > kMaxLineBytes)
            throw Error(fmt::format("{}: the capture helper sent a line without end", request.capture.string()));
    }
    const int status = child.end(false);
    if (!state.error.empty()) throw Error(state.error);
    if (status != 0 || (!request.list && !state.done)) throw Error(ending(request, status, state));
}

}  // namespace si
