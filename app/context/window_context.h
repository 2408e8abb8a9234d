// A window with an OpenGL 4.5 core context, through GLFW.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/context/input_queue.h"
#include "app/context/thread_context.h"

struct GLFWwindow;

namespace si {

/// One window at a time; the context is a debug context, current on the constructing thread, with vsync.
class WindowContext {
public:
    /// @param width, height in screen coordinates at scale 1; shrunk to fit the monitor's work area.
    /// @throws Error when there is no display or no OpenGL 4.5.
    WindowContext(const std::string& title, int width, int height, bool maximised = false);
    ~WindowContext();
    WindowContext(const WindowContext&) = delete;
    WindowContext& operator=(const WindowContext&) = delete;

    GLFWwindow* handle() const { return window_; }
    /// Makes one context beside the window's, which must live longer; empty where the driver has none.
    ThreadContextMaker sharing() const;
    /// Ends wait_events(). From any thread.
    static void wake();
    bool should_close() const;
    void set_title(const std::string& title);
    /// Sleeps until input arrives, at most `seconds`.
    void wait_events(double seconds);
    void poll_events();
    void swap();
    /// Hides the mouse and frees it from the screen's edges, or gives it back where it was.
    void hold_cursor(bool held);
    int framebuffer_width() const;
    int framebuffer_height() const;
    /// In screen coordinates at scale 1, as the constructor takes it.
    std::pair<int, int> size() const;
    bool maximised() const;
    /// The monitor's scale for text and widgets; 1 at about 96 dots per inch.
    float content_scale() const;
    /// Whether the last wait brought input, a resize or an uncovered window; cleared by the call.
    bool take_input();
    /// What mouse and keys did and no frame has shown yet. ImGui's backend is told nothing of it as it arrives.
    InputQueue& input() { return events_.queue; }
    /// A key that went down, perhaps already up again. ImGui 1.86 sees only keys that are held when its frame starts.
    struct KeyPress {
        int key = 0;   ///< GLFW_KEY_*
        int mods = 0;  ///< GLFW_MOD_*
    };
    /// Tells ImGui's backend of keys, characters and the wheel in the step that input().next() began.
    /// @returns the keys that went down in it
    std::vector<KeyPress> take_keys();
    /// As frames have been shown it.
    bool is_down(int key) const { return events_.queue.is_down(key); }
    /// Files dropped on the window since the last call.
    std::vector<std::filesystem::path> take_dropped();

    /// How other programs name the window to the desktop's portals: "x11:" and its id; empty elsewhere.
    std::string portal_name() const;

    /// Whether a window can be opened as far as the environment tells (DISPLAY or WAYLAND_DISPLAY).
    static bool display_available();

private:
    struct Events {
        bool input = true;
        bool waiting = false;  ///< events are told of as they arrive
        double polled_s = 0;   ///< when they were asked for last
        InputQueue queue;
        std::vector<std::filesystem::path> dropped;
    };
    /// ImGui's, which the queue stands before.
    struct Backend {
        void (*key)(GLFWwindow*, int key, int scancode, int action, int mods) = nullptr;
        void (*character)(GLFWwindow*, unsigned) = nullptr;
        void (*scroll)(GLFWwindow*, double, double) = nullptr;
    };
    void install_callbacks();
    void stand_before_backend();
    static void on_key(GLFWwindow* window, int key, int scancode, int action, int mods);
    static void on_character(GLFWwindow* window, unsigned code);
    static void on_scroll(GLFWwindow* window, double x, double y);
    static void note_input(GLFWwindow* window);
    static InputQueue& queue_of(GLFWwindow* window);

    GLFWwindow* window_ = nullptr;
    GLFWwindow* beside_ = nullptr;  ///< never shown: a context that shares the window's objects; null: there is none
    Events events_;
    Backend backend_;
};

}  // namespace si
