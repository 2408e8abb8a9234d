// Tests of maps warped towards the camera (light.fit lispsm): their contents and texel sizes.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "renderer/base/angles.h"
#include "renderer/view/bounds/scene_shape.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/cascades/cascades.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/box_scene.h"
#include "tests/support/ray_reference.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si {
namespace {

Settings warped(const glm::dvec3& target) {
    Settings s;
    s.lights[0].fit = LightFit::Lispsm;
    s.map.resolution = 512;
    CameraSettings& c = s.camera;
    c.source = CameraSource::Manual;
    set_target(c, target);
    c.distance = 9;
    c.elevation = 12;
    return s;
}

/// Makes a camera 2 m above the ground that looks along -z, and a light from above whose rays have that angle to its
/// view.
Settings level_view(double angle_deg) {
    // An offset along normals would widen the map.
    Settings s = settings_with(warped({0, 2, 20}), {"camera.azimuth=0", "camera.elevation=0", "camera.distance=10",
                                                    "camera.near=0.5", "bias.normal=0", "light.azimuth=0"});
    s.lights[0].elevation = angle_deg;
    return s;
}

struct Fitted {
    Camera camera;
    FittedLight light;
    std::shared_ptr<const SceneShape> shape;
};
Fitted fitted(const Scene& scene, const Settings& s) {
    const PlacedLights placed = place_lights(scene, s);
    Fitted f{make_camera(scene, s, 16.0 / 9), {}, placed.shape};
    f.light = fit_maps(placed, scene, s, &f.camera)[0];
    return f;
}

/// Returns w of clip space for each point.
double w_at(const LightView& view, const glm::dvec3& p) {
    return view.clip_from_relative(p)[3][3];
}

constexpr NearFar kNearFars[] = {NearFar::Fitted, NearFar::Manual, NearFar::Casters, NearFar::Scene,
                                 NearFar::Pancaking};

SI_TESTS_ARE(Repeated, WarpedFit);
TEST(WarpedFit, HoldsVisibleReceiversAndTheirCasters) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::size_t seen = 0, before = 0;
    double most_ratio = 1;
    for (const glm::dvec3& at : {glm::dvec3(0), glm::dvec3(115, 0, -115), glm::dvec3(1e5, 0, 3e4)}) {
        const Scene scene = test::blocks_on_ground(at, 0.01);
        for (int i = 0; i < 60; ++i) {
            SCOPED_TRACE(testing::Message() << at.x << " " << i);
            Settings s = warped(at + glm::dvec3(20 * unit(random), 1, 20 * unit(random)));
            s.camera.azimuth = 180 * unit(random);
            s.camera.elevation = 5 + 40 * std::abs(unit(random));
            LightSettings& l = s.lights[0];
            l.azimuth = i % 5 ? 180 * unit(random) : 90;
            l.elevation = i % 7 ? 8 + 80 * std::abs(unit(random)) : 90;
            l.cascades = i % 3 ? 1 : 3;
            l.near_far = kNearFars[i % 5];
            s.bias.normal = 3;
            l.near = 1;
            l.far = 2;
            s.map.reversed_z = i % 2;
            const Fitted f = fitted(scene, s);
            ASSERT_TRUE(f.light.is_warped());
            for (const LightView& view : f.light.views) {
                const TexelSize sizes = view.texel_size_range(s.map.resolution);
                most_ratio = std::max(most_ratio, sizes.longest / sizes.shortest);
            }
            const CameraSlice slice(f.camera, f.camera.curve.near, f.camera.curve.far);
            for (const Box& box : f.shape->boxes)
                for (const glm::dvec3& p : slice.visible_points(box)) {
                    const LightView& view = f.light.views[f.light.chooser.choose(f.light.views, p).view];
                    const glm::dvec4 at_map = test::uvdw(view, p);
                    ASSERT_GT(at_map.w, 0);
                    for (int axis = 0; axis < 2; ++axis) {
                        EXPECT_GT(at_map[axis], 2.0 / 512) << "a kernel has room";
                        EXPECT_LT(at_map[axis], 1 - 2.0 / 512);
                    }
                    // Normal offsets in every direction stay inside the map.
                    const double offset = s.bias.normal * view.texel_size_at(p, 512).longest;
                    ASSERT_GT(offset, 0);
                    for (int way = 0; way < 4; ++way) {
                        const glm::dvec3 aside = (way & 1 ? offset : -offset) * view.axes[way >> 1];
                        const glm::dvec4 moved = test::uvdw(view, p + aside);
                        EXPECT_GT(std::min({moved.x, moved.y, 1 - moved.x, 1 - moved.y}), 0);
                    }
                    // Receivers without a caster in front may be in front of a range that starts at the casters.
                    const double share = s.map.reversed_z ? 1 - at_map.z : at_map.z;
                    if (l.near_far != NearFar::Casters) {
                        EXPECT_GT(share, 0);
                    }
                    EXPECT_LT(share, 1);
                    ++seen;
                    if (l.near_far == NearFar::Pancaking) continue;
                    for (const Box& caster : f.shape->boxes)
                        for (const glm::dvec3& q : caster) {
                            const glm::dvec4 of_caster = test::uvdw(view, q);
                            if (!(of_caster.w > 0) ||
                                std::min({of_caster.x, of_caster.y, 1 - of_caster.x, 1 - of_caster.y}) < 0)
                                continue;
                            EXPECT_GE(s.map.reversed_z ? 1 - of_caster.z : of_caster.z, 0) << "drawn";
                            ++before;
                        }
                }
        }
    }
    EXPECT_GT(seen, 5000u);
    EXPECT_GT(before, 100000u);
    EXPECT_GT(most_ratio, 10) << "else nothing was warped";
}

// The paper's choice, derived independently: the plane of w = 0 is n_opt in front of the nearest held depth. Texels
// grow by the square of ((n + d) / n) along the view, and by that factor across it.
TEST(WarpedFit, TexelsGrowByTheFormulaOfThePaper) {
    const Scene scene = test::blocks_on_ground({0, 0, 0}, 0.01);
    for (const double angle : {90.0, 60.0, 30.0, 12.0}) {
        SCOPED_TRACE(angle);
        const Settings s = level_view(angle);
        const Fitted f = fitted(scene, s);
        const LightView& view = f.light.views[0];
        const glm::dvec3 forward = -f.camera.axes[2], along = view.axes[1];
        double nearest = 1e300, lo = 1e300, hi = -1e300;
        glm::dvec3 first(0), last(0);
        const CameraSlice slice(f.camera, f.camera.curve.near, f.camera.curve.far);
        for (const Box& box : f.shape->boxes)
            for (const glm::dvec3& p : slice.visible_points(box)) {
                nearest = std::min(nearest, glm::dot(p - f.camera.eye, forward));
                const double y = glm::dot(p, along);
                if (y < lo) {
                    lo = y;
                    first = p;
                }
                if (y > hi) {
                    hi = y;
                    last = p;
                }
            }
        const double sine = std::sin(angle * kDegree), d = hi - lo;
        EXPECT_NEAR(glm::dot(along, forward), sine, 1e-9);
        const double n_opt = (nearest + std::sqrt(nearest * (nearest + d * sine))) / sine;
        const double ratio = (n_opt + d) / n_opt;
        EXPECT_NEAR(w_at(view, last) / w_at(view, first), ratio, 1e-6 * ratio);
        EXPECT_NEAR(w_at(view, first - along * n_opt), 0, 1e-9 * w_at(view, last));
        // Texels along the view, by differences of points half a texel to both sides.
        const auto texel_along = [&](const glm::dvec3& p) {
            const double step = 1e-4;
            return 2 * step / (512 * (test::uvdw(view, p + step * along).y - test::uvdw(view, p - step * along).y));
        };
        EXPECT_NEAR(texel_along(last) / texel_along(first), ratio * ratio, 1e-4 * ratio * ratio);
        if (angle == 90.0) {
            EXPECT_GT(texel_along(last), 5 * texel_along(first));
        }
    }
}

TEST(WarpedFit, TexelSizesAndDepthsMatchTheMatrix) {
    const Scene scene = test::blocks_on_ground({0, 0, 0}, 0.01);
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const bool reversed : {false, true})
        for (const double angle : {90.0, 35.0, 10.0}) {
            Settings s = level_view(angle);
            s.lights[0].azimuth = 25;
            s.map.reversed_z = reversed;
            const LightView view = fitted(scene, s).light.views[0];
            const TexelSize all = view.texel_size_range(512);
            for (int i = 0; i < 200; ++i) {
                const glm::dvec2 uv(unit(random), unit(random));
                const DepthCurve row = view.curve.curve_at_row(uv.y);
                EXPECT_GE(row.near, view.curve.near - 1e-9);
                EXPECT_LE(row.far, view.curve.far + 1e-9);
                const double z = row.near + unit(random) * (row.far - row.near);
                const glm::dvec3 p = view.position_ws(uv, z);
                const glm::dvec4 back = test::uvdw(view, p);
                EXPECT_NEAR(back.x, uv.x, 1e-10);
                EXPECT_NEAR(back.y, uv.y, 1e-10);
                EXPECT_NEAR(back.z, row.depth(z), 1e-10);
                EXPECT_EQ(view.clip_position(p), view.clip_from_relative(p)[3]);
                EXPECT_NEAR(view.ray_depth_curve(p).distance(back.z), z, 1e-6);
                EXPECT_NEAR(glm::dot(view.eye - p, view.axes[2]), z, 1e-9);
                // Returns the longest and the shortest step across the rays that moves the place by a texel, in turns.
                double longest = 0, shortest = 1e300;
                for (int turn = 0; turn < 360; ++turn) {
                    const double a = turn * 0.5 * kDegree, step = 1e-5;
                    const glm::dvec3 aside = std::cos(a) * view.axes[0] + std::sin(a) * view.axes[1];
                    const glm::dvec4 moved = test::uvdw(view, p + step * aside);
                    const double texel = step / (512 * std::hypot(moved.x - back.x, moved.y - back.y));
                    longest = std::max(longest, texel);
                    shortest = std::min(shortest, texel);
                }
                const TexelSize own = view.texel_size_at(p, 512);
                EXPECT_NEAR(own.longest / longest, 1, 0.01);
                EXPECT_NEAR(own.shortest / shortest, 1, 0.01);
                EXPECT_LE(own.longest, all.longest * (1 + 1e-9));
                EXPECT_GE(own.shortest, all.shortest * (1 - 1e-9));
            }
        }
}

// The warp fades as the light turns into the view or against it, and places in the map move by small steps only.
TEST(WarpedFit, WarpFadesForLightAlongTheView) {
    const Scene scene = test::blocks_on_ground({0, 0, 0}, 0.01);
    for (const double azimuth : {0.0, 180.0}) {  // towards the camera, and from behind
        std::vector<glm::dvec2> last;
        double last_ratio = 1e300, moved = 0;
        for (double angle = 20; angle >= 0; angle -= 0.125) {
            Settings s = level_view(angle);
            s.lights[0].azimuth = azimuth;
            const LightView view = fitted(scene, s).light.views[0];
            const double ratio = 1 + view.curve.warp->rise;
            EXPECT_LE(ratio, 1);
            if (angle < 20) {
                EXPECT_LE(1 / ratio, last_ratio * (1 + 1e-9)) << "at " << angle;
            }
            last_ratio = 1 / ratio;
            std::vector<glm::dvec2> places;
            for (int i = 0; i < 25; ++i)
                places.emplace_back(test::uvdw(view, glm::dvec3(i % 5 - 2, 0.5, 8 - 4 * (i / 5))));
            for (std::size_t i = 0; i < last.size(); ++i) moved = std::max(moved, glm::distance(places[i], last[i]));
            last = places;
        }
        EXPECT_NEAR(last_ratio, 1, 1e-12) << "straight along the view nothing is warped";
        EXPECT_LT(moved, 0.04) << "of the map, in an eighth of a degree";
    }
}

TEST(WarpedFit, ReportsUnwarpedViews) {
    const Scene scene = test::blocks_on_ground({0, 0, 0}, 0.01);
    Settings s = settings_with(level_view(60), {"camera.orthographic=true", "camera.height=10"});
    const FittedLight flat = fitted(scene, s).light;
    EXPECT_EQ(flat.views[0].curve.warp->rise, 0);
    ASSERT_FALSE(flat.notes.empty());
    EXPECT_NE(flat.notes[0].find("orthographic camera"), std::string::npos) << flat.notes[0];
    s = level_view(60);
    for (const LightType type : {LightType::Spot, LightType::Point}) {
        s.lights[0].type = type;
        EXPECT_FALSE(fitted(scene, s).light.is_warped());
    }
    s.lights[0].type = LightType::Directional;
    s.lights[0].projection = LightProjection::Perspective;
    EXPECT_FALSE(fitted(scene, s).light.is_warped());
    s.lights[0].projection = LightProjection::Automatic;
    EXPECT_TRUE(fitted(scene, s).light.is_warped());
    EXPECT_FALSE(fit_lights(scene, s)[0].is_warped()) << "without a camera";
}

}  // namespace
}  // namespace si
