// Data in glTF extras that this program's exporter writes where the format has no field.
#pragma once

#include "renderer/gltf/context.h"
#include "renderer/gltf/json_guard.h"
#include "renderer/scene/scene.h"

namespace si::gltf {

/// Member of extras under which the exporter writes; extras of other programs are ignored.
inline constexpr const char* kExtrasKey = "shadow_inspector";

/// Reads description and suggested settings of a scene from its glTF extras, where save_gltf() writes them. Skips
/// unknown settings and values with a warning.
/// @param scene_index scene of the file; -1: the default one
void read_scene_extras(Context& context, const Json& root, int scene_index, Scene& scene);

/// Reads the extras that an importer has written into the asset of a converted model. Its notes become warnings. The up
/// axis and the unit of the original file go to `scene`, and the other files that the importer read are recorded.
void read_importer_extras(Context& context, const Json& root, Scene& scene);

/// Returns true when this program has saved a glTF camera whose near or far plane was automatic. The loader then makes
/// that plane automatic again. @param name "znear_automatic" or "zfar_automatic"
bool is_automatic_camera_field(const Json& camera, const char* name);

}  // namespace si::gltf
