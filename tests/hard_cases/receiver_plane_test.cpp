// Tests bias.kind receiver-plane, which compares every texel with the plane of the triangle at its centre, on planes
// in all positions and at casters that touch them.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "renderer/bias/account.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/mesh_scene.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

void choose(Settings& s, std::string_view kind) {
    set_setting(s, "bias.kind", kind);
}

struct Plane {
    const char* name;
    glm::dvec3 at;
    double size, azimuth;
};

Settings over(const Plane& plane, LightType type, double theta_deg) {
    Settings s = hard_settings();
    s.camera.elevation = 70;
    set_target(s.camera, plane.at);
    s.camera.distance *= plane.size / 10;
    s.bias = no_bias();
    LightSettings& light = s.lights[0];
    light.type = type;
    light.azimuth = plane.azimuth;
    light.elevation = 90 - theta_deg;
    light.target_x = light.target_y = light.target_z = 0;
    if (type != LightType::Directional) light.distance = 2 * plane.size;
    light.cone = 50;
    return s;
}

/// Returns the plane's pixels inside the map, with their world positions.
std::vector<std::pair<std::size_t, glm::dvec3>> seen(const Shot& shot, const Plane& plane) {
    std::vector<std::pair<std::size_t, glm::dvec3>> out;
    for (const auto& [x, y, origin, dir] : pixel_rays(shot)) {
        const glm::dvec3 at = origin + dir * ((plane.at.y - origin.y) / dir.y);
        const glm::dvec3 off = glm::abs(at - plane.at);
        if (std::max(off.x, off.z) > 0.4999 * plane.size) continue;
        const glm::dvec4 uvd = uvdw(view_of(shot.light(), at), at);
        if (std::min(uvd.x, uvd.y) >= 0 && std::max(uvd.x, uvd.y) <= 1)
            out.emplace_back(std::size_t(y * shot.width + x), at);
    }
    return out;
}

struct PlaneCase {
    LightType type;
    MapFormat format;
    bool reversed;
};

class ReceiverPlaneBias : public testing::TestWithParam<PlaneCase> {};

TEST_P(ReceiverPlaneBias, LeavesNoAcneOnPlanes) {
    const PlaneCase& c = GetParam();
    std::size_t acne_without = 0, classified = 0;
    double most_texels = 0;
    // Each plane meets each angle, and each kernel meets each plane and each angle. SI_LONG=1: each kernel for every
    // pair of these.
    const bool all = std::getenv("SI_LONG") != nullptr;
    int turn = int(c.type) + int(c.format) + int(c.reversed);
    for (const Plane& plane : {Plane{"at home", {0, 0, 0}, 10, 30}, Plane{"light from +x", {0, 0, 0}, 10, 90},
                               Plane{"off origin", {-1000, 40, 2000}, 10, 205}, Plane{"large", {115, 0, 70}, 400, 333}})
        for (++turn; const double theta : {0.0, 20.0, 45.0, 70.0, 85.0}) {
            const std::string_view kernels[] = {"hard", "tent3", "pcf3", "pcf9", "poisson"},
                                   chosen = kernels[turn++ % 5];
            for (const std::string_view filter : kernels) {
                const bool against_one = filter == "pcf3" && theta >= 40;
                if (!all && !against_one && filter != chosen) continue;
                SCOPED_TRACE(testing::Message() << plane.name << ", " << theta << " degrees, " << filter);
                const Scene scene =
                    make_scene(make_plane(plane.size, plane.size), moved(plane.at.x, plane.at.y, plane.at.z));
                Settings s = over(plane, c.type, theta);
                s.map.format = c.format;
                s.map.reversed_z = c.reversed;
                set_setting(s, "filter.kernel", filter);
                choose(s, "receiver-plane");
                const Shot shot = draw_shot(scene, s);
                const auto pixels = seen(shot, plane);
                ASSERT_GT(pixels.size(), 1500u);
                std::size_t acne = 0;
                for (const auto& [i, at] : pixels) {
                    acne += shot.visibility.data[i] < 1 - 1e-3f;
                    const BiasBreakdown a = breakdown_at(shot.frame, s, hard_renderer().driver(), at);
                    ASSERT_EQ(a.least.kernel, 0) << "whatever the kernel reaches";
                    ASSERT_EQ(a.equivalent_depth(), a.least.total()) << "of itself just enough";
                    if (c.format == MapFormat::D32F && plane.at == glm::dvec3(0))
                        most_texels = std::max(most_texels, a.amount(a.equivalent_depth()).texels);
                }
                EXPECT_EQ(acne, 0u) << "of " << pixels.size();
                if (!against_one) continue;
                // One constant bias of that size for all texels is not enough.
                const BiasBreakdown middle = breakdown_at(shot.frame, s, hard_renderer().driver(), plane.at);
                choose(s, "constant");
                s.bias.constant = middle.equivalent_depth();
                const Shot one = draw_shot(scene, s);
                classified += pixels.size();
                for (const auto& [i, at] : pixels) acne_without += one.visibility.data[i] < 1 - 1e-3f;
            }
        }
    EXPECT_GT(double(acne_without), 0.7 * double(classified));
    if (c.format == MapFormat::D32F) {
        // Corners snap by half a step of the driver's grid, which slopes of 85 degrees along both axes turn into
        // depth.
        const double snapping = 17 * std::exp2(-(hard_renderer().driver().subpixel_bits + 1));
        EXPECT_LT(most_texels, 0.1 + snapping) << "35 texels is what pcf5 needs at 85 degrees";
    }
}

std::vector<PlaneCase> plane_cases() {
    std::vector<PlaneCase> out;
    for (const LightType type : kLightTypes)
        for (const MapFormat format : {MapFormat::D16, MapFormat::D32F})
            for (const bool reversed : {false, true}) out.push_back({type, format, reversed});
    return out;
}

std::string plane_case_name(const testing::TestParamInfo<PlaneCase>& named) {
    return light_name(named.param.type) + "_" + format_name(named.param.format) +
           (named.param.reversed ? "_reversed" : "");
}

INSTANTIATE_TEST_SUITE_P(All, ReceiverPlaneBias, testing::ValuesIn(plane_cases()), plane_case_name);

// A wall without thickness stands on a floor, turned against the map's axes so that its foot meets texels in every
// position. Between the wall and its shadow light leaks along b sin(theta).
TEST(ReceiverPlane, LightsAStripAtAWallOfTheClosedFormsWidth) {
    const Scene scene = grey_scene({{"floor", make_plane(20, 20)}, {"wall", make_box({6, 3, 1e-4}), moved(0, 1.5, 0)}});
    for (const LightType type : {LightType::Directional, LightType::Spot}) {
        double narrow = 0, narrow_expected = 0;
        for (const double texels : {2.0, 6.0}) {
            SCOPED_TRACE(testing::Message() << int(type) << ", " << texels << " texels");
            Settings s = texel_settings("hard", 512, texels);
            choose(s, "receiver-plane");
            s.lights[0].type = type;
            s.lights[0].azimuth = 23;
            s.lights[0].elevation = 35;  // from +z
            if (type == LightType::Spot) {
                set_all(s, {"light.distance=16", "light.cone=60"});
            }
            set_all(s, {"camera.azimuth=180", "camera.elevation=65", "camera.distance=9", "camera.target_x=0",
                        "camera.target_y=0", "camera.target_z=-0.5"});
            const Shot shot = draw_shot(scene, s, 480, 360);
            double lit = 0, expected = 0;
            int columns = 0;
            const double pixel_m = 9 * 2 * std::tan(glm::radians(0.5 * s.camera.fov)) / 360;
            // The lines run along the light's direction, across the floor behind the wall, away from the shadow's
            // ends.
            const FittedLight& light = shot.light();
            for (double x = -1; x <= 1; x += 0.01) {
                const glm::dvec3 foot(x, 0, 0);
                const glm::dvec3 to_light =
                    type == LightType::Directional ? light.to_light : glm::normalize(light.position - foot);
                const glm::dvec3 along = -glm::normalize(glm::dvec3(to_light.x, 0, to_light.z));
                const BiasBreakdown a = breakdown_at(shot.frame, s, hard_renderer().driver(), foot);
                const double step = 0.005;
                for (double d = 0.5 * step; d < 1.5; d += step) {
                    const glm::dvec4 p = shot.frame.camera.project(foot + along * d, shot.width, shot.height);
                    ASSERT_TRUE(p.x >= 0 && p.y >= 0 && p.x < shot.width && p.y < shot.height);
                    lit += step * shot.visibility.at(int(p.x), int(p.y));
                }
                expected += a.contact_gap_m();
                EXPECT_NEAR(a.amount(a.equivalent_depth()).metres * a.receiver.axis_per_ray / a.receiver.texel_m,
                            texels, 0.1);
                ++columns;
            }
            lit /= columns;
            expected /= columns;
            // Pixels at the foot show the wall, not the floor before it: less than one pixel is missing.
            EXPECT_LE(lit, 1.02 * expected);
            EXPECT_GE(lit, expected - pixel_m);
            if (texels == 2) {
                narrow = lit;
                narrow_expected = expected;
            } else  // under a spot light texels grow along the strip
                EXPECT_NEAR((lit - narrow) / (expected - narrow_expected), 1, 0.05);
        }
    }
}

// For casters well above the floor both kinds agree: no edge moves or widens.
SI_TEST_IS(Later, ReceiverPlane, DrawsEdgesOfDistantCastersLikeASingleDepth);
TEST(ReceiverPlane, DrawsEdgesOfDistantCastersLikeASingleDepth) {
    const Scene scene = floor_and_box(10, {1.5, 1, 2}, 0.6);
    for (const Filter& row : filters())
        for (const LightType type : kLightTypes) {
            // Penumbra kernels find their width from the compared depth.
            if (row.samples() != Samples::Depth || row.searches_blockers || row.reads_light_size) continue;
            SCOPED_TRACE(testing::Message() << row.key << ", light " << int(type));
            Settings s = texel_settings(row.key, 512, 0);
            s.lights[0].type = type;
            set_all(s, {"light.distance=9", "light.cone=80"});
            choose(s, "receiver-plane");
            const Shot plane = draw_shot(scene, s, 320, 240);
            choose(s, "constant");
            s.bias.constant = 4 * reach_of(s).bias;
            const Shot one = draw_shot(scene, s, 320, 240);
            const RayReference rays(scene);
            int floor = 0, partly = 0, dark = 0, differ = 0;
            for (const auto& [x, y, hit] : pixel_hits(rays, plane)) {
                if (hit.normal.y < 0.5 || hit.position.y > 1e-6) continue;
                const glm::dvec4 uvd = uvdw(view_of(plane.light(), hit.position), hit.position);
                if (std::min(uvd.x, uvd.y) < 0.02 || std::max(uvd.x, uvd.y) > 0.98) continue;
                const float a = plane.visibility.at(x, y), b = one.visibility.at(x, y);
                ++floor;
                dark += b == 0;
                partly += b > 0 && b < 1;
                differ += std::abs(a - b) > 1e-5f;
            }
            EXPECT_GT(floor, 5000);
            EXPECT_GT(dark, 200);
            EXPECT_TRUE((row.square() && row.size == 1) || partly > 100) << partly;
            EXPECT_EQ(differ, 0);
        }
}

TEST(ReceiverPlane, ClampBoundsTheDepthGradient) {
    const Plane plane{"", {0, 0, 0}, 10, 30};
    const Scene scene = make_scene(make_plane(10, 10));
    Settings s = over(plane, LightType::Directional, 80);
    set_setting(s, "filter.kernel", "pcf3");
    choose(s, "receiver-plane");
    const auto acne = [&] {
        const Shot shot = draw_shot(scene, s);
        std::size_t dark = 0;
        const auto pixels = seen(shot, plane);
        for (const auto& [i, at] : pixels) dark += shot.visibility.data[i] < 1 - 1e-3f;
        return double(dark) / double(pixels.size());
    };
    const auto account = [&] {
        const Shot shot = draw_shot(scene, s);
        return breakdown_at(shot.frame, s, hard_renderer().driver(), {0, 0, 0});
    };
    s.bias.plane_clamp = 0;  // no limit
    EXPECT_EQ(acne(), 0);
    choose(s, "constant");
    const BiasBreakdown whole = account();
    const double needed = whole.amount(whole.least.kernel).texels;
    EXPECT_GT(needed, 8);
    choose(s, "receiver-plane");
    s.bias.plane_clamp = 1.001 * needed;
    EXPECT_EQ(acne(), 0);
    EXPECT_EQ(account().least.kernel, 0);
    s.bias.plane_clamp = 0.5 * needed;
    EXPECT_GT(acne(), 0.5);
    const BiasBreakdown half = account();
    EXPECT_NEAR(half.amount(half.least.kernel).texels, 0.5 * needed, 1e-6 * needed) << "what is left to be cleared";
    s.bias.constant = half.least.kernel;
    EXPECT_EQ(acne(), 0) << "and with that much bias it is";
}

TEST(ReceiverPlane, ComparesInTheShaderWhereSamplersCannot) {
    const Scene scene = floor_and_box(10, {1.5, 1, 2}, 0.3);
    for (const char* filter : {"hard", "pcf3_nearest", "hw2x2", "pcf5"})
        for (const char* format : {"d16", "d32f"}) {
            SCOPED_TRACE(std::string(filter) + " " + format);
            Settings s = texel_settings(filter, 256, 0);
            set_setting(s, "map.format", format);
            choose(s, "receiver-plane");
            const Shot gather = draw_shot(scene, s);
            set_setting(s, "filter.method", "sampler");
            const Shot sampler = draw_shot(scene, s);
            EXPECT_EQ(differing_share(gather, sampler, 1e-5), 0);
            const bool told = std::ranges::any_of(sampler.frame.notes, [](const std::string& note) {
                return note.find("receiver-plane") != std::string::npos && note.find("gather") != std::string::npos;
            });
            EXPECT_EQ(told, is_bilinear(filter_of(s), s));
        }
}

}  // namespace
}  // namespace si::test
