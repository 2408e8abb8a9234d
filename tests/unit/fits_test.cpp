// Tests of light fits, compared with closed forms and with rays from every surface to the light.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "renderer/base/angles.h"
#include "renderer/base/directions.h"
#include "renderer/scenes/builtin.h"
#include "renderer/scenes/shapes.h"
#include "renderer/view/bounds/flat_mesh.h"
#include "renderer/view/fits/light_fit.h"
#include "renderer/view/fits/region.h"
#include "tests/support/ray_reference.h"
#include "tests/support/traits.h"

namespace si {
namespace {

constexpr double kFar = 1e9;

/// Returns a sun's view, placed but not fitted.
LightView sun(const Scene& scene, double azimuth, double elevation) {
    LightView view;
    view.axes = orthonormal_basis(direction_from_angles(azimuth, elevation));
    view.eye = scene.bounds.centre() + view.axes[2] * (2 * scene.bounds.radius() + 1);
    return view;
}

LightView spot(const glm::dvec3& eye, const glm::dvec3& at, double cone_deg) {
    LightView view;
    view.axes = orthonormal_basis(glm::normalize(eye - at));
    view.eye = eye;
    view.curve.perspective = true;
    view.set_half_extents(glm::dvec2(std::tan(0.5 * cone_deg * kDegree)));
    return view;
}

/// Returns the region across the view that holds these points: metres, or tangents in perspective.
MapRegion region_of(const LightView& view, const std::vector<glm::dvec3>& points) {
    MapRegion r;
    for (const glm::dvec3& p : points) {
        const glm::dvec3 v = glm::transpose(view.axes) * (p - view.eye);
        r.add(glm::dvec2(v) / (view.curve.perspective ? -v.z : 1.0));
    }
    return r;
}

std::vector<glm::dvec3> box_corners(const glm::dvec3& lo, const glm::dvec3& hi) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 8; ++i) points.emplace_back(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z);
    return points;
}

void expect_bounds_near(const std::optional<MapRegion>& found, const MapRegion& expected, double tolerance) {
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->lo.x, expected.lo.x, tolerance);
    EXPECT_NEAR(found->lo.y, expected.lo.y, tolerance);
    EXPECT_NEAR(found->hi.x, expected.hi.x, tolerance);
    EXPECT_NEAR(found->hi.y, expected.hi.y, tolerance);
}

struct Made {
    Scene scene;
    int root = 0;
    glm::dvec3 offset{0};
    explicit Made(const glm::dvec3& at = glm::dvec3(0)) : offset(at) { root = add_node(scene, "Root"); }
    void add(const char* name, const Mesh& mesh, const glm::dmat4& local, bool two_sided = false) {
        const int material = add_material(scene, name, {0.5f, 0.5f, 0.5f});
        scene.materials[std::size_t(material)].double_sided = two_sided;
        add_object(scene, name, root, add_mesh(scene, name, mesh, material),
                   moved(offset.x, offset.y, offset.z) * local);
    }
    /// Fits a finished scene.
    std::optional<MapRegion> fit(FitFunction f, const LightView& view, const Settings& settings = {},
                                 const Camera* camera = nullptr) const {
        const SceneShape shape = scene_shape(scene, settings);
        return f({.scene = scene, .shape = shape, .view = view, .camera = camera});
    }
};

/// Makes a floor of 20 m and a box of 2 x 1 x 2 m, 3 m from the floor's middle.
Made floor_and_box_at(const glm::dvec3& offset, const glm::dmat4& turn = glm::dmat4(1)) {
    Made m(offset);
    m.add("Floor", make_plane(20, 20), turn);
    m.add("Box", make_box({2, 1, 2}), turn * moved(3, 0.5, 0));
    finalise(m.scene);
    return m;
}

SI_TESTS_ARE(Repeated, CastersFit);
TEST(CastersFit, FloorUnderABoxDoesNotWidenIt) {
    // Every lit point of the box may cast onto the floor: its own extent, whatever the direction.
    for (const glm::dvec3 offset : {glm::dvec3(0), glm::dvec3(-3e5, 40, 7e4)}) {
        const Made m = floor_and_box_at(offset);
        std::vector<glm::dvec3> box = box_corners({2, 0, -1}, {4, 1, 1});
        for (glm::dvec3& p : box) p += offset;
        for (const auto& [azimuth, elevation] :
             {std::pair{0.0, 90.0}, {90.0, 45.0}, {0.0, 30.0}, {180.0, 60.0}, {270.0, 20.0}, {33.0, 40.0}}) {
            SCOPED_TRACE(testing::Message() << azimuth << " " << elevation << " at " << offset.x);
            const LightView view = sun(m.scene, azimuth, elevation);
            expect_bounds_near(m.fit(fit_casters, view), region_of(view, box), 1e-4);
        }
        const glm::dvec3 lamp = offset + glm::dvec3(1, 9, 2);
        const LightView view = spot(lamp, offset, 120);
        expect_bounds_near(m.fit(fit_casters, view), region_of(view, box), 1e-4);
    }
}

TEST(CastersFit, TiltedFloorIsAFloor) {
    const glm::dmat4 turn = turned(25, glm::normalize(glm::dvec3(1, 2, 0.5)));
    const Made m = floor_and_box_at(glm::dvec3(5, -2, 1), turn);
    std::vector<glm::dvec3> box = box_corners({2, 0, -1}, {4, 1, 1});
    for (glm::dvec3& p : box) p = glm::dvec3(turn * glm::dvec4(p, 1)) + glm::dvec3(5, -2, 1);
    const LightView view = sun(m.scene, 20, 70);
    expect_bounds_near(m.fit(fit_casters, view), region_of(view, box), 1e-4);
    // Its triangles need not be in a plane of the mesh's own axes.
    Made baked;
    Mesh floor = make_plane(20, 20);
    for (glm::vec3& p : floor.positions.edit()) p = glm::vec3(turn * glm::dvec4(p, 1));
    baked.add("Floor", floor, glm::dmat4(1));
    baked.add("Box", make_box({2, 1, 2}), turn * moved(3, 0.5, 0));
    finalise(baked.scene);
    for (glm::dvec3& p : box) p -= glm::dvec3(5, -2, 1);
    const LightView there = sun(baked.scene, 20, 70);
    expect_bounds_near(baked.fit(fit_casters, there), region_of(there, box), 1e-4);
}

TEST(CastersFit, FlatCastersCount) {
    // A wall of 4 x 2.5 m on a floor, lit from the front and from behind.
    for (const double azimuth : {0.0, 180.0, 30.0}) {
        Made m;
        m.add("Floor", make_plane(20, 20), glm::dmat4(1));
        m.add("Wall", make_quad(4, 2.5), moved(1, 0, 2), true);
        finalise(m.scene);
        const LightView view = sun(m.scene, azimuth, 35);
        expect_bounds_near(m.fit(fit_casters, view),
                           region_of(view, {{-1, 0, 2}, {3, 0, 2}, {-1, 2.5, 2}, {3, 2.5, 2}}), 1e-4);
    }
    // A shelf of 2 x 3 m above a floor; a floor above a larger floor.
    Made m;
    m.add("Floor", make_plane(20, 20), glm::dmat4(1));
    m.add("Shelf", make_plane(2, 3), moved(4, 1, 0));
    finalise(m.scene);
    const LightView view = sun(m.scene, 0, 90);
    expect_bounds_near(m.fit(fit_casters, view), region_of(view, {{3, 1, -1.5}, {5, 1, 1.5}}), 1e-4);
}

TEST(CastersFit, FloorWithReceiversBelowCounts) {
    Made m = floor_and_box_at(glm::dvec3(0));
    m.add("Sunk", make_box({1, 1, 1}), moved(-6, -0.3, -5));  // from 0.8 m below to 0.2 m above
    m.add("Cellar", make_plane(3, 2), moved(0, -4, 7));
    finalise(m.scene);
    const LightView view = sun(m.scene, 0, 90);
    // The box, the sunk one and, through the floor, the cellar's floor.
    MapRegion expected = region_of(view, {{4, 0, 1}, {-6.5, 0, -5.5}, {1.5, -4, 8}});
    expect_bounds_near(m.fit(fit_casters, view), expected, 1e-4);
    // A light from below lets the floor shadow everything that stands on it.
    Made above = floor_and_box_at(glm::dvec3(0));
    above.add("Far", make_box({1, 1, 1}), moved(-8, 5, -8));
    finalise(above.scene);
    const LightView below = sun(above.scene, 0, -90);
    const auto found = above.fit(fit_casters, below);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->contains(region_of(below, {{-8.5, 5, -8.5}, {4, 0, 1}})));
}

TEST(CastersFit, BackFacingReceiversCountOnlyIfTwoSided) {
    // A ceiling below the floor, whose front looks down: hidden from above unless its back is drawn.
    for (const bool two_sided : {false, true}) {
        Made m = floor_and_box_at(glm::dvec3(0));
        m.add("Ceiling", make_plane(3, 2), moved(-5, -1, 7) * turned(180, {1, 0, 0}), two_sided);
        finalise(m.scene);
        const LightView view = sun(m.scene, 0, 90);
        MapRegion expected = region_of(view, {{2, 0, -1}, {4, 0, 1}});
        if (two_sided) expected.add(region_of(view, {{-6.5, -1, 6}, {-3.5, -1, 8}}));
        expect_bounds_near(m.fit(fit_casters, view), expected, 1e-4);
    }
}

TEST(CastersFit, SlabIsAFloor) {
    // Convex and single-sided: it cannot shade itself, and everything is in front of its upper side.
    Made m;
    m.add("Slab", make_box({20, 0.3, 20}), moved(0, -0.15, 0));
    m.add("Box", make_box({2, 1, 2}), moved(3, 0.5, 0));
    finalise(m.scene);
    const LightView view = sun(m.scene, 70, 35);
    expect_bounds_near(m.fit(fit_casters, view), region_of(view, box_corners({2, 0, -1}, {4, 1, 1})), 1e-4);
    // Two-sided, its lower side is shaded by its upper one.
    Made open;
    open.add("Slab", make_box({20, 0.3, 20}), moved(0, -0.15, 0), true);
    finalise(open.scene);
    const LightView there = sun(open.scene, 70, 35);
    expect_bounds_near(open.fit(fit_casters, there), region_of(there, box_corners({-10, -0.3, -10}, {10, 0, 10})),
                       1e-4);
}

TEST(CastersFit, WithoutAnyShadowItIsTheSceneFit) {
    Made m;
    m.add("Floor", make_plane(20, 20), glm::dmat4(1));
    finalise(m.scene);
    EXPECT_FALSE(m.fit(fit_casters, sun(m.scene, 20, 50)));
    EXPECT_FALSE(m.fit(fit_casters, sun(m.scene, 90, 0))) << "edge-on";
}

TEST(CastersFit, ObjectsThatNeitherCastNorReceiveDoNotCount) {
    Made m = floor_and_box_at(glm::dvec3(0));
    m.add("Ghost", make_box({1, 1, 1}), moved(-8, 0.5, -8));
    finalise(m.scene);
    const LightView view = sun(m.scene, 0, 90);
    Settings s;
    s.objects["Root/Ghost"] = {.cast = false};
    expect_bounds_near(m.fit(fit_casters, view, s), region_of(view, {{2, 0, -1}, {4, 0, 1}}), 1e-4);
    EXPECT_TRUE(m.fit(fit_casters, view)->contains(region_of(view, {{-8, 0, -8}})));
    s = {};
    s.objects["Root/Floor"] = {.receive = false};
    s.objects["Root/Ghost"] = {.receive = false};
    EXPECT_FALSE(m.fit(fit_casters, view, s)) << "a box does not shade its own lit sides";
}

Camera camera_at(const glm::dvec3& eye, const glm::dvec3& at, double fov_deg, double near, double far) {
    Camera c;
    c.eye = eye;
    c.axes = orthonormal_basis(glm::normalize(eye - at));
    c.fov_y_rad = fov_deg * kDegree;
    c.curve.near = near;
    c.curve.far = far;
    c.curve.perspective = true;
    return c;
}

SI_TESTS_ARE(Repeated, ViewFit);
TEST(ViewFit, HoldsTheVisibleRegion) {
    // From above, at a height of 10 m and with a square picture, the camera sees 10 tan(20°) to each side of the floor.
    Made m;
    m.add("Floor", make_plane(200, 200), glm::dmat4(1));
    m.add("Roof", make_box({150, 1, 150}), moved(0, 60.5, 0));
    finalise(m.scene);
    const Camera camera = camera_at({7, 10, -3}, {7, 0, -3}, 40, 0.1, 50);
    const double side = 10 * std::tan(20 * kDegree);
    const LightView view = sun(m.scene, 0, 90);
    // A camera may be rolled: a rotated square has a wider extent.
    MapRegion seen;
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0}) {
            const glm::dvec3 ray = camera.axes * glm::dvec3(x * side, y * side, -10);
            seen.add(region_of(view, {camera.eye + ray}));
        }
    expect_bounds_near(m.fit(fit_view, view, {}, &camera), seen, 1e-6);
    const auto all = m.fit(fit_casters, view);
    expect_bounds_near(all, region_of(view, {{-75, 0, -75}, {75, 0, 75}}), 1e-6);
    expect_bounds_near(m.fit(fit_view, view), *all, 0);
}

/// Point on a scene's surfaces, with the front side of its triangle.
struct OnSurface {
    glm::dvec3 position, normal;
    bool two_sided;
};

OnSurface surface_point(const Scene& scene, const test::Triangle& t, const glm::dvec3& position) {
    const Object& object = scene.objects[std::size_t(t.object)];
    const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
    const double front =
        glm::determinant(glm::dmat3(object.world)) < 0 ? -1 : 1;  // a mirrored object has the other front side
    const bool two_sided = mesh.material >= 0 && scene.materials[std::size_t(mesh.material)].double_sided;
    return {position, front * t.normal, two_sided};
}

/// Calls `use` with points on all surfaces, independent of any camera.
template <class Use>
void each_surface_point(const Scene& scene, const test::RayReference& rays, int count, Use use) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<double> area{0};
    for (std::size_t i = 0; i < rays.triangle_count(); ++i) {
        const test::Triangle& t = rays.triangle(int(i));
        area.push_back(area.back() + std::sqrt(glm::length(glm::cross(t.b - t.a, t.c - t.a))));
    }
    for (int i = 0; i < count; ++i) {
        const double at = unit(random) * area.back();
        const int which = int(std::upper_bound(area.begin(), area.end(), at) - area.begin()) - 1;
        const test::Triangle& t = rays.triangle(std::min(which, int(rays.triangle_count()) - 1));
        double u = unit(random), v = unit(random);
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        use(surface_point(scene, t, t.a + u * (t.b - t.a) + v * (t.c - t.a) + scene.bounds.centre()));
    }
}

/// Calls `use` with the surface of each pixel of a small picture: the first one between the near and far planes that is
/// not the back of a single-sided one.
template <class Use>
void each_visible_point(const Scene& scene, const test::RayReference& rays, const Camera& camera, int width, int height,
                        Use use) {
    for (const auto& [x, y, origin, dir] : test::pixel_rays(camera, width, height)) {
        const double per_depth = 1 / -glm::dot(dir, camera.axes[2]);
        double gone = camera.curve.near * per_depth;
        for (int layers = 0; layers < 30; ++layers) {
            const auto hit = rays.first_hit(origin + gone * dir, dir);
            if (!hit) break;
            gone += hit->distance;
            if (gone > camera.curve.far * per_depth) break;
            const OnSurface p = surface_point(scene, rays.triangle(hit->triangle), hit->position);
            if (p.two_sided || glm::dot(p.normal, dir) < 0) {
                use(p);
                break;
            }
            gone += 1e-9 * scene.bounds.radius();
        }
    }
}

/// Counts points inside and outside a region, and expects that no outer one is shadowed.
class OutsidePoints {
public:
    int outside = 0, within = 0, shadowed = 0;

    OutsidePoints(const Scene& scene, const test::RayReference& rays, const LightView& view, const MapRegion& region)
        : scene_(scene), rays_(rays), view_(view), region_(region) {
        light_.type = view.curve.perspective ? LightType::Spot : LightType::Directional;
        light_.to_light = view.axes[2];
        light_.position = view.eye;
    }
    /// Counts a point and tests outer ones for shadow. @param every tests one inner point in so many for shadow
    void look_at(const OnSurface& p, int every) {
        const double facing = glm::dot(p.normal, test::direction_to(light_, p.position));
        if (p.two_sided ? std::abs(facing) < 1e-5 : facing < 1e-5) return;
        const glm::dvec3 v = glm::transpose(view_.axes) * (p.position - view_.eye);
        if (view_.curve.perspective && std::max(std::abs(v.x), std::abs(v.y)) > -v.z * view_.half_extent()) return;
        const glm::dvec2 at = glm::dvec2(v) / (view_.curve.perspective ? -v.z : 1.0);
        const double rim = 1e-6 * (view_.curve.perspective ? 1 : scene_.bounds.radius());
        const bool is_outside = at.x < region_.lo.x - rim || at.y < region_.lo.y - rim || at.x > region_.hi.x + rim ||
                                at.y > region_.hi.y + rim;
        (is_outside ? outside : within) += 1;
        if (!is_outside && within % every != 0) return;
        const double least = 1e-5 * scene_.bounds.radius();
        if (!rays_.occluded(p.position + std::copysign(least, facing) * p.normal, light_, -1, 0)) return;
        ++shadowed;
        EXPECT_FALSE(is_outside) << "at " << p.position.x << " " << p.position.y << " " << p.position.z;
    }

private:
    const Scene& scene_;
    const test::RayReference& rays_;
    LightView view_;
    MapRegion region_;
    FittedLight light_;
};

OutsidePoints expect_lit_outside(const Scene& scene, const LightView& view, const MapRegion& region, int points) {
    const test::RayReference rays(scene);
    OutsidePoints out(scene, rays, view, region);
    each_surface_point(scene, rays, points, [&](const OnSurface& p) { out.look_at(p, 16); });
    return out;
}

TEST(CastersFit, CoversAllShadowsOfBuiltInScenes) {
    int narrowed = 0;
    for (const BuiltinScene& row : builtin_scenes()) {
        const Scene scene = load_scene(std::string(row.key));
        const SceneShape shape = scene_shape(scene, {});
        const bool large = scene.triangle_count() > 30'000;
        std::vector<LightView> views;
        for (const auto& [azimuth, elevation] :
             {std::pair{72.0, 36.0}, {0.0, 90.0}, {90.0, 20.0}, {180.0, 45.0}, {-90.0, 0.0}, {40.0, -30.0}})
            views.push_back(sun(scene, azimuth, elevation));
        const double r = scene.bounds.radius();
        const glm::dvec3 middle = scene.bounds.centre();
        views.push_back(spot(middle + r * glm::dvec3(0.1, 1.2, 0.2), middle, 60));
        views.push_back(spot(middle + r * glm::dvec3(0.3, 0.15, -0.2), middle, 100));
        for (const LightView& view : views) {
            SCOPED_TRACE(testing::Message() << row.key << ", light along " << view.axes[2].x << " " << view.axes[2].y
                                            << " " << view.axes[2].z);
            const auto region = fit_casters({.scene = scene, .shape = shape, .view = view});
            if (!region) {
                EXPECT_EQ(row.key, "plane");
                continue;
            }
            const OutsidePoints n = expect_lit_outside(scene, view, *region, large ? 400 : 3000);
            narrowed += n.outside > 100 && n.shadowed > 0;
        }
    }
    EXPECT_GT(narrowed, 15) << "of all these some have to be narrower than the scene";
}

/// Random floors with a few boxes, cards and balls: of any size, some far from the origin, mirrored, rotated by right
/// angles.
struct RandomScene {
    Made made;
    double scale;
};

RandomScene random_scene(int i, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(-1, 1);
    const double scale = std::pow(10.0, 3 * unit(random));
    Made m(i % 3 == 0 ? scale * 1e3 * glm::dvec3(unit(random), unit(random), unit(random)) : glm::dvec3(0));
    const glm::dmat4 all = scaled(scale, scale, i % 4 == 0 ? -scale : scale) *
                           turned(i % 2 ? 90 * (i % 5) : 180 * unit(random), {0, 1, 0});
    m.add("Floor", make_plane(20, 20, 1 + i % 3, 1), all, i % 7 == 0);
    if (i % 5 == 0) m.add("Slab", make_box({22, 0.5, 22}), all * moved(0, -1, 0));
    for (int k = 0; k <= i % 6; ++k) {
        const glm::dmat4 place = all * moved(4 * unit(random), 1 + unit(random), 4 * unit(random)) *
                                 turned(180 * unit(random), glm::normalize(glm::dvec3(unit(random), 1, unit(random))));
        const double size = 0.3 + std::abs(unit(random));
        if (k % 3 == 0) m.add("Box", make_box({size, 1, 2 * size}), place, i % 2 == 0);
        if (k % 3 == 1) m.add("Card", make_quad(2 * size, size), place, i % 3 == 0);
        if (k % 3 == 2) m.add("Ball", make_sphere(size), place);
    }
    finalise(m.scene);
    return {std::move(m), scale};
}

/// Returns a sun, sometimes straight above, below or along an axis, and spot lights above the scene.
LightView random_light(int i, const RandomScene& s, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(-1, 1);
    const Scene& scene = s.made.scene;
    const double elevation = i % 6 == 0 ? 90 : i % 6 == 1 ? -60 : 10 + 70 * std::abs(unit(random));
    if (i % 4 != 3) return sun(scene, i % 2 ? 90.0 * (i % 4) : 180 * unit(random), elevation);
    const glm::dvec3 middle = scene.bounds.centre();
    return spot(middle + s.scale * glm::dvec3(6 * unit(random), 8, 6 * unit(random)), middle,
                40 + 40 * std::abs(unit(random)));
}

TEST(CastersFit, CoversAllShadowsOfRandomScenes) {
    std::mt19937 random(9);
    int outside = 0, shadowed = 0;
    for (int i = 0; i < 150; ++i) {
        SCOPED_TRACE(i);
        const RandomScene s = random_scene(i, random);
        const LightView view = random_light(i, s, random);
        const auto region = s.made.fit(fit_casters, view);
        if (!region) continue;
        const OutsidePoints n = expect_lit_outside(s.made.scene, view, *region, 400);
        outside += n.outside;
        shadowed += n.shadowed;
    }
    EXPECT_GT(outside, 5000);
    EXPECT_GT(shadowed, 300);
}

// Cameras at any place and direction: outside, inside the scene, behind the light, with a narrow angle, without
// perspective, cut off by planes. Lights include ones inside the scene that light only half of the visible part.
TEST(ViewFit, CoversAllVisibleShadowsOfRandomCameras) {
    std::mt19937 random(31);
    std::uniform_real_distribution<double> unit(-1, 1);
    int narrower = 0;
    std::array<int, 6> outside{}, shadowed{};
    for (int i = 0; i < 480; ++i) {
        SCOPED_TRACE(i);
        const RandomScene s = random_scene(i, random);
        const Scene& scene = s.made.scene;
        const double m = s.scale;
        const glm::dvec3 middle = scene.bounds.centre();
        const auto near_middle = [&](double metres) {
            return middle + m * metres * glm::dvec3(unit(random), 0.4 * unit(random), unit(random));
        };
        const LightView view = i % 8 == 5 ? spot(near_middle(4) + m * glm::dvec3(0, 1, 0), near_middle(5), 50 + i % 90)
                                          : random_light(i, s, random);
        const int kind = i / 3 % 6;
        glm::dvec3 eye = near_middle(9) + m * glm::dvec3(0, 6, 0), at = near_middle(4);
        if (kind == 1) eye = near_middle(4);
        if (kind == 2) eye = view.curve.perspective ? view.eye + 2 * m * view.axes[2] : middle + 15 * m * view.axes[2];
        Camera camera = camera_at(eye, at, kind == 3 ? 6 : 45, 1e-2 * m, 80 * m);
        camera.aspect = 1.6;
        if (kind == 4) {
            camera.orthographic = true;
            camera.height = 5 * m;
        }
        if (kind == 5) {
            camera.curve.near = 5 * m;
            camera.curve.far = 11 * m;
        }
        const auto region = s.made.fit(fit_view, view, {}, &camera);
        const auto all = s.made.fit(fit_casters, view);
        if (!region) continue;
        ASSERT_TRUE(all);
        EXPECT_TRUE(MapRegion({all->lo - 1e-6 * m, all->hi + 1e-6 * m}).contains(*region))
            << "at most what casters need";
        const double area = (region->hi.x - region->lo.x) * (region->hi.y - region->lo.y);
        narrower += area < 0.7 * (all->hi.x - all->lo.x) * (all->hi.y - all->lo.y);
        const test::RayReference rays(scene);
        OutsidePoints n(scene, rays, view, *region);
        each_visible_point(scene, rays, camera, 20, 13, [&](const OnSurface& p) { n.look_at(p, 1); });
        outside[std::size_t(kind)] += n.outside;
        shadowed[std::size_t(kind)] += n.shadowed;
    }
    for (std::size_t kind = 0; kind < 6; ++kind) {
        EXPECT_GT(outside[kind], 300) << kind;
        EXPECT_GT(shadowed[kind], 40) << kind;
    }
    EXPECT_GT(narrower, 100);
}

// Visible floor may reach behind a spot light above it: only the part in front of the light counts, out to the sides of
// its cone.
TEST(ViewFit, CountsOnlyPartsInFrontOfASpotLight) {
    for (const glm::dvec3 offset : {glm::dvec3(0), glm::dvec3(-3e4, 10, 8e3)}) {
        Made m(offset);
        m.add("Floor", make_plane(60, 60), glm::dmat4(1));
        m.add("Box", make_box({2, 1.9, 2}), moved(0, 0.95, -4));
        finalise(m.scene);
        Settings s;
        s.objects["Root/Box"] = {.receive = false};
        const LightView view = spot(offset + glm::dvec3(0, 2, 0), offset + glm::dvec3(0, 2, -10), 100);
        const Camera camera = camera_at(offset + glm::dvec3(0, 30, 0), offset, 60, 0.1, 100);
        // The box's own extent, but no higher than the farthest visible floor.
        const MapRegion expected{{-1.0 / 3, -2.0 / 3}, {1.0 / 3, -2 / (30 * std::tan(30 * kDegree))}};
        expect_bounds_near(m.fit(fit_view, view, s, &camera), expected, 1e-6);
    }
}

// A camera that sees nothing gets the map of the whole scene, without a promise; visible lit parts are promised.
TEST(ViewFit, HoldsTheSceneIfNothingIsVisible) {
    for (const glm::dvec3 offset : {glm::dvec3(0), glm::dvec3(5e4, -200, 3e3)}) {
        Made m = floor_and_box_at(offset);
        for (const LightView& view : {sun(m.scene, 90, 45), spot(offset + glm::dvec3(1, 9, 2), offset, 120)}) {
            const Camera away = camera_at(offset + glm::dvec3(0, 5, 12), offset + glm::dvec3(0, 9, 40), 50, 0.01, 100);
            EXPECT_FALSE(m.fit(fit_view, view, {}, &away));
            const Camera beside =
                camera_at(offset + glm::dvec3(-8, 6, -8), offset + glm::dvec3(-8, 0, -8.01), 20, 0.01, 100);
            EXPECT_FALSE(m.fit(fit_view, view, {}, &beside)) << "it sees lit floor only";
        }
        Settings s;
        s.lights[0].fit = LightFit::View;
        const Camera away = camera_at(offset + glm::dvec3(0, 5, 12), offset + glm::dvec3(0, 9, 40), 50, 0.01, 100);
        const FittedLight of_view = fit_lights(m.scene, s, &away)[0];
        EXPECT_FALSE(of_view.closed);
        s.lights[0].fit = LightFit::Scene;
        EXPECT_EQ(of_view.views[0].half_extent(), fit_lights(m.scene, s, &away)[0].views[0].half_extent());
    }
}

Mesh bounded(Mesh mesh) {
    mesh.bounds = {};
    for (const glm::vec3& p : mesh.positions) mesh.bounds.add(p);
    return mesh;
}

TEST(FlatMeshes, AreDetectedByGeometry) {
    EXPECT_TRUE(mesh_plane(bounded(make_plane(3, 4, 20, 20))));
    EXPECT_TRUE(mesh_plane(bounded(make_quad(3, 4))));
    EXPECT_FALSE(mesh_plane(bounded(make_box({1, 1, 1}))));
    EXPECT_FALSE(mesh_plane(bounded(make_sphere(1))));
    // A dent of a thousandth of its size is not flat.
    Mesh dented = make_plane(2, 2, 8, 8);
    dented.positions.edit()[40].y += 2e-3f;
    EXPECT_FALSE(mesh_plane(bounded(dented)));
    EXPECT_TRUE(is_convex(bounded(make_box({1, 2, 3}))));
    EXPECT_FALSE(is_convex(bounded(make_torus(1, 0.2))));
    Mesh inside_out = bounded(make_box({1, 2, 3}));
    for (std::size_t i = 0; i < inside_out.indices.size(); i += 3)
        std::swap(inside_out.indices.edit()[i], inside_out.indices.edit()[i + 1]);
    EXPECT_FALSE(is_convex(inside_out));
}

}  // namespace
}  // namespace si
