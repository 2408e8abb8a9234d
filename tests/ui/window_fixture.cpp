// Fixture for window tests: X server, child processes, xdotool, screenshots.
#include "tests/ui/window_fixture.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

#include "app/base/output.h"

namespace si::test {
namespace {

using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

/// Limit against hangs; no machine is so slow.
constexpr auto kHung = std::chrono::minutes(10);

std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

Process::Process(const std::vector<std::string>& arguments, const fs::path& folder, const std::string& log, int keep_fd,
                 const Confinement* confinement) {
    std::vector<char*> argv;
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    const fs::path log_path = folder / log;
    pid_ = fork();
    if (pid_ != 0) return;
    if (chdir(folder.c_str()) != 0) _exit(126);
    const int out = open(log_path.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0644);
    dup2(out, 1);
    dup2(out, 2);
    if (keep_fd >= 0) fcntl(keep_fd, F_SETFD, 0);
    if (confinement && !confinement->apply_to_this_process()) _exit(125);
    execvp(argv[0], argv.data());
    _exit(127);
}

Process::~Process() {
    if (!running()) return;
    kill(pid_, SIGTERM);
    waitpid(pid_, nullptr, 0);
}

void Process::send(int signal) const {
    if (pid_ > 0) ::kill(pid_, signal);
}

void Process::hold(bool held) {
    if (pid_ > 0) ::kill(pid_, held ? SIGSTOP : SIGCONT);
}

void Process::kill_at_once() {
    if (!running()) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    code_ = 128 + SIGKILL;
}

bool Process::running() {
    if (code_) return false;
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) != pid_) return true;
    code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return false;
}

double Process::cpu_seconds() const {
    const std::string text = text_of("/proc/" + std::to_string(pid_) + "/stat");
    if (text.empty()) return 0;
    std::istringstream fields(text.substr(text.rfind(')') + 2));
    std::string skipped;
    long user = 0, system = 0;
    for (int i = 0; i < 11; ++i) fields >> skipped;
    fields >> user >> system;
    return double(user + system) / double(sysconf(_SC_CLK_TCK));
}

namespace {

/// Returns whether a thread runs only in idle time (field 41). The text is /proc/.../stat from the state (field 3) on.
bool takes_idle_time(const std::string& from_state) {
    std::istringstream fields(from_state);
    std::string field;
    for (int i = 3; i <= 41; ++i) fields >> field;
    return field == std::to_string(SCHED_IDLE);
}

}  // namespace

bool Process::sleeps(bool idle_threads_too) const {
    std::error_code ended;
    for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(pid_) + "/task", ended)) {
        const std::string text = text_of(task.path() / "stat");
        const auto name_end = text.rfind(')');
        if (name_end == std::string::npos || text.compare(name_end + 2, 1, "S") == 0) continue;
        if (idle_threads_too || !takes_idle_time(text.substr(name_end + 2))) return false;
    }
    return true;
}

// X11/XWDFile.h: a header of big-endian 32-bit words, the colour map, rows of 32-bit pixels.
ByteImage read_screen(const fs::path& file) {
    const std::string text = text_of(file);
    const auto byte = [&](std::size_t i) { return std::size_t(static_cast<unsigned char>(text[i])); };
    const auto word = [&](std::size_t i) {
        return byte(4 * i) << 24 | byte(4 * i + 1) << 16 | byte(4 * i + 2) << 8 | byte(4 * i + 3);
    };
    if (text.size() < 100) return {};
    const std::size_t header = word(0), width = word(4), height = word(5), stride = word(12), colours = word(19);
    const std::size_t start = header + colours * 12;
    if (text.size() < start + stride * height) return {};
    ByteImage image{int(width), int(height), std::vector<std::uint8_t>(width * height * 4, 255)};
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t c = 0; c < 3; ++c)  // stored B G R
                image.data[(y * width + x) * 4 + c] = std::uint8_t(byte(start + y * stride + x * 4 + 2 - c));
    return image;
}

void Window::SetUp() {
    // One folder a test: ctest runs tests in parallel.
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = fs::path(SI_TEST_OUTPUT_DIR) / ("window_" + name);
    fs::remove_all(folder_);
    // The editor keeps state between runs: each test has its own instead of the user's home.
    fs::create_directories(home());
    setenv("HOME", home().c_str(), 1);
    setenv("XDG_CACHE_HOME", (folder_ / "cache").c_str(), 1);
    setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);
    // No connection to the desktop of the user.
    for (const char* desktop : {"WAYLAND_DISPLAY", "DBUS_SESSION_BUS_ADDRESS", "XDG_RUNTIME_DIR"}) unsetenv(desktop);
    ASSERT_EQ(std::system("command -v xdotool > /dev/null"), 0) << "the package xdotool is missing";
    // Servers that start together may choose the same number: the loser ends, and another try finds a free one.
    bool up = false;
    for (int attempt = 0; attempt < 20 && !up; ++attempt) {
        if (attempt > 0) std::this_thread::sleep_for(std::chrono::milliseconds(100 * attempt));
        up = start_server();
    }
    ASSERT_TRUE(up) << "Xvfb did not start; is the package xvfb installed?\n" << text_of(folder_ / "xvfb.log");
}

bool Window::start_server() {
    int pipe_ends[2];
    if (pipe(pipe_ends) != 0) return false;
    fcntl(pipe_ends[0], F_SETFD, FD_CLOEXEC);
    server_ = std::make_unique<Process>(
        std::vector<std::string>{"Xvfb", "-displayfd", std::to_string(pipe_ends[1]), "-screen", "0", "1280x720x24",
                                 "-fbdir", folder_.string(), "-nolisten", "tcp", "-noreset"},
        folder_, "xvfb.log", pipe_ends[1]);
    close(pipe_ends[1]);
    // The server writes its number and a line feed once it accepts clients; its end closes the pipe.
    std::string number;
    pollfd end{pipe_ends[0], POLLIN, 0};
    while (!number.ends_with('\n') && poll(&end, 1, int(std::chrono::milliseconds(kHung).count())) > 0) {
        char c = 0;
        if (read(pipe_ends[0], &c, 1) != 1) break;
        number += c;
    }
    close(pipe_ends[0]);
    if (!number.ends_with('\n')) return false;
    number.pop_back();
    setenv("DISPLAY", (":" + number).c_str(), 1);
    return xdotool("getdisplaygeometry") && server_->running();
}

bool Window::wait_until(const std::function<bool()>& done) const {
    const auto end = Clock::now() + kHung;
    while (!done()) {
        const bool alive = server_->running() && (!program_ || program_->running());
        if (!alive || Clock::now() > end) return done();
        std::this_thread::sleep_for(std::chrono::milliseconds(150));
    }
    return true;
}

void Window::start(const std::vector<std::string>& more, const std::string& scene) {
    std::vector<std::string> line{SI_PROGRAM, "edit", scene};
    line.insert(line.end(), more.begin(), more.end());
    program_.reset();
    program_ = std::make_unique<Process>(line, folder_, "program.log");
    // The title names the scene after the first frame.
    ASSERT_TRUE(shows(scene)) << log();
    wait_until_idle();
}

void Window::quit() {
    keys("ctrl+q");
    EXPECT_TRUE(wait_until([&] { return !program_->running(); }));
    EXPECT_EQ(program_->code(), 0) << log();
}

bool Window::xdotool(const std::string& command) const {
    return std::system(("xdotool " + command + " > /dev/null 2>&1").c_str()) == 0;
}

std::string Window::ask(const std::string& command) const {
    const fs::path answer = folder_ / "xdotool.txt";
    return std::system(("xdotool " + command + " > '" + answer.string() + "' 2>&1").c_str()) == 0 ? text_of(answer)
                                                                                                  : "";
}

bool Window::titled(const std::string& scene) const {
    return xdotool("search --name '" + scene + " - Shadow Inspector'");
}

bool Window::shows(const std::string& scene) const {
    return wait_until([&] { return titled(scene); });
}

void Window::type(const std::string& text) const {
    xdotool("type --delay 40 '" + text + "'");
    wait_until_idle();
}

void Window::mouse(int x, int y) const {
    xdotool("mousemove " + std::to_string(x) + " " + std::to_string(y));
    wait_until_idle();
}

void Window::wait_until_idle(bool idle_threads_too) const {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    if (!program_) return;
    // Twelve checks in a row: between two frames, or during a wait for the driver, one of them would find it awake.
    int asleep = 0;
    const auto end = Clock::now() + kHung;
    while (asleep < 12 && program_->running() && Clock::now() < end) {
        asleep = server_->sleeps(true) && program_->sleeps(idle_threads_too) ? asleep + 1 : 0;
        std::this_thread::sleep_for(std::chrono::milliseconds(15));
    }
}

void Window::drag(int x, int y, int dx, int dy) const {
    mouse(x, y);
    xdotool("mousedown 1");
    wait_until_idle();
    for (int i = 1; i <= 3; ++i) mouse(x + dx * i / 3, y + dy * i / 3);
    xdotool("mouseup 1");
    wait_until_idle();
}

void Window::double_click(int x, int y, const std::function<bool()>& done) const {
    EXPECT_TRUE(wait_until([&] {
        mouse(x, y);
        xdotool("click --repeat 2 --delay 120 1");
        wait_until_idle();
        return done();
    }));
}

nlohmann::json Window::json_of(const fs::path& file) {
    return nlohmann::json::parse(text_of(file), nullptr, false);
}

nlohmann::json Window::saved(const std::string& name) const {
    const fs::path file = folder_ / name;
    fs::remove(file);
    keys("ctrl+s");  // one press: a second save could come after the next change
    wait_until([&] { return fs::exists(file); });
    const auto preset = json_of(file);
    if (!preset.is_object()) {
        ADD_FAILURE() << "ctrl+s saved no preset";
        return nlohmann::json::object();
    }
    return preset.value("settings", nlohmann::json::object());
}

ByteImage Window::screen(const std::string& name) const {
    ByteImage image = read_screen(folder_ / "Xvfb_screen0");
    if (image.width > 0) write_png(fs::path(SI_TEST_OUTPUT_DIR) / (name + ".png"), image);
    return image;
}

std::string Window::log() const {
    return text_of(folder_ / "program.log");
}

}  // namespace si::test
