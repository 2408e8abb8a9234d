// Tests hard cases 10, 11, 14, 15 and 16: distant, tiny, huge, stretched, mirrored and flattened scenes.
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>

#include "renderer/base/index_of.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/overlays.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"
#include "tests/support/stability.h"

namespace si::test {
namespace {

/// Returns floor_and_box() below a node that moves, turns, scales or mirrors both.
Scene placed_scene(const glm::dmat4& placed) {
    Scene scene;
    const int root = add_node(scene, "root", -1, placed);
    add_object(scene, "floor", root, add_mesh(scene, "floor", make_plane(10, 10), -1));
    add_object(scene, "box", root, add_mesh(scene, "box", make_box({1.5, 1, 2}), -1), moved(0.3, 0.5, 0.2));
    add_object(scene, "ball", root, add_mesh(scene, "ball", make_sphere(0.6, 24, 12), -1), moved(-2, 1.4, 1));
    finalise(scene);
    return scene;
}

Settings seen_from(Settings s, const glm::dvec3& target, double scale = 1) {
    set_target(s.camera, target);
    s.camera.distance *= scale;
    return s;
}

// Case 10: a million metres from the origin.
TEST(HardCase10, ScenesFarFromTheOriginLookTheSame) {
    for (LightType type : kLightTypes) {
        Settings s = hard_settings();
        s.lights[0].type = type;
        const Shot here = draw_shot(placed_scene(glm::dmat4(1)), seen_from(s, {0, 0.5, 0}));
        EXPECT_GT(shadow_share(here), 0.01);
        for (double offset : {1e4, 1e6}) {
            const glm::dvec3 at(offset, -0.5 * offset, offset);
            const Shot there =
                draw_shot(placed_scene(moved(at.x, at.y, at.z)), seen_from(s, at + glm::dvec3(0, 0.5, 0)));
            expect_within_limit(10, differing_share(here, there));
        }
    }
}

TEST(HardCase10Vacuity, AbsoluteFloatMatricesAreTexelsOff) {
    const glm::dvec3 at(1e6, -5e5, 1e6);
    const Shot there = draw_shot(placed_scene(moved(at.x, at.y, at.z)), seen_from(hard_settings(), at));
    const LightView& view = there.view();
    const glm::mat4 absolute(view.clip_from_relative(glm::dvec3(0)));
    double worst_texels = 0;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 p = at + glm::dvec3(0.037 * i, 0, 0.021 * i);
        const glm::dvec4 exact = view.clip_from_relative(p)[3];
        const glm::vec4 naive = absolute * glm::vec4(glm::vec3(p), 1);
        worst_texels = std::max(worst_texels, std::abs(naive.x - exact.x) * 0.5 * there.frame.map_resolution);
    }
    expect_fault(10, worst_texels);
}

// Case 11: biases and epsilons without a unit fail away from a scale of 1.
TEST(HardCase11, EveryScaleLooksTheSame) {
    for (LightType type : kLightTypes) {
        Settings s = hard_settings();
        s.lights[0].type = type;
        const Shot one = draw_shot(placed_scene(glm::dmat4(1)), seen_from(s, {0, 0.5, 0}));
        for (double scale : {1e-3, 1e-1, 1e3, 1e6}) {
            const Shot other = draw_shot(placed_scene(scaled(scale, scale, scale)),
                                         seen_from(s, glm::dvec3(0, 0.5, 0) * scale, scale));
            expect_within_limit(11, differing_share(one, other));
        }
    }
    // A bias in metres does depend on the scale: the comparison can fail.
    Settings s = hard_settings();
    s.bias = no_bias();
    set_all(s, {"bias.unit=metres", "bias.constant=0.05"});
    const Shot one = draw_shot(placed_scene(glm::dmat4(1)), seen_from(s, {0, 0.5, 0}));
    const Shot other = draw_shot(placed_scene(scaled(1e-2, 1e-2, 1e-2)), seen_from(s, {0, 0.005, 0}, 1e-2));
    expect_fault(11, differing_share(one, other));
}

// Case 14: normals under a non-uniform scale.
TEST(HardCase14, NormalsArePerpendicularToStretchedFaces) {
    Scene scene;
    const int root = add_node(scene, "root", -1, scaled(4, 0.5, 1));
    const glm::dmat4 turn = turned(30) * turned(25, {1, 0, 0});
    add_object(scene, "box", root, add_mesh(scene, "box", make_box({1, 1, 1}), -1), turn);
    finalise(scene);
    Settings s = settings_with(hard_settings(), {"camera.target_y=0", "camera.distance=6"});
    for (std::size_t i = 0; i < overlays().size(); ++i)
        if (overlays()[i].key == "normals") s.view.overlay = int(i) + 1;
    FrameRequest request;
    request.width = 160;
    request.height = 120;
    request.outputs = {.colour = false, .shadow_map = false, .visibility = false, .overlay = true};
    Renderer& renderer = hard_renderer();
    const FrameResult frame = renderer.render(scene, s, request);
    const FloatImage image = renderer.read_float(frame.overlay, 4);
    const RayReference rays(scene);
    double worst = 0, naive_worst = 0;
    int seen = 0;
    for (const auto& [x, y, hit] : pixel_hits(rays, frame.camera, image.width, image.height)) {
        if (image.at(x, y, 3) == 0) continue;
        const glm::dvec3 n = 2.0 * glm::dvec3(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)) - 1.0;
        const auto degrees = [](const glm::dvec3& a, const glm::dvec3& b) {
            return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / M_PI;
        };
        worst = std::max(worst, degrees(n, hit.normal));
        // A normal transformed like a point would give this, computed back from the right normal.
        const glm::dmat3 m(scene.objects[0].world);
        const glm::dvec3 local = glm::transpose(m) * hit.normal;
        naive_worst = std::max(naive_worst, degrees(m * local, hit.normal));
        ++seen;
    }
    EXPECT_GT(seen, 1000);
    expect_within_limit(14, worst);
    expect_fault(14, naive_worst);
    EXPECT_TRUE(renderer.take_gl_messages().empty());
}

// Case 15: a mirrored scene under a mirrored light and camera is the mirrored picture, with culling too.
TEST(HardCase15, MirroredScenesGiveMirroredPictures) {
    const auto make = [](const glm::dmat4& placed) {
        Scene scene = placed_scene(placed);
        // A single-sided plate that faces up: culling its back or front decides whether it casts.
        const int plate = add_mesh(scene, "plate", make_plane(3, 2), -1);
        add_object(scene, "plate", 0, plate, moved(2, 2, -1.5));
        finalise(scene);
        return scene;
    };
    const Scene straight = make(glm::dmat4(1)), mirrored = make(scaled(-1, 1, 1));
    Shot culled[3];
    for (Cull cull : {Cull::None, Cull::Back, Cull::Front}) {
        Settings s = hard_settings();
        s.caster.cull = cull;
        Shot a = draw_shot(straight, s, 161, 120);
        Settings t = s;
        t.camera.azimuth = -s.camera.azimuth;
        t.lights[0].azimuth = -s.lights[0].azimuth;
        const Shot b = draw_shot(mirrored, t, 161, 120);
        const Shot flipped = [&] {
            Shot f = b;
            for (int y = 0; y < b.height; ++y)
                for (int x = 0; x < b.width; ++x)
                    f.visibility.data[std::size_t(y * b.width + x)] = b.visibility.at(b.width - 1 - x, y);
            return f;
        }();
        // The mirrored light's map has other axes, so filtered edges differ; the half-lit contour may not.
        expect_within_limit(15, differing_share(a, flipped, 0.5));
        culled[index_of(cull)] = std::move(a);
    }
    expect_fault(15, differing_share(culled[index_of(Cull::Back)], culled[index_of(Cull::Front)], 0.5));
}

// Case 16: objects whose scale is 0 along one or all axes have no inverse.
TEST(HardCase16, SingularScalesGiveFinitePictures) {
    const Scene plain = placed_scene(glm::dmat4(1));
    const Shot without = draw_shot(plain, hard_settings());
    Scene scene = placed_scene(glm::dmat4(1));
    add_object(scene, "gone", 0, 1, moved(0.3, 0.5, 0.2) * scaled(0, 0, 0));
    finalise(scene);
    expect_within_limit(16, differing_share(without, draw_shot(scene, hard_settings()), 0));
    for (const glm::dvec3& flat : {glm::dvec3(1, 0, 1), glm::dvec3(0, 1, 1), glm::dvec3(0, 0, 1)})
        for (LightType type : kLightTypes) {
            Scene flattened = placed_scene(glm::dmat4(1));
            add_object(flattened, "flat", 0, 1, moved(2, 1, 1) * scaled(flat.x, flat.y, flat.z));
            finalise(flattened);
            Settings s = hard_settings();
            s.lights[0].type = type;
            const Shot shot = draw_shot(flattened, s);
            if (flat == glm::dvec3(1, 0, 1) && type == LightType::Directional) {
                expect_fault(16, differing_share(without, shot, 0.5));
            }
        }
}

}  // namespace
}  // namespace si::test
