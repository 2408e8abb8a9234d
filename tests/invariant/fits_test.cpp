// Tests invariants of every fit: a loop over the rows of the fit table under every light, with alternating kernels and
// positions.
#include "renderer/settings/fits.h"

#include <algorithm>

#include "renderer/scenes/shapes.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"
#include "renderer/view/lights/kernel_reach.h"
#include "tests/support/box_scene.h"
#include "tests/support/combinations.h"
#include "tests/support/hard_case.h"
#include "tests/support/mesh_scene.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

struct FitCase {
    std::string fit;
    LightType light;
    std::string kernel;
    Place place;
    bool seen_in_part;  ///< near camera that sees part of the scene
};

std::vector<FitCase> fit_cases() {
    std::vector<FitCase> out;
    std::size_t turn = 0, row_number = 0;
    // Rows meet one place each by default, seen whole and in part, and all places in the full product.
    std::vector<std::pair<Place, bool>> ways;
    for (const bool part : {false, true})
        for (const Place& place : kPlaces) ways.emplace_back(place, part);
    for (const FitRow& row : fits())
        for (const LightType light : kLightTypes) {
            // Kernels with radii in metres or by depth meet varying texels and ranges over a warped map.
            const bool all = row.warps && light == LightType::Directional;
            const std::size_t first = turn++ * 5 % filters().size(), count = all ? filters().size() : 1;
            for (std::size_t i = 0; i < count; ++i, ++row_number)
                for (const auto& [place, part] : portion(ways, 3, row_number))
                    out.push_back({std::string(row.key), light,
                                   std::string(filters()[(first + i) % filters().size()].key), place, part});
        }
    return out;
}

std::string fit_name(const testing::TestParamInfo<FitCase>& info) {
    return identifier(info.param.fit + "_" + light_name(info.param.light) + "_" + info.param.kernel + "_" +
                      std::to_string(info.index));
}

class EachFit : public testing::TestWithParam<FitCase> {
protected:
    const FitCase& c = GetParam();

    Settings settings() const {
        Settings s = texel_settings(c.kernel, 256, 0);
        place_light(s, c.light, c.place);
        s.lights[0].size = c.light == LightType::Directional ? 0.5 : 0.05;
        if (c.seen_in_part) {
            s.camera.distance = 4;
            s.camera.target_x += 1;
        }
        // Enough for any of these maps: in metres, so that it is the same for all fits.
        set_all(s, {"bias.unit=metres", "bias.constant=0.6"});
        return s;
    }
};

/// Makes a floor, half of it covered at 2 m, and a floating box over the other half.
Scene covered_in_part(const glm::dvec3& at) {
    Scene scene = grey_scene({{"floor", make_plane(12, 12)},
                              {"cover", make_plane(3, 5), moved(-2, 2, 0)},
                              {"box", make_box({1.2, 0.4, 1.6}), moved(2, 1.5, 0.5)}});
    move_scene(scene, at);
    return scene;
}

SI_TESTS_ARE(DriverIndependent, EachFit);
SI_TESTS_ARE(Product, EachFit);
// Away from edges visibility equals that of rays, for any part of the scene that the map leaves out; so all fits
// agree.
TEST_P(EachFit, AgreesWithTheReferenceInsideAndOutsideItsMap) {
    const Scene scene = covered_in_part(c.place.at);
    Settings s = settings();
    set_setting(s, "light.fit", "scene");
    const Shot whole = draw_shot(scene, s);
    set_setting(s, "light.fit", c.fit);
    const Shot shot = draw_shot(scene, s);
    const FitRow& row = fits()[std::size_t(s.lights[0].fit)];
    // The widest texels of both maps bound the distance to an edge; compared depths may lie to its side.
    const FittedLight& wider = shot.view().half_extent() > whole.view().half_extent() ? shot.light() : whole.light();
    const double reach = kernel_reach_in_light(s, wider, whole.frame.map_resolution).edge + 1.5;
    const ReferenceImage reference = trace_reference(RayReference(scene), whole.frame.camera, wider, whole.width,
                                                     whole.height, whole.frame.map_resolution, reach);
    // A warped map has wider and narrower texels.
    const ReferenceImage own = !shot.light().is_warped()
                                   ? reference
                                   : trace_reference(RayReference(scene), whole.frame.camera, shot.light(), whole.width,
                                                     whole.height, whole.frame.map_resolution, reach);
    const Tolerance& tolerance = filter_of(s).tolerance;
    int lit = 0, dark = 0, beyond = 0;
    for (std::size_t i = 0; i < reference.states.size(); ++i) {
        const ReferenceState is = reference.states[i];
        if (is != ReferenceState::Lit && is != ReferenceState::Shadow && is != ReferenceState::Boundary) continue;
        if (reference.hits[i]->normal.y < 0.5) continue;  // sides of the box lie within the bias of its top
        const double v = shot.visibility.data[i];
        const glm::dvec4 at = uvdw(view_of(shot.light(), reference.hits[i]->position), reference.hits[i]->position);
        const bool outside = std::min({at.x, at.y, 1 - at.x, 1 - at.y}) < 0;
        if (outside && shot.light().closed) {
            ++beyond;
            EXPECT_NE(is, ReferenceState::Shadow) << "pixel " << i;
            EXPECT_EQ(v, 1) << "pixel " << i;
        }
        if (is == ReferenceState::Boundary || own.states[i] == ReferenceState::Boundary) continue;
        (is == ReferenceState::Lit ? lit : dark) += 1;
        ASSERT_TRUE(is == ReferenceState::Lit ? v >= 1 - tolerance.lit : v <= tolerance.dark)
            << v << " at pixel " << i << " of " << c.fit;
        ASSERT_NEAR(v, whole.visibility.data[i], std::max(tolerance.lit, tolerance.dark)) << "pixel " << i;
    }
    EXPECT_GT(lit, 1000);
    EXPECT_GT(dark, 20);
    EXPECT_TRUE(row.narrows || !shot.light().closed);
    if (row.narrows && c.light != LightType::Point) {
        EXPECT_TRUE(shot.light().closed);
        EXPECT_LT(shot.view().half_extent(), 0.95 * whole.view().half_extent()) << "else there was nothing to narrow";
    }
    if (row.narrows && c.light == LightType::Directional && !c.seen_in_part) {
        EXPECT_GT(beyond, 100);
    }
}

// Without shadows a fit has no region to narrow to: everything is lit, inside the map and outside.
TEST_P(EachFit, LightsALonePlane) {
    Scene scene = make_scene(make_plane(8, 8));
    move_scene(scene, c.place.at);
    Settings s = settings();
    set_setting(s, "light.fit", c.fit);
    const Shot shot = draw_shot(scene, s, 80, 60);
    const ReferenceImage reference = trace_reference(RayReference(scene), shot, 0);
    int lit = 0;
    for (std::size_t i = 0; i < reference.states.size(); ++i) {
        if (reference.states[i] != ReferenceState::Lit) continue;
        ++lit;
        ASSERT_GE(shot.visibility.data[i], 1 - filter_of(s).tolerance.lit);
    }
    EXPECT_GT(lit, 1000);
}

// A spot light may have an orthographic map, and a sun a perspective one. Neither map has the light's own rays. The
// picture follows the map's own rays for every fit: of the sun that replaces the spot, and of the point that replaces
// the sun.
SI_TEST_IS(Later, EachFitInOtherProjection, AgreesWithTheReferenceAlongItsMapsRays);
TEST(EachFitInOtherProjection, AgreesWithTheReferenceAlongItsMapsRays) {
    const Scene scene = covered_in_part({0, 0, 0});
    for (const FitRow& row : fits())
        for (const LightType type : {LightType::Directional, LightType::Spot}) {
            SCOPED_TRACE(std::string(row.key) + (type == LightType::Spot ? ", spot" : ", sun"));
            const bool sun = type == LightType::Directional;
            Settings s = settings_with(texel_settings("pcf3", 512, 0), {"light.azimuth=30",
                                                                        "light.elevation=60",
                                                                        "light.distance=9",
                                                                        "light.cone=100",
                                                                        {"light.fit", std::string(row.key)},
                                                                        "bias.unit=metres",
                                                                        "bias.constant=0.4"});
            s.lights[0].type = type;
            s.lights[0].projection = sun ? LightProjection::Perspective : LightProjection::Orthographic;
            const Shot shot = draw_shot(scene, s);
            ASSERT_EQ(shot.light().views.size(), 1u) << "cascades are for parallel rays";
            EXPECT_FALSE(shot.light().closed) << "narrowed fits promise something of the light's own rays";
            EXPECT_FALSE(shot.light().is_warped());
            EXPECT_EQ(shot.light().is_perspective(), sun);
            FittedLight as_mapped = shot.light();
            as_mapped.type = sun ? LightType::Point : LightType::Directional;
            as_mapped.position = shot.view().eye;
            const ReferenceImage reference =
                trace_reference(RayReference(scene), shot.frame.camera, as_mapped, shot.width, shot.height,
                                shot.frame.map_resolution, kernel_reach_in_light(s, shot.light(), 512).edge + 1.5);
            int lit = 0, dark = 0;
            for (std::size_t i = 0; i < reference.states.size(); ++i) {
                const ReferenceState is = reference.states[i];
                if ((is != ReferenceState::Lit && is != ReferenceState::Shadow) || reference.hits[i]->normal.y < 0.5)
                    continue;
                const glm::dvec3 at = uvdw(shot.view(), reference.hits[i]->position);
                if (std::min({at.x, at.y, 1 - at.x, 1 - at.y}) < 0.02) continue;
                (is == ReferenceState::Lit ? lit : dark) += 1;
                ASSERT_NEAR(shot.visibility.data[i], is == ReferenceState::Lit, 1e-6) << "pixel " << i;
            }
            EXPECT_GT(lit, 1000);
            EXPECT_GT(dark, 150);
        }
}

INSTANTIATE_TEST_SUITE_P(All, EachFit, testing::ValuesIn(fit_cases()), fit_name);

}  // namespace
}  // namespace si::test
