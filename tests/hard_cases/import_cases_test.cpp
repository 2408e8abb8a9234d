// Tests hard cases 39 to 41: quantised positions, a stray vertex, other units.
#include <cmath>

#include "renderer/measure/measured_error.h"
#include "renderer/scene/main_part.h"
#include "renderer/scenes/shapes.h"
#include "tests/support/hard_view.h"
#include "tests/support/placements.h"
#include "tests/support/stability.h"

namespace si::test {
namespace {

/// Returns the share of pixels with acne.
double acne_share(const DrawnCase& c) {
    ReferenceCache cache;
    return measure_error(hard_renderer(), c.scene, c.settings, {.width = 320, .height = 240}, 0, {}, cache)
        .metrics.acne;
}

/// Returns a case's scene without one node's object.
Scene without_node(Scene scene, std::string_view name) {
    std::erase_if(scene.objects, [&](const Object& o) { return scene.nodes[std::size_t(o.node)].name == name; });
    finalise(scene);
    set_main_part(scene);
    return scene;
}

TEST(HardCase39, QuantisedFacetsDoNotShadowThemselves) {
    expect_within_limit(39, acne_share(hard_view("quantised", true)));
    DrawnCase exact = hard_view("quantised", false);
    for (Mesh& mesh : exact.scene.meshes)
        if (mesh.name == "Hill")
            for (glm::vec3& p : mesh.positions.edit()) p.y = 0.25f * std::exp(-0.25f * (p.x * p.x + p.z * p.z));
    finalise(exact.scene);
    expect_fault(39, acne_share(hard_view("quantised", false)) - acne_share(exact));
}

TEST(HardCase40, AStrayVertexCostsNoShadow) {
    const DrawnCase fixed = hard_view("stray-vertex", true);
    EXPECT_EQ(far_objects_text(fixed.scene), "node 'Case/Stray' reaches 1.05e+06 m from the rest");
    const Shot clean = draw_shot(without_node(fixed.scene, "Stray"), fixed.settings);
    EXPECT_GT(shadow_share(clean), 0.01);
    expect_within_limit(40, differing_share(clean, draw_shot(fixed)));
    expect_fault(40, differing_share(clean, draw_shot(hard_view("stray-vertex", false))));
}

TEST(HardCase41, UnitsLookTheSameUnderABiasInTexels) {
    for (const bool fixed : {true, false}) {
        const DrawnCase drawn = hard_view("units", fixed);
        const auto in_units = [&](double scale) {
            DrawnCase c = drawn;
            place_scene(c.scene, scaled(scale, scale, scale));
            return draw_shot(c);
        };
        const Shot one = in_units(1024);
        for (const double scale : {1.0, 1024.0 * 1024}) {
            const double differing = differing_share(one, in_units(scale));
            if (fixed)
                expect_within_limit(41, differing);
            else
                expect_fault(41, differing);
        }
    }
}

}  // namespace
}  // namespace si::test
