// Trouble that drivers make, by a seam: where tests have the n-th call fail, and what is then thrown.
#pragma once

#include <epoxy/gl.h>

#include <functional>
#include <string>
#include <string_view>

#include "renderer/base/error.h"
#include "renderer/gl/handle.h"

namespace si::gl {

/// The driver has no memory for an image or a buffer. Something smaller may do.
class OutOfMemory : public Error {
public:
    using Error::Error;
};

/// The context is gone, with all that was in it: only a new one draws again.
class ContextLost : public Error {
public:
    using Error::Error;
};

enum class Trouble { Memory, Shader, Context };

/// What tests have OpenGL do wrong, in all contexts of the process. Nothing by default.
struct TroubleSeam {
    /// Asked at each call that may fail of this kind; true: it fails.
    std::function<bool(Trouble, std::string_view what)> fails;
    /// Handed each image before its numbers are searched.
    std::function<void(std::string_view label, GLuint texture)> spoils;
    /// Kept from frame to frame; 0: as many as ever.
    std::size_t most_programs = 0;
};
TroubleSeam& trouble_seam();
/// Whether the seam has this call fail.
bool made_to_fail(Trouble kind, std::string_view what);

/// Gives a buffer contents, and room for them. @param bytes null: undefined ones @throws OutOfMemory, ContextLost
void fill_buffer(Buffer& buffer, std::string_view label, GLsizeiptr size, const void* bytes, GLenum usage);
/// The same for good, by glNamedBufferStorage's flags.
void store_buffer(Buffer& buffer, std::string_view label, GLsizeiptr size, const void* bytes, GLbitfield flags);
/// Forgets errors of calls before, so that those of the next are its own.
void forget_errors();
/// Of the calls since forget_errors(). @param what "the shadow maps (1024 x 1024 x 4)" @param remedy a clause
/// @throws OutOfMemory, ContextLost
void require_memory(std::string_view what, std::string_view fix);
/// Whether the context still draws. @throws ContextLost
void require_context();

}  // namespace si::gl
