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

/// Draws the bar at the top of the editor: menus, scene, presets, undo and save.
void draw_top_bar(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the scene pictures with their toolbar and marks, and moves camera and lights with the mouse.
void draw_viewport(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the map viewer: the shadow map with its toolbar, marks and plots.
void draw_map_viewer(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the inspector, the panel on the right: tabs of settings, objects, lights, the probed pixel and improvements.
void draw_inspector(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the strip, the panel below the pictures: tabs of plots and tables. Draws only the tabs while the strip is
/// closed.
void draw_strip(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Returns the height of the closed strip (the panel below the pictures, only its tabs), pixels.
float closed_strip_height();
/// Draws the page Settings of the inspector: all settings, with search.
void draw_settings(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the page Lights of the inspector: the list of lights, and all settings of the shown light.
void draw_lights_page(EditorState& state, const EditorFrame& frame);
/// Draws the page Pixel of the inspector, about the probed pixel: shadow test, verdict, and cross-section along the
/// light's ray.
void draw_probe(EditorState& state, const EditorFrame& frame);
/// Draws the page Error of the strip (the panel below the pictures): errors of the shown light's shadows against the
/// ray-traced reference, in numbers and by cause.
void draw_error(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the page Objects of the inspector: the tree of the scene's nodes with their settings.
void draw_objects(EditorState& state, const EditorFrame& frame);
/// Draws the welcome window, while state.window.show_welcome is set.
void draw_welcome(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Draws the controls of the animation: play, time, speed and loop. Call only while time_bar_height() is not 0.
void draw_time_bar(EditorState& state, const EditorFrame& frame);
/// Returns the height of the controls that draw_time_bar() draws, pixels; 0: the scene has no animation.
float time_bar_height(const EditorFrame& frame);
/// Draws the notes above the pictures, each only while it applies. Subjects: reset of the graphics driver, session left
/// by a crash, saved scene files, far-off objects, z-up scene, open preset. @param width pixels; the height follows the
/// text
void draw_notes(EditorState& state, const EditorFrame& frame, EditorRequests& requests, float width);

/// Returns the built-in presets that the buttons Next and Previous step through. These are the hard cases (corner cases
/// of shadow maps) if a hard case is open, else the guided presets (with a sentence on what to look at).
std::span<const PresetEntry> open_preset_sequence(const EditorState& state, const EditorFrame& frame);
/// Returns the key of the preset `step` places after the open one in open_preset_sequence(); none beyond either end. If
/// no preset of the list is open, returns the first, or the last for a negative step.
std::optional<std::string> neighbour_preset(const EditorState& state, const EditorFrame& frame, int step);

/// Draws the colour scale of a pane's overlay, with numbers and unit, over the lower left corner of the pane's scene
/// picture. For an overlay with one colour for each view of the light, lists the views instead, with range and texel
/// size.
/// @param light the shown light; null: none @param map_size texels of each view's map
/// @param left, bottom lower left corner of the picture, pixels of the screen @param room size of the picture, pixels
void draw_legend(const Pane& pane, const FittedLight* light, MapSize map_size, float left, float bottom, ImVec2 room);

/// Draws widgets for opacity and scale of the overlay of a pane (one of up to four scene pictures), below its legend
/// (draw_legend()).
/// @param left, bottom lower left corner of the picture, pixels of the screen @param room size of the picture, pixels
void draw_legend_widgets(Settings& settings, const Pane& pane, float left, float bottom, ImVec2 room);
/// Returns the width of the widgets that draw_legend_widgets() draws for a pane (a scene picture), pixels.
float legend_widgets_width(const Settings& settings, const Pane& pane);
/// Returns the height of the widgets that draw_legend_widgets() draws, pixels; 0: no overlay, or too small a picture.
/// @param room size of the picture, pixels
float legend_widgets_height(const Settings& settings, const Pane& pane, ImVec2 room);

/// Draws the legend of the artefact overlay over the lower left corner of its picture: colours, causes of wrong pixels
/// and pixel counts. @param error errors of the frame; null: not known, so that no counts are drawn
/// @param left, bottom the corner, pixels of the screen @param room width of the picture, pixels
void draw_artefact_legend(const LiveError* error, float left, float bottom, float room);

/// Formats the state of the ray-traced reference: progress, why it is missing, or the rays and time that it took.
/// Requires frame.reference.
std::string reference_status(const EditorFrame& frame);

/// Draws the progress of the ray-traced reference, with a button that cancels tracing, over a picture whose overlay
/// needs the reference. Draws nothing if the reference is complete.
/// @param left, bottom lower left corner of the picture, pixels of the screen @param width width of the picture, pixels
void draw_tracing(const EditorFrame& frame, EditorRequests& requests, float left, float bottom, float width);

/// Draws the combo that chooses how two pictures are compared: off, swipe, side by side or difference.
/// @param width width of the combo, pixels
void comparison_view_widget(EditorState& state, float width);
/// Draws the combo that chooses what the picture is compared with: the ray-traced reference, or the picture of other
/// settings.
/// @param width width of the combo, pixels
void comparison_other_widget(EditorState& state, const EditorFrame& frame, float width);
/// Returns the arrangement of the compared pictures (off, swipe, side by side, difference) that the user has chosen.
/// The key that, while held, shows only the picture of the pinned settings does not change it.
ComparisonView chosen_comparison(const EditorState& state);
/// Moves the line of the swipe comparison, between the two compared pictures, with the mouse. Call before the picture's
/// own gestures. Returns true while the line is dragged: the picture then ignores the mouse.
bool steer_swipe(EditorState& state, const PictureView& view);
/// Draws the other picture of a comparison over the shown one: right of the dividing line (swipe), side by side, or as
/// a difference. Labels the two sides with the names of their settings.
/// @param lo upper left corner of the pane, pixels of the screen @param size size of the pane, pixels
/// @param right_half true: the right pane of a comparison side by side
void draw_comparison(const EditorState& state, const EditorFrame& frame, glm::vec2 lo, glm::vec2 size, bool right_half);

/// Pins the present settings as A, to compare later settings with them. If no comparison is shown, the comparison that
/// the user switches on next is with A. Removes the pin if these settings are pinned already. Does nothing while the
/// user holds the key that shows A alone.
void pin_settings(EditorState& state);
/// Previews settings that a search proposes: shows their picture right of the dividing line (swipe), and the present
/// picture left of it. Does nothing while the user holds the key that shows the picture of the pinned settings alone.
/// The user pins settings to compare others with them.
void show_tried(EditorState& state, const Settings& settings);
/// Ends the preview of proposed settings that show_tried() began, and restores the earlier picture comparison.
void hide_tried(EditorState& state);
/// Ends the preview of proposed settings if the scene, the comparison or the settings have changed since show_tried()
/// began it. Keeps the preview if the changed settings differ from the previewed ones only in bias, kernel and
/// resolution. Call once a frame.
void follow_tried(EditorState& state);
/// Applies a change of settings that a search has drawn and measured. The log then compares the measured errors with
/// those of the shown frame (check_prediction()).
void apply_trial(EditorState& state, const Trial& trial);
/// Logs the errors that a search predicted for the applied settings beside the measured ones, once these are known.
/// Requests the errors until then. Call once a frame.
void check_prediction(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Shows the picture of the pinned settings (A) alone, until end_flicker(). Call when the user presses the key for
/// this. If no settings are pinned, only logs a message.
void begin_flicker(EditorState& state);
/// Ends the view of the pinned settings (A) alone, which begin_flicker() began. Shows the picture of the present
/// settings again, and restores the earlier comparison.
void end_flicker(EditorState& state);

/// Draws the progress of loading a scene, with a button that cancels it, over the upper part of a picture. Draws
/// nothing if no scene is being loaded. @param left, top, width upper edge of the picture, pixels of the screen
void draw_loading(const EditorFrame& frame, EditorRequests& requests, float left, float top, float width);

/// Returns true while the user types into a text field, in this frame or from the next one on. Shortcuts then do not
/// act.
bool text_is_typed();

/// Makes a panel fill the editor's window, or shows all panels again if the panel fills the window already.
void toggle_maximised(EditorState& state, Panel panel);

/// Draws the status bar below all panels: last message, frame time, size of the shadow maps, kernel taps per pixel,
/// picture size, driver.
void draw_status_bar(EditorState& state, const EditorFrame& frame);
/// Returns the height of the status bar, pixels.
float status_bar_height();

}  // namespace si
