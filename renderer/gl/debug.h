// Debug messages of the OpenGL driver, and named groups for frame debuggers.
#pragma once

#include <epoxy/gl.h>

#include <string>
#include <string_view>
#include <vector>

namespace si::gl {

/// Collector of OpenGL errors and high-severity driver messages of the current context, from construction to
/// destruction.
class MessageLog {
public:
    MessageLog();
    ~MessageLog();
    MessageLog(const MessageLog&) = delete;
    MessageLog& operator=(const MessageLog&) = delete;
    /// Returns the driver messages and glGetError() codes collected since the last call, and clears the log.
    std::vector<std::string> take_messages();

private:
    /// Stores one driver message in a MessageLog. OpenGL calls this function as debug callback
    /// (glDebugMessageCallback).
    /// @param user the MessageLog
    static void GLAPIENTRY on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                      const GLchar* message, const void* user);
    std::vector<std::string> messages_;
    void* outer_function_ = nullptr;  ///< callback of an older log of the same context, restored at the end
    void* outer_user_ = nullptr;
};

/// Scope that groups OpenGL calls under a name in frame debuggers (KHR_debug), from construction to destruction.
struct DebugGroup {
    explicit DebugGroup(std::string_view name) {
        glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, GLsizei(name.size()), name.data());
    }
    ~DebugGroup() { glPopDebugGroup(); }
    DebugGroup(const DebugGroup&) = delete;
    DebugGroup& operator=(const DebugGroup&) = delete;
};

}  // namespace si::gl
