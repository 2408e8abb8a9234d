#include "renderer/passes/mesh_boxes.h"

#include "renderer/passes/scene_findings.h"

namespace si {
namespace {

BoxesOfMesh& boxes_of(const FrameState& f, std::size_t mesh) {
    return f.gl.found->boxes.of(f.scene, mesh);
}

}  // namespace

std::span<const Cluster> clusters_of_mesh(const FrameState& f, std::size_t mesh) {
    const Mesh& m = f.scene.meshes[mesh];
    if (m.deformer) return {};
    BoxesOfMesh& boxes = boxes_of(f, mesh);
    if (boxes.clusters.empty()) boxes.clusters = clusters_of(m);
    return boxes.clusters;
}

std::span<const Bounds> run_boxes_of_mesh(const FrameState& f, std::size_t mesh) {
    if (f.scene.meshes[mesh].deformer) return {};
    BoxesOfMesh& boxes = boxes_of(f, mesh);
    if (!boxes.runs) boxes.runs = run_boxes_of(f.scene.meshes[mesh]);
    return *boxes.runs;
}

}  // namespace si
