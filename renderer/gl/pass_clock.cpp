#include "renderer/gl/pass_clock.h"

#include <algorithm>

#include "renderer/gl/program_cache.h"
#include "renderer/gl/target.h"

namespace si::gl {
namespace {

using Clock = std::chrono::steady_clock;

double elapsed_ms(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

PassClock::PassClock() {
    Target target;
    target.ensure("clock calibration", GL_RGBA8, 512, 512);
    auto framebuffer = make_framebuffer("clock calibration", &target, nullptr);
    auto vao = VertexArray::create("clock calibration");
    ProgramCache programs;
    const GLuint program =
        programs.get({.vertex = "passes/fullscreen.vert.glsl", .fragment = "passes/clock_load.frag.glsl"});
    auto query = Query::create("clock calibration", GLenum(GL_TIME_ELAPSED));
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    glViewport(0, 0, 512, 512);
    glDisable(GL_DEPTH_TEST);
    glUseProgram(program);
    glBindVertexArray(vao.id());
    std::array<double, 5> shares{};
    for (int i = -1; i < int(shares.size()); ++i) {  // the first round compiles and is discarded
        glFinish();
        const auto start = Clock::now();
        glBeginQuery(GL_TIME_ELAPSED, query.id());
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glEndQuery(GL_TIME_ELAPSED);
        glFinish();
        const double wall = elapsed_ms(start);
        GLuint64 ns = 0;
        glGetQueryObjectui64v(query.id(), GL_QUERY_RESULT, &ns);
        if (i >= 0) shares[std::size_t(i)] = double(ns) * 1e-6 / std::max(wall, 1e-6);
    }
    std::sort(shares.begin(), shares.end());
    query_share_ = shares[2];
    uses_queries_ = query_share_ > 0.5 && query_share_ < 2;
    glUseProgram(0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

std::string PassClock::name() const {
    return uses_queries_ ? "GPU timer queries" : "finished wall time (CPU rasteriser)";
}

void PassClock::begin() {
    if (used_ == slots_.size()) slots_.emplace_back();
    Slot& slot = slots_[used_];
    if (uses_queries_) {
        if (!slot.start) {
            slot.start = Query::create("pass start", GLenum(GL_TIMESTAMP));
            slot.stop = Query::create("pass stop", GLenum(GL_TIMESTAMP));
        }
        glQueryCounter(slot.start.id(), GL_TIMESTAMP);
    } else {
        glFinish();
        started_ = Clock::now();
    }
}

std::size_t PassClock::end() {
    Slot& slot = slots_[used_];
    if (uses_queries_) {
        glQueryCounter(slot.stop.id(), GL_TIMESTAMP);
    } else {
        glFinish();
        slot.wall_ms = elapsed_ms(started_);
    }
    return used_++;
}

double PassClock::milliseconds(std::size_t slot) {
    if (!uses_queries_) return slots_[slot].wall_ms;
    GLuint64 start = 0, stop = 0;
    glGetQueryObjectui64v(slots_[slot].start.id(), GL_QUERY_RESULT, &start);
    glGetQueryObjectui64v(slots_[slot].stop.id(), GL_QUERY_RESULT, &stop);
    return double(stop - start) * 1e-6;
}

}  // namespace si::gl
