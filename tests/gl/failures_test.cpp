// Tests drivers that run out of memory, reject a shader or lose their context, by failure injection at every call of a
// frame.
#include <fmt/format.h>

#include <memory>
#include <set>

#include "renderer/bundle/imported_maps.h"
#include "renderer/gl/driver_failure.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/error_text.h"
#include "tests/support/traits.h"

namespace si {
namespace {

using gl::DriverFailure;

class FailuresTest : public ::testing::Test {
protected:
    HeadlessContext context;
    void SetUp() override { test::expect_requested_driver(); }
    void TearDown() override { gl::fault_injection() = {}; }

    /// Counter of calls of one kind, which fails the call with a given number. 0: none fails.
    struct Count {
        int calls = 0, failing = 0;
        std::string failed;  ///< purpose of the failed call
    };
    static std::shared_ptr<Count> fail(DriverFailure kind, int number) {
        auto count = std::make_shared<Count>(Count{.failing = number});
        gl::fault_injection().fails = [count, kind](DriverFailure of, std::string_view what) {
            if (of != kind || ++count->calls != count->failing) return false;
            count->failed = what;
            return true;
        };
        return count;
    }
    /// Lets every call for this purpose fail.
    static void always_fail(const std::string& name) {
        gl::fault_injection().fails = [name](DriverFailure of, std::string_view what) {
            return of == DriverFailure::Memory && what.find(name) != std::string_view::npos;
        };
    }
    static FrameRequest request() {
        FrameRequest r{.width = 48,
                       .height = 32,
                       .outputs = {.colour = true, .shadow_map = true, .visibility = true, .health = true}};
        return r;
    }
    static Settings settings(const Scene& scene) {
        return settings_for(scene, {"map.resolution=64", "light.count=2", "light.1.source=volumes-zfail",
                                    "filter.kernel=vsm", "view.overlay=visibility"});
    }
    static ByteImage draw(Renderer& renderer, const Scene& scene, const Settings& s) {
        return renderer.read_colour(renderer.render(scene, s, request()).colour);
    }
    /// Draws whole frames with a new renderer, with another failing call in each. The frames that follow draw as
    /// usual.
    void expect_each_failure_handled(DriverFailure kind, std::size_t least_calls) {
        const Scene scene = load_scene("boxes");
        const Settings s = settings(scene);
        ByteImage whole;
        int calls = 0;
        {
            const auto count = fail(kind, 0);
            Renderer renderer;
            whole = draw(renderer, scene, s);
            calls = count->calls;
        }
        ASSERT_GE(std::size_t(calls), least_calls);
        std::set<std::string> what;
        for (int n = 1; n <= calls; ++n) {
            SCOPED_TRACE(fmt::format("call {} of {}", n, calls));
            const auto count = fail(kind, n);
            Renderer renderer;
            const std::string text = test::error_text([&] { draw(renderer, scene, s); });
            if (!text.empty()) {
                const char* what_failed = kind == DriverFailure::Memory ? "no memory for" : "does not compile";
                EXPECT_TRUE(test::mentions(text, {what_failed, count->failed, "; "})) << "with place and fix";
            }
            EXPECT_FALSE(count->failed.empty()) << "nothing failed";
            what.insert(count->failed);
            gl::fault_injection() = {};
            Settings again = s;
            again.map.resolution = 65;  // a resolution without a known limit
            renderer.render(scene, again, request());
            EXPECT_EQ(draw(renderer, scene, s), whole) << "after " << count->failed;
        }
        EXPECT_GE(what.size(), least_calls / 2);
    }
};

SI_TESTS_ARE(DriverIndependent, FailuresTest);
SI_TEST_IS(Later, FailuresTest, OutOfMemoryIsHandledAtEveryCallOfAFrame);
TEST_F(FailuresTest, OutOfMemoryIsHandledAtEveryCallOfAFrame) {
    expect_each_failure_handled(DriverFailure::Memory, 20);
}

TEST_F(FailuresTest, FailureOfEveryShaderIsHandled) {
    expect_each_failure_handled(DriverFailure::Shader, 10);
}

TEST_F(FailuresTest, SmallerMapsAreDrawnAndReported) {
    const Scene scene = load_scene("boxes");
    const Settings s = settings_for(scene, {"map.resolution=512"});
    Settings smaller = s;
    smaller.map.resolution = 128;
    Renderer renderer;
    gl::fault_injection().fails = [](DriverFailure of, std::string_view what) {
        return of == DriverFailure::Memory && (what.find("shadow maps (512") != std::string_view::npos ||
                                               what.find("shadow maps (256") != std::string_view::npos);
    };
    const FrameResult frame = renderer.render(scene, s, request());
    EXPECT_EQ(frame.map_resolution, 128);
    bool told = false;
    for (const std::string& note : frame.notes)
        told |= note.starts_with("maps of 128² are used in place of 512²: the driver has no memory for");
    EXPECT_TRUE(told) << fmt::format("{}", fmt::join(frame.notes, "; "));
    const ByteImage picture = renderer.read_colour(frame.colour);
    gl::fault_injection() = {};
    EXPECT_EQ(renderer.render(scene, s, request()).map_resolution, 128) << "it is tried again in every frame";
    EXPECT_EQ(draw(renderer, scene, smaller), picture);
    EXPECT_EQ(renderer.render(scene, s, request()).map_resolution, 512) << "another resolution ends it";
}

TEST_F(FailuresTest, WithoutMemoryForAnyMapTheMessageReportsIt) {
    const Scene scene = load_scene("boxes");
    Renderer renderer;
    always_fail("shadow maps");
    EXPECT_TRUE(test::fails_with<gl::OutOfMemory>([&] { renderer.render(scene, settings_for(scene), request()); },
                                                  {"use a smaller size, map.resolution or fewer lights"}));
}

TEST_F(FailuresTest, MapsKeepTheirSizeAfterAPictureWithoutMemory) {
    const Scene scene = load_scene("boxes");
    const Settings s = settings_for(scene, {"map.resolution=512"});
    Renderer renderer;
    always_fail("shaded picture");
    EXPECT_TRUE(test::fails_with<gl::OutOfMemory>([&] { renderer.render(scene, s, request()); },
                                                  {"the driver has no memory for shaded picture"}));
    gl::fault_injection() = {};
    EXPECT_EQ(renderer.render(scene, s, request()).map_resolution, 512);
}

TEST_F(FailuresTest, AFrameWithGivenMapsIsTriedOnce) {
    const Scene scene = load_scene("boxes");
    const Settings s = settings_for(scene, {"map.resolution=512"});
    FrameRequest given = request();
    {
        Renderer drawing;
        const FrameResult frame = drawing.render(scene, s, given);
        std::vector<FloatImage> images;
        for (std::size_t v = 0; v < frame.lights.at(0).views.size(); ++v)
            images.push_back(drawing.read_shadow_map(frame, 0, int(v)));
        given.imported = {imported_maps(std::move(images))};
    }
    int failures = 0;
    gl::fault_injection().fails = [&failures](DriverFailure of, std::string_view what) {
        if (of != DriverFailure::Memory || what.find("shaded picture") == std::string_view::npos) return false;
        return ++failures <= 10;  // a frame that is tried for ever would end here
    };
    Renderer renderer;
    EXPECT_TRUE(test::fails_with<gl::OutOfMemory>([&] { renderer.render(scene, s, given); },
                                                  {"the driver has no memory for shaded picture"}));
    EXPECT_EQ(failures, 1);
}

TEST_F(FailuresTest, ALostContextIsReportedOncePerFrame) {
    const Scene scene = load_scene("boxes");
    const Settings s = settings(scene);
    Renderer renderer;
    const ByteImage whole = draw(renderer, scene, s);
    for (int n = 1; n <= 2; ++n) {  // before the frame, and after it
        const auto count = fail(DriverFailure::Context, n);
        EXPECT_TRUE(test::fails_with<gl::ContextLost>([&] { renderer.render(scene, s, request()); },
                                                      {"save the settings and start the program again"}));
        gl::fault_injection() = {};
        EXPECT_EQ(draw(renderer, scene, s), whole);
    }
}

}  // namespace
}  // namespace si
