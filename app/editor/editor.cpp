#include "app/editor/editor.h"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <imgui.h>
// clang-format off
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
// clang-format on

#include <algorithm>
#include <cfloat>

#include "app/base/interrupt.h"
#include "app/base/output.h"
#include "app/context/imgui_session.h"
#include "app/context/window_context.h"
#include "app/context/x11_errors.h"
#include "app/editor/file_portal.h"
#include "app/editor/headless_editor.h"
#include "app/editor/model.h"
#include "renderer/base/error.h"
#include "renderer/frame/read_images.h"
#include "renderer/gl/driver_failure.h"
#include "renderer/gl/target.h"
#include "renderer/importers/importers.h"

namespace si {
namespace {

constexpr int kStillLooks = 3;                ///< idle polls after which the editor counts as idle
constexpr double kPollSeconds = 0.4;          ///< between polls of shader files and blinks of a text cursor
constexpr double kLoadingPollSeconds = 0.05;  ///< between polls of background work
constexpr int kSettleFrames = 3;              ///< frames that ImGui takes to settle after input

/// Scope in which ImGui's GLFW backend is installed on the window.
struct WindowInput {
    explicit WindowInput(const WindowContext& window) { ImGui_ImplGlfw_InitForOpenGL(window.handle(), true); }
    ~WindowInput() { ImGui_ImplGlfw_Shutdown(); }
    WindowInput(const WindowInput&) = delete;
    WindowInput& operator=(const WindowInput&) = delete;
};

/// Passes the present state of Ctrl and Shift to ImGui.
void show_held_modifiers(const WindowContext& window) {
    const auto held = [&](int left, int right) { return window.is_down(left) || window.is_down(right); };
    ImGui::GetIO().KeyCtrl = held(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
    ImGui::GetIO().KeyShift = held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
}

/// Passes the next step of the mouse queue to ImGui. The backend would pass only the present state: of all presses
/// during a slow frame one, at the mouse's latest place.
class MouseStep {
public:
    explicit MouseStep(WindowContext& window) : window_(window), step_(window.input().next()) {
        ImGuiIO& io = ImGui::GetIO();
        std::ranges::copy(step_.down, io.MouseDown);
        if (step_.at) io.MousePos = {float(step_.at->x), float(step_.at->y)};
        io.MouseDoubleClickTime = step_.doubles ? FLT_MAX : 0;
        if (!step_.mods) return;
        io.KeyCtrl = (*step_.mods & GLFW_MOD_CONTROL) != 0;
        io.KeyShift = (*step_.mods & GLFW_MOD_SHIFT) != 0;
    }
    ~MouseStep() {
        if (step_.mods) show_held_modifiers(window_);
    }
    MouseStep(const MouseStep&) = delete;
    MouseStep& operator=(const MouseStep&) = delete;

private:
    WindowContext& window_;
    MouseQueue::Step step_;
};

/// Reads back the window's picture before it is shown, top row first.
ByteImage read_window(int width, int height) {
    ByteImage image{width, height, {}};
    image.data.resize(std::size_t(width) * std::size_t(height) * 4);
    gl::prepare_read_back();
    glReadBuffer(GL_BACK);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image.data.data());
    flip_rows(image.data, width, height, 4);
    return image;
}

/// Passes keys pressed since the last frame to ImGui as held during the next one, so that a short press is not lost
/// during a slow frame.
class PressedKeys {
public:
    explicit PressedKeys(WindowContext& window) : window_(window), keys_(window.pass_keys_to_imgui()) {
        ImGuiIO& io = ImGui::GetIO();
        for (const auto& [key, mods] : keys_) {
            io.KeysDown[key] = true;
            if (mods & GLFW_MOD_CONTROL) io.KeyCtrl = true;
            if (mods & GLFW_MOD_SHIFT) io.KeyShift = true;
        }
    }
    ~PressedKeys() {
        for (const auto& [key, mods] : keys_) ImGui::GetIO().KeysDown[key] = window_.is_down(key);
        if (!keys_.empty()) show_held_modifiers(window_);
    }
    PressedKeys(const PressedKeys&) = delete;
    PressedKeys& operator=(const PressedKeys&) = delete;

private:
    WindowContext& window_;
    std::vector<WindowContext::KeyPress> keys_;
};

/// Checks that no faulty numbers were found (--check-numeric). @throws Error naming the first fault
void require_sound_session(EditorModel& model) {
    if (const std::string& what = model.session().unsound(); !what.empty()) throw Error("--check-numeric: " + what);
}

/// Opens or saves the file that was chosen in the desktop's dialog. Returns true if there was an answer.
bool take_file(FilePortal& portal, EditorModel& model) {
    const auto answer = portal.take_answer();
    if (!answer) return false;
    if (answer->kind == FilePortal::Answer::Kind::NoDialog) {
        model.has_desktop_dialog = false;
        model.state.files.dialog.asked = true;  // opens the editor's own dialog
    } else if (answer->kind == FilePortal::Answer::Kind::Chosen) {
        if (answer->job == FileDialog::Job::Open)
            model.open(answer->file);
        else
            model.save_as(answer->file);
    }
    return true;
}

std::vector<std::string> run_window(const EditorOptions& options) {
    const WorkspaceData kept = Workspace(options.state_folder).data();
    const bool as_kept = !options.size_given && kept.window_width > 0;
    WindowContext window("Shadow Inspector", as_kept ? kept.window_width : options.width,
                         as_kept ? kept.window_height : options.height, !options.size_given && kept.maximised);
    ImGuiSession imgui(options.scale > 0 ? float(options.scale) : window.content_scale());
    const WindowInput input(window);
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    // A capture or an image of a map becomes a bundle first, as one that is dropped on the window.
    const bool imports = find_frame_file(options.session.scene) != nullptr;
    EditorOptions first = options;
    if (imports) first.session.scene.clear();
    EditorModel model(first, {}, {.context = window.sharing(), .wake = WindowContext::wake});
    if (imports) model.open(options.session.scene);
    FilePortal portal(WindowContext::wake);
    model.has_desktop_dialog = true;
    std::string titled;
    const InterruptGuard interrupt;  // SIGTERM and SIGHUP end the editor cleanly
    const XServerGuard server([&]() -> std::string {
        model.save_before_crash();
        return options.state_folder.empty() ? "" : "the next start offers the settings that were not saved";
    });
    int due = kSettleFrames;  // frames to draw before the editor may sleep
    int still = 0;            // consecutive polls without work
    while (!window.should_close() && !interrupt.stop_requested()) {
        if (due > 0)
            window.poll_events();
        else
            window.wait_events(model.busy() ? kLoadingPollSeconds : kPollSeconds);
        if (window.take_input()) due = kSettleFrames;
        for (const auto& path : window.take_dropped()) {
            model.open(path);
            due = kSettleFrames;
        }
        if (take_file(portal, model)) due = kSettleFrames;
        if (model.follow_scene_files()) due = std::max(due, 1);
        if (model.poll_shaders() || ImGui::GetIO().WantTextInput) due = std::max(due, 1);
        if (model.loading_moved() || model.drawing_moved() || model.measuring_moved() || model.tracing_moved())
            due = std::max(due, 1);
        model.write_when_due();
        const glm::ivec2 size = window.framebuffer_size();
        still = due == 0 && !model.busy() ? still + 1 : 0;
        if (still == kStillLooks) model.release_unused_memory();
        if (due == 0 || size.x == 0 || size.y == 0) {
            if (due > 0) window.wait_events(kPollSeconds);  // minimised
            continue;
        }
        --due;

        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplGlfw_NewFrame();
        const MouseStep mouse(window);
        const PressedKeys keys(window);
        ImGui::NewFrame();
        const EditorRequests requests = draw_editor(model.state, model.facts());
        ImGui::Render();
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        imgui.draw(size.x, size.y);
        if (const GLenum error = glGetError(); error != GL_NO_ERROR)
            model.session().note_driver(fmt::format("the editor's window: glGetError {:#x}", error));
        const float scale = ImGui::GetIO().DisplayFramebufferScale.x;
        if (requests.shot && !model.save_drawing(*requests.shot, imgui))
            model.save_shot(*requests.shot, read_window(size.x, size.y), scale);
        window.swap();
        try {
            gl::check_context_alive();
        } catch (const gl::ContextLost&) {
            model.save_before_crash();  // the next start offers the session
            throw;
        }
        window.hold_cursor(requests.hold_cursor);
        if (model.fulfil(requests)) due = std::max(due, 2);
        if (requests.open_desktop_dialog) portal.open_dialog(*requests.open_desktop_dialog, window.portal_name());
        if (!window.input().empty()) due = std::max(due, kSettleFrames);
        if (requests.redraw) due = std::max(due, 1);
        if (requests.quit) break;
        if (titled != model.state.scene_name) {
            titled = model.state.scene_name;
            window.set_title(titled + " - Shadow Inspector");
        }
    }
    // A minimised window has no size, and neither has one that another client has destroyed.
    if (const auto [width, height] = window.size(); width > 0 && height > 0)
        model.note_window_size(width, height, window.maximised());
    model.end();
    require_sound_session(model);
    return model.notes();
}

}  // namespace

std::vector<std::string> run_editor(const EditorOptions& options) {
    if (!options.headless) return run_window(options);
    HeadlessEditor editor(options);
    editor.settle();
    editor.add_all_samples();
    editor.model().require_scene();
    require_outputs_not_read(std::vector{options.screenshot}, *editor.model().facts().scene, options.session.preset);
    write_png(options.screenshot, editor.picture());
    editor.model().end();
    require_sound_session(editor.model());
    return editor.model().notes();
}

}  // namespace si
