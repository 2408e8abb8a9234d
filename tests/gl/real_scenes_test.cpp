// Tests features of files in real frames: animation, normal maps, blended casters.
#include <glm/gtc/matrix_transform.hpp>

#include "app/session/session.h"
#include "renderer/base/directions.h"
#include "renderer/scene/animation.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/missing_reason.h"
#include "tests/unit/gltf_test_file.h"

namespace si {
namespace {

using test::GltfFile;
using test::Json;

class RealScenes : public FrameTest {
protected:
    /// Returns the mean column and the number of pixels in shadow.
    glm::dvec2 shadow(const Scene& scene, const Settings& s) {
        const FloatImage v = visibility(scene, s);
        double sum = 0, count = 0;
        for (int y = 0; y < v.height; ++y)
            for (int x = 0; x < v.width; ++x)
                if (v.at(x, y) < 0.5f) {
                    sum += x;
                    ++count;
                }
        return {count > 0 ? sum / count : -1, count};
    }
    /// Returns the middle pixel of an overlay's picture.
    glm::dvec3 middle(const Scene& scene, const Settings& s, const char* overlay) {
        const FloatImage v = overlay_values(scene, s, overlay);
        const int x = v.width / 2, y = v.height / 2;
        return {v.at(x, y, 0), v.at(x, y, 1), v.at(x, y, 2)};
    }
};

/// Makes a floor and, one metre above, a triangle bound to a joint that moves along x from -1 to 1 in two seconds.
GltfFile skinned_over_floor() {
    GltfFile file;
    const int floor = file.floats({-3, 0, -3, -3, 0, 3, 3, 0, 3, -3, 0, -3, 3, 0, 3, 3, 0, -3}, "VEC3");
    file.root({{"name", "floor"}, {"mesh", file.mesh({{"attributes", {{"POSITION", floor}}}})}});
    const Json attributes = {{"POSITION", file.floats({-0.5f, 1, -0.5f, -0.5f, 1, 0.5f, 0.5f, 1, 0.5f}, "VEC3")},
                             {"JOINTS_0", file.accessor(file.view(std::vector<std::uint8_t>(12, 0)), 5121, "VEC4", 3)},
                             {"WEIGHTS_0", file.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4")}};
    file.root({{"name", "hero"}, {"mesh", file.mesh({{"attributes", attributes}})}, {"skin", 0}});
    const int joint = file.root({{"name", "joint"}});
    file.json["skins"] = {{{"joints", {joint}}}};
    file.json["animations"] = {
        {{"samplers",
          {{{"input", file.floats({0, 2}, "SCALAR")}, {"output", file.floats({-1, 0, 0, 1, 0, 0}, "VEC3")}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", joint}, {"path", "translation"}}}}}}}};
    return file;
}

TEST_F(RealScenes, AShadowMovesWithTheSkinThatCastsIt) {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("model.glb", skinned_over_floor().glb()).string();
    const auto at = [&](const std::vector<std::string>& sets) {
        std::vector<std::string> all = {"camera.source=manual", "camera.azimuth=0", "camera.elevation=30",
                                        "light.0.azimuth=0", "light.0.elevation=45"};
        all.insert(all.end(), sets.begin(), sets.end());
        const Session session = open_session({.scene = path, .sets = all});
        EXPECT_TRUE(session.notes.empty()) << session.notes.front();
        return shadow(session.scene, session.settings);
    };
    const glm::dvec2 start = at({}), half = at({"scene.time=1"}), end = at({"scene.time=2"}),
                     late = at({"scene.time=99"}), rest = at({"scene.animation=-1"});
    EXPECT_GT(start.y, 50) << "no shadow";
    EXPECT_LT(start.x + 15, half.x);
    EXPECT_LT(half.x + 15, end.x);
    EXPECT_EQ(late, end);
    EXPECT_EQ(rest, half) << "in its rest pose the joint stands at 0";
    EXPECT_THROW(at({"scene.animation=1"}), UsageError);
    const Session still = open_session({.scene = "boxes", .sets = {"scene.time=1"}});
    EXPECT_TRUE(test::mentions(still.notes, "no animation"));
}

TEST_F(RealScenes, AShadowMovesInASharedSkinnedModel) {
    const std::string path = SI_SOURCE_DIR "/../shared/models/khr_RiggedSimple/glTF-Binary/RiggedSimple.glb";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << test::kMissingReason << "../shared/models";
    const Session a = open_session({.scene = path, .sets = {"scene.time=0"}}),
                  b = open_session({.scene = path, .sets = {"scene.time=1"}});
    EXPECT_NE(visibility(a.scene, a.settings).data, visibility(b.scene, b.settings).data);
}

/// Adds a normal map of one texel to the scene. Returns its index.
int add_normal_map(Scene& scene, const glm::vec3& n) {
    Texture t;
    t.width = t.height = 1;
    t.srgb = false;
    t.mipmaps = false;
    for (int i = 0; i < 3; ++i) t.rgba.push_back(std::uint8_t(std::lround((n[i] * 0.5f + 0.5f) * 255)));
    t.rgba.push_back(255);
    scene.textures.push_back(t);
    return int(scene.textures.size()) - 1;
}

/// Makes a floor of normals +y whose texture lies with u along +x and v along +z.
Scene mapped_floor(const glm::vec3& n, bool tangents, const glm::dmat4& local = glm::dmat4(1)) {
    Scene scene;
    scene.name = "mapped floor";
    const int material = add_material(scene, "bumps", {0.5f, 0.5f, 0.5f});
    scene.materials[std::size_t(material)].normal_texture = add_normal_map(scene, n);
    scene.materials[std::size_t(material)].double_sided = true;
    Mesh mesh;
    mesh.positions = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
    mesh.normals.assign(4, {0, 1, 0});
    mesh.uv = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    if (tangents) mesh.tangents.assign(4, {1, 0, 0, 1});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    add_object(scene, "Floor", -1, add_mesh(scene, "Floor", mesh, material), local);
    finalise(scene);
    return scene;
}

TEST_F(RealScenes, NormalMapsTiltTheShadingNormalAlike) {
    struct Case {
        const char* name;
        glm::vec3 map;
        glm::dmat4 local;
        const char* elevation;
        glm::dvec3 expected;
    };
    const glm::dmat4 one(1), mirrored = glm::scale(one, {-1, 1, 1});
    const glm::dmat4 tiny = glm::scale(one, glm::dvec3(1e-6));
    const Case cases[] = {
        {"flat", {0, 0, 1}, one, "60", {0, 1, 0}},
        {"x is along u", {0.6f, 0, 0.8f}, one, "60", {0.6, 0.8, 0}},
        {"y is against v", {0, 0.6f, 0.8f}, one, "60", {0, 0.8, -0.6}},
        {"mirrored x", {0.6f, 0, 0.8f}, mirrored, "60", {-0.6, 0.8, 0}},
        {"mirrored y", {0, 0.6f, 0.8f}, mirrored, "60", {0, 0.8, -0.6}},
        {"tiny", {0.6f, 0, 0.8f}, tiny, "60", {0.6, 0.8, 0}},
        {"from behind", {0.6f, 0, 0.8f}, one, "-60", {-0.6, -0.8, 0}},
    };
    for (const Case& c : cases)
        for (const bool tangents : {false, true}) {
            const Scene scene = mapped_floor(c.map, tangents, c.local);
            const std::string distance = c.local == tiny ? "0.000003" : "3";
            Settings s = settings_for(
                scene, {"camera.source=manual", {"camera.elevation", c.elevation}, {"camera.distance", distance}});
            const glm::dvec3 n = middle(scene, s, "normals") * 2.0 - 1.0;
            EXPECT_LE(glm::distance(n, c.expected), 0.015)
                << c.name << (tangents ? " with tangents: " : ": ") << n.x << ' ' << n.y << ' ' << n.z;
            set_setting(s, "shading.textures", "false");
            EXPECT_NEAR(std::abs(middle(scene, s, "normals").y * 2 - 1), 1, 1e-6) << c.name;
        }
}

TEST_F(RealScenes, TangentsOfTheFileOrientNormalMaps) {
    // The tangents differ from the texture's axes, as a tool may write them; glTF: bitangent = cross(normal, tangent)
    // * w.
    struct Case {
        glm::vec4 tangent;
        glm::vec3 map;
        glm::dvec3 expected;
    };
    for (const Case& c :
         {Case{{0, 0, 1, 1}, {0.6f, 0, 0.8f}, {0, 0.8, 0.6}}, Case{{0, 0, 1, 1}, {0, 0.6f, 0.8f}, {0.6, 0.8, 0}},
          Case{{0, 0, 1, -1}, {0, 0.6f, 0.8f}, {-0.6, 0.8, 0}}, Case{{1, 0, 0, -1}, {0, 0.6f, 0.8f}, {0, 0.8, 0.6}}}) {
        Scene scene = mapped_floor(c.map, true);
        scene.meshes[0].tangents.assign(4, c.tangent);
        finalise(scene);
        const Settings s = settings_for(scene, {"camera.source=manual", "camera.elevation=60", "camera.distance=3"});
        const glm::dvec3 n = middle(scene, s, "normals") * 2.0 - 1.0;
        EXPECT_LE(glm::distance(n, c.expected), 0.015) << n.x << ' ' << n.y << ' ' << n.z;
    }
}

TEST_F(RealScenes, PosesShareTexturesAndOtherScenesDoNot) {
    const auto moving = [](const glm::vec3& n) {
        Scene scene = mapped_floor(n, false);
        auto rig = std::make_shared<Rig>();
        rig->rest.resize(scene.nodes.size());
        AnimationChannel turn{.node = 0, .property = AnimatedProperty::Rotation, .width = 4};
        turn.times_s = {0, 1};
        turn.values = {0, 0, 0, 1, 0, 0.38268f, 0, 0.92388f};
        rig->animations.push_back({.name = "turn", .duration_s = 1, .channels = {turn}});
        scene.rig = rig;
        return scene;
    };
    const auto normal = [&](Renderer& r, const Scene& scene) {
        Settings s = settings_for(
            scene, {"camera.source=manual", "camera.elevation=60", "camera.distance=3", "view.overlay=normals"});
        FrameRequest request = small_request({.colour = false, .overlay = true});
        return r.read_float(r.render(scene, s, request).overlay, 4).data;
    };
    Scene scene = moving({0.6f, 0, 0.8f}), other = moving({0, 0.6f, 0.8f});
    pose(scene, 0, 0);
    const std::vector<float> start = normal(renderer, scene);
    pose(scene, 0, 1);
    const std::vector<float> turned = normal(renderer, scene);
    EXPECT_NE(turned, start);
    pose(other, 0, 1);
    const std::vector<float> others = normal(renderer, other);
    EXPECT_NE(others, turned);
    Renderer fresh;
    EXPECT_EQ(normal(fresh, scene), turned);
    Renderer fresher;
    EXPECT_EQ(normal(fresher, other), others);
}

TEST_F(RealScenes, TheBiasFollowsTheChosenNormal) {
    // Light comes from +x at 45 degrees. The floor's normal is +y, its vertex normals lean to -x, its normal map leans
    // them to +x.
    Scene scene = mapped_floor({0.6f, 0, 0.8f}, true);
    const glm::dvec3 light = direction_from_angles(90, 45), vertex(-0.28, 0.96, 0), tangent(0.96, 0.28, 0);
    scene.meshes[0].normals.assign(4, glm::vec3(vertex));
    scene.meshes[0].tangents.assign(4, glm::vec4(glm::vec3(tangent), 1));
    finalise(scene);
    const glm::dvec3 mapped = 0.6 * tangent + 0.8 * vertex;
    const Settings base =
        settings_for(scene, {"light.0.azimuth=90", "light.0.elevation=45", "bias.kind=slope", "bias.slope=1"});
    for (const auto& [source, normal] :
         {std::pair<const char*, glm::dvec3>{"geometric", {0, 1, 0}}, {"shading", vertex}, {"mapped", mapped}}) {
        Settings s = base;
        set_setting(s, "bias.normal_source", source);
        const double slope = 1 - glm::dot(normal, light);
        EXPECT_NEAR(middle(scene, s, "bias-applied").x, slope, 0.01) << source;
        // Equivalent depth bias of the normal offset, along the light.
        set_setting(s, "bias.normal", "2");
        EXPECT_NEAR(middle(scene, s, "bias-applied").x, slope + 2 * glm::dot(normal, light), 0.02) << source;
        const Probe probe =
            renderer.probe(scene, s, small_request(), small_request().width / 2, small_request().height / 2);
        ASSERT_EQ(probe.lights.size(), 1u);
        EXPECT_NEAR(probe.lights[0].bias_texels, slope, 0.01) << source;
        // Without the normal map the mapped normal is the vertex normal.
        set_setting(s, "shading.textures", "false");
        const glm::dvec3 plain = source == std::string("mapped") ? vertex : normal;
        EXPECT_NEAR(middle(scene, s, "bias-applied").x, 1 + glm::dot(plain, light), 0.02) << source;
    }
}

TEST_F(RealScenes, BlendedSurfacesCastOnlyAsMasks) {
    Scene scene;
    scene.name = "glass";
    const int grey = add_material(scene, "grey", {0.5f, 0.5f, 0.5f}), glass = add_material(scene, "glass", {1, 1, 1});
    add_object(scene, "Floor", -1, add_mesh(scene, "Floor", make_plane(6, 6), grey));
    add_object(scene, "Glass", -1, add_mesh(scene, "Glass", make_plane(1, 1), glass), moved(0, 1, 0));
    Material& m = scene.materials[std::size_t(glass)];
    m.alpha = AlphaMode::Blend;
    m.double_sided = true;
    const auto pixels = [&](float alpha, const char* blend) {
        m.base_colour.a = alpha;
        finalise(scene);
        return shadow(scene, settings_for(scene, {{"caster.blend", blend}})).y;
    };
    EXPECT_EQ(pixels(0.8f, "none"), 0);
    EXPECT_GT(pixels(0.8f, "mask"), 50);
    EXPECT_EQ(pixels(0.4f, "mask"), 0);
}

}  // namespace
}  // namespace si
