// Tests measured properties of the driver: the effect of glPolygonOffset and the choice of a reliable clock.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <set>
#include <thread>

#include "renderer/gl/pass_clock.h"
#include "renderer/render/polygon_offset.h"
#include "renderer/settings/map_storage.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/traits.h"

namespace si {
namespace {

/// Replaces a function behind an OpenGL name (epoxy's pointer) during its lifetime.
template <typename Function>
class Instead {
public:
    Instead(Function& name, Function other) : name_(name), real_(name) { name = other; }
    ~Instead() { name_ = real_; }
    Instead(const Instead&) = delete;
    Instead& operator=(const Instead&) = delete;

private:
    Function& name_;
    Function real_;
};

class DriverTest : public FrameTest {
protected:
    const Scene scene = load_scene("boxes");
    FrameResult draw(const Settings& s, bool timing = false) {
        FrameRequest request = small_request();
        request.force = true;
        request.timing = timing;
        return renderer.render(scene, s, request);
    }
};

TEST_F(DriverTest, IsTheDriverThatTheRunNames) {
    const DriverInfo& d = renderer.driver();
    EXPECT_NE(d.renderer.find(test::requested_driver()), std::string::npos) << d.renderer;
    RecordProperty("driver", d.renderer + ", " + d.version);
    std::printf("drawn by %s, %s\n", d.renderer.c_str(), d.version.c_str());
}

int offsets_set = 0;
decltype(epoxy_glPolygonOffset) real_offset = nullptr;

TEST_F(DriverTest, PolygonOffsetsAreMeasuredOnceAndOnlyWhereTheyAct) {
    Settings s = settings_for(scene);
    glPolygonOffset(0, 0);  // epoxy looks a function up when it is first called
    real_offset = epoxy_glPolygonOffset;
    const Instead counted(
        epoxy_glPolygonOffset, +[](GLfloat factor, GLfloat units) {
            ++offsets_set;
            real_offset(factor, units);
        });
    const auto set_by = [&](auto&& action) {
        offsets_set = 0;
        action();
        return offsets_set;
    };
    EXPECT_EQ(set_by([&] { draw(s); }), 0) << "nothing asks for an offset";
    s.bias.raster_units = 1;
    EXPECT_GT(set_by([&] { draw(s); }), 1) << "the first frame with an offset measures its effect";
    EXPECT_EQ(set_by([&] { draw(s); }), 1) << "and the next only draws its map";
    set_setting(s, "map.format", s.map.format == MapFormat::D16 ? "d24" : "d16");
    EXPECT_GT(set_by([&] { draw(s); }), 1) << "another format is another measure";
    renderer.driver();
    EXPECT_EQ(set_by([&] { renderer.driver(); }), 0);
    for (const PolygonOffset& offset : renderer.driver().offset) EXPECT_TRUE(offset.measured);
}

// OpenGL 4.5, 14.6.5: m lies between the larger component and the length; r is at least the smallest resolvable step.
TEST_F(DriverTest, PolygonOffsetsLieWithinTheBoundsOfOpenGL) {
    for (std::size_t i = 0; i < kMapFormats; ++i) {
        const PolygonOffset& offset = renderer.driver().offset[i];
        SCOPED_TRACE(i);
        if (holds_distances(MapFormat(i))) {
            EXPECT_EQ(offset.unit(0x1p-24), 0) << "what a shader writes is not offset";
            EXPECT_EQ(offset.slope({3, -4}), 0);
            continue;
        }
        EXPECT_NE(offset.unit_depth > 0, offset.unit_steps > 0);
        const double step = i == 0 ? 1.0 / 65535 : 0x1p-24;  // depth of 1/2 and more
        EXPECT_GE(offset.unit(step), 0.99 * step);
        EXPECT_LE(offset.unit(step), 8 * step);
        EXPECT_NEAR(offset.slope_gain, 1, 0.011);
        EXPECT_NEAR(offset.slope({3, -4}), offset.slope_is_length ? 5 : 4, 0.06);
    }
}

std::vector<double> state() {
    std::vector<double> out;
    const auto add = [&](GLenum name, int count) {
        double values[4] = {};
        glGetDoublev(name, values);
        out.insert(out.end(), values, values + count);
    };
    for (const GLenum name :
         {GL_DRAW_FRAMEBUFFER_BINDING, GL_READ_FRAMEBUFFER_BINDING, GL_CURRENT_PROGRAM, GL_VERTEX_ARRAY_BINDING,
          GL_DEPTH_FUNC, GL_DEPTH_WRITEMASK, GL_CLIP_ORIGIN, GL_CLIP_DEPTH_MODE, GL_POLYGON_OFFSET_FACTOR,
          GL_POLYGON_OFFSET_UNITS, GL_PACK_ALIGNMENT, GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND, GL_STENCIL_TEST,
          GL_SCISSOR_TEST, GL_POLYGON_OFFSET_FILL, GL_DEPTH_CLAMP, GL_RASTERIZER_DISCARD})
        add(name, 1);
    add(GL_DEPTH_RANGE, 2);
    add(GL_VIEWPORT, 4);
    add(GL_COLOR_WRITEMASK, 4);
    return out;
}

TEST_F(DriverTest, MeasuringAnOffsetRestoresTheState) {
    const DriverInfo usual = renderer.driver();
    draw(settings_for(scene));  // a program, a framebuffer and vertices are bound
    glDepthFunc(GL_NOTEQUAL);
    glDepthMask(GL_FALSE);
    glDepthRange(0.25, 0.75);
    glViewport(3, 5, 7, 11);
    glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
    glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glPolygonOffset(3, 5);
    glPixelStorei(GL_PACK_ALIGNMENT, 2);
    for (const GLenum on :
         {GL_CULL_FACE, GL_BLEND, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_DEPTH_CLAMP, GL_RASTERIZER_DISCARD})
        glEnable(on);
    const std::vector<double> before = state();
    for (std::size_t format = 0; format < kMapFormats; ++format) {
        const PolygonOffset offset = measure_polygon_offset(MapFormat(format));
        EXPECT_EQ(state(), before) << format;
        // The state does not influence the measurement.
        const PolygonOffset& as_usual = usual.offset[format];
        EXPECT_EQ(offset.unit(0x1p-24), as_usual.unit(0x1p-24));
        EXPECT_EQ(offset.slope({1, 1}), as_usual.slope({1, 1}));
    }
}

std::set<GLuint> linked, used;
decltype(epoxy_glLinkProgram) real_link = nullptr;
decltype(epoxy_glUseProgram) real_use = nullptr;

SI_TEST_IS(Repeated, DriverTest, CompilesOnlyTheProgramsThatAFrameUses);
// A new renderer compiles exactly the programs that its frames use, at their first use.
SI_TEST_IS(Later, DriverTest, CompilesOnlyTheProgramsThatAFrameUses);
TEST_F(DriverTest, CompilesOnlyTheProgramsThatAFrameUses) {
    const GLuint program = glCreateProgram();
    glLinkProgram(program);
    glUseProgram(0);  // epoxy looks a function up when it is first called
    glDeleteProgram(program);
    real_link = epoxy_glLinkProgram;
    real_use = epoxy_glUseProgram;
    const Instead linking(
        epoxy_glLinkProgram, +[](GLuint id) {
            linked.insert(id);
            real_link(id);
        });
    const Instead using_(
        epoxy_glUseProgram, +[](GLuint id) {
            if (id) used.insert(id);
            real_use(id);
        });
    linked.clear();
    used.clear();
    Renderer fresh;
    EXPECT_TRUE(linked.empty()) << "before the first frame";
    FrameRequest request = small_request({.shadow_map = true});
    for (const char* kernel : {"pcf3", "pcss", "vsm", "savsm"}) {
        const Settings s = settings_for(scene, {{"filter.kernel", kernel}});
        // The very first frame shows the new picture, with its programs compiled.
        const ByteImage at_once = fresh.read_colour(fresh.render(scene, s, request).colour);
        EXPECT_FALSE(linked.empty());
        EXPECT_TRUE(std::ranges::includes(used, linked)) << kernel;
        Renderer other;
        EXPECT_EQ(at_once, other.read_colour(other.render(scene, s, request).colour)) << kernel;
        linked.clear();
        used.clear();
    }
}

int stamps = 0;
decltype(epoxy_glQueryCounter) real_stamp = nullptr;

TEST_F(DriverTest, PassTimesUseTheReliableClockAndSumUpToTheFrame) {
    const DriverInfo& d = renderer.driver();
    const bool honest = !d.software && d.query_share > 0.5 && d.query_share < 2;
    EXPECT_EQ(d.clock, d.software ? "processor time (CPU rasteriser)"
                       : honest   ? "GPU timer queries"
                                  : "finished wall time")
        << d.query_share;
    GLuint query = 0;
    glCreateQueries(GL_TIMESTAMP, 1, &query);
    glQueryCounter(query, GL_TIMESTAMP);  // epoxy looks a function up when it is first called
    glDeleteQueries(1, &query);
    real_stamp = epoxy_glQueryCounter;
    const Instead counted(
        epoxy_glQueryCounter, +[](GLuint id, GLenum target) {
            ++stamps;
            real_stamp(id, target);
        });
    const Settings s = settings_for(scene, {"filter.kernel=pcf9", "map.resolution=4096"});
    FrameRequest request{.width = 1280, .height = 720};
    request.force = request.timing = true;
    renderer.render(scene, s, request);
    double best = 0;
    for (int i = 0; i < 5; ++i) {
        stamps = 0;
        glFinish();
        const auto start = std::chrono::steady_clock::now();
        const FrameResult frame = renderer.render(scene, s, request);
        glFinish();
        const double wall = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        EXPECT_EQ(frame.clock, d.clock);
        double sum = 0;
        int ran = 0;
        for (const PassInfo& pass : frame.passes) {
            if (pass.state != PassState::Drawn) continue;
            ++ran;
            EXPECT_GT(pass.gpu_ms, 0) << pass.name;
            EXPECT_EQ(pass.wall_ms > 0, d.software) << pass.name;
            sum += d.software ? pass.wall_ms : pass.gpu_ms;
        }
        EXPECT_EQ(stamps, honest ? 2 * ran : 0);
        EXPECT_LE(sum, 1.05 * wall) << "passes follow one another within the frame";
        best = std::max(best, sum / wall);
    }
    EXPECT_GT(best, 0.5) << "of the wall time of a frame that draws four megatexels";
}

std::chrono::steady_clock::time_point query_began;
decltype(epoxy_glBeginQuery) real_begin = nullptr;

TEST_F(DriverTest, TheClockFollowsTheQueriesAndIsReported) {
    { const gl::PassClock first(false); }  // epoxy looks functions up when they are first called
    {
        const Instead lying(
            epoxy_glGetQueryObjectui64v, +[](GLuint, GLenum, GLuint64* ns) { *ns = 1000; });
        const gl::PassClock clock(false);
        EXPECT_EQ(clock.kind(), gl::ClockKind::Wall);
        EXPECT_LT(clock.query_share(), 0.5);
    }
    real_begin = epoxy_glBeginQuery;
    const Instead begin(
        epoxy_glBeginQuery, +[](GLenum target, GLuint id) {
            query_began = std::chrono::steady_clock::now();
            real_begin(target, id);
        });
    const Instead honest(
        epoxy_glGetQueryObjectui64v, +[](GLuint, GLenum, GLuint64* ns) {
            *ns = GLuint64(std::chrono::nanoseconds(std::chrono::steady_clock::now() - query_began).count());
        });
    const gl::PassClock clock(false);
    EXPECT_EQ(clock.kind(), gl::ClockKind::Queries);
    EXPECT_NEAR(clock.query_share(), 1, 0.4);
    EXPECT_EQ(gl::PassClock(true).kind(), gl::ClockKind::Processor) << "even if queries are honest";
}

TEST_F(DriverTest, ProcessorTimeCountsThreadsThatDrawAndNoOthers) {
    if (!renderer.driver().software) GTEST_SKIP() << "the driver does not draw on the CPU";
    std::atomic<bool> stop = false;
    std::atomic<ThreadId> spinning = 0;
    std::jthread other([&] {
        spinning = gettid();
        while (!stop) {
        }
    });
    while (spinning == 0) std::this_thread::yield();
    gl::PassClock clock(true);
    // This thread waits until the other has worked.
    clock.begin();
    const double before = processor_ms(spinning);
    while (processor_ms(spinning) < before + 50) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const double waited = clock.milliseconds(clock.end());
    EXPECT_LT(waited, 25) << "of 50 ms that another thread worked";
    stop = true;
    other.join();
    // The work of all threads together, where only the driver's work.
    const auto worked = [] {
        double ms = own_processor_ms();
        for (const ThreadId thread : other_threads()) ms += processor_ms(thread);
        return ms;
    };
    const Settings s = settings_for(scene, {"filter.kernel=pcf9", "map.resolution=2048"});
    const FrameRequest request{.width = 1280, .height = 720, .force = true};
    renderer.render(scene, s, request);
    clock.begin();
    const double start = worked();
    renderer.render(scene, s, request);
    glFinish();
    const double all = worked() - start, counted = clock.milliseconds(clock.end());
    EXPECT_GT(all, 20) << "too short to tell";
    EXPECT_GT(counted, 0.9 * all);
    EXPECT_LT(counted, 1.1 * all + 2);
}

}  // namespace
}  // namespace si
