// Tests of cross-section drawings: separate and readable texts, and SVG that is XML.
#include "renderer/inspect/section_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "app/report/section_svg.h"
#include "tests/support/strict_xml.h"

namespace si {
namespace {

/// Returns a cross-section with acne on a plane of 45 degrees and ten texels of 40 mm, made by hand.
Section acne() {
    Section s;
    s.shadowed = true;
    s.classified = true;
    s.cut = {.axis = 0, .first = 100, .count = 10, .reach_texels = 1.5};
    s.row = 7;
    s.lookup_texel = 104;
    s.texel_m = 0.04;
    s.lit = false;
    s.visibility = 0.25;
    s.theta_rad = M_PI / 4;
    s.artefact = "acne";
    s.verdict = "acne: needs 0.6 texels of bias here, has 0.1 texels";
    s.surface_along = glm::dvec2(1, 1) / std::sqrt(2.0);
    for (int i = 0; i < 10; ++i) {
        const double x = (i - 4.7) * 0.04, y = x + 0.02;
        s.steps.push_back({.texel = 100 + i,
                           .from = {x, y},
                           .to = {x + 0.04, y},
                           .compared_from = {x, 0.004},
                           .compared_to = {x + 0.04, 0.004},
                           .weight = i > 2 && i < 6 ? 0.25 : 0,
                           .lit = i < 4,
                           .meets = KernelTap::Meets::Own});
    }
    s.compared = {0, 0.004};
    s.terms = {{"constant bias", {0.001, 0.1, 0.004}, {0, 0}, {0, 0.004}}};
    s.least = {0.006, 0.6, 0.024};
    s.has = {0.001, 0.1, 0.004};
    s.window_from = 0.024;
    s.has_window = true;
    s.profile = {{{-0.2, -0.2}, {0.2, 0.2}}};
    return s;
}

/// Returns a cross-section whose bias has shifted the compared point past a box 0.3 m above, which fills the map to the
/// right.
Section peter_panning() {
    Section s = acne();
    s.lit = true;
    s.reference_lit = false;
    s.visibility = 1;
    s.artefact = "peter-panning";
    s.verdict = "peter-panning: bias moves it past its occluder";
    for (Section::Step& step : s.steps) {
        step.lit = true;
        step.compared_from.y = step.compared_to.y = 0.4;
        if (step.texel >= 104) {
            step.from.y = step.to.y = 0.3;
            step.meets = KernelTap::Meets::Nearer;
        }
    }
    s.compared = {0, 0.4};
    s.terms = {{"constant bias", {0.1, 10, 0.4}, {0, 0}, {0, 0.4}}};
    s.occluder = glm::dvec2(0, 0.3);
    s.occluder_m = 0.3;
    s.window_to = 0.3;
    return s;
}

/// Returns a cross-section whose normal offset leads the look-up two and a half texels aside; one tap hits another
/// surface.
Section offset_look_up() {
    Section s = acne();
    s.artefact = "peter-panning (normal offset)";
    s.moved = {0.1, 0.06};
    s.normal_offset_m = std::hypot(0.1, 0.06);
    s.lookup_texel = 107;
    s.compared = {0.1, 0.064};
    s.terms = {{"constant bias", {0.001, 0.1, 0.004}, s.moved, s.compared}};
    s.steps[4].lit = true;
    s.steps[5].meets = KernelTap::Meets::Nearer;
    return s;
}

Section light_bleeding() {
    Section s = acne();
    s.lit = true;
    s.reference_lit = false;
    s.visibility = 0.66;
    s.artefact = "leak";
    for (Section::Step& step : s.steps) step.weight = 0;
    s.moments = Section::Moments{.mean = 0.15, .spread = 0.1, .bound = 0.66};
    return s;
}

/// Returns the texts of the legend.
std::vector<std::string> legend_texts(const SectionDrawing& d) {
    std::vector<std::string> out;
    for (const LegendRow& row : d.legend) out.emplace_back(row.text);
    return out;
}

/// Returns the first mark of a kind and ink; null without one.
const Mark* mark_of(const SectionDrawing& d, Mark::Kind kind, Ink ink) {
    const auto found = std::ranges::find_if(d.marks, [&](const Mark& m) { return m.kind == kind && m.ink == ink; });
    return found == d.marks.end() ? nullptr : &*found;
}

bool legend_has(const SectionDrawing& d, std::string_view text) {
    return std::ranges::any_of(d.legend, [&](const LegendRow& row) { return row.text == text; });
}

double luminance(const std::array<std::uint8_t, 3>& rgb) {
    double sum = 0;
    const double weights[] = {0.2126, 0.7152, 0.0722};
    for (std::size_t i = 0; i < 3; ++i) {
        const double c = rgb[i] / 255.0;
        sum += weights[i] * (c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return sum;
}

double contrast(const std::array<std::uint8_t, 3>& a, const std::array<std::uint8_t, 3>& b) {
    const double x = luminance(a), y = luminance(b);
    return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

TEST(SectionDrawing, TextIsReadableOnBothBackgrounds) {
    for (const bool captions : {false, true})
        for (const Mark& m : draw_section(acne(), {.captions = captions}).marks) {
            if (m.kind != Mark::Kind::Text) continue;
            const InkColour &ink = ink_colour(m.ink), &paper = ink_colour(Ink::Paper);
            EXPECT_GE(contrast(ink.on_light, paper.on_light), 4.5) << ink.key;
            EXPECT_GE(contrast(ink.on_dark, paper.on_dark), 4.5) << ink.key;
        }
}

TEST(SectionDrawing, TextDoesNotOverlapAndStaysInside) {
    Section crowded = acne();
    // All parts at one height.
    crowded.window_from = 0.005;
    crowded.window_to = 0.0052;
    crowded.has_window = true;
    crowded.occluder = glm::dvec2(0, 0.0051);
    crowded.occluder_m = 0.0051;
    crowded.moved = {0.02, 0.004};
    crowded.normal_offset_m = 0.0204;
    for (const Section& s : {acne(), crowded})
        for (const double height : {560.0, 260.0, 140.0}) {
            const bool captions = height > 500;
            SCOPED_TRACE(height);
            const SectionPage page{.width = 900, .height = height, .captions = captions};
            const SectionDrawing d = draw_section(s, page);
            std::vector<std::array<double, 4>> boxes;
            for (const Mark& m : d.marks) {
                if (m.kind != Mark::Kind::Text) continue;
                const double width = 0.54 * page.em * double(m.text.size());
                const double x = m.points[0].x - (m.anchor == Mark::Anchor::End ? width : 0), y = m.points[0].y;
                const std::array<double, 4> box{x, y - 0.75 * page.em, x + width, y};
                EXPECT_GE(box[0], 0) << m.text;
                EXPECT_LE(box[2], d.width) << m.text;
                EXPECT_GE(box[1], 0) << m.text;
                EXPECT_LE(box[3], d.height) << m.text;
                for (const auto& other : boxes)
                    EXPECT_FALSE(box[0] < other[2] && other[0] < box[2] && box[1] < other[3] && other[1] < box[3])
                        << m.text << " lies over other words";
                boxes.push_back(box);
            }
            EXPECT_GT(boxes.size(), 6u);
            for (const char* wanted : {"surface, 45", "compared: ", s.occluder ? "occluder" : ""})
                EXPECT_TRUE(std::ranges::any_of(d.marks, [&](const Mark& m) { return m.text.starts_with(wanted); }))
                    << wanted << " is not said";
        }
}

TEST(SectionDrawing, NarrowDrawingBreaksItsWords) {
    for (const Section& s : {acne(), peter_panning(), offset_look_up()})
        for (const double width : {480.0, 360.0, 330.0}) {
            SCOPED_TRACE(width);
            const SectionPage page{.width = width, .height = 0.75 * width, .em = 13, .captions = false};
            const SectionDrawing d = draw_section(s, page);
            std::string said;
            for (const Mark& m : d.marks) {
                if (m.kind != Mark::Kind::Text) continue;
                EXPECT_LE(m.points[0].x + 0.54 * page.em * double(m.text.size()), d.width) << m.text;
                EXPECT_LE(m.points[0].y, d.height) << m.text;
                said += m.text + " ";
            }
            const char* const scale = std::abs(d.along / d.across - 1) < 1e-9 ? "to scale" : "depth drawn";
            for (const char* wanted : {"surface, 45° from the light", "compared: ", scale, "taps in this row"})
                EXPECT_NE(said.find(wanted), std::string::npos) << wanted << " is not said: " << said;
        }
}

TEST(SectionDrawing, LegendListsExactlyTheDrawnMarks) {
    using enum Mark::Kind;
    const std::set<std::pair<Mark::Kind, Ink>> legended{
        {Line, Ink::Step},         {Area, Ink::Shade}, {Line, Ink::Surface}, {Line, Ink::Plane},
        {Line, Ink::ComparedLit},  {Area, Ink::Lit},   {Area, Ink::Window},  {Line, Ink::Moments},
        {Line, Ink::ComparedDark}, {Area, Ink::Dark},  {Area, Ink::Self},    {Area, Ink::NoWindow},
        {Area, Ink::Moments},
    };
    Section untraced = acne();
    untraced.profile.clear();
    untraced.classified = untraced.has_window = false;
    Section hopeless = acne();
    hopeless.window_to = 0.01;
    Section no_map;
    std::set<std::pair<Mark::Kind, Ink>> seen;
    for (const Section& s : {acne(), peter_panning(), offset_look_up(), light_bleeding(), untraced, hopeless, no_map})
        for (const bool captions : {false, true}) {
            SCOPED_TRACE((s.artefact.empty() ? "no artefact" : s.artefact) + (captions ? ", captions" : ""));
            const SectionDrawing d = draw_section(s, {.captions = captions});
            auto end = d.marks.end();
            if (captions && !d.legend.empty()) {
                const auto first_words =
                    std::ranges::find_if(d.marks, [&](const Mark& m) { return m.text == d.legend[0].text; });
                ASSERT_NE(first_words, end);
                end = first_words - 1;  // the swatch
            }
            std::set<std::pair<Mark::Kind, Ink>> drawn, listed;
            for (auto m = d.marks.begin(); m != end; ++m)
                if (legended.contains({m->kind, m->ink})) drawn.emplace(m->kind, m->ink);
            for (const LegendRow& row : d.legend) EXPECT_TRUE(listed.emplace(row.kind, row.ink).second) << row.text;
            EXPECT_EQ(drawn, listed);
            seen.insert(listed.begin(), listed.end());
            // Swatch and text of each row in turn, and of no other.
            for (const LegendRow& row : d.legend) {
                if (!captions) break;
                EXPECT_TRUE(row.explains(*end) && end->dashed == row.dashed) << row.text;
                EXPECT_EQ((++end)->text, row.text);
                ++end;
            }
            if (captions && !d.legend.empty()) {
                EXPECT_TRUE(end->text.starts_with("Cut along")) << end->text;
            }
        }
    EXPECT_EQ(seen, legended) << "each row is tested";
}

TEST(SectionDrawing, LegendDescribesTheProbedPixel) {
    const SectionDrawing dark = draw_section(acne(), {});
    EXPECT_EQ(
        legend_texts(dark),
        (std::vector<std::string>{"stored depths, one step per texel", "in shadow, by the map",
                                  "first surface from the light, by rays", "the surface's plane",
                                  "compared with the texel's depth: lit", "compared with the texel's depth: in shadow",
                                  "right depth biases", "tap lit", "tap in shadow by the surface itself"}));
    EXPECT_EQ(legend_texts(draw_section(acne(), {.height = 300, .captions = false})), legend_texts(dark))
        << "the same words";
    const SectionDrawing shifted = draw_section(peter_panning(), {});
    EXPECT_TRUE(legend_has(shifted, "tap lit"));
    EXPECT_FALSE(legend_has(shifted, "tap in shadow") || legend_has(shifted, "tap in shadow by the surface itself"));
    EXPECT_TRUE(legend_has(draw_section(offset_look_up(), {}), "tap in shadow"));
    Section s = light_bleeding();
    const SectionDrawing spread = draw_section(s, {});
    EXPECT_TRUE(legend_has(spread, "mean of the depths"));
    EXPECT_TRUE(legend_has(spread, "one standard deviation to each side of the mean"));
    EXPECT_FALSE(legend_has(spread, "tap lit") || legend_has(spread, "compared with the texel's depth: lit"));
    s.moments->spread = std::numeric_limits<double>::quiet_NaN();
    const SectionDrawing mean = draw_section(s, {});
    EXPECT_TRUE(legend_has(mean, "mean of the depths"));
    EXPECT_FALSE(legend_has(mean, "one standard deviation to each side of the mean"));
}

TEST(SectionDrawing, HoveredMarkIsFoundInTheLegend) {
    SectionDrawing d;
    d.legend = {{Mark::Kind::Line, Ink::Step, false, "step"},
                {Mark::Kind::Area, Ink::Shade, false, "shade"},
                {Mark::Kind::Area, Ink::Window, false, "window"}};
    const auto square = [](double x, double y, double size) {
        return std::vector<glm::dvec2>{{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
    };
    d.marks = {{.kind = Mark::Kind::Area, .ink = Ink::Shade, .points = square(0, 0, 100)},
               {.kind = Mark::Kind::Line, .ink = Ink::Grid, .points = {{10, 0}, {10, 100}}},
               {.kind = Mark::Kind::Line, .ink = Ink::Step, .points = {{0, 50}, {100, 50}}},
               {.kind = Mark::Kind::Area, .ink = Ink::Window, .points = square(20, 70, 10)},
               {.kind = Mark::Kind::Line, .ink = Ink::Bias, .points = {{80, 0}, {80, 100}}},
               {.kind = Mark::Kind::Dot, .ink = Ink::Text, .points = {{60, 20}}, .width = 6},
               {.kind = Mark::Kind::Text, .ink = Ink::Step, .points = {{40, 20}}, .text = "label"}};
    const auto at = [&](double x, double y) {
        const LegendRow* row = legend_row_at(d, {x, y}, 7);
        return row ? row->text : "";
    };
    EXPECT_EQ(at(10, 44), "step") << "near enough, and texels' sides do not count";
    EXPECT_EQ(at(10, 42), "shade");
    EXPECT_EQ(at(25, 75), "window") << "over the shade";
    EXPECT_EQ(at(40, 20), "shade");
    EXPECT_EQ(at(82, 20), "") << "an arrow that a label names";
    EXPECT_EQ(at(82, 51), "step") << "nearer than the arrow";
    EXPECT_EQ(at(60, 30), "") << "the dot";
    EXPECT_EQ(at(106, 50), "step") << "beside its end";
    EXPECT_EQ(at(108, 50), "");
    EXPECT_EQ(at(60, 120), "");
}

TEST(SectionDrawing, PositionsMatchTheSection) {
    const Section s = acne();
    const SectionDrawing d = draw_section(s, {.height = 640});
    EXPECT_FALSE(d.broken);
    EXPECT_NEAR(d.along, d.across, 1e-9) << "to scale: as high as wide";
    int found = 0;
    for (const Section::Step& step : s.steps) {
        const glm::dvec2 a{d.zero_x + step.from.x * d.across, d.zero_y - step.from.y * d.along};
        const glm::dvec2 b{d.zero_x + step.to.x * d.across, d.zero_y - step.to.y * d.along};
        found += std::ranges::any_of(d.marks, [&](const Mark& m) {
            return m.kind == Mark::Kind::Line && m.ink == Ink::Step && glm::length(m.points.front() - a) < 1e-6 &&
                   glm::length(m.points.back() - b) < 1e-6;
        });
    }
    EXPECT_GE(found, 3) << "each step that the page holds, where it lies";
}

/// Returns the centres of the lines that mark the ends of the bias window, the near one first, relative to the ring.
std::vector<glm::dvec2> ends_of_window(const SectionDrawing& d) {
    std::vector<glm::dvec2> out;
    for (const Mark& m : d.marks)
        if (m.kind == Mark::Kind::Line && (m.ink == Ink::Window || m.ink == Ink::NoWindow))
            out.push_back(0.5 * (m.points[0] + m.points[1]) - glm::dvec2(d.zero_x, d.zero_y));
    return out;
}

const Mark* words_of(const SectionDrawing& d, std::string_view text) {
    const auto m = std::ranges::find(d.marks, text, &Mark::text);
    return m == d.marks.end() ? nullptr : &*m;
}

/// Returns the note and the other muted texts.
std::string muted_words(const SectionDrawing& d) {
    std::string out;
    for (const Mark& m : d.marks)
        if (m.kind == Mark::Kind::Text && m.ink == Ink::Muted) out += m.text + " ";
    return out;
}

TEST(SectionDrawing, BiasWindowIsNextToTheRingAlongItsRay) {
    Section right = offset_look_up();
    right.artefact.clear();
    Section slanted = acne();
    slanted.light_ray = glm::normalize(glm::dvec2(0.3, 1));
    for (Section s : {acne(), offset_look_up(), right, slanted}) {
        s.window_to = 0.05;
        SCOPED_TRACE(s.artefact + (s.light_ray.x > 0 ? ", slanted" : ""));
        const SectionPage page{.height = 640};
        const SectionDrawing d = draw_section(s, page);
        ASSERT_FALSE(d.broken);
        const Mark* ring = mark_of(d, Mark::Kind::Dot, Ink::Text);
        ASSERT_TRUE(ring);
        EXPECT_NEAR(glm::length(ring->points[0] - glm::dvec2(d.zero_x, d.zero_y)), 0, 1e-9);
        const std::vector<glm::dvec2> ends = ends_of_window(d);
        ASSERT_EQ(ends.size(), 2u);
        for (const auto& [end, metres] : {std::pair{ends[0], s.window_from}, {ends[1], s.window_to}}) {
            EXPECT_NEAR(end.x + 0.75 * page.em, metres * s.light_ray.x * d.across, 1e-6);
            EXPECT_NEAR(-end.y, metres * s.light_ray.y * d.along, 1e-6);
        }
        EXPECT_TRUE(words_of(d, "needs 0.6 texels of bias"));
        // The bar between the two lines.
        const Mark* bar = mark_of(d, Mark::Kind::Area, Ink::Window);
        ASSERT_TRUE(bar);
        const auto [top, bottom] = std::ranges::minmax(bar->points, {}, [](const glm::dvec2& p) { return p.y; });
        EXPECT_NEAR(top.y - d.zero_y, ends[1].y, 1e-6);
        EXPECT_NEAR(bottom.y - d.zero_y, ends[0].y, 1e-6);
    }
}

TEST(SectionDrawing, EquivalentBiasOfAnOffsetIsMarked) {
    EXPECT_FALSE(words_of(draw_section(acne(), {}), "has 0.1 texels")) << "that is the disk's height";
    Section s = offset_look_up();
    s.has = {0.005, 0.5, 0.02};
    const SectionDrawing d = draw_section(s, {});
    EXPECT_TRUE(words_of(d, "has 0.5 texels"));
    EXPECT_TRUE(std::ranges::any_of(d.marks, [&](const Mark& m) {
        return m.kind == Mark::Kind::Line && m.ink == Ink::Bias && m.points[0].y == m.points[1].y &&
               std::abs(d.zero_y - m.points[0].y - 0.02 * d.along) < 1e-6;
    }));
}

TEST(SectionDrawing, TexelBarHasTheWidthOfTexels) {
    Section aslant = acne();
    aslant.texel_long_m = 0.05;
    for (const Section& s : {acne(), aslant}) {
        const SectionDrawing d = draw_section(s, {});
        const auto scale = std::ranges::find_if(
            d.marks, [](const Mark& m) { return m.ink == Ink::Muted && m.text.find(" = ") != std::string::npos; });
        ASSERT_NE(scale, d.marks.end());
        const std::vector<glm::dvec2>& bar = (scale - 1)->points;
        EXPECT_NEAR((bar.back().x - bar.front().x) / std::stod(scale->text),
                    (s.steps[4].to.x - s.steps[4].from.x) * d.across, 1e-6);
        const bool noted = muted_words(d).find("as bias counts them, texels are 50 mm long") != std::string::npos;
        EXPECT_EQ(noted, s.texel_long_m > 0);
        EXPECT_EQ(words_of(d, "needs 0.6 texels = 24 mm") != nullptr, s.texel_long_m > 0);
    }
}

TEST(SectionDrawing, ArrowHasTheLengthOfItsLabel) {
    Section leaves = offset_look_up();
    leaves.normal_offset_m = 0.15;
    leaves.surface_offset_texels = 2.35;
    leaves.surface_at = {0, -0.08};
    for (const Section& s : {offset_look_up(), leaves}) {
        const SectionDrawing d = draw_section(s, {});
        const Mark* arrow = mark_of(d, Mark::Kind::Line, Ink::Offset);
        ASSERT_TRUE(arrow);
        const glm::dvec2 way = (arrow->points[1] - arrow->points[0]) / glm::dvec2(d.across, d.along);
        EXPECT_NEAR(glm::length(way), std::hypot(0.1, 0.06), 1e-9);
        const bool in_cut = s.surface_offset_texels == 0;
        EXPECT_EQ(words_of(d, "normal offset 117 mm") != nullptr, in_cut);
        EXPECT_EQ(words_of(d, "offset 117 mm in the cut") != nullptr, !in_cut);
    }
}

TEST(SectionDrawing, SurfaceOffTheCutHasItsOwnPlaneAndANote) {
    Section s = offset_look_up();
    s.row_offset_texels = 0.49;
    const auto planes = [](const SectionDrawing& d) {
        std::vector<const Mark*> out;
        for (const Mark& m : d.marks)
            if (m.kind == Mark::Kind::Line && m.ink == Ink::Plane) out.push_back(&m);
        return out;
    };
    const SectionDrawing inside = draw_section(s, {.captions = false});
    EXPECT_EQ(planes(inside).size(), 1u);
    EXPECT_EQ(muted_words(draw_section(s, {})).find("surface itself"), std::string::npos);

    s.surface_offset_texels = -7.32;
    s.surface_at = {0, -0.08};
    s.normal_offset_m = 0.15;
    const SectionDrawing beside = draw_section(s, {.captions = false});
    ASSERT_EQ(planes(beside).size(), 2u);
    const Mark& own = *planes(beside)[1];
    const glm::dvec2 way = own.points[1] - own.points[0];
    const glm::dvec2 middle = 0.5 * (own.points[0] + own.points[1]);
    EXPECT_NEAR(middle.x, beside.zero_x, 1e-6) << "through the ring";
    EXPECT_NEAR(middle.y, beside.zero_y, 1e-6);
    EXPECT_NEAR(way.y / way.x, -beside.along / beside.across, 1e-6) << "parallel";
    const std::string noted = muted_words(draw_section(s, {}));
    for (const char* part : {"0.49 texels off the cut", "7.32 texels off the cut", "150 mm", "117 mm", "dashes"})
        EXPECT_NE(noted.find(part), std::string::npos) << part << " in: " << noted;
}

TEST(SectionDrawing, FarPartsAreDrawnAfterABreak) {
    Section s = acne();
    s.occluder = glm::dvec2(0, 7.5);
    s.occluder_m = 7.5;
    s.reference_lit = false;
    const SectionDrawing d = draw_section(s, {});
    EXPECT_TRUE(d.broken);
    EXPECT_TRUE(std::ranges::any_of(d.marks, [](const Mark& m) { return m.text == "occluder 7.5 m nearer"; }));
    for (const Mark& m : d.marks)
        for (const glm::dvec2& p : m.points)
            EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && p.x >= 0 && p.y >= 0 && p.x <= d.width &&
                        p.y <= d.height);
}

TEST(SectionSvg, IsWellFormedForAnyText) {
    Section s = acne();
    s.verdict = "<script>&amp; a & b \"quoted\" 'too' \x01 \xff \xef\xbf\xbf ]]> 0.5\xc2\xb0";
    const std::string svg = section_svg(draw_section(s, {}), s.verdict + " </title>");
    EXPECT_EQ(test::xml_fault(svg), "");
    EXPECT_EQ(svg.find("<script>"), std::string::npos);
    EXPECT_EQ(svg.find("href"), std::string::npos) << "nothing from elsewhere";
    EXPECT_EQ(svg, section_svg(draw_section(s, {}), s.verdict + " </title>"));
    EXPECT_NE(svg.find("prefers-color-scheme:dark"), std::string::npos);
    Section none;
    none.verdict = "lit: no map";
    EXPECT_EQ(test::xml_fault(section_svg(draw_section(none, {}), "none")), "");
}

TEST(SectionSvg, XmlCheckFindsErrors) {
    for (const char* bad : {"<a>", "<a></b>", "<a b=c/>", "<a b=\"1\" b=\"2\"/>", "<a>&nbsp;</a>", "<a>&</a>",
                            "<a/><b/>", "<a b=\"<\"/>", "<a>]]></a>", "<a>\x01</a>", "<a>\xff</a>", "text", ""})
        EXPECT_NE(test::xml_fault(bad), "") << bad;
    EXPECT_EQ(test::xml_fault("<a b=\"1\"><c/>x &amp; y</a>\n"), "");
}

}  // namespace
}  // namespace si
