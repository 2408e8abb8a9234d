// An OpenGL 4.5 core context without window or display, through EGL.
#pragma once

#include <memory>
#include <string>

#include "app/context/thread_context.h"

namespace si {

/// OpenGL 4.5 core debug context without a window, current on the constructing thread. It needs neither a display
/// server nor GLFW. It takes the first EGL device that works (EGL_EXT_platform_device; hardware first, the software
/// rasteriser last), else a surfaceless display. Several contexts may be made one after another, as each owns its EGL
/// resources.
class HeadlessContext {
public:
    /// Makes the context. @throws Error naming every EGL call that failed and what to try
    HeadlessContext();
    ~HeadlessContext();

    /// Makes this OpenGL context current on the calling thread, so that later OpenGL calls there use it. @throws Error
    /// when EGL refuses
    void make_current();
    /// Returns a text for people about the EGL device or display that the OpenGL context uses, such as "EGL device 0
    /// (/dev/dri/card0), no surface".
    std::string description() const;
    /// Returns a function that makes OpenGL contexts for background threads. The new contexts share textures and
    /// buffers with this context, which must outlive them.
    ThreadContextMaker sharing() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace si
