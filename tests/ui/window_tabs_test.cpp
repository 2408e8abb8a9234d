// Test of the window's tabs while a reference is traced: clicks on tabs restart nothing and move no pixel.
#include <array>
#include <chrono>
#include <thread>

#include "tests/ui/drawn_text.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/window_fixture.h"

namespace si::test {
namespace {

class WindowTabs : public Window {
protected:
    /// Returns the pixels of the picture that the open strip does not cover.
    std::vector<std::uint8_t> picture(const std::string& name) const {
        const ByteImage image = screen(name);
        std::vector<std::uint8_t> rows;
        for (std::size_t y = 110; y < 380; ++y) {
            const auto from = image.data.begin() + std::ptrdiff_t((y * kWidth + 20) * 4);
            rows.insert(rows.end(), from, from + 4 * 820);
        }
        return rows;
    }
    /// Returns the number of references that the session has begun to trace, by its report; -1: not written yet.
    int references() const { return json_of(folder_ / "session.json").value("references", -1); }
};

TEST_F(WindowTabs, HundredClicksRestartNoReferenceAndMoveNoPixel) {
    std::array<glm::ivec2, kTabs> tabs{};
    {
        EditorOptions options = editor_options("boxes");
        options.tab = "error";
        TestEditor twin(options);
        twin.frames(4);
        const DrawnText text;
        for (int i = 0; i < kTabs; ++i) {
            const std::string_view label = kTabLabels[i];
            std::optional<glm::ivec2> at;
            // The tabs of the inspector are right of the picture, those of the strip at the lower edge.
            const std::u32string letters(label.begin(), label.end());
            for (int which = 0; const auto found = text.find(letters, which); ++which)
                if (is_in_inspector(Tab(i)) ? found->x > 900 && found->y > 300 && !at
                                            : found->y > 650 && found->x < 900)
                    at = glm::ivec2(int(found->x), int(found->y));
            ASSERT_TRUE(at) << label;
            tabs[std::size_t(i)] = *at;
        }
    }
    // More rays than any machine traces before the last click. The marks of the lights, which the tab Lights
    // adds to the picture, are off.
    std::vector<std::string> arguments = {SI_PROGRAM, "edit", "boxes", "--size", "1280x720", "--tab", "error"};
    for (const char* set : {"truth.area=true", "truth.samples=1048576", "truth.noise=0", "light.size=5",
                            "view.smooth=false", "view.axes=false", "view.frustum=false"}) {
        arguments.emplace_back("--set");
        arguments.emplace_back(set);
    }
    arguments.insert(arguments.end(), {"--report", (folder_ / "session.json").string()});
    program_ = std::make_unique<Process>(arguments, folder_, "program.log");
    ASSERT_TRUE(shows("boxes")) << log();
    ASSERT_TRUE(wait_until([&] { return references() > 0; })) << "no reference is traced";
    const auto pause = [] { std::this_thread::sleep_for(std::chrono::milliseconds(120)); };
    const auto click_tab = [&](glm::ivec2 at) {
        xdotool("mousemove " + std::to_string(at.x) + " " + std::to_string(at.y));
        pause();
        xdotool("click 1");
        pause();
    };
    click_tab(tabs[0]);
    wait_until([&] { return picture("window_tabs") == picture("window_tabs"); });
    const std::vector<std::uint8_t> before = picture("window_tabs_before");
    const int begun = references();
    for (int click = 1; click <= 100; ++click) {
        click_tab(tabs[std::size_t(click * 3 % kTabs)]);
        if (click % 5 == 0) {
            xdotool("mousemove 1270 2");
            pause();
            ASSERT_EQ(picture("window_tabs_after"), before) << "click " << click;
        }
        ASSERT_TRUE(program_->running()) << log();
    }
    std::this_thread::sleep_for(std::chrono::seconds(5));  // the report is written every few seconds
    EXPECT_EQ(references(), begun);
    keys("ctrl+q");
    EXPECT_TRUE(wait_until([&] { return !program_->running(); }));
    EXPECT_EQ(references(), begun) << "at the end of the session";
}

}  // namespace
}  // namespace si::test
