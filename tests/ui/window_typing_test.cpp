// Tests of typing faster than frames are drawn.
#include <chrono>
#include <thread>

#include "tests/ui/window_fixture.h"

namespace si::test {
namespace {

namespace fs = std::filesystem;

class WindowTyping : public Window {
protected:
    /// Sends commands while the editor is stopped, as during one slow frame.
    void in_one_slow_frame(const std::vector<std::string>& commands) const {
        program_->hold(true);
        for (const std::string& command : commands) EXPECT_TRUE(xdotool(command)) << command;
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        program_->hold(false);
        wait_until_idle();
    }
    /// Returns the saved preset of any name; empty if none.
    std::string saved_name() const {
        std::string name;
        const auto is_saved = [&] {
            for (const auto& entry : fs::directory_iterator(folder_))
                if (entry.path().extension() == ".json") name = entry.path().filename();
            return !name.empty();
        };
        wait_until(is_saved);
        return name;
    }
};

TEST_F(WindowTyping, NoLetterIsLostAfterControlAInASlowFrame) {
    ASSERT_NO_FATAL_FAILURE(start());
    keys("ctrl+shift+s");
    wait_until_idle();
    type("before");
    in_one_slow_frame({"key ctrl+a", "type --delay 20 depthbiass"});
    screen("window_typed");
    keys("Return");
    EXPECT_EQ(saved_name(), "depthbiass.json") << log();
    wait_until_idle();
    quit();
}

TEST_F(WindowTyping, KeysKeepTheirOrderAmongLetters) {
    ASSERT_NO_FATAL_FAILURE(start());
    keys("ctrl+shift+s");
    wait_until_idle();
    in_one_slow_frame({"key --delay 20 ctrl+a m i x x BackSpace BackSpace n d Left e Right s Return"});
    EXPECT_EQ(saved_name(), "mineds.json") << log();
    wait_until_idle();
    quit();
}

TEST_F(WindowTyping, LettersWaitForTheClickIntoTheirField) {
    ASSERT_NO_FATAL_FAILURE(start());
    mouse(400, 600);
    const nlohmann::json before = saved();
    // The search for settings, then its first slider.
    in_one_slow_frame({"mousemove 1040 376", "click 1", "type --delay 20 bias.constant"});
    screen("window_typed_after_click");
    drag(1170, 433, 60, 0);
    nlohmann::json after = saved();
    EXPECT_EQ(after.erase("bias.constant"), 1u) << after;
    EXPECT_EQ(after, before) << "letters were shortcuts";
    quit();
}

}  // namespace
}  // namespace si::test
