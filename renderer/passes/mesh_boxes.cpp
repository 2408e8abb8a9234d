#include "renderer/passes/mesh_boxes.h"

#include <optional>

#include "renderer/passes/of_meshes.h"

namespace si {
namespace {

struct BoxesOfMesh {
    std::vector<Cluster> clusters;
    std::optional<std::vector<Bounds>> runs;
};

BoxesOfMesh& boxes_of(const FrameState& f, std::size_t mesh) {
    return f.gl.owned.get<OfMeshes<BoxesOfMesh>>().of(f.scene, mesh);
}

}  // namespace

std::span<const Cluster> clusters_of_mesh(const FrameState& f, std::size_t mesh) {
    const Mesh& m = f.scene.meshes[mesh];
    if (m.deformer) return {};
    BoxesOfMesh& boxes = boxes_of(f, mesh);
    if (boxes.clusters.empty()) boxes.clusters = build_clusters(m);
    return boxes.clusters;
}

std::span<const Bounds> run_boxes_of_mesh(const FrameState& f, std::size_t mesh) {
    if (f.scene.meshes[mesh].deformer) return {};
    BoxesOfMesh& boxes = boxes_of(f, mesh);
    if (!boxes.runs) boxes.runs = index_run_boxes(f.scene.meshes[mesh]);
    return *boxes.runs;
}

}  // namespace si
