// Marks over one scene picture: the probed pixel, the pixels that read a texel, numbers under the mouse.
#pragma once

#include <imgui.h>

#include <string>

#include "ui/state/editor_ui.h"
#include "ui/widgets/theme.h"

namespace si {

// `origin` and `size` are the picture's place on the screen.

void draw_probe_mark(const EditorState& state, const FrameResult& result, ImVec2 origin, ImVec2 size);

/// The pixels whose kernels read the texel under the mouse in the map viewer.
void draw_readers(const EditorState& state, const EditorFrame& frame, ImVec2 origin, ImVec2 size);

/// The pixel under the mouse and the value of the pane's overlay there.
void hover_readout(const EditorFrame& frame, const Pane& pane, ImVec2 origin, glm::ivec2 pixel);

/// The pixels around state.loupe_pixel, large, with a grid, the middle one's colour and visibility, in a corner.
void draw_loupe(const EditorState& state, const EditorFrame& frame, ImVec2 origin, ImVec2 size);

/// Text on a picture, readable over anything.
void veiled_text(ImVec2 at, const std::string& text, ImU32 colour = theme::kOnPicture);

}  // namespace si
