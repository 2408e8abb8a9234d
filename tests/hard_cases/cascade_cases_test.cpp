// Tests hard cases 28 and 31: extreme splits, and casters between the light and its near plane.
#include <cmath>

#include "renderer/settings/splits.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/hard_view.h"
#include "tests/support/sets.h"
#include "tests/support/stability.h"

namespace si::test {
namespace {

/// Counts splits that do not grow or are NaN, and visible surfaces in no map.
int faults_of(const DrawnCase& c) {
    const Camera camera = make_camera(c.scene, c.settings, 4.0 / 3);
    const FittedLight light = fit_lights(c.scene, c.settings, &camera)[0];
    int faults = 0;
    double before = -1e300;
    for (const ViewSpan& span : light.chooser.spans) {
        faults += !(std::isfinite(span.ends) && span.ends > before);
        before = span.ends;
    }
    EXPECT_EQ(light.chooser.choice, ViewChoice::Interval);
    static const RayReference rays(c.scene);
    int seen = 0;
    for (const auto& [x, y, hit] : pixel_hits(rays, camera, 80, 60)) {
        if (c.settings.camera.far > 0 && glm::dot(hit.position - camera.eye, -camera.axes[2]) > c.settings.camera.far)
            continue;
        ++seen;
        const glm::dvec4 at = uvdw(light.views[light.chooser.choose(light.views, hit.position).view], hit.position);
        faults += !(at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1 && at.z >= 0 && at.z <= 1);
    }
    EXPECT_GT(seen, 200);
    return faults;
}

TEST(HardCase28, SplitsStayDistinctAndCoverVisiblePoints) {
    for (const char* split : {"uniform", "logarithmic", "practical"})
        for (const char* lambda : {"0", "1"})
            for (const auto& [near, far] :
                 {std::pair{"0", "0"}, {"1e-9", "0"}, {"1e-4", "1e6"}, {"8", "8"}, {"8", "30"}}) {
                SCOPED_TRACE(std::string(split) + " " + lambda + " near " + near + " far " + far);
                for (const char* cascades : {"2", "8"})
                    for (const char* fit : {"view", "stabilised"})
                        if (std::string(far) != "8")  // otherwise nothing is visible
                            expect_within_limit(28, faults_of(hard_view("split-ends", true,
                                                                        {{"light.split", split},
                                                                         {"light.split_lambda", lambda},
                                                                         {"camera.near", near},
                                                                         {"camera.far", far},
                                                                         {"light.cascades", cascades},
                                                                         {"light.fit", fit}})));
            }
    // near 0: 0 * (far / 0)^(i / count).
    int none = 0;
    for (const double end : {0.0 * std::pow(30.0 / 0.0, 0.25), 0.0 * std::pow(30.0 / 0.0, 0.5)})
        none += std::isnan(end);
    expect_fault(28, none);
    // The drawn results are finite.
    draw_shot(hard_view("split-ends", true));
    draw_shot(hard_view("split-ends", true, {"camera.near=8", "camera.far=8"}));
}

TEST(HardCase31, ALongTriangleAcrossTheNearPlaneIsNotBent) {
    for (const char* reversed : {"false", "true"}) {
        const Sets depth = {{"map.reversed_z", reversed}};
        DrawnCase wide = hard_view("pancaking", true, depth);
        set_setting(wide.settings, "light.near_far", "fitted");
        const Shot whole = draw_shot(wide), flat = draw_shot(hard_view("pancaking", true, depth));
        EXPECT_GT(shadow_share(whole), 0.02);
        EXPECT_LT(flat.view().curve.far - flat.view().curve.near,
                  0.8 * (whole.view().curve.far - whole.view().curve.near))
            << "the range must be shorter than the casters";
        expect_within_limit(31, differing_share(whole, flat));
        expect_fault(31, differing_share(whole, draw_shot(hard_view("pancaking", false, depth))));
    }
}

}  // namespace
}  // namespace si::test
