// Dear ImGui over OpenGL, without a window: its context, the editor's font and style, its GL objects.
#pragma once

#include "renderer/frame/frame.h"

struct ImDrawList;

namespace si {

/// One at a time. Needs a current OpenGL context from construction to destruction.
class ImGuiSession {
public:
    /// @throws Error when ImGui finds no OpenGL functions.
    explicit ImGuiSession(float scale);
    ~ImGuiSession();
    ImGuiSession(const ImGuiSession&) = delete;
    ImGuiSession& operator=(const ImGuiSession&) = delete;

    /// Draws what ImGui::Render() left into the bound framebuffer of this size.
    void draw(int width, int height);
    /// A picture of a list alone, in pixels from the upper left corner, top row first. Leaves the default framebuffer
    /// bound.
    ByteImage picture(ImDrawList& list, int width, int height);
};

}  // namespace si
