#include "renderer/gl/pass_clock.h"

#include <algorithm>
#include <thread>
#include <vector>

#include "renderer/base/median.h"
#include "renderer/gl/program_cache.h"
#include "renderer/gl/target.h"

namespace si::gl {
namespace {

using Clock = std::chrono::steady_clock;

double elapsed_ms(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Processor time of each thread, in the order of a list of threads, milliseconds.
std::vector<double> processor_times(const std::vector<ThreadId>& threads) {
    std::vector<double> out;
    for (const ThreadId thread : threads) out.push_back(processor_ms(thread));
    return out;
}

/// Finds the threads that work while this one draws and rest while it waits. Threads that trace or load at the same
/// time work as much during both. Workers that draw for another context meanwhile rest at least half of the time.
class WorkerSearch {
public:
    /// Notes the processor times before a round.
    void begin() { before_ = processor_times(threads_); }
    /// Notes the processor times after a round. @param drawing the round drew; false: it waited @param round_ms its
    /// length, milliseconds
    void end(bool drawing, double round_ms) {
        const std::vector<double> after = processor_times(threads_);
        for (std::size_t i = 0; i < threads_.size(); ++i)
            (drawing ? drawing_ : waiting_)[i].push_back((after[i] - before_[i]) / round_ms);
    }
    /// Returns the threads that do at least 2 % of a drawing round's work, and twice as much as in a waiting round.
    /// @param own processor time of the calling thread over the length of a drawing round
    std::vector<ThreadId> workers(double own) const {
        std::vector<ThreadId> out;
        double all = own;
        for (const std::vector<double>& shares : drawing_) all += median(shares);
        for (std::size_t i = 0; i < threads_.size(); ++i)
            if (const double share = median(drawing_[i]); share > 0.02 * all && share > 2 * median(waiting_[i]))
                out.push_back(threads_[i]);
        return out;
    }

private:
    std::vector<ThreadId> threads_ = other_threads();
    std::vector<double> before_;
    /// Processor time over the length of a round, by thread and round.
    std::vector<std::vector<double>> drawing_{threads_.size()}, waiting_{threads_.size()};
};

}  // namespace

std::string_view name(ClockKind kind) {
    switch (kind) {
        case ClockKind::Queries:
            return "GPU timer queries";
        case ClockKind::Processor:
            return "processor time (CPU rasteriser)";
        case ClockKind::Wall:
            break;
    }
    return "finished wall time";
}

PassClock::PassClock(bool cpu_rasteriser) {
    constexpr int kRounds = 5;
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
    // The first draw compiles, and starts threads that a driver starts late.
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glFinish();
    WorkerSearch search;
    std::vector<double> shares, own;
    for (int i = 0; i < kRounds; ++i) {
        search.begin();
        const double own_before = own_processor_ms();
        const auto start = Clock::now();
        glBeginQuery(GL_TIME_ELAPSED, query.id());
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glEndQuery(GL_TIME_ELAPSED);
        glFinish();
        const double wall = elapsed_ms(start);
        own.push_back((own_processor_ms() - own_before) / wall);
        search.end(true, wall);
        GLuint64 ns = 0;
        glGetQueryObjectui64v(query.id(), GL_QUERY_RESULT, &ns);
        shares.push_back(double(ns) * 1e-6 / std::max(wall, 1e-6));
        if (!cpu_rasteriser) continue;
        // A wait as long as the draw would make the calibration twice as long.
        const double wait = wall / 4;
        search.begin();
        std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(wait));
        search.end(false, wait);
    }
    query_share_ = median(shares);
    const bool honest = query_share_ > 0.5 && query_share_ < 2;
    kind_ = honest ? ClockKind::Queries : ClockKind::Wall;
    if (cpu_rasteriser) {
        workers_ = search.workers(median(own));
        kind_ = ClockKind::Processor;
    }
    glUseProgram(0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

double PassClock::drawing_ms() const {
    double ms = own_processor_ms();
    for (const ThreadId worker : workers_) ms += processor_ms(worker);
    return ms;
}

void PassClock::begin() {
    if (used_ == slots_.size()) slots_.emplace_back();
    Slot& slot = slots_[used_];
    if (kind_ == ClockKind::Queries) {
        if (!slot.start) {
            slot.start = Query::create("pass start", GLenum(GL_TIMESTAMP));
            slot.stop = Query::create("pass stop", GLenum(GL_TIMESTAMP));
        }
        glQueryCounter(slot.start.id(), GL_TIMESTAMP);
    } else {
        glFinish();
        started_processor_ms_ = drawing_ms();
        started_ = Clock::now();
    }
}

std::size_t PassClock::end() {
    Slot& slot = slots_[used_];
    if (kind_ == ClockKind::Queries) {
        glQueryCounter(slot.stop.id(), GL_TIMESTAMP);
    } else {
        glFinish();
        slot.wall_ms = elapsed_ms(started_);
        slot.processor_ms = drawing_ms() - started_processor_ms_;
    }
    return used_++;
}

double PassClock::milliseconds(std::size_t slot) {
    if (kind_ == ClockKind::Wall) return slots_[slot].wall_ms;
    if (kind_ == ClockKind::Processor) return slots_[slot].processor_ms;
    GLuint64 start = 0, stop = 0;
    glGetQueryObjectui64v(slots_[slot].start.id(), GL_QUERY_RESULT, &start);
    glGetQueryObjectui64v(slots_[slot].stop.id(), GL_QUERY_RESULT, &stop);
    return double(stop - start) * 1e-6;
}

}  // namespace si::gl
