// Facts about casters that passes compute once and keep between frames.
#pragma once

#include <optional>

#include "renderer/passes/caster_content.h"
#include "renderer/passes/casters.h"
#include "renderer/scene/per_mesh.h"

namespace si {

/// Cache of mesh sides and content keys of casters, each computed when first needed. One object for each renderer
/// (Resources::caster_findings).
struct CasterFindings {
    OfMeshes<std::optional<MeshSides>> sides;
    OfMeshes<RigidMeshKeys> rigid_content;
    CasterContentCache content;
};

}  // namespace si
