// Validation of array sizes, references between arrays, and the node graph.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/gltf/rules.h"

namespace si::gltf {
namespace {

constexpr std::size_t kDeepestNode = 4096;
constexpr std::size_t kMostModelBytes = std::size_t{512} << 20;

void check_primitive(const Context& context, const Json& root, const Json& primitive, const Place& place,
                     const Sizes& sizes) {
    const Fields fields(context, primitive, place);
    const auto check_attributes = [&](const Json& attributes, const Place& here) {
        if (!attributes.is_object()) context.fail(here, "is not an object");
        for (const auto& [name, accessor] : attributes.items()) {
            checked_index(context, accessor, Place(here, name), sizes.accessors);
        }
    };
    check_attributes(fields.object("attributes"), Place(place, "attributes"));
    fields.index("material", sizes.materials);
    fields.whole("mode", 6);
    if (const auto indices = fields.index("indices", sizes.accessors);
        indices && !root["accessors"][*indices].contains("bufferView")) {
        context.fail(Place(place, "indices"), fmt::format("accessor {} has no bufferView", *indices));
    }
    const auto targets = primitive.find("targets");
    if (targets == primitive.end()) return;
    if (!targets->is_array()) context.fail(Place(place, "targets"), "is not an array");
    for (std::size_t t = 0; t < targets->size(); ++t) {
        check_attributes((*targets)[t], Place(place, "targets", t));
    }
}

void check_meshes(Context& context, const Json& root, const Sizes& sizes) {
    for (std::size_t i = 0; i < sizes.meshes; ++i) {
        const Place place("meshes", i);
        const Json& mesh = root["meshes"][i];
        const auto primitives = mesh.find("primitives");
        if (primitives == mesh.end() || !primitives->is_array()) {
            context.fail(Place(place, "primitives"), "is not an array");
        }
        if (primitives->empty()) context.warn(Place(place, "primitives"), "is empty; the mesh draws nothing");
        for (std::size_t p = 0; p < primitives->size(); ++p) {
            check_primitive(context, root, (*primitives)[p], Place(place, "primitives", p), sizes);
        }
    }
}

void check_node_fields(const Context& context, const Json& node, const Place& place, const Sizes& sizes) {
    const Fields fields(context, node, place);
    fields.index("mesh", sizes.meshes);
    fields.index("camera", sizes.cameras);
    fields.index("skin", sizes.skins);
    fields.numbers("translation", 3);
    fields.numbers("rotation", 4);
    fields.numbers("scale", 3);
    if (const auto m = fields.numbers("matrix", 16)) {
        if ((*m)[3] != 0 || (*m)[7] != 0 || (*m)[11] != 0 || (*m)[15] == 0) {
            // A zero matrix flattens everything to a point; anything else here is a projection.
            const bool zero = std::all_of(m->begin(), m->end(), [](double v) { return v == 0; });
            if (!zero) context.fail(Place(place, "matrix"), "its last row is not 0 0 0 1 (a projection)");
        }
    }
}

/// Returns the parent of each node. @throws Error when a node has two
std::vector<std::size_t> check_parents(const Context& context, const Json& root, const Sizes& sizes) {
    std::vector<std::size_t> parent(sizes.nodes, sizes.nodes);
    for (std::size_t i = 0; i < sizes.nodes; ++i) {
        const Place place("nodes", i);
        const Json& node = root["nodes"][i];
        check_node_fields(context, node, place, sizes);
        for (const std::size_t child : Fields(context, node, place).indices("children", sizes.nodes)) {
            if (parent[child] != sizes.nodes) {
                context.fail(Place(place, "children"),
                             fmt::format("node {} is already a child of node {}", child, parent[child]));
            }
            parent[child] = i;
        }
    }
    return parent;
}

void check_depth(const Context& context, const std::vector<std::size_t>& parent) {
    // Depth of each node; 0: unknown. More than kDeepestNode steps upwards are a cycle or too deep a chain.
    std::vector<std::size_t> depth(parent.size(), 0), chain;
    for (std::size_t i = 0; i < parent.size(); ++i) {
        chain.clear();
        std::size_t at = i;
        while (at != parent.size() && depth[at] == 0) {
            chain.push_back(at);
            if (chain.size() > kDeepestNode) {
                context.fail(Place("nodes", i), fmt::format("has more than {} ancestors, or is its own", kDeepestNode),
                             "flatten the hierarchy or repair the cycle");
            }
            at = parent[at];
        }
        std::size_t level = at == parent.size() ? 0 : depth[at];
        if (level + chain.size() > kDeepestNode) {
            context.fail(Place("nodes", i), fmt::format("lies more than {} levels deep", kDeepestNode),
                         "flatten the hierarchy");
        }
        for (auto it = chain.rbegin(); it != chain.rend(); ++it) depth[*it] = ++level;
    }
}

void check_scenes(Context& context, const Json& root, const Sizes& sizes) {
    const Place top("scene");
    if (const auto scene = root.find("scene"); scene != root.end()) checked_index(context, *scene, top, sizes.scenes);
    std::vector<std::size_t> seen_in(sizes.nodes, sizes.scenes);
    for (std::size_t i = 0; i < sizes.scenes; ++i) {
        const Place place("scenes", i);
        for (const std::size_t node : Fields(context, root["scenes"][i], place).indices("nodes", sizes.nodes)) {
            if (seen_in[node] == i) context.warn(Place(place, "nodes"), fmt::format("node {} is listed twice", node));
            seen_in[node] = i;
        }
    }
}

void check_skins(const Context& context, const Json& root, const Sizes& sizes) {
    for (std::size_t i = 0; i < sizes.skins; ++i) {
        const Place place("skins", i);
        const Fields fields(context, root["skins"][i], place);
        const auto joints = fields.indices("joints", sizes.nodes);
        if (joints.empty()) context.fail(Place(place, "joints"), "is missing or empty");
        fields.index("skeleton", sizes.nodes);
        const auto matrices = fields.index("inverseBindMatrices", sizes.accessors);
        if (!matrices) continue;
        const Json& accessor = root["accessors"][*matrices];
        if (accessor["type"] != "MAT4" || accessor["componentType"] != 5126 || accessor["count"] < joints.size()) {
            context.fail(
                Place(place, "inverseBindMatrices"),
                fmt::format("accessor {} is not one float MAT4 for each of {} joints", *matrices, joints.size()));
        }
    }
}

}  // namespace

Sizes check_arrays(const Context& context, const Json& root) {
    Sizes sizes;
    // Approximate bytes that tinygltf and the scene need for an empty element.
    struct Row {
        const char* name;
        std::size_t& size;
        std::size_t bytes;
    };
    const std::array rows{Row{"buffers", sizes.buffers, 256},      Row{"bufferViews", sizes.views, 512},
                          Row{"accessors", sizes.accessors, 768},  Row{"meshes", sizes.meshes, 512},
                          Row{"nodes", sizes.nodes, 1024},         Row{"scenes", sizes.scenes, 512},
                          Row{"materials", sizes.materials, 4096}, Row{"textures", sizes.textures, 512},
                          Row{"samplers", sizes.samplers, 512},    Row{"images", sizes.images, 512},
                          Row{"cameras", sizes.cameras, 256},      Row{"skins", sizes.skins, 512},
                          Row{"animations", sizes.animations, 512}};
    std::size_t total = 0;
    for (const Row& row : rows) {
        const auto it = root.find(row.name);
        if (it == root.end()) continue;
        const Place place(row.name);
        if (!it->is_array()) context.fail(place, "is not an array");
        row.size = it->size();
        total += row.size * row.bytes;
        if (total > kMostModelBytes) {
            context.fail(place, fmt::format("{} elements would take more than {} MiB", row.size, kMostModelBytes >> 20),
                         "merge or remove elements");
        }
        for (std::size_t i = 0; i < it->size(); ++i) {
            if (!(*it)[i].is_object()) {
                context.fail(Place(row.name, i), "is not an object");
            }
        }
    }
    return sizes;
}

void check_graph(Context& context, const Json& root, const Sizes& sizes) {
    check_meshes(context, root, sizes);
    check_depth(context, check_parents(context, root, sizes));
    check_scenes(context, root, sizes);
    check_skins(context, root, sizes);
}

}  // namespace si::gltf
