// Tests hard cases 1 to 3: the theory's least bias of planes, on the renderer's own maps.
#include <cmath>

#include "renderer/bias/account.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"
#include "tests/support/hard_case.h"
#include "tests/support/mesh_scene.h"
#include "tests/support/sets.h"
#include "tests/support/stability.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

constexpr MapFormat kFormats[] = {MapFormat::D16, MapFormat::D24, MapFormat::D32F, MapFormat::Colour};

/// Makes an unshadowed plane with a camera that sees most of it.
Scene plane_scene() {
    return make_scene(make_plane(10, 10));
}

Settings plane_settings(MapFormat format, std::string_view filter) {
    Settings s = settings_with(hard_settings(), {"camera.elevation=70", "camera.target_y=0"});
    s.map.format = format;
    set_setting(s, "filter.kernel", filter);
    s.bias = no_bias();
    return s;
}

/// Returns the bias that the theory needs at the worst point of the plane's map.
LeastBias predicted(const Shot& shot, const Settings& s) {
    const LightView& view = shot.view();
    LeastBias worst;
    for (double x : {-5.0, 0.0, 5.0})
        for (double z : {-5.0, 0.0, 5.0}) {
            const ReceiverPlane plane = receiver_plane(view, {x, 0, z}, {0, 1, 0});
            const LeastBias b = least_bias(plane.gradient, reach_of(s).bias, shot.frame.map_resolution,
                                           depth_quantum(s.map.format, view.curve, plane.uvd.z),
                                           hard_renderer().driver().subpixel_bits, rounding_bias(view, {x, 0, z}, 10));
            if (b.total() > worst.total()) worst = b;
        }
    return worst;
}

/// Returns the share of lit pixels that are not fully lit.
double acne_share(const Shot& shot) {
    std::size_t acne = 0, seen = 0;
    const RayReference rays(plane_scene());
    for (const auto& [x, y, hit] : pixel_hits(rays, shot)) {
        ++seen;
        acne += shot.visibility.at(x, y) < 1 - 1e-3f;
    }
    EXPECT_GT(seen, 5000u);
    return seen ? double(acne) / double(seen) : 0;
}

struct GrazingCase {
    MapFormat format;
    const char* filter;
};

class HardCase1 : public testing::TestWithParam<GrazingCase> {};

TEST_P(HardCase1, NoAcneUnderGrazingLight) {
    const Scene scene = plane_scene();
    Settings s = plane_settings(GetParam().format, GetParam().filter);
    for (double theta : {0.0, 20.0, 45.0, 60.0, 75.0, 85.0, 89.0, 89.5}) {
        SCOPED_TRACE(theta);
        s.lights[0].elevation = 90 - theta;
        s.bias.constant = 0;
        const Shot bare = draw_shot(scene, s);
        const LeastBias b = predicted(bare, s);
        s.bias.constant = b.total();
        expect_within_limit(1, acne_share(draw_shot(scene, s)));
        // Elsewhere quantisation decides (at 0 degrees it is all or nothing), so only tilted planes are compared.
        const double steps = b.kernel / (b.quantum + b.rounding);
        if (theta == 0 || steps < 20) continue;
        expect_fault(1, acne_share(bare));
        s.bias.constant = 0.9 * b.total();
        EXPECT_GT(acne_share(draw_shot(scene, s)), 0) << "a tenth less bias must show acne: the prediction is tight";
    }
}

INSTANTIATE_TEST_SUITE_P(All, HardCase1,
                         testing::Values(GrazingCase{MapFormat::D16, "hard"}, GrazingCase{MapFormat::D24, "hard"},
                                         GrazingCase{MapFormat::D32F, "hard"}, GrazingCase{MapFormat::Colour, "hard"},
                                         GrazingCase{MapFormat::Linear, "hard"},
                                         GrazingCase{MapFormat::Linear16, "hard"}, GrazingCase{MapFormat::D24, "hw2x2"},
                                         GrazingCase{MapFormat::D32F, "hw2x2"},
                                         GrazingCase{MapFormat::D32F, "pcf3_nearest"},
                                         GrazingCase{MapFormat::D32F, "pcf5"}),
                         [](const auto& named) { return format_name(named.param.format) + "_" + named.param.filter; });

class HardCase5Offset : public testing::TestWithParam<MapFormat> {};

// The test uses the measured effect of glPolygonOffset on this driver: the plane's need gives no acne, and less gives
// acne.
TEST_P(HardCase5Offset, ClearsAPlaneByTheEquivalentDepthBiasAndNotByATenthLess) {
    const Scene scene = plane_scene();
    const RasterTraits& driver = hard_renderer().driver();
    for (double theta : {45.0, 75.0})
        for (double BiasSettings::*offset : {&BiasSettings::raster_units, &BiasSettings::raster_slope}) {
            SCOPED_TRACE(testing::Message() << theta << (offset == &BiasSettings::raster_units ? " units" : " slope"));
            Settings s = plane_settings(GetParam(), "hard");
            s.lights[0].elevation = 90 - theta;  // along neither axis of the map
            const Shot bare = draw_shot(scene, s);
            s.bias.*offset = 1;
            double needed = 0;
            for (double x : {-5.0, 0.0, 5.0})
                for (double z : {-5.0, 0.0, 5.0}) {
                    const BiasBreakdown a = breakdown_at(bare.frame, s, driver, {x, 0, z});
                    EXPECT_GT(a.raster, 0);
                    EXPECT_EQ(a.equivalent_depth(), a.raster);
                    needed = std::max(needed, a.least.total() / a.raster);
                }
            expect_fault(5, acne_share(bare));
            s.bias.*offset = needed;
            expect_within_limit(5, acne_share(draw_shot(scene, s)));
            // The unit of a float format depends on the farthest depth of the whole triangle.
            if (driver.offset[std::size_t(GetParam())].unit_steps > 0 && offset == &BiasSettings::raster_units)
                continue;
            s.bias.*offset = 0.9 * needed;
            EXPECT_GT(acne_share(draw_shot(scene, s)), 0) << needed;
        }
}

INSTANTIATE_TEST_SUITE_P(All, HardCase5Offset, testing::ValuesIn(kFormats),
                         [](const auto& named) { return format_name(named.param); });

// The picture's shaders count from a grid point up to eight focus lengths away, the map's from the middle of the
// scene. At the bias that each point of the account needs, nothing may shadow itself, wherever the scene stands.
SI_TEST_IS(Later, HardCase1Places, NoAcneAtTheLeastBiasAnywhere);
TEST(HardCase1Places, NoAcneAtTheLeastBiasAnywhere) {
    struct Place {
        glm::dvec3 at;
        double size;
    };
    for (const Place& place : {Place{{0, 0, 0}, 10},
                               {{115, 0, 70}, 10},
                               {{-1000, 40, 1000}, 10},
                               {{1e4, -2e3, 1e4}, 10},
                               {{115, 0, 70}, 0.1},
                               {{115, 0, 70}, 1000}})
        for (const LightType type : {LightType::Directional, LightType::Spot})
            for (const double theta : {0.0, 45.0, 75.0, 88.0}) {
                SCOPED_TRACE(testing::Message()
                             << place.size << " m at " << place.at.x << ", light " << int(type) << " at " << theta);
                const Scene scene =
                    make_scene(make_plane(place.size, place.size), moved(place.at.x, place.at.y, place.at.z));
                Settings s = plane_settings(MapFormat::D32F, "hard");
                set_target(s.camera, place.at);
                s.camera.distance *= place.size / 10;
                s.lights[0].type = type;
                if (type == LightType::Spot) {
                    s.lights[0].distance = 2 * place.size;
                    s.lights[0].cone = 60;
                }
                s.lights[0].elevation = 90 - theta;
                s.bias.unit = BiasUnit::Texels;
                const auto visible = [&](Shot& shot) {
                    std::vector<std::pair<std::size_t, glm::dvec3>> seen;
                    for (const auto& [x, y, origin, dir] : pixel_rays(shot)) {
                        const glm::dvec3 at = origin + dir * ((place.at.y - origin.y) / dir.y);
                        const glm::dvec3 off = glm::abs(at - place.at);
                        const glm::dvec4 uvd = uvdw(shot.view(), at);
                        if (std::max(off.x, off.z) < 0.49 * place.size && std::min(uvd.x, uvd.y) > 0.02 &&
                            std::max(uvd.x, uvd.y) < 0.98)
                            seen.emplace_back(std::size_t(y * shot.width + x), at);
                    }
                    return seen;
                };
                Shot bare = draw_shot(scene, s);
                double most = 0;
                for (const auto& [pixel, at] : visible(bare)) {
                    const BiasBreakdown a = breakdown_at(bare.frame, s, hard_renderer().driver(), at);
                    most = std::max(most, a.amount(a.least.total()).texels);
                }
                s.bias.constant = most;
                Shot shot = draw_shot(scene, s);
                const auto seen = visible(shot);
                EXPECT_GT(seen.size(), 1500u);
                std::size_t dark = 0;
                for (const auto& [pixel, at] : seen) dark += shot.visibility.data[pixel] < 1;
                EXPECT_EQ(dark, 0u) << "at " << most << " texels";
            }
}

// The nearest kernel has acne on one half of a plane without bias: a texel's plane lies behind its centre's depth on
// one side and before it on the other.
TEST(HardCase1Share, HalfOfThePlaneHasAcneWithoutBias) {
    Settings s = settings_with(plane_settings(MapFormat::D32F, "hard"), {"light.elevation=40", "bias.constant=0"});
    EXPECT_NEAR(acne_share(draw_shot(plane_scene(), s, 320, 240)), 0.5, 0.02);
}

// Case 2: where N.L goes to 0 the bias has no bound; the faces there hardly receive light.
TEST(HardCase2, TheTerminatorOfASphereHasLittleError) {
    const Scene scene = make_scene(make_sphere(1, 128, 64));
    Settings s = hard_settings();
    // The camera looks across the terminator.
    set_all(s, {"camera.target_y=0", "camera.distance=3", "camera.azimuth=80", "camera.elevation=10"});
    const auto energy = [&](const Shot& shot) {
        // A convex body is lit wherever the facet faces the light.
        const RayReference rays(scene);
        double error = 0;
        int domain = 0;
        for (const auto& [x, y, hit] : pixel_hits(rays, shot)) {
            const double n_dot_l = glm::dot(hit.normal, shot.light().to_light);
            if (n_dot_l <= 0) continue;
            ++domain;
            error += n_dot_l * (1 - shot.visibility.at(x, y));
        }
        EXPECT_GT(domain, 1000);
        return error / domain;
    };
    expect_within_limit(2, energy(draw_shot(scene, s, 80, 60)));
    s.bias = no_bias();
    expect_fault(2, energy(draw_shot(scene, s, 80, 60)));
    // A bias without bound would reach infinity here.
    set_all(s, {"bias.slope=1000", "bias.normal=100"});
    draw_shot(scene, s, 80, 60);
}

// Case 3: depth steps of the formats over wide ranges, visible as acne on a plane under a spot light.
struct RangeCase {
    MapFormat format;
    double ratio;
    bool reversed;
};

class HardCase3 : public testing::TestWithParam<RangeCase> {};

TEST_P(HardCase3, NoAcneWithTheFormatsStep) {
    const RangeCase& c = GetParam();
    Settings s = plane_settings(c.format, "hard");
    set_all(s, {"light.type=spot", "light.cone=60", "light.elevation=75", "light.distance=20", "light.fit=manual",
                "light.far=32"});
    s.lights[0].near = s.lights[0].far / c.ratio;
    s.map.reversed_z = c.reversed;
    set_all(s, {"map.resolution=512", "bias.constant=0"});
    const Scene scene = plane_scene();
    const Shot bare = draw_shot(scene, s);
    EXPECT_NEAR(bare.view().curve.far / bare.view().curve.near, c.ratio, 1e-9 * c.ratio);
    const LeastBias b = predicted(bare, s);
    s.bias.constant = b.total();
    expect_within_limit(3, acne_share(draw_shot(scene, s)));
    // A step larger than the plane's tilt over a texel may round all depths to one and show nothing.
    if (b.kernel > 2 * (b.quantum + b.rounding)) {
        expect_fault(3, acne_share(bare));
    } else {
        EXPECT_TRUE(c.ratio >= 1e3 || c.format == MapFormat::D16) << "short ranges must resolve the plane";
    }
}

std::vector<RangeCase> range_cases() {
    std::vector<RangeCase> cases;
    for (MapFormat format : kFormats)
        for (double ratio : {10.0, 1e3, 1e5})
            for (bool reversed : {false, true}) cases.push_back({format, ratio, reversed});
    return cases;
}

INSTANTIATE_TEST_SUITE_P(All, HardCase3, testing::ValuesIn(range_cases()), [](const auto& named) {
    return format_name(named.param.format) + "_" + std::to_string(int(named.param.ratio)) +
           (named.param.reversed ? "_reversed" : "_standard");
});

}  // namespace
}  // namespace si::test
