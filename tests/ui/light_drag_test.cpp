// Tests of light handles: a known drag on the screen is compared with the change in the world.
#include "ui/scene_view/light_drag.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/base/angles.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/light_fit.h"
#include "renderer/view/fits/manual_light.h"
#include "tests/support/box_scene.h"
#include "ui/state/panels.h"

namespace si {
namespace {

constexpr double kMetresPerPixel = 0.05;

/// Returns a view along -z with parallel rays: x to the right, y up, 5 cm a pixel, the origin in the centre.
PictureView front_view() {
    PictureView v;
    v.camera.orthographic = true;
    v.camera.eye = {0, 0, 60};
    v.camera.height = 800 * kMetresPerPixel;
    v.camera.aspect = 1.5;
    v.camera.curve = {false, 1, 200, {true, true}};
    v.origin = {30, 70};
    v.size = {1200, 800};
    return v;
}

PictureView perspective_view(const Scene& scene) {
    Settings s;
    s.camera.source = CameraSource::Manual;
    s.camera.distance = 30;
    s.camera.azimuth = 20;
    s.camera.elevation = 35;
    PictureView v;
    v.camera = make_camera(scene, s, 1.5);
    v.origin = {11, 5};
    v.size = {900, 600};
    return v;
}

Scene small_scene() {
    return test::box_scene({{{-3, -1, -2}, {3, 1, 2}}});
}

struct Case {
    Scene scene = small_scene();
    Settings settings;
    LightSettings& light = settings.lights[0];

    explicit Case(LightType type, double azimuth = 90, double elevation = 0) {
        light.type = type;
        light.azimuth = azimuth;
        light.elevation = elevation;
    }
    FittedLight fitted() const { return fit_lights(scene, settings)[0]; }
    LightPose pose() const { return light_pose(light, fitted(), 0); }
    /// Drags a handle by screen pixels (y down) and applies the result to the light.
    void drag(LightHandle h, const PictureView& v, glm::dvec2 by, double step = 0) {
        const LightPose start = grab_light(pose(), h, fitted());
        const auto at = v.point(handle_position(start, h, v));
        ASSERT_TRUE(at);
        const auto moved = drag_light(start, h, v, *at + by, step);
        ASSERT_TRUE(moved);
        light = *moved;
    }
};

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-9) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

TEST(LightDrag, PositionMovesWithTheMouse) {
    for (const LightType type : {LightType::Spot, LightType::Point}) {
        Case c(type, 60, 30);
        const FittedLight before = c.fitted();
        c.drag(LightHandle::Position, front_view(), {40, -20});
        const FittedLight after = c.fitted();
        expect_near(after.position, before.position + glm::dvec3(40, 20, 0) * kMetresPerPixel);
        expect_near(after.target, before.target);
        EXPECT_EQ(c.light.fit, LightSettings().fit) << "the map follows";
    }
}

TEST(LightDrag, ArrowMovesOnlyAlongItsAxis) {
    Case c(LightType::Point, 60, 30);
    for (const auto& [handle, way] :
         {std::pair{LightHandle::AxisX, glm::dvec3(1, 0, 0)}, {LightHandle::AxisY, {0, 1, 0}}}) {
        const glm::dvec3 before = c.fitted().position;
        c.drag(handle, front_view(), {40, -40});
        expect_near(c.fitted().position, before + way * 40.0 * kMetresPerPixel);
    }
}

TEST(LightDrag, DirectionalLightMovesItsTarget) {
    for (const LightHandle h : {LightHandle::Position, LightHandle::AxisY, LightHandle::Target}) {
        Case c(LightType::Directional, 35, 50);
        const FittedLight before = c.fitted();
        if (h == LightHandle::Target) c.light = manual_light(c.light, before);  // under the fit it has no target
        c.drag(h, front_view(), {0, -30});
        const FittedLight after = c.fitted();
        expect_near(after.views[0].eye, before.views[0].eye + glm::dvec3(0, 30 * kMetresPerPixel, 0));
        expect_near(after.to_light, before.to_light);
        EXPECT_NEAR(after.views[0].half_extent(), before.views[0].half_extent(), 1e-9);
        EXPECT_NEAR(after.views[0].curve.far, before.views[0].curve.far, 1e-9);
    }
}

TEST(LightDrag, TargetOfASpotLightMovesAlone) {
    Case c(LightType::Spot, 60, 30);
    const FittedLight before = c.fitted();
    c.drag(LightHandle::Target, front_view(), {25, 10});
    const FittedLight after = c.fitted();
    expect_near(after.position, before.position);
    expect_near(after.target, before.target + glm::dvec3(25, -10, 0) * kMetresPerPixel);
    expect_near(after.to_light, glm::normalize(before.position - after.target));
    EXPECT_EQ(c.light.fit, LightSettings().fit) << "near and far still follow the scene";
}

TEST(LightDrag, PlanesMoveAlongTheAxis) {
    for (const LightType type : {LightType::Directional, LightType::Spot, LightType::Point}) {
        Case c(type);  // from +x; near and far are to the left of the light. The first face of a point light faces +x.
        const double sign = type == LightType::Point ? 1 : -1;
        const LightView before = c.fitted().views[0];
        c.drag(LightHandle::Near, front_view(), {sign * 8, 31});
        LightView after = c.fitted().views[0];
        EXPECT_NEAR(after.curve.near, before.curve.near + 8 * kMetresPerPixel, 1e-9);
        EXPECT_NEAR(after.curve.far, before.curve.far, 1e-9);
        c.drag(LightHandle::Far, front_view(), {sign * 12, -7});
        after = c.fitted().views[0];
        EXPECT_NEAR(after.curve.near, before.curve.near + 8 * kMetresPerPixel, 1e-9);
        EXPECT_NEAR(after.curve.far, before.curve.far + 12 * kMetresPerPixel, 1e-9);
        EXPECT_NEAR(after.half_extent(), before.half_extent(), 1e-9);
        EXPECT_EQ(c.light.fit, LightFit::Manual);
    }
}

TEST(LightDrag, PlanesStayInOrderAndInFrontOfTheLight) {
    for (const LightType type : {LightType::Spot, LightType::Directional}) {
        Case c(type);
        c.drag(LightHandle::Near, front_view(), {-1e4, 0});
        EXPECT_LT(c.light.near, c.light.far);
        c.drag(LightHandle::Far, front_view(), {1e4, 0});
        EXPECT_LT(c.light.near, c.light.far);
        const FittedLight fitted = c.fitted();
        EXPECT_TRUE(fitted.notes.empty());
        EXPECT_NEAR(fitted.views[0].curve.near, c.light.near, 1e-9);
    }
    Case spot(LightType::Spot);
    spot.drag(LightHandle::Near, front_view(), {1e4, 0});
    EXPECT_GT(spot.light.near, 0);
}

TEST(LightDrag, DirectionalLightMovesBackForItsNearPlane) {
    Case c(LightType::Directional);
    const LightView before = c.fitted().views[0];
    const double wanted = before.curve.near + 7;  // metres towards the light, and past it
    c.drag(LightHandle::Near, front_view(), {wanted / kMetresPerPixel, 0});
    const LightView after = c.fitted().views[0];
    EXPECT_GT(c.light.near, 0);
    const auto plane = [](const LightView& v, double z) { return v.eye.x - z; };
    EXPECT_NEAR(plane(after, after.curve.near), plane(before, before.curve.near) + wanted, 1e-9);
    EXPECT_NEAR(plane(after, after.curve.far), plane(before, before.curve.far), 1e-9);
}

TEST(LightDrag, ExtentIsTheDistanceFromTheAxis) {
    Case c(LightType::Directional);
    const LightPose pose = c.pose();
    int tried = 0;
    for (const LightHandle h :
         {LightHandle::ExtentRight, LightHandle::ExtentTop, LightHandle::ExtentLeft, LightHandle::ExtentBottom}) {
        const glm::dvec3 way = handle_axis(pose, h);
        if (std::abs(way.z) > 0.5) continue;  // along the line of sight
        const double before = c.fitted().views[0].half_extent();
        c.drag(h, front_view(), {20 * way.x + 3 * way.y, -20 * way.y + 3 * way.x});
        EXPECT_NEAR(c.fitted().views[0].half_extent(), before + 20 * kMetresPerPixel, 1e-9);
        EXPECT_EQ(c.light.fit, LightFit::Manual);
        c.drag(h, front_view(), {-1e4 * way.x, 1e4 * way.y});
        EXPECT_GT(c.light.extent, 0) << "dragged across the axis";
        c.light.extent = before;
        ++tried;
    }
    EXPECT_EQ(tried, 2);
}

TEST(LightDrag, ConeOpensToTheMouse) {
    Case c(LightType::Spot);  // from +x: its axis is -x, and the rim's handles up and down are in the picture plane
    for (const double cone : {50.0, 220.0})
        for (const LightHandle h :
             {LightHandle::ConeRight, LightHandle::ConeTop, LightHandle::ConeLeft, LightHandle::ConeBottom}) {
            c.light.cone = cone;
            c.light.distance = 9;
            const LightPose pose = c.pose();
            const glm::dvec3 way = handle_axis(pose, h);
            if (std::abs(way.z) > 0.5) continue;
            const double half = 0.5 * cone * kDegree, r = cone_rim_distance(pose);
            const glm::dvec2 at(r * std::cos(half) + 14 * kMetresPerPixel, r * std::sin(half) + 9 * kMetresPerPixel);
            c.drag(h, front_view(), {-14, -9 * way.y});
            EXPECT_NEAR(c.light.cone, 2 * std::atan2(at.y, at.x) / kDegree, 1e-4);
            EXPECT_EQ(c.light.fit, LightSettings().fit);
            EXPECT_EQ(c.light.distance, 9);
        }
    c.light.cone = 50;
    c.light.distance = 0;
    const glm::dvec3 before = c.fitted().position;
    c.drag(LightHandle::ConeTop, front_view(), {5, 3});
    expect_near(c.fitted().position, before);
}

TEST(LightDrag, RangeFollowsTheMouseAndChangesNothingElse) {
    const PictureView v = front_view();
    for (const LightType type : {LightType::Spot, LightType::Point}) {
        Case c(type);
        EXPECT_EQ(std::ranges::count(handles_of(c.pose()), LightHandle::Range), 0) << "unlimited";
        c.light.range = 8;
        c.light.cone = 50;
        const glm::dvec3 way = range_axis(c.pose());
        EXPECT_NEAR(glm::length(way), 1, 1e-12);
        const double along = type == LightType::Spot ? std::cos(25 * kDegree) : 0;  // on the rim, or across
        EXPECT_NEAR(glm::dot(way, -c.pose().to_light), along, 1e-12);
        const LightSettings before = c.light;
        // On the screen the handle moves by the component across the line of sight.
        c.drag(LightHandle::Range, v, glm::dvec2(way.x, -way.y) * (2 / kMetresPerPixel));
        EXPECT_NEAR(c.light.range, 10, 1e-6);
        c.drag(LightHandle::Range, v, glm::dvec2(way.x, -way.y) * (1.3 / kMetresPerPixel), 0.5);
        EXPECT_DOUBLE_EQ(c.light.range, 11.5);
        c.drag(LightHandle::Range, v, glm::dvec2(way.x, -way.y) * (-40 / kMetresPerPixel));
        EXPECT_GT(c.light.range, 0) << "0 would be unlimited";
        c.light.range = before.range;
        EXPECT_EQ(c.light, before) << "neither fit nor place is taken over by hand";
    }
    Case sun(LightType::Directional);
    sun.light.range = 8;
    EXPECT_EQ(std::ranges::count(handles_of(sun.pose()), LightHandle::Range), 0);
}

TEST(LightDrag, ConeOpensInAViewAlongTheAxis) {
    Case c(LightType::Spot, 0, 0);  // from +z, as the camera
    c.light.cone = 50;
    c.light.distance = 9;
    const LightPose pose = c.pose();
    const glm::dvec3 way = handle_axis(pose, LightHandle::ConeRight);
    const double r = cone_rim_distance(pose), half = 25 * kDegree;
    c.drag(LightHandle::ConeRight, front_view(), {10 * way.x, -10 * way.y});
    EXPECT_NEAR(c.light.cone, 2 * std::asin(std::sin(half) + 10 * kMetresPerPixel / r) / kDegree, 1e-4);
}

TEST(LightDrag, ConeFollowsTheMouseWhereItsRimIsSeenEdgeOn) {
    // The axis leaves the picture plane by a few degrees, and a handle points at the camera.
    for (const double azimuth : {80.0, 86.0, 94.0, 97.0})
        for (const LightHandle h :
             {LightHandle::ConeRight, LightHandle::ConeTop, LightHandle::ConeLeft, LightHandle::ConeBottom})
            for (const glm::dvec2 by : {glm::dvec2(40, 0), {-40, 0}, {0, 30}, {0, -30}}) {
                Case c(LightType::Spot, azimuth, 4);
                c.light.cone = 70;
                c.light.distance = 9;
                const PictureView v = front_view();
                const glm::dvec2 to = *v.point(handle_position(c.pose(), h, v)) + by;
                const auto off = [&] { return glm::distance(*v.point(handle_position(c.pose(), h, v)), to); };
                double least = 1e9;
                const double present = c.light.cone;
                for (double cone = 0.2; cone <= 360; cone += 0.5) {
                    c.light.cone = cone;
                    least = std::min(least, off());
                }
                c.light.cone = present;
                c.drag(h, v, by);
                EXPECT_LT(off(), least + 1.5) << azimuth << ", " << int(h) << ": as near as any cone brings it";
            }
}

TEST(LightDrag, RimSeenEdgeOnHasHandlesAtItsEndsWhichFollowTheMouse) {
    constexpr double kPull = 112;  // pixels
    const PictureView v = front_view();
    for (const double azimuth : {86.0, 90.0, 94.0}) {
        Case c(LightType::Spot, azimuth, 2);
        c.light.cone = 60;
        c.light.distance = 9;
        const LightSettings before = c.light;
        const glm::dvec2 apex = *v.point(c.pose().position);
        int cones = 0;
        for (const PlacedHandle& placed : place_handles(c.pose(), v)) {
            if (!is_cone(placed.handle)) continue;
            ++cones;
            const glm::dvec2 outwards(0, placed.on_screen.y < apex.y ? -1 : 1);
            c.drag(placed.handle, v, kPull * outwards);
            EXPECT_GT(c.light.cone, before.cone + 20) << azimuth << ", " << int(placed.handle);
            c.light = before;
        }
        EXPECT_EQ(cones, 2) << "those before and behind the axis would stay behind the mouse, at " << azimuth;
    }
    Case along(LightType::Spot, 0, 0);  // a rim seen as a circle keeps all four
    along.light.distance = 9;
    int cones = 0;
    for (const PlacedHandle& placed : place_handles(along.pose(), v)) cones += is_cone(placed.handle);
    EXPECT_EQ(cones, 4);
}

TEST(LightDrag, DirectionFollowsTheMouseOnItsSphere) {
    for (const LightType type : {LightType::Directional, LightType::Spot}) {
        Case c(type, 40, 25);
        if (type == LightType::Spot) c.light.distance = 12;
        const FittedLight before = c.fitted();
        const double radius = direction_ball_radius(c.pose(), front_view());
        const double sign = type == LightType::Spot ? -1 : 1;  // a spot light's arrow points where it shines
        const glm::dvec3 tip = sign * radius * before.to_light;
        glm::dvec3 wanted = tip + glm::dvec3(-30, 12, 0) * kMetresPerPixel;
        wanted.z = std::copysign(std::sqrt(radius * radius - wanted.x * wanted.x - wanted.y * wanted.y), tip.z);
        c.drag(LightHandle::Direction, front_view(), {-30, -12});
        const FittedLight after = c.fitted();
        expect_near(after.to_light, sign * wanted / radius, 1e-9);
        EXPECT_EQ(c.light.fit, LightSettings().fit);
        if (type != LightType::Spot) continue;
        expect_near(after.position, before.position);
        EXPECT_NEAR(glm::distance(after.target, after.position), 12, 1e-9);
    }
}

TEST(LightDrag, MouseOutsideTheOutlineReachesTheFarSideOfTheSphere) {
    Case c(LightType::Directional, 40, 0);
    const double radius = direction_ball_radius(c.pose(), front_view()) / kMetresPerPixel,
                 x = radius * std::sin(40 * kDegree);
    c.drag(LightHandle::Direction, front_view(), {radius - x + 0.25 * radius, 0});  // a quarter of the radius too far
    const glm::dvec3 to_light = c.fitted().to_light;
    EXPECT_NEAR(to_light.x, 0.75, 1e-9);
    EXPECT_LT(to_light.z, 0);
}

TEST(LightDrag, HandlesStayUnderTheMouseInPerspective) {
    using enum LightHandle;
    int tried = 0;
    for (const LightType type : {LightType::Directional, LightType::Spot, LightType::Point})
        for (const bool by_hand : {false, true})
            for (const glm::dvec2 by : {glm::dvec2(17, -9), glm::dvec2(-6, 13)}) {
                Case first(type, -30, 40);
                first.light.distance = 12;
                if (by_hand) first.light = manual_light(first.light, first.fitted());
                const PictureView v = perspective_view(first.scene);
                for (const PlacedHandle& placed : place_handles(first.pose(), v)) {
                    Case c(type, -30, 40);
                    c.light = first.light;
                    const LightHandle h = placed.handle;
                    const LightPose start = grab_light(c.pose(), h, c.fitted());
                    // Handles of a line are dragged along the line; a cone's rim and other handles in any direction.
                    glm::dvec2 to = placed.on_screen + by;
                    if (is_axis(h) || is_extent(h) || h == Near || h == Far) {
                        const glm::dvec3 way = h == Near || h == Far ? start.view.axes[2] : handle_axis(start, h);
                        to = *v.point(handle_position(start, h, v) + 0.3 * way);
                    }
                    const auto moved = drag_light(start, h, v, to);
                    ASSERT_TRUE(moved);
                    c.light = *moved;
                    if (is_cone(h)) {
                        EXPECT_NE(c.light.cone, first.light.cone);
                        continue;
                    }
                    const auto now = v.point(handle_position(c.pose(), h, v));
                    ASSERT_TRUE(now);
                    // An arrow has a fixed length on the screen, so that the distance of its tip changes with the
                    // light.
                    const double tolerance = is_axis(h) ? 3 : 1e-6;
                    EXPECT_LT(glm::distance(*now, to), tolerance) << handle_name(h) << " of type " << int(type);
                    ++tried;
                }
            }
    EXPECT_GT(tried, 60);
}

TEST(LightDrag, StepsAreRound) {
    EXPECT_DOUBLE_EQ(snap_step(50), 1);
    EXPECT_DOUBLE_EQ(snap_step(7), 0.1);
    EXPECT_DOUBLE_EQ(snap_step(100), 2);
    EXPECT_DOUBLE_EQ(snap_step(0.02), 5e-4);
    const auto multiple = [](double v, double step) { return std::abs(v - std::round(v / step) * step) < 1e-9; };
    Case spot(LightType::Spot, 61.3, 33.3);
    spot.drag(LightHandle::Position, front_view(), {33, 17}, 0.5);
    const glm::dvec3 p = spot.fitted().position;
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(multiple(p[i], 0.5)) << p[i];
    Case axis(LightType::Point, 61.3, 33.3);
    const glm::dvec3 before = axis.fitted().position;
    axis.drag(LightHandle::AxisX, front_view(), {33, 17}, 0.5);
    EXPECT_TRUE(multiple(axis.fitted().position.x, 0.5));
    EXPECT_NEAR(axis.fitted().position.y, before.y, 1e-9) << "off its axis";
    Case turned(LightType::Directional, 61.3, 33.3);
    turned.drag(LightHandle::Direction, front_view(), {-40, 21}, 0.5);
    EXPECT_TRUE(multiple(turned.light.azimuth, 5)) << turned.light.azimuth;
    EXPECT_TRUE(multiple(turned.light.elevation, 5)) << turned.light.elevation;
    Case cone(LightType::Spot);
    cone.light.cone = 52.7;
    cone.drag(LightHandle::ConeTop, front_view(), {-9, -16}, 0.5);
    EXPECT_TRUE(multiple(cone.light.cone, 5)) << cone.light.cone;
    Case planes(LightType::Directional);
    planes.drag(LightHandle::Near, front_view(), {-9, 0}, 0.5);
    EXPECT_TRUE(multiple(planes.light.near, 0.5)) << planes.light.near;
    planes.drag(LightHandle::Far, front_view(), {-9, 0}, 0.5);
    EXPECT_TRUE(multiple(planes.light.far, 0.5)) << planes.light.far;
}

TEST(LightDrag, TargetIsRelativeToTheSceneCentre) {
    for (const LightType type : {LightType::Spot, LightType::Directional}) {
        Case c(type, 40, 30);
        c.scene = test::box_scene({{{7, -1, -2}, {13, 5, 4}}});
        c.light.fit = LightFit::Manual;
        c.light.distance = 20;
        const glm::dvec3 before = c.fitted().target;
        c.drag(LightHandle::Target, front_view(), {12, -7});
        expect_near(c.fitted().target, before + kMetresPerPixel * glm::dvec3(12, 7, 0), 1e-9);
    }
}

TEST(LightDrag, ConeStaysShutOrWideOpenAcrossItsAxis) {
    for (const auto& [cone, wanted] : {std::pair{50.0, 0.2}, {300.0, 360.0}}) {
        Case c(LightType::Spot);
        c.light.cone = cone;
        c.light.distance = 9;
        const LightHandle h = std::abs(handle_axis(c.pose(), LightHandle::ConeTop).y) > 0.5 ? LightHandle::ConeTop
                                                                                            : LightHandle::ConeRight;
        const glm::dvec3 way = handle_axis(c.pose(), h);
        c.drag(h, front_view(), {0, way.y * 2.5 * cone_rim_distance(c.pose()) / kMetresPerPixel});
        EXPECT_EQ(c.light.cone, wanted);
    }
}

TEST(LightHandles, NumbersBelongToTheDraggedHandle) {
    Case c(LightType::Spot, 30, 20);
    c.light.cone = 41;
    c.light.distance = 9;
    const LightPose pose = c.pose();
    EXPECT_EQ(handle_numbers(pose, LightHandle::Near), metres_text(pose.view.curve.near));
    EXPECT_EQ(handle_numbers(pose, LightHandle::Far), metres_text(pose.view.curve.far));
    EXPECT_NE(handle_numbers(pose, LightHandle::Near), handle_numbers(pose, LightHandle::Far));
    EXPECT_EQ(handle_numbers(pose, LightHandle::ConeTop), "41.0°");
    EXPECT_EQ(handle_numbers(pose, LightHandle::Direction), "azimuth 30.0°   elevation 20.0°");
    EXPECT_EQ(handle_numbers(pose, LightHandle::AxisY), "y " + metres_text(pose.position.y));
    EXPECT_EQ(handle_numbers(pose, LightHandle::Position), "x " + metres_text(pose.position.x) + "   y " +
                                                               metres_text(pose.position.y) + "   z " +
                                                               metres_text(pose.position.z));
}

TEST(LightHandles, FittedLightHasATargetOnlyIfItHasAPosition) {
    const auto has_target = [](const Case& c) {
        const auto all = handles_of(c.pose());
        return std::find(all.begin(), all.end(), LightHandle::Target) != all.end();
    };
    Case sun(LightType::Directional), lamp(LightType::Spot);
    EXPECT_FALSE(has_target(sun)) << "the fit places its map";
    EXPECT_TRUE(has_target(lamp));
    sun.light.fit = LightFit::Manual;
    EXPECT_TRUE(has_target(sun));
}

TEST(LightHandles, HandlesAlongTheLineOfSightCannotBeDragged) {
    Case c(LightType::Directional, 0, 0);  // from +z, the camera's side
    for (const PlacedHandle& h : place_handles(c.pose(), front_view()))
        EXPECT_TRUE(h.handle != LightHandle::Near && h.handle != LightHandle::Far && h.handle != LightHandle::AxisZ)
            << handle_name(h.handle);
}

TEST(LightHandles, AreNeitherBehindTheCameraNorOutsideThePicture) {
    Case c(LightType::Spot, 20, 35);
    c.light.distance = 100;  // behind the camera, which looks from about there from 30 m
    const PictureView v = perspective_view(c.scene);
    bool target = false;
    for (const PlacedHandle& h : place_handles(c.pose(), v)) {
        EXPECT_TRUE(v.contains(h.on_screen)) << handle_name(h.handle);
        EXPECT_NE(h.handle, LightHandle::Position);
        target = target || h.handle == LightHandle::Target;
    }
    EXPECT_TRUE(target);
    Case wide(LightType::Directional, 0, 60);
    wide.light.fit = LightFit::Manual;
    wide.light.distance = 20;
    wide.light.extent = 100;  // the picture is 60 m wide
    const LightPose pose = wide.pose();
    ASSERT_FALSE(
        front_view().contains(*front_view().point(handle_position(pose, LightHandle::ExtentRight, front_view()))));
    for (const PlacedHandle& h : place_handles(pose, front_view()))
        EXPECT_TRUE(front_view().contains(h.on_screen)) << handle_name(h.handle);
}

TEST(LightHandles, LightWithoutAMapHasNoPlanes) {
    Case c(LightType::Directional);
    c.light.cast = false;
    for (const LightHandle h : handles_of(c.pose()))
        EXPECT_TRUE(h != LightHandle::Near && h != LightHandle::Far && !is_extent(h));
}

TEST(PictureView, RayThroughAScreenPointHitsTheShownSurface) {
    const Scene scene = small_scene();
    for (const PictureView& v : {front_view(), perspective_view(scene)}) {
        const glm::dvec3 p(1.5, -0.7, 0.9);
        const auto on = v.point(p);
        ASSERT_TRUE(on);
        const auto met = intersect_plane(v.ray(*on), p, v.camera.axes[2]);
        ASSERT_TRUE(met);
        expect_near(*met, p);
        const auto one_pixel_right = v.point(p + v.camera.axes[0] * v.metres_per_pixel(p));
        ASSERT_TRUE(one_pixel_right);
        EXPECT_NEAR(one_pixel_right->x - on->x, 1, 1e-9);
    }
}

}  // namespace
}  // namespace si
