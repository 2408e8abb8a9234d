// Draw functions of the editor's panels, one file each. Each fills the current child window.
#pragma once

#include <imgui.h>

#include "renderer/base/lengths_text.h"
#include "ui/scene_view/picture_view.h"
#include "ui/state/editor_ui.h"
#include "ui/state/light_list.h"
#include "ui/state/scene_choices.h"
#include "ui/widgets/progress_bar.h"

namespace si {

struct Trial;

/// Draws the row of menus, scene, presets, undo and save.
void draw_top_bar(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the scene pictures with their toolbar and marks, and steers camera and lights by the mouse.
void draw_viewport(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the shadow map with its toolbar, marks and plots.
void draw_map_viewer(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the inspector on the right: tabs of settings, objects, lights, the probed pixel, and improvements.
void draw_inspector(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the strip below the pictures: tabs of plots and tables. While it is closed, its tabs alone.
void draw_strip(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Returns the height of the closed strip, pixels.
float closed_strip_height();
/// Draws all settings, with search.
void draw_settings(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the list of lights with all settings of the shown light.
void draw_lights_page(EditorState& state, const EditorFrame& frame);
/// Draws the probed pixel: its shadow test, verdict and cross-section.
void draw_probe(EditorState& state, const EditorFrame& frame);
/// Draws the errors of the shown light's shadows in numbers, by cause.
void draw_error(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the tree of the scene's nodes with their settings.
void draw_objects(EditorState& state, const EditorFrame& frame);
/// Draws the welcome window, while state.window.show_welcome is set.
void draw_welcome(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the animation's controls. Call only while time_bar_height() is not 0.
void draw_time_bar(EditorState& state, const EditorFrame& frame);
/// Returns the height of the animation's controls, pixels; 0: the scene has no animation.
float time_bar_height(const EditorFrame& frame);
/// Draws the note of the open preset and the offer to restore a lost session, each if there is one.
/// @param width pixels; the height follows the text
void draw_strips(EditorState& state, const EditorFrame& frame, EditorRequests& requests, float width);

/// Returns the sequence of presets that the open preset belongs to: the hard cases, or else the guided presets.
std::span<const PresetEntry> open_preset_sequence(const EditorState& state, const EditorFrame& frame);
/// Returns the key of the preset `step` places after the open preset in its sequence; none beyond either end.
std::optional<std::string> neighbour_preset(const EditorState& state, const EditorFrame& frame, int step);

/// Draws the colour scale of a pane's overlay, with numbers and unit, over its picture's lower left corner. Overlays
/// with one colour for each view of a light list these colours, with range and texel size. @param left, bottom the
/// corner, pixels of the screen @param room the size of the picture, pixels @param light the light; null: none
/// @param map_size texels of each view's map
void draw_legend(const Pane& pane, const FittedLight* light, MapSize map_size, float left, float bottom, ImVec2 room);

/// Draws sliders for opacity and scale of a pane's overlay, below its legend.
void draw_legend_widgets(Settings& settings, const Pane& pane, float left, float bottom, ImVec2 room);
/// Returns the width of draw_legend_widgets(), pixels.
float legend_widgets_width(const Settings& settings, const Pane& pane);
/// Returns the height of draw_legend_widgets(), pixels; 0: the picture is too small for sliders.
float legend_widgets_height(const Settings& settings, const Pane& pane, ImVec2 room);

/// Draws the colours of the artefact overlay with their causes and pixel counts, in its picture's corner.
void draw_artefact_legend(const LiveError* error, float left, float bottom, float room);

/// Formats the progress of the ray-traced reference, or the time that tracing took. Requires frame.reference.
std::string reference_status(const EditorFrame& frame);

/// Draws the progress of the traced rays over a picture whose overlay waits for the reference.
void draw_tracing(const EditorFrame& frame, EditorRequests& requests, float left, float bottom, float width);

/// Draws the combo that chooses the view of the picture comparison (swipe, side by side, difference). @param width
/// pixels
void comparison_view_widget(EditorState& state, float width);
/// Draws the combo that chooses what the shown picture is compared with: the reference, or other settings.
/// @param width pixels
void comparison_other_widget(EditorState& state, const EditorFrame& frame, float width);
/// Returns the chosen view of the picture comparison, also while a held key shows another view.
ComparisonView chosen_comparison(const EditorState& state);
/// Drags the line of the swipe comparison with the mouse. Call before the picture's own gestures. Returns true if the
/// line has taken the press.
bool steer_swipe(EditorState& state, const PictureView& view);
/// Draws the compared picture (right of the swipe's line, side by side or as a difference) and the names of both sides.
/// @param lo the upper left corner of the picture, pixels of the screen
/// @param size the size of the picture, pixels
void draw_comparison(const EditorState& state, const EditorFrame& frame, glm::vec2 lo, glm::vec2 size, bool right_half);

/// Pins the present settings as A, to compare later settings with. While no pictures are compared, A becomes the side
/// that the next comparison shows. Removes the pin if the present settings are pinned already. Does nothing during the
/// flicker comparison.
void pin_settings(EditorState& state);
/// Shows settings right of the swipe's line, before they are taken.
void show_tried(EditorState& state, const Settings& settings);
/// Ends show_tried(), and restores the comparison that it replaced.
void hide_tried(EditorState& state);
/// Ends show_tried() when other settings than bias, kernel and resolution, the scene or the comparison have changed.
/// Call once a frame.
void follow_tried(EditorState& state);
/// Applies a drawn change to the settings. The log then compares the predicted errors with the measured ones
/// (check_prediction()).
void apply_trial(EditorState& state, const Trial& trial);
/// Logs the errors that a search predicted for the present settings beside the measured ones, once those are known.
/// Requests them until then. Call once a frame.
void check_prediction(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Shows the picture of the pinned settings alone, until end_flicker(). Without a pin the log says so.
void begin_flicker(EditorState& state);
/// Shows the present settings again, with the comparison that begin_flicker() has replaced.
void end_flicker(EditorState& state);

/// Draws the progress of a loading scene, with a button that cancels the loading, at the top of a picture.
/// @param left, top, width the place, pixels of the screen
void draw_loading(const EditorFrame& frame, EditorRequests& requests, float left, float top, float width);

/// Returns true while a text field has the keyboard, in this frame or from the next one on.
bool text_is_typed();

/// Makes a panel fill the window, or shows all panels again if the panel fills it already.
void toggle_maximised(EditorState& state, Panel panel);

/// Draws the status bar below all panels: last message, frame time, map's bytes and taps, picture's size, driver.
void draw_status_bar(EditorState& state, const EditorFrame& frame);
/// Returns the height of the status bar, pixels.
float status_bar_height();

}  // namespace si
