// Compares triangle normals of the shaders with the geometry in double: near and far from the world origin, at grazing
// views, mirrored, stretched and bent.
#include "renderer/bias/account.h"
#include "renderer/scene/animation.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/hard_case.h"
#include "tests/support/mesh_scene.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si {
namespace {

constexpr int kWidth = 320, kHeight = 240;

class FaceNormalsOnGpu : public FrameTest {
protected:
    FrameResult frame;
    /// Returns the first pane's values, x of each pixel; NaN for background and undefined values.
    std::vector<float> values(const Scene& scene, Settings s, const char* overlay) {
        const FloatImage image = overlay_values(scene, s, overlay, {.width = kWidth, .height = kHeight}, &frame);
        std::vector<float> out;
        for (std::size_t i = 0; i < image.data.size(); i += 4)
            out.push_back(image.data[i + 3] > 0 ? image.data[i] : std::numeric_limits<float>::quiet_NaN());
        return out;
    }
};

SI_TESTS_ARE(Repeated, FaceNormalsOnGpu);
// One plane needs one bias: under parallel light its gradient is the same everywhere.
TEST_F(FaceNormalsOnGpu, OnePlaneNeedsOneBiasOnEveryPixel) {
    struct View {
        double distance, elevation;
    };
    for (const double size : {10.0, 400.0})
        for (const glm::dvec3& place : {glm::dvec3(0), {115, 0, -80}, {1e4, 3e3, -1e4}})
            for (const View& view : {View{0.8, 55}, {1.5, 4}, {20, 1.5}}) {
                SCOPED_TRACE(testing::Message() << size << " m at " << place.x << ", camera distance "
                                                << view.distance * size << " m at " << view.elevation << " degrees");
                const Scene scene = make_scene(make_plane(size, size), moved(place.x, place.y, place.z));
                Settings s = settings_with(test::hard_settings(), {"filter.kernel=pcf3", "light.elevation=1.64"});
                set_target(s.camera, place);
                s.camera.distance = view.distance * size;
                s.camera.elevation = view.elevation;
                s.camera.fov = view.distance > 10 ? 4 : 45;
                const std::vector<float> shown = values(scene, s, "least-bias");
                int told = 0;
                double least = 1e30, most = 0;
                for (const auto& [x, y, origin, dir] : test::pixel_rays(frame.camera, kWidth, kHeight)) {
                    const float value = shown[std::size_t(y * kWidth + x)];
                    if (std::isnan(value)) continue;
                    ++told;
                    const glm::dvec3 at = origin + dir * ((place.y - origin.y) / dir.y);
                    const BiasBreakdown a = test::breakdown_at(frame, s, renderer.driver(), at);
                    const double ratio = value / a.amount(a.least.total()).texels;
                    least = std::min(least, ratio);
                    most = std::max(most, ratio);
                }
                EXPECT_GT(told, 500);
                EXPECT_GT(least, 0.99);
                EXPECT_LT(most, 1.01);
            }
}

// N.L of facets is compared with rays against the triangles in double, under every transform.
TEST_F(FaceNormalsOnGpu, StayPerpendicularUnderAnyTransform) {
    const auto under = [](const glm::dmat4& m) {
        Scene scene;
        const int root = add_node(scene, "root", -1, m);
        add_object(scene, "ball", root, add_mesh(scene, "ball", make_sphere(1, 24, 12), -1));
        add_object(scene, "again", root, 0, moved(2.4, 0.3, 0) * turned(40));
        finalise(scene);
        return scene;
    };
    const glm::dmat4 sheared(1, 0, 0, 0, 0.4, 1, 0, 0, 0, 0.3, 1, 0, 0, 0, 0, 1);
    for (const glm::dmat4& m :
         {glm::dmat4(1), scaled(1, 0.05, 2), scaled(-1, 1, 1), scaled(-0.5, -2, -1), turned(77) * sheared,
          moved(115, 20, -300) * scaled(3, 1, 1), moved(1e4, 0, 1e4), scaled(1e-5, 1e-5, 1e-5)}) {
        const Scene scene = under(m);
        SCOPED_TRACE(testing::Message() << m[0].x << " " << m[1].y << " " << m[3].x);
        Settings s;  // the automatic camera and light
        set_all(s, {"light.azimuth=20", "light.elevation=35"});
        const std::vector<float> shown = values(scene, s, "n-dot-l");
        const test::RayReference rays(scene);
        int checked = 0, off = 0, facing = 0;
        for (const auto& [x, y, hit] : test::pixel_hits(rays, frame.camera, kWidth, kHeight, 3)) {
            const float value = shown[std::size_t(y * kWidth + x)];
            if (std::isnan(value)) continue;
            ++checked;
            facing += value > 0;
            off += std::abs(value - glm::dot(hit.normal, frame.lights[0].to_light)) > 5e-7;
        }
        EXPECT_GT(checked, 300);
        EXPECT_GT(facing, checked / 8);
        EXPECT_LE(off, checked / 50) << "only where the ray and the rasteriser choose another triangle";
    }
}

// A morph bends the mesh. The facets' normals follow, also at corners that several triangles share.
TEST_F(FaceNormalsOnGpu, FollowPoses) {
    Scene scene = make_scene(make_sphere(1, 24, 12));
    Mesh& mesh = scene.meshes[0];
    auto source = std::make_shared<DeformSource>();
    source->positions = mesh.positions;
    source->normals = mesh.normals;
    source->indices = mesh.indices;
    source->targets.resize(1);
    for (const glm::vec3& p : mesh.positions)
        source->targets[0].positions.push_back({0.5f * p.y * p.y, 0.4f * p.x, -0.3f * p.z});
    mesh.deformer = std::make_shared<Deformer>(Deformer{.source = source, .node = 0});
    auto rig = std::make_shared<Rig>();
    rig->rest.resize(scene.nodes.size());
    rig->rest[0].weights = {0};
    AnimationChannel bend{.node = 0, .property = AnimatedProperty::Weights, .width = 1};
    bend.times_s = {0, 1};
    bend.values = {0, 1};
    rig->animations.push_back({.name = "bend", .duration_s = 1, .channels = {bend}});
    scene.rig = rig;
    std::vector<float> before;
    for (const double time : {0.0, 1.0}) {
        pose(scene, 0, time);
        const std::vector<float> shown = values(scene, Settings{}, "n-dot-l");
        EXPECT_NE(before, shown);
        before = shown;
        const test::RayReference rays(scene);
        int checked = 0, off = 0;
        for (const auto& [x, y, hit] : test::pixel_hits(rays, frame.camera, kWidth, kHeight, 4)) {
            const float value = shown[std::size_t(y * kWidth + x)];
            if (std::isnan(value)) continue;
            ++checked;
            off += std::abs(value - glm::dot(hit.normal, frame.lights[0].to_light)) > 5e-7;
        }
        EXPECT_GT(checked, 500);
        EXPECT_LE(off, checked / 50) << time;
    }
}

}  // namespace
}  // namespace si
