#include "app/context/imgui_session.h"

#include <epoxy/gl.h>
#include <imgui.h>
// Backends are included here only: ui/ draws without them.
#include <backends/imgui_impl_opengl3.h>

#include "app/context/canvas.h"
#include "renderer/base/error.h"
#include "ui/widgets/theme.h"

namespace si {

ImGuiSession::ImGuiSession(float scale) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    theme::load_fonts(scale);
    theme::apply_style(scale);
    if (!ImGui_ImplOpenGL3_Init("#version 450 core")) {
        ImGui::DestroyContext();
        throw Error("the editor cannot draw: ImGui found no OpenGL functions; is libGL installed?");
    }
}

ImGuiSession::~ImGuiSession() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

namespace {

void draw_data(ImDrawData* data, int width, int height) {
    // The backend does not set these states, which the renderer's last pass may have changed.
    glViewport(0, 0, width, height);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(data);
}

}  // namespace

void ImGuiSession::draw(int width, int height) {
    draw_data(ImGui::GetDrawData(), width, height);
}

ByteImage ImGuiSession::render_list(ImDrawList& list, int width, int height) {
    const Canvas canvas(width, height);
    canvas.bind();
    ImDrawList* lists[] = {&list};
    ImDrawData data;
    data.Valid = true;
    data.CmdLists = lists;
    data.CmdListsCount = 1;
    data.TotalIdxCount = list.IdxBuffer.Size;
    data.TotalVtxCount = list.VtxBuffer.Size;
    data.DisplaySize = {float(width), float(height)};
    data.FramebufferScale = {1, 1};
    draw_data(&data, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return canvas.read_picture();
}

}  // namespace si
