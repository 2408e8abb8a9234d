// Window with an OpenGL 4.5 core context, through GLFW.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/context/input_queue.h"
#include "app/context/thread_context.h"

struct GLFWwindow;

namespace si {

/// Window of the program with an OpenGL 4.5 core debug context and vsync. The context is current on the constructing
/// thread. Only one window may exist.
class WindowContext {
public:
    /// Opens the window. @param width, height the size of the window in screen coordinates at scale 1; shrunk to fit
    /// the monitor's work area
    /// @throws Error when there is no display or no OpenGL 4.5.
    WindowContext(const std::string& title, int width, int height, bool maximised = false);
    ~WindowContext();
    WindowContext(const WindowContext&) = delete;
    WindowContext& operator=(const WindowContext&) = delete;

    /// Returns the GLFW handle of the window.
    GLFWwindow* handle() const { return window_; }
    /// Returns a function that makes an OpenGL context for one background thread, which shares textures and buffers
    /// with the window's context. The function is empty if the driver offers no second context. The window must outlive
    /// the new context.
    ThreadContextMaker sharing() const;
    /// Wakes the thread that sleeps in wait_events(). Any thread may call it.
    static void wake();
    /// Returns true once the user has closed the window, or the X server has destroyed it.
    bool should_close() const;
    /// Sets the text of the window's title bar.
    void set_title(const std::string& title);
    /// Handles the events of the window that have arrived. If there is no input, sleeps until some arrives, at most
    /// `seconds`.
    void wait_events(double seconds);
    /// Handles the events of the window that have arrived, without sleeping.
    void poll_events();
    /// Shows the drawn frame in the window (swaps the buffers).
    void swap();
    /// Hides the mouse cursor so that the mouse moves without limits, while the user flies the camera; or shows the
    /// cursor again.
    /// @param held true: hide the cursor; false: show it at its old place
    void hold_cursor(bool held);
    /// Returns width and height of the window's framebuffer in pixels; 0 while the window is minimised or after it was
    /// destroyed.
    glm::ivec2 framebuffer_size() const;
    /// Returns width and height of the window in screen coordinates at scale 1. The constructor takes the same numbers,
    /// so that the next start can restore the size.
    std::pair<int, int> size() const;
    /// Returns true if the window is maximised: it fills the work area of the monitor.
    bool maximised() const;
    /// Returns the factor by which the desktop enlarges text and widgets on the window's monitor; 1 at about 96 dots
    /// per inch.
    float content_scale() const;
    /// Returns true if input, a resize or an uncovered window arrived since the last call.
    bool take_input() { return std::exchange(events_.input, false); }
    /// Returns the queue of input that no frame has shown yet. ImGui's backend receives input only from this queue.
    InputQueue& input() { return events_.queue; }
    /// Press of a key in the present ImGui frame; the key may be released already. Needed since ImGui 1.86 sees only
    /// keys that are held when its frame starts.
    struct KeyPress {
        int key = 0;   ///< GLFW_KEY_*
        int mods = 0;  ///< GLFW_MOD_*
    };
    /// Passes keys, characters and wheel movement to ImGui, as many as input().next() took from the queue for this
    /// frame. Returns the keys that were pressed.
    std::vector<KeyPress> pass_keys_to_imgui();
    /// Returns true if the key was held in the last frame shown. @param key GLFW_KEY_*
    bool is_down(int key) const { return events_.queue.is_down(key); }
    /// Returns the files dropped on the window since the last call.
    std::vector<std::filesystem::path> take_dropped() { return std::exchange(events_.dropped, {}); }

    /// Returns the window's name for the file dialogs of the desktop (XDG portals): "x11:" and the window's id. Empty
    /// if the window is not on X11.
    std::string portal_name() const;

    /// Returns true if the environment names a display on which a window can open (DISPLAY or WAYLAND_DISPLAY).
    static bool display_available();

private:
    /// Input events and dropped files of the window that no frame has used yet.
    struct Events {
        bool input = true;
        bool waiting = false;  ///< inside wait_events(): callbacks run as events arrive
        double polled_s = 0;   ///< time of the last poll
        InputQueue queue;
        std::vector<std::filesystem::path> dropped;
    };
    /// Callbacks of ImGui's GLFW backend, through which pass_keys_to_imgui() passes the queued input to ImGui.
    struct Backend {
        void (*key)(GLFWwindow*, int key, int scancode, int action, int mods) = nullptr;
        void (*character)(GLFWwindow*, unsigned) = nullptr;
        void (*scroll)(GLFWwindow*, double, double) = nullptr;
    };
    /// Installs the GLFW callbacks of the window for mouse, focus, resize, redraw and dropped files.
    void install_callbacks();
    /// Replaces the GLFW callbacks of ImGui for keys, characters and wheel by ones that fill the input queue. Keeps
    /// ImGui's callbacks for pass_keys_to_imgui(). Called before each poll, since ImGui may install its callbacks
    /// again.
    void intercept_backend();
    /// Adds a press or release of a key to the window's input queue. Callback for GLFW.
    static void on_key(GLFWwindow* window, int key, int scancode, int action, int mods);
    /// Queues a typed character (Unicode). GLFW callback.
    static void on_character(GLFWwindow* window, unsigned code) { note_input(window).queue.character(code); }
    /// Queues a turn of the mouse wheel. GLFW callback.
    static void on_scroll(GLFWwindow* window, double x, double y) { note_input(window).queue.wheel({x, y}); }
    /// Records that the window has received input, so that the next frame is drawn. Returns the events of the
    /// WindowContext that owns the window.
    static Events& note_input(GLFWwindow* window);

    GLFWwindow* window_ = nullptr;
    GLFWwindow* shared_window_ = nullptr;  ///< never shown; its context shares the window's objects; null: none
    Events events_;
    Backend backend_;
};

}  // namespace si
