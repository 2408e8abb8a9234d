// Drawing of lights and their handles in the scene picture.
#pragma once

#include "ui/scene_view/light_drag.h"
#include "ui/scene_view/picture_painter.h"

namespace si {

/// Draws frustum, position, cone and target of the shown light. A light outside the picture gets a pointer at the
/// picture's edge. @param busy true: the light is hovered or dragged; else its lines are faint
void draw_shown_light(const PicturePainter& painter, const LightPose& pose, bool busy, bool pointer_hovered);
/// Returns the position of the pointer to a light outside the picture, pixels; nothing if the light is inside.
std::optional<glm::dvec2> pointer_place(const LightPose& pose, const PictureView& view);
/// Draws a light that is not the shown one: a faint frustum and a mark at its position.
void draw_other_light(const PicturePainter& painter, const LightPose& pose, const FittedLight& fitted, bool hovered);

/// Draws the handles of the shown light. @param hovered the handle under the mouse
void draw_handles(const PicturePainter& painter, const LightPose& pose, std::optional<LightHandle> hovered);
/// Draws the numbers that a drag of a light's handle changes, next to the handle.
void draw_numbers(const PicturePainter& painter, const LightPose& pose, LightHandle handle, MapSize map_size);
/// Draws the tooltip of a hovered light handle: its name and numbers.
void handle_tooltip(const LightPose& pose, LightHandle handle);

}  // namespace si
