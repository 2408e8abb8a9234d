// How lights and their handles look in the scene picture.
#pragma once

#include "ui/scene_view/light_drag.h"
#include "ui/scene_view/picture_painter.h"

namespace si {

/// Frustum, place, cone and aim of the light whose handles are shown; at the picture's edge a pointer to a light
/// outside.
/// @param busy it is hovered or dragged: else its lines are faint
void draw_shown_light(const PicturePainter& painter, const LightPose& pose, bool busy, bool pointer_hovered);
/// Where that pointer stands; nothing when the light is in the picture.
std::optional<glm::dvec2> pointer_place(const LightPose& pose, const PictureView& view);
/// A faint frustum and a mark where the light stands.
void draw_other_light(const PicturePainter& painter, const LightPose& pose, const FittedLight& fitted, bool hovered);

void draw_handles(const PicturePainter& painter, const LightPose& pose, std::optional<LightHandle> hovered);
/// What a drag changes, beside the handle.
void draw_numbers(const PicturePainter& painter, const LightPose& pose, LightHandle handle, int map_resolution);
void handle_tooltip(const LightPose& pose, LightHandle handle);

}  // namespace si
