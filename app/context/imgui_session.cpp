#include "app/context/imgui_session.h"

#include <epoxy/gl.h>
#include <imgui.h>
// The backends are the app's business: ui/ draws without them.
#include <backends/imgui_impl_opengl3.h>

#include "renderer/base/error.h"
#include "renderer/frame/read_images.h"
#include "renderer/gl/target.h"
#include "ui/widgets/theme.h"

namespace si {

ImGuiSession::ImGuiSession(float scale) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    theme::load_fonts(scale);
    theme::apply(scale);
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
    // The backend leaves these as the renderer's last pass set them.
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

ByteImage ImGuiSession::picture(ImDrawList& list, int width, int height) {
    GLuint texture = 0, framebuffer = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_RGBA8, width, height);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    ImDrawList* lists[] = {&list};
    ImDrawData data;
    data.Valid = true;
    data.CmdLists = lists, data.CmdListsCount = 1;
    data.TotalIdxCount = list.IdxBuffer.Size, data.TotalVtxCount = list.VtxBuffer.Size;
    data.DisplaySize = {float(width), float(height)};
    data.FramebufferScale = {1, 1};
    draw_data(&data, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    ByteImage image{width, height, {}};
    image.data.resize(std::size_t(width) * std::size_t(height) * 4);
    gl::begin_reading();
    glGetTextureImage(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(image.data.size()), image.data.data());
    flip_rows(image.data, width, height, 4);
    for (std::size_t i = 3; i < image.data.size(); i += 4) image.data[i] = 255;
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &texture);
    return image;
}

}  // namespace si
