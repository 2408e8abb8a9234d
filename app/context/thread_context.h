// Second OpenGL context for a background thread.
#pragma once

#include <functional>
#include <memory>

namespace si {

/// OpenGL context of a background thread. It is current on the thread that made it, until that thread destroys it. It
/// shares textures and buffers with the context from which it was made, but not framebuffers and compiled program
/// variants.
struct ThreadContext {
    virtual ~ThreadContext() = default;
};

/// Function that makes a ThreadContext; called on the thread that will use the context. Empty if the driver offers no
/// second context.
/// @throws Error when the driver refuses
using ThreadContextMaker = std::function<std::unique_ptr<ThreadContext>()>;

}  // namespace si
