// Cached facts about the scene that optimisations share between frames.
#pragma once

#include "renderer/optimisations/map_extents.h"
#include "renderer/optimisations/mesh_boxes.h"
#include "renderer/optimisations/visible_objects.h"
#include "renderer/scene/per_mesh.h"

namespace si {

/// Cache of mesh boxes and of the parts of the scene that the camera sees, each computed on first use. One object a
/// renderer (Resources::found).
struct SceneFindings {
    OfMeshes<MeshBoxes> boxes;
    CameraMapReads seen;          ///< map cells read
    VisibleObjects seen_objects;  ///< draw order of the picture
};

}  // namespace si
