// Tests of the frontier panel over made-up cases: requests, clicks on dots, layout.
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "app/sweep/measured_cases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/idle_reason.h"
#include "renderer/settings/param.h"
#include "tests/ui/ui_harness.h"
#include "ui/state/playback.h"

namespace si::test {
namespace {

/// Makes three cases, the last one dominated, with the present settings between them.
SweepFacts made_up_sweep() {
    SweepFacts facts;
    facts.columns = measured_columns();
    std::vector<SweepRow> rows;
    const auto numbers = [](double ms, double mae) {
        CaseNumbers n{.error = CaseErrors{}, .time = TimeMeasurement{}};
        n.error->metrics.mae = mae;
        n.error->metrics.signed_mean = -0.5 * mae;
        n.time->total_ms = {.median = ms, .p95 = ms, .median_low = ms - 0.1, .median_high = ms + 0.1};
        return n;
    };
    const auto add = [&](const char* kernel, double ms, double mae) {
        rows.push_back({.number = rows.size(),
                        .settings = {{"filter.kernel", kernel}, {"map.resolution", "1024"}},
                        .numbers = numbers(ms, mae)});
    };
    add("hard", 2, 0.08);
    add("pcf5", 8, 0.01);
    add("pcf3", 9, 0.05);
    for (const SweepRow& row : rows) facts.cases.push_back(measured_case(row));
    facts.total = rows.size();
    facts.software = true;
    const CaseNumbers present = numbers(4, 0.04);
    facts.present = measured_case(present);
    facts.view = frontier_view(rows, &present, "time.total_ms.median", "error.mae");
    return facts;
}

/// Returns the centres of the filled shapes of this colour in the last frame, one for each run of vertices.
std::vector<glm::vec2> dots_of_colour(ImU32 colour) {
    std::vector<glm::vec2> dots;
    const ImDrawData* data = ImGui::GetDrawData();
    const ImVec2 white = ImGui::GetIO().Fonts->TexUvWhitePixel;
    for (int i = 0; i < data->CmdListsCount; ++i) {
        glm::vec2 sum{0};
        int run = 0;
        for (const ImDrawVert& v : data->CmdLists[i]->VtxBuffer) {
            const bool filled = v.uv.x == white.x && v.uv.y == white.y;  // glyphs and lines have other places
            if (v.col == colour && filled) {
                sum += glm::vec2(v.pos.x, v.pos.y);
                ++run;
                continue;
            }
            // The fringe of a shape is transparent: its vertices alternate with the filled ones.
            if ((v.col & ~IM_COL32_A_MASK) == (colour & ~IM_COL32_A_MASK) && v.col >> IM_COL32_A_SHIFT == 0) continue;
            if (run >= 3) dots.push_back(sum / float(run));
            sum = {};
            run = 0;
        }
        if (run >= 3) dots.push_back(sum / float(run));
    }
    return dots;
}

struct Panel {
    UiHarness ui;
    explicit Panel(int width = 1280, int height = 720, float scale = 1) : ui(width, height, scale) {
        ui.sweep = made_up_sweep();
        ui.state.window.open_page = Page::Frontier;
        ui.frames(4);
    }
};

/// Returns the place of the dot of "pcf5", the front's most accurate case.
glm::vec2 accurate_dot() {
    const auto& c = plot_colour(family_ink(1)).on_dark;
    const std::vector<glm::vec2> dots = dots_of_colour(IM_COL32(c[0], c[1], c[2], 255));
    EXPECT_FALSE(dots.empty()) << "no dot of the family is drawn";
    const auto lowest = std::ranges::max_element(dots, {}, &glm::vec2::y);
    return lowest == dots.end() ? glm::vec2(0) : *lowest;
}

TEST(FrontierPanel, ClickOnADotAppliesItsSettingsAndIsUndone) {
    Panel p;
    ASSERT_TRUE(p.ui.state.shows(Page::Frontier));
    const Settings before = p.ui.state.settings;
    p.ui.click(accurate_dot());
    p.ui.frames(3);
    EXPECT_EQ(kernel_label(p.ui.state.settings), "PCF 5×5");
    EXPECT_EQ(p.ui.state.settings.map.resolution, 1024);
    EXPECT_EQ(p.ui.state.sweep.chosen, 1);
    undo(p.ui.state);
    EXPECT_EQ(p.ui.state.settings, before) << "one step of undo takes it back";
}

TEST(FrontierPanel, TooltipsShowTheSignOfTheMeanError) {
    Panel p;
    p.ui.move(accurate_dot());
    p.ui.frames(3);
    EXPECT_TRUE(p.ui.drawn().shows(U"Meansignederror(+toolight):−0.005"));
}

TEST(FrontierPanel, AdviceNamesTheCostOfABetterDot) {
    Panel p;
    const FrontierAdvice& advice = p.ui.sweep->view.advice;
    ASSERT_TRUE(advice.better);
    EXPECT_EQ(p.ui.sweep->cases[p.ui.sweep->view.marks[*advice.better].of].settings[0].second, "pcf5");
    EXPECT_DOUBLE_EQ(advice.extra_cost, 4);
    EXPECT_FALSE(advice.cheaper);
    EXPECT_TRUE(p.ui.sweep->view.marks[0].on && p.ui.sweep->view.marks[1].on && !p.ui.sweep->view.marks[2].on);
}

TEST(FrontierPanel, ComparesTwoDotsByCostAndError) {
    Panel p(1600, 900);
    SweepFacts& facts = *p.ui.sweep;
    EXPECT_FALSE(p.ui.drawn().shows("Before"));
    const auto compared = [&](const Dot& before, const Dot& now) {
        facts.before = facts.present;
        facts.view.before = before;
        facts.view.present = now;
        facts.change = "Kernel: PCF -> Poisson disk";
        p.ui.frames(2);
        return [&](const char* text) { return p.ui.drawn().shows(text); };
    };
    const Dot dear{.cost = 8, .error = 0.02, .cost_noise = 0.1, .error_noise = 0};
    const Dot cheap{.cost = 4, .error = 0.04, .cost_noise = 0.1, .error_noise = 0};
    const auto shows = compared(cheap, dear);
    EXPECT_TRUE(shows("Now 0.02 at 8 ms"));
    EXPECT_TRUE(shows("Before 0.04 at 4 ms."));
    EXPECT_TRUE(shows("Kernel: PCF -> Poisson disk: 50 % less error for 100 % more time"));
    compared(dear, cheap);
    EXPECT_TRUE(shows("100 % more error for 50 % less time"));
    Dot alike = dear;
    alike.cost += 0.15;
    compared(dear, alike);
    EXPECT_TRUE(shows("the same error for the same time"));
    Dot noisy = cheap;
    noisy.cost_noise = 6;
    compared(noisy, dear);
    for (const char* part : {"50 % less error; the", "differs by less than", "6.1 ms)"})
        EXPECT_TRUE(shows(part)) << part;
    facts.before_is_pinned = true;
    compared(cheap, dear);
    EXPECT_TRUE(shows("A 0.04 at 4 ms."));
    facts.measuring_present = true;
    p.ui.frames(2);
    EXPECT_FALSE(shows("A 0.04 at 4 ms.")) << "what is not measured is not compared";
}

TEST(FrontierPanel, BytesHaveReadableUnits) {
    Panel p(1600, 900);
    SweepFacts& facts = *p.ui.sweep;
    facts.cost = "cost.bytes_touched";
    const double costs[] = {17.3e6, 67.7e6, 8e6};
    ASSERT_EQ(facts.view.marks.size(), std::size(costs));
    for (std::size_t i = 0; i < std::size(costs); ++i) {
        facts.view.marks[i].dot.cost = costs[i];
        facts.view.marks[i].dot.cost_noise = 0;
        facts.view.plot.cases.at(i).dot.cost = costs[i];
    }
    facts.view.plot.bytes = true;
    facts.view.present->cost = 25.1e6;
    facts.view.present->cost_noise = 0;
    facts.view.advice.better = 1;
    facts.view.advice.extra_cost = 42.6e6;
    facts.view.advice.cheaper = 0;
    facts.view.advice.saved_cost = 7.78e6;
    p.ui.frames(3);
    const DrawnText& drawn = p.ui.drawn();
    EXPECT_TRUE(drawn.shows("Now 0.04 at 24 MiB"));
    EXPECT_TRUE(drawn.shows("The next better costs +41 MiB"));
    EXPECT_TRUE(drawn.shows(U"Thesameerrorfor−7.4MiB"));
    EXPECT_TRUE(drawn.find(U"16MiB") && drawn.find(U"32MiB")) << "numbers of the axis";
    EXPECT_FALSE(drawn.shows("e+0"));
}

TEST(FrontierPanel, MissingMeasurementsAreNamedInASentence) {
    Panel p(1600, 900);
    p.ui.sweep->cost = "cost.bytes_touched";
    p.ui.sweep->running = true;
    p.ui.frames(3);
    EXPECT_TRUE(p.ui.drawn().shows("Not measured yet: time of the shadow while the light moves"));
    p.ui.sweep->running = false;
    p.ui.frames(3);
    EXPECT_TRUE(p.ui.drawn().shows("Not measured: time of the shadow while the light moves"));
    EXPECT_TRUE(p.ui.drawn().find(U"×", 1)) << "one between width and height, one for each axis";
}

TEST(FrontierPanel, ErrorIsShownBeforeItsTimeIsMeasured) {
    Panel p(1600, 900);
    SweepFacts& facts = *p.ui.sweep;
    facts.view.present.reset();
    facts.measuring_present = true;
    p.ui.frames(2);
    EXPECT_TRUE(p.ui.drawn().shows("Now 0.04;"));
    facts.present.reset();
    p.ui.frames(2);
    EXPECT_TRUE(p.ui.drawn().shows("Measuring the present settings"));
    p.ui.sweep = made_up_sweep();
    p.ui.sweep->measuring_present = p.ui.sweep->present_is_old = true;
    p.ui.frames(2);
    EXPECT_TRUE(p.ui.drawn().shows("Before 0.04 at 4 ms")) << "what is measured is not what is shown";
    EXPECT_FALSE(p.ui.drawn().shows("Now 0.04"));
}

TEST(FrontierPanel, RequestsASweepOfTheTypedAxes) {
    Panel p;
    p.ui.state.sweep.axes = {{"bias.slope", "0:2:0.5"}};
    p.ui.state.sweep.width = 96;
    p.ui.state.sweep.height = 64;
    const auto press_sweep = [&] {
        p.ui.frames(2);
        // The button stands below the heading of the light path and the line with "Vary another".
        std::optional<SweepRequest> request;
        for (float y = 570; y < 660 && !request; y += 6) {
            p.ui.move({60, y});
            p.ui.frames(2);
            request = p.ui.click_here().start_sweep;
        }
        return request;
    };
    const auto request = press_sweep();
    ASSERT_TRUE(request);
    ASSERT_FALSE(request->axes.empty());
    EXPECT_EQ(request->axes[0], "bias.slope=0:2:0.5");
    EXPECT_EQ(request->width, 96);
    EXPECT_EQ(request->height, 64);
    p.ui.state.sweep.axes = {{"bias.slope", "nonsense"}};
    EXPECT_FALSE(press_sweep()) << "values that are none cannot be swept";
}

TEST(FrontierPanel, RunningSweepCanBeCancelled) {
    Panel p;
    p.ui.sweep->running = true;
    p.ui.sweep->progress = 0.4;
    p.ui.sweep->seconds_left = 75;
    p.ui.state.sweep.axes = {{"bias.slope", "0,1"}};
    bool cancelled = false;
    for (float y = 570; y < 660 && !cancelled; y += 6) {
        p.ui.move({30, y});
        p.ui.frames(2);
        const EditorRequests requests = p.ui.click_here();
        cancelled = requests.cancel_sweep;
        EXPECT_FALSE(requests.start_sweep);
    }
    EXPECT_TRUE(cancelled);
}

TEST(FrontierPanel, CurrentSettingsAreMeasuredOnlyWhileShown) {
    Panel p;
    EXPECT_TRUE(p.ui.frame().want_present);
    p.ui.state.sweep.follow = false;
    EXPECT_FALSE(p.ui.frame().want_present);
    p.ui.state.sweep.follow = true;
    p.ui.state.window.open_page = Page::Log;
    p.ui.frames(3);
    EXPECT_FALSE(p.ui.frame().want_present);
}

TEST(FrontierPanel, FitsAtEverySizeWithEveryState) {
    for (const auto& [width, height, scale] : {std::tuple{1280, 720, 1.0f}, {1600, 900, 1.0f}, {3840, 2160, 2.0f}}) {
        Panel p(width, height, scale);
        for (int variant = 0; variant < 5; ++variant) {
            SweepFacts facts = made_up_sweep();
            if (variant == 1) {
                facts.running = true;
                facts.seconds_left = 3000;
            }
            if (variant == 2) {
                facts.view.present.reset();
                facts.present_problem = "there is no such light";
            }
            if (variant == 3) {
                facts.other_settings = {"Slope: 0 to 1 texels"};
                facts.problem = "the disk is full";
            }
            if (variant == 4) facts = SweepFacts{.columns = measured_columns()};
            p.ui.sweep = facts;
            p.ui.frames(3);
            bool seen = false;
            for (const ImGuiWindow* w : ImGui::GetCurrentContext()->Windows) {
                const std::string_view name(w->Name);
                const bool plot = name.find("plot and advice") != std::string_view::npos;
                if (!w->WasActive || (!plot && name.find("controls") == std::string_view::npos)) continue;
                seen = true;
                EXPECT_LE(w->ContentSize.x, w->InnerRect.GetWidth() + 1) << name << " at " << width << ", " << variant;
                if (!plot || height < 720 || variant == 3) continue;  // messages may be scrolled to
                EXPECT_LE(w->ContentSize.y, w->InnerRect.GetHeight() + 1) << name << " at " << width << ", " << variant;
            }
            EXPECT_TRUE(seen);
        }
    }
}

TEST(FrontierPanel, NarrowWindowHasTheControlsAboveThePlot) {
    for (const int width : {640, 900}) {
        Panel p(width, 900);
        bool seen = false;
        for (const ImGuiWindow* w : ImGui::GetCurrentContext()->Windows) {
            const std::string_view name(w->Name);
            if (!w->WasActive) continue;
            EXPECT_EQ(name.find("/controls_"), std::string_view::npos) << width;
            if (name.find("plot and advice") == std::string_view::npos) continue;
            seen = true;
            EXPECT_GE(w->Size.x, 0.9f * w->ParentWindow->InnerRect.GetWidth()) << width;
            EXPECT_GE(w->Size.y, 200) << width;
            EXPECT_LE(w->ContentSize.x, w->InnerRect.GetWidth() + 1) << width;
            EXPECT_LE(w->ParentWindow->ContentSize.x, w->ParentWindow->InnerRect.GetWidth() + 1) << width;
            EXPECT_GT(w->ParentWindow->ScrollMax.y, 0) << "the rest is scrolled to, at " << width;
        }
        EXPECT_TRUE(seen);
        EXPECT_TRUE(p.ui.drawn().shows("Vary another")) << width;
    }
}

TEST(FrontierDefaults, VarySettingsThatHaveAnEffect) {
    for (const AxisText& axis : SweepPanel{}.axes)
        EXPECT_EQ(idle_reason(Settings{}, *find_setting(axis.key)), "") << axis.key;
}

}  // namespace
}  // namespace si::test
