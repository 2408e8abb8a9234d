// Debug messages of the OpenGL driver, and named groups for frame debuggers.
#pragma once

#include <epoxy/gl.h>

#include <string>
#include <string_view>
#include <vector>

namespace si::gl {

/// Collector of OpenGL errors and high-severity driver messages of the current context, for its own lifetime.
class MessageLog {
public:
    MessageLog();
    ~MessageLog();
    MessageLog(const MessageLog&) = delete;
    MessageLog& operator=(const MessageLog&) = delete;
    /// Returns and forgets the driver messages and glGetError() codes collected since the last call.
    std::vector<std::string> take_messages();

private:
    /// Receives one driver message (glDebugMessageCallback); `user` is the MessageLog.
    static void GLAPIENTRY on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                      const GLchar* message, const void* user);
    std::vector<std::string> messages_;
    void* outer_function_ = nullptr;  ///< callback of an older log of the same context, restored at the end
    void* outer_user_ = nullptr;
};

/// Named KHR_debug group that lasts as long as this object; frame debuggers show its GL calls under the name.
struct DebugGroup {
    explicit DebugGroup(std::string_view name) {
        glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, GLsizei(name.size()), name.data());
    }
    ~DebugGroup() { glPopDebugGroup(); }
    DebugGroup(const DebugGroup&) = delete;
    DebugGroup& operator=(const DebugGroup&) = delete;
};

}  // namespace si::gl
