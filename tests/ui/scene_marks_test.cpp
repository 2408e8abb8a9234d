// Tests of the ray to a probed pixel, a camera's outline in a map, and boxes of objects, compared with arithmetic by
// hand.
#include <gtest/gtest.h>

#include <cmath>

#include "renderer/base/directions.h"
#include "renderer/projection/projection.h"
#include "tests/support/box_scene.h"
#include "ui/scene_view/frustum_lines.h"
#include "ui/scene_view/probe_anchor.h"
#include "ui/state/selection.h"
#include "ui/widgets/clip.h"

namespace si {
namespace {

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-9) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

/// Makes one light from straight above, its map between 2 m and 12 m below `height`.
FittedLight from_above(double height, bool perspective) {
    FittedLight light;
    light.casts = true;
    LightView view;
    view.eye = {0, height, 0};
    view.axes = orthonormal_basis({0, 1, 0});
    view.curve = {perspective, 2, 12, {}};
    view.set_half_extents(glm::dvec2(perspective ? 0.5 : 5));
    light.views = {view};
    return light;
}

Probe probe_at(const glm::dvec3& position, const FittedLight& light, double stored_m, double visibility) {
    Probe p;
    p.hit = true;
    p.position_ws = position;
    Probe::PerLight l;
    l.casts = true;
    l.place = MapPlace::Inside;
    l.account.curve = light.views[0].curve;
    l.account.receiver.own_m = light.views[0].eye.y - position.y;
    l.stored_m = stored_m;
    l.visibility = visibility;
    p.lights = {l};
    return p;
}

TEST(ProbeRay, ParallelRaysBeginAtTheNearPlane) {
    const FittedLight light = from_above(12, false);
    const auto lit =
        probe_ray(probe_at({1, 0, 3}, light, 12.2, 1), probe_at({1, 0, 3}, light, 12.2, 1).lights[0], light);
    ASSERT_TRUE(lit);
    EXPECT_FALSE(lit->blocked);
    expect_near(lit->from, {1, 10, 3});
    expect_near(lit->occluder, {1, 0, 3});
    const Probe p = probe_at({1, 0, 3}, light, 5, 0);
    const auto blocked = probe_ray(p, p.lights[0], light);
    ASSERT_TRUE(blocked);
    EXPECT_TRUE(blocked->blocked);
    expect_near(blocked->occluder, {1, 7, 3});
    expect_near(blocked->to, {1, 0, 3});
}

TEST(ProbeRay, RaysOfAPunctualLightBeginAtIt) {
    const FittedLight light = from_above(10, true);
    const Probe p = probe_at({2, 0, 4}, light, 5, 0.25);
    const auto ray = probe_ray(p, p.lights[0], light);
    ASSERT_TRUE(ray);
    EXPECT_TRUE(ray->blocked);
    expect_near(ray->from, {0, 10, 0});
    expect_near(ray->occluder, {1, 5, 2});  // half the depth: half the way
}

TEST(ProbeRay, RaysOutsideTheMapOrInLightAreUnblocked) {
    const FittedLight light = from_above(12, false);
    Probe p = probe_at({1, 0, 3}, light, 5, 1);
    EXPECT_FALSE(probe_ray(p, p.lights[0], light)->blocked) << "the kernel found it lit";
    p.lights[0].visibility = 0;
    p.lights[0].place = MapPlace::Sides;
    EXPECT_FALSE(probe_ray(p, p.lights[0], light)->blocked);
    p.lights[0].place = MapPlace::Behind;
    EXPECT_FALSE(probe_ray(p, p.lights[0], light));
    p.lights[0].place = MapPlace::Inside;
    p.lights[0].casts = false;
    EXPECT_FALSE(probe_ray(p, p.lights[0], light));
    p.lights[0].casts = true;
    p.hit = false;
    EXPECT_FALSE(probe_ray(p, p.lights[0], light));
}

Camera level_camera() {
    Camera c;
    c.orthographic = true;
    c.height = 2;
    c.aspect = 2;
    c.focus = 10;
    c.curve = {false, 1, 5, {true, true}};
    return c;
}

TEST(CameraOutline, EdgesEndAtTheCornersOfClipSpace) {
    Camera perspective = level_camera();
    perspective.orthographic = false;
    perspective.curve.perspective = true;
    for (const Camera& c : {level_camera(), perspective}) {
        const auto edges = camera_edges(c);
        ASSERT_EQ(edges.size(), 12u);
        for (const auto& [from, to, far] : edges)
            for (const glm::dvec3& p : {from, to}) {
                const glm::dvec4 clip = c.clip_from_relative(p) * glm::dvec4(0, 0, 0, 1);
                EXPECT_NEAR(std::abs(clip.x / clip.w), 1, 1e-9);
                EXPECT_NEAR(std::abs(clip.y / clip.w), 1, 1e-9);
                const double z = clip.z / clip.w;
                EXPECT_TRUE(std::abs(z) < 1e-9 || std::abs(z - 1) < 1e-9) << z;
            }
    }
    perspective.curve.far = 1e6;
    for (const auto& [from, to, far] : camera_edges(perspective)) EXPECT_GE(std::min(from.z, to.z), -200 - 1e-9);
}

TEST(CameraOutline, IsTheFloorPlanOfTheCameraFromAbove) {
    const FittedLight light = from_above(12, false);
    const LightView& view = light.views[0];
    const auto lines = camera_outline_in_map(level_camera(), view);
    glm::dvec2 lo(2), hi(-1);
    for (const auto& [a, b] : lines)
        for (const glm::dvec2& p : {a, b}) {
            lo = glm::min(lo, p);
            hi = glm::max(hi, p);
        }
    // x from -2 to 2 and z from -5 to -1, ten metres to the map's width.
    glm::dvec2 a(2), b(-1);
    for (const glm::dvec3& p : {glm::dvec3(-2, 0, -1), glm::dvec3(2, 0, -5)}) {
        const glm::dvec4 clip = view.clip_from_relative(p) * glm::dvec4(0, 0, 0, 1);
        glm::dmat4 projected = view.projection;
        const glm::dvec3 v = glm::transpose(view.axes) * (p - view.eye);
        const glm::dvec4 by_hand = projected * glm::dvec4(v, 1);
        EXPECT_NEAR(glm::length(clip - by_hand), 0, 1e-9);
        a = glm::min(a, glm::dvec2(v) / 10.0 + 0.5);
        b = glm::max(b, glm::dvec2(v) / 10.0 + 0.5);
    }
    EXPECT_NEAR(glm::distance(lo, a), 0, 1e-9);
    EXPECT_NEAR(glm::distance(hi, b), 0, 1e-9);
}

// A region that leaves the map is closed along the map's border.
TEST(CameraOutline, IsClosed) {
    const LightView view = from_above(12, false).views[0];
    Camera wide = level_camera();
    wide.eye.x = 4;
    for (const Camera& camera : {level_camera(), wide}) {
        const auto lines = camera_region_in_map(camera, view);
        ASSERT_GE(lines.size(), 3u);
        double area = 0;
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const auto& [a, b] = lines[i];
            EXPECT_EQ(b, lines[(i + 1) % lines.size()].first) << i;
            EXPECT_TRUE(a.x >= 0 && a.x <= 1 && a.y >= 0 && a.y <= 1);
            area += 0.5 * (a.x * b.y - a.y * b.x);
        }
        // Four metres wide, one of them outside the map for a camera off the centre.
        EXPECT_NEAR(std::abs(area), (camera.eye.x == 4 ? 3 * 4 : 4 * 4) / 100.0, 0.02);
    }
    Camera away = level_camera();
    away.eye.x = 100;
    EXPECT_TRUE(camera_region_in_map(away, view).empty());
}

TEST(CameraOutline, LeavesOutPartsBehindAPunctualLight) {
    const FittedLight light = from_above(12, true);
    Camera above = level_camera();
    above.eye = {0, 30, 0};
    EXPECT_TRUE(camera_outline_in_map(above, light.views[0]).empty());
    Camera across = level_camera();  // from below the lamp to above it
    across.axes = orthonormal_basis({0, -1, 0});
    across.eye = {0, 2, 0};
    across.curve.far = 40;
    for (const auto& [a, b] : camera_outline_in_map(across, light.views[0]))
        for (const double v : {a.x, a.y, b.x, b.y}) {
            EXPECT_TRUE(std::isfinite(v));
            EXPECT_TRUE(v >= -1e-9 && v <= 1 + 1e-9);
        }
}

TEST(Clip, KeepsTheInnerPart) {
    const auto cut = clip_to_box({-1, 0.5}, {3, 0.5}, {0, 0}, {1, 1});
    ASSERT_TRUE(cut);
    EXPECT_NEAR(cut->first.x, 0, 1e-12);
    EXPECT_NEAR(cut->second.x, 1, 1e-12);
    EXPECT_FALSE(clip_to_box({-1, 2}, {3, 2}, {0, 0}, {1, 1}));
    EXPECT_FALSE(clip_to_box({-2, 0}, {0, 3}, {0, 0}, {1, 1})) << "past the corner";
    EXPECT_TRUE(clip_to_box({0.2, 0.2}, {0.2, 0.2}, {0, 0}, {1, 1}));
}

TEST(Selection, BoxOfANodeRotatesWithIt) {
    Scene scene = test::box_scene({{{-1, -2, -3}, {1, 2, 3}}, {{10, 0, 0}, {11, 1, 1}}});
    scene.nodes[0].world = glm::dmat4({0, 0, -1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {5, 0, 0, 1});  // x to -z, z to x
    scene.objects[0].world = scene.nodes[0].world;
    const Bounds b = bounds_of(scene, "box0");
    expect_near(b.lo, {2, -2, -1});
    expect_near(b.hi, {8, 2, 1});
    // A second placement by the same node is in the box too.
    Object twin = scene.objects[0];
    twin.instance[3] = {4, 0, 0, 1};
    scene.objects.push_back(twin);
    expect_near(bounds_of(scene, "box0").lo, {2, -2, -5});
    EXPECT_TRUE(bounds_of(scene, "no such node").empty());
    EXPECT_FALSE(box_of(scene, ""));
}

}  // namespace
}  // namespace si
