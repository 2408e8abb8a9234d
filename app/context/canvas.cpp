#include "app/context/canvas.h"

#include "renderer/frame/read_images.h"
#include "renderer/gl/target.h"

namespace si {

Canvas::Canvas(int width, int height) : width_(width), height_(height) {
    glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
    glTextureStorage2D(texture_, 1, GL_RGBA8, width, height);
    glCreateFramebuffers(1, &framebuffer_);
    glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture_, 0);
    glObjectLabel(GL_FRAMEBUFFER, framebuffer_, -1, "editor");
}

Canvas::~Canvas() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(1, &texture_);
}

void Canvas::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
}

ByteImage Canvas::read_picture() const {
    ByteImage image{width_, height_, {}};
    image.data.resize(std::size_t(width_) * std::size_t(height_) * 4);
    gl::prepare_read_back();
    glGetTextureImage(texture_, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(image.data.size()), image.data.data());
    flip_rows(image.data, width_, height_, 4);
    for (std::size_t i = 3; i < image.data.size(); i += 4) image.data[i] = 255;
    return image;
}

}  // namespace si
