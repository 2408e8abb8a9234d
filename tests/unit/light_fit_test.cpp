// Tests of light views and their fits to a scene.
#include "renderer/view/fits/light_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "renderer/base/directions.h"
#include "renderer/base/index_of.h"
#include "renderer/settings/fits.h"
#include "tests/support/box_scene.h"
#include "tests/support/sets.h"

namespace si {
namespace {

using test::box_scene;
using test::BoxExtent;

Settings one_light(LightType type) {
    Settings s;
    s.light_count = 1;
    s.lights[0].type = type;
    return s;
}

bool all_finite(const FittedLight& light) {
    bool ok = std::isfinite(light.cos_cone_outer) && std::isfinite(light.cos_cone_inner);
    for (int i = 0; i < 3; ++i)
        ok = ok && std::isfinite(light.position[i]) && std::isfinite(light.to_light[i]) &&
             std::isfinite(light.radiance[i]);
    for (const LightView& v : light.views) {
        const glm::dmat4 m = v.clip_from_relative(light.position);
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) ok = ok && std::isfinite(m[i][j]);
        ok = ok && std::isfinite(v.half_extent()) && v.half_extent() > 0 && v.curve.far > v.curve.near;
        ok = ok && (!v.curve.perspective || v.curve.near > 0);
        ok = ok && float(v.curve.far) > float(v.curve.near);  // in the precision of shaders
    }
    return ok && !light.views.empty();
}

void expect_basis(const glm::dvec3& n) {
    const glm::dmat3 m = orthonormal_basis(n);
    const glm::dmat3 product = glm::transpose(m) * m;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) ASSERT_LE(std::abs(product[i][j] - (i == j)), 1e-6);
    ASSERT_NEAR(glm::determinant(m), 1, 1e-6);
    ASSERT_EQ(m[2], n);
}

TEST(LightFit, FarDirectionalLightHasARangeForShaders) {
    // The target, or the light along its rays, is far off; found by random settings.
    for (const auto& [distance, aside] : {std::pair{0.0, 6.2e7}, {1e7, 0.0}, {1e7, -1e8}}) {
        Settings s = one_light(LightType::Directional);
        s.lights[0].distance = distance;
        s.lights[0].target_z = aside;
        const Scene scene =
            box_scene({{glm::dvec3(-1, 0, -1), glm::dvec3(1, 2, 1)}, {glm::dvec3(-5, -0.1, -5), glm::dvec3(5, 0, 5)}});
        const FittedLight light = fit_lights(scene, s)[0];
        ASSERT_EQ(light.views.size(), 1u);
        const LightView& view = light.views[0];
        const float near = float(view.curve.near), far = float(view.curve.far);
        EXPECT_GT(far - near, 1) << "near " << near;
        EXPECT_TRUE(std::isfinite(1 / (far - near)));
        // Points of the scene are still inside the map.
        const glm::dvec4 clip = view.clip_from_relative({0, 0, 0}) * glm::dvec4(0, 1, 0, 1);
        EXPECT_LT(std::abs(clip.x), 1);
        EXPECT_LT(std::abs(clip.y), 1);
        EXPECT_GT(clip.z, 0);
        EXPECT_LT(clip.z, 1);
    }
}

TEST(Basis, IsOrthonormalForEveryDirection) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 100000; ++i)
        expect_basis(glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
    for (int axis = 0; axis < 3; ++axis)
        for (double sign : {-1.0, 1.0})
            for (double tilt : {0.0, 1e-4, 1e-7, 1e-12, -1e-12}) {
                glm::dvec3 n(0);
                n[axis] = sign;
                expect_basis(n);
                n[(axis + 1) % 3] = tilt;
                expect_basis(glm::normalize(n));
            }
}

TEST(Basis, AnglesGiveTheirDirection) {
    const auto near_to = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) < 1e-15; };
    EXPECT_TRUE(near_to(direction_from_angles(0, 0), {0, 0, 1}));
    EXPECT_TRUE(near_to(direction_from_angles(90, 0), {1, 0, 0}));
    EXPECT_TRUE(near_to(direction_from_angles(123, 90), {0, 1, 0}));
    EXPECT_TRUE(near_to(direction_from_angles(180, -45), {0, -std::sqrt(0.5), -std::sqrt(0.5)}));
}

/// Largest |x|, |y| of the scene's corners in the map and the range of their depths, through the given
/// views.
struct Coverage {
    double aside = 0, lo = 1, hi = 0;
};
Coverage coverage(const FittedLight& light, const Scene& scene) {
    Coverage c;
    for (const Object& o : scene.objects)
        for (const glm::vec3& p : scene.meshes[o.mesh].positions) {
            const glm::dvec3 world(o.world * glm::dvec4(glm::dvec3(p), 1));
            double aside = INFINITY, depth = 0;
            for (const LightView& v : light.views) {
                const glm::dvec4 q = v.clip_from_relative(world)[3];
                if (q.w <= 0) continue;
                const double here = std::max(std::abs(q.x), std::abs(q.y)) / q.w;
                if (here < aside) {
                    aside = here;
                    depth = q.z / q.w;
                }
            }
            c.aside = std::max(c.aside, aside);
            c.lo = std::min(c.lo, depth);
            c.hi = std::max(c.hi, depth);
        }
    return c;
}

TEST(LightFit, SceneFitHoldsTheScene) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 1000; ++i) {
        const double scale = std::pow(10.0, 6 * unit(random));
        const glm::dvec3 offset = glm::dvec3(unit(random), unit(random), unit(random)) * (i % 2 ? 1e3 * scale : 0.0);
        std::vector<BoxExtent> boxes;
        for (int b = 0; b <= i % 4; ++b) {
            const glm::dvec3 at(unit(random), unit(random), unit(random)),
                half(1 + unit(random), 1, 1.01 + unit(random));
            boxes.push_back({scale * (3.0 * at - half), scale * (3.0 * at + half)});
        }
        const Scene scene = box_scene(boxes, offset);
        Settings s = one_light(LightType(i % 3));
        s.lights[0].fit = LightFit::Scene;
        s.lights[0].azimuth = 180 * unit(random);
        s.lights[0].elevation = 90 * unit(random);
        s.lights[0].cone = 85 + 80 * unit(random);
        s.lights[0].projection = i % 3 == 0 && i % 2 ? LightProjection::Perspective : LightProjection::Automatic;
        s.map.reversed_z = i % 5 == 0;
        s.map.resolution = 64 << (i % 6);
        const FittedLight light = fit_lights(scene, s)[0];
        ASSERT_TRUE(all_finite(light)) << i;
        ASSERT_EQ(light.views.size(), light.type == LightType::Point ? 6u : 1u);
        ASSERT_TRUE(light.casts);
        const Coverage c = coverage(light, scene);
        ASSERT_LT(c.aside, 1) << i;
        ASSERT_GE(c.lo, 0) << i;
        ASSERT_LE(c.hi, 1) << i;
        EXPECT_EQ(light.clipped_casters, 0) << i;
        if (light.type != LightType::Directional) continue;
        // Tight: only the margin is added across, and almost nothing in depth.
        ASSERT_GT(c.aside, 1 - 5.0 / s.map.resolution) << i;
        ASSERT_LT(c.lo, 1e-3);
        ASSERT_GT(c.hi, 0.999);
        // At least a texel of margin.
        ASSERT_LT(c.aside, 1 - 2.0 / s.map.resolution) << i;
    }
}

TEST(LightFit, ViewLooksAlongTheLight) {
    Settings s =
        settings_with(one_light(LightType::Spot), {"light.azimuth=90", "light.elevation=0", "light.distance=7"});
    const Scene scene = box_scene({{glm::dvec3(1), glm::dvec3(3)}});
    const FittedLight light = fit_lights(scene, s)[0];
    EXPECT_NEAR(glm::distance(light.position, glm::dvec3(9, 2, 2)), 0, 1e-12);
    const LightView& v = light.views[0];
    EXPECT_NEAR(glm::distance(v.axes[2], glm::dvec3(1, 0, 0)), 0, 1e-12);
    const glm::dvec4 centre = v.clip_from_relative({2, 2, 2})[3];
    EXPECT_NEAR(centre.w, 7, 1e-12);
    EXPECT_NEAR(centre.z / centre.w, v.curve.depth(7), 1e-12);
    EXPECT_LT(v.clip_from_relative({10, 2, 2})[3].w, 0);  // behind the light
}

TEST(LightFit, FacesOfAPointLightCoverEveryDirection) {
    Settings s = one_light(LightType::Point);
    s.lights[0].distance = 1e-3;
    const FittedLight light = fit_lights(box_scene({{glm::dvec3(-5), glm::dvec3(5)}}), s)[0];
    const glm::dvec3 forward[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int f = 0; f < 6; ++f) {
        const LightView& v = light.views[f];
        EXPECT_EQ(v.axes[2], -forward[f]);
        EXPECT_EQ(glm::determinant(v.axes), 1);
        EXPECT_EQ(v.curve.near, light.views[0].curve.near);  // shaders know one range per light
        EXPECT_EQ(v.curve.far, light.views[0].curve.far);
        // A corner direction shared with two other faces is inside, with spare texels for kernels.
        const glm::dvec3 corner = forward[f] + v.axes[0] + v.axes[1];
        const glm::dvec4 q = v.clip_from_relative(light.position + corner)[3];
        EXPECT_NEAR(q.x / q.w, 1 - 12.0 / s.map.resolution, 1e-6);
        EXPECT_NEAR(q.y / q.w, 1 - 12.0 / s.map.resolution, 1e-6);
    }
}

TEST(LightFit, SceneOffsetOfAMillionMetresChangesNothing) {
    const std::vector<BoxExtent> boxes = {{glm::dvec3(-4, 0, -4), glm::dvec3(4, 0.25, 4)},
                                          {glm::dvec3(0, 0.25, 0), glm::dvec3(1, 2.5, 1)}};
    const glm::dvec3 offset(1 << 20, -(1 << 19), 1 << 20);
    for (LightType type : {LightType::Directional, LightType::Spot, LightType::Point}) {
        const Settings s = one_light(type);
        const FittedLight a = fit_lights(box_scene(boxes), s)[0], b = fit_lights(box_scene(boxes, offset), s)[0];
        for (std::size_t i = 0; i < a.views.size(); ++i) {
            const glm::dmat4 p = a.views[i].clip_from_relative(glm::dvec3(1)),
                             q = b.views[i].clip_from_relative(offset + glm::dvec3(1));
            for (int k = 0; k < 4; ++k)
                // 4 ulp of a double at the offset, in a map that is some 10 m wide
                for (int l = 0; l < 4; ++l)
                    EXPECT_NEAR(p[k][l], q[k][l], 4 * 2.4e-10 * std::max(1.0, std::abs(p[k][l])))
                        << int(type) << k << l;
        }
        EXPECT_NEAR(glm::length(a.radiance - b.radiance), 0, 1e-9 * glm::length(a.radiance));
    }
}

TEST(LightFit, SpotAnglesStayFinite) {
    const Scene scene = box_scene({{glm::dvec3(-1), glm::dvec3(1)}});
    for (double cone :
         {0.0, 1e-4, 89.9, 90.0, 120.0, 170.0, 2 * 89.9, 180.0, 360.0, 1e9, -5.0, double(NAN), double(INFINITY)})
        for (const LightProjection projection :
             {LightProjection::Automatic, LightProjection::Orthographic, LightProjection::Perspective})
            for (double distance : {0.0, 0.1, 30.0}) {
                Settings s = one_light(LightType::Spot);
                s.lights[0].cone = cone;
                s.lights[0].projection = projection;
                s.lights[0].distance = distance;
                EXPECT_TRUE(all_finite(fit_lights(scene, s)[0])) << cone << " " << index_of(projection);
                s.lights[0].fit = LightFit::Scene;
                const FittedLight light = fit_lights(scene, s)[0];
                ASSERT_TRUE(all_finite(light)) << cone << " " << index_of(projection);
                const bool wide = 0.5 * cone * M_PI / 180 > 1.5;
                EXPECT_EQ(light.views.size(), wide ? 6u : 1u) << cone;
                const bool narrow = std::isnan(cone) || cone < 0.1;
                EXPECT_EQ(!light.notes.empty(), wide || narrow) << cone;
                if (!wide && !narrow && projection != LightProjection::Orthographic) {
                    EXPECT_NEAR(light.views[0].half_extent(), std::tan(0.5 * cone * M_PI / 180), 0.01 * std::tan(1.5));
                }
                EXPECT_LE(light.cos_cone_outer, light.cos_cone_inner);
            }
}

TEST(LightFit, ManualMapOfASpotIsAtMostItsCone) {
    const Scene scene = box_scene({{glm::dvec3(-1), glm::dvec3(1)}});
    Settings s = settings_with(one_light(LightType::Spot), {"light.fit=manual", "light.cone=60", "light.distance=8"});
    LightSettings& l = s.lights[0];
    const double of_cone = fit_lights(scene, s)[0].views[0].half_extent();
    EXPECT_NEAR(of_cone, std::tan(M_PI / 6), 0.01);
    l.extent = 2;
    EXPECT_DOUBLE_EQ(fit_lights(scene, s)[0].views[0].half_extent(), 2.0 / 8);
    l.extent = 100;
    EXPECT_EQ(fit_lights(scene, s)[0].views[0].half_extent(), of_cone);
    l.extent = 1e-300;
    EXPECT_TRUE(all_finite(fit_lights(scene, s)[0]));
}

TEST(LightFit, StaysFiniteForDegenerateScenes) {
    std::vector<Scene> scenes = {Scene()};
    for (double scale : {1e-6, 1e-3, 1.0, 1e3, 1e7})
        for (double offset : {0.0, 1e6}) {
            scenes.push_back(box_scene({{glm::dvec3(scale), glm::dvec3(scale)}}, glm::dvec3(offset)));
            scenes.push_back(
                box_scene({{glm::dvec3(-scale, 0, -scale), glm::dvec3(scale, 0, scale)}}, glm::dvec3(offset)));
            scenes.push_back(box_scene({{glm::dvec3(-scale, 0, 0), glm::dvec3(scale, 0, 0)}}, glm::dvec3(offset)));
        }
    for (std::size_t i = 0; i < scenes.size(); ++i)
        for (const LightType type : {LightType::Directional, LightType::Spot, LightType::Point})
            for (const LightProjection projection :
                 {LightProjection::Automatic, LightProjection::Orthographic, LightProjection::Perspective})
                for (double distance : {0.0, 1e-9, 1.0, 1e7})
                    for (double elevation : {90.0, 0.0, 30.0})
                        for (int resolution : {1, 16384})
                            for (LightFit fit : {LightFit::Scene, LightFit::Casters}) {
                                Settings s = one_light(type);
                                s.lights[0].fit = fit;
                                s.lights[0].projection = projection;
                                s.lights[0].distance = distance;
                                s.lights[0].elevation = elevation;
                                s.map.resolution = resolution;
                                const FittedLight light = fit_lights(scenes[i], s)[0];
                                ASSERT_TRUE(all_finite(light))
                                    << i << " " << index_of(type) << " " << index_of(projection) << " " << distance;
                                const LightView& v = light.views[0];
                                // A wide perspective map of one texel has no shorter range.
                                const double texel = v.texel_size(v.curve.far, resolution);
                                const double least =
                                    v.curve.perspective ? std::min(2 * texel, 1e-4 * v.curve.far) : 2 * texel;
                                ASSERT_GE(v.curve.far - v.curve.near, least * 0.999) << i << " " << index_of(type);
                            }
}

TEST(LightFit, NonFiniteSettingsAreReplaced) {
    const Scene scene = box_scene({{glm::dvec3(-1), glm::dvec3(1)}});
    for (double bad : {double(NAN), double(INFINITY), -double(INFINITY), -1.0})
        for (const LightType type : {LightType::Directional, LightType::Spot, LightType::Point})
            for (int fit = 0; fit < int(fits().size()); ++fit) {
                Settings s = one_light(type);
                LightSettings& l = s.lights[0];
                l.fit = LightFit(fit);
                l.azimuth = l.elevation = l.distance = l.target_x = l.target_y = l.target_z = bad;
                l.cone = l.cone_blend = l.intensity = l.red = l.near = l.far = l.extent = bad;
                EXPECT_TRUE(all_finite(fit_lights(scene, s)[0])) << bad << " " << index_of(type) << " " << fit;
            }
}

TEST(LightFit, WorksForALightInsideTheScene) {
    const Scene scene = box_scene({{glm::dvec3(-5, -1, -5), glm::dvec3(5, 0, 5)}, {glm::dvec3(-1), glm::dvec3(1)}});
    Settings s = settings_with(one_light(LightType::Spot), {"light.distance=0.2", "light.elevation=90"});
    FittedLight light = fit_lights(scene, s)[0];
    EXPECT_GT(light.views[0].curve.near, 0);
    EXPECT_EQ(light.clipped_casters, 1);  // the light is inside the cube and above the floor
    s.objects["box1"].cast = false;
    EXPECT_EQ(fit_lights(scene, s)[0].clipped_casters, 0);
    s.objects.clear();
    s.lights[0].distance = 20;
    EXPECT_EQ(fit_lights(scene, s)[0].clipped_casters, 0);
    set_all(s, {"light.fit=manual", "light.near=19.4", "light.far=21"});
    light = fit_lights(scene, s)[0];
    EXPECT_EQ(light.views[0].curve.near, 19.4);
    EXPECT_EQ(light.views[0].curve.far, 21);
    EXPECT_EQ(light.clipped_casters, 1);
}

TEST(LightFit, RangeEndsTheMap) {
    // A floor 10 m below the light and a wall 30 m away from it.
    const Scene scene = box_scene({{glm::dvec3(-40, -1, -40), glm::dvec3(40, 0, 40)}, {{30, 0, -40}, {31, 20, 40}}});
    for (const auto& [type, projection] : {std::pair{LightType::Point, LightProjection::Automatic},
                                           {LightType::Spot, LightProjection::Automatic},
                                           {LightType::Spot, LightProjection::Orthographic}})
        for (const double range : {0.001, 5.0, 12.0, 25.0, 1e4}) {
            Settings s = settings_with(one_light(type), {"light.elevation=90", "light.cone=150", "light.distance=10"});
            LightSettings& l = s.lights[0];
            l.projection = projection;
            l.target_y = -scene.bounds.centre().y;
            const FittedLight endless = fit_lights(scene, s)[0];
            l.range = range;
            const FittedLight light = fit_lights(scene, s)[0];
            ASSERT_TRUE(all_finite(light)) << int(type) << " " << range;
            EXPECT_EQ(light.range_m, range);
            // Parallel rays let the wall's box reach behind the light.
            EXPECT_EQ(!light.notes.empty(), range < 10 && projection == LightProjection::Automatic)
                << "which says that it reaches nothing";
            EXPECT_EQ(light.radiance, endless.radiance) << "a range changes no brightness near the light";
            for (std::size_t v = 0; v < light.views.size(); ++v) {
                const DepthCurve &limited = light.views[v].curve, &free = endless.views[v].curve;
                if (range == 1e4) {
                    EXPECT_EQ(limited.far, free.far) << "nothing is so far away";
                }
                if (range < 10) {
                    EXPECT_LT(limited.far, 1.5 * range + 0.2) << "nothing is so near";
                }
                if (range == 12 || range == 25) {
                    EXPECT_GE(limited.far, std::min(range, free.far)) << "what is lit must be in the map";
                    EXPECT_LE(limited.far, std::min(range, free.far) * 1.001);
                    EXPECT_NEAR(limited.near, free.near, 0.01 * range);
                }
            }
            l.type = LightType::Directional;
            EXPECT_EQ(fit_lights(scene, s)[0].range_m, 0);
        }
    EXPECT_TRUE(within_range(1e9, 0));
    EXPECT_TRUE(within_range(11.9, 12));
    EXPECT_FALSE(within_range(12, 12));
}

TEST(LightFit, ManualFitUsesItsNumbers) {
    const Scene scene = box_scene({{glm::dvec3(-1), glm::dvec3(1)}});
    Settings s =
        settings_with(one_light(LightType::Directional), {"light.fit=manual", "light.distance=12", "light.extent=3",
                                                          "light.near=2", "light.far=30", "light.target_x=1"});
    LightSettings& l = s.lights[0];
    FittedLight light = fit_lights(scene, s)[0];
    EXPECT_EQ(light.views[0].half_extent(), 3);
    EXPECT_EQ(light.views[0].curve.near, 2);
    EXPECT_EQ(light.views[0].curve.far, 30);
    EXPECT_NEAR(glm::distance(light.views[0].eye, glm::dvec3(1, 0, 0) + 12.0 * light.to_light), 0, 1e-12);
    l.near = 30;
    l.far = 2;
    light = fit_lights(scene, s)[0];
    EXPECT_TRUE(all_finite(light));
    EXPECT_FALSE(light.notes.empty());
    // Zeros leave the fit's values.
    l = LightSettings();
    l.fit = LightFit::Scene;
    const FittedLight fitted = fit_lights(scene, s)[0];
    l.fit = LightFit::Manual;
    EXPECT_EQ(fit_lights(scene, s)[0].views[0].projection, fitted.views[0].projection);
}

TEST(LightFit, ReportsWhyNothingCasts) {
    Scene scene = box_scene({{glm::dvec3(-1), glm::dvec3(1)}});
    Settings s = one_light(LightType::Directional);
    EXPECT_TRUE(fit_lights(scene, s)[0].casts);
    s.objects["box0"].cast = false;
    EXPECT_EQ(fit_lights(scene, s)[0].reason, "no object casts");
    EXPECT_FALSE(fit_lights(scene, s)[0].casts);
    s.objects["box0"] = {.receive = false};
    EXPECT_EQ(fit_lights(scene, s)[0].reason, "no object receives shadows");
    s.lights[0].cast = false;
    EXPECT_EQ(fit_lights(scene, s)[0].reason, "light.cast is off");
    s.lights[0].cast = true;
    EXPECT_EQ(fit_lights(Scene(), s)[0].reason, "the scene has no triangles");
    s.light_count = 0;
    EXPECT_TRUE(fit_lights(scene, s).empty());
}

TEST(LightFit, BrightestPunctualLightIsOneAtTheCentre) {
    const Scene scene = box_scene({{glm::dvec3(-1), glm::dvec3(1)}}, glm::dvec3(50, 0, 0));
    Settings s;
    s.light_count = 3;
    set_all(s, {"light.type=spot", "light.distance=10", "light.intensity=100", "light.1.type=point",
                "light.1.distance=5", "light.1.intensity=50", "light.1.green=0.5", "light.2.intensity=3"});
    const auto lights = fit_lights(scene, s);
    const auto at_centre = [&](int i) {
        const glm::dvec3 d = lights[i].position - scene.bounds.centre();
        return lights[i].radiance / glm::dot(d, d);
    };
    EXPECT_NEAR(at_centre(1).r, 1, 1e-12);
    EXPECT_NEAR(at_centre(1).g, 0.5, 1e-12);
    EXPECT_NEAR(at_centre(0).r, 0.5, 1e-12);
    EXPECT_EQ(lights[2].radiance, glm::dvec3(3));
    s.light_count = 1;
    s.lights[0].distance = 1e-12;
    EXPECT_TRUE(all_finite(fit_lights(scene, s)[0]));
    EXPECT_LT(fit_lights(scene, s)[0].radiance.r, 10);
}

}  // namespace
}  // namespace si
