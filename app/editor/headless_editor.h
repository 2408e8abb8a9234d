// The editor without a window: drawn into a framebuffer, steered by calls instead of a mouse. For screenshots and
// tests.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "app/context/canvas.h"
#include "app/context/headless_context.h"
#include "app/context/imgui_session.h"
#include "app/editor/model.h"

namespace si {

/// Editor without a window, drawn into a framebuffer frame by frame, for screenshots and tests.
class HeadlessEditor {
public:
    /// Makes the editor and starts to read its first scene (EditorOptions::session). @param read reads scenes; empty:
    /// load_scene()
    /// @throws Error if there is no OpenGL, or the size cannot be drawn
    explicit HeadlessEditor(const EditorOptions& options, SceneReader read = {});

    EditorModel& model() { return model_; }

    /// Simulated mouse and modifier keys, which the next frames of the headless editor read.
    struct Mouse {
        std::optional<glm::vec2> at;  ///< pixels from the top left; none: outside
        bool left = false, right = false, middle = false, ctrl = false, shift = false;
        float wheel = 0;
    };
    Mouse mouse;

    /// Draws one frame of the headless editor (for screenshots and tests), 1/60 s after the one before, and performs
    /// what the panels request. Returns these requests.
    EditorRequests frame();
    /// Draws frames until nothing changes any more: the scene is loaded, layout and pictures are final, and all
    /// requested measurements have ended.
    void settle();
    /// Completes the anti-aliasing of the scene picture (view.smooth), which the editor adds sample by sample over
    /// several frames, and draws the editor once more. With view.smooth off the picture stays as it is.
    void add_all_samples();
    /// Returns the editor's last frame as an image, top row first.
    ByteImage picture() const { return canvas_.read_picture(); }

private:
    int width_, height_;
    HeadlessContext context_;
    ImGuiSession imgui_;
    Canvas canvas_;
    EditorModel model_;
};

/// Returns the default scale of text and widgets for a screenshot: height / 1080, rounded to quarters, from 1 to 4.
/// @param height of the screenshot, pixels
float screenshot_scale(int height);

}  // namespace si
