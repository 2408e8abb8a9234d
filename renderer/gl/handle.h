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
        return adopt(label, Traits::create(args...));
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
    /// Returns the OpenGL name of the owned object; 0: none.
    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }
    /// Deletes the OpenGL object now.
    void reset() {
        if (id_) Traits::destroy(std::exchange(id_, 0));
        held_.drop();
    }
    /// Counts `bytes` of driver memory for this object in the memory report. @param holder name in the report, see
    /// TrackedMemory
    void track_memory(std::string_view holder, std::uint64_t bytes) { held_ = TrackedMemory(holder, bytes); }

private:
    GLuint id_ = 0;
    TrackedMemory held_;
};

/// Creation and deletion of OpenGL objects by the functions that take a count and names, for Handle. `Identifier` is
/// the object's kind for labels. Arguments of create() precede the count, as in glCreateTextures.
template <GLenum Identifier, auto& Create, auto& Delete>
struct ObjectTraits {
    static constexpr GLenum kIdentifier = Identifier;
    template <typename... Args>
    static GLuint create(Args... args) {
        GLuint id = 0;
        Create(args..., 1, &id);
        return id;
    }
    static void destroy(GLuint id) { Delete(1, &id); }
};
/// Creation and deletion of OpenGL programs, as Handle (the owner of an OpenGL object) needs them.
struct ProgramTraits {
    static constexpr GLenum kIdentifier = GL_PROGRAM;
    static GLuint create() { return glCreateProgram(); }
    static void destroy(GLuint id) { glDeleteProgram(id); }
};

using Buffer = Handle<ObjectTraits<GL_BUFFER, glCreateBuffers, glDeleteBuffers>>;
using Texture = Handle<ObjectTraits<GL_TEXTURE, glCreateTextures, glDeleteTextures>>;
using Framebuffer = Handle<ObjectTraits<GL_FRAMEBUFFER, glCreateFramebuffers, glDeleteFramebuffers>>;
using VertexArray = Handle<ObjectTraits<GL_VERTEX_ARRAY, glCreateVertexArrays, glDeleteVertexArrays>>;
using Sampler = Handle<ObjectTraits<GL_SAMPLER, glCreateSamplers, glDeleteSamplers>>;
using Program = Handle<ProgramTraits>;
using Query = Handle<ObjectTraits<GL_QUERY, glCreateQueries, glDeleteQueries>>;

/// Enables a float attribute of a vertex array. @param size number of components @param offset bytes within a vertex
/// @param type GL_FLOAT; GL_UNSIGNED_BYTE: bytes, normalised to [0, 1]
inline void enable_attribute(const VertexArray& vao, GLuint location, GLuint binding, GLint size, GLuint offset = 0,
                             GLenum type = GL_FLOAT) {
    glEnableVertexArrayAttrib(vao.id(), location);
    glVertexArrayAttribFormat(vao.id(), location, size, type, type != GL_FLOAT, offset);
    glVertexArrayAttribBinding(vao.id(), location, binding);
}

}  // namespace si::gl
