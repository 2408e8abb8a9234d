// An OpenGL 4.5 core context without window or display, through EGL.
#pragma once

#include <memory>
#include <string>

#include "app/context/thread_context.h"

namespace si {

/// OpenGL 4.5 core debug context without a window, current on the constructing thread. Takes the first EGL device
/// (EGL_EXT_platform_device; hardware first, the software rasteriser last) that works, else a surfaceless display.
/// Contexts may follow one another; each owns its EGL resources. Needs neither a display server nor GLFW.
class HeadlessContext {
public:
    /// Makes the context. @throws Error naming every EGL call that failed and what to try
    HeadlessContext();
    ~HeadlessContext();

    /// Makes this OpenGL context current on the calling thread, for all further OpenGL calls there. @throws Error when
    /// EGL refuses
    void make_current();
    /// Returns a text about the EGL device or display in use: "EGL device 0 (/dev/dri/card0), no surface".
    std::string description() const;
    /// Returns a function that makes OpenGL contexts for other threads. They share objects with this context, which
    /// must outlive them.
    ThreadContextMaker sharing() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace si
