// Facts that passes find of the casters once and keep between frames.
#pragma once

#include <optional>

#include "renderer/passes/caster_content.h"
#include "renderer/passes/casters.h"
#include "renderer/scene/per_mesh.h"

namespace si {

/// Sides of meshes and keys of their content, each found when first needed. One object a renderer
/// (Resources::caster_findings).
struct CasterFindings {
    OfMeshes<std::optional<MeshSides>> sides;
    OfMeshes<RigidMeshKeys> rigid_content;
    CasterContentCache content;
};

}  // namespace si
