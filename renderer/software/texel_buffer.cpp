#include "renderer/software/texel_buffer.h"

#include <utility>

#include "renderer/gl/driver_failure.h"

namespace si {

TexelBuffer::TexelBuffer(std::string_view label)
    : buffer_(gl::Buffer::create(label)), texels_(gl::Texture::create(label, GL_TEXTURE_BUFFER)), label_(label) {}

void TexelBuffer::upload(std::span<const std::byte> bytes) {
    const auto size = GLsizeiptr(bytes.size());
    // The size is compared first, since querying GL waits for drivers with a thread of their own.
    if (std::exchange(size_, 0) == bytes.size())
        glNamedBufferData(buffer_.id(), size, bytes.data(), GL_STREAM_DRAW);
    else
        gl::fill_buffer(buffer_, label_, size, bytes.data(), GL_STREAM_DRAW);
    size_ = bytes.size();
}

void TexelBuffer::bind_block(GLuint block) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, block, buffer_.id());
}

void TexelBuffer::bind_image(GLuint image, GLenum format) const {
    glTextureBuffer(texels_.id(), format, buffer_.id());
    glBindImageTexture(image, texels_.id(), 0, GL_FALSE, 0, GL_READ_ONLY, format);
}

}  // namespace si
