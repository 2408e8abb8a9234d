// Drawing of lights and their handles in the scene picture.
#pragma once

#include "ui/scene_view/light_drag.h"
#include "ui/scene_view/picture_painter.h"

namespace si {

/// Draws frustum, place, cone and target of the shown light. A light outside gets a pointer at the picture's edge.
/// @param busy the light is hovered or dragged; else its lines are faint
void draw_shown_light(const PicturePainter& painter, const LightPose& pose, bool busy, bool pointer_hovered);
/// Returns the place of that pointer, pixels; nothing if the light is in the picture.
std::optional<glm::dvec2> pointer_place(const LightPose& pose, const PictureView& view);
/// Draws a faint frustum and a mark at the light's place.
void draw_other_light(const PicturePainter& painter, const LightPose& pose, const FittedLight& fitted, bool hovered);

/// Draws the handles of the shown light.
void draw_handles(const PicturePainter& painter, const LightPose& pose, std::optional<LightHandle> hovered);
/// Draws the numbers that a drag changes, next to the handle.
void draw_numbers(const PicturePainter& painter, const LightPose& pose, LightHandle handle, int map_resolution);
/// Draws the tooltip of a hovered handle.
void handle_tooltip(const LightPose& pose, LightHandle handle);

}  // namespace si
