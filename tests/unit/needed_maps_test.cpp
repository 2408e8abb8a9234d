// Tests of needed map parts: every look-up of a visible point is inside them.
#include "renderer/view/culling/needed_maps.h"

#include <gtest/gtest.h>

#include "renderer/projection/projection.h"
#include "renderer/scene/clusters.h"
#include "renderer/scenes/builtin.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/param.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/error_text.h"
#include "tests/support/mesh_scene.h"
#include "tests/support/sets.h"

namespace si {
namespace {

std::vector<std::vector<Cluster>> all_clusters(const Scene& scene) {
    std::vector<std::vector<Cluster>> out;
    for (const Mesh& m : scene.meshes) out.push_back(build_clusters(m));
    return out;
}

/// Returns what a camera sees in a picture of 100 lines. @param clusters clusters of each mesh
VisibleBodies visible_bodies(const Scene& scene, const Camera& camera,
                             const std::vector<std::vector<Cluster>>& clusters) {
    return find_visible_bodies(scene, camera, 100,
                               [&](std::size_t m) -> std::span<const Cluster> { return clusters[m]; });
}

TEST(Clusters, HoldEveryTriangle) {
    for (const char* name : {"boxes", "landscape", "figures"}) {
        const Scene scene = load_scene(name);
        for (const Mesh& m : scene.meshes) {
            const std::vector<Cluster> boxes = build_clusters(m);
            EXPECT_LE(boxes.size(), m.indices.size() / 3);
            for (std::size_t i = 0; i + 2 < m.indices.size(); i += 3) {
                const bool held = std::ranges::any_of(boxes, [&](const Cluster& c) {
                    glm::dvec3 p[3];
                    for (std::size_t k = 0; k < 3; ++k) {
                        p[k] = m.positions[m.indices[i + k]];
                        if (glm::any(glm::lessThan(p[k], c.box.lo)) || glm::any(glm::greaterThan(p[k], c.box.hi)))
                            return false;
                    }
                    if (c.axis == glm::dvec3(0)) return true;
                    const glm::dvec3 n = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
                    return std::acos(std::clamp(glm::dot(n, c.axis), -1.0, 1.0)) <= c.spread + 1e-6;
                });
                ASSERT_TRUE(held) << name << ", " << m.name << ", triangle " << i / 3;
                if (m.indices.size() > 30000) i += 3 * 100;
            }
        }
    }
    const Scene scene = load_scene("landscape");
    const auto large = std::ranges::max_element(scene.meshes, {}, [](const Mesh& m) { return m.indices.size(); });
    EXPECT_GT(build_clusters(*large).size(), 500u);
}

// Each triangle of a cluster shows the cluster's side at each corner.
TEST(Clusters, FaceOneSideOnlyIfEachTriangleDoes) {
    Random random(7);
    int fronts = 0, backs = 0, either = 0;
    for (const char* name : {"landscape", "figures", "teapot", "stage", "boxes"}) {
        const Scene scene = load_scene(name);
        for (const Mesh& m : scene.meshes) {
            const std::vector<Cluster> clusters = build_clusters(m);
            for (int round = 0; round < 20; ++round) {
                const glm::dvec3 way(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1));
                const bool parallel = round % 2 == 0;
                const glm::dvec3 there = m.bounds.centre() + random.in(0.3, 3) * m.bounds.radius() * way;
                const Cluster& c = clusters[std::size_t(random.in(0, double(clusters.size()) - 0.01))];
                const VisibleSide side = visible_side(c, parallel ? glm::dvec4(way, 0) : glm::dvec4(there, 1));
                fronts += side == VisibleSide::Front;
                backs += side == VisibleSide::Back;
                either += side == VisibleSide::Either;
                if (side == VisibleSide::Either) continue;
                for (std::size_t i = 0; i + 2 < m.indices.size(); i += 3) {
                    const glm::dvec3 a = m.positions[m.indices[i]], b = m.positions[m.indices[i + 1]],
                                     d = m.positions[m.indices[i + 2]];
                    Bounds box;
                    for (const glm::dvec3& p : {a, b, d, c.box.lo, c.box.hi}) box.add(p);
                    const glm::dvec3 n = glm::normalize(glm::cross(b - a, d - a));
                    // Directions that the cluster may hold.
                    if (box.lo != c.box.lo || box.hi != c.box.hi || glm::dot(n, c.axis) < std::cos(c.spread)) continue;
                    for (const glm::dvec3& p : {a, b, d}) {
                        const double at = glm::dot(n, parallel ? way : there - p);
                        ASSERT_TRUE(side == VisibleSide::Front ? at > 0 : at < 0) << name << ", " << m.name;
                    }
                }
            }
        }
    }
    EXPECT_GT(fronts, 30);
    EXPECT_GT(backs, 30);
    EXPECT_GT(either, 10);
    EXPECT_EQ(visible_side({}, {0, 1, 0, 0}), VisibleSide::Either);
    // A floor shows one side to every point above it, also near its middle.
    Mesh plane = make_plane(40, 40);
    for (const auto& p : plane.positions) plane.bounds.add(p);
    const std::vector<Cluster> floor = build_clusters(plane);
    ASSERT_EQ(floor.size(), 1u);
    EXPECT_EQ(visible_side(floor[0], {1, 2, 3, 1}), VisibleSide::Front);
    EXPECT_EQ(visible_side(floor[0], {1, -2, 3, 1}), VisibleSide::Back);
    EXPECT_EQ(visible_side(floor[0], {1, 0.1, 3, 1}), VisibleSide::Either) << "its far corners are seen nearly edge-on";
}

TEST(MapCells, IntersectTheirContents) {
    MapCells r;
    EXPECT_TRUE(r.empty());
    r.add({{1.2, 0.2}, {1.3, 0.3}}, false);
    EXPECT_TRUE(r.empty()) << "it lies beyond the map";
    r.add({{1.2, 0.2}, {1.3, 0.3}}, true);
    EXPECT_TRUE(r.overlaps({{0.99, 0.25}, {0.995, 0.26}})) << "the rim stands for it";
    EXPECT_FALSE(r.overlaps({{0.5, 0.25}, {0.6, 0.26}}));
    EXPECT_FALSE(r.overlaps({{0.99, 0.5}, {1, 0.6}}));
    EXPECT_TRUE(r.overlaps({{-1, -1}, {2, 2}}));
    EXPECT_TRUE(MapCells::whole().contains(r));
    EXPECT_FALSE(r.contains(MapCells::whole()));
    r.add({{-1, -1}, {2, 2}}, false);
    EXPECT_TRUE(r.is_whole());
    MapCells rim;
    rim.add_border_cells();
    EXPECT_FALSE(rim.overlaps({{0.1, 0.1}, {0.9, 0.9}}));
    EXPECT_TRUE(rim.overlaps({{0.1, 0.1}, {0.9, 0.99}}));
}

struct Kind {
    const char* name;
    Sets sets;
    bool whole = false;  ///< whole maps; otherwise nothing of each map
};

const Kind kKinds[] = {
    {"directional", {}},
    {"directional by hand", {"light.fit=manual", "light.extent=0.7", "map.wrap=clamp"}},
    {"spot", {"light.type=spot", "light.distance=3"}},
    {"spot among the boxes", {"light.type=spot", "light.distance=0.6", "map.wrap=clamp"}},
    {"spot that looks along the floor", {"light.type=spot", "light.distance=3", "light.elevation=3", "map.wrap=clamp"}},
    {"spot that repeats", {"light.type=spot", "light.distance=2", "light.cone=20", "map.wrap=repeat"}, true},
    {"directional that repeats", {"light.fit=manual", "light.extent=0.7", "map.wrap=repeat"}, true},
    {"point", {"light.type=point", "light.distance=1"}},
    {"point, ranged", {"light.type=point", "light.distance=3", "light.range=2.5"}},
    {"cascades", {"light.cascades=4", "light.cascade_blend=0.2"}},
    {"stabilised", {"light.cascades=3", "light.fit=stabilised"}},
    {"warped", {"light.fit=lispsm"}, true},
};

/// Returns whether shaders treat the side towards the camera as facing away from the light.
bool is_turned_away(const Object& object, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                    const glm::dvec3& at_ws, const Camera& camera, const FittedLight& light) {
    const glm::dmat3 m(object.world);
    const glm::dvec3 n = glm::cross(m * (b - a), m * (c - a));
    const glm::dvec3 to_eye = camera.orthographic ? camera.axes[2] : camera.eye - at_ws;
    const glm::dvec3 to_light = light.type == LightType::Directional ? light.to_light : light.position - at_ws;
    return glm::dot(n, to_eye) * glm::dot(n, to_light) < 0;
}

/// Makes boxes among balls that are large enough for clusters, one mirrored and skewed.
/// @param alone leaves out the boxes
Scene boxes_and_balls(bool alone) {
    Scene scene = load_scene("boxes");
    if (alone) scene.objects.clear();
    const int ball = add_mesh(scene, "Ball", make_sphere(0.7, 48, 24), -1);
    add_object(scene, "Ball", -1, ball, moved(1.5, 0.5, -1));
    add_object(scene, "Ball", -1, ball, moved(-1.2, 0.8, 1) * scaled(-1, 1.7, 0.6) * turned(30));
    finalise(scene);
    return scene;
}

// Look-ups of visible triangle points, as set up by choose_view(), are inside the needed cells.
TEST(NeededMaps, HoldAllVisibleReceivers) {
    const Scene scenes[] = {boxes_and_balls(false), boxes_and_balls(true)};
    const std::vector<std::vector<Cluster>> of_scenes[] = {all_clusters(scenes[0]), all_clusters(scenes[1])};
    Random random(3);
    for (const Kind& kind : kKinds) {
        int looked_up = 0, unread = 0, views = 0;
        for (int round = 0; round < 16; ++round) {
            const Scene& scene = scenes[round / 2 % 2];
            const std::vector<std::vector<Cluster>>& clusters = of_scenes[round / 2 % 2];
            Settings s = settings_with({}, kind.sets);
            s.camera.source = CameraSource::Manual;
            s.camera.azimuth = random.in(0, 360);
            s.camera.elevation = random.in(-10, 80);
            s.camera.distance = random.in(0.3, 9);
            s.camera.fov = random.in(15, 70);
            s.camera.target_x = random.in(-3, 3);
            s.camera.target_z = random.in(-3, 3);
            s.lights[0].azimuth = random.in(0, 360);
            const Camera camera = make_camera(scene, s, 1.5);
            const FittedLight light = fit_lights(scene, s, &camera)[0];
            ASSERT_TRUE(light.casts) << light.reason;
            const VisibleBodies seen = visible_bodies(scene, camera, clusters);
            const bool only_lit_points = round % 2 == 0;
            LookupArea area{.resolution = 512,
                            .reach_texels = 20,
                            .normal_texels = 4,
                            .wrap = s.map.wrap,
                            .only_lit_points = only_lit_points};
            if (round % 3 == 2) {  // the same offset in metres
                area.normal_texels = 0;
                for (const LightView& view : light.views)
                    area.normal_m = std::max(area.normal_m, 4 * view.texel_size_range(512).longest);
            }
            const NeededMaps needed = needed_maps(light, seen, area);
            ASSERT_EQ(needed.views.size(), light.views.size());
            for (const MapCells& r : needed.views) {
                ++views;
                unread += !r.is_whole();
            }
            for (const Object& object : scene.objects) {
                const Mesh& m = scene.meshes[std::size_t(object.mesh)];
                for (std::size_t i = 0; i + 2 < m.indices.size(); i += 3 * (1 + m.indices.size() / 600))
                    for (int k = 0; k < 20; ++k) {
                        double a = random.in(0, 1), b = random.in(0, 1);
                        if (a + b > 1) {
                            a = 1 - a;
                            b = 1 - b;
                        }
                        const glm::dvec3 p0 = m.positions[m.indices[i]], p1 = m.positions[m.indices[i + 1]],
                                         p2 = m.positions[m.indices[i + 2]];
                        const glm::dvec3 p = object.world * glm::dvec4(p0 + a * (p1 - p0) + b * (p2 - p0), 1);
                        const glm::dvec4 at = camera.project(p, 150, 100);
                        if (!(at.w > 0 && at.x >= 0 && at.x <= 150 && at.y >= 0 && at.y <= 100 && at.z >= 0 &&
                              at.z <= 1))
                            continue;
                        if (only_lit_points && light.range_m > 0 && glm::distance(p, light.position) > light.range_m)
                            continue;
                        if (is_turned_away(object, p0, p1, p2, p, camera, light)) continue;
                        const ChosenView chosen = light.chooser.choose(light.views, p);
                        for (const std::size_t v : {chosen.view, chosen.other}) {
                            const LightView& view = light.views[v];
                            const glm::dvec4 h = (uvd_from_clip(view.curve.convention) * view.clip_from_relative(p))[3];
                            if (!(h.w > 0)) continue;
                            // A spot light lights only its cone.
                            if (only_lit_points && light.type == LightType::Spot &&
                                glm::dot(glm::normalize(light.position - p), light.to_light) < light.cos_cone_outer)
                                continue;
                            ++looked_up;
                            for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {-1, 1}, {1, -1}, {1, 1}}) {
                                const glm::dvec2 uv = glm::dvec2(h) / h.w + corner * (24.0 / 512);
                                const bool repeats = area.wrap == MapWrap::Repeat, clamps = area.wrap == MapWrap::Clamp;
                                const glm::dvec2 held =
                                    repeats ? glm::fract(uv) : glm::clamp(uv, glm::dvec2(0), glm::dvec2(1));
                                if (uv != held && ((!clamps && !repeats) || light.is_cascaded())) continue;
                                ASSERT_TRUE(needed.views[v].overlaps({held, held}))
                                    << kind.name << ", round " << round << ", view " << v << ", at " << uv.x << ", "
                                    << uv.y;
                            }
                        }
                    }
            }
        }
        EXPECT_GT(looked_up, 1000) << kind.name;
        if (!kind.whole) {
            EXPECT_GT(unread, views / 10) << kind.name;
        }
    }
}

TEST(NeededMaps, SkipBackFacingReceivers) {
    Scene scene = make_scene(make_sphere(1, 200, 100));
    const auto clusters = all_clusters(scene);
    Settings s = settings_with({}, {"camera.source=manual", "camera.elevation=0", "camera.distance=9"});
    s.lights[0].elevation = 0;
    int needed[2];
    for (const bool against : {false, true}) {
        s.camera.azimuth = 40;
        s.lights[0].azimuth = against ? 220 : 40;
        const Camera camera = make_camera(scene, s, 1.5);
        const VisibleBodies seen = visible_bodies(scene, camera, clusters);
        const NeededMaps maps = needed_maps(fit_lights(scene, s, &camera)[0], seen, {.resolution = 512});
        int& cells = needed[against] = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                cells += maps.views[0].overlaps({{(x + 0.4) / 64, (y + 0.4) / 64}, {(x + 0.6) / 64, (y + 0.6) / 64}});
    }
    EXPECT_GT(needed[false], 1500) << "a disc that nearly fills the map";
    EXPECT_LT(needed[true], needed[false] / 2) << "its rim, where clusters may show either side";
}

TEST(NeededMaps, GiveTheReasonIfNoneIsNeeded) {
    const Scene scene = load_scene("boxes");
    Settings s = settings_with({}, {"light.intensity=0"});
    const Camera camera = make_camera(scene, s, 1.5);
    const auto clusters = all_clusters(scene);
    const VisibleBodies seen = visible_bodies(scene, camera, clusters);
    const FittedLight dark = fit_lights(scene, s, &camera)[0];
    const NeededMaps of_lit_points = needed_maps(dark, seen, {.resolution = 512, .only_lit_points = true});
    EXPECT_TRUE(test::mentions(of_lit_points.unneeded_reason, {"intensity"}));
    EXPECT_EQ(needed_maps(dark, seen, {.resolution = 512}).unneeded_reason, "") << "its visibility may be looked at";
    EXPECT_TRUE(
        test::mentions(needed_maps(dark, {seen.view, {}}, {.resolution = 512}).unneeded_reason, {"sees nothing"}));
    VisibleBodies unknown{seen.view, {}, true};
    EXPECT_TRUE(needed_maps(dark, unknown, {.resolution = 512}).views[0].is_whole());
}

}  // namespace
}  // namespace si
