// The whole editor as one function: state and the frame's facts go in, wishes come out. Knows ImGui and the renderer's
// data types; no window, no GL. The caller fulfils the wishes before the next frame.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/frame/renderer.h"
#include "renderer/inspect/depth_histogram.h"
#include "renderer/inspect/lost_casters.h"
#include "renderer/inspect/texel_usage.h"
#include "renderer/view/camera.h"
#include "ui/scene_view/light_drag.h"
#include "ui/state/history.h"
#include "ui/state/log.h"
#include "ui/state/measured.h"
#include "ui/widgets/file_dialog.h"

namespace si {

struct CureTable;  // renderer/measure/cures.h

struct Probe;
struct Dossier;

/// Where the splitters stand. Sizes are in units of text height, so that they survive a change of scale.
struct EditorLayout {
    float settings_width = 24;
    float bottom_height = 17.2f;
    float map_share = 0.40f;  ///< of the width left of the settings
    bool map_plots = true;    ///< histogram and depth curve under the map
    bool operator==(const EditorLayout&) const = default;
};

/// Pan and zoom of the map viewer: `zoom` 1 fits the map; `centre` is what stands in the middle, v up.
struct MapWindow {
    float zoom = 1;
    glm::vec2 centre{0.5f};
};

/// Flying with the right mouse button held.
struct Flight {
    bool on = false, moving = false;  ///< the button, and a key of movement, were down in the last frame
    double speed = 1;                 ///< factor
};

/// The camera whose view of the shadow map is kept while another one flies about.
struct FrozenCamera {
    Camera camera;
    CameraSettings settings;  ///< that make this camera
    glm::ivec2 pixels{1};     ///< of its picture
};

/// How scene.time runs while it plays.
struct Playback {
    bool playing = false;
    bool loop = true;
    double speed = 1;  ///< seconds of the animation in a second
};

enum class BottomTab { Passes, Probe, Error, Objects, Compare, Frontier, Log };

/// What the present state is compared with.
enum class CompareKind { Scene, Defaults, Preset };
struct CompareWith {
    CompareKind kind = CompareKind::Scene;
    std::string preset;  ///< built-in key or path
    bool operator==(const CompareWith&) const = default;
};

/// What the picture shown is held against, and how.
enum class AgainstView { Off, Swipe, SideBySide, Difference };
struct Against {
    AgainstView view = AgainstView::Off;
    bool truth = true;  ///< the ray-traced truth; else what EditorState::compare names
    float at = 0.5f;    ///< where the swipe's line stands: share of the picture's width, what is shown on its left
    bool held = false;  ///< the line is being dragged
};

/// A file that exists and is to be replaced, once a person agrees.
struct Replacement {
    std::string path;
    std::optional<std::string> about;
};

/// The limits of a search, as they are being typed.
struct TunePanel {
    bool bound_error = true, bound_ms = false, area = false;
    double most_error = 0.01, most_ms = 10;
};

struct EditorState {
    Settings settings;
    History history;
    Log log;
    std::string scene_name;                   ///< built-in key or path, as loaded
    std::string scene_input;                  ///< path being typed
    std::string preset_path = "preset.json";  ///< the file that is saved to
    GuideNote guide;                          ///< of the preset that was opened last
    std::string hidden_guide;                 ///< key of the note that is not to be shown
    CompareWith compare;
    Against against;
    std::string error_path = "error.json";  ///< that the error panel's Save writes
    FileDialog file_dialog;
    std::optional<Replacement> replace;
    bool between_steps = false;  ///< undo or redo waits for the scene of its step
    std::string search;
    bool only_changed = false;
    TunePanel tune;
    std::optional<glm::ivec2> probe_pixel;  ///< of the scene picture, row 0 at the top
    EditorLayout layout;
    MapWindow map_window;
    std::string map_path = "shadow-map.pfm";  ///< that the map viewer's Save writes
    std::optional<glm::ivec2> hovered_pixel;  ///< under the mouse in the scene picture, row 0 at the top
    int active_pane = 0;                      ///< under the mouse, or where a press began
    std::optional<glm::ivec2> hovered_texel;  ///< under the mouse in the map viewer, y up
    Playback playback;
    SweepPanel sweep;
    BottomTab tab = BottomTab::Passes;
    std::optional<BottomTab> open_tab = BottomTab::Passes;  ///< brought to the front in the next frame
    std::string object_search;
    bool only_lost = false;       ///< the object list shows lost casters only
    std::string selected_object;  ///< node path; empty: none
    bool show_shortcuts = false;
    double wheel_until = 0;                 ///< a turn of the wheel counts as one gesture until this time, seconds
    bool dragging = false;                  ///< a drag in a picture is under way
    std::optional<PictureView> scene_view;  ///< where the scene picture was drawn last
    bool press_moved = false;               ///< the press in the scene picture became a drag
    bool press_taken = false;  ///< the press in the scene picture is on a mark in it, no gesture of the camera
    std::optional<LightHit> hovered_light;  ///< under the mouse in the scene picture
    std::optional<HandleDrag> handle_drag;  ///< under way
    char hovered_axis = 0;                  ///< 'x', 'y' or 'z': an end of the gnomon is under the mouse
    Flight flight;
    std::optional<CameraSettings> camera_before_light;  ///< what looking through the light goes back to
    std::optional<FrozenCamera> frozen;
    bool select_probed = false;  ///< the next probe of a click chooses the selected object
};

/// A preset that ships with the program.
struct PresetEntry {
    std::string key, title, topic, about;
};

/// What a crash left behind.
struct LostFacts {
    std::string scene, when;  ///< "3 minutes ago"
};

/// What state.compare names.
struct ComparisonFacts {
    CompareWith with;
    Settings settings;
    std::string scene;    ///< that it was made for; empty: any
    std::string problem;  ///< why there are no settings
};

/// What is known of the ray-traced truth about the frame.
struct TruthFacts {
    bool current = false;                             ///< the frame shown has all that it asks for
    bool wanted = false;                              ///< something that is shown asks for it
    std::string doing;                                ///< what runs in the background: "Tracing rays"; empty: nothing
    double progress = 0;                              ///< 0..1, of that
    std::string problem;                              ///< why there is none
    double build_ms = 0, place_ms = 0, trace_ms = 0;  ///< wall time of the last trace; 0 where it was known
    std::uint64_t rays = 0;
    std::string noise;          ///< noise_text() of a light of size
    int width = 0, height = 0;  ///< in pixels
};

/// The picture that the one shown is held against.
struct AgainstFacts {
    Image picture, difference;  ///< without a texture: not there yet
    std::string label;          ///< what it shows: "Truth", "PCF 5x5"
    std::string problem;        ///< why there is none
    double mae = 0;             ///< mean |A - B| of the pictures' channels, 0..1; with the difference
};

/// A scene that is being read while the editor shows another.
struct LoadingFacts {
    std::string name;         ///< built-in key or path
    double progress = 0;      ///< 0..1
    double seconds_left = 0;  ///< estimated; 0: not known yet
};

/// What the depth image in the map viewer holds.
struct MapFacts {
    DepthStatistics statistics;
    DepthHistogram histogram;  ///< of the values that view.map shows
};

/// A search for the least bias, under way.
struct TuneFacts {
    std::string about;    ///< what is being tried
    double progress = 0;  ///< 0..1
};

/// What a search is to find: without limits the least bias that leaves no acne.
struct TuneWish {
    std::optional<double> most_error, most_ms;  ///< then kernel and resolution are searched, too
    bool area = false;                          ///< against a light of its size
};

/// What a search for the least bias found of one way to spend it.
struct TunedFamily {
    std::string name, bias_text;
    BiasSettings bias;
    std::size_t acne = 0, wrong = 0, lost = 0;  ///< pixels; lost: wrong by the price of bias
    double gap_p95_m = 0, shift_p95_m = 0;      ///< lit strip at contacts; how far edges are moved
    bool chosen = false;
};

/// What is to be cured: a pixel, or nothing for the whole picture.
struct CureWish {
    std::optional<glm::ivec2> pixel;
};
/// A search for what puts wrong pixels right.
struct CureSearch {
    std::optional<TuneFacts> running;
    const CureTable* table = nullptr;  ///< that was found last
    std::optional<glm::ivec2> pixel;   ///< that it is about; none: the picture
    bool current = false;              ///< it is about the present settings
};

/// What the last frame found out. Pointers may be null: the editor draws without them.
struct EditorFrame {
    const FrameResult* result = nullptr;
    const Scene* scene = nullptr;
    const DriverInfo* driver = nullptr;
    const Probe* probe = nullptr;       ///< of state.probe_pixel
    std::span<const Dossier> dossiers;  ///< one for each light of the probe, once the truth is there
    bool tracing_probe = false;         ///< dossiers will follow
    std::optional<TuneFacts> tuning;
    std::span<const TunedFamily> tuned;  ///< all that the last search for the least bias tried, for this scene
    bool tuned_current = false;          ///< the present settings, whatever their bias, would give the same
    CureSearch cures;
    const FloatImage* map_values = nullptr;  ///< the map viewer's depth image as stored, row 0 at the top
    const MapFacts* map_facts = nullptr;
    const FloatImage* map_coordinates = nullptr;  ///< FrameResult::map_coordinates read back
    const TexelUsage* texel_usage = nullptr;      ///< of the shown light and face
    const TexelUsage* frozen_usage = nullptr;     ///< the same by the pixels of state.frozen
    const FloatImage* overlay_values = nullptr;   ///< of the active pane
    std::span<const LostCaster> lost_casters;     ///< of the shown light
    std::span<const PresetEntry> presets;
    std::span<const std::string> recent_scenes, recent_presets;  ///< paths, the newest first
    const ComparisonFacts* comparison = nullptr;
    bool unsaved = false;  ///< state.preset_path does not hold the present settings
    std::optional<LostFacts> lost;
    std::string_view shader_log;
    std::string_view problem;  ///< why there is no picture
    std::optional<LoadingFacts> loading;
    const SweepFacts* sweep = nullptr;
    std::optional<TruthFacts> truth;
    const LiveError* error = nullptr;  ///< of the frame shown; null: not known
    std::optional<AgainstFacts> against;
};

struct EditorActions {
    int scene_width = 0, scene_height = 0;  ///< wanted size of the scene picture; 0: not shown
    bool want_map = false;
    bool want_map_values = false;      ///< the cursor is over the map
    bool want_map_facts = false;       ///< the plots are shown
    bool want_overlay_values = false;  ///< a scene picture is hovered
    bool want_links = false;           ///< which pixel reads which texel: a picture is hovered and nothing is dragged
    bool want_frozen_usage = false;    ///< what the frozen camera reads: the map is shown and nothing is dragged
    bool want_timing = false;
    bool want_error = false;  ///< the error panel is shown
    bool cancel_truth = false;
    std::optional<std::string> save_error;  ///< all metrics as JSON into this file
    std::optional<std::string> load_scene, load_preset, save_preset, save_map;
    std::optional<std::string> open_file;   ///< a scene or a preset, by its extension
    std::optional<std::string> save_about;  ///< the sentence to save along
    bool replace = false;                   ///< save over a file that was neither opened nor saved before
    bool reset_all = false;                 ///< to the scene's own settings
    bool restore_lost = false, discard_lost = false;
    bool cancel_load = false;  ///< keep the scene that is shown
    std::optional<SweepWish> start_sweep;
    bool cancel_sweep = false;
    std::optional<std::string> save_sweep, open_sweep;  ///< folders
    bool take_sweep_base = false;                       ///< the settings that the sweep's cases share
    bool want_present = false;                          ///< the present settings are to be measured
    std::optional<TuneWish> tune;
    bool cancel_tune = false;
    std::optional<CureWish> find_cures;
    bool cancel_cures = false, forget_cures = false;
    bool copy_command_line = false;
    bool quit = false;
    bool hold_cursor = false;  ///< hide the mouse and let it move without end: the camera flies
    bool redraw = false;       ///< something still moves: draw another frame soon
};

/// Draws one frame of the editor into the current ImGui frame; edits state.settings in place.
EditorActions draw_editor(EditorState& state, const EditorFrame& frame);

}  // namespace si
