// Error metrics over pictures made by hand, and the distances that they rest on.
#include <gtest/gtest.h>

#include <cmath>

#include "renderer/reference/distance_transform.h"
#include "renderer/reference/light_space.h"
#include "renderer/reference/metrics.h"
#include "renderer/scenes/shapes.h"
#include "tests/support/traced.h"

namespace si {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// A truth from rows of characters: '.' lit, '#' dark, '+' half lit, ' ' background, 'o' turned away.
Truth truth_of(const std::vector<std::string>& rows) {
    Truth t;
    t.width = int(rows[0].size()), t.height = int(rows.size());
    for (const std::string& row : rows)
        for (const char c : row) {
            t.state.push_back(c == ' ' ? PixelState::Background : c == 'o' ? PixelState::FacesAway : PixelState::Counted);
            ++t.pixels[std::size_t(t.state.back())];
            t.visibility.data.push_back(c == '#' || c == 'o' ? 0.f : c == '+' ? 0.5f : 1.f);
            t.nearest_m.data.push_back(c == '#' ? 1.f : kNaN);
        }
    t.visibility.width = t.width, t.visibility.height = t.height;
    return t;
}

FloatImage measured_of(const std::vector<std::string>& rows) {
    return truth_of(rows).visibility;
}

TEST(DistanceTransform, IsTheNearestOfAll) {
    Random random(4);
    for (const auto& [w, h] : {std::pair{1, 1}, {7, 1}, {1, 9}, {23, 17}}) {
        std::vector<std::uint8_t> set(std::size_t(w * h));
        for (auto& s : set) s = random.in(0, 1) < 0.1;
        const std::vector<float> distance = distance_to(set, w, h);
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                double least = INFINITY;
                for (int v = 0; v < h; ++v)
                    for (int u = 0; u < w; ++u)
                        if (set[std::size_t(v * w + u)]) least = std::min(least, std::hypot(u - x, v - y));
                EXPECT_EQ(distance[std::size_t(y * w + x)], float(least)) << x << ',' << y;
            }
    }
}

TEST(Metrics, OfEqualPicturesAreZero) {
    const std::vector<std::string> rows = {"..##", "..## ", "o..."};
    const Truth truth = truth_of({"..##", "..##", "o.. "});
    const ErrorMetrics m = error_metrics(truth.visibility, truth, {});
    EXPECT_EQ(m.counted, 10u);
    EXPECT_EQ(m.pixels[std::size_t(PixelState::Background)], 1u);
    EXPECT_EQ(m.pixels[std::size_t(PixelState::FacesAway)], 1u);
    for (const double v : {m.false_shadow, m.false_light, m.acne, m.leak, m.any_acne, m.mae, m.rmse, m.signed_mean,
                           m.outside_map, m.boundary_px_mean, m.boundary_px_p95, m.boundary_px_max})
        EXPECT_EQ(v, 0);
    EXPECT_EQ(m.iou, 1);
    EXPECT_EQ(m.artefacts[0], 12u);
}

TEST(Metrics, CountEachKindOfError) {
    // Counted: 10. Two false shadows (one near an edge), three false lights (one each of edge, interior, outside).
    const Truth truth = truth_of({".....#####", "          "});
    const FloatImage v = measured_of({"#...#...##", "##########"});
    PixelFacts facts;
    facts.edge_texels.assign(20, kInf);
    facts.edge_texels[4] = 0.4f, facts.edge_texels[5] = 0.4f;
    facts.outside_map.assign(20, 0);
    facts.outside_map[7] = facts.outside_map[2] = 1;
    facts.bias_m.assign(20, 0);
    std::vector<Artefact> artefacts;
    const ErrorMetrics m = error_metrics(v, truth, facts, &artefacts);
    EXPECT_EQ(m.counted, 10u);
    EXPECT_DOUBLE_EQ(m.false_shadow, 0.2);
    EXPECT_DOUBLE_EQ(m.acne, 0.1);
    EXPECT_DOUBLE_EQ(m.boundary_false_shadow, 0.1);
    EXPECT_DOUBLE_EQ(m.false_light, 0.3);
    EXPECT_DOUBLE_EQ(m.leak, 0.1);
    EXPECT_DOUBLE_EQ(m.boundary_false_light, 0.1);
    EXPECT_DOUBLE_EQ(m.outside_false_light, 0.1);
    EXPECT_DOUBLE_EQ(m.outside_false_shadow, 0);
    EXPECT_DOUBLE_EQ(m.outside_map, 0.2) << "right and wrong ones";
    EXPECT_DOUBLE_EQ(m.any_acne, 0.1);
    EXPECT_DOUBLE_EQ(m.mae, 0.5);
    EXPECT_DOUBLE_EQ(m.rmse, std::sqrt(0.5));
    EXPECT_NEAR(m.signed_mean, 0.1, 1e-12);
    EXPECT_DOUBLE_EQ(m.iou, 2.0 / 7);
    EXPECT_EQ(artefacts[0], Artefact::Acne);
    EXPECT_EQ(artefacts[4], Artefact::EdgeAliasing);
    EXPECT_EQ(artefacts[5], Artefact::EdgeAliasing);
    EXPECT_EQ(artefacts[6], Artefact::Leak);
    EXPECT_EQ(artefacts[2], Artefact::OutsideMap);
    EXPECT_EQ(artefacts[10], Artefact::None);
}

TEST(Metrics, TellWhyLightIsFalse) {
    Truth truth = truth_of({"####"});
    truth.nearest_m.data = {1, 1, kNaN, 1};
    PixelFacts facts;
    facts.bias_m = {0.9f, 1.1f, 5, 0};
    std::vector<Artefact> artefacts;
    error_metrics(measured_of({"...#"}), truth, facts, &artefacts);
    EXPECT_EQ(artefacts, (std::vector{Artefact::Leak, Artefact::PeterPanning, Artefact::LostCaster, Artefact::None}));
}

TEST(Metrics, SeeFaintAcneAndPenumbrae) {
    const Truth truth = truth_of({"....++"});
    FloatImage v = measured_of({"......"});
    v.data = {0.9f, 0.9999f, 1, kNaN, 0.2f, 0.7f};
    const ErrorMetrics m = error_metrics(v, truth, {});
    EXPECT_DOUBLE_EQ(m.any_acne, 2.0 / 6) << "0.9 and the NaN, which counts as dark";
    EXPECT_DOUBLE_EQ(m.acne, 1.0 / 6);
    EXPECT_DOUBLE_EQ(m.boundary_false_shadow, 1.0 / 6) << "a penumbra is an edge";
    EXPECT_NEAR(m.mae, (0.1 + 0.0001 + 1 + 0.3 + 0.2) / 6, 1e-6);
}

TEST(Metrics, MeasureHowFarContoursAreApart) {
    const std::vector<std::string> rows(8, "....########");
    const std::vector<std::string> moved(8, "......######");
    const ErrorMetrics m = error_metrics(measured_of(moved), truth_of(rows), {});
    EXPECT_DOUBLE_EQ(m.boundary_px_mean, 1.5) << "one contour pixel of each lies 1 px off, the other 2";
    EXPECT_EQ(m.boundary_px_max, 2);
    EXPECT_EQ(m.boundary_px_p95, 2);
    const ErrorMetrics none = error_metrics(measured_of(std::vector<std::string>(8, "............")), truth_of(rows), {});
    EXPECT_TRUE(std::isnan(none.boundary_px_mean));
    // Every fourth pixel of a picture: the same contours are four times as far apart in it.
    Truth coarse = truth_of(rows);
    coarse.step = 4;
    const ErrorMetrics far = error_metrics(measured_of(moved), coarse, {});
    EXPECT_DOUBLE_EQ(far.boundary_px_mean, 6);
    EXPECT_EQ(far.boundary_px_max, 8);
    EXPECT_EQ(far.boundary_px_p95, 8);
    // Where two surfaces meet in the picture there is no contour.
    PixelFacts facts;
    facts.joins.assign(96, 3);
    for (std::size_t y = 0; y < 8; ++y) facts.joins[y * 12 + 3] = 2;
    EXPECT_TRUE(std::isnan(error_metrics(measured_of(moved), truth_of(rows), facts).boundary_px_mean));
    EXPECT_THROW(error_metrics(measured_of({"..."}), truth_of(rows), {}), Error);
}

/// A floor under a box, seen from straight above through a map of 16 x 16 texels over 8 x 8 m.
struct Lit {
    Scene scene;
    std::shared_ptr<const TruthGeometry> geometry;
    FittedLight light;
    static constexpr int kResolution = 16;

    explicit Lit(Mesh caster, const glm::dmat4& place, bool floor_casts = true) {
        const int grey = add_material(scene, "grey", {0.5f, 0.5f, 0.5f});
        add_object(scene, "floor", -1, add_mesh(scene, "floor", make_plane(20, 20), grey));
        add_object(scene, "caster", -1, add_mesh(scene, "caster", std::move(caster), grey), place);
        finalise(scene);
        Settings settings;
        settings.objects["floor"].cast = floor_casts;
        geometry = test::geometry_of(scene, settings);
        light.to_light = {0, 1, 0};
        light.casts = true;
        LightView view;
        view.eye = {0, 10, 0};
        view.axes = glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0));
        view.half_width = 4;
        view.curve = {.perspective = false, .near = 0, .far = 20};
        light.views = {view};
    }
    /// Of a floor point; in texels, x is 2 (x + 4).
    float edge_distance(double x, double z, double reach) const {
        Receiver r;
        r.position_ws = {x, 0, z}, r.normal_ws = {0, 1, 0}, r.edge_m = 20, r.object = 0;
        return edge_distance(r, reach);
    }
    float edge_distance(const Receiver& r, double reach) const {
        const Receivers receivers = test::row_of({r});
        const TruthScene casters(geometry);
        const Truth truth = trace_visibility(casters, receivers, test::query_for(scene, test::sun({0, 1, 0})), {});
        Footprint f;
        f.centre = f.own = {2 * (r.position_ws.x + 4), 2 * (4 - r.position_ws.z)};
        f.view = 0;
        return edge_distances(casters, receivers, truth, light, kResolution, reach, {f}, {})[0];
    }
};

TEST(EdgeDistance, IsInTexelsToWhereTheTruthChanges) {
    // The box covers x in [-1, 1]: texels 6 to 9, centres 6.5 to 9.5.
    for (const bool floor_casts : {true, false}) {
        const Lit lit(make_box({2, 1, 2}), moved(0, 2, 0), floor_casts);
        EXPECT_EQ(lit.edge_distance(0, 0, 0.5), kInf) << "the nearest lit centre is 2.5 texels off";
        EXPECT_FLOAT_EQ(lit.edge_distance(0, 0, 2), 2.5f);
        EXPECT_FLOAT_EQ(lit.edge_distance(-0.9, 0, 0.5), 0.7f) << "texel 5 is lit";
        EXPECT_FLOAT_EQ(lit.edge_distance(-1.1, 0, 0.5), 0.7f) << "texel 6 is dark";
        EXPECT_EQ(lit.edge_distance(-2, 0, 0.5), kInf);
        EXPECT_EQ(lit.edge_distance(3, 3, 2), kInf);
    }
}

TEST(EdgeDistance, KnowsNoEdgeInFoldsThatAreLit) {
    // A gutter over the floor: each side rises above the other's plane, and all of it is lit.
    const Lit lit(make_polygons("gutter", {{{-2, 4, -2}, {-2, 4, 2}, {0, 3, 2}, {0, 3, -2}},
                                           {{0, 3, -2}, {0, 3, 2}, {2, 4, 2}, {2, 4, -2}}}),
                  glm::dmat4(1));
    const Receiver r = test::receiver_on(*lit.geometry, 1, 1, 0.45, 0.5);
    ASSERT_LT(r.position_ws.x, 0);
    ASSERT_GT(r.position_ws.x, -0.3) << "the fold lies in the footprint";
    ASSERT_GT(r.normal_ws.y, 0);
    EXPECT_EQ(lit.edge_distance(r, 2), kInf);
    EXPECT_FLOAT_EQ(lit.edge_distance(1.9, 0, 0.5), 0.7f) << "but the floor's edge beside it counts";
}

}  // namespace
}  // namespace si
