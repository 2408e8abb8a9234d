// Proxy scene: a small scene that needs the same shader programs as a large one, for shader warm-up.
#pragma once

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

namespace si {

/// Returns a small proxy scene that needs the same shader programs as `scene`, for compiling them early (shader
/// warm-up). It keeps the outermost objects and one object of each kind (by material, vertex attributes and object
/// settings). It keeps few of their triangles, and a few texels of each texture. Cameras and lights are those of
/// `scene`, and its bounds are nearly kept. A small scene keeps all its triangles.
Scene make_proxy_scene(const Scene& scene, const Settings& settings);

}  // namespace si
