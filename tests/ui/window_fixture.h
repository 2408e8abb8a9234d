// The program in a real window on an X server of its own, steered by real mouse and keyboard events.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/frame/frame.h"
#include "tests/support/confinement.h"
#include "tests/ui/screen.h"

namespace si::test {

/// A child process, ended at the latest with this object.
class Process {
public:
    /// @param confinement that it is under; null: under none
    Process(const std::vector<std::string>& arguments, const std::filesystem::path& folder, const std::string& log,
            int keep_fd = -1, const Confinement* confinement = nullptr);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    bool running();
    void kill_at_once();
    /// As a batch system does (SIGTERM).
    void ask_to_end();
    /// Stops it where it is, as a slow frame does, or lets it go on.
    void hold(bool held);
    /// Valid when no longer running.
    int code() const { return code_.value_or(-1); }
    /// Processor time used so far; 0 when it is gone.
    double cpu_seconds() const;
    /// No thread wants the processor.
    /// @param idle_threads_too those that take only idle time, which on a busy machine is none, too
    bool sleeps(bool idle_threads_too) const;

private:
    pid_t pid_ = -1;
    std::optional<int> code_;
};

/// The virtual screen's pixels, from the XWD file that Xvfb keeps its framebuffer in.
ByteImage read_screen(const std::filesystem::path& file);

class Window : public testing::Test {
protected:
    void SetUp() override;

    /// Starts `edit` and waits for its first picture.
    void start(const std::vector<std::string>& more = {"--size", "1280x720"}, const std::string& scene = "boxes");
    /// Ends it by Ctrl+Q; its exit code has to be 0.
    void quit();
    bool xdotool(const std::string& command) const;
    /// What a command of xdotool says.
    std::string ask(const std::string& command) const;
    /// Whether the window's title names the scene.
    bool titled(const std::string& scene) const;
    /// Waits for such a title.
    bool shows(const std::string& scene) const;
    bool keys(const std::string& combination) const { return xdotool("key " + combination); }
    void type(const std::string& text) const;
    void mouse(int x, int y) const;
    /// Until it is so, however slow the machine is, or the program or its server has ended. @returns whether it is so.
    bool wait_until(const std::function<bool()>& done) const;
    /// Until the editor has drawn what the last event calls for and sleeps again, however slow the machine is.
    /// What a thread foresees in idle time is waited for only where `idle_threads_too`.
    void breathe(bool idle_threads_too = false) const;
    void drag(int x, int y, int dx, int dy) const;
    void click(int x, int y) const { drag(x, y, 0, 0); }
    /// Until it has had its effect: where two presses take too long to arrive they are two clicks.
    void double_click(int x, int y, const std::function<bool()>& done) const;

    std::filesystem::path home() const { return folder_ / "home"; }
    std::filesystem::path state_folder() const { return folder_ / "state/shadow-inspector"; }
    /// A file's JSON; discarded when there is none.
    static nlohmann::json json_of(const std::filesystem::path& file);
    /// The settings of the preset at `file` (default: the one a new session saves to) after a fresh Ctrl+S.
    nlohmann::json saved(const std::string& file = "preset.json") const;
    /// The screen, also kept as NAME.png beside the tests.
    ByteImage screen(const std::string& name) const;
    std::string log() const;

    std::filesystem::path folder_;
    std::unique_ptr<Process> server_, program_;

private:
    bool start_server();
};

}  // namespace si::test
