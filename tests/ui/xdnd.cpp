// Drag-and-drop source by the XDND protocol.
#include "tests/ui/xdnd.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <chrono>
#include <initializer_list>
#include <optional>
#include <string>
#include <thread>

namespace si::test {
namespace {

using Clock = std::chrono::steady_clock;
constexpr long kVersion = 5;

/// Returns the URI of a file: "file:///a%20b", with all but plain letters encoded.
std::string uri(const std::filesystem::path& path) {
    constexpr char kHex[] = "0123456789ABCDEF";
    std::string out = "file://";
    for (const char c : path.string()) {
        const auto code = static_cast<unsigned char>(c);
        if (std::isalnum(code) || std::string_view("/._-").find(c) != std::string_view::npos)
            out += c;
        else
            out += std::string{'%', kHex[code >> 4], kHex[code & 15]};
    }
    return out;
}

/// Source side of the protocol (freedesktop.org, "Drag-and-Drop Protocol for the X Window System").
class Source {
public:
    explicit Source(Window target, std::chrono::seconds patience = {})
        : display_(XOpenDisplay(nullptr)), target_(target), patience_(patience) {
        if (!display_) return;
        XSetErrorHandler([](Display*, XErrorEvent*) { return 0; });  // errors of closed windows are ignored
        window_ = XCreateSimpleWindow(display_, DefaultRootWindow(display_), -10, -10, 1, 1, 0, 0, 0);
        XSetSelectionOwner(display_, atom("XdndSelection"), window_, CurrentTime);
    }
    ~Source() {
        if (display_) XCloseDisplay(display_);
    }
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    void enter(int x, int y) const {
        if (!display_) return;
        send("XdndEnter", {long(window_), kVersion << 24, long(atom("text/uri-list")), 0, 0});
        send("XdndPosition", {long(window_), 0, long(x) << 16 | y, CurrentTime, long(atom("XdndActionCopy"))});
    }

    bool drop(const std::string& text, int x, int y) {
        if (!display_) return false;
        enter(x, y);
        const auto status = wait_for("XdndStatus", text);
        if (!status || !(status->data.l[1] & 1)) return false;
        send("XdndDrop", {long(window_), 0, CurrentTime, 0, 0});
        const auto finished = wait_for("XdndFinished", text);
        return finished && finished->data.l[1] != 0;  // GLFW 3.3 answers with the number of bytes read
    }

private:
    Atom atom(const char* name) const { return XInternAtom(display_, name, False); }

    void send(const char* type, std::initializer_list<long> data) const {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.display = display_;
        event.xclient.window = target_;
        event.xclient.message_type = atom(type);
        event.xclient.format = 32;
        std::size_t i = 0;
        for (const long value : data) event.xclient.data.l[i++] = value;
        XSendEvent(display_, target_, False, NoEventMask, &event);
        XFlush(display_);
    }

    /// Answers the target's request for the dragged data.
    void answer(const XSelectionRequestEvent& request, const std::string& text) const {
        XChangeProperty(display_, request.requestor, request.property, request.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(text.data()), int(text.size()));
        XEvent event{};
        event.xselection.type = SelectionNotify;
        event.xselection.requestor = request.requestor;
        event.xselection.selection = request.selection;
        event.xselection.target = request.target;
        event.xselection.property = request.property;
        event.xselection.time = request.time;
        XSendEvent(display_, request.requestor, False, NoEventMask, &event);
        XFlush(display_);
    }

    /// Waits for the next message of a type and answers requests for the dragged text.
    std::optional<XClientMessageEvent> wait_for(const char* type, const std::string& text) const {
        for (const auto end = Clock::now() + patience_; Clock::now() < end;) {
            if (XPending(display_) == 0) {
                if (XWindowAttributes known; !XGetWindowAttributes(display_, target_, &known)) return {};
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
                continue;
            }
            XEvent event;
            XNextEvent(display_, &event);
            if (event.type == SelectionRequest) answer(event.xselectionrequest, text);
            if (event.type == ClientMessage && event.xclient.message_type == atom(type)) return event.xclient;
        }
        return {};
    }

    Display* display_ = nullptr;
    Window target_ = 0, window_ = 0;
    std::chrono::seconds patience_;
};

}  // namespace

bool drop_file(unsigned long window, const std::filesystem::path& file, int x, int y, std::chrono::seconds patience) {
    return Source(window, patience).drop(uri(file) + "\r\n", x, y);
}

void begin_abandoned_drag(unsigned long window, int x, int y) {
    Source(window).enter(x, y);
}

}  // namespace si::test
