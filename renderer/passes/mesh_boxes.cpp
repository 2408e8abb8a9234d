#include "renderer/passes/mesh_boxes.h"

#include <memory>
#include <optional>

#include "renderer/scene/clusters.h"

namespace si {
namespace {

struct BoxesOfMesh {
    std::vector<Bounds> clusters;
    std::optional<std::vector<Bounds>> runs;
};

struct BoxesOfMeshes {
    std::shared_ptr<const Rig> rig;  ///< of poses that share their rigid meshes; held, so that no other takes its place
    std::uint64_t scene = 0;         ///< where there is none
    std::vector<BoxesOfMesh> meshes;
};

BoxesOfMesh& boxes_of(const FrameState& f, std::size_t mesh) {
    BoxesOfMeshes& known = f.gl.owned.get<BoxesOfMeshes>();
    const Scene& scene = f.scene;
    if (known.rig != scene.rig || (!scene.rig && known.scene != scene.id) || known.meshes.size() != scene.meshes.size())
        known = {scene.rig, scene.id, std::vector<BoxesOfMesh>(scene.meshes.size())};
    return known.meshes[mesh];
}

}  // namespace

std::span<const Bounds> clusters_of_mesh(const FrameState& f, std::size_t mesh) {
    const Mesh& m = f.scene.meshes[mesh];
    if (m.deformer) return {&m.bounds, 1};
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
