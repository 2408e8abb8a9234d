#include "app/editor/upload_picture.h"

#include <fmt/format.h>

#include "renderer/gl/driver_failure.h"

namespace si {

gl::Texture upload_picture(const ByteImage& image) {
    gl::Texture texture = gl::Texture::create("difference", GL_TEXTURE_2D);
    gl::clear_gl_errors();
    glTextureStorage2D(texture.id(), 1, GL_RGBA8, image.width, image.height);
    gl::check_memory_errors(fmt::format("the picture compared with ({} x {})", image.width, image.height),
                            "make the window smaller, or switch comparing off");
    glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int y = 0; y < image.height; ++y)  // bottom row first, like the renderer's pictures
        glTextureSubImage2D(texture.id(), 0, 0, image.height - 1 - y, image.width, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                            &image.data[std::size_t(y) * std::size_t(image.width) * 4]);
    return texture;
}

}  // namespace si
