// Compares the shadow of a box on a plane with its known outline.
#include <cmath>

#include "renderer/settings/filters.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"

namespace si::test {
namespace {

struct OutlineCase {
    const char* name;
    LightType type;
    const char* filter;
    int resolution;
};

class BoxShadow : public testing::TestWithParam<OutlineCase> {};

TEST_P(BoxShadow, EdgesLieWithinATexel) {
    const OutlineCase& c = GetParam();
    const glm::dvec3 box(1.5, 1, 2);
    const double gap = 0.4;
    const glm::dvec3 lo(-0.5 * box.x, gap, -0.5 * box.z), hi(0.5 * box.x, gap + box.y, 0.5 * box.z);
    const Scene scene = floor_and_box(10, box, gap);
    Settings s = hard_settings();
    s.lights[0].type = c.type;
    set_all(s, {"light.distance=9", "light.cone=80"});
    s.map.resolution = c.resolution;
    set_setting(s, "filter.kernel", c.filter);
    // The kernel's need on the floor is added along the light only, so that the outline does not move.
    s.bias = no_bias();
    s.bias.unit = BiasUnit::Texels;
    s.bias.constant = 4 * reach_of(s).bias;
    const Shot shot = draw_shot(scene, s, 320, 240);
    const FittedLight& light = shot.light();
    const RayReference rays(scene);
    const auto in_shadow = [&](const glm::dvec3& p) {
        const bool directional = light.type == LightType::Directional;
        return meets_box(p, directional ? light.to_light : light.position - p, directional ? 1e9 : 1, lo, hi);
    };
    int inside = 0, outside = 0, edge = 0, wrong = 0;
    for (const auto& [x, y, hit] : pixel_hits(rays, shot)) {
        if (hit.normal.y < 0.5 || hit.position.y > 1e-6) continue;
        const LightView& view = view_of(light, hit.position);
        const glm::dvec4 p = uvdw(view, hit.position);
        // Outside a map that holds all shadows the floor is lit.
        if (!light.closed && (p.x < 0 || p.x > 1 || p.y < 0 || p.y > 1)) continue;
        // One texel to each side on the floor, along the map's axes.
        const double z = glm::dot(view.eye - hit.position, view.axes[2]);
        const double texel = view.texel_size(z, shot.frame.map_resolution);
        const bool dark = in_shadow(hit.position);
        bool near_edge = false;
        for (int i = -4; i <= 4; ++i)
            for (int j = -4; j <= 4; ++j) {
                glm::dvec3 q = hit.position + texel * 0.25 * (double(i) * view.axes[0] + double(j) * view.axes[1]);
                const glm::dvec3 ray = view.curve.perspective ? q - view.eye : -view.axes[2];
                q -= ray * (q.y / ray.y);  // back onto the floor, along the light
                near_edge = near_edge || in_shadow(q) != dark;
            }
        if (near_edge) {
            ++edge;
            continue;
        }
        ++(dark ? inside : outside);
        wrong += (shot.visibility.at(x, y) < 0.5f) != dark;
    }
    EXPECT_GT(inside, 500) << "the box must cast";
    EXPECT_GT(outside, 5000);
    EXPECT_GT(edge, 20);
    EXPECT_LT(edge, inside + outside) << "most pixels must be compared";
    EXPECT_EQ(wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(All, BoxShadow,
                         testing::Values(OutlineCase{"directional_hard", LightType::Directional, "hard", 256},
                                         OutlineCase{"directional_pcf3", LightType::Directional, "pcf3", 256},
                                         OutlineCase{"directional_fine", LightType::Directional, "hw2x2", 1024},
                                         OutlineCase{"spot_hard", LightType::Spot, "hard", 256},
                                         OutlineCase{"spot_pcf3", LightType::Spot, "pcf3", 256},
                                         OutlineCase{"point_hard", LightType::Point, "hard", 512}),
                         [](const auto& named) { return std::string(named.param.name); });

// The seams between a point light's faces show no errors.
TEST(PointLight, SeamsShowNoError) {
    const Scene scene = floor_and_box(10, {4.4, 0.2, 4.4}, 1.2);
    for (const char* filter : {"hard", "pcf5"}) {
        // The map's faces meet on the floor, in the shadow.
        Settings s = settings_with(hard_settings(), {"light.type=point",
                                                     "light.elevation=90",
                                                     "light.distance=2.5",
                                                     "camera.elevation=35",
                                                     {"filter.kernel", filter}});
        s.bias = no_bias();
        s.bias.unit = BiasUnit::Texels;
        // Near a face's rim the floor is tilted by 45 to 60 degrees against the face's axis.
        s.bias.constant = 4 * reach_of(s).bias;
        const ReferenceErrors e = compare_with_reference(draw_shot(scene, s), scene, reach_of(s).edge + 1);
        EXPECT_GT(e.shadow, 200) << filter;
        EXPECT_EQ(e.false_shadow, 0) << filter;
        EXPECT_EQ(e.any_acne, 0) << filter;
        EXPECT_EQ(e.any_leak, 0) << filter;
    }
}

}  // namespace
}  // namespace si::test
