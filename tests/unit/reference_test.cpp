// Tests of the ray-traced reference without a GPU: no self-shadowing, known shadows and penumbrae, and scene options
// (masks, culling, instances).
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "renderer/scenes/shapes.h"
#include "renderer/settings/param.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/mesh_scene.h"
#include "tests/support/ray_reference.h"
#include "tests/support/sets.h"
#include "tests/support/traced.h"

namespace si {
namespace {

using test::geometry_of;
using test::meets_box;
using test::query_for;
using test::receiver_on;
using test::row_of;
using test::sun;

std::size_t count_dark(const Reference& reference) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < reference.state.size(); ++i)
        count += reference.state[i] == PixelState::Counted && reference.hard().data[i] < 0.5f;
    return count;
}

/// Returns receivers all over each triangle of a single body, corners and edges included.
Receivers all_over(const ReferenceGeometry& geometry) {
    std::vector<Receiver> pixels;
    constexpr double kEps = 1e-7;
    const double places[][2] = {{1.0 / 3, 1.0 / 3}, {kEps, kEps}, {1 - 2 * kEps, kEps}, {0.5, 0}, {0, 0.5}, {0.5, 0.5}};
    for (std::uint32_t t = 0; t < geometry.objects[0].mesh->triangles(); ++t)
        for (const auto& [u, v] : places) pixels.push_back(receiver_on(geometry, 0, t, u, v));
    return row_of(std::move(pixels));
}

struct Placed {
    double radius, centre;
};

class ConvexCaster : public testing::TestWithParam<Placed> {};

TEST_P(ConvexCaster, NeverShadowsItself) {
    const auto [radius, centre] = GetParam();
    const Mesh bodies[] = {make_sphere(radius), make_box(glm::dvec3(radius)), make_capsule(radius, radius),
                           make_cylinder(radius, 2 * radius)};
    for (const Mesh& body : bodies) {
        const Scene scene = make_scene(body, moved(centre, -0.7 * centre, centre));
        const auto geometry = geometry_of(scene);
        const ReferenceScene casters(geometry);
        const Receivers receivers = all_over(*geometry);
        Random random(7);
        std::size_t facing = 0;
        std::vector<glm::dvec3> directions = {{0, 1, 0}, {1, 0, 0}, {0, 1e-4, 1}, {0.3, 0.5, -0.8}};
        for (int i = 0; i < 8; ++i) directions.push_back(random.direction());
        for (const glm::dvec3& to_light : directions) {
            const Reference reference = trace_visibility(casters, receivers, query_for(scene, sun(to_light)), {});
            facing += reference.counted();
            EXPECT_EQ(count_dark(reference), 0u)
                << scene.nodes[0].path << " towards " << to_light.x << ' ' << to_light.y << ' ' << to_light.z;
        }
        Emitter lamp = sun({0, 1, 0});
        lamp.type = LightType::Point;
        lamp.position_ws = glm::dvec3(centre, -0.7 * centre, centre) + glm::dvec3(3, 4, -2) * radius;
        const Reference reference = trace_visibility(casters, receivers, query_for(scene, lamp), {});
        EXPECT_EQ(count_dark(reference), 0u) << scene.nodes[0].path << ", point light";
        EXPECT_GT(facing + reference.counted(), receivers.pixels.size() * 4) << "too little was asked";
    }
}

INSTANTIATE_TEST_SUITE_P(ScalesAndPlaces, ConvexCaster,
                         testing::Values(Placed{1, 0}, Placed{1e3, 0}, Placed{1e6, 0}, Placed{1, 1e2}, Placed{1, 1e4},
                                         Placed{1, 1e6}, Placed{1e3, 1e6}, Placed{1e-6, 0}, Placed{1e-3, 1e3}),
                         [](const auto& named) {
                             const auto text = [](double v) {
                                 return v == 0 ? std::string("0")
                                               : "1e" + std::string(v < 1 ? "m" : "") +
                                                     std::to_string(std::abs(int(std::lround(std::log10(v)))));
                             };
                             return "radius_" + text(named.param.radius) + "_at_" + text(named.param.centre);
                         });

TEST(ConvexCaster, IsFullyLitByALargeLight) {
    const Scene scene = make_scene(make_sphere(1));
    const auto geometry = geometry_of(scene);
    const Reference reference =
        trace_visibility(ReferenceScene(geometry), all_over(*geometry),
                         query_for(scene, sun({0.2, 1, 0.1}, 5), {.area = true, .samples = 64}), {});
    std::size_t less = 0;
    for (std::size_t i = 0; i < reference.state.size(); ++i)
        less += reference.state[i] == PixelState::Counted && reference.visibility.data[i] != 1.f;
    EXPECT_EQ(less, 0u);
    EXPECT_GT(reference.counted(), 1000u);
}

/// Distance in metres between a floor and a box of 1.5 x 1 x 2 m that floats over it.
constexpr double kGap = 0.4;
Scene floor_and_box(double scale, const glm::dvec3& at) {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    const int root = add_node(scene, "root", -1, moved(at.x, at.y, at.z));
    add_object(scene, "floor", root, add_mesh(scene, "floor", make_plane(10 * scale, 10 * scale), grey));
    add_object(scene, "box", root, add_mesh(scene, "box", make_box(scale * glm::dvec3(1.5, 1, 2)), grey),
               moved(0, (kGap + 0.5) * scale, 0));
    finalise(scene);
    return scene;
}

TEST(Reference, BoxShadowIsTheClosedForm) {
    for (const double scale : {1.0, 1e3, 1e-4})
        for (const double away : {0.0, 1e6})
            for (const LightType type : {LightType::Directional, LightType::Spot, LightType::Point}) {
                const glm::dvec3 at = glm::dvec3(1, 0.5, -1) * away;
                const Scene scene = floor_and_box(scale, at);
                const auto geometry = geometry_of(scene);
                Emitter light = sun({0.5, 1, 0.3});
                light.type = type;
                light.position_ws = at + scale * glm::dvec3(2, 4, 1.2);
                std::vector<Receiver> pixels;
                for (int i = 0; i <= 100; ++i)
                    for (int j = 0; j <= 100 - i; ++j)
                        for (std::uint32_t triangle : {0u, 1u})
                            pixels.push_back(receiver_on(*geometry, 0, triangle, i / 100.0, j / 100.0));
                const Receivers receivers = row_of(std::move(pixels));
                const Reference reference =
                    trace_visibility(ReferenceScene(geometry), receivers, query_for(scene, light), {});
                const glm::dvec3 lo = scale * glm::dvec3(-0.75, kGap, -1), hi = scale * glm::dvec3(0.75, kGap + 1, 1);
                std::size_t in_shadow = 0;
                for (std::size_t i = 0; i < receivers.pixels.size(); ++i) {
                    const glm::dvec3 p = receivers.pixels[i].position_ws - at;
                    const bool directional = type == LightType::Directional;
                    const glm::dvec3 d = directional ? light.to_light : light.position_ws - at - p;
                    const double most = directional ? 1e9 * scale : 1;
                    // Points within rounding of the outline may fall to either side.
                    const double slack = 1e-6 * scale;
                    const bool shadow = meets_box(p, d, most, lo, hi);
                    if (meets_box(p, d, most, lo - slack, hi + slack) != meets_box(p, d, most, lo + slack, hi - slack))
                        continue;
                    in_shadow += shadow;
                    ASSERT_EQ(reference.hard().data[i] < 0.5f, shadow)
                        << p.x / scale << ' ' << p.z / scale << " scale " << scale << " away " << away;
                }
                EXPECT_GT(in_shadow, 100u);
                EXPECT_EQ(reference.counted(), receivers.pixels.size());
            }
}

TEST(Reference, MatchesBruteForceOverTriangles) {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    add_object(scene, "floor", -1, add_mesh(scene, "floor", make_plane(8, 8, 4, 4), grey));
    add_object(scene, "ring", -1, add_mesh(scene, "ring", make_torus(1, 0.3, 20, 10), grey),
               moved(0.6, 1, 0.2) * turned(50, {1, 0, 0}));
    add_object(scene, "mirrored ring", -1, 1, moved(-1.5, 0.6, 0) * scaled(-0.6, 0.4, 0.6));
    add_object(scene, "box", -1, add_mesh(scene, "box", make_box({0.7, 1.2, 0.5}), grey), moved(1.8, 0.6, -1));
    finalise(scene);
    Settings settings;
    const int w = 144, h = 96;
    const Camera camera = make_camera(scene, settings, double(w) / h);
    const auto geometry = geometry_of(scene);
    EXPECT_EQ(geometry->caster_triangles(), scene.triangle_count());
    const ReferenceScene casters(geometry);
    EXPECT_EQ(casters.triangle_count(), scene.triangle_count());
    const Receivers receivers = reconstruct_receivers(*geometry, camera, test::ids_by_rays(scene, camera, w, h), {});
    const test::RayReference rays(scene);
    for (const char* type : {"directional", "spot", "point"}) {
        set_setting(settings, "light.0.type", type);
        const auto lights = fit_lights(scene, settings);
        const Reference reference =
            trace_visibility(casters, receivers, reference_query(scene, settings, lights, 0), {});
        std::size_t shadow = 0, lit = 0;
        for (const auto& [x, y, origin, dir] : test::pixel_rays(camera, w, h)) {
            const std::size_t i = std::size_t(y) * w + std::size_t(x);
            if (reference.state[i] != PixelState::Counted) continue;
            const auto hit = rays.first_hit(origin, dir);
            ASSERT_TRUE(hit);
            EXPECT_LT(glm::distance(hit->position, receivers.pixels[i].position_ws), 1e-9);
            const bool expected = rays.occluded(hit->position, lights[0], hit->triangle);
            EXPECT_EQ(reference.hard().data[i] < 0.5f, expected) << type << " at " << x << ',' << y;
            ++(expected ? shadow : lit);
        }
        EXPECT_GT(shadow, 100u) << type;
        EXPECT_GT(lit, 500u) << type;
    }
}

TEST(Reference, FastPathForDirectionalLightsIsEqual) {
    const Scene scene = floor_and_box(1, glm::dvec3(0));
    Settings settings;
    const Camera camera = make_camera(scene, settings, 1.5);
    for (const char* receives : {"true", "false"}) {
        set_setting(settings, "object.root/box.receive", receives);
        const auto geometry = geometry_of(scene, settings);
        const ReferenceScene casters(geometry);
        const Receivers receivers =
            reconstruct_receivers(*geometry, camera, test::ids_by_rays(scene, camera, 90, 60), {});
        Receivers slow = receivers;
        slow.starts.clear();
        for (const double elevation : {45.0, 0.05, 0.0, -0.05}) {
            settings.lights[0].elevation = elevation;
            const ReferenceQuery query = reference_query(scene, settings, fit_lights(scene, settings), 0);
            const Reference a = trace_visibility(casters, receivers, query, {}),
                            b = trace_visibility(casters, slow, query, {});
            EXPECT_EQ(a.state, b.state) << elevation;
            EXPECT_EQ(a.visibility.data, b.visibility.data) << elevation;
            EXPECT_EQ(a.rays, b.rays) << elevation;
        }
    }
}

TEST(Reference, CountsReasonsOfExcludedPixels) {
    const Scene scene = floor_and_box(1, glm::dvec3(0));
    Settings settings = settings_with({}, {"light.0.type=spot", "light.0.cone=20", "light.0.distance=12",
                                           "light.0.elevation=50", "object.root/box.receive=false"});
    const Camera camera = make_camera(scene, settings, 1.5);
    const auto geometry = geometry_of(scene, settings);
    const Receivers receivers = reconstruct_receivers(*geometry, camera, test::ids_by_rays(scene, camera, 90, 60), {});
    const auto traced = [&](const std::vector<FittedLight>& lights) {
        return trace_visibility(ReferenceScene(geometry), receivers, reference_query(scene, settings, lights, 0), {});
    };
    Reference reference = traced(fit_lights(scene, settings));
    std::array<std::size_t, kPixelStates> counted{};
    for (const PixelState s : reference.state) ++counted[std::size_t(s)];
    EXPECT_EQ(counted, reference.pixels);
    EXPECT_GT(reference.counted(), 100u);
    EXPECT_GT(counted[std::size_t(PixelState::Background)], 100u);
    EXPECT_GT(counted[std::size_t(PixelState::OutsideCone)], 100u);
    EXPECT_GT(counted[std::size_t(PixelState::NotReceiving)], 20u);
    EXPECT_EQ(counted[std::size_t(PixelState::BeyondRange)], 0u);

    // A light straight overhead reaches a circle of the floor, and shadows outside it are still traced.
    set_setting(settings, "light.0.elevation", "90");
    const double height = fit_lights(scene, settings)[0].position.y, range = std::hypot(height, 1.75);
    settings.lights[0].range = range;
    const FittedLight ranged = fit_lights(scene, settings)[0];
    reference = traced({ranged});
    std::size_t outside = 0;
    for (std::size_t i = 0; i < reference.state.size(); ++i) {
        const Receiver& r = receivers.pixels[i];
        if (reference.state[i] != PixelState::Counted && reference.state[i] != PixelState::BeyondRange) continue;
        const bool reached = glm::distance(r.position_ws, ranged.position) < range;
        EXPECT_EQ(reference.state[i] == PixelState::Counted, reached);
        outside += !reached;
    }
    EXPECT_GT(outside, 30u);
    EXPECT_GT(reference.counted(), 50u);
    EXPECT_EQ(reference.pixels[std::size_t(PixelState::BeyondRange)], outside);
    set_setting(settings, "light.0.range", "0");
    const Reference endless = traced(fit_lights(scene, settings));
    EXPECT_EQ(endless.visibility.data, reference.visibility.data);
    EXPECT_EQ(endless.counted(), reference.counted() + outside);

    set_all(settings, {"light.0.type=directional", "light.0.elevation=-30"});
    reference = traced(fit_lights(scene, settings));
    EXPECT_EQ(reference.counted(), 0u) << "the floor is lit from below";
    EXPECT_GT(reference.pixels[std::size_t(PixelState::FacesAway)], 100u);
    set_all(settings, {"light.0.elevation=50", "light.0.cast=false"});
    reference = traced(fit_lights(scene, settings));
    EXPECT_EQ(count_dark(reference), 0u) << "a light that casts nothing";
    EXPECT_THROW(reference_query(scene, settings, fit_lights(scene, settings), 1), Error);
}

}  // namespace
}  // namespace si
