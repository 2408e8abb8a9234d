// Tests of cascades: splits of the camera's depth, contents of each map, and blending.
#include "renderer/view/cascades/cascades.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "renderer/settings/filters.h"
#include "renderer/settings/fits.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/box_scene.h"
#include "tests/support/sets.h"

namespace si {
namespace {

using test::BoxExtent;

std::mt19937& numbers() {
    static std::mt19937 engine(7);
    return engine;
}
double random_between(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(numbers());
}
glm::dvec3 within(const Box& box) {
    return box[0] + (box[1] - box[0]) * random_between(0, 1) + (box[2] - box[0]) * random_between(0, 1) +
           (box[4] - box[0]) * random_between(0, 1);
}

TEST(Cascades, SplitsAreTheClosedForm) {
    EXPECT_EQ(split_depths(2, 10, 1, 0.7), std::vector<double>{10});
    const auto expect = [](const std::vector<double>& ends, const std::vector<double>& wanted) {
        ASSERT_EQ(ends.size(), wanted.size());
        for (std::size_t i = 0; i < ends.size(); ++i) EXPECT_NEAR(ends[i], wanted[i], 1e-9 * std::abs(wanted[i]));
    };
    expect(split_depths(1, 10000, 4, 1), {10, 100, 1000, 10000});
    expect(split_depths(1, 9, 4, 0), {3, 5, 7, 9});
    expect(split_depths(-5, 3, 4, 0), {-3, -1, 1, 3});
    expect(split_depths(1, 81, 4, 0.25), {0.25 * 3 + 0.75 * 21, 0.25 * 9 + 0.75 * 41, 0.25 * 27 + 0.75 * 61, 81});
}

Settings looking(const glm::dvec3& target, double azimuth, double elevation, double distance, bool orthographic) {
    Settings s;
    s.camera = orbiting_camera(target, azimuth, elevation, distance);
    s.camera.orthographic = orthographic;
    s.camera.height = 6;
    return s;
}

/// Returns whether the camera sees a point between two of its depths.
bool sees(const Camera& c, const glm::dvec3& p, double from_m, double to_m, double slack = 0) {
    const glm::dvec3 v = glm::transpose(c.axes) * (p - c.eye);
    const double half = c.orthographic ? 0.5 * c.height : std::tan(0.5 * c.fov_y_rad) * -v.z;
    return -v.z >= from_m - slack && -v.z <= to_m + slack && std::abs(v.y) <= half + slack &&
           std::abs(v.x) <= half * c.aspect + slack;
}

// The hull of the corners holds every visible point of the box, and no corner is outside.
TEST(Cascades, VisibleCornersEncloseTheFrustum) {
    int seen = 0, empty = 0;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 at = i % 2 ? glm::dvec3(0) : glm::dvec3(1e4, 30, -2e4);
        const glm::dvec3 half(random_between(0.1, 20), i % 3 ? random_between(0.1, 9) : 0,
                              random_between(0.1, 20));  // some are flat
        const BoxExtent extent{at - half, at + half};
        const Scene scene = test::box_scene({extent});
        Settings s = looking(at + glm::dvec3(random_between(-9, 9), random_between(-3, 9), random_between(-9, 9)),
                             random_between(0, 360), random_between(-80, 80), random_between(0.1, 25), i % 5 == 0);
        const Camera camera = make_camera(scene, s, 1.5);
        const double from = random_between(0.1, 9), to = from + random_between(0.1, 20);
        Box box;
        for (std::size_t k = 0; k < 8; ++k)
            box[k] = at + half * glm::dvec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
        const auto corners = CameraSlice(camera, from, to).visible_points(box);
        for (const glm::dvec3& p : corners) {
            EXPECT_TRUE(sees(camera, p, from, to, 1e-9 * 3e4)) << i;
            EXPECT_LE(glm::length(glm::max(glm::abs(p - at) - half, 0.0)), 1e-9 * 3e4) << i;
        }
        std::array<glm::dvec3, 20> ways;
        for (glm::dvec3& way : ways) way = {random_between(-1, 1), random_between(-1, 1), random_between(-1, 1)};
        for (int k = 0; k < 400; ++k) {
            const glm::dvec3 p = within(box);
            if (!sees(camera, p, from, to)) continue;
            ++seen;
            ASSERT_FALSE(corners.empty()) << i;
            for (const glm::dvec3& way : ways) {
                double most = -1e300;
                for (const glm::dvec3& c : corners) most = std::max(most, glm::dot(c - at, way));
                EXPECT_GE(most, glm::dot(p - at, way) - 1e-8) << i;
            }
        }
        empty += corners.empty();
    }
    EXPECT_GT(seen, 5000);
    EXPECT_GT(empty, 20);
}

struct Case {
    glm::dvec3 at;
    double azimuth, elevation;  // direction of the light
    double camera_azimuth, camera_elevation, camera_distance;
    bool orthographic;
    CascadeChoice choice;
};

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const glm::dvec3& at : {glm::dvec3(0), glm::dvec3(1e4, -300, 7e4)})
        for (const auto& [azimuth, elevation] : {std::pair{0., 90.}, {90., 0.}, {180., 45.}, {-40., 30.}, {0., -90.}})
            for (const CascadeChoice choice : {CascadeChoice::Interval, CascadeChoice::Map})
                for (const bool orthographic : {false, true})
                    all.push_back({at, azimuth, elevation, random_between(0, 360), random_between(-20, 60),
                                   random_between(1, 40), orthographic, choice});
    return all;
}

/// Makes boxes on a long ground.
Scene long_scene(const glm::dvec3& at) {
    std::vector<BoxExtent> boxes{{at + glm::dvec3(-40, -1, -40), at + glm::dvec3(40, 0, 40)}};
    for (int x = -3; x < 4; ++x)
        for (int z = -3; z < 4; ++z) {
            const glm::dvec3 foot = at + glm::dvec3(11 * x, 0, 11 * z);
            boxes.push_back({foot - glm::dvec3(1, 0, 1), foot + glm::dvec3(1, 2 + (x * x + z) % 5, 1)});
        }
    return test::box_scene(boxes);
}

struct Cascaded {
    Scene scene;
    Settings settings;
    Camera camera;
    FittedLight light;
    SceneShape shape;
    explicit Cascaded(const Case& c, int count = 4) : scene(long_scene(c.at)) {
        settings = looking(c.at, c.camera_azimuth, c.camera_elevation, c.camera_distance, c.orthographic);
        LightSettings& l = settings.lights[0];
        l.azimuth = c.azimuth;
        l.elevation = c.elevation;
        l.cascades = count;
        l.cascade_choice = c.choice;
        settings.map.resolution = 512;
        camera = make_camera(scene, settings, 1.5);
        light = fit_lights(scene, settings, &camera)[0];
        shape = scene_shape(scene, settings);
    }
    glm::dvec3 uvd(std::size_t view, const glm::dvec3& p) const {
        const glm::dvec4 h = light.views[view].clip_from_relative(p) * glm::dvec4(0, 0, 0, 1);
        return {0.5 * h.x + 0.5, 0.5 * h.y + 0.5, h.z};
    }
    /// Returns the reach of a look-up around its point: kernel, normal offset and half a texel.
    double reach() const { return (reach_of(settings).read + settings.bias.normal + 0.5) / 512; }
};

// Every read of a look-up within a cascade's interval is inside its map, the band's second map included.
TEST(Cascades, HoldAllLookUps) {
    std::size_t points = 0, blended = 0;
    for (const Case& c : cases()) {
        const Cascaded scene(c);
        ASSERT_EQ(scene.light.views.size(), 4u);
        ASSERT_TRUE(scene.light.is_cascaded());
        for (int i = 0; i < 20000; ++i) {
            const Box& box = scene.shape.boxes[std::size_t(i) % scene.shape.boxes.size()];
            const glm::dvec3 p = within(box);
            if (!sees(scene.camera, p, scene.camera.curve.near, scene.camera.curve.far)) continue;
            ++points;
            const ChosenView chosen = scene.light.chooser.choose(scene.light.views, p);
            for (const std::size_t view : {chosen.view, chosen.other}) {
                const glm::dvec3 at = scene.uvd(view, p);
                ASSERT_GE(std::min({at.x, at.y, 1 - at.x, 1 - at.y}), scene.reach())
                    << "view " << view << " light " << c.azimuth << "," << c.elevation << " choice " << int(c.choice);
                ASSERT_GE(at.z, 0);
                ASSERT_LE(at.z, 1);
            }
            blended += chosen.share > 0;
            EXPECT_GE(chosen.other, chosen.view);
            if (c.choice != CascadeChoice::Interval) continue;
            const double depth = glm::dot(p - scene.camera.eye, -scene.camera.axes[2]);
            const auto& spans = scene.light.chooser.spans;
            EXPECT_TRUE(chosen.view == 0 || depth >= spans[chosen.view - 1].ends);
            EXPECT_TRUE(chosen.view == 3 || depth < spans[chosen.view].ends);
        }
    }
    EXPECT_GT(points, 50000u);
    EXPECT_GT(blended, 1000u);
}

// A caster outside the view, but between the view and the light, is behind the near plane of each map that it covers.
TEST(Cascades, ReachToTheFirstCaster) {
    std::size_t held = 0;
    for (const Case& c : cases()) {
        const Cascaded scene(c);
        EXPECT_EQ(scene.light.clipped_casters, 0);
        for (int i = 0; i < 5000; ++i) {
            const glm::dvec3 p = within(scene.shape.boxes[std::size_t(i) % scene.shape.boxes.size()]);
            for (std::size_t view = 0; view < 4; ++view) {
                const glm::dvec3 at = scene.uvd(view, p);
                if (std::min({at.x, at.y, 1 - at.x, 1 - at.y}) < 0) continue;
                ++held;
                ASSERT_GE(at.z, 0);
            }
        }
    }
    EXPECT_GT(held, 10000u);
}

TEST(Cascades, NearCascadesAreFinerThanTheSceneMap) {
    Case c{{0, 0, 0}, -40, 45, 30, 8, 30, false, CascadeChoice::Interval};
    const Cascaded several(c), one(c, 1);
    ASSERT_EQ(one.light.views.size(), 1u);
    EXPECT_EQ(one.light.chooser.choice, ViewChoice::One);
    EXPECT_LT(several.light.views[0].half_extent(), 0.4 * one.light.views[0].half_extent());
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_LE(several.light.views[i].half_extent(), 1.1 * one.light.views[0].half_extent());
        const DepthCurve &part = several.light.views[i].curve, &whole = one.light.views[0].curve;
        EXPECT_LE(part.far - part.near, 1.001 * (whole.far - whole.near));
    }
}

// Along a line away from the camera the share grows from 0 to 1 within the band, and the next view continues there.
TEST(Cascades, BlendIntoEachOther) {
    for (const CascadeChoice choice : {CascadeChoice::Interval, CascadeChoice::Map}) {
        const Cascaded scene({{0, 0, 0}, -40, 45, 30, 8, 30, false, choice});
        // Returns the blend weight of view k at a point.
        const auto weights = [&](const glm::dvec3& p) {
            std::array<double, 4> w{};
            const ChosenView chosen = scene.light.chooser.choose(scene.light.views, p);
            w[chosen.view] += 1 - chosen.share;
            w[chosen.other] += chosen.share;
            return w;
        };
        const double length = scene.light.chooser.choice == ViewChoice::Interval
                                  ? scene.light.chooser.spans[3].ends
                                  : glm::distance(scene.camera.eye, glm::dvec3(0)) + 30;
        constexpr int kSteps = 20000;
        std::set<std::size_t> met;
        auto before = weights(scene.camera.eye);
        for (int i = 1; i < kSteps; ++i) {
            // A line through the ground, where maps hold it.
            const auto now = weights(scene.camera.eye - scene.camera.axes[2] * (length * i / kSteps));
            for (std::size_t k = 0; k < 4; ++k) {
                if (choice == CascadeChoice::Interval) {
                    EXPECT_LT(std::abs(now[k] - before[k]), 0.02) << i;
                }
                if (now[k] > 0.99) met.insert(k);
            }
            before = now;
        }
        EXPECT_GE(met.size(), 3u);
    }
}

TEST(Cascades, ReadTheCameraOnlyUnderCascadedFits) {
    Case c{{0, 0, 0}, -40, 45, 30, 8, 30, false, CascadeChoice::Interval};
    Settings s = Cascaded(c).settings;
    EXPECT_TRUE(fit_reads_camera(s, 0));
    s.lights[0].fit = LightFit::Manual;
    EXPECT_FALSE(fit_reads_camera(s, 0));
    s.lights[0].fit = LightFit::Scene;
    s.lights[0].projection = LightProjection::Perspective;
    EXPECT_FALSE(fit_reads_camera(s, 0));
    s.lights[0].projection = LightProjection::Automatic;
    s.lights[0].type = LightType::Spot;
    EXPECT_FALSE(fit_reads_camera(s, 0));
    set_all(s, {"light.type=directional", "light.cascades=1"});
    EXPECT_FALSE(fit_reads_camera(s, 0));
    // A camera that looks away from the scene still gets maps.
    Cascaded away({{0, 0, 0}, -40, 45, 30, 8, 30, false, CascadeChoice::Interval});
    away.settings.camera.target_y = 1e4;
    away.settings.camera.elevation = -80;
    const Camera camera = make_camera(away.scene, away.settings, 1.5);
    const std::vector<FittedLight> lights = fit_lights(away.scene, away.settings, &camera);
    for (const LightView& view : lights[0].views) {
        EXPECT_TRUE(std::isfinite(view.half_extent()) && view.half_extent() > 0);
        EXPECT_GT(view.curve.far, view.curve.near);
    }
}

}  // namespace
}  // namespace si
