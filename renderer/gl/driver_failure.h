// Errors of OpenGL drivers as exceptions, and the injection of such errors for tests.
#pragma once

#include <epoxy/gl.h>

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/error.h"
#include "renderer/gl/handle.h"

namespace si::gl {

/// Exception: the driver has no memory for an image or a buffer. The same call with a smaller size may succeed.
struct OutOfMemory : Error {
    using Error::Error;
};

/// Exception: the driver lost the OpenGL context and all its objects. Drawing needs a new context.
struct ContextLost : Error {
    using Error::Error;
};

/// Kinds of driver failures that tests can inject.
enum class DriverFailure { Memory, Shader, Context };

/// Driver failures that a test injects into all OpenGL contexts of the process. By default none.
struct FaultInjection {
    /// Callback for each OpenGL call that may fail with this kind of failure; returning true makes the call fail.
    std::function<bool(DriverFailure, std::string_view what)> fails;
    /// Callback for each image before it is searched for NaN and infinity, so that a test can write such values.
    std::function<void(std::string_view label, GLuint texture)> corrupt_image;
    /// Limit of programs that stay cached after a frame; 0: ProgramCache::kMaxPrograms.
    std::size_t max_programs = 0;
};
/// Returns the driver failures that are injected in the whole process; tests assign the members.
FaultInjection& fault_injection();
/// Returns true when a test wants the current OpenGL call to fail. Code that calls the driver then acts as if the
/// driver had failed.
/// @param kind kind of failure that the call may have
/// @param what object that the call is about, such as a texture's name
bool is_injected_failure(DriverFailure kind, std::string_view what);

/// Allocates a buffer and copies `size` bytes into it (glNamedBufferData).
/// @param label name of the buffer in error messages and the memory report
/// @param bytes the bytes to store; null: contents stay undefined
/// @param usage as for glNamedBufferData()
/// @throws OutOfMemory, ContextLost
void fill_buffer(Buffer& buffer, std::string_view label, GLsizeiptr size, const void* bytes, GLenum usage);
/// Replaces a buffer's contents by an array. For an empty array, allocates one undefined element, as OpenGL has no
/// empty buffers. @throws OutOfMemory, ContextLost
template <typename T>
void fill_buffer(Buffer& buffer, std::string_view label, const std::vector<T>& data, GLenum usage) {
    fill_buffer(buffer, label, GLsizeiptr(std::max<std::size_t>(data.size(), 1) * sizeof(T)),
                data.empty() ? nullptr : data.data(), usage);
}
/// Creates a buffer with the contents of an array, which seldom change. @throws OutOfMemory
template <typename T>
Buffer make_buffer(std::string_view label, const std::vector<T>& data) {
    Buffer buffer = Buffer::create(label);
    fill_buffer(buffer, label, data, GL_STATIC_DRAW);
    return buffer;
}
/// Allocates immutable storage for a buffer and copies `size` bytes into it (glNamedBufferStorage).
/// @param label name of the buffer in error messages and the memory report
/// @param bytes the bytes to store; null: contents stay undefined
/// @param flags as for glNamedBufferStorage()
/// @throws OutOfMemory, ContextLost
void store_buffer(Buffer& buffer, std::string_view label, GLsizeiptr size, const void* bytes, GLbitfield flags);
/// Discards pending OpenGL errors, so that check_memory_errors() reports only errors of later calls.
void clear_gl_errors();
/// Throws when an OpenGL call since clear_gl_errors() ran out of memory or lost the context.
/// @param what allocated object, for the message: "the shadow maps (1024 x 1024 x 4)"
/// @param fix clause with advice for the user
/// @throws OutOfMemory, ContextLost
void check_memory_errors(std::string_view what, std::string_view fix);
/// Throws when a reset of the graphics driver has destroyed the current OpenGL context. @throws ContextLost
void check_context_alive();

}  // namespace si::gl
