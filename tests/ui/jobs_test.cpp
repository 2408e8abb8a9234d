// Tests of user tasks in a real window, with today's number of presses as the limit. A double click counts
// two, a drag or a held key one, a word or a path one, turns of the wheel none.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <utility>

#include "renderer/base/lengths_text.h"
#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/settings/overlays.h"
#include "tests/support/process.h"
#include "tests/ui/drawn_text.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/window_fixture.h"
#include "tests/unit/gltf_test_file.h"
#include "ui/state/light_list.h"
#include "ui/state/selection.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class WindowJobs : public Window {
protected:
    void TearDown() override { editor_.reset(); }

    /// Starts the window and its twin: an editor without a window that receives the same events by press() and
    /// turn_wheel() and shows the same scene.
    /// @param sets further settings, "KEY=VALUE"
    void begin(const std::string& scene = "boxes", std::vector<std::string> sets = {}) {
        std::vector<std::string> arguments = {"--size", "1280x720", "--set", "view.smooth=false"};
        for (const std::string& set : sets) arguments.insert(arguments.end(), {"--set", set});
        ASSERT_NO_FATAL_FAILURE(start(arguments, scene));
        sets.emplace_back("view.smooth=false");
        editor_ = std::make_unique<TestEditor>(editor_options(scene, sets));
        text_ = std::make_unique<DrawnText>();
        editor_->settle();
        beginning_ = editor_->model().state.settings;
        saved();
        fs::copy_file(folder_ / "preset.json", folder_ / "beginning.json", fs::copy_options::overwrite_existing);
    }

    EditorState& twin() { return editor_->model().state; }

    /// Runs a task, counts its presses and restores everything.
    void job(const char* name, int presses, const std::function<void()>& done) {
        SCOPED_TRACE(name);
        presses_ = 0;
        done();
        EXPECT_EQ(presses_, presses);
        if (HasFailure()) screen(std::string("job_") + name);
        keys("Escape");
        wait_until_idle();
        keys("Escape");
        wait_until_idle();
        fs::copy_file(folder_ / "beginning.json", folder_ / "preset.json", fs::copy_options::overwrite_existing);
        open_preset("preset.json");
        twin().settings = beginning_;
        twin().probe_pixel.reset();
        twin().window.open_page = Page::Settings;
        twin().layout.strip_open = false;
        keys("ctrl+1");
        wait_until_idle();
        twin_draws();
    }
    /// Draws until positions (two frames) and pictures (one more) are stable.
    void twin_draws() { editor_->frames(4); }
    /// Prepares a task; not counted.
    void open_preset(const std::string& name) {
        keys("ctrl+o");
        wait_until_idle();
        type(name);
        keys("Return");
        wait_until_idle();
    }

    void key(const std::string& combination) {
        ++presses_;
        keys(combination);
        wait_until_idle();
    }
    void word(const std::string& text) {
        ++presses_;
        type(text);
    }
    void press(glm::ivec2 at, int button = 1) {
        ++presses_;
        mouse(at.x, at.y);
        const std::string which = std::to_string(button);
        xdotool("mousedown " + which);
        wait_until_idle();
        xdotool("mouseup " + which);
        wait_until_idle();
        auto& hand = editor_->mouse;
        hand.at = glm::vec2(at);
        editor_->frames(2);
        (button == 1 ? hand.left : hand.right) = true;
        editor_->frames(2);
        hand.left = hand.right = false;
        twin_draws();
    }
    void pull(glm::ivec2 from, glm::ivec2 by) {
        ++presses_;
        drag(from.x, from.y, by.x, by.y);
        std::vector<glm::vec2> positions;
        for (int i = 0; i <= 3; ++i) positions.emplace_back(from + by * i / 3);
        editor_->drag(positions);
        editor_->frame();
    }
    /// Returns the position of a text in the twin, given without spaces.
    glm::ivec2 place(std::u32string_view text, int which = 0) {
        const auto at = text_->find(text, which);
        if (!at) {
            ADD_FAILURE() << "not on the screen: " << std::string(text.begin(), text.end());
            return {1, 1};
        }
        return {int(at->x), int(at->y)};
    }
    void press(std::u32string_view text, int which = 0) { press(place(text, which)); }
    /// Scrolls the settings until they show the `which`-th text of its kind; none: back to the top.
    void turn_wheel(std::u32string_view text, int which = 0, bool up = false) {
        const glm::ivec2 over = {kWidth - 40, kHeight - 160};
        mouse(over.x, over.y);
        editor_->mouse.at = glm::vec2(over);
        twin_draws();
        if (text.empty()) {
            xdotool("click --repeat 60 --delay 5 4");
            editor_->mouse.wheel = 60;
            twin_draws();
        }
        for (int i = 0; i < 40 && !text.empty() && !text_->find(text, which); ++i) {
            xdotool(up ? "click 4" : "click 5");
            editor_->mouse.wheel = up ? 1 : -1;
            editor_->frame();
            editor_->frame();
        }
        wait_until_idle();
    }
    /// Waits until window and twin have measured the present settings in the panel Frontier.
    void measured() {
        editor_->settle();
        ASSERT_TRUE(editor_->model().facts().sweep->view.present) << editor_->model().facts().sweep->present_problem;
        const glm::ivec2 said = place(U"Now");
        EXPECT_TRUE(wait_until([&] { return written_at(said); })) << "the window measures nothing";
    }
    /// Returns whether the window has letters near a position.
    bool written_at(glm::ivec2 at) const {
        const ByteImage image = screen("job_written");
        int bright = 0;
        for (int y = std::max(at.y - 6, 0); y < std::min(at.y + 6, image.height); ++y)
            for (int x = std::max(at.x - 20, 0); x < std::min(at.x + 20, image.width); ++x)
                bright += image.data[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4] >
                          200;  // muted text is darker
        return bright > 20;
    }
    /// Loads the preset that the window saved last into the twin.
    void twin_opens(const std::string& name) {
        editor_->model().open(folder_ / name);
        editor_->settle();
    }
    /// Acts in the twin alone and waits for all results; not counted.
    void twin_key(char letter) {
        bool& down = ImGui::GetIO().KeysDown[int(letter)];
        down = true;
        editor_->frame();
        down = false;
        editor_->settle();
        for (int i = 0; i < 20 && twin().artefact_tour.waits_for != 0; ++i) editor_->settle();
        editor_->settle();
    }
    /// Returns the twin's verdict on the probed pixel.
    std::string verdict() {
        const std::span<const PixelDiagnosis> diagnoses = editor_->model().facts().diagnoses;
        return diagnoses.empty() ? std::string() : diagnoses.front().verdict;
    }
    /// Returns whether the window shows the twin's pixels around a text.
    bool reads_as_twin(std::u32string_view text) {
        const auto at = text_->find(text);
        const ByteImage seen = screen("job_reads"), meant = editor_->picture();
        if (!at || seen.width != meant.width || seen.height != meant.height) return false;
        const glm::ivec2 middle(int(at->x), int(at->y)), reach(3 * int(text.size()), 6);  // within all of its letters
        int all = 0, others = 0;
        for (int y = std::max(middle.y - reach.y, 0); y < std::min(middle.y + reach.y, seen.height); ++y)
            for (int x = std::max(middle.x - reach.x, 0); x < std::min(middle.x + reach.x, seen.width); ++x) {
                const std::size_t i = (std::size_t(y) * std::size_t(seen.width) + std::size_t(x)) * 4;
                bool other = false;
                for (std::size_t c = 0; c < 3; ++c)
                    other |= std::abs(int(seen.data[i + c]) - int(meant.data[i + c])) > 40;
                ++all;
                others += other;
            }
        return others < all / 50;
    }
    /// Returns the centre of an object in the picture.
    glm::ivec2 object(const std::string& path) {
        const Bounds b = bounds_of(*editor_->model().facts().scene, path);
        const auto at = twin().viewport.view->point(b.centre());
        return at ? glm::ivec2(*at) : glm::ivec2(1);
    }
    int presses_ = 0;
    Settings beginning_;
    std::unique_ptr<TestEditor> editor_;
    std::unique_ptr<DrawnText> text_;
};

/// Writes a map of the scene boxes, as another engine may store it, and the matrix of its light beside it.
void write_foreign_map(const fs::path& folder) {
    const ProcessResult drawn =
        run_program({"render", "boxes", "-o", "theirs.pfm", "--size", "64x64", "--view", "shadow-map", "--report",
                     "drawn.json", "--set", "view.map=raw", "--set", "map.resolution=256"},
                    folder);
    ASSERT_EQ(drawn.code, 0) << drawn.err;
    const json rows = json::parse(file_bytes(folder / "drawn.json"))["fit"][0]["matrices"]["clip_from_world"];
    json by_columns;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) by_columns.push_back(rows[row][column]);
    std::ofstream(folder / "light.json") << json{{"clip_from_world", by_columns}};
}

constexpr glm::ivec2 kSliderFromLabel{200, 0};  ///< from a setting's label to its slider

TEST_F(WindowJobs, ChangeShadowsLightsAndSettings) {
    ASSERT_NO_FATAL_FAILURE(begin("boxes", {"bias.kind=constant", "bias.constant=2"}));
    const json before = saved();

    job("undo", 2, [&] {
        const glm::ivec2 bias = place(U"Constantbias") + kSliderFromLabel, scene = object("Boxes/Flat");
        for (const glm::ivec2 by : {glm::ivec2(40, 0), glm::ivec2(-20, 0)}) {
            pull(bias, by);
            pull(scene, {30, 8});
        }
        const json dragged = saved();
        EXPECT_NE(dragged.value("bias.constant", 0.0), before.value("bias.constant", 0.0)) << dragged;
        EXPECT_TRUE(dragged.contains("camera.source")) << dragged;
        presses_ = 0;  // presses that the undo takes back
        press(U"History");
        press(U"thebeginning");
        EXPECT_EQ(saved(), before);
    });
    job("round_trip", 3, [&] {
        key("ctrl+s");
        pull(place(U"Constantbias") + kSliderFromLabel, {50, 0});
        key("ctrl+r");
        EXPECT_EQ(saved(), before);
        keys("ctrl+z");
        wait_until_idle();
        EXPECT_NE(saved(), before) << "nothing was dragged";
        keys("ctrl+y");
        EXPECT_EQ(saved(), before);
    });
    job("who_casts", 6, [&] {
        for (const char* path : {"Boxes/Hovering", "Boxes/Tower"}) {
            press(object(path), 3);
            press(U"Casts");
        }
        const json silent = saved();
        for (const char* path : {"Boxes/Hovering", "Boxes/Tower"})
            EXPECT_EQ(silent.value("object." + std::string(path) + ".cast", true), false) << silent;
        press(object("Boxes/Tower"), 3);  // where the last one was
        press(U"Letallcast");
        EXPECT_EQ(saved(), before);
    });
    job("resolution_and_quads", 2, [&] {
        key("bracketleft");
        const glm::ivec2 at = object("Boxes/Tower");
        mouse(at.x, at.y);
        key("q");
        const json after = saved();
        EXPECT_EQ(after.value("map.resolution", 0), 1024);
        EXPECT_EQ(after.value("view.slabs", "none"), "both") << after;
    });
    job("spot_light", 5, [&] {
        key("t");
        EXPECT_EQ(saved().value("light.type", ""), "spot");
        twin().settings.lights[0].type = LightType::Spot;
        editor_->settle();
        turn_wheel(U"Coneblend");
        pull(place(U"Cone") + kSliderFromLabel, {-60, 0});
        EXPECT_TRUE(saved().contains("light.cone")) << saved();
        key("shift+l");
        EXPECT_EQ(saved().value("camera.source", ""), "light");
        key("shift+l");
        EXPECT_NE(saved().value("camera.source", ""), "light");
        const auto status = [&] { return screen("job_spot").data; };
        const auto live = status();
        key("k");
        EXPECT_NE(status(), live) << "nothing says that the view is frozen";
        keys("k");
        wait_until_idle();
        turn_wheel({});
    });
    job("two_filters", 3, [&] {
        press(U"Cost");
        measured();
        turn_wheel(U"PCF");
        press(U"PCF");
        press(U"Poissondisk");
        EXPECT_EQ(saved().value("filter.kernel", ""), "poisson");
        measured();
        const FrontierView& view = editor_->model().facts().sweep->view;
        ASSERT_TRUE(view.present && view.before);
        EXPECT_GT(view.before->error, 0);
        EXPECT_GT(view.before->cost, 0);
        EXPECT_NE(view.present->error, view.before->error);
        EXPECT_EQ(editor_->model().facts().sweep->change, "Kernel: PCF \u2192 Poisson disk");
        // Window and twin show both with errors, times and the comparison.
        for (const char32_t* part : {U"Now", U"Before", U"Kernel:PCF\u2192Poissondisk:", U"error", U"time"})
            EXPECT_TRUE(text_->find(part)) << "not said";
        const glm::ivec2 said = place(U"Before");
        EXPECT_TRUE(wait_until([&] { return written_at(said); })) << "the window says nothing of it";
        turn_wheel({});
    });
    job("three_lights", 6, [&] {
        for (int i = 0; i < 2; ++i) {
            turn_wheel(U"Addlight");
            press(U"Addlight");
        }
        const json all = saved();
        EXPECT_EQ(all.value("light.count", 0), 3);
        for (int shown = 0; shown < 3; ++shown) {
            turn_wheel({});
            turn_wheel(U"Solo", shown);
            press(U"Solo", shown);
            const json solo = saved();
            for (int i = 0; i < 3; ++i)
                EXPECT_EQ(solo.value(i == 0 ? "light.on" : "light." + std::to_string(i) + ".on", true), i == shown)
                    << solo;
        }
        turn_wheel({});
        turn_wheel(U"Solo", 2);
        press(U"Solo", 2);
        EXPECT_EQ(saved(), all);
        turn_wheel({});
    });
    job("window_and_its_size", 3, [&] {
        ++presses_;  // drag of the window's edge
        ASSERT_TRUE(xdotool("search --name 'Shadow Inspector' windowsize 1000 600"));
        mouse(200, 300);
        const auto corner = [&] {  // the menu's
            const ByteImage image = screen("job_window");
            std::vector<std::uint8_t> out;
            for (std::size_t y = 0; y < 36; ++y)
                out.insert(out.end(), &image.data[y * kWidth * 4], &image.data[y * kWidth * 4 + 4 * 400]);
            return out;
        };
        const auto all = corner();
        key("F11");
        EXPECT_NE(corner(), all);
        key("F11");
        EXPECT_EQ(corner(), all);
        xdotool("search --name 'Shadow Inspector' windowsize 1280 720");
        wait_until_idle();
    });
    quit();
}

TEST_F(WindowJobs, OpenModelsAndPresetsAndUseKeys) {
    ASSERT_EQ(run_program({"export", "boxes", "-o", (folder_ / "mine.glb").string()}).code, 0);
    std::ofstream(folder_ / "far.json")
        << R"({"format": "shadow-inspector-preset", "version": 3, "scene": "boxes", "settings": {"bias.kind": "constant", "bias.constant": 60}})";
    ASSERT_NO_FATAL_FAILURE(write_foreign_map(folder_));
    std::ofstream(folder_ / "leaf.glb", std::ios::binary) << falling_leaf(10, {0, 0, 0}, {1, 1, 0});
    ASSERT_NO_FATAL_FAILURE(begin());
    // The fix is applied once the reference is traced, however early the key was pressed.
    const auto fixed = [&](const std::string& file, const auto& is_so) {
        return wait_until([&] { return is_so(saved(file)); });
    };
    const auto toured = [&](const std::string& file, const json& from) {
        return wait_until([&] {
            return saved(file).value("camera.azimuth", 1e9) != from.value("camera.azimuth", 1e9) ||
                   saved(file).value("camera.target_x", 1e9) != from.value("camera.target_x", 1e9);
        });
    };
    // A kind that computes its own need is a bias without amounts.
    const auto biased = [](const json& s) {
        return s.value("bias.kind", "adaptive") != "constant" || s.value("bias.constant", 0.0) > 0 ||
               s.value("bias.slope", 0.0) > 0 || s.value("bias.normal", 0.0) > 0;
    };

    job("peter_panning", 2, [&] {
        open_preset("far.json");
        const json from = saved("far.json");
        twin_opens("far.json");
        key("x");
        EXPECT_TRUE(toured("far.json", from));
        twin_key('X');
        EXPECT_TRUE(verdict().starts_with("peter-panning: bias moves it")) << verdict();
        EXPECT_TRUE(wait_until([&] { return reads_as_twin(U"peter-panning:biasmovesit"); })) << "the window says less";
        key("c");
        EXPECT_TRUE(fixed("far.json", [](const json& s) { return s.value("bias.constant", 0.0) < 60; }));
        twin_key('C');
        EXPECT_EQ(saved("far.json").value("bias.constant", 0.0), twin().settings.bias.constant);
        EXPECT_TRUE(verdict().starts_with("correct: in shadow, as in the reference")) << verdict();
        EXPECT_TRUE(wait_until([&] { return reads_as_twin(U"correct:inshadow"); })) << "the window says less";
    });
    job("own_model", 6, [&] {
        key("ctrl+o");
        word((folder_ / "mine.glb").string());
        key("Return");
        EXPECT_TRUE(shows("mine.glb")) << log();
        key("u");
        const json bare = saved();
        EXPECT_FALSE(biased(bare)) << bare;
        key("x");
        EXPECT_TRUE(toured("preset.json", bare));
        key("c");
        EXPECT_TRUE(fixed("preset.json", biased));
    });
    job("keyboard_only", 9, [&] {
        key("u");
        json from = saved();
        EXPECT_FALSE(biased(from)) << from;
        EXPECT_EQ(from.value("bias.constant", 0.0), 0) << from;
        for (int i = 0; i < 3; ++i) {
            key("x");
            EXPECT_TRUE(toured("preset.json", from)) << "cluster " << i;
            from = saved();
        }
        key("c");
        EXPECT_TRUE(fixed("preset.json", biased));
        key("ctrl+s");
        key("4");
        from = saved();
        EXPECT_EQ(from.value("view.overlay", ""), overlays()[3].key);
        twin_opens("preset.json");
        key("k");
        twin_key('K');
        EXPECT_TRUE(twin().frozen);
        constexpr std::u32string_view kFrozen = U"Shadowcamerafrozen";
        EXPECT_TRUE(wait_until([&] { return reads_as_twin(kFrozen); })) << "nothing says that the view is frozen";
        key("f");
        const json framed = saved();
        EXPECT_NE(framed, from);
        const glm::dvec3 middle = editor_->model().facts().scene->bounds.centre();
        EXPECT_NEAR(framed.value("camera.target_x", 0.0), middle.x, 1e-3);
        EXPECT_NEAR(framed.value("camera.target_y", 0.0), middle.y, 1e-3);
        EXPECT_NEAR(framed.value("camera.target_z", 0.0), middle.z, 1e-3);
        EXPECT_TRUE(reads_as_twin(kFrozen)) << "the camera went on, and the shadows' stays";
        keys("k");
        wait_until_idle();
        EXPECT_FALSE(reads_as_twin(kFrozen));
        twin().frozen.reset();
    });
    job("guided_presets", 2, [&] {
        const json own = saved();
        key("Next");
        EXPECT_TRUE(wait_until([&] { return saved() != own; }));
        const json first = saved();
        EXPECT_EQ(first.value("bias.normal", 0.0), 0) << first;
        key("Next");
        EXPECT_TRUE(wait_until([&] { return saved() != first; }));
    });
    job("animation", 6, [&] {
        const std::string leaf = (folder_ / "leaf.glb").string();
        key("ctrl+o");
        word(leaf);
        key("Return");
        EXPECT_TRUE(shows("leaf.glb")) << log();
        ++presses_;
        const double before = program_->cpu_seconds();
        keys("space");
        wait_until([&] { return program_->cpu_seconds() > before + 0.5; });  // it draws during playback
        key("space");
        EditorRequests open;
        open.load_scene = leaf;
        editor_->model().fulfil(open);
        editor_->settle();
        const double paused = saved().value("scene.time", 0.0);
        EXPECT_GT(paused, 0);
        pull(place(U"Loop") - glm::ivec2(500, 0), {60, 0});
        EXPECT_NE(saved().value("scene.time", paused), paused);
    });
    job("foreign_map", 5, [&] {
        key("ctrl+o");
        word((folder_ / "theirs.pfm").string());
        key("Return");
        wait_until_idle();
        key("Return");  // the light's file beside it, compared with the shown scene
        // The readings are tried in the background, and a press before they are offered does nothing: it is repeated
        // and counted once.
        ++presses_;
        EXPECT_TRUE(wait_until([&] {
            keys("Return");
            wait_until_idle();
            return titled("theirs.bundle") || !program_->running();
        })) << log();
    });
    quit();
}

TEST_F(WindowJobs, SearchImproveAndExport) {
    ASSERT_NO_FATAL_FAILURE(begin("boxes", {"filter.kernel=evsm4"}));
    const json before = saved();

    job("light_bleeding", 3, [&] {
        key("ctrl+f");
        word("lightBleedReduction");  // the word of other engines
        twin().settings_panel.search = "lightBleedReduction";
        twin_draws();
        pull(place(U"Light-bleedreduction") + kSliderFromLabel, {40, 0});
        EXPECT_GT(saved().value("filter.bleed", 0.0), before.value("filter.bleed", 0.0)) << saved();
        // Taken back; not counted.
        key("ctrl+f");
        keys("ctrl+a BackSpace Escape");
        wait_until_idle();
        twin().settings_panel.search.clear();
        presses_ = 3;
    });
    job("compare_with_reference", 1, [&] {
        const auto picture = [&] { return screen("job_compare").data; };
        const auto alone = picture();
        key("b");
        EXPECT_TRUE(wait_until([&] { return picture() != alone; })) << "nothing is compared";
        for (int i = 0; i < 3; ++i) keys("b");
        wait_until_idle();
    });
    job("plots_below", 2, [&] {
        const auto upper = [&] {  // part of the picture
            const ByteImage image = screen("job_plots");
            return std::vector<std::uint8_t>(&image.data[kWidth * 4 * 120], &image.data[kWidth * 4 * 121 - 4 * 400]);
        };
        mouse(1270, 4);
        const auto closed = upper();
        key("j");
        EXPECT_EQ(upper(), closed);
        key("j");
        EXPECT_EQ(upper(), closed);
    });
    job("bundle", 3, [&] {
        const fs::path file = folder_ / "frame.bundle";
        key("ctrl+e");
        word(file.string());
        key("Return");
        EXPECT_TRUE(wait_until([&] { return fs::exists(file); })) << log();
    });
    job("engine_code", 5, [&] {
        const fs::path file = folder_ / "code.txt";
        press(U"File");
        press(U"Convert\u2026");
        wait_until_idle();
        editor_->frames(6);
        press(U"pathofthefiletowrite");
        word(file.string());
        key("Return");
        EXPECT_TRUE(wait_until([&] { return fs::exists(file); })) << log();
        editor_->key(ImGui::GetKeyIndex(ImGuiKey_Escape));
    });
    quit();
}

TEST_F(WindowJobs, LeastBiasIsSeenBeforeItIsTaken) {
    ASSERT_NO_FATAL_FAILURE(begin("boxes", {"bias.kind=constant", "bias.constant=0", "bias.normal=0"}));
    const json before = saved();
    job("auto_bias", 2, [&] {
        press(U"Autobias");
        editor_->settle();
        editor_->frames(6);
        EXPECT_EQ(saved(), before) << "nothing is taken yet";
        // While it measures, other letters are where the button will be.
        EXPECT_TRUE(wait_until([&] { return reads_as_twin(U"Take"); })) << "nothing is offered";
        press(U"Take");
        EXPECT_TRUE(wait_until([&] { return saved() != before; })) << "nothing was taken";
        EXPECT_NE(twin().settings, beginning_);
    });
    quit();
}

TEST_F(WindowJobs, BrowseMeasureAndReport) {
    ASSERT_NO_FATAL_FAILURE(begin("boxes", {"bias.kind=constant", "bias.constant=0"}));
    // Menus and dialogs that a key has closed in the window are closed in the twin, too.
    const auto twin_escapes = [&] { editor_->key(ImGui::GetKeyIndex(ImGuiKey_Escape)); };

    job("pin_and_compare", 3, [&] {
        key("p");
        pull(place(U"Constantbias") + kSliderFromLabel, {60, 0});
        // Part of the picture with the ground, whose stripes go.
        const auto ground = [&] {
            const ByteImage image = screen("job_pin");
            const std::size_t row = kWidth * 4 * 420;
            return std::vector<std::uint8_t>(&image.data[row], &image.data[row + 4 * 600]);
        };
        mouse(1270, 4);
        wait_until_idle();
        const auto now = ground();
        ++presses_;
        xdotool("keydown a");
        EXPECT_TRUE(wait_until([&] { return ground() != now; })) << "A is not shown";
        xdotool("keyup a");
        EXPECT_TRUE(wait_until([&] { return ground() == now; })) << "A stays";
        keys("p");
        wait_until_idle();
    });
    job("save_error", 4, [&] {
        const fs::path file = folder_ / "error.json";
        press(U"Error");
        editor_->settle();
        press(U"Save\u2026");
        word(file.string());
        key("Return");
        EXPECT_TRUE(wait_until([&] { return fs::exists(file); })) << log();
        EXPECT_TRUE(json_of(file)["error"].contains("mae")) << json_of(file);
        twin_escapes();
    });
    job("light_path", 4, [&] {
        const double before = saved().value("light.azimuth", -1e9);
        press(U"Cost");
        press(U"Lightpath");
        press(U"Measurethepath");
        editor_->settle();
        twin_draws();
        const glm::ivec2 worst = place(U"Gototheworst");
        EXPECT_TRUE(wait_until([&] { return reads_as_twin(U"Gototheworst"); })) << "no path is shown";
        pull(worst + glm::ivec2(0, 50), {120, 0});
        EXPECT_NE(saved().value("light.azimuth", -1e9), before);
    });
    job("report", 4, [&] {
        const fs::path page = folder_ / "page.html";
        press(U"File");
        press(U"Report\u2026");
        editor_->frames(6);
        word(page.string());
        key("Return");
        EXPECT_TRUE(wait_until([&] { return fs::exists(page); })) << log();
        EXPECT_NE(file_bytes(page).find("Content-Security-Policy"), std::string::npos);
        twin_escapes();
    });
    job("gallery", 3, [&] {
        const json own = saved();
        press(U"Guidedpresets");
        word("peter panning");
        key("Return");
        EXPECT_TRUE(wait_until([&] { return saved() != own; })) << "no preset was opened";
        twin_escapes();
    });
    job("hard_pair", 4, [&] {
        press(U"Hardcases");
        word("grazing");
        key("Return");
        EXPECT_TRUE(wait_until([&] { return titled("grazing"); })) << log();
        EXPECT_EQ(saved().value("bias.kind", "adaptive"), "constant");
        key("Next");
        EXPECT_TRUE(wait_until([&] { return saved().value("bias.kind", "adaptive") == "adaptive"; }))
            << "Page down shows no fixed twin";
        twin_escapes();
    });
    quit();
}

TEST_F(WindowJobs, DragTheEndOfACascade) {
    ASSERT_NO_FATAL_FAILURE(begin("landscape", {"light.fit=view", "light.cascades=3", "view.overlay=cascade"}));
    job("cascade_bar", 1, [&] {
        const Settings& s = twin().settings;
        const FittedLight* const light = shown_fitted_light(s, *editor_->model().facts().result);
        ASSERT_TRUE(light && light->chooser.spans.size() == 3u);
        // The number ends at the end of its cascade.
        const std::string text = metres_text(light->chooser.spans[1].ends);
        std::u32string letters;
        std::ranges::copy_if(text, std::back_inserter(letters), [](char c) { return c != ' '; });
        const float half = 0.5f * text_width(text, theme::small());
        const double before = saved().value("light.split_2", -1.0);
        int last = 0;  // the legend has the same number
        while (text_->find(letters, last + 1)) ++last;
        pull(place(letters, last) + glm::ivec2(int(half), -12), {-60, 0});
        const json dragged = saved();
        EXPECT_EQ(dragged.value("light.split", ""), "manual") << dragged;
        EXPECT_NE(dragged.value("light.split_2", -1.0), before) << dragged;
    });
    quit();
}

}  // namespace
}  // namespace si::test
