// The editor without a window: drawn into a framebuffer, steered by calls instead of a mouse. For screenshots and
// tests.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>

#include "app/context/canvas.h"
#include "app/context/headless_context.h"
#include "app/context/imgui_session.h"
#include "app/editor/model.h"

namespace si {

/// The editor in a framebuffer, frame by frame.
class HeadlessEditor {
public:
    /// Starts to read the first scene. @throws Error if there is no OpenGL, or the size cannot be drawn
    explicit HeadlessEditor(const EditorOptions& options, SceneReader read = {});
    ~HeadlessEditor();

    EditorModel& model() { return *model_; }

    /// Mouse in the following frames.
    struct Mouse {
        std::optional<glm::vec2> at;  ///< pixels from the top left; none: outside
        bool left = false, right = false, middle = false, ctrl = false, shift = false;
        float wheel = 0;
    };
    Mouse mouse;

    /// Draws one frame of the editor, 1/60 s after the one before. Returns its requests.
    EditorRequests frame();
    /// Waits for a scene that is being read, draws frames until layout and pictures no longer change, and waits for
    /// what they ask to be measured.
    void settle();
    /// Adds all samples per pixel to the picture, if view.smooth is on, and draws it.
    void smooth();
    /// Returns the last frame, top row first.
    ByteImage picture() const;

private:
    int width_, height_;
    HeadlessContext context_;
    ImGuiSession imgui_;
    std::unique_ptr<Canvas> canvas_;
    std::unique_ptr<EditorModel> model_;
};

/// Returns the scale of text and widgets for a screenshot of this height, pixels.
float screenshot_scale(int height);

}  // namespace si
