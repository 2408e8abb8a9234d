#include "renderer/software/llvmpipe_queue.h"

#include <epoxy/gl.h>

#include "renderer/gl/target.h"

namespace si::gl {

namespace {

/// Throttling state of the calling thread, in which one context is current.
struct DrawThrottle {
    bool lets_others = false;
    GLsync before = nullptr;  ///< signalled when the previous picture is done
};
thread_local DrawThrottle turns;

}  // namespace

void set_background_drawing(bool on) {
    turns.lets_others = on;
    if (turns.before) glDeleteSync(turns.before);
    turns.before = nullptr;
}

void throttle_background_drawing() {
    if (!turns.lets_others) return;
    const GLsync done = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush();
    if (turns.before) {
        glClientWaitSync(turns.before, 0, GL_TIMEOUT_IGNORED);
        glDeleteSync(turns.before);
    }
    turns.before = done;
}

void limit_pending_draws() {
    constexpr int kMost = 8;
    throttle_background_drawing();
    thread_local int under_way = 0;  // a context is current on one thread
    if (++under_way < kMost) return;
    under_way = 0;
    glFinish();
}

bool release_finished_images() {
    constexpr int kPlaces = 56;  // with the slow one below 64 slots, after which llvmpipe reuses none
    constexpr float kBlack[4] = {};
    Target tiny;
    tiny.ensure("tiny picture", GL_R8, 1, 1);
    const Framebuffer into_tiny = make_framebuffer("tiny picture", &tiny, nullptr);
    // A picture takes a new slot while all earlier ones are pending, and the queue is drawn in order: pictures queued
    // behind a slow one reach every slot.
    for (int size = 2048; size <= 8192; size *= 2) {
        Target large;
        large.ensure("picture that takes long", GL_R8, size, size);
        const Framebuffer into_large = make_framebuffer("picture that takes long", &large, nullptr);
        glFinish();
        glBlitNamedFramebuffer(into_tiny.id(), into_large.id(), 0, 0, 1, 1, 0, 0, size, size, GL_COLOR_BUFFER_BIT,
                               GL_LINEAR);
        const GLsync large_done = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
        for (int i = 0; i < kPlaces; ++i) {
            glClearNamedFramebufferfv(into_tiny.id(), GL_COLOR, 0, kBlack);
            glFlush();
        }
        const bool each_waited = glClientWaitSync(large_done, 0, 0) == GL_TIMEOUT_EXPIRED;
        glDeleteSync(large_done);
        glFinish();
        if (each_waited) return true;
    }
    return false;
}

}  // namespace si::gl
