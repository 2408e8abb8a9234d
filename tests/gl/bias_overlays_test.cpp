// Compares overlays of bias and texel density with the same formulas in double, pixel by pixel.
#include "renderer/bias/account.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/combinations.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class BiasOverlays : public FrameTest {
protected:
    /// Makes a floor with a ball: planes of every direction.
    static Scene hills() {
        return test::grey_scene({{"floor", make_plane(6, 6)}, {"ball", make_sphere(1, 12, 8), moved(0, 1.2, 0)}});
    }
    std::optional<MapSize> map_size;  ///< of all maps; nullopt: map.resolution
    struct Pixels {
        FrameResult frame;
        FloatImage values;
    };
    Pixels draw(const Scene& scene, Settings s, const char* overlay) {
        Pixels p;
        p.values = overlay_values(scene, s, overlay, {.width = 80, .height = 60, .map_size = map_size}, &p.frame);
        return p;
    }
    /// Calls check(hit, value) for each pixel that holds a number away from the outlines of triangles.
    template <typename Check>
    int each_inner(const Scene& scene, const Pixels& p, Check&& check) {
        const test::RayReference rays(scene);
        int count = 0;
        for (int y = 0; y < 60; ++y)
            for (int x = 0; x < 80; ++x) {
                glm::dvec3 origin, dir;
                // Derivatives use 2x2 blocks: all four pixels must lie in one triangle.
                std::optional<test::Hit> hit, other;
                bool inner = true;
                for (int k = 0; k < 4 && inner; ++k) {
                    p.frame.camera.pixel_ray((x & ~1) + (k & 1), (y & ~1) + (k >> 1), 80, 60, origin, dir);
                    other = rays.first_hit(origin, dir);
                    inner = other && (!hit || hit->triangle == other->triangle);
                    hit = other;
                }
                if (!inner) continue;
                p.frame.camera.pixel_ray(x, y, 80, 60, origin, dir);
                hit = rays.first_hit(origin, dir);
                const float value = p.values.at(x, y);
                if (std::isnan(value)) continue;
                check(*hit, double(value));
                ++count;
            }
        return count;
    }
};

Settings lit_by(LightType type, LightFit fit = LightFit::Scene) {
    Settings s = settings_with(test::hard_settings(), {"camera.target_y=0.6", "camera.distance=7"});
    LightSettings& light = s.lights[0];
    light.type = type;
    light.fit = fit;
    if (type != LightType::Directional) light.distance = 6;
    light.cone = 80;
    set_all(s, {"bias.kind=slope", "bias.unit=texels", "bias.constant=0.4", "bias.slope=2.5", "bias.normal=1.3"});
    return s;
}

SI_TEST_IS(Repeated, BiasOverlays, LeastBiasAndSlackEqualTheFormulas);
SI_TEST_IS(Product, BiasOverlays, LeastBiasAndSlackEqualTheFormulas);
SI_TEST_IS(Slow, BiasOverlays, LeastBiasAndSlackEqualTheFormulas);
TEST_F(BiasOverlays, LeastBiasAndSlackEqualTheFormulas) {
    const Scene scene = hills();
    for (const auto& [light, format, bias, size] :
         test::combinations<std::pair<LightType, LightFit>, const char*, std::pair<bool, const char*>,
                            std::optional<MapSize>>({{LightType::Directional, LightFit::Scene},
                                                     {LightType::Directional, LightFit::Lispsm},
                                                     {LightType::Spot, LightFit::Scene},
                                                     {LightType::Point, LightFit::Scene}},
                                                    {"d16", "d24", "d32f"},
                                                    {{false, "slope"},
                                                     {true, "slope"},
                                                     {false, "constant"},
                                                     {true, "receiver-plane"},
                                                     {true, "receiver-plane-derivatives"},
                                                     {false, "receiver-plane-remainder"},
                                                     {true, "receiver-plane-remainder"},
                                                     {false, "adaptive"}},
                                                    {std::nullopt, MapSize(600, 150), MapSize(200, 1000)})) {
        const auto& [type, fit] = light;
        const auto& [reversed, kind] = bias;
        SCOPED_TRACE(testing::Message() << int(type) << " " << int(fit) << " " << format
                                        << (reversed ? " reversed " : " ") << kind << " "
                                        << size.value_or(MapSize(0)).width);
        map_size = size;
        Settings s = lit_by(type, fit);
        set_setting(s, "bias.kind", kind);
        set_setting(s, "map.format", format);
        s.map.reversed_z = reversed;
        set_setting(s, "filter.kernel", reversed ? "pcf3" : "hard");
        s.bias.raster_slope = reversed ? 1.5 : 0;
        s.bias.raster_units = reversed ? 2 : 0;
        const auto compare = [&](const char* overlay, auto&& expected_texels) {
            const Pixels p = draw(scene, s, overlay);
            const RasterTraits& driver = renderer.driver();
            double worst = 0;
            const int count = each_inner(scene, p, [&](const test::Hit& hit, double value) {
                const BiasBreakdown a = test::breakdown_at(p.frame, s, driver, hit.position, hit.normal);
                if (a.receiver.n_dot_l < 0.02) return;  // edge-on surfaces leave no digits in single precision
                const double scale = a.amount(a.least.total()).texels;
                worst = std::max(worst, std::abs(value - expected_texels(a)) / (1 + scale));
            });
            EXPECT_GT(count, 800) << overlay;
            EXPECT_LT(worst, 2e-3) << overlay;
        };
        compare("least-bias", [](const BiasBreakdown& a) { return a.amount(a.least.total()).texels; });
        compare("bias-slack", [](const BiasBreakdown& a) {
            return a.amount(a.equivalent_depth()).texels - a.amount(a.least.total()).texels;
        });
        compare("contact-gap", [](const BiasBreakdown& a) { return a.contact_gap_m(); });
        compare("bias-applied", [](const BiasBreakdown& a) { return a.amount(a.depth_shift - a.raster).texels; });
    }
}

TEST_F(BiasOverlays, AcneAppearsWhereSlackIsNegative) {
    const Scene scene = hills();
    Settings s = lit_by(LightType::Directional);
    s.bias = test::no_bias();
    set_all(s, {"bias.unit=texels", "map.resolution=256"});
    for (const auto& [constant, negative] : {std::pair{0.0, true}, std::pair{40.0, false}}) {
        s.bias.constant = constant;
        const Pixels p = draw(scene, s, "bias-slack");
        int below = 0;
        const int count = each_inner(scene, p, [&](const test::Hit&, double value) { below += value < 0; });
        EXPECT_GT(count, 800);
        EXPECT_EQ(below > count / 2, negative) << constant;
        EXPECT_EQ(below == 0, !negative) << constant;
    }
}

// The expected value is a pixel's step in the map by central differences of exact positions.
TEST_F(BiasOverlays, DensityEqualsBothSingularValues) {
    const Scene scene = hills();
    for (const auto& [type, fit, size] : {std::tuple{LightType::Directional, LightFit::Scene, std::optional<MapSize>()},
                                          {LightType::Directional, LightFit::Lispsm, std::nullopt},
                                          {LightType::Spot, LightFit::Scene, std::nullopt},
                                          {LightType::Directional, LightFit::Lispsm, MapSize(150, 600)},
                                          {LightType::Spot, LightFit::Scene, MapSize(800, 200)}}) {
        const Settings s = lit_by(type, fit);
        map_size = size;
        const Pixels wide = draw(scene, s, "texels-per-pixel"), narrow = draw(scene, s, "pixels-per-texel"),
                     bands = draw(scene, s, "sampling-bands");
        const test::RayReference rays(scene);
        const glm::dvec2 n = wide.frame.map_size.texels();
        int checked = 0;
        for (int y = 2; y < 58; y += 3)
            for (int x = 2; x < 78; x += 3) {
                std::optional<test::Hit> at[5];
                constexpr double kStep[5][2] = {{0, 0}, {-0.5, 0}, {0.5, 0}, {0, -0.5}, {0, 0.5}};
                bool one = true;
                glm::dvec2 texel[5];
                for (int k = 0; k < 5 && one; ++k) {
                    glm::dvec3 origin, dir;
                    wide.frame.camera.pixel_ray(x + kStep[k][0], y + kStep[k][1], 80, 60, origin, dir);
                    at[k] = rays.first_hit(origin, dir);
                    one = at[k] && at[k]->triangle == at[0]->triangle;
                    if (one)
                        texel[k] = glm::dvec2(test::uvdw(test::view_of(wide.frame.lights[0], at[k]->position),
                                                         at[k]->position)) *
                                   n;
                }
                const float sigma1 = wide.values.at(x, y), inverse2 = narrow.values.at(x, y);
                if (!one || std::isnan(sigma1)) continue;
                const glm::dvec2 jx = texel[2] - texel[1], jy = texel[4] - texel[3];
                const double trace = glm::dot(jx, jx) + glm::dot(jy, jy), det = jx.x * jy.y - jx.y * jy.x;
                const double root = std::sqrt(std::max(trace * trace - 4 * det * det, 0.0));
                const double s1 = std::sqrt((trace + root) / 2), s2 = std::sqrt(std::max((trace - root) / 2, 0.0));
                EXPECT_NEAR(sigma1 / s1, 1, 0.15);
                EXPECT_NEAR(inverse2 * s2, 1, 0.15);
                EXPECT_GE(sigma1 * inverse2, 0.999) << "the larger one over the smaller one";
                EXPECT_EQ(bands.values.at(x, y), std::trunc(std::log2(1 / inverse2)));
                ++checked;
            }
        EXPECT_GT(checked, 60);
    }
}

}  // namespace
}  // namespace si
