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

class HeadlessEditor {
public:
    /// Starts to read the first scene. @throws Error when there is no OpenGL, or the size cannot be drawn.
    explicit HeadlessEditor(const EditorOptions& options, SceneReader read = {});
    ~HeadlessEditor();

    EditorModel& model() { return *model_; }

    /// Where the mouse is and what it does in the following frames.
    struct Mouse {
        std::optional<glm::vec2> at;  ///< pixels from the top left; none: outside
        bool left = false, right = false, middle = false, ctrl = false, shift = false;
        float wheel = 0;
    };
    Mouse mouse;

    /// One frame of the editor, 1/60 s after the one before, and what it asked for.
    EditorRequests frame();
    /// Waits for a scene that is being read, draws frames until layout and pictures no longer change, and waits for
    /// what they ask to be measured.
    void settle();
    /// Lets the picture become smooth, where it is to (view.smooth), and draws it. Before, it stays as it is drawn.
    void smooth();
    /// The last frame, top row first.
    ByteImage picture() const;

private:
    int width_, height_;
    HeadlessContext context_;
    ImGuiSession imgui_;
    std::unique_ptr<Canvas> canvas_;
    std::unique_ptr<EditorModel> model_;
};

/// The scale of text and widgets that suits a screenshot of this height.
float screenshot_scale(int height);

}  // namespace si
