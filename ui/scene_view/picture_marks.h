// Marks over one scene picture: the probed pixel, readers of a texel, numbers under the mouse.
#pragma once

#include <imgui.h>

#include <string>

#include "ui/state/editor_ui.h"
#include "ui/widgets/theme.h"

namespace si {

// `origin` and `size` are the picture's place on the screen, pixels.

/// Draws a cross over the scene picture at the probed pixel. @param origin, size place of the picture on the screen,
/// pixels
void draw_probe_mark(const EditorState& state, const FrameResult& result, ImVec2 origin, ImVec2 size);

/// Marks the pixels of the scene picture whose kernels read the shadow-map texel under the mouse in the map viewer.
/// @param origin, size place of the picture on the screen, pixels
void draw_readers(const EditorState& state, const EditorFrame& frame, ImVec2 origin, ImVec2 size);

/// Draws the coordinates of the pixel under the mouse, and the overlay's value there, in the upper left corner of the
/// picture.
/// @param light light whose views (such as cascades) the overlay shows by colour; null: not known
/// @param origin upper left corner of the picture, or of its part below a caption, pixels of the screen
void draw_hover_readout(const EditorFrame& frame, const Pane& pane, const FittedLight* light, ImVec2 origin,
                        glm::ivec2 pixel);

/// Draws the enlarged pixels around state.loupe_pixel in an upper corner of the scene picture, with colour and
/// visibility of the middle one. @param origin, size place of the picture on the screen, pixels
void draw_loupe(const EditorState& state, const EditorFrame& frame, ImVec2 origin, ImVec2 size);

/// Draws text on a dark background, readable over any picture. @param at upper left corner of the text, pixels of the
/// screen
void draw_text_on_picture(ImVec2 at, const std::string& text, ImU32 colour = theme::kOnPicture);

}  // namespace si
