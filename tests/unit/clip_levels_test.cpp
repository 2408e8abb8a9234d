// Tests of clip levels: visible points are inside the level of their look-up, texels match pixels in size, and pages
// stay in place while the camera moves.
#include "renderer/view/cascades/clip_levels.h"

#include <gtest/gtest.h>

#include <random>

#include "renderer/base/directions.h"
#include "renderer/view/bounds/scene_shape.h"
#include "renderer/view/cameras/make_camera.h"
#include "tests/support/box_scene.h"
#include "tests/support/sets.h"

namespace si {
namespace {

using test::BoxExtent;

constexpr ClipLevelRequest kRequest{.convention = {true, false},
                                    .resolution = 1024,
                                    .page_texels = 64,
                                    .count = 8,
                                    .margin_texels = 9,
                                    .picture_lines = 360};

Settings looking_at(const glm::dvec3& target, double azimuth, double elevation, double distance, bool orthographic) {
    Settings s;
    s.camera = orbiting_camera(target, azimuth, elevation, distance);
    s.camera.orthographic = orthographic;
    s.camera.height = 14;
    return s;
}

TEST(ClipLevels, HoldTheVisibleRegion) {
    std::mt19937 engine(11);
    const auto between = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine); };
    for (const glm::dvec3& offset : {glm::dvec3(0), glm::dvec3(115, -3, 40), glm::dvec3(1e5, 2e3, -1e5)}) {
        const Scene scene = test::box_scene({{{-40, -1, -40}, {40, 0, 40}}, {{-1, 0, -1}, {1, 6, 1}}}, offset);
        const SceneShape shape = scene_shape(scene, {});
        int all = 0;
        for (int i = 0; i < 60; ++i) {
            const bool orthographic = i % 4 == 0;
            const glm::dvec3 target = offset + glm::dvec3(between(-30, 30), 0, between(-30, 30));
            const Settings s = looking_at(target, between(0, 360), between(2, 89), between(1, 90), orthographic);
            const Camera camera = make_camera(scene, s, 16.0 / 9);
            ClipLevelRequest request = kRequest;
            request.to_light =
                i % 3 == 0 ? glm::dvec3(0, 1, 0) : direction_from_angles(between(0, 360), between(5, 90));
            const ClipLevels found = clip_levels(request, shape, camera);
            ASSERT_EQ(found.views.size(), 8u);
            const double pixel = 2 * std::tan(0.5 * camera.fov_y_rad) / request.picture_lines;
            int counted = 0;
            for (int k = 0; k < 200; ++k) {
                const glm::dvec3 p = offset + glm::dvec3(between(-40, 40), between(-1, 0), between(-40, 40));
                const glm::dvec4 at = camera.project(p, 640, 360);
                if (!(at.w > 0) || at.x < 0 || at.x > 640 || at.y < 0 || at.y > 360 || at.z < 0 || at.z > 1) continue;
                if (!orthographic && (at.w < camera.curve.near || at.w > camera.curve.far)) continue;
                ++counted;
                const std::size_t level = found.chooser.choose(found.views, p).view;
                const LightView& view = found.views[level];
                const glm::dvec4 h = view.clip_from_relative(p) * glm::dvec4(0, 0, 0, 1);
                const double rim = 1 - 2 * request.margin_texels / request.resolution;
                EXPECT_LE(std::max(std::abs(h.x), std::abs(h.y)), rim * (1 + 1e-9)) << "level " << level;
                EXPECT_TRUE(h.z >= 0 && h.z <= 1);
                // No coarser than a pixel unless the requested level is too narrow.
                const double texel = found.levels[level].texel_m();
                EXPECT_EQ(texel, view.texel_size(1, request.resolution));
                if (!orthographic && level > 0) {
                    const double away = glm::distance(p, camera.eye), finer = 0.5 * texel;
                    EXPECT_TRUE(texel <= pixel * away * (1 + 1e-9) || away > finer * (512 - 32 - 9) * (1 - 1e-9));
                    EXPECT_TRUE(level == 7 || 2 * texel >= pixel * away * (1 - 1e-9));
                }
            }
            all += counted;
        }
        EXPECT_GT(all, 2000) << "places that were seen";
    }
}

// A page of two cameras is drawn by the same numbers, bit for bit.
TEST(ClipLevels, PagesDoNotMoveWithTheCamera) {
    const Scene scene = test::box_scene({{{-40, -1, -40}, {40, 0, 40}}}, {115, 7, -30});
    const SceneShape shape = scene_shape(scene, {});
    ClipLevelRequest request = kRequest;
    request.to_light = direction_from_angles(31, 52);
    const auto levels = [&](double x, double azimuth) {
        return clip_levels(request, shape, make_camera(scene, looking_at({x, 0, 2}, azimuth, 20, 15, false), 1.5));
    };
    const ClipLevels a = levels(0, 10);
    std::size_t shared_pages = 0, moved_levels = 0;
    for (const auto& [x, azimuth] : {std::pair{1.7, 10.0}, {9.3, 12.0}, {0.0, 100.0}}) {
        const ClipLevels b = levels(x, azimuth);
        for (std::size_t i = 0; i < a.levels.size(); ++i)
            for (std::size_t k = 0; k < b.levels.size(); ++k) {
                if (a.levels[i].exponent != b.levels[k].exponent) continue;
                moved_levels += a.levels[i].corner != b.levels[k].corner;
                const glm::i64vec2 page = glm::max(a.levels[i].corner, b.levels[k].corner) + glm::i64(3);
                glm::ivec2 in_a, in_b;
                const LightView va = block_view(a.views[i], a.levels[i], 64, page, in_a);
                const LightView vb = block_view(b.views[k], b.levels[k], 64, page, in_b);
                EXPECT_EQ(in_a, in_b);
                EXPECT_TRUE(in_a.x >= 0 && in_a.x < kBlockPages && in_a.y >= 0 && in_a.y < kBlockPages);
                EXPECT_EQ(va.clip_from_relative(page_origin(shape)), vb.clip_from_relative(page_origin(shape)));
                ++shared_pages;
                // The page's position matches the level's own map.
                const double texel = a.levels[i].texel_m();
                const glm::dvec3 own = a.views[i].position_ws(
                    (glm::dvec2(page - a.levels[i].corner) + 0.5) * 64.0 / double(request.resolution), 1);
                const glm::dvec3 block = va.position_ws((glm::dvec2(in_a) + 0.5) / double(kBlockPages), 1);
                EXPECT_LT(glm::distance(own, block), 1e-9 * (1 + texel * request.resolution));
            }
    }
    EXPECT_GE(shared_pages, 20u);
    EXPECT_GE(moved_levels, 6u);
}

}  // namespace
}  // namespace si
