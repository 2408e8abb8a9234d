// Tests of the front's steps, its knee and the best cases, against brute force and by hand.
#include "renderer/measure/front_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "renderer/measure/frontier_drawing.h"
#include "renderer/measure/shadow_time.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

std::vector<Dot> random_dots(std::mt19937& random, int count) {
    // Few distinct values, so that ties are common.
    std::uniform_int_distribution<int> value(1, 12);
    std::vector<Dot> dots;
    for (int i = 0; i < count; ++i) dots.push_back({double(value(random)), 0.25 * value(random)});
    return dots;
}

/// Returns true when a point is on the strict front and the first of its twins, from the definition.
bool on_front_by_definition(const std::vector<Dot>& dots, std::size_t i) {
    for (std::size_t k = 0; k < dots.size(); ++k) {
        const bool no_worse = dots[k].cost <= dots[i].cost && dots[k].error <= dots[i].error;
        const bool twin = dots[k].cost == dots[i].cost && dots[k].error == dots[i].error;
        if (no_worse && (!twin || k < i)) return false;
    }
    return true;
}

TEST(FrontSteps, FrontIsThatOfTheDefinition) {
    std::mt19937 random(7);
    for (int round = 0; round < 300; ++round) {
        const std::vector<Dot> dots = random_dots(random, 1 + round % 17);
        std::vector<std::size_t> front = strict_front(dots);
        for (std::size_t k = 1; k < front.size(); ++k) {
            EXPECT_LT(dots[front[k - 1]].cost, dots[front[k]].cost);
            EXPECT_GT(dots[front[k - 1]].error, dots[front[k]].error);
        }
        std::ranges::sort(front);
        std::vector<std::size_t> expected;
        for (std::size_t i = 0; i < dots.size(); ++i)
            if (on_front_by_definition(dots, i)) expected.push_back(i);
        EXPECT_EQ(front, expected);
    }
}

TEST(FrontSteps, KneeIsThatOfTheDefinition) {
    std::mt19937 random(11);
    int none = 0;
    for (int round = 0; round < 500; ++round) {
        const std::vector<Dot> dots = random_dots(random, 1 + round % 13);
        std::optional<std::size_t> expected;
        for (std::size_t i = 0; i < dots.size(); ++i) {
            if (!on_front_by_definition(dots, i)) continue;
            bool dearer = false, bought = false;
            for (const Dot& d : dots) {
                dearer = dearer || d.cost > dots[i].cost;
                bought = bought || (d.cost <= 2 * dots[i].cost && d.error <= 0.75 * dots[i].error);
            }
            if (dearer && !bought && (!expected || dots[i].cost < dots[*expected].cost)) expected = i;
        }
        none += !expected;
        EXPECT_EQ(knee_of(dots, strict_front(dots)), expected);
    }
    EXPECT_GT(none, 10) << "sweeps without a knee were tried, too";
}

TEST(FrontSteps, KneeByHand) {
    // 1: 0.1, doubling buys a half; 2: 0.05, doubling buys a tenth; 8: 0.01, four times as dear.
    const std::vector<Dot> dots = {{1, 0.1}, {2, 0.05}, {4, 0.045}, {8, 0.01}, {9, 0.02}};
    EXPECT_EQ(knee_of(dots, strict_front(dots)), 1u);
    const std::vector<Dot> halving = {{1, 0.8}, {2, 0.4}, {4, 0.2}};
    EXPECT_FALSE(knee_of(halving, strict_front(halving))) << "nothing dearer than the best was measured";
    const std::vector<Dot> measured_on = {{1, 0.8}, {2, 0.4}, {4, 0.2}, {5, 0.3}};
    EXPECT_EQ(knee_of(measured_on, strict_front(measured_on)), 2u);
    const std::vector<Dot> perfect = {{1, 0}, {2, 0}};
    EXPECT_EQ(knee_of(perfect, strict_front(perfect)), 0u) << "no error is better than none";
}

TEST(FrontSteps, StepsAreRatiosOfNeighbours) {
    const std::vector<Dot> dots = {{4, 0.01}, {1, 0.1}, {2, 0.04}, {3, 0.5}, {NAN, 0}};
    const std::vector<FrontStep> steps = front_steps(dots, strict_front(dots));
    ASSERT_EQ(steps.size(), 2u);
    EXPECT_EQ(steps[0].from, 1u);
    EXPECT_EQ(steps[0].to, 2u);
    EXPECT_DOUBLE_EQ(steps[0].cost_factor, 2);
    EXPECT_DOUBLE_EQ(steps[0].error_reduction, 0.6);
    EXPECT_DOUBLE_EQ(steps[1].cost_factor, 2);
    EXPECT_DOUBLE_EQ(steps[1].error_reduction, 0.75);
}

TEST(FrontSteps, BestWithinIsTheLeastErrorOfAll) {
    std::mt19937 random(3);
    for (int round = 0; round < 300; ++round) {
        const std::vector<Dot> dots = random_dots(random, 1 + round % 9);
        for (const double limit : {0.5, 3.0, 6.0, 100.0}) {
            double least = INFINITY, cheapest = INFINITY;
            for (const Dot& d : dots)
                if (d.cost <= limit) least = std::min(least, d.error);
            for (const Dot& d : dots)
                if (d.cost <= limit && d.error == least) cheapest = std::min(cheapest, d.cost);
            const auto best = best_within(dots, limit);
            ASSERT_EQ(best.has_value(), std::isfinite(least));
            if (!best) continue;
            EXPECT_EQ(dots[*best].error, least);
            EXPECT_EQ(dots[*best].cost, cheapest);
        }
    }
}

/// Makes a plot of three kernels; the grey one is never on the front.
FrontierPlot three_kernels() {
    FrontierPlot plot{.cost_title = "Time of the shadow", .error_title = "Mean error", .cost_unit = "ms"};
    const auto add = [&](const char* line, int family, double n, double cost, double error) {
        plot.cases.push_back({.of = plot.cases.size(),
                              .line = line,
                              .place = std::to_string(int(n)) + "\u00b2",
                              .along = n,
                              .family = family,
                              .dot = {cost, error, 0.02 * cost, 0}});
    };
    add("Hard", 0, 1024, 4, 0.08);
    add("Hard", 0, 512, 2, 0.16);
    add("Hard", 0, 2048, 12, 0.04);
    add("PCF 3\u00d73", 1, 512, 5, 0.05);
    add("PCF 3\u00d73", 1, 1024, 7, 0.02);
    add("PCF 3\u00d73", 1, 2048, 15, 0.018);
    add("Poisson", 2, 1024, 20, 0.09);
    add("Poisson", 2, 2048, 28, 0.07);
    plot.base_cost = 4;
    plot.base_name = "Hard, 1024\u00b2";
    return plot;
}

TEST(FrontierDrawing, NamesKneeStepsAndBestCases) {
    const FrontierPlot plot = three_kernels();
    const std::string knee = "PCF 3\u00d73, 1024\u00b2: 0.02 for 7 ms; nothing within 2 \u00d7 is a quarter better. ";
    EXPECT_EQ(knee_sentence(plot), knee + "No dearer case is, either.");
    FrontierPlot dearer = plot;
    dearer.cases.back().dot = {.cost = 21, .error = 0.015};
    EXPECT_EQ(knee_sentence(dearer), knee + "The cheapest that is: Poisson, 2048\u00b2, for 3 \u00d7.");
    const std::vector<BestRow> best = best_rows(plot);
    ASSERT_EQ(best.size(), 4u);
    EXPECT_EQ(plot.cases[*best[0].best].name(), "Hard, 1024\u00b2");
    EXPECT_EQ(plot.cases[*best[1].best].name(), "PCF 3\u00d73, 1024\u00b2");
    EXPECT_EQ(plot.cases[*best[2].best].name(), "PCF 3\u00d73, 2048\u00b2");
    EXPECT_EQ(best[3].best, best[2].best) << "more money buys nothing";
    const FrontierDrawing drawing = frontier_drawing(plot, {});
    const auto says = [&](std::string_view text) {
        return std::ranges::any_of(drawing.marks,
                                   [&](const PlotMark& m) { return m.text.find(text) != std::string::npos; });
    };
    for (const char* text :
         {"PCF 3\u00d73, 1024\u00b2", "\u221260 % error", "step: 1.4 \u00d7 cost", "Poisson", "1 \u00d7 base",
          "8 \u00d7 base", "Mean error", "Time of the shadow, ms", "more money buys nothing"})
        EXPECT_TRUE(says(text)) << text;
    EXPECT_EQ(drawing.cases.size(), plot.cases.size());
}

TEST(FrontierDrawing, SentenceOnAKneeWithoutErrorOrCost) {
    FrontierPlot plot{.cost_title = "Time", .error_title = "Mean error", .cost_unit = "ms"};
    const auto add = [&](const char* line, double cost, double error) {
        plot.cases.push_back({.of = plot.cases.size(), .line = line, .place = "", .dot = {cost, error, 0, 0}});
    };
    add("Exact", 5, 0);
    add("Worse", 9, 0.1);
    EXPECT_NE(knee_sentence(plot).find("No dearer case is, either."), std::string::npos) << knee_sentence(plot);
    plot.cases.clear();
    add("Free", 0, 0.1);
    add("Dear", 5, 0.01);
    EXPECT_EQ(knee_sentence(plot).find("inf"), std::string::npos) << knee_sentence(plot);
}

TEST(FrontierDrawing, HasALegend) {
    FrontierPlot plot = three_kernels();
    const auto count = [&](std::string_view text, const PlotPage& page) {
        const FrontierDrawing drawing = frontier_drawing(plot, page);
        return std::ranges::count_if(drawing.marks,
                                     [&](const PlotMark& m) { return m.text.find(text) != std::string::npos; });
    };
    EXPECT_EQ(count("Black steps: the Pareto front", {}), 1);
    EXPECT_EQ(count("Circle:", {}), 1);
    EXPECT_EQ(count("Black steps: the Pareto front", {.titles = false}), 0) << "a small page has no room";
    EXPECT_EQ(count("same cost, \u221238 % error", {}), 0);
    plot.cases[3].dot.cost = 4.05;  // 1.01 of the hard kernel's
    EXPECT_EQ(count("same cost, \u221238 % error", {}), 1);
}

TEST(FrontierDrawing, NamesKneeTableAndLastCaseInACrowd) {
    FrontierPlot plot{.cost_title = "Time", .error_title = "Mean error", .cost_unit = "ms of processor"};
    const auto add = [&](const char* line, const char* place, double along, double cost, double error) {
        plot.cases.push_back({.of = plot.cases.size(),
                              .line = line,
                              .place = place,
                              .along = along,
                              .dot = {.cost = cost, .error = error}});
    };
    for (const auto& [line, costs, errors] :
         {std::tuple("Hard (nearest)", std::array{12.7, 26.8, 70.0}, std::array{0.0283, 0.0223, 0.0195}),
          {"2\u00d72 bilinear", std::array{14.9, 28.4, 74.5}, std::array{0.0263, 0.0173, 0.015}},
          {"PCF 2\u00d72", std::array{16.0, 32.0, 78.0}, std::array{0.0363, 0.021, 0.0137}},
          {"Tent 3\u00d73", std::array{17.0, 33.0, 74.0}, std::array{0.0405, 0.023, 0.0149}},
          {"Shadow-map rays", std::array{66.0, 81.3, 127.0}, std::array{0.025, 0.0136, 0.00895}}})
        for (int i = 0; i < 3; ++i)
            add(line, i == 0 ? "512\u00b2" : i == 1 ? "1024\u00b2" : "2048\u00b2", i, costs[i], errors[i]);
    plot.base_cost = 26.8;
    for (const double width : {640.0, 1000.0}) {
        const FrontierDrawing drawing = frontier_drawing(plot, {.width = width});
        for (const char* text :
             {"Hard (nearest), 512\u00b2 \u2013 knee", "Hard (nearest), 1024\u00b2", "2\u00d72 bilinear, 1024\u00b2",
              "Shadow-map rays, 1024\u00b2", "Shadow-map rays, 2048\u00b2"})
            EXPECT_TRUE(std::ranges::any_of(drawing.marks, [&](const PlotMark& m) { return m.halo && m.text == text; }))
                << text << " at " << width;
    }
}

TEST(FrontierDrawing, MarksTheBaseAndHasTheKneeInTheTable) {
    FrontierPlot plot = three_kernels();
    const auto count = [&](std::string_view text) {
        const FrontierDrawing drawing = frontier_drawing(plot, {});
        return std::ranges::count(drawing.marks, text, &PlotMark::text);
    };
    EXPECT_EQ(count("base"), 1);
    EXPECT_EQ(count("the knee"), 1);
    EXPECT_EQ(count("PCF 3\u00d73, 1024\u00b2"), 2) << "as the knee, and as the best within twice the base's cost";
    plot.base_cost = 1e6;
    EXPECT_EQ(count("base"), 0) << "the axis ends before it";
    plot.base_cost.reset();
    EXPECT_EQ(count("the knee"), 0) << "without a base there is no table";
}

/// A case that the table names can be found in the plot, however small its step.
TEST(FrontierDrawing, NamesTheCasesOfTheTable) {
    FrontierPlot plot = three_kernels();
    plot.cases.clear();
    const auto add = [&](const char* line, double cost, double error) {
        plot.cases.push_back(
            {.of = plot.cases.size(), .line = line, .place = "1024\u00b2", .dot = {.cost = cost, .error = error}});
    };
    plot.base_cost = 1;
    add("Small", 1, 0.100);
    add("Middle", 3, 0.098);
    add("Large", 30, 0.05);
    std::size_t named = 0;
    for (const PlotMark& m : frontier_drawing(plot, {}).marks) named += m.halo && m.text == "Middle, 1024\u00b2";
    EXPECT_EQ(named, 1u);
}

// A step of 2.05 times the cost may gain a quarter beside a knee: "2 x" would contradict the sentence on the knee.
TEST(FrontierDrawing, NamesAKneeAtTheLeftEndAndItsStepWithThreeDigits) {
    FrontierPlot plot{.cases = {}, .spots = {}, .forced = {}, .cost_title = "Time", .error_title = "Mean error"};
    const auto add = [&](const char* place, double cost, double error) {
        plot.cases.push_back({.of = plot.cases.size(),
                              .line = "2\u00d72 bilinear",
                              .place = place,
                              .along = cost,
                              .dot = {.cost = cost, .error = error}});
    };
    add("512\u00b2", 13.25, 0.02625);
    add("1024\u00b2", 27.12, 0.0173);
    add("2048\u00b2", 220, 0.015);
    for (const double width : {640.0, 1000.0}) {
        std::string all;
        for (const PlotMark& m : frontier_drawing(plot, {.width = width}).marks) all += m.text + "\n";
        EXPECT_NE(all.find("512\u00b2 \u2013 knee"), std::string::npos) << all;
        EXPECT_NE(all.find("2.05 \u00d7 cost"), std::string::npos) << all;
    }
}

TEST(FrontierDrawing, StaysOnThePageAndOverlapsNoText) {
    for (const double width : {320.0, 640.0, 1400.0}) {
        PlotPage page{.width = width};
        page.text_width = [](std::string_view text, double size, bool) { return 0.5 * size * double(text.size()); };
        const FrontierDrawing drawing = frontier_drawing(three_kernels(), page);
        std::vector<std::array<double, 4>> boxes;
        for (const PlotMark& m : drawing.marks) {
            if (m.kind != PlotMark::Kind::Text) {
                for (const glm::dvec2& p : m.points) {
                    EXPECT_GE(p.x, 0) << width;
                    EXPECT_LE(p.x, width) << width;
                    EXPECT_LE(p.y, drawing.height) << width;
                }
                continue;
            }
            if (!m.halo) continue;
            const double w = page.text_width(m.text, m.size, m.strong);
            const double left = m.points[0].x - w * 0.5 * double(m.anchor), top = m.points[0].y - 0.8 * m.size;
            EXPECT_GE(left, 0) << m.text;
            EXPECT_LE(left + w, width + 0.01) << m.text;
            for (const auto& b : boxes)
                EXPECT_FALSE(left < b[2] && b[0] < left + w && top < b[3] && b[1] < top + 0.9 * m.size)
                    << m.text << " covers another label at " << width;
            boxes.push_back({left, top, left + w, top + 0.9 * m.size});
        }
    }
}

TEST(FrontierDrawing, NumbersOfTheAxisStayOnThePage) {
    FrontierPlot plot = three_kernels();
    PlotPage page;
    page.text_width = [](std::string_view text, double size, bool) { return 0.6 * size * double(text.size()); };
    for (double most = 800; most < 1300; most += 7) {
        plot.cases.back().dot.cost = most;
        plot.whole = true;
        for (const PlotMark& m : frontier_drawing(plot, page).marks)
            if (m.anchor == PlotMark::Anchor::Middle) {
                EXPECT_LE(m.points[0].x + 0.5 * page.text_width(m.text, m.size, false), page.width + 0.01) << m.text;
            }
    }
}

TEST(FrontierDrawing, WhiskersStandOnlyWhereNoiseOverlaps) {
    FrontierPlot plot = three_kernels();
    const auto whiskers = [&] {
        int count = 0;
        for (const PlotMark& m : frontier_drawing(plot, {}).marks)
            count += m.kind == PlotMark::Kind::Line && m.ink == PlotInk::Text && m.points.size() == 2;
        return count;
    };
    EXPECT_EQ(whiskers(), 0);
    plot.cases[3].dot.cost_noise = 1.5;  // 5 ± 1.5 meets 4 ± 0.08, not 7 ± 0.14
    EXPECT_EQ(whiskers(), 2);
}

TEST(FrontierDrawing, BoundsAreOpenAndHaveNoRatio) {
    FrontierPlot plot = three_kernels();
    plot.cases[1].bound = true;
    EXPECT_EQ(plot_cost_text(plot, 2, true), "< 2 ms");
    std::string all;
    for (const PlotMark& m : frontier_drawing(plot, {}).marks) all += m.text + "\n";
    EXPECT_NE(all.find("< 2 ms"), std::string::npos) << all;
    EXPECT_EQ(all.find("2 \u00d7 cost, \u221250 %"), std::string::npos) << "a ratio to a bound means nothing";
}

TEST(FrontierDrawing, AxesEndBeyondTheFront) {
    FrontierPlot plot = three_kernels();
    plot.cases[7].dot.cost = 1000;
    const FrontierDrawing drawing = frontier_drawing(plot, {});
    EXPECT_EQ(drawing.cases.size(), plot.cases.size() - 1);
    EXPECT_TRUE(std::ranges::any_of(drawing.marks, [](const PlotMark& m) {
        return m.text == "1 case not shown: over 4 \u00d7 the front's largest cost or error";
    }));
    plot.whole = true;
    EXPECT_EQ(frontier_drawing(plot, {}).cases.size(), plot.cases.size());
}

TEST(FrontierDrawing, ALineOfForcedFramesHasTwoPoints) {
    const auto named = [](const FrontierPlot& plot) {
        return std::ranges::any_of(frontier_drawing(plot, {}).marks,
                                   [](const PlotMark& m) { return m.text == "optimisations off"; });
    };
    FrontierPlot plot = three_kernels();
    plot.forced = {{.cost = 4, .error = 0.02}};
    EXPECT_FALSE(named(plot)) << "a name without a line points at nothing";
    plot.forced.push_back({.cost = 6, .error = 0.01});
    EXPECT_TRUE(named(plot));
}

TEST(FrontierDrawing, EmptyPlotsAndSinglesAreDrawn) {
    EXPECT_TRUE(frontier_drawing({}, {}).cases.empty());
    EXPECT_EQ(knee_sentence({}), "");
    FrontierPlot one = three_kernels();
    one.cases.resize(1);
    EXPECT_EQ(knee_sentence(one), "One case: 0.08 for 4 ms.");
    FrontierPlot best_is_dearest = one;
    best_is_dearest.cases.push_back(one.cases[0]);
    best_is_dearest.cases[1].dot = {.cost = 3.9, .error = 0.081};
    best_is_dearest.cases[0].dot = {.cost = 3.9, .error = 0.08};
    EXPECT_EQ(knee_sentence(best_is_dearest).substr(best_is_dearest.cases[0].name().size()),
              ": 0.08 for 3.9 ms; nothing dearer was measured.");
    one.cases[0].dot = {0, 0, 0, 0};
    const FrontierDrawing drawing = frontier_drawing(one, {});
    ASSERT_EQ(drawing.cases.size(), 1u);
    EXPECT_TRUE(std::isfinite(drawing.cases[0].at.x) && std::isfinite(drawing.cases[0].at.y));
}

TEST(ShadowTime, IsTheDifferenceOfAlternatingFrames) {
    // A clock that drifts by 1 ms a frame: with shadows a frame takes 5 ms more.
    int frame = 0;
    std::vector<int> order;
    const auto ms = time_rounds(4, 2, [&](int kind) {
        order.push_back(kind);
        return 20 + ++frame + (kind == 0 ? 5 : 0);
    });
    EXPECT_EQ(order, (std::vector<int>{0, 1, 1, 0, 0, 1, 1, 0}));
    const std::vector<double> shadow = differences(ms[0], ms[1]);
    EXPECT_EQ(shadow, (std::vector<double>{4, 6, 4, 6})) << "drift falls on both orders alike";
    EXPECT_DOUBLE_EQ(spread_of_differences(shadow).median, 5);
}

TEST(ShadowTime, SettingsAreTimedInTurnsUntilAllHaveSettled) {
    // The first settles after kMinBursts bursts, the second after five.
    std::vector<std::size_t> order;
    std::vector<int> bursts(2);
    const std::vector<TurnTimes> times = time_in_turns(2, [&](std::size_t i, TurnTimes& to) {
        order.push_back(i);
        const double far = i == 1 && ++bursts[1] < 5 ? 8 : 0;
        ShadowSamples burst{
            .moving_ms = {10 - far, 10, 10 + far}, .still_ms = {1, 1, 1}, .forced_more_ms = {}, .bursts = {}};
        if (far == 0 && i == 1)
            for (int more = 0; more < 40; ++more) burst.moving_ms.push_back(10);
        to.shadow.add(burst);
        to.frames.total_ms.insert(to.frames.total_ms.end(), 3, 20);
    });
    ASSERT_GE(order.size(), 8u);
    EXPECT_EQ(std::vector<std::size_t>(order.begin(), order.begin() + 8),
              (std::vector<std::size_t>{0, 1, 1, 0, 0, 1, 1, 0}));
    EXPECT_LT(order.size(), 16u) << "ends before the last turn";
    EXPECT_EQ(times[0].shadow.moving_ms.size(), times[0].frames.total_ms.size());
    // Times that never settle end after eight turns.
    int turns = 0;
    time_in_turns(1, [&](std::size_t, TurnTimes& to) {
        to.shadow.add({.moving_ms = {turns % 2 ? 1.0 : 100.0}, .still_ms = {0}, .forced_more_ms = {}, .bursts = {}});
        to.frames.total_ms.push_back(20);
        ++turns;
    });
    EXPECT_EQ(turns, 8);
}

TEST(ShadowTime, TheBaseIsTheHardKernelAt1024Texels) {
    Settings s;
    set_settings(s, base_of_costs());
    EXPECT_EQ(filter_of(s).key, "hard");
    EXPECT_EQ(s.map.resolution, 1024);
}

TEST(ShadowTime, BelowItsNoiseItIsABound) {
    const Spread none = spread_of_differences({-1, 2, -2, 1, 0.5, -0.5});
    EXPECT_TRUE(below_noise(none));
    EXPECT_DOUBLE_EQ(time_or_bound(none), none.median_high);
    EXPECT_GT(time_or_bound(none), 0);
    const Spread clear = spread_of_differences({5, 5.2, 4.8, 5.1, 4.9});
    EXPECT_FALSE(below_noise(clear));
    EXPECT_DOUBLE_EQ(time_or_bound(clear), 5);
    EXPECT_DOUBLE_EQ(time_ratio(clear, spread_of_differences({10, 10, 10})), 0.5);
    EXPECT_TRUE(std::isnan(time_ratio(none, clear))) << "no ratio within the noise";
    EXPECT_TRUE(std::isnan(time_ratio(clear, none)));
    EXPECT_TRUE(below_noise(spread_of_differences({3}))) << "one pair says nothing of its noise";
}

TEST(ShadowTime, NegativeIntervalsStayNegative) {
    const std::vector<std::size_t> bursts = {0, 2, 4};
    const Spread s = spread_of_differences({-3, -3, -2, -2, -1, -1}, bursts);
    EXPECT_DOUBLE_EQ(s.median, -2);
    EXPECT_LT(s.median_low, -2);
    EXPECT_NEAR(s.noise(), 4.303 * 1 / std::sqrt(3.0), 1e-9) << "Student's t of three bursts, 1 ms apart";
}

TEST(ShadowTime, BurstsUnderAStillLightAreCountedByThemselves) {
    ShadowSamples samples;
    samples.add({.moving_ms = {5, 5}, .still_ms = {1, 1}, .forced_more_ms = {2}, .bursts = {}});
    samples.add({.moving_ms = {6, 6, 6}, .still_ms = {}, .forced_more_ms = {}, .bursts = {}});
    samples.add({.moving_ms = {7}, .still_ms = {3}, .forced_more_ms = {}, .bursts = {}});
    EXPECT_EQ(samples.bursts, (std::vector<std::size_t>{0, 2, 5}));
    EXPECT_EQ(samples.still_bursts, (std::vector<std::size_t>{0, 2}));
    const ShadowTime time = summarise_shadow(samples);
    EXPECT_EQ(time.moving_ms.bursts, 3);
    EXPECT_EQ(time.still_ms.bursts, 2);
    EXPECT_DOUBLE_EQ(time.still_ms.median, 1);
    EXPECT_NEAR(time.still_ms.noise(), 12.706, 1e-9) << "Student's t of two bursts, 2 ms apart";
}

TEST(ShadowTime, SettlesByItsShareOrTheFrames) {
    ShadowSamples samples;
    for (int burst = 0; burst < 3; ++burst)
        samples.add({.moving_ms = {10, 10.1, 9.9}, .still_ms = {1, 1, 1}, .forced_more_ms = {}, .bursts = {}});
    EXPECT_EQ(samples.bursts, (std::vector<std::size_t>{0, 3, 6}));
    EXPECT_TRUE(shadow_settled(samples, 10));
    ShadowSamples wild;
    for (int burst = 0; burst < 3; ++burst)
        wild.add({.moving_ms = {1.0 + burst}, .still_ms = {1}, .forced_more_ms = {}, .bursts = {}});
    EXPECT_FALSE(shadow_settled(wild, 10));
    EXPECT_TRUE(shadow_settled(wild, 1000)) << "within 2 % of the frame";
    EXPECT_FALSE(shadow_settled({}, 1000));
}

}  // namespace
}  // namespace si
