// Compares the ray-traced reference with closed forms in double (a plane, a box and a ball) wherever a scene stands.
// Also compares scenes with distant vertices with the same numbers placed by a node.
#include <cmath>

#include "renderer/measure/measured_error.h"
#include "renderer/scenes/shapes.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/placements.h"
#include "tests/support/sets.h"

namespace si::test {
namespace {

/// Sizes of the unmoved bodies, and the tolerance for facets and rounding.
struct Solids {
    double floor = 5;  ///< half its side, at y = 0
    glm::dvec3 box_lo{-0.75, 0.5, -1}, box_hi{0.75, 1.5, 1};
    glm::dvec3 ball_at{-2.25, 1.5, 1};
    double ball = 0.75;
};

Scene solid_scene() {
    const Solids s;
    const glm::dvec3 middle = 0.5 * (s.box_lo + s.box_hi);
    Scene scene = grey_scene({{"floor", make_plane(2 * s.floor, 2 * s.floor)},
                              {"box", make_box(s.box_hi - s.box_lo), moved(middle.x, middle.y, middle.z)},
                              {"ball", make_sphere(s.ball, 192, 96), moved(s.ball_at.x, s.ball_at.y, s.ball_at.z)}});
    add_camera(scene, {-2.5, 7, 6.5}, {-0.5, 0.5, 0}, 45);
    finalise(scene);
    return scene;
}

enum class Body { None, Floor, Box, Ball };

/// Returns the distance at which a ray enters; infinite for a miss.
double meets_floor(const Solids& s, const glm::dvec3& p, const glm::dvec3& d) {
    if (d.y == 0) return INFINITY;
    const double t = -p.y / d.y;
    const glm::dvec3 at = p + t * d;
    return t > 0 && std::max(std::abs(at.x), std::abs(at.z)) <= s.floor ? t : INFINITY;
}

double enters_box(const Solids& s, const glm::dvec3& p, const glm::dvec3& d) {
    double from = 0, to = INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
        if (d[axis] == 0) {
            if (p[axis] < s.box_lo[axis] || p[axis] > s.box_hi[axis]) return INFINITY;
            continue;
        }
        double a = (s.box_lo[axis] - p[axis]) / d[axis], b = (s.box_hi[axis] - p[axis]) / d[axis];
        if (a > b) std::swap(a, b);
        from = std::max(from, a);
        to = std::min(to, b);
    }
    return from <= to && to > 0 ? from : INFINITY;
}

double enters_ball(const Solids& s, const glm::dvec3& p, const glm::dvec3& d) {
    const glm::dvec3 o = p - s.ball_at;
    const double b = glm::dot(o, d), c = glm::dot(o, o) - s.ball * s.ball, under = b * b - c * glm::dot(d, d);
    if (under < 0) return INFINITY;
    const double far = (-b + std::sqrt(under)) / glm::dot(d, d);
    return far <= 0 ? INFINITY : std::max(0.0, (-b - std::sqrt(under)) / glm::dot(d, d));
}

struct CameraHit {
    Body body = Body::None;
    bool lit = false;
    bool operator==(const CameraHit&) const = default;
};

/// Returns the hit of a camera ray, and whether a body blocks the light there.
/// @param light direction towards it, or (by_place) its position
/// @param facing cosine between the surface's normal and the light
CameraHit first_hit(const Solids& s, const glm::dvec3& p, const glm::dvec3& d, const glm::dvec3& light, bool by_place,
                    double* facing) {
    const double floor = meets_floor(s, p, d), box = enters_box(s, p, d), ball = enters_ball(s, p, d);
    const double t = std::min({floor, box, ball});
    if (!std::isfinite(t)) return {};
    const Body body = t == floor ? Body::Floor : t == box ? Body::Box : Body::Ball;
    const glm::dvec3 at = p + t * d, to_light = by_place ? light - at : light;
    glm::dvec3 n(0, 1, 0);
    if (body == Body::Ball) n = glm::normalize(at - s.ball_at);
    if (body == Body::Box) {
        double nearest = INFINITY;
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {-1.0, 1.0}) {
                const double off = std::abs(at[axis] - (side < 0 ? s.box_lo : s.box_hi)[axis]);
                if (off < nearest) {
                    nearest = off;
                    n = glm::dvec3(0);
                    n[axis] = side;
                }
            }
    }
    *facing = glm::dot(n, glm::normalize(to_light));
    // The body is convex: it does not block its own faces that are turned to the light.
    const double most = by_place ? 1 : INFINITY;
    const bool covered = (body != Body::Box && enters_box(s, at, to_light) < most) ||
                         (body != Body::Ball && enters_ball(s, at, to_light) < most) ||
                         (body != Body::Floor && meets_floor(s, at, to_light) < most);
    return {body, !covered};
}

/// Returns all sizes within the tolerance: a pixel with equal answers for all of them is certain.
std::vector<Solids> variants() {
    std::vector<Solids> out(3);
    const double rounding = 2e-4, facets = 1.5e-3;
    out[1].box_lo -= rounding;
    out[1].box_hi += rounding;
    out[1].ball += rounding;
    out[1].floor += rounding;
    out[2].box_lo += rounding;
    out[2].box_hi -= rounding;
    out[2].ball -= facets;
    out[2].floor -= rounding;
    return out;
}

class HardCase36Everywhere : public testing::TestWithParam<LightType> {};

TEST_P(HardCase36Everywhere, TheReferenceEqualsTheClosedForm) {
    const LightType type = GetParam();
    std::vector<Placement> placements = single_factor_placements();
    placements.push_back({});
    for (std::size_t light = 1; light < light_directions().size(); ++light)
        placements.push_back({.distance = 4, .scale = 1 + light % (scales().size() - 1), .light = light});
    placements.push_back({.distance = 3, .scale = 3, .light = 4, .mirrored = true});
    std::size_t classified = 0, dark = 0, parallel = 0;
    for (const Placement& placement : placements) {
        SCOPED_TRACE(placement.name());
        Scene scene = solid_scene();
        place_scene(scene, placement.matrix());
        Settings s;
        s.map.resolution = 64;
        s.lights[0].type = type;
        set_all(s, {"light.azimuth=30", "light.elevation=40"});
        if (type == LightType::Point) s.lights[0].distance = 6;
        ASSERT_TRUE(place_settings(s, placement) || placement.scale == 4);
        ReferenceCache cache;
        const int width = 96, height = 72;
        const MeasuredError e =
            measure_error(hard_renderer(), scene, s, {.width = width, .height = height}, 0, {}, cache);
        const glm::dvec3 origin = distances()[placement.distance].offset;
        const double factor = scales()[placement.scale].factor;
        const auto home = [&](glm::dvec3 v) {  // directions, without the shift
            if (placement.mirrored) v.x = -v.x;
            return v / factor;
        };
        const bool by_place = type != LightType::Directional;
        const glm::dvec3 light = by_place ? home(e.lights[0].position - origin) : factor * home(e.lights[0].to_light);
        std::size_t otherwise = 0;
        for (const auto& [x, y, from, along] : pixel_rays(e.camera, width, height)) {
            const auto i = std::size_t(y * width + x);
            std::vector<CameraHit> answers;
            double facing = 0;
            for (const Solids& solids : variants())
                answers.push_back(
                    first_hit(solids, home(from - origin), factor * home(along), light, by_place, &facing));
            const CameraHit& seen = answers[0];
            if (answers[1] != seen || answers[2] != seen || seen.body == Body::None) continue;
            const PixelState state = e.traced.reference->state[i];
            if (std::abs(facing) < 1e-12) {
                ++parallel;
                otherwise += state != PixelState::FacesAway;
            }
            // Facets lean: the ball's pixels near its terminator are left out.
            if (std::abs(facing) < (seen.body == Body::Ball ? 0.1 : 1e-6)) continue;
            ++classified;
            if (facing < 0) {
                otherwise += state != PixelState::FacesAway;
                continue;
            }
            dark += !seen.lit;
            otherwise += state != PixelState::Counted || (e.traced.reference->hard().data[i] > 0.5f) != seen.lit;
        }
        EXPECT_EQ(otherwise, 0u);
    }
    EXPECT_GT(classified, 100'000u);
    EXPECT_GT(dark, 3'000u);
    if (type == LightType::Directional) {
        EXPECT_GT(parallel, 10'000u);
    }
}

INSTANTIATE_TEST_SUITE_P(All, HardCase36Everywhere, testing::Values(LightType::Directional, LightType::Point),
                         [](const auto& named) {
                             return std::string(named.param == LightType::Point ? "point" : "directional");
                         });

// Baking rounds distant vertices. The same rounded numbers without the shift, below a node that adds the shift, are
// the same geometry as the baked scene.
TEST(HardCase10Baked, DistantVerticesAreComparedAsRounded) {
    for (const glm::dvec3& at : {glm::dvec3(70.3, -13.7, 70.1),
                                 {-7071.3, 130.7, 7071.1},
                                 {70710.3, -1300.7, -70710.1},
                                 {707106.3, -1300.7, -707108.1},
                                 {7071066.3, -13007.7, -7071068.1}}) {
        SCOPED_TRACE(at.x);
        Scene baked = solid_scene(), placed = solid_scene();
        const glm::dvec3 whole = glm::round(at / 1024.0) * 1024.0;
        for (Scene* scene : {&baked, &placed}) {
            for (const Object& object : scene->objects) {
                const glm::dmat4 world = scene->nodes[std::size_t(object.node)].world;
                Mesh& mesh = scene->meshes[std::size_t(object.mesh)];
                mesh.normals.clear();
                for (glm::vec3& p : mesh.positions.edit()) {
                    const glm::vec3 far = glm::vec3(glm::dvec3(world * glm::dvec4(p, 1)) + at);
                    p = scene == &baked ? far : glm::vec3(glm::dvec3(far) - whole);
                }
            }
            for (Node& node : scene->nodes)
                node.local = scene == &baked ? glm::dmat4(1) : moved(whole.x, whole.y, whole.z);
            scene->cameras[0].world[3] += glm::dvec4(at, 0);
            finalise(*scene);
        }
        ASSERT_EQ(baked.bounds.lo, placed.bounds.lo);
        for (LightType type : {LightType::Directional, LightType::Spot}) {
            Settings s;
            s.map.resolution = 256;
            s.lights[0].type = type;
            set_all(s, {"light.azimuth=30", "light.elevation=40"});
            const Shot a = draw_shot(baked, s), b = draw_shot(placed, s);
            EXPECT_GT(shadow_share(a), 0.02);
            EXPECT_LE(differing_share(a, b), 5e-4) << int(type);
        }
    }
}

}  // namespace
}  // namespace si::test
