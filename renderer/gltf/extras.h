// Data in glTF extras that this program's exporter writes where the format has no field.
#pragma once

#include "renderer/gltf/context.h"
#include "renderer/gltf/json_guard.h"
#include "renderer/scene/scene.h"

namespace si::gltf {

/// Key of this program's object in glTF extras, which its exporter and importers write; other keys are ignored.
inline constexpr const char* kExtrasKey = "shadow_inspector";

/// Reads description and suggested settings of a scene from its glTF extras, where save_gltf() writes them. Skips
/// unknown settings and values with a warning.
/// @param scene_index index of the scene in the file; -1: the file's default scene
void read_scene_extras(Context& context, const Json& root, int scene_index, Scene& scene);

/// Reads the extras that an importer has written into the asset of a converted model. The importer's notes become
/// warnings. The up axis and the unit of the original file go to `scene`. The files that the importer read besides the
/// model are recorded by Context::note_file().
void read_importer_extras(Context& context, const Json& root, Scene& scene);

/// Returns true when the extras of a glTF camera, as save_gltf() writes them, mark its near or far plane as automatic.
/// The loader then ignores the distance that the camera states for this plane.
/// @param name "znear_automatic" or "zfar_automatic"
bool is_automatic_camera_field(const Json& camera, const char* name);

}  // namespace si::gltf
