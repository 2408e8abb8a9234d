// Tests of the surface of a map as a mesh, against the boxes that the map shows.
#include "renderer/bundle/height_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/projection/view_of_matrix.h"
#include "tests/support/error_text.h"
#include "tests/support/ray_traced_map.h"

namespace si {
namespace {

const glm::dvec3 kCentre{-3000, 20, 700};

/// View of test::unequal_boxes(kCentre) and its map.
struct ViewedMap {
    LightView view;
    FloatImage depths;
};

ViewedMap viewed_map(bool perspective, bool reversed, int width, int height, bool mirrored = false) {
    test::TracedMap map;
    const glm::dvec3 forward = glm::normalize(glm::dvec3(0.35, -1, 0.2));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.2, 1, 0.1), -forward));
    LightView light;
    light.axes = {right, glm::cross(-forward, right), -forward};
    light.eye = kCentre - 18.0 * forward;
    light.curve.perspective = perspective;
    light.curve.near = 5;
    light.curve.far = 40;
    light.curve.convention.reversed = reversed;
    light.set_half_extents(perspective ? glm::dvec2(0.7, 0.35) : glm::dvec2(9, 7));
    if (mirrored) light.projection[0][0] *= -1;
    map.clip_from_world = light.clip_from_relative(glm::dvec3(0));
    map.depth = light.curve.convention;
    map.width = width;
    map.height = height;
    return {view_of_matrix(map.clip_from_world, map.depth), test::traced_map(map, test::unequal_boxes(kCentre))};
}

TEST(HeightField, LiesOnTheSurfacesOfTheMap) {
    const auto boxes = test::unequal_boxes(kCentre);
    for (const bool perspective : {true, false})
        for (const bool reversed : {true, false})
            for (const bool mirrored : {true, false})
                for (const glm::ivec2 size : {glm::ivec2(192, 96), glm::ivec2(65, 129), glm::ivec2(120, 33)}) {
                    const ViewedMap map = viewed_map(perspective, reversed, size.x, size.y, mirrored);
                    const HeightField field = height_field(map.view, map.depths);
                    EXPECT_EQ(field.stride, 1);
                    double covered = 0;
                    std::size_t far_off = 0, turned = 0;
                    const std::size_t count = field.mesh.indices.size() / 3;
                    ASSERT_GT(count, 0u);
                    const glm::dmat4 clip = map.view.clip_from_relative(glm::dvec3(0));
                    for (std::size_t t = 0; t < count; ++t) {
                        glm::dvec3 p[3];
                        glm::dvec2 uv[3];
                        for (std::size_t k = 0; k < 3; ++k) {
                            p[k] = field.origin_ws + glm::dvec3(field.mesh.positions[field.mesh.indices[3 * t + k]]);
                            const glm::dvec4 h = clip * glm::dvec4(p[k], 1);
                            uv[k] = 0.5 * glm::dvec2(h) / h.w + 0.5;
                        }
                        const glm::dvec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
                        covered += 0.5 * std::abs(a.x * b.y - a.y * b.x) * size.x * size.y;
                        const glm::dvec3 middle = (p[0] + p[1] + p[2]) / 3.0;
                        const glm::dvec3 towards =
                            perspective ? glm::normalize(middle - map.view.eye) : -map.view.axes[2];
                        turned += glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), towards) > 0;
                        const auto hit = test::first_hit(boxes, middle - 30.0 * towards, middle + 30.0 * towards);
                        const double texel = map.view.texel_size_at(middle, {size.x, size.y}).longest;
                        far_off += !hit || std::abs(*hit * 60 - 30) > 1.5 * texel;
                    }
                    // Triangles across the rim of a box stand on texels of both its sides.
                    EXPECT_LT(double(far_off), 0.12 * double(count)) << perspective << size.x;
                    EXPECT_EQ(turned, 0u) << "fronts face the light";
                    std::size_t seen = 0;
                    const auto far = float(map.view.curve.convention.far_depth());
                    for (const float d : map.depths.data) seen += d != far;
                    EXPECT_GT(covered, 0.85 * double(seen)) << perspective << size.x;
                    EXPECT_LE(covered, double(seen));
                    EXPECT_GT(field.cut, 20u);
                    EXPECT_LT(count, seen) << "flat parts have few triangles";
                }
}

TEST(HeightField, HasAtMostTheGivenTriangles) {
    ViewedMap map = viewed_map(false, false, 256, 200);
    std::uint32_t state = 1;
    for (float& d : map.depths.data) {
        state = state * 1664525u + 1013904223u;
        d = 0.5f + 0.2f * float(state >> 8) / 16777216.0f;
    }
    const HeightField fine = height_field(map.view, map.depths);
    EXPECT_GT(fine.mesh.indices.size() / 3, 20'000u);
    const HeightField coarse = height_field(map.view, map.depths, {.max_triangles = 2000});
    EXPECT_LE(coarse.mesh.indices.size() / 3, 2000u);
    EXPECT_GT(coarse.mesh.indices.size(), 0u);
    EXPECT_GT(coarse.error_texels, fine.error_texels);
    // A smooth surface loses detail before it loses rows.
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 256; ++x)
            map.depths.data[std::size_t(y) * 256 + std::size_t(x)] = 0.5f + 0.01f * std::sin(0.2f * float(x + y));
    const HeightField smooth = height_field(map.view, map.depths, {.max_triangles = 6000});
    EXPECT_EQ(smooth.stride, 1);
    EXPECT_LE(smooth.mesh.indices.size() / 3, 6000u);
    EXPECT_GT(height_field(map.view, map.depths).mesh.indices.size() / 3, 6000u);
}

TEST(HeightField, FlatGroundTakesFewTrianglesAlsoUnderCoarseDepth) {
    ViewedMap map = viewed_map(true, false, 257, 257);
    test::TracedMap ground;
    ground.clip_from_world = map.view.clip_from_relative(glm::dvec3(0));
    ground.width = ground.height = 257;
    ground.bits = 8;
    const FloatImage depths =
        test::traced_map(ground, {{kCentre + glm::dvec3(-200, -1, -200), kCentre + glm::dvec3(200, 0, 200)}});
    const HeightField field = height_field(map.view, depths, {.depth_step = 1.0 / 255});
    EXPECT_LT(field.mesh.indices.size() / 3, 3000u);
    EXPECT_EQ(field.cut, 0u);
    EXPECT_GT(height_field(map.view, depths).mesh.indices.size() / 3, 6000u) << "steps are no surface";
}

TEST(HeightField, AnEmptyMapIsRefused) {
    ViewedMap map = viewed_map(true, true, 40, 30);
    std::ranges::fill(map.depths.data, 0.f);
    EXPECT_TRUE(test::fails_with([&] { height_field(map.view, map.depths); }, {"shows no surface", "; "}));
    std::ranges::fill(map.depths.data, std::numeric_limits<float>::quiet_NaN());
    EXPECT_TRUE(test::fails_with([&] { height_field(map.view, map.depths); }, {"shows no surface"}));
    FloatImage one{1, 1, 1, {0.5f}};
    EXPECT_TRUE(test::fails_with([&] { height_field(map.view, one); }, {"shows no surface"}));
}

TEST(HeightField, IsASceneInPlace) {
    const ViewedMap map = viewed_map(false, true, 100, 60);
    const Scene scene = height_field_scene(map.view, map.depths);
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_LT(glm::distance(scene.bounds.centre(), kCentre), 12);
    EXPECT_TRUE(scene.materials.at(std::size_t(scene.meshes[0].material)).double_sided);
}

}  // namespace
}  // namespace si
