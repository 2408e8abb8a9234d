// What the driver says, and named groups for frame debuggers.
#pragma once

#include <epoxy/gl.h>

#include <string>
#include <string_view>
#include <vector>

namespace si::gl {

/// Collects errors and high-severity messages of the current context while it lives.
class MessageLog {
public:
    MessageLog();
    ~MessageLog();
    MessageLog(const MessageLog&) = delete;
    MessageLog& operator=(const MessageLog&) = delete;
    /// Messages since the last call, glGetError included.
    std::vector<std::string> take();

private:
    static void GLAPIENTRY on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                      const GLchar* message, const void* user);
    std::vector<std::string> messages_;
    void* outer_function_ = nullptr;  ///< of a log that lives longer, on the same context
    void* outer_user_ = nullptr;
};

/// A KHR_debug group for the lifetime of the value.
struct DebugGroup {
    explicit DebugGroup(std::string_view name) {
        glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, GLsizei(name.size()), name.data());
    }
    ~DebugGroup() { glPopDebugGroup(); }
    DebugGroup(const DebugGroup&) = delete;
    DebugGroup& operator=(const DebugGroup&) = delete;
};

}  // namespace si::gl
