#include "renderer/gl/driver_failure.h"

#include <fmt/format.h>

namespace si::gl {
namespace {

constexpr int kMostForgotten = 64;  ///< limit, as a lost context reports an error at every call

[[noreturn]] void throw_lost(std::string_view why) {
    throw ContextLost(
        fmt::format("the graphics driver reset, and what was drawn is lost ({}); save the settings and start the "
                    "program again; where it happens again, take a smaller map.resolution or picture",
                    why));
}

void require_buffer(Buffer& buffer, std::string_view label, GLsizeiptr size) {
    check_memory_errors(fmt::format("the {} ({} bytes)", label, size),
                        "use a scene of fewer triangles or fewer lights, or close what else draws");
    buffer.track_memory(label, std::uint64_t(size));
}

}  // namespace

FaultInjection& fault_injection() {
    static FaultInjection seam;
    return seam;
}

bool is_injected_failure(DriverFailure kind, std::string_view what) {
    const auto& fails = fault_injection().fails;
    return fails && fails(kind, what);
}

void clear_gl_errors() {
    for (int i = 0; i < kMostForgotten && glGetError() != GL_NO_ERROR; ++i) {
    }
}

void check_memory_errors(std::string_view what, std::string_view fix) {
    const GLenum error = is_injected_failure(DriverFailure::Memory, what) ? GLenum(GL_OUT_OF_MEMORY) : glGetError();
    if (error == GL_NO_ERROR) return;
    if (error == GL_CONTEXT_LOST) throw_lost("while it made room for " + std::string(what));
    throw OutOfMemory(fmt::format("the driver has no memory for {}; {}", what, fix));
}

void store_buffer(Buffer& buffer, std::string_view label, GLsizeiptr size, const void* bytes, GLbitfield flags) {
    clear_gl_errors();
    glNamedBufferStorage(buffer.id(), size, bytes, flags);
    require_buffer(buffer, label, size);
}

void fill_buffer(Buffer& buffer, std::string_view label, GLsizeiptr size, const void* bytes, GLenum usage) {
    clear_gl_errors();
    glNamedBufferData(buffer.id(), size, bytes, usage);
    require_buffer(buffer, label, size);
}

void check_context_alive() {
    GLenum status =
        is_injected_failure(DriverFailure::Context, "frame") ? GLenum(GL_UNKNOWN_CONTEXT_RESET) : GLenum(GL_NO_ERROR);
    if (status == GL_NO_ERROR && epoxy_gl_version() >= 45) status = glGetGraphicsResetStatus();
    if (status == GL_NO_ERROR) return;
    throw_lost(status == GL_GUILTY_CONTEXT_RESET     ? "what this program drew took too long or failed"
               : status == GL_INNOCENT_CONTEXT_RESET ? "another program made it fail"
                                                     : "for a reason that the driver does not tell");
}

}  // namespace si::gl
