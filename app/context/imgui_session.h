// Dear ImGui over OpenGL without a window: ImGui's context, the editor's font and style, ImGui's GL objects.
#pragma once

#include "renderer/frame/frame.h"

struct ImDrawList;

namespace si {

/// Owner of the Dear ImGui context, with the editor's fonts and style. Only one may exist at a time. It needs a current
/// OpenGL context from construction to destruction.
class ImGuiSession {
public:
    /// Makes the ImGui context. @param scale scale of text and widgets; 1 at about 96 dots per inch @throws Error when
    /// ImGui finds no OpenGL functions
    explicit ImGuiSession(float scale);
    ~ImGuiSession();
    ImGuiSession(const ImGuiSession&) = delete;
    ImGuiSession& operator=(const ImGuiSession&) = delete;

    /// Draws the widgets that ImGui::Render() has prepared into the bound framebuffer. @param width, height size of the
    /// framebuffer, pixels
    void draw(int width, int height);
    /// Renders one ImGui draw list into an image of its own, top row first. Leaves the default framebuffer bound.
    /// @param list its coordinates are pixels from the upper left @param width, height size of the image, pixels
    ByteImage render_list(ImDrawList& list, int width, int height);
};

}  // namespace si
