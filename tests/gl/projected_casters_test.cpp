// Tests that casters projected onto a light hide the same sample points as shadow rays to them.
#include <cmath>
#include <vector>

#include "renderer/reference/reference_rays.h"
#include "renderer/reference/reference_task.h"
#include "renderer/render/reference_frames.h"
#include "renderer/scenes/builtin.h"
#include "tests/gl/frame_fixture.h"

namespace si {
namespace {

class ProjectedCastersTest : public FrameTest {};

constexpr int kSamples = 64;

/// Numbers of pixels, and of samples in which a reference differs from rays.
struct Difference {
    std::size_t pixels = 0, partial = 0, samples = 0;
};

/// Compares each pixel of a reference, whose casters are projected, with a ray to each sample point.
Difference compare_with_rays(Renderer& renderer, const Scene& scene, const Settings& settings, bool as_rasterised) {
    const ReferenceTask task = reference_task(renderer, scene, settings, {.width = 128, .height = 72}, 0,
                                              {.area = true,
                                               .as_rasterised = as_rasterised,
                                               .samples = kSamples,
                                               .first_samples = kSamples,
                                               .nearest = false});
    const Receivers receivers = reconstruct_receivers(*task.geometry, task.camera, task.ids, {});
    const ReferenceScene casters(task.geometry);
    const RayHierarchy& hierarchy = casters.impl();
    const Reference reference = trace_visibility(casters, receivers, task.query, {});
    const HitRules rules{
        as_rasterised ? std::span<const ObjectTraits>(task.query.traits) : std::span<const ObjectTraits>(), {}};
    Difference out;
    std::vector<RTCRay> rays;
    for (std::size_t i = 0; i < reference.state.size(); ++i) {
        if (!is_traced(reference.state[i])) continue;
        const Receiver& r = receivers.pixels[i];
        const LightSamples samples(task.query.emitter, r.position_ws, i);
        rays.clear();
        for (unsigned k = 0; k < kSamples; ++k) {
            const LightRay ray = samples.ray(k);
            if (glm::dot(ray.direction, r.normal_ws) > kGrazingCosine)
                rays.push_back(make_ray(ray_origin(hierarchy, r), glm::vec3(ray.direction),
                                        float(ray.length_m * hierarchy.scale), k));
        }
        if (rays.size() < kSamples) continue;  // a part of the light lies below the horizon
        mark_occluded(hierarchy, rays, rules);
        const auto lit = std::ranges::count_if(rays, [](const RTCRay& ray) { return !(ray.tfar < 0); });
        ++out.pixels;
        out.partial += lit > 0 && lit < kSamples;
        out.samples +=
            std::size_t(std::lround(std::abs(kSamples * double(reference.visibility.data[i]) - double(lit))));
    }
    return out;
}

TEST_F(ProjectedCastersTest, HideTheSamplesThatRaysFindDark) {
    struct Light {
        const char *type, *size;
    };
    for (const Light& light : {Light{"directional", "3"}, Light{"spot", "0.4"}, Light{"point", "0.4"}}) {
        Difference all;
        for (const char* key : {"stage", "boxes", "figures", "teapot"}) {
            const Scene scene = load_scene(key);
            Settings settings = settings_for(scene, {{"light.type", light.type}, {"light.size", light.size}});
            for (const bool as_rasterised : {false, true}) {
                if (as_rasterised) set_setting(settings, "caster.cull", "front");
                const Difference one = compare_with_rays(renderer, scene, settings, as_rasterised);
                all.pixels += one.pixels;
                all.partial += one.partial;
                all.samples += one.samples;
                // A sample that an edge crosses by rounding may go either way.
                EXPECT_LE(one.samples, 10u) << key << ", " << light.type << ", culling " << as_rasterised;
            }
        }
        EXPECT_GT(all.pixels, 20000u) << light.type;
        EXPECT_GT(all.partial, 1000u) << light.type;
    }
}

}  // namespace
}  // namespace si
