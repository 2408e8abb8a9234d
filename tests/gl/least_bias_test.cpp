// Compares the least bias in GLSL (shaders/lib/bias.glsl, lib/least_bias.glsl) with C++ (renderer/bias) on random
// planes under random lights, for every format, kernel and kind of bias.
#include <random>

#include "renderer/base/directions.h"
#include "renderer/bias/account.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class LeastBiasTwins : public FrameTest {
protected:
    static constexpr int kWidth = 24, kHeight = 18;
    std::mt19937 random{20261};
    double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); }

    /// Plane somewhere in the world that fills the picture, with a small sheet before it that gives the light
    /// a depth range.
    struct Sight {
        Scene scene;
        Settings settings;
        glm::dvec3 at, normal;
    };
    Sight random_sight(LightType type, LightFit fit) {
        Sight sight;
        sight.at = glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)) * std::pow(10.0, uniform(0, 4));
        const glm::dvec3 tilt(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        const glm::dmat3 turn(orthonormal_basis(glm::normalize(tilt + glm::dvec3(0, 0.2, 0))));
        glm::dmat4 place(turn);
        place[3] = glm::dvec4(sight.at, 1);
        sight.normal = glm::dvec3(place[1]);
        sight.scene = test::grey_scene(
            {{"plane", make_plane(10, 10), place}, {"sheet", make_plane(0.1f, 0.1f), place * moved(4, 2, 4)}});
        Settings& s = sight.settings;
        s.camera.source = CameraSource::Manual;
        const glm::dvec3 from = glm::normalize(sight.normal + 0.4 * glm::dvec3(place[0]));
        set_target(s.camera, sight.at);
        s.camera.azimuth = glm::degrees(std::atan2(from.x, from.z));
        s.camera.elevation = glm::degrees(std::asin(std::clamp(from.y, -1.0, 1.0)));
        s.camera.distance = 4;
        LightSettings& light = s.lights[0];
        light.type = type;
        light.fit = fit;
        // Some lights lie along the axes exactly.
        light.azimuth = uniform(0, 1) < 0.3 ? 90 * std::floor(uniform(0, 4)) : uniform(-180, 180);
        light.elevation = uniform(0, 1) < 0.2 ? 90 : uniform(-85, 85);
        light.target_x = light.target_y = light.target_z = 0;
        light.distance = type == LightType::Directional ? 0 : uniform(6, 30);
        light.cone = uniform(50, 100);
        s.map.resolution = 1 << int(uniform(6, 11));
        return sight;
    }
};

SI_TESTS_ARE(Repeated, LeastBiasTwins);
SI_TEST_IS(Slow, LeastBiasTwins, CpuAndGpuAgreeOnRandomPlanes);
TEST_F(LeastBiasTwins, CpuAndGpuAgreeOnRandomPlanes) {
    int compared = 0, perspective = 0, warped = 0, grazing = 0;
    std::size_t next = 0;
    constexpr const char* formats[] = {"d16", "d24", "d32f", "colour", "linear", "linear16"};
    double worst = 0;
    // A float's step doubles at a power of two.
    const auto at_power_of_two = [](double v) {
        int exponent = 0;
        const double mantissa = std::frexp(v, &exponent);
        return std::min(mantissa - 0.5, 1 - mantissa) < 1e-5;
    };
    for (const auto& [type, fit] : {std::pair{LightType::Directional, LightFit::Casters},
                                    {LightType::Directional, LightFit::Lispsm},
                                    {LightType::Spot, LightFit::Casters},
                                    {LightType::Point, LightFit::Casters}})
        for (const Filter& filter : filters()) {
            const char* format = formats[next % std::size(formats)];
            // Each kind meets each format, with alternating kernels.
            const Choice& kind = bias_choices()[next++ % bias_choices().size()];
            const Sight sight = random_sight(type, fit);
            Settings s = sight.settings;
            set_setting(s, "map.format", format);
            set_setting(s, "filter.kernel", filter.key);
            set_setting(s, "bias.kind", kind.key);
            set_setting(s, "view.overlay", "least-bias");
            s.map.reversed_z = uniform(0, 1) < 0.5;
            s.bias.plane_clamp = uniform(0, 1) < 0.5 ? 0 : uniform(0.1, 20);
            FrameRequest request{.width = kWidth, .height = kHeight, .outputs = {.colour = false, .overlay = true}};
            const FrameResult frame = renderer.render(sight.scene, s, request);
            const FloatImage values = renderer.read_float(frame.overlay, 4);
            int here = 0;
            for (const auto& [x, y, origin, dir] : test::pixel_rays(frame.camera, kWidth, kHeight)) {
                const float value = values.at(x, y);
                if (std::isnan(value)) continue;
                const double along = glm::dot(sight.at - origin, sight.normal) / glm::dot(dir, sight.normal);
                const glm::dvec3 p = origin + dir * along;
                const glm::dvec3 n = glm::dot(dir, sight.normal) < 0 ? sight.normal : -sight.normal;
                const BiasBreakdown a = test::breakdown_at(frame, s, renderer.driver(), p, n);
                const double cosine = a.receiver.n_dot_l;
                if (cosine < 0.01) continue;  // half a degree: single precision keeps few digits
                const double expected = a.amount(a.least.total()).texels;
                // The tangent of the angle carries the normal's rounding over its cosine. Some dozens of roundings
                // of single precision, and of coordinates up to the scene's extent, come on top.
                double scale = expected;
                // Both terms of the kernel's part under bias.plane_clamp round.
                if (a.per_texel && a.least.kernel > 0) scale += a.amount(a.max_texel_shift).texels;
                double tolerance = scale * 2e-5 / cosine;
                const double share = (a.receiver.own_m - a.curve.near) / (a.curve.far - a.curve.near);
                if (at_power_of_two(a.receiver.uvd.z) || at_power_of_two(share) || at_power_of_two(1 - share))
                    tolerance += a.amount(a.least.quantum).texels;
                const double off = std::abs(value - expected);
                ASSERT_LE(off, tolerance)
                    << int(type) << " " << int(fit) << " " << format << " " << filter.key << " " << kind.key
                    << (s.map.reversed_z ? " reversed" : "") << ", cosine " << cosine << ", at " << x << "," << y
                    << ": " << value << " on the GPU, " << expected << " here";
                worst = std::max(worst, off / tolerance);
                ++compared;
                ++here;
                perspective += a.curve.perspective;
                warped += frame.lights[0].is_warped();
                grazing += cosine < 0.2;
            }
        }
    EXPECT_GT(compared, 10000);
    EXPECT_GT(perspective, 3000);
    EXPECT_GT(warped, 2000);
    EXPECT_GT(grazing, 1000);
    EXPECT_GT(worst, 0.01) << "the tolerance is too large to prove anything";
}

}  // namespace
}  // namespace si
