// Changes of settings that have a keyboard shortcut of their own.
#pragma once

#include "renderer/settings/settings.h"

namespace si {

struct FixRequests;

struct EditorFrame;
struct EditorState;

/// Opens the page Pixel, which explains the probed pixel. Does nothing while the panel Improve is shown with the aim
/// "Fix this pixel".
void show_pixel(EditorState& state);
/// Removes all bias: sets constant, slope, normal offset and polygon offset to 0. A bias.kind that computes the needed
/// bias itself becomes "constant".
void remove_bias(Settings& settings);
/// Changes the shown light to the next type of light.type; the first follows the last. Does nothing without a light.
void next_light_type(Settings& settings);
/// Doubles or halves map.resolution, clamped to its range. @param twice true: doubles; false: halves
void scale_resolution(Settings& settings, bool twice);
/// Applies the fix (change of settings) that was found for the probed pixel under the shown light. If no fix exists,
/// the log gives the reason. While the search is not finished, apply_waiting_fix() applies the fix later.
void apply_fix(EditorState& state, const EditorFrame& frame);
/// Applies the fix that apply_fix() could not apply yet, once its search has ended. A click on another pixel drops it.
/// Call once a frame.
void apply_waiting_fix(EditorState& state, const EditorFrame& frame);
/// Requests the search for a fix (change of settings) of the probed pixel once the pixel is known to be wrong. Does
/// nothing if neither a shown panel nor a waiting apply_fix() needs the fix. Call once a frame.
void request_pixel_fix(EditorState& state, const EditorFrame& frame, FixRequests& requests);

/// Texel of a light's shadow map.
struct TexelPlace {
    int light = 0;
    int face = 0;  ///< index of the light's view
    double u = 0;  ///< centre of the texel, 0..1
    double v = 0;  ///< centre of the texel, 0..1
};
/// Shows the shadow map's texels around a given texel as quads at their stored depths in the scene (view.slabs). Hides
/// the quads if they are already shown around this texel.
void toggle_quads(Settings& settings, const TexelPlace& place);
/// Returns true if toggle_quads() shows quads at stored depths around this texel.
bool shows_quads_at(const Settings& settings, const TexelPlace& place);
/// Shows or hides quads at the stored depths of the shadow map (toggle_quads()), around the texel that the pixel under
/// the mouse reads. If the mouse is over no such pixel, the probed pixel takes its place. The log reports the result.
void toggle_pointed_quads(EditorState& state, const EditorFrame& frame);

}  // namespace si
