// Data in glTF extras that this program's exporter writes where the format has no field.
#pragma once

#include "renderer/gltf/context.h"
#include "renderer/gltf/json_guard.h"
#include "renderer/scene/scene.h"

namespace si::gltf {

/// Member of extras under which the exporter writes; extras of other programs are ignored.
inline constexpr const char* kExtrasKey = "shadow_inspector";

/// Reads description and suggested settings of a scene from its glTF extras. Unknown settings and values are skipped
/// with a warning. @param scene_index scene of the file; -1: the default one
void read_scene_extras(Context& context, const Json& root, int scene_index, Scene& scene);

/// Reads what an importer says of a converted model in the extras of its asset: notes, which become warnings, up axis
/// and unit of the original file.
void read_importer_extras(Context& context, const Json& root, Scene& scene);

/// Returns true when the exporter marked a number of a camera as automatic. @param name "znear_automatic"
bool is_automatic_camera_field(const Json& camera, const char* name);

}  // namespace si::gltf
