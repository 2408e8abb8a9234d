#include "app/context/window_context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstdlib>

#include "app/context/x11_errors.h"
#include "renderer/base/error.h"
#include "ui/state/editor_ui.h"

namespace si {
namespace {

/// Returns code and text of the last error of GLFW.
std::pair<int, std::string> last_glfw_error() {
    const char* text = nullptr;
    const int code = glfwGetError(&text);
    return {code, text ? text : "no reason given"};
}

/// Returns the X11 id of a window; 0: it has none.
unsigned long x11_id(GLFWwindow* window) {
    // The function is looked up at run time, because a GLFW built for Wayland only lacks it.
    using IdOf = unsigned long (*)(GLFWwindow*);
    const auto id_of = reinterpret_cast<IdOf>(dlsym(RTLD_DEFAULT, "glfwGetX11Window"));
    return id_of ? id_of(window) : 0;
}

constexpr const char* kHeadlessHint =
    "without a display use the headless commands, or: edit SCENE --headless --screenshot FILE.png";

}  // namespace

bool WindowContext::display_available() {
    const auto set = [](const char* name) {
        const char* value = std::getenv(name);
        return value && *value;
    };
    return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

std::string WindowContext::portal_name() const {
    const unsigned long id = x11_id(window_);
    return id ? fmt::format("x11:{:x}", id) : std::string();
}

WindowContext::WindowContext(const std::string& title, int width, int height, bool maximised) {
    if (!glfwInit())
        throw Error(fmt::format("no window: glfwInit failed ({}); {}", last_glfw_error().second, kHeadlessHint));
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);  // for drivers that report a reset
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_MAXIMIZED, maximised ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    // A desktop finds the icon of a window by its class: StartupWMClass in packaging/shadow-inspector.desktop.
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "shadow-inspector");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "shadow-inspector");
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
        int x = 0, y = 0, w = 0, h = 0;
        glfwGetMonitorWorkarea(monitor, &x, &y, &w, &h);
        float across = 1, down = 1;  // factors by which GLFW enlarges the requested size
        glfwGetMonitorContentScale(monitor, &across, &down);
        if (w > 0 && h > 0) {
            width = std::min(width, int(float(w) / std::max(across, 0.5f)));
            height = std::min(height, int(float(h) / std::max(down, 0.5f)));
        }
    }
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (!window_) {
        const auto [code, reason] = last_glfw_error();
        glfwTerminate();
        throw Error(fmt::format("no window: glfwCreateWindow (OpenGL 4.5 core) failed ({}); {}", reason,
                                code == GLFW_VERSION_UNAVAILABLE
                                    ? "`shadow-inspector info` says what the driver offers; update it, or use "
                                      "Mesa's software driver with LIBGL_ALWAYS_SOFTWARE=1"
                                    : kHeadlessHint));
    }
    float scale_x = 1, scale_y = 1;
    glfwGetWindowContentScale(window_, &scale_x, &scale_y);
    glfwSetWindowSizeLimits(window_, int(kMinWindowWidth * scale_x), int(kMinWindowHeight * scale_y), GLFW_DONT_CARE,
                            GLFW_DONT_CARE);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHint(GLFW_MAXIMIZED, GLFW_FALSE);
    shared_window_ = glfwCreateWindow(16, 16, title.c_str(), nullptr, window_);
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    survive_x_errors(x11_id(window_));
    glfwSetWindowUserPointer(window_, &events_);
    install_callbacks();
}

WindowContext::~WindowContext() {
    if (shared_window_) glfwDestroyWindow(shared_window_);
    glfwDestroyWindow(window_);
    glfwTerminate();
}

// ImGui's backend is installed later and calls these callbacks after its own.
void WindowContext::install_callbacks() {
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int mods) {
        Events& events = note_input(w);
        const double now_s = glfwGetTime();
        events.queue.button(button, action == GLFW_PRESS, mods, {events.waiting ? now_s : events.polled_s, now_s});
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) { note_input(w).queue.move({x, y}); });
    glfwSetCursorEnterCallback(window_,
                               [](GLFWwindow* w, int entered) { note_input(w).queue.enter(entered == GLFW_TRUE); });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int) { note_input(w); });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { note_input(w); });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { note_input(w); });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
        auto& dropped = note_input(w).dropped;
        dropped.insert(dropped.end(), paths, paths + count);
    });
}

// The backend would pass all events to the next frame at once, so that these callbacks replace the backend's.
void WindowContext::intercept_backend() {
    const auto stand = [](auto before, auto mine, auto& behind) {
        if (before != mine) behind = before;
    };
    stand(glfwSetKeyCallback(window_, on_key), &on_key, backend_.key);
    stand(glfwSetCharCallback(window_, on_character), &on_character, backend_.character);
    stand(glfwSetScrollCallback(window_, on_scroll), &on_scroll, backend_.scroll);
}

void WindowContext::on_key(GLFWwindow* window, int key, int, int action, int mods) {
    Events& events = note_input(window);
    // ImGui makes key repeats itself.
    if (action != GLFW_REPEAT) events.queue.key({.key = key, .mods = mods, .down = action == GLFW_PRESS});
}

ThreadContextMaker WindowContext::sharing() const {
    struct Current : ThreadContext {
        explicit Current(GLFWwindow* window) { glfwMakeContextCurrent(window); }
        ~Current() override { glfwMakeContextCurrent(nullptr); }
    };
    if (!shared_window_) return {};
    return [this] { return std::make_unique<Current>(shared_window_); };
}

void WindowContext::wake() {
    glfwPostEmptyEvent();
}

WindowContext::Events& WindowContext::note_input(GLFWwindow* window) {
    Events& events = *static_cast<Events*>(glfwGetWindowUserPointer(window));
    events.input = true;
    return events;
}

bool WindowContext::should_close() const {
    return glfwWindowShouldClose(window_) || x_window_is_gone();
}
void WindowContext::set_title(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}
void WindowContext::wait_events(double seconds) {
    poll_events();  // events that have arrived already come first
    if (events_.input) return;
    events_.waiting = true;
    glfwWaitEventsTimeout(seconds);
    events_.waiting = false;
    events_.polled_s = glfwGetTime();
}
void WindowContext::poll_events() {
    intercept_backend();
    glfwPollEvents();
    events_.polled_s = glfwGetTime();
    events_.queue.typing(ImGui::GetCurrentContext() && ImGui::GetIO().WantTextInput);
}
void WindowContext::hold_cursor(bool held) {
    const int wanted = held ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL;
    // ImGui sets the cursor's shape and hides it.
    if (held == (glfwGetInputMode(window_, GLFW_CURSOR) == GLFW_CURSOR_DISABLED)) return;
    glfwSetInputMode(window_, GLFW_CURSOR, wanted);
    glm::dvec2 at(0);  // GLFW sends no event about the cursor's new place
    glfwGetCursorPos(window_, &at.x, &at.y);
    events_.queue.move(at);
}
void WindowContext::swap() {
    glfwSwapBuffers(window_);
}

glm::ivec2 WindowContext::framebuffer_size() const {
    glm::ivec2 size(0);
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return x_window_is_gone() ? glm::ivec2(0) : size;
}

std::pair<int, int> WindowContext::size() const {
    const glm::vec2 size = glm::round(glm::vec2(framebuffer_size()) / content_scale());
    return {int(size.x), int(size.y)};
}

bool WindowContext::maximised() const {
    return glfwGetWindowAttrib(window_, GLFW_MAXIMIZED) == GLFW_TRUE;
}

float WindowContext::content_scale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    return std::max({x, y, 0.5f});
}

std::vector<WindowContext::KeyPress> WindowContext::pass_keys_to_imgui() {
    const InputQueue::Strokes strokes = events_.queue.take_strokes();
    std::vector<KeyPress> pressed;
    for (const auto& [key, mods, down] : strokes.keys) {
        if (backend_.key) backend_.key(window_, key, 0, down ? GLFW_PRESS : GLFW_RELEASE, mods);
        if (down) pressed.push_back({key, mods});
    }
    for (const unsigned code : strokes.characters)
        if (backend_.character) backend_.character(window_, code);
    if (backend_.scroll && strokes.wheel != glm::dvec2(0)) backend_.scroll(window_, strokes.wheel.x, strokes.wheel.y);
    return pressed;
}

}  // namespace si
