// The program in a real window on an X server of its own, steered by real mouse and keyboard events.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "app/headless_editor.h"
#include "app/output.h"
#include "renderer/scenes/builtin.h"

namespace si {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kWidth = 1280, kHeight = 720;

/// A child process, ended at the latest with this object.
class Process {
public:
    Process(const std::vector<std::string>& arguments, const std::filesystem::path& folder, const std::string& log,
            int keep_fd = -1) {
        std::vector<char*> argv;
        for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
        argv.push_back(nullptr);
        const std::filesystem::path log_path = folder / log;
        pid_ = fork();
        if (pid_ == 0) {
            if (chdir(folder.c_str()) != 0) _exit(126);
            const int out = open(log_path.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0644);
            dup2(out, 1), dup2(out, 2);
            if (keep_fd >= 0) fcntl(keep_fd, F_SETFD, 0);
            execvp(argv[0], argv.data());
            _exit(127);
        }
    }
    ~Process() {
        if (!running()) return;
        kill(pid_, SIGTERM);
        waitpid(pid_, nullptr, 0);
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    bool running() {
        if (code_) return false;
        int status = 0;
        if (waitpid(pid_, &status, WNOHANG) != pid_) return true;
        code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        return false;
    }
    /// Valid when no longer running.
    int code() const { return code_.value_or(-1); }
    pid_t pid() const { return pid_; }
    /// Processor time used so far.
    double cpu_seconds() const {
        std::ifstream file("/proc/" + std::to_string(pid_) + "/stat");
        std::string text((std::istreambuf_iterator<char>(file)), {});
        std::istringstream fields(text.substr(text.rfind(')') + 2));
        std::string skipped;
        long user = 0, system = 0;
        for (int i = 0; i < 11; ++i) fields >> skipped;
        fields >> user >> system;
        return double(user + system) / double(sysconf(_SC_CLK_TCK));
    }

private:
    pid_t pid_ = -1;
    std::optional<int> code_;
};

bool wait_until(const std::function<bool()>& done, double seconds) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (Clock::now() < end) {
        if (done()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(150));
    }
    return done();
}

/// The virtual screen's pixels, from the XWD file that Xvfb keeps its framebuffer in (X11/XWDFile.h: a header of
/// big-endian 32-bit words, the colour map, rows of 32-bit pixels).
ByteImage read_screen(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(in)), {});
    const auto word = [&](std::size_t i) {
        return std::size_t(bytes[4 * i]) << 24 | std::size_t(bytes[4 * i + 1]) << 16 |
               std::size_t(bytes[4 * i + 2]) << 8 | bytes[4 * i + 3];
    };
    if (bytes.size() < 100) return {};
    const std::size_t header = word(0), width = word(4), height = word(5), stride = word(12), colours = word(19);
    const std::size_t start = header + colours * 12;
    if (bytes.size() < start + stride * height) return {};
    ByteImage image{int(width), int(height), std::vector<std::uint8_t>(width * height * 4, 255)};
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                image.data[(y * width + x) * 4 + c] = bytes[start + y * stride + x * 4 + 2 - c];  // stored B G R
    return image;
}

class Window : public testing::Test {
protected:
    void SetUp() override {
        // A folder of its own: ctest runs tests side by side.
        const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
        folder_ = std::filesystem::path(SI_TEST_OUTPUT_DIR) / ("window_" + name);
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
        unsetenv("WAYLAND_DISPLAY");
        setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);  // what one test leaves behind is not for the next
        ASSERT_EQ(std::system("command -v xdotool > /dev/null"), 0) << "the package xdotool is missing";
        // Several servers starting at once may choose the same number: the loser ends, and another try finds a free
        // one.
        bool up = false;
        for (int attempt = 0; attempt < 8 && !up; ++attempt) {
            if (attempt > 0) std::this_thread::sleep_for(std::chrono::milliseconds(700 * attempt));
            up = start_server();
        }
        ASSERT_TRUE(up) << "Xvfb did not start; is the package xvfb installed?";
    }

    bool start_server() {
        int pipe_ends[2];
        if (pipe(pipe_ends) != 0) return false;
        fcntl(pipe_ends[0], F_SETFD, FD_CLOEXEC);
        server_ = std::make_unique<Process>(
            std::vector<std::string>{"Xvfb", "-displayfd", std::to_string(pipe_ends[1]), "-screen", "0", "1280x720x24",
                                     "-fbdir", folder_.string(), "-nolisten", "tcp", "-noreset"},
            folder_, "xvfb.log", pipe_ends[1]);
        close(pipe_ends[1]);
        char number[16] = {};
        const bool told = read(pipe_ends[0], number, sizeof number - 1) > 0;
        close(pipe_ends[0]);
        setenv("DISPLAY", (":" + std::to_string(std::atoi(number))).c_str(), 1);
        // A server that lost the race for its number ends.
        wait_until([&] { return !server_->running() || xdotool("getdisplaygeometry"); }, 60);
        return told && server_->running();
    }

    void start(const std::vector<std::string>& more = {}) {
        std::vector<std::string> line{SI_PROGRAM, "edit", "boxes", "--size", "1280x720"};
        line.insert(line.end(), more.begin(), more.end());
        program_ = std::make_unique<Process>(line, folder_, "program.log");
        // The title names the scene once the first frame is drawn.
        const auto drawn = [&] { return xdotool("search --name 'boxes - Shadow Inspector'"); };
        wait_until([&] { return !program_->running() || drawn(); }, 120);
        ASSERT_TRUE(program_->running() && drawn()) << log();
        breathe();
    }

    bool xdotool(const std::string& command) const {
        return std::system(("xdotool " + command + " > /dev/null 2>&1").c_str()) == 0;
    }
    bool keys(const std::string& combination) const { return xdotool("key " + combination); }
    void mouse(int x, int y) const {
        xdotool("mousemove " + std::to_string(x) + " " + std::to_string(y));
        breathe();
    }
    /// Long enough for a slow frame to see the state before the next event.
    static void breathe() { std::this_thread::sleep_for(std::chrono::milliseconds(300)); }
    void drag(int x, int y, int dx, int dy) const {
        mouse(x, y);
        xdotool("mousedown 1");
        breathe();
        for (int i = 1; i <= 3; ++i) mouse(x + dx * i / 3, y + dy * i / 3);
        xdotool("mouseup 1");
        breathe();
    }
    void click(int x, int y) const { drag(x, y, 0, 0); }

    std::filesystem::path preset() const { return folder_ / "preset.json"; }
    /// The settings of the preset after a fresh save.
    nlohmann::json saved() const {
        std::filesystem::remove(preset());
        keys("ctrl+s");  // once: a second save could come after the next change
        wait_until([&] { return std::filesystem::exists(preset()); }, 60);
        std::ifstream file(preset());
        const auto preset_json = nlohmann::json::parse(file, nullptr, false);
        if (!preset_json.is_object()) {
            ADD_FAILURE() << "ctrl+s saved no preset";
            return nlohmann::json::object();
        }
        return preset_json.value("settings", nlohmann::json::object());
    }
    ByteImage screen(const std::string& name) const {
        ByteImage image = read_screen(folder_ / "Xvfb_screen0");
        if (image.width > 0) write_png(std::filesystem::path(SI_TEST_OUTPUT_DIR) / (name + ".png"), image);
        return image;
    }
    std::string log() const {
        std::ifstream file(folder_ / "program.log");
        return {std::istreambuf_iterator<char>(file), {}};
    }

    std::filesystem::path folder_;
    std::unique_ptr<Process> server_, program_;
};

TEST_F(Window, ASliderIsDraggedUndoneRedoneAndSaved) {
    ASSERT_NO_FATAL_FAILURE(start());
    click(1040, 56);  // the search field
    xdotool("type --delay 40 bias.constant");
    breathe();
    drag(1170, 115, 60, 0);
    const nlohmann::json after = saved();
    screen("window_slider");
    ASSERT_TRUE(after.contains("bias.constant")) << after;
    keys("ctrl+z");
    EXPECT_FALSE(saved().contains("bias.constant"));
    keys("ctrl+y");
    EXPECT_EQ(saved(), after);
    keys("ctrl+q");
    EXPECT_TRUE(wait_until([&] { return !program_->running(); }, 30));
    EXPECT_EQ(program_->code(), 0) << log();
}

TEST_F(Window, ADotOfAFrontierIsClicked) {
    const std::string command = std::string("cd '") + folder_.string() + "' && '" SI_PROGRAM
        "' sweep boxes --vary filter.kernel=pcf3,pcf9 --vary map.resolution=64,4096 --size 64x48 --rounds 1 -o swept "
        "> sweep.log 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
    // Where the dots are is found in the same editor without a window.
    EditorOptions options;
    options.session.scene = "boxes";
    options.sweep = folder_ / "swept";
    options.width = 1280, options.height = 720, options.headless = true, options.scale = 1;
    const auto is_dot = [](const ByteImage& image, int x, int y) {
        const std::uint8_t* p = &image.data[4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x))];
        return p[0] == 86 && p[1] == 180 && p[2] == 233;
    };
    glm::ivec2 first{-1};
    {
        HeadlessEditor headless(options);
        headless.model().state.sweep.follow = false;
        headless.settle();
        const ByteImage picture = headless.picture();
        for (int x = 0; x < 900 && first.x < 0; ++x)
            for (int y = 500; y < 718 && first.x < 0; ++y)
                if (is_dot(picture, x, y) && is_dot(picture, x + 3, y)) first = {x + 3, y};
    }
    ASSERT_GE(first.x, 0) << "no dot of the frontier is drawn";
    ASSERT_NO_FATAL_FAILURE(start({"--sweep", (folder_ / "swept").string()}));
    click(21, 606);  // do not measure the present settings: the plot stays as it is
    click(first.x, first.y);
    const nlohmann::json settings = saved();
    screen("window_frontier");
    EXPECT_EQ(settings.value("map.resolution", 0), 64) << settings;
    keys("ctrl+z");
    EXPECT_FALSE(saved().contains("map.resolution"));
}

TEST_F(Window, AKilledEditorOffersItsSettingsAgain) {
    ASSERT_NO_FATAL_FAILURE(start());
    click(1040, 56);  // the search field
    xdotool("type --delay 40 bias.constant");
    breathe();
    drag(1170, 115, 60, 0);
    const nlohmann::json changed = saved();
    ASSERT_TRUE(changed.contains("bias.constant")) << changed;
    // The settings that a crash would leave behind.
    const auto kept = [&] {
        std::error_code none_yet;
        for (const auto& entry :
             std::filesystem::directory_iterator(folder_ / "state/shadow-inspector/sessions", none_yet)) {
            if (entry.path().extension() != ".json") continue;
            std::ifstream file(entry.path());
            const auto json = nlohmann::json::parse(file, nullptr, false);
            return json.is_object() ? json.value("settings", nlohmann::json()) : nlohmann::json();
        }
        return nlohmann::json();
    };
    ASSERT_TRUE(wait_until([&] { return kept() == changed; }, 30)) << kept();
    kill(program_->pid(), SIGKILL);
    ASSERT_TRUE(wait_until([&] { return !program_->running(); }, 30));
    std::filesystem::remove(folder_ / "preset.json");

    ASSERT_NO_FATAL_FAILURE(start());
    screen("window_restore");
    click(808, 54);  // Restore
    breathe();
    EXPECT_EQ(saved(), changed);
    keys("ctrl+q");
    EXPECT_TRUE(wait_until([&] { return !program_->running(); }, 30));
    EXPECT_TRUE(kept().is_null()) << "a clean end leaves nothing to restore";
}

TEST_F(Window, TheSceneIsTurnedProbedFramedAndShownUnderAnOverlay) {
    ASSERT_NO_FATAL_FAILURE(start());
    drag(270, 300, 90, 30);
    const nlohmann::json turned = saved();
    ASSERT_TRUE(turned.contains("camera.source")) << turned;
    click(200, 330);
    keys("4");
    breathe();
    EXPECT_TRUE(saved().contains("view.overlay"));
    screen("window_probe");
    keys("f");
    EXPECT_NE(saved(), turned);
    EXPECT_TRUE(program_->running()) << log();
}

/// The editor without a window as `edit boxes --size 1280x720` shows it.
std::unique_ptr<HeadlessEditor> twin() {
    EditorOptions o;
    o.session.scene = "boxes";
    o.width = kWidth;
    o.height = kHeight;
    auto editor = std::make_unique<HeadlessEditor>(o);
    editor->settle();
    return editor;
}

TEST_F(Window, AHandleOfTheLightIsDraggedAndUndone) {
    ASSERT_NO_FATAL_FAILURE(start());
    const auto editor = twin();
    const EditorState& state = editor->model().state;
    const FittedLight& fitted = editor->model().facts().result->lights[0];
    const auto handles = place_handles(light_pose(state.settings.lights[0], fitted, 0), *state.scene_view);
    const auto drag_handle = [&](const std::function<bool(LightHandle)>& wanted) {
        const auto found = std::find_if(handles.begin(), handles.end(), [&](const auto& h) { return wanted(h.handle); });
        ASSERT_NE(found, handles.end());
        drag(int(found->on_screen.x), int(found->on_screen.y), 24, 18);
    };
    const nlohmann::json before = saved();
    drag_handle([](LightHandle h) { return h == LightHandle::Direction; });
    const nlohmann::json turned = saved();
    screen("window_handle");
    EXPECT_TRUE(turned.contains("light.azimuth")) << turned;
    EXPECT_FALSE(turned.contains("light.fit")) << "a light turns under its fit";
    EXPECT_FALSE(turned.contains("camera.source")) << "the camera turned too";
    keys("ctrl+z");
    EXPECT_EQ(saved(), before);
    drag_handle(is_extent);
    const nlohmann::json wider = saved();
    EXPECT_EQ(wider.value("light.fit", ""), "manual") << wider;
    EXPECT_TRUE(wider.contains("light.extent") && wider.contains("light.near") && wider.contains("light.far"));
    keys("ctrl+z");
    EXPECT_EQ(saved(), before);
    EXPECT_TRUE(program_->running()) << log();
}

TEST_F(Window, TheCameraFliesWhileAKeyIsHeld) {
    ASSERT_NO_FATAL_FAILURE(start());
    mouse(200, 330);
    xdotool("mousedown 3");
    breathe();
    xdotool("keydown w");
    std::this_thread::sleep_for(std::chrono::seconds(2));
    xdotool("keyup w");
    breathe();
    xdotool("mouseup 3");
    breathe();
    const nlohmann::json flown = saved();
    EXPECT_EQ(flown.value("camera.source", ""), "manual") << flown;
    EXPECT_TRUE(flown.contains("camera.target_x") && flown.contains("camera.target_z"));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    EXPECT_EQ(saved(), flown) << "it flies on";
    keys("ctrl+z");
    EXPECT_FALSE(saved().contains("camera.source"));
}

TEST_F(Window, AStillEditorSleepsAndAResizeIsFollowed) {
    ASSERT_NO_FATAL_FAILURE(start());
    mouse(900, 700);
    std::this_thread::sleep_for(std::chrono::seconds(2));
    const double before = program_->cpu_seconds();
    ASSERT_GT(before, 0);
    std::this_thread::sleep_for(std::chrono::seconds(3));
    EXPECT_LT(program_->cpu_seconds() - before, 0.3) << "seconds of processor time in three still seconds";
    ASSERT_TRUE(xdotool("search --name 'Shadow Inspector' windowsize 1000 600"));
    std::this_thread::sleep_for(std::chrono::seconds(2));
    screen("window_resized");
    EXPECT_TRUE(program_->running()) << log();
    keys("ctrl+q");
    EXPECT_TRUE(wait_until([&] { return !program_->running(); }, 30));
    EXPECT_EQ(program_->code(), 0) << log();
}

TEST_F(Window, ShowsTheSamePictureAsWithoutAWindow) {
    ASSERT_NO_FATAL_FAILURE(start());
    mouse(900, 700);
    const ByteImage expected = twin()->picture();
    // The pictures and the settings; the panel of passes shows times.
    const auto differing = [&] {
        const ByteImage seen = screen("window_still");
        if (seen.width != kWidth || seen.height != kHeight) return -1;
        int count = 0;
        for (int y = 0; y < 440; ++y)
            for (int x = 0; x < kWidth; ++x)
                for (int c = 0; c < 3; ++c) {
                    const std::size_t at = (std::size_t(y) * kWidth + std::size_t(x)) * 4 + std::size_t(c);
                    if (std::abs(int(seen.data[at]) - int(expected.data[at])) > 2) {
                        ++count;
                        break;
                    }
                }
        return count;
    };
    EXPECT_TRUE(wait_until([&] { return differing() == 0; }, 20)) << differing() << " pixels differ";
}

}  // namespace
}  // namespace si
