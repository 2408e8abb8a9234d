// OpenGL names as move-only values, each with a label for frame debuggers.
#pragma once

#include <epoxy/gl.h>

#include <string_view>
#include <utility>

#include "renderer/base/held_memory.h"

namespace si::gl {

/// Owns one GL name; Traits says how to make, label and delete it.
template <typename Traits>
class Handle {
public:
    Handle() = default;
    template <typename... Args>
    static Handle create(std::string_view label, Args... args) {
        Handle h;
        h.id_ = Traits::create(args...);
        glObjectLabel(Traits::kIdentifier, h.id_, GLsizei(label.size()), label.data());
        return h;
    }
    /// Takes over a name made elsewhere.
    static Handle adopt(std::string_view label, GLuint id) {
        Handle h;
        h.id_ = id;
        glObjectLabel(Traits::kIdentifier, id, GLsizei(label.size()), label.data());
        return h;
    }
    ~Handle() { reset(); }
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)), held_(std::move(other.held_)) {}
    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            reset();
            id_ = std::exchange(other.id_, 0);
            held_ = std::move(other.held_);
        }
        return *this;
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }
    void reset() {
        if (id_) Traits::destroy(std::exchange(id_, 0));
        held_.drop();
    }
    /// So many bytes are behind the name. @param holder see HeldMemory
    void holds(std::string_view holder, std::uint64_t bytes) { held_ = HeldMemory(holder, bytes); }

private:
    GLuint id_ = 0;
    HeldMemory held_;
};

struct BufferTraits {
    static constexpr GLenum kIdentifier = GL_BUFFER;
    static GLuint create() {
        GLuint id = 0;
        glCreateBuffers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
};
struct TextureTraits {
    static constexpr GLenum kIdentifier = GL_TEXTURE;
    static GLuint create(GLenum target) {
        GLuint id = 0;
        glCreateTextures(target, 1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};
struct FramebufferTraits {
    static constexpr GLenum kIdentifier = GL_FRAMEBUFFER;
    static GLuint create() {
        GLuint id = 0;
        glCreateFramebuffers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
};
struct VertexArrayTraits {
    static constexpr GLenum kIdentifier = GL_VERTEX_ARRAY;
    static GLuint create() {
        GLuint id = 0;
        glCreateVertexArrays(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }
};
struct SamplerTraits {
    static constexpr GLenum kIdentifier = GL_SAMPLER;
    static GLuint create() {
        GLuint id = 0;
        glCreateSamplers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteSamplers(1, &id); }
};
struct ProgramTraits {
    static constexpr GLenum kIdentifier = GL_PROGRAM;
    static GLuint create() { return glCreateProgram(); }
    static void destroy(GLuint id) { glDeleteProgram(id); }
};
struct QueryTraits {
    static constexpr GLenum kIdentifier = GL_QUERY;
    static GLuint create(GLenum target) {
        GLuint id = 0;
        glCreateQueries(target, 1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteQueries(1, &id); }
};

using Buffer = Handle<BufferTraits>;
using Texture = Handle<TextureTraits>;
using Framebuffer = Handle<FramebufferTraits>;
using VertexArray = Handle<VertexArrayTraits>;
using Sampler = Handle<SamplerTraits>;
using Program = Handle<ProgramTraits>;
using Query = Handle<QueryTraits>;

}  // namespace si::gl
