// A second OpenGL context beside one that is in use, for a thread of its own.
#pragma once

#include <functional>
#include <memory>

namespace si {

/// Current on the thread that made it until it is destroyed there. Textures and buffers are shared with the context
/// that it was made beside; framebuffers and programs' compiled variants are not.
struct ThreadContext {
    virtual ~ThreadContext() = default;
};

/// Called on the thread that is to have it. @throws Error when the driver refuses. Empty: there is none to be had.
using ThreadContextMaker = std::function<std::unique_ptr<ThreadContext>()>;

}  // namespace si
