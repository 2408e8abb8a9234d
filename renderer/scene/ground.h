// The ground that a loaded model is stood on where its file has none: it shows the shadow.
#pragma once

#include "renderer/scene/scene.h"

namespace si {

/// Whether the scene brings what shadows fall on: level surfaces at its bottom that do not lie under a
/// roof, or a landscape, over most of its width.
bool has_level_surface(const Scene& scene);

/// Puts a disc under the scene as it stands, wide enough for shadows of lights from half way up: an object that
/// receives, never casts and is no part of Scene::bounds, the last of its kind in each of the scene's lists. Nothing
/// happens where there is one, where there is a level surface (Scene::has_floor, found out once), or where there is
/// nothing to stand on it.
void add_ground(Scene& scene);

/// Takes it away again.
void remove_ground(Scene& scene);

}  // namespace si
