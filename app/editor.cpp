#include "app/editor.h"

#include <epoxy/gl.h>
#include <imgui.h>
// clang-format off
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
// clang-format on

#include <algorithm>

#include "app/editor_model.h"
#include "app/headless_editor.h"
#include "app/imgui_session.h"
#include "app/output.h"
#include "app/window_context.h"
#include "renderer/error.h"

namespace si {
namespace {

constexpr double kPollSeconds = 0.4;  ///< between looks at shader files and blinks of a text cursor
constexpr int kSettleFrames = 3;      ///< frames that ImGui takes to settle after input

/// ImGui's hold on the window's callbacks.
struct WindowInput {
    explicit WindowInput(const WindowContext& window) { ImGui_ImplGlfw_InitForOpenGL(window.handle(), true); }
    ~WindowInput() { ImGui_ImplGlfw_Shutdown(); }
    WindowInput(const WindowInput&) = delete;
    WindowInput& operator=(const WindowInput&) = delete;
};

int run_window(const EditorOptions& options) {
    WindowContext window("Shadow Inspector", options.width, options.height);
    ImGuiSession imgui(options.scale > 0 ? float(options.scale) : window.content_scale());
    const WindowInput input(window);
    EditorModel model(options);
    std::string titled;
    int due = kSettleFrames;  // frames still to draw before the editor may sleep
    while (!window.should_close()) {
        if (due > 0)
            window.poll_events();
        else
            window.wait_events(kPollSeconds);
        if (window.take_input()) due = kSettleFrames;
        for (const auto& path : window.take_dropped()) model.open(path), due = kSettleFrames;
        if (model.poll_shaders() || ImGui::GetIO().WantTextInput) due = std::max(due, 1);
        const int width = window.framebuffer_width(), height = window.framebuffer_height();
        if (due == 0 || width == 0 || height == 0) {
            if (due > 0) window.wait_events(kPollSeconds);  // minimised
            continue;
        }
        --due;

        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
        if (ImGui::IsKeyPressed(GLFW_KEY_F1, false)) model.state.show_shortcuts = !model.state.show_shortcuts;
        const EditorActions actions = draw_editor(model.state, model.facts());
        ImGui::Render();
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        imgui.draw(width, height);
        window.swap();
        if (model.fulfil(actions)) due = std::max(due, 2);
        if (actions.redraw) due = std::max(due, 1);
        if (actions.quit) break;
        if (titled != model.state.scene_name) {
            titled = model.state.scene_name;
            window.set_title(titled + " - Shadow Inspector");
        }
    }
    return 0;
}

}  // namespace

int run_editor(const EditorOptions& options) {
    if (!options.headless) return run_window(options);
    HeadlessEditor editor(options);
    editor.settle();
    write_png(options.screenshot, editor.picture());
    return 0;
}

}  // namespace si
