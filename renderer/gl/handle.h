// Move-only owners of OpenGL objects, each with a label for frame debuggers.
#pragma once

#include <epoxy/gl.h>

#include <string_view>
#include <utility>

#include "renderer/base/held_memory.h"

namespace si::gl {

/// Move-only owner of one OpenGL object. `Traits` creates and deletes the object and gives its identifier for labels.
template <typename Traits>
class Handle {
public:
    Handle() = default;
    template <typename... Args>
    /// Creates the object; `label` is its name in frame debuggers.
    static Handle create(std::string_view label, Args... args) {
        Handle h;
        h.id_ = Traits::create(args...);
        glObjectLabel(Traits::kIdentifier, h.id_, GLsizei(label.size()), label.data());
        return h;
    }
    /// Takes ownership of an OpenGL object created elsewhere.
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
    /// Returns the OpenGL name; 0: none.
    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }
    /// Deletes the OpenGL object now.
    void reset() {
        if (id_) Traits::destroy(std::exchange(id_, 0));
        held_.drop();
    }
    /// Counts `bytes` of driver memory for this object in the memory report. @param holder see TrackedMemory
    void track_memory(std::string_view holder, std::uint64_t bytes) { held_ = TrackedMemory(holder, bytes); }

private:
    GLuint id_ = 0;
    TrackedMemory held_;
};

/// Creation and deletion of OpenGL buffers, for Handle.
struct BufferTraits {
    static constexpr GLenum kIdentifier = GL_BUFFER;
    static GLuint create() {
        GLuint id = 0;
        glCreateBuffers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
};
/// Creation and deletion of OpenGL textures, for Handle.
struct TextureTraits {
    static constexpr GLenum kIdentifier = GL_TEXTURE;
    static GLuint create(GLenum target) {
        GLuint id = 0;
        glCreateTextures(target, 1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};
/// Creation and deletion of OpenGL framebuffers, for Handle.
struct FramebufferTraits {
    static constexpr GLenum kIdentifier = GL_FRAMEBUFFER;
    static GLuint create() {
        GLuint id = 0;
        glCreateFramebuffers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
};
/// Creation and deletion of OpenGL vertex arrays, for Handle.
struct VertexArrayTraits {
    static constexpr GLenum kIdentifier = GL_VERTEX_ARRAY;
    static GLuint create() {
        GLuint id = 0;
        glCreateVertexArrays(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }
};
/// Creation and deletion of OpenGL samplers, for Handle.
struct SamplerTraits {
    static constexpr GLenum kIdentifier = GL_SAMPLER;
    static GLuint create() {
        GLuint id = 0;
        glCreateSamplers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteSamplers(1, &id); }
};
/// Creation and deletion of OpenGL programs, for Handle.
struct ProgramTraits {
    static constexpr GLenum kIdentifier = GL_PROGRAM;
    static GLuint create() { return glCreateProgram(); }
    static void destroy(GLuint id) { glDeleteProgram(id); }
};
/// Creation and deletion of OpenGL queries, for Handle.
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
