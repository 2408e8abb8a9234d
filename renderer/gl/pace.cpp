#include "renderer/gl/pace.h"

#include <epoxy/gl.h>

namespace si::gl {

void keep_few_under_way() {
    constexpr int kMost = 8;
    thread_local int under_way = 0;  // a context is current in one thread
    if (++under_way < kMost) return;
    under_way = 0;
    glFinish();
}

}  // namespace si::gl
