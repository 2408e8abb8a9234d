#include "app/editor/headless_editor.h"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <imgui.h>
// clang-format off
#include <backends/imgui_impl_opengl3.h>
// clang-format on

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <utility>

#include "renderer/base/error.h"

namespace si {

namespace {

/// Makes the offscreen target of the whole editor. @throws Error if the size cannot be drawn
Canvas make_canvas(int width, int height) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (width < 64 || height < 64 || width > most || height > most)
        throw Error(
            fmt::format("the editor cannot be drawn at {} x {} pixels; each side is 64 to {}", width, height, most));
    return {width, height};
}

/// Returns true if a needed reference is not traced yet.
bool lacks_reference(const EditorFrame& f) {
    if (!f.reference || !f.reference->wanted || !f.reference->problem.empty()) return false;
    return !f.reference->current;
}

}  // namespace

float screenshot_scale(int height) {
    return std::clamp(std::round(float(height) / 1080 * 4) / 4, 1.0f, 4.0f);
}

HeadlessEditor::HeadlessEditor(const EditorOptions& options, SceneReader read)
    : width_(options.width),
      height_(options.height),
      imgui_(options.scale > 0 ? float(options.scale) : screenshot_scale(options.height)),
      canvas_(make_canvas(width_, height_)),
      model_(options, std::move(read),
             options.frame_patience ? FrameThread{.context = context_.sharing(), .patience = *options.frame_patience}
                                    : FrameThread{}) {
    model_.smooths = false;
}

void HeadlessEditor::add_all_samples() {
    model_.smooths = true;
    for (int i = 0; i <= kMaxSmoothedShadings; ++i) {
        frame();
        model_.finish_drawing();
    }
    frame();
}

EditorRequests HeadlessEditor::frame() {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {float(width_), float(height_)};
    io.DeltaTime = 1.0f / 60;
    io.MousePos = mouse.at ? ImVec2(mouse.at->x, mouse.at->y) : ImVec2(-FLT_MAX, -FLT_MAX);
    io.MouseDown[0] = mouse.left;
    io.MouseDown[1] = mouse.right;
    io.MouseDown[2] = mouse.middle;
    io.KeyCtrl = mouse.ctrl;
    io.KeyShift = mouse.shift;
    io.MouseWheel = mouse.wheel;
    mouse.wheel = 0;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    EditorRequests requests = draw_editor(model_.state, model_.facts());
    ImGui::Render();
    canvas_.bind();
    imgui_.draw(width_, height_);
    if (requests.shot && !model_.save_drawing(*requests.shot, imgui_)) model_.save_shot(*requests.shot, picture(), 1);
    model_.fulfil(requests);
    return requests;
}

void HeadlessEditor::settle() {
    do {
        model_.finish_loading();
        model_.finish_tracing();
        // Sizes settle in two frames; the picture follows in the next, numbers read from it in one more.
        for (int i = 0; i < 6; ++i) frame();
        if (model_.measuring()) {
            model_.finish_measuring();
            frame();
            frame();
        }
    } while (model_.finish_drawing() || model_.busy() || lacks_reference(model_.facts()));
}

}  // namespace si
