// Tests that a reference ray in a packet answers as a single ray.
#include "renderer/reference/reference_rays.h"
#include "renderer/reference/reference_task.h"
#include "renderer/render/reference_frames.h"
#include "renderer/scenes/builtin.h"
#include "tests/gl/frame_fixture.h"

namespace si {
namespace {

class ReferencePackets : public FrameTest {};

TEST_F(ReferencePackets, ARayInAPacketEqualsASingleRayInBuiltInScenes) {
    std::size_t rays = 0, occluded = 0;
    for (const BuiltinScene& row : builtin_scenes()) {
        const Scene scene = load_scene(std::string(row.key));
        const ReferenceTask task = reference_task(renderer, scene, settings_for(scene, {}),
                                                  {.width = 192, .height = 108}, 0, {.nearest = false});
        const ReferenceScene casters(task.geometry);
        const Receivers receivers = reconstruct_receivers(*task.geometry, task.camera, task.ids, {});
        std::vector<RTCRay> together;
        for (const Receiver& r : receivers.pixels) {
            if (!r.hit()) continue;
            double distance = 0;
            const glm::vec3 direction(task.query.emitter.direction_from(r.position_ws, distance));
            together.push_back(make_ray(ray_origin(casters.impl(), r), direction,
                                        float(distance * casters.impl().scale), unsigned(together.size())));
        }
        std::vector<RTCRay> alone = together;
        mark_occluded(casters.impl(), together, {});
        for (std::size_t i = 0; i < alone.size(); ++i) {
            mark_occluded(casters.impl(), {&alone[i], 1}, {});
            ASSERT_EQ(together[i].tfar < 0, alone[i].tfar < 0) << row.key << ", ray " << i;
            occluded += alone[i].tfar < 0;
        }
        rays += alone.size();
    }
    EXPECT_GT(rays, 50000u);
    EXPECT_GT(occluded, 5000u);
    EXPECT_LT(occluded, rays);
}

}  // namespace
}  // namespace si
