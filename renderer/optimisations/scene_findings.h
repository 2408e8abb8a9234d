// Facts that optimisations find of a scene once and keep between frames.
#pragma once

#include "renderer/optimisations/map_extents.h"
#include "renderer/optimisations/mesh_boxes.h"
#include "renderer/optimisations/visible_objects.h"
#include "renderer/scene/per_mesh.h"

namespace si {

/// Boxes of meshes and the parts that the camera sees, each found when first needed. One object a renderer
/// (Resources::found).
struct SceneFindings {
    OfMeshes<BoxesOfMesh> boxes;
    SeenFromCamera seen;
    SeenObjects seen_objects;
};

}  // namespace si
