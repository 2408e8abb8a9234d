// Tests of smoothing in the idle editor: paused during measurements, continued after them, excluded from frame times.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include "renderer/gl/target.h"
#include "renderer/inspect/effects.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"

namespace si {
namespace {

class EditorSmoothing : public testing::Test {
protected:
    HeadlessEditor editor{test::editor_options("boxes", {"map.resolution=256"}, {800, 600})};
    EditorModel& model = editor.model();

    /// Changes the picture: one shading exists and no smoothed one.
    void begin_again() {
        model.smooths = false;
        model.state.settings.lights[0].azimuth += 1;
        editor.settle();
        ASSERT_FALSE(is_smooth());
        model.smooths = true;
    }
    bool is_smooth() const { return model.facts().result->smooth.texture != 0; }
    /// Returns the shown picture of the scene.
    std::vector<std::uint8_t> picture() const {
        const Image image = model.facts().result->panes.front().picture;
        std::vector<std::uint8_t> out(std::size_t(image.width) * std::size_t(image.height) * 4);
        gl::prepare_read_back();
        glGetTextureImage(image.texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(out.size()), out.data());
        return out;
    }
};

SI_TEST_IS(Later, EditorSmoothing, PausesDuringMeasurementsAndContinues);
TEST_F(EditorSmoothing, PausesDuringMeasurementsAndContinues) {
    struct Measurement {
        const char* name;
        void (*begin)(EditorRequests&);
        void (*cancel)(EditorRequests&);  ///< cancel function; null: the test waits
    };
    const std::vector<Measurement> measurements = {
        {"savings", [](EditorRequests& a) { a.measure_saved_times = true; }, nullptr},
        {"a sweep",
         [](EditorRequests& a) {
             a.start_sweep = SweepRequest{{"map.resolution=64,128"}, 64, 48, false};
         },
         nullptr},
        {"tuning", [](EditorRequests& a) { a.tune = SearchRequest{}; },
         [](EditorRequests& a) { a.cancel_tune = true; }},
        {"cures", [](EditorRequests& a) { a.find_fixes = FixRequest{}; },
         [](EditorRequests& a) { a.cancel_fixes = true; }},
        {"advice", [](EditorRequests& a) { a.find_advice = SearchRequest{}; },
         [](EditorRequests& a) { a.cancel_advice = true; }},
        {"ways", [](EditorRequests& a) { a.compare_pipelines = true; },
         [](EditorRequests& a) { a.cancel_pipelines = true; }},
        {"shimmer", [](EditorRequests& a) { a.measure_shimmer = ShimmerOptions{.steps = 2}; },
         [](EditorRequests& a) { a.cancel_shimmer = true; }},
    };
    for (const Measurement& m : measurements) {
        SCOPED_TRACE(m.name);
        ASSERT_NO_FATAL_FAILURE(begin_again());
        EditorRequests requests = editor.frame();
        ASSERT_TRUE(requests.at_rest && is_smooth()) << "nothing is measured yet";
        const auto begun = picture();
        m.begin(requests);
        model.fulfil(requests);
        ASSERT_TRUE(model.measuring());
        EXPECT_TRUE(picture() == begun) << "in the frame in which it begins";
        for (int i = 0; i < 5; ++i) {
            editor.frame();
            if (!model.measuring()) break;  // the measurement may have ended during that frame
            EXPECT_TRUE(picture() == begun) << "while it goes on";
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        if (m.cancel) {
            requests = editor.frame();
            m.cancel(requests);
            model.fulfil(requests);
        }
        do {
            model.finish_measuring();
            editor.frame();
        } while (model.measuring());
        for (int i = 0; i < kMaxSmoothedShadings; ++i) editor.frame();
        EXPECT_TRUE(is_smooth());
        EXPECT_FALSE(picture() == begun) << "it stayed at one shading";
        EXPECT_EQ(model.state.log.unseen_errors(), 0);
    }
}

TEST_F(EditorSmoothing, IsNotCountedInFrameTimes) {
    model.state.window.open_page = Page::Effects;
    editor.settle();
    ASSERT_TRUE(model.state.shows(Page::Effects)) << "which times frames";
    model.state.settings.lights[0].azimuth += 1;
    editor.frame();
    editor.frame();
    const std::vector<PassInfo> timed = model.facts().result->passes;
    const std::size_t frames = model.state.times.frames.size();
    ASSERT_TRUE(std::ranges::any_of(timed, [](const PassInfo& pass) { return pass.gpu_ms > 0; }));
    ASSERT_GT(frames, 0u);
    model.smooths = true;
    for (int i = 0; i <= kMaxSmoothedShadings; ++i) editor.frame();
    ASSERT_TRUE(is_smooth());
    const std::vector<PassInfo>& told = model.facts().result->passes;
    ASSERT_EQ(told.size(), timed.size());
    for (std::size_t i = 0; i < told.size(); ++i) {
        SCOPED_TRACE(told[i].name);
        EXPECT_EQ(told[i].name, timed[i].name);
        EXPECT_EQ(told[i].gpu_ms, timed[i].gpu_ms);
        EXPECT_EQ(told[i].cpu_ms, timed[i].cpu_ms);
        if (told[i].name == kSmoothingPass) {
            EXPECT_EQ(told[i].gpu_ms, 0);
        }
    }
    const auto effects = model.facts().effects;
    const auto row = std::ranges::find(effects, kSmoothingPass, &Effect::name);
    ASSERT_NE(row, effects.end());
    EXPECT_EQ(row->state, EffectState::Drawn) << row->reason;
    EXPECT_EQ(model.state.times.frames.size(), frames) << "a shading counts as a frame";
}

}  // namespace
}  // namespace si
