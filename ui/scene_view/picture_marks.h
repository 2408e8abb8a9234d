// Marks over one scene picture: the probed pixel, readers of a texel, numbers under the mouse.
#pragma once

#include <imgui.h>

#include <string>

#include "ui/state/editor_ui.h"
#include "ui/widgets/theme.h"

namespace si {

// `origin` and `size` are the picture's place on the screen, pixels.

/// Draws a cross over the scene picture at the probed pixel.
void draw_probe_mark(const EditorState& state, const FrameResult& result, ImVec2 origin, ImVec2 size);

/// Marks the pixels whose kernels read the texel under the mouse in the map viewer.
void draw_readers(const EditorState& state, const EditorFrame& frame, ImVec2 origin, ImVec2 size);

/// Draws a readout next to the mouse: the pixel's coordinates and the overlay's value there.
void draw_hover_readout(const EditorFrame& frame, const Pane& pane, const FittedLight* light, ImVec2 origin,
                        glm::ivec2 pixel);

/// Draws the enlarged pixels around state.loupe_pixel in a corner, with colour and visibility of the middle one.
void draw_loupe(const EditorState& state, const EditorFrame& frame, ImVec2 origin, ImVec2 size);

/// Draws text on a dark background, readable over any picture. @param at the upper left corner, pixels of the screen
void draw_text_on_picture(ImVec2 at, const std::string& text, ImU32 colour = theme::kOnPicture);

}  // namespace si
