// An OpenGL 4.5 core context without window or display, through EGL.
#pragma once

#include <memory>
#include <string>

#include "app/context/thread_context.h"

namespace si {

/// Looks for a device with EGL_EXT_platform_device (hardware first, the software rasteriser last), then for a
/// surfaceless display. The context is a debug context and is current on the constructing thread. Contexts may follow
/// one another; each owns its own EGL resources. Neither a display server nor GLFW is involved.
class HeadlessContext {
public:
    /// @throws Error naming every call that failed on the way and what to try.
    HeadlessContext();
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    /// Makes the context current on this thread. @throws Error when EGL refuses.
    void make_current();
    /// How the context was found, e.g. "EGL device 0 (/dev/dri/card0), no surface".
    std::string description() const;
    /// Makes contexts beside this one, which must live longer.
    ThreadContextMaker sharing() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace si
