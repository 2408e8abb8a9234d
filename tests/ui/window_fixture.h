// Fixture that runs the editor in a real window on a private X server, driven by real mouse and keyboard events.
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

/// Child process, ended at the latest by the destructor.
class Process {
public:
    /// Starts a program in `folder`. @param arguments program and its arguments
    /// @param log file for standard output and errors
    /// @param keep_fd file descriptor that the child inherits; -1: none
    /// @param confinement sandbox of the child; null: none
    Process(const std::vector<std::string>& arguments, const std::filesystem::path& folder, const std::string& log,
            int keep_fd = -1, const Confinement* confinement = nullptr);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// Returns whether the process still runs; collects its exit code.
    bool running();
    /// Ends the process by SIGKILL.
    void kill_at_once();
    /// Sends a signal to the process.
    void send(int signal) const;
    /// Stops the process (SIGSTOP), as a slow frame would, or continues it (SIGCONT).
    void hold(bool held);
    /// Returns the exit code; valid once running() is false.
    int code() const { return code_.value_or(-1); }
    /// Returns the processor time used so far, seconds; 0 for an ended process.
    double cpu_seconds() const;
    /// Returns whether no thread wants the processor. @param idle_threads_too also checks threads of idle priority,
    /// which may starve on a busy machine
    bool sleeps(bool idle_threads_too) const;

private:
    pid_t pid_ = -1;
    std::optional<int> code_;
};

/// Returns the pixels of the virtual screen from the XWD file that holds Xvfb's framebuffer.
ByteImage read_screen(const std::filesystem::path& file);

/// Test fixture with an X server and the editor in a window. Mouse positions are screen pixels.
class Window : public testing::Test {
protected:
    void SetUp() override;

    /// Starts `edit` and waits for its first picture. @param more further arguments
    /// @param scene name or path of the scene
    void start(const std::vector<std::string>& more = {"--size", "1280x720"}, const std::string& scene = "boxes");
    /// Ends the editor by Ctrl+Q and expects exit code 0.
    void quit();
    /// Runs an xdotool command. Returns whether the command succeeded.
    bool xdotool(const std::string& command) const;
    /// Returns the standard output of an xdotool command.
    std::string ask(const std::string& command) const;
    /// Returns whether the window's title names the scene.
    bool titled(const std::string& scene) const;
    /// Waits until the window's title names the scene.
    bool shows(const std::string& scene) const;
    /// Presses a key combination in xdotool's notation ("ctrl+s").
    bool keys(const std::string& combination) const { return xdotool("key " + combination); }
    /// Types a text.
    void type(const std::string& text) const;
    /// Moves the mouse.
    void mouse(int x, int y) const;
    /// Waits until `done` returns true, or the program or its server has ended. Returns the last result of `done`.
    bool wait_until(const std::function<bool()>& done) const;
    /// Waits until the editor has drawn all effects of the last event and sleeps again. @param idle_threads_too also
    /// waits for shader warm-up in idle threads
    void wait_until_idle(bool idle_threads_too = false) const;
    /// Drags from a position by an offset with the left button.
    void drag(int x, int y, int dx, int dy) const;
    /// Clicks at a position with the left button.
    void click(int x, int y) const { drag(x, y, 0, 0); }
    /// Double-clicks until `done` returns true: a slow machine may deliver two single clicks.
    void double_click(int x, int y, const std::function<bool()>& done) const;

    /// Returns the home folder of the editor under test.
    std::filesystem::path home() const { return folder_ / "home"; }
    /// Returns the folder of the editor's saved state.
    std::filesystem::path state_folder() const { return folder_ / "state/shadow-inspector"; }
    /// Returns the JSON of a file; a discarded value for a missing or broken file.
    static nlohmann::json json_of(const std::filesystem::path& file);
    /// Presses Ctrl+S and returns the settings of the preset at `file`. The default is the file of a new session.
    nlohmann::json saved(const std::string& file = "preset.json") const;
    /// Returns the screen and saves it as NAME.png in the tests' output folder.
    ByteImage screen(const std::string& name) const;
    /// Returns the editor's output so far.
    std::string log() const;

    std::filesystem::path folder_;
    std::unique_ptr<Process> server_, program_;

private:
    bool start_server();
};

}  // namespace si::test
