// Dear ImGui over OpenGL without a window: ImGui's context, the editor's font and style, ImGui's GL objects.
#pragma once

#include "renderer/frame/frame.h"

struct ImDrawList;

namespace si {

/// Dear ImGui context with the editor's fonts and style. Only one may exist at a time. Needs a current OpenGL context
/// from construction to destruction.
class ImGuiSession {
public:
    /// Makes the ImGui context. @param scale scale of text and widgets; 1 at about 96 dots per inch @throws Error when
    /// ImGui finds no OpenGL functions
    explicit ImGuiSession(float scale);
    ~ImGuiSession();
    ImGuiSession(const ImGuiSession&) = delete;
    ImGuiSession& operator=(const ImGuiSession&) = delete;

    /// Draws the output of ImGui::Render() into the bound framebuffer of this size in pixels.
    void draw(int width, int height);
    /// Renders one ImGui draw list into an image of its own, top row first. The list's coordinates are pixels from the
    /// upper left. Leaves the default framebuffer bound.
    ByteImage render_list(ImDrawList& list, int width, int height);
};

}  // namespace si
