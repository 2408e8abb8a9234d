// Marks over one scene picture: the probed pixel, readers of a texel, numbers under the mouse.
#pragma once

#include <imgui.h>

#include <string>

#include "ui/state/editor_ui.h"
#include "ui/widgets/theme.h"

namespace si {

// `origin` and `size` are the picture's place on the screen.

/// Draws a cross at the probed pixel.
void draw_probe_mark(const EditorState& state, const FrameResult& result, ImVec2 origin, ImVec2 size);

/// Marks the pixels whose kernels read the texel under the mouse in the map viewer.
void draw_readers(const EditorState& state, const EditorFrame& frame, ImVec2 origin, ImVec2 size);

/// Draws the coordinates of the pixel under the mouse and the overlay's value there.
void hover_readout(const EditorFrame& frame, const Pane& pane, ImVec2 origin, glm::ivec2 pixel);

/// Draws the enlarged pixels around state.loupe_pixel in a corner, with colour and visibility of the middle one.
void draw_loupe(const EditorState& state, const EditorFrame& frame, ImVec2 origin, ImVec2 size);

/// Draws text on a dark veil, readable over any picture.
void veiled_text(ImVec2 at, const std::string& text, ImU32 colour = theme::kOnPicture);

}  // namespace si
