// A window with an OpenGL 4.5 core context, through GLFW.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/context/mouse_queue.h"
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
    /// A key that went down, perhaps already up again. ImGui 1.86 sees only keys that are held when its frame starts.
    struct KeyPress {
        int key = 0;   ///< GLFW_KEY_*
        int mods = 0;  ///< GLFW_MOD_*
    };
    /// Keys pressed since the last call.
    std::vector<KeyPress> take_keys();
    bool is_down(int key) const;
    /// What the mouse did and no frame has shown yet.
    MouseQueue& mouse() { return events_.mouse; }
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
        std::vector<KeyPress> keys;
        MouseQueue mouse;
        std::vector<std::filesystem::path> dropped;
    };
    void install_callbacks();
    static void note_input(GLFWwindow* window);
    static MouseQueue& mouse_of(GLFWwindow* window);

    GLFWwindow* window_ = nullptr;
    GLFWwindow* beside_ = nullptr;  ///< never shown: a context that shares the window's objects; null: there is none
    Events events_;
};

}  // namespace si
