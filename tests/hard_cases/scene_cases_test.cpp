// Tests hard cases 13, 17, 18 and 34: degenerate triangles, empty scenes, flat bounds, large indices.
#include <algorithm>
#include <cmath>

#include "renderer/scenes/shapes.h"
#include "renderer/settings/param.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/mesh_scene.h"
#include "tests/support/sets.h"
#include "tests/support/stability.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

const PassInfo* shadow_pass(const FrameResult& frame) {
    const auto it = std::find_if(frame.passes.begin(), frame.passes.end(),
                                 [](const PassInfo& p) { return p.name.rfind("shadow map", 0) == 0; });
    return it == frame.passes.end() ? nullptr : &*it;
}

// Case 13: triangles without area rasterise to depths out of range on some drivers.
TEST(HardCase13, DegenerateTrianglesChangeNothing) {
    Scene clean, dirty;
    int without_normal = 0;  // triangles whose plane and slope would be 0/0
    for (Scene* scene : {&clean, &dirty}) {
        Mesh box = make_box({1.5, 1, 2});
        if (scene == &dirty) {
            const auto a = std::uint32_t(box.positions.size());
            // A point, a line twice over, and a line of three points, far outside of the box among others.
            const glm::vec3 extra[] = {{0, 0, 0}, {0.5f, 0.4f, 0.7f}, {-0.7f, 0.3f, 0.9f}, {0.25f, 0.2f, 0.35f}};
            for (const glm::vec3& p : extra) {
                box.positions.push_back(p);
                if (!box.normals.empty()) box.normals.push_back({0, 1, 0});
                if (!box.uv.empty()) box.uv.push_back({0, 0});
            }
            for (std::uint32_t i : {0u, 0u, 0u, 1u, 1u, 2u, 2u, 1u, 2u, 0u, 3u, 1u}) box.indices.push_back(a + i);
            for (std::size_t i = 0; i < box.indices.size(); i += 3) {
                const glm::vec3 p = box.positions[box.indices[i]];
                const glm::vec3 normal = glm::normalize(
                    glm::cross(box.positions[box.indices[i + 1]] - p, box.positions[box.indices[i + 2]] - p));
                without_normal += !(glm::length(normal) > 0);
            }
        }
        add_object(*scene, "floor", -1, add_mesh(*scene, "floor", make_plane(10, 10), -1));
        add_object(*scene, "box", -1, add_mesh(*scene, "box", box, -1), moved(0, 0.5, 0));
        finalise(*scene);
    }
    EXPECT_EQ(dirty.dropped_triangles, 4u);
    EXPECT_EQ(without_normal, 4);
    expect_fault(13, without_normal);
    EXPECT_FALSE(dirty.warnings.empty());
    EXPECT_EQ(clean.dropped_triangles, 0u);
    for (LightType type : kLightTypes) {
        Settings s = hard_settings();
        s.lights[0].type = type;
        const Shot a = draw_shot(clean, s), b = draw_shot(dirty, s);
        expect_within_limit(13, differing_share(a, b, 0) * double(a.visibility.data.size()));
        EXPECT_EQ(a.maps.at(0).data, b.maps.at(0).data);
    }
}

// Slivers with an area stay in the scene and must do no harm.
TEST(HardCase13, SliversGiveFinitePictures) {
    Scene scene = floor_and_box();
    Mesh slivers;
    for (int i = 0; i < 50; ++i) {
        const float x = -2 + 0.08f * float(i), thin = std::ldexp(1.0f, -10 - i % 20);
        const auto a = std::uint32_t(slivers.positions.size());
        slivers.positions.append({{x, 0.1f, -3}, {x + thin, 2, 3}, {x + 0.5f * thin, 0.1f, 3}});
        slivers.indices.append({a, a + 1, a + 2});
    }
    add_object(scene, "slivers", -1, add_mesh(scene, "slivers", slivers, -1));
    finalise(scene);
    for (LightType type : kLightTypes) {
        Settings s = hard_settings();
        s.lights[0].type = type;
        draw_shot(scene, s);
    }
}

// Case 17: without casters, receivers or objects no shadow pass runs and everything is lit.
void expect_no_shadow(const Scene& scene, const Settings& s, const char* what) {
    SCOPED_TRACE(what);
    const Shot shot = draw_shot(scene, s);
    for (float v : shot.visibility.data) ASSERT_EQ(v, 1);
    const PassInfo* pass = shadow_pass(shot.frame);
    ASSERT_NE(pass, nullptr) << "the plan must say why there is no shadow pass";
    EXPECT_EQ(pass->state, PassState::Skipped);
    expect_within_limit(17, double(pass->draws));
    EXPECT_FALSE(pass->reason.empty());
}

TEST(HardCase17, EmptyScenesAreDrawn) {
    const Scene scene = floor_and_box();
    Settings s = hard_settings();
    const Shot with = draw_shot(scene, s);
    EXPECT_GT(shadow_share(with), 0.01);
    ASSERT_NE(shadow_pass(with.frame), nullptr);
    expect_fault(17, double(shadow_pass(with.frame)->draws));

    s.lights[0].cast = false;
    expect_no_shadow(scene, s, "light.cast off");
    s = hard_settings();
    s.light_count = 0;
    expect_no_shadow(scene, s, "no lights");
    s = hard_settings();
    s.objects["floor"].cast = s.objects["box"].cast = false;
    expect_no_shadow(scene, s, "no object casts");
    s = hard_settings();
    s.objects["floor"].receive = s.objects["box"].receive = false;
    expect_no_shadow(scene, s, "no object receives");
    Scene empty;
    finalise(empty);
    for (LightType type : kLightTypes) {
        s = hard_settings();
        s.lights[0].type = type;
        expect_no_shadow(empty, s, "empty scene");
    }
}

// Case 18: a plane straight under the light has a depth range of zero.
SI_TEST_IS(Later, HardCase18, BoundsWithoutThicknessGiveFiniteFits);
TEST(HardCase18, BoundsWithoutThicknessGiveFiniteFits) {
    const Scene scene = make_scene(make_plane(10, 10));
    const double bare_range = scene.bounds.hi.y - scene.bounds.lo.y;  // range of a fit without a minimum
    expect_fault(18, std::isinf(1 / bare_range));
    for (LightType type : kLightTypes)
        for (bool reversed : {false, true}) {
            Settings s = hard_settings();
            s.lights[0].type = type;
            s.lights[0].elevation = 90;
            s.map.reversed_z = reversed;
            const Shot shot = draw_shot(scene, s);
            const LightView& view = shot.view();
            // Two texels at the plane; at the far end of the range they are a little larger.
            EXPECT_GE(view.curve.far - view.curve.near, 2 * view.texel_size(view.curve.near, 512));
            expect_within_limit(18, compare_with_reference(shot, scene, 0).any_acne);
            // Edge-on: the plane is a line in the map.
            s.lights[0].elevation = 0;
            draw_shot(scene, s);
        }
    // The flat scene still casts and receives.
    const Scene two = grey_scene({{"floor", make_plane(10, 10)}, {"plate", make_plane(2, 2), moved(0, 1e-2, 0)}});
    Settings s = hard_settings();
    s.map.resolution = 4096;
    s.bias = no_bias();
    set_all(s, {"bias.constant=1e-3", "filter.kernel=hard"});
    const ReferenceErrors e = compare_with_reference(draw_shot(two, s), two, 1);
    EXPECT_EQ(e.false_light, 0);
    EXPECT_EQ(e.false_shadow, 0);
}

// Case 34: more than 65535 vertices, and index 65535, which 16-bit indices read as "restart".
TEST(HardCase34, LargeIndicesAreDrawn) {
    const auto scene_with = [](const Mesh& plate) {
        return grey_scene({{"floor", make_plane(10, 10)}, {"plate", plate, moved(0, 1.5, 0)}});
    };
    const Mesh many = make_plane(4, 3, 300, 300);
    Mesh wrapped = many;
    for (std::uint32_t& i : wrapped.indices.edit()) i &= 0xffff;
    const Scene fine = scene_with(many), coarse = scene_with(make_plane(4, 3, 1, 1));
    const Mesh& mesh = fine.meshes[1];
    ASSERT_GT(mesh.positions.size(), 65536u);
    EXPECT_TRUE(std::find(mesh.indices.begin(), mesh.indices.end(), 65535u) != mesh.indices.end());
    Settings s = hard_settings();
    const Shot a = draw_shot(fine, s), b = draw_shot(coarse, s);
    EXPECT_GT(shadow_share(a), 0.01);
    expect_within_limit(34, differing_share(a, b));
    expect_fault(34, differing_share(draw_shot(scene_with(wrapped), s), b));
}

}  // namespace
}  // namespace si::test
