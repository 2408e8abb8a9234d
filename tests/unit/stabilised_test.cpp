// Maps that keep still: no probe changes its texel as the camera turns, or moves by parts of a texel.
#include <gtest/gtest.h>

#include <random>

#include "renderer/settings/splits.h"
#include "renderer/view/cascades.h"
#include "tests/support/box_scene.h"
#include "tests/support/ray_truth.h"

namespace si {
namespace {

constexpr int kResolution = 512;

Scene wide_scene(const glm::dvec3& at) {
    std::vector<test::BoxExtent> boxes{{at + glm::dvec3(-40, -1, -40), at + glm::dvec3(40, 0, 40)}};
    for (int x = -3; x < 4; ++x)
        for (int z = -3; z < 4; ++z)
            boxes.push_back({at + glm::dvec3(11 * x - 1, 0, 11 * z - 1), at + glm::dvec3(11 * x + 1, 3, 11 * z + 1)});
    return test::box_scene(boxes);
}

/// The texel that a probe falls into: its view, the place of its middle across the light, metres, and how far the probe
/// is from its border, texels.
struct Texel {
    std::size_t view = 0;
    glm::dvec2 middle_m{0};
    double size_m = 0, to_border = 0;
};

Texel texel_of(const FittedLight& light, const glm::dvec3& probe, const glm::dvec3& counted_from) {
    const ChosenView chosen = light.chooser.choose(light.views, probe);
    const LightView& view = light.views[chosen.view];
    const glm::dvec2 at = glm::dvec2(test::uvdw(view, probe)) * double(kResolution), part = glm::fract(at);
    const glm::dvec3 middle = view.position_ws((glm::floor(at) + 0.5) / double(kResolution), 0) - counted_from;
    return {chosen.view,
            {glm::dot(middle, view.axes[0]), glm::dot(middle, view.axes[1])},
            view.texel_size(1, kResolution),
            std::min({part.x, part.y, 1 - part.x, 1 - part.y})};
}

struct Walk {
    std::size_t compared = 0, flips = 0;
    int widths = 0;  ///< changes of a map's width
};

/// 1000 steps, and a full turn in 500, of which each moves what is seen by less than a texel or turns it by less than a
/// degree.
Walk walk(const glm::dvec3& at, const char* fit, int cascades, double azimuth, double elevation) {
    const Scene scene = wide_scene(at);
    Settings s;
    set_setting(s, "light.fit", fit);
    s.map.resolution = kResolution;
    LightSettings& l = s.lights[0];
    l.cascades = cascades, l.azimuth = azimuth, l.elevation = elevation, l.split = int(Split::Logarithmic);
    CameraSettings& c = s.camera;
    c.source = int(CameraSource::Manual);
    c.target_x = at.x - 10, c.target_y = at.y + 1, c.target_z = at.z - 5, c.distance = 9, c.elevation = 12;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::vector<glm::dvec3> probes;
    for (int i = 0; i < 60; ++i) probes.push_back(at + glm::dvec3(38 * unit(random), 0, 38 * unit(random)));
    std::vector<Texel> before;
    std::vector<double> widths;
    Walk out;
    for (int step = 0; step < 1500; ++step) {
        const Camera camera = make_camera(scene, s, 16.0 / 9);
        const FittedLight light = fit_lights(scene, s, &camera)[0];
        std::vector<double> now_wide;
        for (const LightView& view : light.views) now_wide.push_back(view.half_width);
        out.widths += !widths.empty() && now_wide != widths;
        widths = now_wide;
        std::vector<Texel> now;
        for (const glm::dvec3& p : probes) now.push_back(texel_of(light, p, at));
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (now[i].view != before[i].view || std::min(now[i].to_border, before[i].to_border) < 1e-3) continue;
            ++out.compared;
            out.flips += glm::distance(now[i].middle_m, before[i].middle_m) > 1e-3 * now[i].size_m;
        }
        before = std::move(now);
        const double texel = light.views[0].texel_size(1, kResolution);
        if (step < 1000)
            c.target_x += 0.6 * unit(random) * texel + 0.2 * texel, c.target_z += 0.6 * unit(random) * texel;
        else
            c.azimuth += 0.72;
    }
    return out;
}

TEST(Stabilised, NoProbeChangesItsTexel) {
    for (const glm::dvec3& at : {glm::dvec3(0), glm::dvec3(115, 0, 3), glm::dvec3(-1e5, 40, 2e4)})
        for (const int cascades : {1, 4}) {
            const Walk steady = walk(at, "stabilised", cascades, cascades == 1 ? -40 : 90, cascades == 1 ? 45 : 60);
            EXPECT_EQ(steady.flips, 0u) << "of " << steady.compared << " at " << at.x << ", " << cascades;
            EXPECT_EQ(steady.widths, 0);
            EXPECT_GT(steady.compared, 80000u);
        }
    const Walk tight = walk({0, 0, 0}, "view", 4, 90, 60);
    EXPECT_GT(tight.flips, tight.compared / 2) << "what the others do";
}

// The sphere holds every corner of the slice, touches some, and is as large wherever the camera stands.
TEST(Stabilised, TheSphereIsTheSmallest) {
    Settings s;
    s.camera.source = int(CameraSource::Manual);
    const Scene scene = wide_scene({0, 0, 0});
    for (const double fov : {15., 60., 110.})
        for (const bool orthographic : {false, true})
            for (const auto& [near, far] : {std::pair{0.0, 9.0}, {1.0, 2.0}, {30.0, 31.0}}) {
                s.camera.fov = fov, s.camera.orthographic = orthographic;
                double radius = -1;
                for (const double azimuth : {0., 90., 33.}) {
                    s.camera.azimuth = azimuth, s.camera.target_x = azimuth * 1e3;
                    const Camera camera = make_camera(scene, s, 16.0 / 9);
                    const Sphere sphere = sphere_around(camera, {near, far});
                    EXPECT_TRUE(radius < 0 || std::abs(sphere.radius - radius) <= 1e-9 * radius);
                    radius = sphere.radius;
                    const double half = orthographic ? 0.5 * camera.height : std::tan(0.5 * camera.fov_y_rad);
                    double farthest = 0, least_far = 1e300, towards = 0;
                    for (int i = 0; i < 8; ++i) {
                        const double z = i & 4 ? far : near, scale = orthographic ? 1 : z;
                        const glm::dvec3 corner =
                            camera.eye + camera.axes * glm::dvec3((i & 1 ? 1 : -1) * scale * half * camera.aspect,
                                                                  (i & 2 ? 1 : -1) * scale * half, -z);
                        const double d = glm::distance(corner, sphere.centre);
                        farthest = std::max(farthest, d);
                        if (i & 4) least_far = std::min(least_far, d);
                        if (i & 4) towards = glm::dot(sphere.centre - camera.eye, -camera.axes[2]) - far;
                    }
                    EXPECT_NEAR(farthest, radius, 1e-9 * radius);
                    EXPECT_NEAR(least_far, radius, 1e-9 * radius) << "the far corners lie on it";
                    EXPECT_LE(towards, 1e-9 * far) << "its middle not beyond them";
                }
            }
}

// Whatever is seen lies in the depths, wherever the camera looks; and they stay as it turns.
TEST(Stabilised, DepthsHoldTheScene) {
    const glm::dvec3 centre(5, -2, 100);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 500; ++i) {
        Camera camera;
        camera.orthographic = i % 4 == 0;
        camera.eye =
            centre + 40.0 * std::exp2(3 * unit(random)) * glm::normalize(glm::dvec3(unit(random), unit(random), 0.3));
        camera.axes = orthonormal_basis(glm::normalize(glm::dvec3(unit(random), unit(random), unit(random))));
        const DepthSpan span = steady_depths(camera, centre, 20);
        for (int k = 0; k < 50; ++k) {
            const glm::dvec3 way = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
            const double depth = glm::dot(camera.eye - (centre + 20.0 * way), camera.axes[2]);
            if (depth < 0 && !camera.orthographic) continue;
            EXPECT_LE(depth, span.to_m + 1e-9);
            const glm::dvec3 v = glm::transpose(camera.axes) * (centre + 20.0 * way - camera.eye);
            const bool seen = std::max(std::abs(v.x), std::abs(v.y)) <= std::tan(0.5 * camera.fov_y_rad) * depth;
            EXPECT_TRUE(!(camera.orthographic || seen) || depth >= span.from_m - 1e-9);
        }
        const DepthSpan turned = [&] {
            Camera other = camera;
            other.axes = orthonormal_basis(glm::normalize(glm::dvec3(unit(random), unit(random), unit(random))));
            return steady_depths(other, centre, 20);
        }();
        EXPECT_TRUE(camera.orthographic || turned == span);
        EXPECT_GT(span.to_m, span.from_m);
    }
}

}  // namespace
}  // namespace si
