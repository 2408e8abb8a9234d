// Tests of the widths of light and shadow around a pixel, over pictures made by hand: a floor from straight above under
// a sun straight above, so that pixels are squares of metres across the light.
#include "renderer/reference/shadow_runs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace si {
namespace {

constexpr double kPixel_m = 0.1;

/// Picture made from rows: '.' lit, '#' dark, ' ' background, '|' a surface in front of the floor.
struct Floor {
    Reference reference;
    Receivers receivers;
    Camera camera;
    PixelRaster raster;
    ReferenceQuery query;

    explicit Floor(const std::vector<std::string>& rows, const glm::dvec3& at = {0, 0, 0}) {
        const int w = int(rows[0].size()), h = int(rows.size());
        reference.width = w;
        reference.height = h;
        reference.visibility = {w, h, 1, {}};
        receivers.width = w;
        receivers.height = h;
        camera.axes = glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0));
        camera.eye = at + glm::dvec3(0.5 * w * kPixel_m, 10, 0.5 * h * kPixel_m);
        camera.orthographic = true;
        camera.height = h * kPixel_m;
        camera.aspect = double(w) / h;
        camera.curve = {.perspective = false, .near = 1, .far = 20};
        raster = {w, h};
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                const char c = rows[std::size_t(y)][std::size_t(x)];
                reference.state.push_back(c == ' ' ? PixelState::Background : PixelState::Counted);
                reference.visibility.data.push_back(c == '#' ? 0.f : 1.f);
                Receiver r;
                if (c != ' ') {
                    r.object = c == '|' ? 1 : 0;
                    r.position_ws = at + glm::dvec3((x + 0.5) * kPixel_m, c == '|' ? 1 : 0, (y + 0.5) * kPixel_m);
                    r.normal_ws = {0, 1, 0};
                    const auto same = [&](int u, int v) {
                        return u < w && v < h && (rows[std::size_t(v)][std::size_t(u)] == '|') == (c == '|') &&
                               rows[std::size_t(v)][std::size_t(u)] != ' ';
                    };
                    r.same_surface_right = same(x + 1, y);
                    r.same_surface_below = same(x, y + 1);
                }
                receivers.pixels.push_back(r);
            }
        query.emitter.type = LightType::Directional;
        query.emitter.to_light = {0, 1, 0};
        query.emitter.casts = true;
        LightView view;
        view.axes = camera.axes;
        query.views = {view};
    }
    ShadowRuns runs() const { return shadow_runs(reference, receivers, camera, raster, query, {.threads = 1}); }
};

std::string row(int lit_before, int dark, int lit_after) {
    return std::string(std::size_t(lit_before), '.') + std::string(std::size_t(dark), '#') +
           std::string(std::size_t(lit_after), '.');
}

TEST(ShadowRuns, AreTheWidthsOfStripesInMetres) {
    for (const glm::dvec3& at : {glm::dvec3(0), glm::dvec3(1e5, 300, -2e5)}) {
        const Floor floor(std::vector<std::string>(30, row(40, 6, 44)), at);
        const ShadowRuns runs = floor.runs();
        // A bar's shadow of six pixels: every pixel inside is in a run of 0.6 m.
        for (int x = 40; x < 46; ++x) {
            EXPECT_NEAR(runs.run_m.at(x, 15), 0.6, 1e-6) << x;
            EXPECT_NEAR(runs.edge_m.at(x, 15), kPixel_m * (std::min(x - 40, 45 - x) + 0.5), 1e-6) << x;
        }
        // Next to the bar the light is wide, but the bar is not: texels of 0.6 m can be wrong within 0.6 m of it, wider
        // ones farther.
        EXPECT_NEAR(runs.run_m.at(38, 15), 0.6, 1e-6);
        EXPECT_NEAR(runs.edge_m.at(38, 15), 0.15, 1e-6);
        EXPECT_NEAR(runs.run_m.at(20, 15), 1.95, 1e-6) << "a texel has to reach the bar";
        EXPECT_NEAR(runs.edge_m.at(20, 15), 1.95, 1e-6);
    }
}

TEST(ShadowRuns, OneEdgeGivesAnEndlessRun) {
    const ShadowRuns runs = Floor(std::vector<std::string>(30, row(50, 150, 0))).runs();
    for (const int x : {10, 49, 50, 80}) EXPECT_TRUE(std::isinf(runs.run_m.at(x, 15))) << x;
    EXPECT_NEAR(runs.edge_m.at(49, 15), 0.05, 1e-6);
    EXPECT_TRUE(std::isinf(runs.edge_m.at(50 + kRunReach + 1, 15))) << "as far as is looked";
}

TEST(ShadowRuns, EndAtTheSurfaceAndContinueBehindOccluders) {
    std::string broken = row(30, 10, 30);
    broken.replace(33, 2, "  ");
    const ShadowRuns ends = Floor(std::vector<std::string>(20, broken)).runs();
    EXPECT_NEAR(ends.run_m.at(31, 10), 1.0, 1e-6) << "the floor's plane goes on beyond a hole";
    std::string hidden = row(30, 10, 30);
    hidden.replace(34, 2, "||");
    const Floor behind(std::vector<std::string>(20, hidden));
    EXPECT_NEAR(behind.runs().run_m.at(31, 10), 1.0, 1e-6);
    EXPECT_TRUE(std::isinf(behind.runs().edge_m.at(34, 10))) << "another surface knows nothing of the floor's shadow";
}

TEST(ShadowRuns, LargePartsGiveTheRunsOfTheWhole) {
    std::vector<std::string> rows;
    for (int y = 0; y < 150; ++y) {
        std::string r;
        for (int x = 0; x < 220; ++x) r += (x * 7 + y * 3) % 53 < 9 || (x / 31 + y / 17) % 4 == 0 ? '#' : '.';
        rows.push_back(r);
    }
    const ShadowRuns whole = Floor(rows).runs();
    const int cx = 110, cy = 75;
    std::vector<std::string> part;
    for (int y = cy - kRunReach; y <= cy + kRunReach; ++y)
        part.push_back(rows[std::size_t(y)].substr(cx - kRunReach, 2 * kRunReach + 1));
    Floor small(part, {(cx - kRunReach) * kPixel_m, 0, (cy - kRunReach) * kPixel_m});
    const ShadowRuns runs = small.runs();
    EXPECT_NEAR(runs.run_m.at(kRunReach, kRunReach), whole.run_m.at(cx, cy), 1e-6);
    EXPECT_NEAR(runs.edge_m.at(kRunReach, kRunReach), whole.edge_m.at(cx, cy), 1e-6);
}

TEST(ShadowRuns, AreEndlessWithoutAMapOrOutsideTheRange) {
    Floor floor(std::vector<std::string>(10, row(5, 5, 5)));
    floor.reference.state[5 * 15 + 7] = PixelState::FacesAway;
    EXPECT_TRUE(std::isinf(floor.runs().run_m.at(7, 5)));
    floor.query.views.clear();
    for (const float v : floor.runs().run_m.data) EXPECT_TRUE(std::isinf(v));
}

bool same_runs(const Floor& a, const Floor& b) {
    return have_same_runs(a.reference, a.query, b.reference, b.query);
}

TEST(ShadowRuns, AreTheSameForOtherPlanesAndCascadesOfASun) {
    for (const glm::dvec3& at : {glm::dvec3(0), glm::dvec3(1e5, 300, -2e5)}) {
        const Floor floor(std::vector<std::string>(30, row(40, 6, 44)), at);
        Floor other = floor;
        other.query.views[0].eye = at + glm::dvec3(3.7, 50, -2.1);
        other.query.views[0].curve.near = 0.3;
        other.query.views.push_back(other.query.views[0]);
        other.query.views[1].eye.x += 7;
        other.query.chooser = {.choice = ViewChoice::Interval, .from_ws = at, .forward = {0, -1, 0}, .spans = {{5, 5}}};
        EXPECT_TRUE(same_runs(floor, other));
        EXPECT_EQ(floor.runs().run_m.data, other.runs().run_m.data);
        EXPECT_EQ(floor.runs().edge_m.data, other.runs().edge_m.data);
    }
}

TEST(ShadowRuns, DifferWithTheShadowsTheAxesAndThePlaceOfALamp) {
    const Floor floor(std::vector<std::string>(30, row(40, 6, 44)));
    EXPECT_TRUE(same_runs(floor, floor));
    Floor other(std::vector<std::string>(30, row(40, 7, 43)));
    EXPECT_FALSE(same_runs(floor, other)) << "another shadow";
    other = floor;
    std::swap(other.query.views[0].axes[0], other.query.views[0].axes[1]);
    EXPECT_FALSE(same_runs(floor, other)) << "a map that is turned about the light's direction";
    other = floor;
    other.reference.state[5] = PixelState::FacesAway;
    EXPECT_FALSE(same_runs(floor, other)) << "another surface";
    other = floor;
    other.query.views.clear();
    EXPECT_FALSE(same_runs(floor, other)) << "no map";
    Floor lamp = floor;
    lamp.query.views[0].curve.perspective = true;
    EXPECT_FALSE(same_runs(floor, lamp)) << "rays from a point";
    EXPECT_TRUE(same_runs(lamp, lamp));
    other = lamp;
    other.query.views[0].eye.x += 1;
    EXPECT_FALSE(same_runs(lamp, other)) << "rays from another point";
}

}  // namespace
}  // namespace si
