#include "renderer/optimisations/scene_findings.h"

#include "renderer/frame/state.h"

namespace si {
namespace {

MeshBoxes& boxes_of(const FrameState& f, std::size_t mesh) {
    return f.gl.found->boxes.of(f.scene, mesh);
}

}  // namespace

std::span<const Cluster> mesh_clusters(const FrameState& f, std::size_t mesh) {
    const Mesh& m = f.scene.meshes[mesh];
    if (m.deformer) return {};
    MeshBoxes& boxes = boxes_of(f, mesh);
    if (boxes.clusters.empty()) boxes.clusters = build_clusters(m);
    return boxes.clusters;
}

std::span<const Bounds> mesh_run_boxes(const FrameState& f, std::size_t mesh) {
    if (f.scene.meshes[mesh].deformer) return {};
    MeshBoxes& boxes = boxes_of(f, mesh);
    if (!boxes.runs) boxes.runs = index_run_boxes(f.scene.meshes[mesh]);
    return *boxes.runs;
}

}  // namespace si
