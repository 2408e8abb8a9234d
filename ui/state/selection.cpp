#include "ui/state/selection.h"

#include <cmath>

namespace si {
namespace {

int node_of(const Scene& scene, const std::string& path) {
    if (path.empty()) return -1;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].path == path) return int(i);
    return -1;
}

/// What a node places, in its own coordinates; mesh bounds are local.
Bounds local_bounds(const Scene& scene, int node) {
    Bounds all;
    for (const Object& o : scene.objects)
        if (o.node == node) all.add(scene.meshes[std::size_t(o.mesh)].bounds.transformed(o.instance));
    return all;
}

}  // namespace

std::optional<Box> box_of(const Scene& scene, const std::string& path) {
    const int node = node_of(scene, path);
    if (node < 0) return {};
    const Bounds local = local_bounds(scene, node);
    if (local.empty() || !std::isfinite(local.radius())) return {};
    return local.corners(scene.nodes[std::size_t(node)].world);
}

Bounds bounds_of(const Scene& scene, const std::string& path) {
    Bounds bounds;
    if (const auto corners = box_of(scene, path))
        for (const glm::dvec3& p : *corners) bounds.add(p);
    return bounds;
}

}  // namespace si
