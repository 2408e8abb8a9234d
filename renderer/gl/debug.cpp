#include "renderer/gl/debug.h"

#include <fmt/format.h>

#include <utility>

namespace si::gl {
namespace {

constexpr int kMostErrors = 100;

}  // namespace

MessageLog::MessageLog() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &outer_function_);
    glGetPointerv(GL_DEBUG_CALLBACK_USER_PARAM, &outer_user_);
    glDebugMessageCallback(&MessageLog::on_message, this);
}

MessageLog::~MessageLog() {
    glDebugMessageCallback(reinterpret_cast<GLDEBUGPROC>(outer_function_), outer_user_);
}

void GLAPIENTRY MessageLog::on_message(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length,
                                       const GLchar* message, const void* user) {
    if (type != GL_DEBUG_TYPE_ERROR && severity != GL_DEBUG_SEVERITY_HIGH) return;
    auto* log = static_cast<MessageLog*>(const_cast<void*>(user));
    if (log->messages_.size() < 100) log->messages_.emplace_back(message, std::size_t(length));
}

std::vector<std::string> MessageLog::take_messages() {
    // A lost context reports an error at every call.
    for (int i = 0; i < kMostErrors; ++i) {
        const GLenum error = glGetError();
        if (error == GL_NO_ERROR) break;
        messages_.push_back(fmt::format("glGetError {:#x}", error));
    }
    return std::exchange(messages_, {});
}

}  // namespace si::gl
