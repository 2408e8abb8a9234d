// Tests the renderer's memory report: every image and buffer is counted and released, and programs do not pile up.
#include <chrono>
#include <map>
#include <thread>

#include "app/editor/shader_warmup.h"
#include "app/sweep/measuring_thread.h"
#include "renderer/base/held_memory.h"
#include "renderer/gl/driver_failure.h"
#include "renderer/gl/program_cache.h"
#include "renderer/gl/target.h"
#include "renderer/software/llvmpipe_queue.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class MemoryReportTest : public FrameTest {
protected:
    void TearDown() override {
        gl::fault_injection() = {};
        FrameTest::TearDown();
    }
    /// Returns a holder's memory without that of other renderers of this process.
    MemoryUse memory_of(const std::string& holder) const {
        for (MemoryUse h : memory_report().holders) {
            if (h.holder != holder) continue;
            for (const MemoryUse& b : before_)
                if (b.holder == holder) {
                    h.bytes -= b.bytes;
                    h.count -= b.count;
                }
            return h;
        }
        return {};
    }
    std::vector<MemoryUse> before_ = memory_report().holders;
};

SI_TESTS_ARE(SystemAllocator, MemoryReportTest);
SI_TESTS_ARE(DriverIndependent, MemoryReportTest);
TEST_F(MemoryReportTest, ImageBytesFollowFormatSizeLayersLevelsAndSamples) {
    const auto bytes = [&](GLenum format, int w, int h, int layers, gl::TargetExtent extent) {
        gl::Target t;
        t.ensure("a test's image", format, w, h, layers, extent);
        return memory_of("a test's image").bytes;
    };
    EXPECT_EQ(bytes(GL_R32F, 64, 32, 0, {}), 64u * 32 * 4);
    EXPECT_EQ(bytes(GL_DEPTH_COMPONENT32F, 64, 64, 3, {}), 64u * 64 * 3 * 4);
    EXPECT_EQ(bytes(GL_DEPTH_COMPONENT16, 64, 64, 0, {}), 64u * 64 * 2);
    EXPECT_EQ(bytes(GL_RGBA16F, 4, 4, 0, {.levels = 3}), (16u + 4 + 1) * 8);
    EXPECT_EQ(bytes(GL_DEPTH_COMPONENT32F, 64, 64, 0, {.samples = 4}), 64u * 64 * 4 * 4);
    EXPECT_EQ(memory_of("a test's image").bytes, 0u);
}

TEST_F(MemoryReportTest, MapsAreCountedAtTheirActualSize) {
    const Scene scene = load_scene("boxes");
    picture(scene, settings_for(scene, {"map.resolution=512", "map.format=d32f"}));
    EXPECT_EQ(memory_of("shadow maps").bytes, 512u * 512 * 4);
    picture(scene, settings_for(scene, {"map.resolution=64", "map.format=d32f"}));
    EXPECT_EQ(memory_of("shadow maps").bytes, 64u * 64 * 4) << "the larger one is still there";
    EXPECT_GT(memory_of("scene's vertices").bytes, 100u);
}

#if !defined(__SANITIZE_ADDRESS__)  // the sanitizer's allocator reports nothing
/// Memory that the report counts as released is released by the driver too, at the latest when nothing is drawn. The
/// test uses 160 MB in forty layers.
TEST_F(MemoryReportTest, TheDriverKeepsNoMapOfManyLayers) {
    if (!renderer.driver().renderer.starts_with("llvmpipe")) GTEST_SKIP() << "other drivers may keep memory";
    const Scene scene = load_scene("boxes");
    Settings s = settings_for(scene, {"map.resolution=32", "map.format=d32f"});
    s.light_count = 7;
    for (int i = 0; i < s.light_count; ++i) s.lights[std::size_t(i)].type = LightType::Point;
    const auto heap_at_rest = [&](int resolution) {
        s.map.resolution = resolution;
        picture(scene, s);
        renderer.release_unused_memory();
        return process_memory().heap;
    };
    const std::uint64_t before = heap_at_rest(32);
    EXPECT_GT(heap_at_rest(1024), before + (150u << 20));
    EXPECT_LT(heap_at_rest(32), before + (16u << 20));
    EXPECT_TRUE(gl::release_finished_images()) << "not even the largest picture takes long";
}

/// The same holds for maps drawn in the background, by another context.
SI_TEST_IS(Slow, MemoryReportTest, ShaderWarmUpKeepsNoMapOfManyLayers);
TEST_F(MemoryReportTest, ShaderWarmUpKeepsNoMapOfManyLayers) {
    if (!renderer.driver().renderer.starts_with("llvmpipe")) GTEST_SKIP() << "other drivers may keep memory";
    const auto scene = std::make_shared<const Scene>(load_scene("boxes"));
    WarmupFrame next{.scene = scene, .settings = settings_for(*scene, {"map.format=d32f"}), .request = {}};
    next.settings.light_count = 7;
    for (int i = 0; i < next.settings.light_count; ++i) next.settings.lights[std::size_t(i)].type = LightType::Point;
    ShaderWarmup warmup;
    const auto heap_after = [&](int resolution) {
        next.settings.map.resolution = resolution;
        warmup.enqueue(next);
        warmup.wait();
        return process_memory().heap;
    };
    const std::uint64_t before = heap_after(32);
    EXPECT_LT(heap_after(1024), before + (16u << 20));
    EXPECT_GE(memory_of("shadow maps").most, 160u << 20) << "none was drawn";
    EXPECT_EQ(warmup.done(), 2u);
}
#endif

/// A background thread keeps at most one picture in drawing and one waiting.
TEST_F(MemoryReportTest, BackgroundDrawingWaitsForThePictureBeforeTheLast) {
    constexpr int kSide = 8192;
    gl::Target tiny, large;
    tiny.ensure("a test's image", GL_R8, 1, 1);
    large.ensure("a test's image", GL_R8, kSide, kSide);
    const gl::Framebuffer into_tiny = gl::make_framebuffer("a test's image", &tiny, nullptr);
    const gl::Framebuffer into_large = gl::make_framebuffer("a test's image", &large, nullptr);
    constexpr float kBlack[4] = {};
    glClearNamedFramebufferfv(into_tiny.id(), GL_COLOR, 0, kBlack);
    glFinish();
    gl::set_background_drawing();
    glBlitNamedFramebuffer(into_tiny.id(), into_large.id(), 0, 0, 1, 1, 0, 0, kSide, kSide, GL_COLOR_BUFFER_BIT,
                           GL_LINEAR);
    const GLsync drawn = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl::throttle_background_drawing();
    glClearNamedFramebufferfv(into_tiny.id(), GL_COLOR, 0, kBlack);
    gl::throttle_background_drawing();
    EXPECT_EQ(glClientWaitSync(drawn, 0, 0), GLenum(GL_ALREADY_SIGNALED));
    glDeleteSync(drawn);
    gl::set_background_drawing(false);
}

/// A failed allocation leaves no image: neither the one of the earlier size, which would pass for the requested one,
/// nor the failed one.
TEST_F(MemoryReportTest, ATargetWithoutMemoryIsEmpty) {
    gl::Target t;
    t.ensure("a test's image", GL_R32F, 64, 64);
    t.key = 5;
    gl::fault_injection().fails = [](gl::DriverFailure of, std::string_view) {
        return of == gl::DriverFailure::Memory;
    };
    EXPECT_THROW(t.ensure("a test's image", GL_R32F, 256, 256), gl::OutOfMemory);
    gl::fault_injection() = {};
    EXPECT_FALSE(t.texture) << "the failed image still exists";
    EXPECT_EQ(t.key, 0u);
    EXPECT_EQ(memory_of("a test's image").bytes, 0u);
    EXPECT_TRUE(t.ensure("a test's image", GL_R32F, 64, 64)) << "the image of before is taken for this one";
    GLint width = 0;
    glGetTextureLevelParameteriv(t.texture.id(), 0, GL_TEXTURE_WIDTH, &width);
    EXPECT_EQ(width, 64);
}

SI_TEST_IS(Later, MemoryReportTest, BackgroundMeasurementsReleaseMemoryWhenIdle);
TEST_F(MemoryReportTest, BackgroundMeasurementsReleaseMemoryWhenIdle) {
    const Settings s = settings_for(load_scene("boxes"), {"map.resolution=256"});
    MeasuringThread thread(std::chrono::milliseconds(300));
    thread.start_measurement(
        {.scene = std::make_shared<const Scene>(load_scene("boxes")), .settings = s, .width = 64, .height = 48});
    thread.wait();
    EXPECT_TRUE(thread.status().measured) << thread.status().measure_problem;
    EXPECT_GE(memory_of("shadow maps").most, 256u * 256 * 4);
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (memory_of("shadow maps").bytes > 0 && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(memory_of("shadow maps").bytes, 0u) << "its maps stay for good";
}

gl::ProgramRequest plain_program(int number) {
    return {.vertex = "passes/fullscreen.vert.glsl",
            .fragment = "passes/volume_depth.frag.glsl",
            .includes = {},
            .defines = {},
            .preamble = "// " + std::to_string(number) + "\n"};
}

TEST_F(MemoryReportTest, LeastRecentlyUsedProgramsAreReleased) {
    gl::ProgramCache cache;
    for (int i = 0; i < 6; ++i) {
        cache.get(plain_program(i));
        cache.end_frame(6);
    }
    const GLuint first = cache.get(plain_program(0));
    cache.end_frame(6);
    EXPECT_EQ(cache.size(), 6u);
    for (int i = 6; i < 9; ++i) cache.get(plain_program(i));
    cache.end_frame(6);
    EXPECT_EQ(cache.size(), 6u);
    EXPECT_EQ(cache.get(plain_program(0)), first) << "used since, and gone before those that were not";
    EXPECT_TRUE(glIsProgram(first));
    EXPECT_NE(cache.get(plain_program(1)), 0u) << "what gave way is made again";
    EXPECT_EQ(cache.size(), 7u);
    EXPECT_EQ(memory_of("texts of shader programs").count, cache.size());
    // All programs that one frame uses stay, whatever their number.
    for (int i = 0; i < 9; ++i) cache.get(plain_program(i));
    cache.end_frame(2);
    EXPECT_EQ(cache.size(), 9u);
    cache.end_frame(2);
    EXPECT_EQ(cache.size(), 2u);
}

TEST_F(MemoryReportTest, FramesWithFewProgramsDrawTheSamePicture) {
    const Scene scene = load_scene("boxes");
    const FrameRequest tiny{.width = 32, .height = 18};
    gl::fault_injection().max_programs = 4;
    std::map<std::string, ByteImage> first;
    std::size_t most = 0;
    for (int round = 0; round < 2; ++round)
        for (const char* overlay : {"visibility", "normals", "stored-depth", "bias-applied", "light-uv", "n-dot-l"}) {
            Settings s = settings_for(scene, {"map.resolution=64"});
            set_setting(s, "view.overlay", overlay);
            const ByteImage drawn = picture(scene, s, tiny);
            most = std::max(most, memory_of("texts of shader programs").count);
            const auto [known, is_new] = first.emplace(overlay, drawn);
            EXPECT_EQ(known->second, drawn) << overlay;
        }
    EXPECT_LE(most, 7u) << "each frame's programs stay for good";
}

}  // namespace
}  // namespace si
