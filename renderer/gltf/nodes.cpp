#include "renderer/gltf/nodes.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "renderer/base/printable.h"
#include "renderer/gltf/rules.h"

namespace si::gltf {
namespace {

constexpr std::size_t kMostObjects = 1'000'000;

std::vector<int> parents_of(const tinygltf::Model& model) {
    std::vector<int> parent(model.nodes.size(), -1);
    for (std::size_t i = 0; i < parent.size(); ++i)
        for (const int child : model.nodes[i].children) parent[std::size_t(child)] = int(i);
    return parent;
}

/// Returns the nodes that a scene lists, each once. A listed child (UniGLTF 1.27) is drawn as other viewers do: below
/// its parent when the scene shows that, else as a root.
std::vector<int> listed_nodes(Context& context, const tinygltf::Model& model, int scene) {
    const std::vector<int> parent = parents_of(model);
    std::vector<char> listed(model.nodes.size(), 0);
    std::vector<int> out;
    for (const int node : model.scenes[std::size_t(scene)].nodes)
        if (!std::exchange(listed[std::size_t(node)], 1)) out.push_back(node);
    std::erase_if(out, [&](int node) {
        const int above = parent[std::size_t(node)];
        if (above < 0) return false;
        int ancestor = above;
        while (ancestor >= 0 && !listed[std::size_t(ancestor)]) ancestor = parent[std::size_t(ancestor)];
        const bool is_shown_below = ancestor >= 0;
        const Place scene_place("scenes", scene);
        context.warn(Place(scene_place, "nodes"),
                     fmt::format("node {} is no root, it is a child of node {}; drawn {}", node, above,
                                 is_shown_below ? "below it" : "as a root, without its parent's transform"));
        return is_shown_below;
    });
    return out;
}

std::vector<int> scene_roots(Context& context, const tinygltf::Model& model, int wanted, Scene& scene) {
    for (const tinygltf::Scene& s : model.scenes) scene.file_scenes.push_back(printable(s.name));
    if (wanted >= 0 && std::size_t(wanted) >= model.scenes.size()) {
        context.fail(
            Place("scenes"), fmt::format("scene {} does not exist, the file has {}", wanted, model.scenes.size()),
            model.scenes.size() < 2 ? "leave scene.index out" : fmt::format("choose 0 to {}", model.scenes.size() - 1));
    }
    const bool chosen = wanted >= 0;
    if (!chosen) wanted = model.defaultScene >= 0 ? model.defaultScene : 0;
    if (!model.scenes.empty()) {
        scene.file_scene = wanted;
        if (model.scenes.size() > 1 && !chosen) {
            context.warn(Place("scenes"), fmt::format("the file has {} scenes; scene {} is shown, scene.index chooses",
                                                      model.scenes.size(), wanted));
        }
        return listed_nodes(context, model, wanted);
    }
    // A file without scenes shows all root nodes.
    std::vector<int> roots;
    const std::vector<int> parent = parents_of(model);
    for (std::size_t i = 0; i < parent.size(); ++i)
        if (parent[i] < 0) roots.push_back(int(i));
    return roots;
}

bool is_usable(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            if (!(std::abs(m[c][r]) <= 1e18)) return false;
        }
    }
    return true;
}

bool deforms(const tinygltf::Model& model, const tinygltf::Node& node) {
    return node.skin >= 0 || target_count(model, node.mesh) > 0;
}

void place_meshes(Context& context, const Place& place, int node, const std::vector<int>& meshes,
                  const std::optional<std::vector<glm::dmat4>>& instances, Scene& scene) {
    const std::size_t added = meshes.size() * (instances ? instances->size() : 1);
    if (added > kMostObjects || scene.objects.size() + added > kMostObjects) {
        context.fail(place, fmt::format("the scene would hold more than {} objects", kMostObjects),
                     "merge meshes or remove instances");
    }
    for (const int mesh : meshes) {
        Object object;
        object.node = node;
        object.mesh = mesh;
        if (!instances) {
            scene.objects.push_back(object);
            continue;
        }
        for (const glm::dmat4& transform : *instances) {
            object.instance = transform;
            scene.objects.push_back(object);
        }
    }
}

}  // namespace

glm::dmat4 local_transform(Context& context, const tinygltf::Node& node, const Place& place) {
    if (node.matrix.size() == 16) {
        glm::dmat4 m = glm::make_mat4(node.matrix.data());
        if (m[3][3] != 0) return m / m[3][3];
        m[3][3] = 1;  // the zero matrix: everything at one point
        return m;
    }
    glm::dmat4 m(1.0);
    if (node.translation.size() == 3) m[3] = {node.translation[0], node.translation[1], node.translation[2], 1};
    if (node.rotation.size() == 4) {
        const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        const double length = glm::length(q);
        if (!(length > 1e-12) || !std::isfinite(length)) {
            context.warn(Place(place, "rotation"), "is no rotation; ignored");
        } else {
            if (std::abs(length - 1) > 1e-2)
                context.warn(Place(place, "rotation"), "is not a unit quaternion; normalised");
            m *= glm::mat4_cast(q / length);
        }
    }
    if (node.scale.size() == 3) m = glm::scale(m, glm::dvec3(node.scale[0], node.scale[1], node.scale[2]));
    return m;
}

PlacedNodes place_nodes(Context& context, const Json& root, const tinygltf::Model& model, Accessors& accessors,
                        Primitives& primitives, int scene_index, Scene& scene) {
    struct Visit {
        int node;
        int parent;
    };
    PlacedNodes placed;
    placed.scene_node.assign(model.nodes.size(), -1);
    std::vector<Visit> stack;
    const auto push_reversed = [&](const std::vector<int>& nodes, int parent) {
        for (auto it = nodes.rbegin(); it != nodes.rend(); ++it) stack.push_back({*it, parent});
    };
    push_reversed(scene_roots(context, model, scene_index, scene), -1);
    std::vector<glm::dmat4> world;
    while (!stack.empty()) {
        const Visit visit = stack.back();
        stack.pop_back();
        const auto at = std::size_t(visit.node);
        const Place place("nodes", visit.node);
        const tinygltf::Node& from = model.nodes[at];
        const Json& json = root["nodes"][at];

        Node node;
        node.name = printable(from.name);
        node.parent = visit.parent;
        node.local = local_transform(context, from, place);
        world.push_back(visit.parent < 0 ? node.local : world[std::size_t(visit.parent)] * node.local);
        if (!is_usable(world.back()))
            context.fail(place, "its transform exceeds 1e18", "bring the scene to a usable scale");
        const int index = int(scene.nodes.size());
        placed.scene_node[at] = index;
        scene.nodes.push_back(std::move(node));

        if (from.mesh >= 0) {
            const auto instances = instance_transforms(context, json, place, accessors, model.accessors.size());
            if (!instances && deforms(model, from))
                placed.deformed.push_back(visit.node);
            else
                place_meshes(context, place, index, primitives.of_mesh(from.mesh), instances, scene);
        }
        place_camera(context, root, json, place, world.back(), scene);
        place_light(context, root, json, place, world.back(), scene);
        placed.camera_nodes.resize(scene.cameras.size(), index);
        placed.light_nodes.resize(scene.lights.size(), index);
        push_reversed(from.children, index);
    }
    return placed;
}

std::optional<std::vector<glm::dmat4>> instance_transforms(Context& context, const Json& node, const Place& node_place,
                                                           Accessors& accessors, std::size_t accessor_count) {
    const Json* const instancing = extension_of(node, "EXT_mesh_gpu_instancing");
    if (!instancing) return std::nullopt;
    const Place place(node_place, "EXT_mesh_gpu_instancing");
    const Fields extension(context, *instancing, place);
    const Place here(place, "attributes");
    const Fields attributes(context, extension.object("attributes"), here);

    const auto find = [&](const char* name) {
        const auto index = attributes.index(name, accessor_count);
        return index ? int(*index) : -1;
    };
    const int translation = find("TRANSLATION"), rotation = find("ROTATION"), scale = find("SCALE");
    std::optional<std::size_t> count;
    for (const int accessor : {translation, rotation, scale}) {
        if (accessor < 0) continue;
        if (count && *count != accessors.count(accessor)) {
            context.fail(here, "its accessors differ in count", "repair the file or export it again");
        }
        count = accessors.count(accessor);
    }
    if (!count) {
        context.warn(here, "has neither TRANSLATION, ROTATION nor SCALE; drawn once");
        return std::nullopt;
    }
    if (*count > kMostObjects)
        context.fail(here, fmt::format("{} instances are too many, at most {} are read", *count, kMostObjects),
                     "remove instances");
    std::vector<glm::dmat4> out(*count, glm::dmat4(1.0));
    if (translation >= 0) {
        const auto t = accessors.floats<3>(translation, Place(here, "TRANSLATION"));
        for (std::size_t i = 0; i < out.size(); ++i) out[i][3] = glm::dvec4(glm::dvec3(t[i]), 1.0);
    }
    if (rotation >= 0) {
        const auto r = accessors.floats<4>(rotation, Place(here, "ROTATION"));
        for (std::size_t i = 0; i < out.size(); ++i) {
            const glm::dquat q(r[i].w, r[i].x, r[i].y, r[i].z);
            const double length = glm::length(q);
            if (length > 1e-12 && std::isfinite(length)) out[i] *= glm::mat4_cast(q / length);
        }
    }
    if (scale >= 0) {
        const auto s = accessors.floats<3>(scale, Place(here, "SCALE"));
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = glm::scale(out[i], glm::dvec3(s[i]));
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (!is_usable(out[i]))
            context.fail(here, fmt::format("the transform of instance {} is not finite", i), "repair the file");
    }
    return out;
}

}  // namespace si::gltf
