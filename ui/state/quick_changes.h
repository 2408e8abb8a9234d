// Changes of settings that have a keyboard shortcut of their own.
#pragma once

#include "renderer/settings/settings.h"

namespace si {

struct FixRequests;

struct EditorFrame;
struct EditorState;

/// Brings the probed pixel to the front: the tab Pixel, or Improve if that is shown and puts this pixel right.
void show_pixel(EditorState& state);
/// Removes all bias: sets constant, slope, normal offset and polygon offset to 0. A bias.kind that computes the needed
/// bias itself becomes "constant".
void remove_bias(Settings& settings);
/// Changes the shown light to the next type; does nothing without a light.
void next_light_type(Settings& settings);
/// Doubles or halves map.resolution, clamped to its range.
void scale_resolution(Settings& settings, bool twice);
/// Applies the fix that the probed pixel's verdict proposes for the shown light. Without a fix the log gives the
/// reason. While the verdict is not known yet, the request waits for apply_waiting_fix().
void apply_fix(EditorState& state, const EditorFrame& frame);
/// Applies a fix that apply_fix() has requested, once the verdict is known. Call once a frame.
void apply_waiting_fix(EditorState& state, const EditorFrame& frame);
/// Requests the search for a fix of the probed pixel once its verdict is known and wrong, if the panel Pixel or a
/// waiting fix needs it. Call once a frame.
void request_pixel_fix(EditorState& state, const EditorFrame& frame, FixRequests& requests);

/// Texel of a light's shadow map.
struct TexelPlace {
    int light = 0;
    int face = 0;  ///< index of the light's view
    double u = 0;  ///< centre of the texel, 0..1
    double v = 0;  ///< centre of the texel, 0..1
};
/// Shows the map's texels around a place as quads at their stored depths in the scene; hides the quads if they are
/// shown at that place.
void toggle_quads(Settings& settings, const TexelPlace& place);
/// Returns true if quads at stored depths are shown around that texel (toggle_quads()).
bool shows_quads_at(const Settings& settings, const TexelPlace& place);
/// Shows quads at the stored depths of the map's texels around one texel, or hides them if they are shown there. The
/// texel is the one that the pixel under the mouse reads from the shown light's map. If the mouse is over no such
/// pixel, the probed pixel takes its place. The log reports the result.
void toggle_pointed_quads(EditorState& state, const EditorFrame& frame);

}  // namespace si
