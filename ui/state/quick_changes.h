// What single keys change of the settings.
#pragma once

#include <optional>
#include <string>

#include "renderer/settings/settings.h"

namespace si {

struct EditorFrame;
struct EditorState;

/// All bias away, as when an engine's numbers are looked for anew.
void remove_bias(Settings& settings);
/// The shown light becomes the next type there is; nothing without a light.
void next_light_type(Settings& settings);
/// Twice as many texels a side, or half as many, within what the setting takes.
void scale_resolution(Settings& settings, bool twice);
/// Applies the remedy that the judged light's verdict names; where there is none the log says why. While the verdict is
/// of an earlier picture, or being found, the wish is kept.
void apply_fix(EditorState& state, const EditorFrame& frame);
/// Fulfils it. Call once a frame.
void follow_fix(EditorState& state, const EditorFrame& frame);

/// A place of a light's map.
struct TexelPlace {
    int light = 0, face = 0;
    double u = 0, v = 0;  ///< middle of a texel, 0..1
};
/// Shows the texels around the place as quads at their stored depths, or hides those that are there.
void toggle_quads(Settings& settings, const TexelPlace& place);
bool quads_at(const Settings& settings, const TexelPlace& place);
/// Where the pixel under the mouse, else the probed one, is looked up in the shown light's map; nothing outside of it.
std::optional<TexelPlace> pointed_place(const EditorState& state, const EditorFrame& frame);
/// toggle_quads() there; the log says what became of it.
void point_quads(EditorState& state, const EditorFrame& frame);

}  // namespace si
