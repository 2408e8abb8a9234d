// The panel Log.
#pragma once

#include <string_view>

namespace si {

class Log;

/// Draws the panel Log: messages, newest last, and the shader compiler's output, if any. Marks all messages as seen.
void draw_log(Log& log, std::string_view shader_log);

}  // namespace si
