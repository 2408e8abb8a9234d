// The parts of the editor, one file each. Each fills the child window that is current.
#pragma once

#include <imgui.h>

#include "renderer/base/lengths_text.h"
#include "ui/scene_view/picture_view.h"
#include "ui/state/editor_ui.h"
#include "ui/state/shown_light.h"
#include "ui/widgets/progress_bar.h"

namespace si {

void draw_top_bar(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
void draw_viewport(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
void draw_map_viewer(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
void draw_settings(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
void draw_probe(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// What is wrong with the shadows of the shown light, in numbers.
void draw_error(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
void draw_objects(EditorState& state, const EditorFrame& frame);
void draw_compare(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// What accuracy costs in time.
void draw_frontier(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
void draw_shortcuts(EditorState& state);
/// Three sentences and three ways to begin, while state.window.show_welcome.
void draw_welcome(EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Only where time_bar_height() is not 0: the scene has animations.
void draw_time_bar(EditorState& state, const EditorFrame& frame);
float time_bar_height(const EditorFrame& frame);
/// The popup `id` of presets by topic, while it is open.
void draw_presets_menu(const char* id, std::span<const PresetEntry> presets, const EditorState& state,
                       EditorRequests& requests);
float presets_menu_width();
/// What to look at and what a crash left, where there is such a thing; as wide as asked, as high as the text needs.
void draw_strips(EditorState& state, const EditorFrame& frame, EditorRequests& requests, float width);

/// The walk that the open preset belongs to: the hard cases, or (also while none is open) the guided presets.
std::span<const PresetEntry> open_walk(const EditorState& state, const EditorFrame& frame);
/// The preset of that walk `step` places after the open one; none beyond either end.
std::optional<std::string> neighbour_preset(const EditorState& state, const EditorFrame& frame, int step);

/// The colour scale of a pane's overlay, with numbers and unit, over its picture's lower left corner; `room` is the
/// picture's size on the screen. Of overlays that name a light's views the colours of those, by number or face.
/// @param light that is shown; null: none is
void draw_legend(const Pane& pane, const FittedLight* light, float left, float bottom, ImVec2 room);

/// Opacity and scale of a pane's overlay, in a box over its picture's lower left corner, below the legend.
void draw_legend_widgets(Settings& settings, const Pane& pane, float left, float bottom, ImVec2 room);
/// What they take of the picture's height, pixels; 0: it is too small for them.
float legend_widgets_height(const Settings& settings, const Pane& pane, ImVec2 room);

/// The colours of the artefact overlay with what they mean and how many pixels have them, in its picture's corner.
void draw_artefact_legend(const LiveError* error, float left, float bottom, float room);

/// How far the truth is, or what it took. Only where frame.truth is.
std::string truth_status(const EditorFrame& frame);

/// Over a picture whose overlay waits for rays: what is done about it, and how far.
void draw_tracing(const EditorFrame& frame, EditorRequests& requests, float left, float bottom, float width);

/// How the picture is compared with another one; and with which. @param width of the combo, pixels
void comparison_view_widget(EditorState& state, float width);
void comparison_other_widget(EditorState& state, const EditorFrame& frame, float width);
/// What was chosen, which a key may have put aside while it is held.
ComparisonView chosen_comparison(const EditorState& state);
/// A press of the mouse on the swipe's line drags it. Call before the picture's own gestures: returns whether it did.
bool steer_swipe(EditorState& state, const PictureView& view);
/// The other picture, right of the line, beside or as a difference, and what the sides are. Pixels of the screen.
void draw_comparison(const EditorState& state, const EditorFrame& frame, glm::vec2 lo, glm::vec2 size, bool right_half);

/// Pins the present settings as what they are compared with; the same settings again: nothing is pinned.
void pin_settings(EditorState& state);
/// Shows the picture of the pinned settings alone, until end_flicker(). Without a pin the log says so.
void begin_flicker(EditorState& state);
/// Shows the present settings again, with the comparison that begin_flicker() has replaced.
void end_flicker(EditorState& state);

/// What is being read, and a button that cancels, at the top of a picture. Pixels of the screen.
void draw_loading(const EditorFrame& frame, EditorRequests& requests, float left, float top, float width);

/// True while a text field takes the keys, in this frame or from the next one on.
bool text_is_typed();

/// Lets the panel fill the window, or takes its place among the others again.
void maximise(EditorState& state, Panel panel);

/// One line below all: the last message, the picture's size, the map's bytes and look-ups, the driver.
void draw_status_bar(EditorState& state, const EditorFrame& frame);
float status_bar_height();

/// A built-in scene's label; a file without its folders; "No scene" when there is none.
std::string scene_label(const std::string& name_or_path);

}  // namespace si
