// Tests of the editor's window under real events: sliders, views, handles and keys.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <thread>

#include "tests/ui/drawn_text.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/window_fixture.h"

namespace si::test {
namespace {

TEST_F(Window, WaitingEndsWithTheProgramAndWithTheServer) {
    ASSERT_NO_FATAL_FAILURE(start());
    int looks = 0;
    const auto never = [&] { return ++looks, false; };
    program_->kill_at_once();
    EXPECT_FALSE(wait_until(never));
    EXPECT_EQ(looks, 2) << "the last look is after its end";
    program_.reset();
    server_->kill_at_once();
    EXPECT_FALSE(wait_until(never));
    EXPECT_EQ(looks, 4);
}

TEST_F(Window, EndOfTheServerKeepsTheSessionAndIsASentence) {
    ASSERT_NO_FATAL_FAILURE(start());
    keys("u");  // all bias away
    wait_until_idle();
    server_->kill_at_once();
    wait_until([&] { return !program_->running(); });
    for (int i = 0; i < 600 && program_->running(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    ASSERT_FALSE(program_->running());
    EXPECT_EQ(program_->code(), 1) << log();
    EXPECT_NE(log().find("shadow-inspector: the X server has ended; the next start offers"), std::string::npos)
        << log();
    std::size_t kept = 0;
    for (const auto& entry : std::filesystem::directory_iterator(state_folder() / "sessions"))
        if (entry.path().extension() == ".json") kept += !json_of(entry.path())["settings"].empty();
    EXPECT_EQ(kept, 1u);
}

TEST_F(Window, ADestroyedWindowEndsTheEditorAsAClosedOne) {
    ASSERT_NO_FATAL_FAILURE(start());
    keys("u");
    wait_until_idle();
    ASSERT_TRUE(xdotool("search --onlyvisible --name boxes windowclose"));
    wait_until([&] { return !program_->running(); });
    EXPECT_EQ(program_->code(), 0) << log();
    EXPECT_EQ(log().find("Assertion"), std::string::npos) << log();
}

TEST_F(Window, ClosedTerminalEndsTheEditorCleanly) {
    ASSERT_NO_FATAL_FAILURE(start());
    keys("u");
    wait_until_idle();
    program_->send(SIGHUP);
    wait_until([&] { return !program_->running(); });
    EXPECT_EQ(program_->code(), 0) << log();
    EXPECT_TRUE(std::filesystem::exists(state_folder() / "workspace.json")) << "the layout is kept";
}

TEST_F(Window, FrontierDotIsClicked) {
    const std::string command = std::string("cd '") + folder_.string() +
                                "' && '" SI_PROGRAM
                                "' sweep boxes --vary filter.kernel=pcf3,pcf9 --vary map.resolution=64,4096 --size "
                                "64x48 --rounds 1 --cost forced -o swept "
                                "> sweep.log 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const auto is_dot = [](const ByteImage& image, int x, int y) {
        const std::uint8_t* p = &image.data[4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x))];
        return p[0] == 86 && p[1] == 180 && p[2] == 233;
    };
    std::filesystem::create_directories(state_folder());
    std::ofstream(state_folder() / "workspace.json")
        << R"({"format": "shadow-inspector-workspace", "version": 1, "layout": {"bottom_height": 18}})";
    ASSERT_NO_FATAL_FAILURE(start({"--size", "1280x720", "--sweep", (folder_ / "swept").string()}));
    {
        EditorOptions options = editor_options();
        options.sweep = folder_ / "swept";
        TestEditor twin(options);
        twin.state().layout.bottom_height = 18;
        twin.frames(4);
        const auto box = DrawnText().find(U"Measurethepresentsettings");
        ASSERT_TRUE(box);
        click(int(box->x), int(box->y));  // measured no more, so that the plot stays
    }
    const ByteImage shown = screen("window_dots");
    glm::ivec2 first{-1};
    for (int x = 0; x < 900 && first.x < 0; ++x)
        for (int y = 500; y < 718 && first.x < 0; ++y)
            // Strokes of labels in the same colour are thinner than a dot.
            if (is_dot(shown, x, y) && is_dot(shown, x + 4, y) && is_dot(shown, x, y + 4) &&
                is_dot(shown, x + 4, y + 4) && is_dot(shown, x + 2, y + 2))
                first = {x + 2, y + 2};
    ASSERT_GE(first.x, 0) << "no dot of the frontier is drawn";
    click(first.x, first.y);
    const nlohmann::json settings = saved();
    screen("window_frontier");
    EXPECT_EQ(settings.value("map.resolution", 0), 64) << settings;
    keys("ctrl+z");
    EXPECT_FALSE(saved().contains("map.resolution"));
}

TEST_F(Window, DoubleClickDuringASlowFrameSelects) {
    ASSERT_NO_FATAL_FAILURE(start());
    mouse(485, 260);  // the floating cube
    program_->hold(true);
    xdotool("click --repeat 2 --delay 100 1");
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    program_->hold(false);
    wait_until_idle();
    keys("f");
    const nlohmann::json object = saved();
    for (int i = 0; i < 2; ++i) {  // the probe, then the object
        keys("Escape");
        wait_until_idle();
    }
    keys("f");
    const nlohmann::json everything = saved();
    EXPECT_LT(object.value("camera.distance", 0.0), 0.6 * everything.value("camera.distance", 0.0)) << object;
    EXPECT_TRUE(program_->running()) << log();
}

TEST_F(Window, LightHandleIsDraggedAndUndone) {
    ASSERT_NO_FATAL_FAILURE(start());
    TestEditor twin;
    const EditorState& state = twin.state();
    const FittedLight& fitted = twin.facts().result->lights[0];
    const auto handles = place_handles(light_pose(state.settings.lights[0], fitted, 0), *state.viewport.view);
    const auto drag_handle = [&](const std::function<bool(LightHandle)>& wanted) {
        const auto found =
            std::find_if(handles.begin(), handles.end(), [&](const auto& h) { return wanted(h.handle); });
        ASSERT_NE(found, handles.end());
        drag(int(found->on_screen.x), int(found->on_screen.y), 24, 18);
    };
    const nlohmann::json before = saved();
    drag_handle([](LightHandle h) { return h == LightHandle::Direction; });
    const nlohmann::json turned = saved();
    screen("window_handle");
    EXPECT_TRUE(turned.contains("light.azimuth")) << turned;
    EXPECT_FALSE(turned.contains("light.fit")) << "a light turns under its fit";
    EXPECT_FALSE(turned.contains("camera.source")) << "the camera turned too";
    keys("ctrl+z");
    EXPECT_EQ(saved(), before);
    drag_handle(is_extent);
    const nlohmann::json wider = saved();
    EXPECT_EQ(wider.value("light.fit", ""), "manual") << wider;
    EXPECT_TRUE(wider.contains("light.extent") && wider.contains("light.near") && wider.contains("light.far"));
    keys("ctrl+z");
    EXPECT_EQ(saved(), before);
    EXPECT_TRUE(program_->running()) << log();
}

TEST_F(Window, CameraFliesWhileAKeyIsHeld) {
    ASSERT_NO_FATAL_FAILURE(start());
    mouse(200, 330);
    xdotool("mousedown 3");
    wait_until_idle();
    const double before = program_->cpu_seconds();
    xdotool("keydown w");
    wait_until([&] { return program_->cpu_seconds() > before + 0.5; });  // it draws while it flies
    xdotool("keyup w");
    wait_until_idle();
    xdotool("mouseup 3");
    wait_until_idle();
    const nlohmann::json flown = saved();
    EXPECT_EQ(flown.value("camera.source", ""), "manual") << flown;
    EXPECT_TRUE(flown.contains("camera.target_x") && flown.contains("camera.target_z"));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    EXPECT_EQ(saved(), flown) << "it flies on";
    keys("ctrl+z");
    EXPECT_FALSE(saved().contains("camera.source"));
}

TEST_F(Window, FlyingContinuesAtTheScreenEdge) {
    ASSERT_NO_FATAL_FAILURE(start());
    // To one side by more than the screen's width, in steps no longer than a hand's.
    const auto look = [&](int steps) {
        mouse(400, 300);
        xdotool("mousedown 3");
        wait_until_idle();
        for (int i = 0; i < steps; ++i) {
            xdotool("mousemove_relative -- 200 0");
            wait_until_idle();
        }
        const std::string held = ask("getmouselocation");
        xdotool("mouseup 3");
        wait_until_idle();
        EXPECT_NE(held, "") << "no mouse";
        return saved().value("camera.azimuth", 0.0);
    };
    const double once = look(2), twice = look(2), far = look(10);
    screen("window_flown");
    // Two steps fit on the screen, and ten turn five times as far.
    const double two_steps = std::remainder(twice - once, 360.0);
    EXPECT_GT(std::abs(two_steps), 20);
    EXPECT_NEAR(std::remainder(far - twice - 5 * two_steps, 360.0), 0, 1) << two_steps;
    // The mouse is back at the start of the flight, which is after its first, shorter step.
    EXPECT_NE(ask("getmouselocation").find("x:600 y:300"), std::string::npos) << ask("getmouselocation");
    quit();
}

TEST_F(Window, IdleEditorSleepsAndFollowsAResize) {
    ASSERT_NO_FATAL_FAILURE(start());
    mouse(900, 700);
    wait_until_idle(true);  // shaders for the click are warmed up
    std::this_thread::sleep_for(std::chrono::seconds(2));
    wait_until_idle(true);
    const double before = program_->cpu_seconds();
    ASSERT_GT(before, 0);
    std::this_thread::sleep_for(std::chrono::seconds(3));
    EXPECT_LT(program_->cpu_seconds() - before, 0.3) << "seconds of processor time in three still seconds";
    ASSERT_TRUE(xdotool("search --name 'Shadow Inspector' windowsize 1000 600"));
    wait_until_idle();
    screen("window_resized");
    EXPECT_TRUE(program_->running()) << log();
    quit();
}

TEST_F(Window, ShowsTheSamePictureAsWithoutAWindow) {
    ASSERT_NO_FATAL_FAILURE(start());
    mouse(900, 700);
    TestEditor twin;
    twin.add_all_samples();
    const ByteImage expected = twin.picture();
    // The pictures and the settings; the panel of passes shows times.
    const auto differing = [&] {
        const ByteImage seen = screen("window_still");
        if (seen.width != kWidth || seen.height != kHeight) return -1;
        int count = 0;
        for (int y = 0; y < 440; ++y)
            for (int x = 0; x < kWidth; ++x)
                for (int c = 0; c < 3; ++c) {
                    const std::size_t at = (std::size_t(y) * kWidth + std::size_t(x)) * 4 + std::size_t(c);
                    if (std::abs(int(seen.data[at]) - int(expected.data[at])) > 2) {
                        ++count;
                        break;
                    }
                }
        return count;
    };
    // A window has its rows in the opposite order: a texel that ends at a pixel's centre may be the neighbour's.
    EXPECT_TRUE(wait_until([&] { return differing() >= 0 && differing() <= 8; })) << differing() << " pixels differ";
}

}  // namespace
}  // namespace si::test
