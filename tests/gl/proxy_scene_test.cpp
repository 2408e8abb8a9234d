// Tests the proxy scene, a small scene that needs the same shader programs as a large one.
#include "renderer/scene/proxy_scene.h"

#include <filesystem>

#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"

namespace si {
namespace {

class ProxySceneTest : public FrameTest {};

/// The test compares the programs that both scenes need.
TEST_F(ProxySceneTest, NeedsTheProgramsOfItsScene) {
    std::vector<std::string> names = {"stage", "boxes", "landscape"};
    for (const char* file : {"gen_forest_10k/forest_10k.glb", "gen_leaf_mask_uv1/leaf_mask_uv1.glb"}) {
        const auto path = std::filesystem::path(SI_SOURCE_DIR "/../shared/models") / file;
        if (std::filesystem::exists(path)) names.push_back(path.string());
    }
    const FrameRequest small_frame = small_request();
    for (const std::string& name : names) {
        const Scene scene = load_scene(name);
        const Settings s = settings_for(scene, {"filter.kernel=pcf3"});
        const Scene small = make_proxy_scene(scene, s);
        EXPECT_LT(glm::distance(small.bounds.lo, scene.bounds.lo), 0.05 * scene.bounds.radius()) << name;
        EXPECT_LT(glm::distance(small.bounds.hi, scene.bounds.hi), 0.05 * scene.bounds.radius()) << name;
        EXPECT_LE(small.triangle_count(), std::max<std::size_t>(scene.triangle_count(), 20000)) << name;
        EXPECT_EQ(renderer.programs_key(scene, s, small_frame), renderer.programs_key(small, s, small_frame)) << name;
    }
}

TEST_F(ProxySceneTest, IsSmallAndKeepsEachKindOfObject) {
    Scene scene;
    const int plain = add_material(scene, "plain", {1, 0, 0}), cut = add_material(scene, "cut", {0, 1, 0});
    scene.materials[std::size_t(cut)].alpha = AlphaMode::Mask;
    const int node = add_node(scene, "Field");
    const int dense = add_mesh(scene, "dense", make_sphere(1, 200, 100), plain);
    const int leaf = add_mesh(scene, "leaf", make_box(glm::dvec3(1)), cut);
    for (int i = 0; i < 2000; ++i) {
        Object o;
        o.node = node;
        o.mesh = i == 777 ? leaf : dense;
        o.instance = i == 778 ? scaled(-1, 1, 1) : moved(115 + i % 50, 0, i / 50);
        scene.objects.push_back(o);
    }
    finalise(scene);
    const Scene small = make_proxy_scene(scene, {});
    EXPECT_LT(small.triangle_count(), 20000u);
    EXPECT_LT(small.objects.size(), 10u);
    bool masked = false, mirrored = false;
    for (const Object& o : small.objects) {
        masked |= small.meshes[std::size_t(o.mesh)].material == cut;
        mirrored |= glm::determinant(glm::dmat3(o.world)) < 0;
    }
    EXPECT_TRUE(masked);
    EXPECT_TRUE(mirrored);
    EXPECT_NEAR(glm::distance(small.bounds.lo, scene.bounds.lo), 0, 1e-6);
    EXPECT_NEAR(glm::distance(small.bounds.hi, scene.bounds.hi), 0, 1e-6);
}

TEST_F(ProxySceneTest, ExistsForAnEmptyScene) {
    Scene nothing;
    finalise(nothing);
    EXPECT_TRUE(make_proxy_scene(nothing, {}).objects.empty());
}

}  // namespace
}  // namespace si
