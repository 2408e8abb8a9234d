// Tests that receivers placed by several threads, in strips of rows, depend on their own pixel only.
#include "renderer/reference/receivers.h"

#include "renderer/reference/reference_task.h"
#include "renderer/render/reference_frames.h"
#include "tests/gl/frame_fixture.h"

namespace si {
namespace {

class ReceiversTest : public FrameTest {};

/// Returns whether two neighbours are joined, by the definition in receivers.cpp.
bool on_one_surface(const Receiver& a, const Receiver& b) {
    if (!a.hit() || !b.hit()) return false;
    const glm::dvec3 d = b.position_ws - a.position_ws;
    const double most = 0.5 * glm::length(d);
    return std::abs(glm::dot(d, a.normal_ws)) <= most && std::abs(glm::dot(d, b.normal_ws)) <= most;
}

TEST_F(ReceiversTest, NeighboursAreJoinedAcrossStrips) {
    const Scene scene = load_scene("boxes");
    for (const int height : {1, 16, 17, 41}) {
        const ReferenceTask task = reference_task(renderer, scene, settings_for(scene), {.width = 53, .height = height},
                                                  0, {.nearest = false});
        const Receivers r = reconstruct_receivers(*task.geometry, task.camera, task.ids, task.raster, {});
        ASSERT_EQ(r.pixels.size(), 53u * std::size_t(height));
        std::size_t joined = 0, apart = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < 53; ++x) {
                const Receiver& here = r.at(x, y);
                const bool right = x + 1 < 53 && on_one_surface(here, r.at(x + 1, y));
                const bool below = y + 1 < height && on_one_surface(here, r.at(x, y + 1));
                ASSERT_EQ(here.same_surface_right, right) << x << ", " << y << " of " << height;
                ASSERT_EQ(here.same_surface_below, below) << x << ", " << y << " of " << height;
                joined += right + below;
                apart += !right + !below;
            }
        EXPECT_GT(joined, 0u);
        EXPECT_GT(apart, 0u);
    }
}

TEST_F(ReceiversTest, BackgroundPixelsAreEmptyForAnyMemoryContent) {
    const Scene scene = load_scene("boxes");
    ReferenceTask task = reference_task(renderer, scene, settings_for(scene), {.width = 320, .height = 180}, 0, {});
    for (int round = 0; round < 2; ++round) {  // the second round reuses the first one's memory
        const Receivers r = reconstruct_receivers(*task.geometry, task.camera, task.ids, task.raster, {});
        ASSERT_EQ(r.starts.size(), r.pixels.size());
        for (std::size_t i = 0; i < r.pixels.size(); ++i) {
            ASSERT_EQ(r.pixels[i].hit(), task.ids.data[i].x != 0);
            ASSERT_EQ(r.starts[i].object, r.pixels[i].object);
            ASSERT_FALSE(!r.pixels[i].hit() && (r.pixels[i].same_surface_right || r.pixels[i].same_surface_below));
        }
        for (glm::uvec2& id : task.ids.data) id = {};
    }
}

}  // namespace
}  // namespace si
