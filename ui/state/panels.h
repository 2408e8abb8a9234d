// The parts of the editor, one file each. Each fills the child window that is current.
#pragma once

#include <imgui.h>

#include "renderer/base/lengths_text.h"
#include "ui/scene_view/picture_view.h"
#include "ui/state/editor_ui.h"

namespace si {

void draw_top_bar(EditorState& state, const EditorFrame& frame, EditorActions& actions);
void draw_viewport(EditorState& state, const EditorFrame& frame, EditorActions& actions);
void draw_map_viewer(EditorState& state, const EditorFrame& frame, EditorActions& actions);
void draw_settings(EditorState& state, const EditorFrame& frame, EditorActions& actions);
/// What the frame simulates, keeps and leaves out, each with why and what that saves; what its passes cost.
void draw_effects(EditorState& state, const EditorFrame& frame, EditorActions& actions);
void draw_probe(EditorState& state, const EditorFrame& frame, EditorActions& actions);
/// What is wrong with the shadows of the shown light, in numbers.
void draw_error(EditorState& state, const EditorFrame& frame, EditorActions& actions);
void draw_objects(EditorState& state, const EditorFrame& frame);
void draw_compare(EditorState& state, const EditorFrame& frame, EditorActions& actions);
/// What accuracy costs in time.
void draw_frontier(EditorState& state, const EditorFrame& frame, EditorActions& actions);
/// What the scene advises, and the autopilot.
void draw_advice_panel(EditorState& state, const EditorFrame& frame, EditorActions& actions);
/// Where the scene is put, what single precision makes of it, and how much edges crawl.
void draw_lab(EditorState& state, const EditorFrame& frame, EditorActions& actions);
/// Which numbers of the frame are none, and where.
void draw_health(EditorState& state, const EditorFrame& frame, EditorActions& actions);
void draw_log(EditorState& state, const EditorFrame& frame);
void draw_shortcuts(EditorState& state);
/// Three sentences and three ways to begin, while state.show_welcome.
void draw_welcome(EditorState& state, const EditorFrame& frame, EditorActions& actions);
/// Only where time_bar_height() is not 0: the scene has animations.
void draw_time_bar(EditorState& state, const EditorFrame& frame);
float time_bar_height(const EditorFrame& frame);
/// The popup `id` of presets by topic, while it is open.
void draw_presets_menu(const char* id, std::span<const PresetEntry> presets, const EditorState& state,
                       EditorActions& actions);
float presets_menu_width();
/// What to look at and what a crash left, where there is such a thing; as wide as asked, as high as the text needs.
void draw_strips(EditorState& state, const EditorFrame& frame, EditorActions& actions, float width);

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
std::string reference_status(const EditorFrame& frame);

/// Over a picture whose overlay waits for rays: what is done about it, and how far.
void draw_tracing(const EditorFrame& frame, EditorActions& actions, float left, float bottom, float width);

/// How the picture is compared with another one; and with which. @param width of the combo, pixels
void against_view_widget(EditorState& state, float width);
void against_other_widget(EditorState& state, const EditorFrame& frame, float width);
/// What was chosen, which a key may have put aside while it is held.
AgainstView chosen_view(const EditorState& state);
/// A press of the mouse on the swipe's line drags it. Call before the picture's own gestures: returns whether it did.
bool steer_swipe(EditorState& state, const PictureView& view);
/// The other picture, right of the line, beside or as a difference, and what the sides are. Pixels of the screen.
void draw_against(const EditorState& state, const EditorFrame& frame, glm::vec2 lo, glm::vec2 size, bool right_half);

/// Pins the present settings as what they are compared with; the same settings again: nothing is pinned.
void pin_settings(EditorState& state);
/// While its key is held the picture is that of the pinned settings. Call in every frame.
/// @param may_start a key that goes down is meant for it
void steer_flicker(EditorState& state, bool may_start);

/// What is being read, and a button that cancels, at the top of a picture. Pixels of the screen.
void draw_loading(const EditorFrame& frame, EditorActions& actions, float left, float top, float width);

/// The light whose map and overlays are shown, clamped to the lights there are; -1 when there is none.
int shown_light(const Settings& settings);
/// The face of the shown light, clamped.
int shown_face(const Settings& settings, const FrameResult& result);

/// Letters, function keys and Escape mean something else: a text is typed, the camera flies, a handle is dragged.
bool keys_are_taken(const EditorState& state);

/// Lets the panel fill the window, or takes its place among the others again.
void maximise(EditorState& state, Panel panel);

/// One line below all: the last message, the picture's size, the map's bytes and look-ups, the driver.
void draw_status_bar(EditorState& state, const EditorFrame& frame);
float status_bar_height();

/// A built-in scene's label; a file without its folders; "No scene" when there is none.
std::string scene_label(const std::string& name_or_path);

/// "12 s", "3 min".
std::string seconds_text(double seconds);

/// A bar filled from the left to this share, with a text that can be read on either part. @param width 0: all there is
void progress_bar(double share, const std::string& text, float width = 0);

}  // namespace si
