// Tests that two descriptions of one scene draw one picture: transforms on nodes or in vertices, metres or
// micrometres, holes as geometry or as an alpha mask.
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/view/cameras/make_camera.h"
#include "tests/gl/frame_fixture.h"

namespace si {
namespace {

/// Returns the scene with `m` applied to its root nodes.
Scene moved_by_nodes(const Scene& scene, const glm::dmat4& m) {
    Scene out = scene;
    for (Node& node : out.nodes)
        if (node.parent < 0) node.local = m * node.local;
    out.cameras.clear();
    finalise(out);
    return out;
}

/// Returns the scene with all transforms baked into vertices.
Scene baked(const Scene& moved) {
    Scene out = moved;
    out.meshes.clear();
    for (std::size_t i = 0; i < moved.objects.size(); ++i) {
        Mesh mesh = moved.meshes[std::size_t(moved.objects[i].mesh)];
        const glm::dmat4& world = moved.objects[i].world;
        const glm::dmat3 linear(world), normals = glm::transpose(glm::inverse(linear));
        for (glm::vec3& p : mesh.positions.edit()) p = glm::vec3(world * glm::dvec4(p, 1));
        for (glm::vec3& n : mesh.normals.edit()) n = glm::vec3(glm::normalize(normals * glm::dvec3(n)));
        if (glm::determinant(linear) < 0)  // a mirror image reverses the winding
            for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3)
                std::swap(mesh.indices.edit()[t], mesh.indices.edit()[t + 1]);
        out.meshes.push_back(std::move(mesh));
        out.objects[i].mesh = int(i);
        out.objects[i].instance = glm::dmat4(1);
    }
    for (Node& node : out.nodes) node.local = glm::dmat4(1);
    finalise(out);
    return out;
}

class TwinScenes : public FrameTest {
protected:
    /// Counts the pixels in which the shaded picture or an overlay differs between the twins.
    std::size_t differences(const Scene& a, const Scene& b, const char* overlay, const Settings& base) {
        Settings s = base;
        set_setting(s, "view.overlay", overlay);
        return different_pixels(picture(a, s), picture(b, s), 3);
    }
};

TEST_F(TwinScenes, MirroredAndShearedNodesLookLikeTheirPlainTwins) {
    const Scene boxes = load_scene("boxes");
    glm::dmat4 shear(1);
    shear[1][0] = 0.6;
    shear[2][1] = -0.3;
    const std::pair<const char*, glm::dmat4> transforms[] = {
        {"mirrored", glm::scale(glm::dmat4(1), {-1, 1, 1})},
        {"mirrored in all axes", glm::scale(glm::dmat4(1), {-1, -1, -1})},
        {"uneven", glm::scale(glm::dmat4(1), {2, 0.5, 1})},
        {"sheared", shear},
        {"sheared and mirrored", shear * glm::scale(glm::dmat4(1), {1, 1, -1})},
    };
    for (const auto& [name, m] : transforms) {
        const Scene by_nodes = moved_by_nodes(boxes, m), plain = baked(by_nodes);
        for (const char* cull : {"none", "front", "back"}) {
            const Settings s = settings_for(boxes, {{"caster.cull", cull}});
            // Single precision rounds both differently: a few pixels on edges.
            const std::size_t pixels = std::size_t(small_request().width) * std::size_t(small_request().height),
                              few = pixels / 200;
            for (const char* overlay : {"none", "visibility", "n-dot-l", "normals"})
                EXPECT_LE(differences(by_nodes, plain, overlay, s), few)
                    << name << ", " << overlay << ", cull " << cull;
        }
    }
}

TEST_F(TwinScenes, ATwinWithReversedWindingLooksDifferent) {
    const Scene boxes = moved_by_nodes(load_scene("boxes"), glm::dmat4(1));
    Scene inside_out = boxes;
    for (Mesh& mesh : inside_out.meshes)
        for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3)
            std::swap(mesh.indices.edit()[t], mesh.indices.edit()[t + 1]);
    finalise(inside_out);
    EXPECT_GT(differences(boxes, inside_out, "none", settings_for(boxes, {"caster.cull=back"})), 500u);
}

TEST_F(TwinScenes, AScenesSizeDoesNotMatter) {
    const Scene boxes = moved_by_nodes(load_scene("boxes"), glm::dmat4(1));
    const double radius = boxes.bounds.radius();
    for (const char* type : {"directional", "spot"}) {
        const Settings s = settings_for(boxes, {{"light.type", type}});
        const ByteImage expected = picture(boxes, s);
        const Camera reference = make_camera(boxes, s, 16.0 / 9);
        for (const double scale : {1e-6, 1e-3, 1e3, 1e6, 1e7}) {
            const Scene scaled = moved_by_nodes(boxes, glm::scale(glm::dmat4(1), glm::dvec3(scale)));
            ASSERT_NEAR(scaled.bounds.radius() / (radius * scale), 1, 1e-6);
            const Camera camera = make_camera(scaled, s, 16.0 / 9);
            EXPECT_NEAR(camera.curve.near / (reference.curve.near * scale), 1, 1e-3) << scale;
            EXPECT_NEAR(camera.curve.far / (reference.curve.far * scale), 1, 1e-3) << scale;
            EXPECT_LE(different_pixels(expected, picture(scaled, s), 3), expected.data.size() / 4 / 200)
                << type << " at scale " << scale;
        }
    }
}

/// Makes a floor of 10 x 10 m and, one metre above, a sheet of 4 x 4 m: whole, or with every second of 4 x 4 fields
/// open.
Scene sheet_over_floor(bool as_mask) {
    Scene scene;
    const auto quad = [](Mesh& mesh, glm::vec3 lo, glm::vec3 hi) {
        const auto base = std::uint32_t(mesh.positions.size());
        mesh.positions.append({{lo.x, lo.y, lo.z}, {lo.x, lo.y, hi.z}, {hi.x, lo.y, hi.z}, {hi.x, lo.y, lo.z}});
        for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(base + i);
    };
    scene.meshes.resize(2);
    quad(scene.meshes[0], {-5, 0, -5}, {5, 0, 5});
    Mesh& sheet = scene.meshes[1];
    if (as_mask) {
        Texture texture{.width = 4,
                        .height = 4,
                        .wrap_s = TextureWrap::Clamp,
                        .wrap_t = TextureWrap::Clamp,
                        .nearest_mag = true,
                        .nearest_min = true,
                        .mipmaps = false};
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) texture.rgba.append({255, 255, 255, std::uint8_t((x + y) % 2 ? 0 : 255)});
        scene.textures.push_back(texture);
        scene.materials.push_back({.base_colour_texture = 0, .alpha = AlphaMode::Mask});
        sheet.material = 0;
        quad(sheet, {-2, 1, -2}, {2, 1, 2});
        sheet.uv = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    } else {
        scene.materials.push_back({});
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x)
                if ((x + y) % 2 == 0) quad(sheet, {x - 2, 1, y - 2}, {x - 1, 1, y - 1});
    }
    scene.nodes = {{.name = "floor"}, {.name = "sheet"}};
    scene.objects = {{.node = 0, .mesh = 0}, {.node = 1, .mesh = 1}};
    finalise(scene);
    return scene;
}

TEST_F(TwinScenes, AMaskCutsTheSameHolesAsGeometry) {
    const Scene masked = sheet_over_floor(true), cut = sheet_over_floor(false);
    Settings s;
    s.lights[0].elevation = 70;
    const FloatImage a = visibility(masked, s), b = visibility(cut, s);
    const std::size_t dark = values_between(b, -1, 0.5f);
    EXPECT_GT(dark, 500u) << "no shadow to cut holes into";
    EXPECT_LE(differing_values(a, b, 0.5f), dark / 50);
}

}  // namespace
}  // namespace si
