#include "tests/support/box_scene.h"

#include <fmt/format.h>

#include "renderer/scenes/shapes.h"

namespace si::test {

Scene box_scene(const std::vector<BoxExtent>& boxes, const glm::dvec3& offset) {
    Scene scene;
    for (const BoxExtent& box : boxes) {
        Mesh mesh;
        // Positions are relative to the box's centre, so that floats lose nothing.
        const glm::dvec3 centre = 0.5 * (box.lo + box.hi), half = 0.5 * (box.hi - box.lo);
        for (int i = 0; i < 8; ++i)
            mesh.positions.push_back(glm::vec3(half * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
        mesh.indices = {0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6};
        for (const glm::vec3& p : mesh.positions) mesh.bounds.add(glm::dvec3(p));
        Node node;
        node.name = node.path = fmt::format("box{}", scene.nodes.size());
        node.local[3] = node.world[3] = glm::dvec4(centre + offset, 1);
        Object object;
        object.node = int(scene.nodes.size());
        object.mesh = int(scene.meshes.size());
        object.world = node.world;
        for (const glm::vec3& p : mesh.positions) scene.bounds.add(glm::dvec3(p) + centre + offset);
        scene.nodes.push_back(node);
        scene.meshes.push_back(mesh);
        scene.objects.push_back(object);
    }
    return scene;
}

Scene blocks_on_ground(const glm::dvec3& at, double thickness_m) {
    std::vector<BoxExtent> boxes{{at + glm::dvec3(-40, -thickness_m, -40), at + glm::dvec3(40, 0, 40)}};
    for (int x = -3; x < 4; ++x)
        for (int z = -3; z < 4; ++z)
            boxes.push_back({at + glm::dvec3(11 * x - 1, 0, 11 * z - 1), at + glm::dvec3(11 * x + 1, 3, 11 * z + 1)});
    return box_scene(boxes);
}

Scene grey_scene(std::vector<GreyPart> parts) {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    for (GreyPart& part : parts) {
        const int mesh = add_mesh(scene, part.name, std::move(part.mesh), grey);
        add_object(scene, part.name, -1, mesh, part.place);
    }
    finalise(scene);
    return scene;
}

Scene fence(int bars, double width_m, double step_m) {
    std::vector<GreyPart> parts{{"floor", make_plane(12, 12)}};
    const Mesh bar = make_box({width_m, 1.6, width_m});
    for (int i = 0; i < bars; ++i)
        parts.push_back({"bar " + std::to_string(i), bar, moved(-3 + step_m * i + 0.013 * (i % 5), 0.9, 0)});
    return grey_scene(std::move(parts));
}

}  // namespace si::test
