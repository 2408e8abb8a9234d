// What passes find of a scene once and keep between frames.
#pragma once

#include <optional>

#include "renderer/passes/caster_content.h"
#include "renderer/passes/casters.h"
#include "renderer/passes/map_extents.h"
#include "renderer/passes/mesh_boxes.h"
#include "renderer/passes/of_meshes.h"

namespace si {

/// Facts about meshes, casters and what the camera sees, each found when first needed. One object a renderer
/// (Resources::found), read through the functions of the headers above.
struct SceneFindings {
    OfMeshes<BoxesOfMesh> boxes;
    OfMeshes<std::optional<SidesOfMesh>> sides;
    OfMeshes<RigidContent> rigid_content;
    KnownContent content;
    SeenFromCamera seen;
};

}  // namespace si
