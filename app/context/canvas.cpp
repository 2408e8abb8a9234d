#include "app/context/canvas.h"

#include "renderer/frame/read_images.h"
#include "renderer/gl/target.h"

namespace si {

Canvas::Canvas(int width, int height) : width_(width), height_(height) {
    glTextureStorage2D(texture_.id(), 1, GL_RGBA8, width, height);
    glNamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT0, texture_.id(), 0);
}

ByteImage Canvas::read_picture() const {
    const std::size_t bytes = std::size_t(width_) * std::size_t(height_) * 4;
    ByteImage image{width_, height_, gl::read_texture<std::uint8_t>(texture_.id(), bytes, GL_RGBA, GL_UNSIGNED_BYTE)};
    flip_rows(image.data, width_, height_, 4);
    for (std::size_t i = 3; i < image.data.size(); i += 4) image.data[i] = 255;
    return image;
}

}  // namespace si
