// Tests of texels drawn as slabs, compared with the light's own transform.
#include "renderer/passes/texel_slabs.h"

#include <gtest/gtest.h>

#include "renderer/scenes/builtin.h"
#include "renderer/view/fits/light_fit.h"

namespace si {
namespace {

constexpr int kTexels = 256;

/// Returns the map coordinates and depth of a world point by the view's projection.
glm::dvec3 uvd_of(const LightView& view, const glm::dvec3& p) {
    const glm::dvec4 clip = view.clip_from_relative(p) * glm::dvec4(0, 0, 0, 1);
    const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
    return {ndc.x * 0.5 + 0.5, ndc.y * 0.5 + 0.5, view.curve.convention.zero_to_one ? ndc.z : ndc.z * 0.5 + 0.5};
}

std::vector<LightView> views_of_every_kind() {
    const Scene scene = load_scene("boxes");
    std::vector<LightView> out;
    for (const LightType type : {LightType::Directional, LightType::Spot, LightType::Point})
        for (const bool reversed : {false, true}) {
            Settings s;
            s.map.resolution = kTexels;
            s.map.reversed_z = reversed;
            s.lights[0].type = type;
            const FittedLight light = fit_lights(scene, s)[0];
            out.insert(out.end(), light.views.begin(), light.views.end());
        }
    return out;
}

TEST(TexelSlabs, LieAtTheirStoredDepthOnTheirTexel) {
    for (const LightView& view : views_of_every_kind()) {
        const TexelRegion region{{100, 30}, {2, 2}};
        const std::vector<float> depths = {0.25f, 0.5f, 0.75f, float(view.curve.convention.far_depth())};
        const auto slabs = texel_slabs(view, {}, kTexels, region, depths, Slabs::Stored);
        ASSERT_EQ(slabs.size(), 3u) << "the far plane makes no slab";
        for (std::size_t i = 0; i < slabs.size(); ++i) {
            EXPECT_EQ(slabs[i].texel, region.first + glm::ivec2(i % 2, i / 2));
            EXPECT_FALSE(slabs[i].biased);
            for (int c = 0; c < 4; ++c) {
                const glm::dvec3 uvd = uvd_of(view, slabs[i].corners[std::size_t(c)]);
                EXPECT_NEAR(uvd.x * kTexels, slabs[i].texel.x + (c & 1), 1e-6);
                EXPECT_NEAR(uvd.y * kTexels, slabs[i].texel.y + (c >> 1), 1e-6);
                EXPECT_NEAR(uvd.z, double(depths[i]), 1e-9);
            }
        }
    }
}

/// Returns the depth that is compared for a point at distance z: that of the point moved towards the light by the bias.
double compared_depth(const LightView& view, const BiasSettings& bias, double z) {
    const double sign = view.curve.convention.reversed ? -1 : 1;
    if (bias.unit == BiasUnit::Depth) return view.curve.depth(z) - sign * bias.constant;
    const double metres = bias.unit == BiasUnit::Texels ? view.texel_size(z, kTexels) : 1;
    return view.curve.depth(z - bias.constant * metres);
}

TEST(TexelSlabs, BiasedSlabsLieAtEqualComparedDepth) {
    for (const LightView& view : views_of_every_kind())
        for (const auto& [unit, constant] :
             {std::pair{BiasUnit::Depth, 0.01}, {BiasUnit::Texels, 3.0}, {BiasUnit::Metres, 0.4}}) {
            BiasSettings bias;
            bias.unit = unit;
            bias.constant = constant;
            for (const double stored : {0.2, 0.6, 0.9}) {
                const auto z = compared_distance(view, bias, kTexels, stored, {0.5, 0.5});
                ASSERT_TRUE(z);
                EXPECT_GT(*z, view.curve.distance(stored)) << "away from the light";
                EXPECT_NEAR(compared_depth(view, bias, *z), stored, 1e-9) << int(unit);
            }
            const auto both = texel_slabs(view, bias, kTexels, {{3, 4}, {1, 1}}, {0.5f}, Slabs::Both);
            ASSERT_EQ(both.size(), 2u);
            EXPECT_TRUE(both[1].biased);
            EXPECT_NEAR(uvd_of(view, both[1].corners[0]).z,
                        view.curve.depth(*compared_distance(view, bias, kTexels, 0.5, {0.5, 0.5})), 1e-9);
            EXPECT_EQ(texel_slabs(view, bias, kTexels, {{3, 4}, {1, 1}}, {0.5f}, Slabs::Biased).size(), 1u);
        }
}

TEST(TexelSlabs, InfiniteDepthHasNoSlab) {
    LightView view;
    view.curve = {.perspective = true, .near = 1, .far = 10, .convention = {}};
    BiasSettings bias;
    bias.unit = BiasUnit::Depth;
    bias.constant = 0.5;  // the curve reaches infinity at depth 10 / 9
    EXPECT_TRUE(compared_distance(view, bias, kTexels, 0.5, {0.5, 0.5}));
    EXPECT_FALSE(compared_distance(view, bias, kTexels, 0.7, {0.5, 0.5}));
    EXPECT_TRUE(texel_slabs(view, bias, kTexels, {{0, 0}, {1, 1}}, {0.7f}, Slabs::Biased).empty());
    view.set_half_extents({1, 1});
    bias.unit = BiasUnit::Texels;
    bias.constant = kTexels;  // a texel is 2 / kTexels of the distance wide: the bias moves every point past the light
    EXPECT_FALSE(compared_distance(view, bias, kTexels, 0.5, {0.5, 0.5}));
}

TEST(TexelSlabs, RegionIsCentredAndClippedToTheMap) {
    ViewSettings v;
    v.slabs_texels = 32;
    EXPECT_EQ(slab_region(v, 256), (TexelRegion{{112, 112}, {32, 32}}));
    v.slabs_u = 0;
    v.slabs_v = 1;
    EXPECT_EQ(slab_region(v, 256), (TexelRegion{{0, 240}, {16, 16}}));
    v.slabs_texels = 1;
    v.slabs_u = v.slabs_v = 10.5 / 256;
    EXPECT_EQ(slab_region(v, 256), (TexelRegion{{10, 10}, {1, 1}}));
    v.slabs_texels = 32;
    v.slabs_u = 100.7 / 256;  // the nearest centred square
    EXPECT_EQ(slab_region(v, 256).first, glm::ivec2(85, 0));
    v.slabs_texels = 256;
    EXPECT_EQ(slab_region(v, 4), (TexelRegion{{0, 0}, {4, 4}}));
}

}  // namespace
}  // namespace si
