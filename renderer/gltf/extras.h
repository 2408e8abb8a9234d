// What this program's exporter keeps in glTF extras, where the format has no place for it.
#pragma once

#include "renderer/gltf/context.h"
#include "renderer/gltf/json_guard.h"
#include "renderer/scene/scene.h"

namespace si::gltf {

/// The member under which the exporter writes, so that other programs' extras mean nothing here.
inline constexpr const char* kExtrasKey = "shadow_inspector";

/// Sentence and suggested settings of the scene that is shown. What is no setting, or no value of it, is left out with
/// a warning.
void read_scene_extras(Context& context, const Json& root, int scene_index, Scene& scene);

/// Whether the exporter marked a number of a camera ("znear_automatic") as a stand-in.
bool is_automatic_camera_field(const Json& camera, const char* name);

}  // namespace si::gltf
