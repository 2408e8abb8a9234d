#include "renderer/gl/trouble.h"

#include <fmt/format.h>

namespace si::gl {
namespace {

constexpr int kMostForgotten = 64;  ///< a lost context reports one at every call

[[noreturn]] void throw_lost(std::string_view why) {
    throw ContextLost(
        fmt::format("the graphics driver reset, and what was drawn is lost ({}); save the settings and start the "
                    "program again; where it happens again, take a smaller map.resolution or picture",
                    why));
}

}  // namespace

TroubleSeam& trouble_seam() {
    static TroubleSeam seam;
    return seam;
}

bool made_to_fail(Trouble kind, std::string_view what) {
    const auto& fails = trouble_seam().fails;
    return fails && fails(kind, what);
}

void forget_errors() {
    for (int i = 0; i < kMostForgotten && glGetError() != GL_NO_ERROR; ++i) {
    }
}

void require_memory(std::string_view what, std::string_view fix) {
    const GLenum error = made_to_fail(Trouble::Memory, what) ? GLenum(GL_OUT_OF_MEMORY) : glGetError();
    if (error == GL_NO_ERROR) return;
    if (error == GL_CONTEXT_LOST) throw_lost("while it made room for " + std::string(what));
    throw OutOfMemory(fmt::format("the driver has no memory for {}; {}", what, fix));
}

namespace {

void require_buffer(Buffer& buffer, std::string_view label, GLsizeiptr size) {
    require_memory(fmt::format("the {} ({} bytes)", label, size),
                   "use a scene of fewer triangles or fewer lights, or close what else draws");
    buffer.holds(label, std::uint64_t(size));
}

}  // namespace

void store_buffer(Buffer& buffer, std::string_view label, GLsizeiptr size, const void* bytes, GLbitfield flags) {
    forget_errors();
    glNamedBufferStorage(buffer.id(), size, bytes, flags);
    require_buffer(buffer, label, size);
}

void fill_buffer(Buffer& buffer, std::string_view label, GLsizeiptr size, const void* bytes, GLenum usage) {
    forget_errors();
    glNamedBufferData(buffer.id(), size, bytes, usage);
    require_buffer(buffer, label, size);
}

void require_context() {
    GLenum status = made_to_fail(Trouble::Context, "frame") ? GLenum(GL_UNKNOWN_CONTEXT_RESET) : GLenum(GL_NO_ERROR);
    if (status == GL_NO_ERROR && epoxy_gl_version() >= 45) status = glGetGraphicsResetStatus();
    switch (status) {
        case GL_NO_ERROR:
            return;
        case GL_GUILTY_CONTEXT_RESET:
            throw_lost("what this program drew took too long or failed");
        case GL_INNOCENT_CONTEXT_RESET:
            throw_lost("another program made it fail");
        default:
            throw_lost("for a reason that the driver does not tell");
    }
}

}  // namespace si::gl
