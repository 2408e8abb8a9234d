// Drawing of lights and their handles in the scene picture.
#pragma once

#include "ui/scene_view/light_drag.h"
#include "ui/scene_view/picture_painter.h"

namespace si {

/// Draws the shown light (view.light) into the scene picture: frusta of its maps, rim of a spot light's cone, and
/// range. A light outside the picture gets an arrow at the picture's edge. draw_handles() draws position and target.
/// @param busy true: the light is hovered or dragged; false: its lines are faint
/// @param pointer_hovered true: the arrow is highlighted
void draw_shown_light(const PicturePainter& painter, const LightPose& pose, bool busy, bool pointer_hovered);
/// Returns the place of the arrow that points to a light outside the picture, pixels of the screen. Nothing if the
/// light is inside.
std::optional<glm::dvec2> pointer_place(const LightPose& pose, const PictureView& view);
/// Draws a light that is not the shown one (view.light) into the scene picture: faint frusta of its maps and a mark at
/// its position. Point lights have no frusta.
void draw_other_light(const PicturePainter& painter, const LightPose& pose, const FittedLight& fitted, bool hovered);

/// Draws the handles, position and direction of the shown light into the scene picture.
/// @param hovered the handle under the mouse; none: no handle
void draw_handles(const PicturePainter& painter, const LightPose& pose, std::optional<LightHandle> hovered);
/// Draws the name and the numbers of a light's handle that is being dragged, next to the handle.
/// @param map_size size of the shadow map, for the texel size at extent handles
void draw_numbers(const PicturePainter& painter, const LightPose& pose, LightHandle handle, MapSize map_size);
/// Draws the tooltip of a light's handle under the mouse: name, numbers and use.
void handle_tooltip(const LightPose& pose, LightHandle handle);

}  // namespace si
