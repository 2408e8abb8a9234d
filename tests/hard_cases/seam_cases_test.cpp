// Tests hard case 30: kernels across the borders of a point light's faces show no seams.
#include <algorithm>
#include <cmath>

#include "renderer/scenes/hard_cases.h"
#include "renderer/settings/param.h"
#include "renderer/view/lights/kernel_reach.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"
#include "tests/support/stability.h"
#include "tests/support/traits.h"

namespace si {
namespace {

struct Seams {
    std::size_t near = 0, near_wrong = 0, inside = 0, inside_wrong = 0;
    std::size_t across = 0;  ///< pixels whose kernel reaches outside a face of exactly a right angle
    double excess() const {
        return double(near_wrong) / double(std::max<std::size_t>(near, 1)) -
               double(inside_wrong) / double(std::max<std::size_t>(inside, 1));
    }
};

class HardCase30 : public testing::Test {
protected:
    /// Counts wrong pixels away from shadow edges, near a border of two faces and elsewhere.
    Seams count(const Scene& scene, const Settings& s) {
        const test::Shot shot = test::draw_shot(scene, s, 200, 150);
        const double reach = kernel_reach_in_light(s, shot.light(), shot.frame.map_resolution).edge + 1.5;
        const test::ReferenceImage reference = test::trace_reference(test::RayReference(scene), shot, reach);
        Seams out;
        for (std::size_t i = 0; i < reference.states.size(); ++i) {
            if (reference.states[i] != test::ReferenceState::Lit && reference.states[i] != test::ReferenceState::Shadow)
                continue;
            if (reference.hits[i]->normal.y < 0.5) continue;
            glm::dvec3 a = glm::abs(reference.hits[i]->position - shot.light().position);
            std::sort(&a.x, &a.x + 3);
            // Distance in texels from the border, where the two largest coordinates are equal.
            const double aside = (1 - a.y / a.z) * 0.5 * shot.frame.map_resolution;
            const double v = shot.visibility.data[i];
            const bool wrong = reference.states[i] == test::ReferenceState::Lit ? v < 0.98 : v > 0.02;
            const bool near = aside < reach + 3;
            (near ? out.near : out.inside) += 1;
            out.across += aside < reach - 1.5;
            (near ? out.near_wrong : out.inside_wrong) += wrong;
        }
        return out;
    }
};

SI_TEST_IS(Later, HardCase30, SeamsHaveNoMoreErrorThanFaces);
TEST_F(HardCase30, SeamsHaveNoMoreErrorThanFaces) {
    for (const glm::dvec3& at : {glm::dvec3(0), glm::dvec3(4e3, -120, 9e3)})
        for (const glm::dvec3& lamp : {glm::dvec3(0, 2, 0), glm::dvec3(0.3, 1.7, -0.4)})
            for (const char* kernel : {"pcf3", "pcf9", "poisson", "pcss", "vsm"}) {
                SCOPED_TRACE(testing::Message() << kernel << " " << lamp.x << " " << at.x);
                Scene scene = hard_cases()[30 - 1].make();
                test::move_scene(scene, at);
                Settings s =
                    settings_with(test::texel_settings(kernel, 256, 0),
                                  {"bias.unit=metres", "bias.constant=0.25", "bias.normal=3", "light.type=point",
                                   "light.size=0.02", "camera.distance=11", "camera.elevation=65"});
                s.lights[0].distance = 1e-3;  // at its target
                set_target(s.lights[0], at + lamp - scene.bounds.centre());
                test::move_camera(s, at);
                const Seams seams = count(scene, s);
                EXPECT_GT(seams.near, 500u);
                EXPECT_GT(seams.inside, 3000u);
                test::expect_within_limit(30, std::max(0.0, seams.excess()));
                test::expect_fault(30, double(seams.across));
            }
}

// All texels of a look-up lie in its face: nothing outside the sides is ever read.
SI_TEST_IS(Later, HardCase30, NothingIsReadOutsideAFace);
TEST_F(HardCase30, NothingIsReadOutsideAFace) {
    const Scene scene = hard_cases()[30 - 1].make();
    for (const Sets& reach : {Sets{"filter.kernel=pcf9", "bias.normal=6"},
                              {"filter.kernel=pcss", "light.size=0.3"},
                              {"filter.kernel=pcf3", "map.blur_texels=5"}}) {
        Settings s = test::texel_settings("pcf3", 256, 3);
        set_all(s, {"light.type=point", "light.distance=2", "light.elevation=90"});
        set_all(s, reach);
        const test::Shot lit = test::draw_shot(scene, s);
        s.map.outside = Outside::Unlit;
        EXPECT_EQ(test::differing_share(lit, test::draw_shot(scene, s), 1e-6), 0) << reach[0].second;
    }
}

}  // namespace
}  // namespace si
