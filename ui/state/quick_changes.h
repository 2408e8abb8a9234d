// Changes of settings that have a key of their own.
#pragma once

#include <optional>
#include <string>

#include "renderer/settings/settings.h"

namespace si {

struct EditorFrame;
struct EditorState;

/// Sets all bias to 0.
void remove_bias(Settings& settings);
/// Changes the shown light to the next type; does nothing without a light.
void next_light_type(Settings& settings);
/// Doubles or halves map.resolution, clamped to its range.
void scale_resolution(Settings& settings, bool twice);
/// Applies the fix of the probed pixel's verdict for the shown light; without one the log says why. While the verdict
/// is not there yet, the request waits for follow_fix().
void apply_fix(EditorState& state, const EditorFrame& frame);
/// Applies a waiting fix once its verdict is there. Call once a frame.
void follow_fix(EditorState& state, const EditorFrame& frame);

/// A texel of a light's map.
struct TexelPlace {
    int light = 0;
    int face = 0;  ///< index of the light's view
    double u = 0;  ///< centre of the texel, 0..1
    double v = 0;  ///< centre of the texel, 0..1
};
/// Shows the texels around a place as quads at their stored depths; hides them if they are shown there.
void toggle_quads(Settings& settings, const TexelPlace& place);
/// Returns true if quads are shown at that place.
bool shows_quads_at(const Settings& settings, const TexelPlace& place);
/// Returns the shown light's texel that the pixel under the mouse, else the probed one, reads; nothing outside the map.
std::optional<TexelPlace> pointed_texel(const EditorState& state, const EditorFrame& frame);
/// Toggles the quads at pointed_texel(), and reports the result in the log.
void toggle_pointed_quads(EditorState& state, const EditorFrame& frame);

}  // namespace si
