// The whole editor as one function: state and the frame's facts go in, wishes come out. Knows ImGui and the renderer's
// data types; no window, no GL. The caller fulfils the wishes before the next frame.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/frame/renderer.h"
#include "renderer/inspect/lost_casters.h"
#include "ui/map_view/map_shown.h"
#include "ui/panels/advice.h"
#include "ui/panels/artefact_tour.h"
#include "ui/panels/compare.h"
#include "ui/panels/cures.h"
#include "ui/panels/effects.h"
#include "ui/panels/health.h"
#include "ui/panels/lab.h"
#include "ui/panels/presets.h"
#include "ui/panels/probed.h"
#include "ui/panels/truth.h"
#include "ui/panels/tune.h"
#include "ui/scene_view/against.h"
#include "ui/scene_view/cameras.h"
#include "ui/scene_view/light_drag.h"
#include "ui/scene_view/probe_anchor.h"
#include "ui/state/frame_times.h"
#include "ui/state/history.h"
#include "ui/state/log.h"
#include "ui/state/measured.h"
#include "ui/state/shots.h"
#include "ui/widgets/file_dialog.h"

namespace si {

/// Where the map viewer stands.
enum class MapSpot { AboveSettings, BesideScene, Inset, Hidden };

/// A part of the window that can fill it.
enum class Panel { Scene, Map, Tabs };

/// Where the splitters stand, and the colours. Sizes are in units of text height, so that they survive a change of
/// scale.
struct EditorLayout {
    float settings_width = 24;
    float bottom_height = 0;  ///< of the tabs below; 0: as high as the tab needs that was chosen by hand
    MapSpot map_place = MapSpot::AboveSettings;
    float map_height = 0.5f;  ///< of the settings' column, where it stands above them
    float map_share = 0.40f;  ///< of the width left of the settings, where it stands beside the scene
    float map_inset = 20;     ///< width and height, where it stands in a corner of the scene
    bool map_plots = true;    ///< histogram and depth curve under the map
    bool light_theme = false;
    bool desktop_dialogs = true;  ///< for files, where the desktop has one
    bool operator==(const EditorLayout&) const = default;
};

enum class BottomTab { Effects, Probe, Error, Objects, Compare, Frontier, Advice, Lab, Numbers, Log };

/// Settings that were kept to compare later ones with.
struct PinnedSettings {
    Settings settings;
    std::string scene;  ///< that they were shown with
    bool operator==(const PinnedSettings&) const = default;
};

/// What was compared before a key showed the other side alone.
struct Flicker {
    Against against;
    CompareWith compare;
};

/// What a loupe shows: the probed pixel, or what is under the mouse.
enum class LoupeMode { Probed, Mouse, Off };

/// What of the editor's state its frames, and the numbers read from them, depend on.
struct PictureState {
    Settings settings;
    CompareWith compare;
    Against against;
    std::optional<PinnedSettings> pinned;
    EffectsPanel effects;
    std::optional<glm::ivec2> probe_pixel;    ///< of the scene picture, row 0 at the top
    std::optional<ProbeAnchor> probe_anchor;  ///< the surface that it sticks to, once it is known
    std::optional<glm::ivec2> loupe_pixel;    ///< that the loupe stands at; none: it is hidden
    LoupeMode loupe = LoupeMode::Probed;
    ArtefactWish artefacts;
    int active_pane = 0;  ///< under the mouse, or where a press began
    BottomTab tab = BottomTab::Effects;
    std::optional<FrozenCamera> frozen;
};

/// A name being typed in the list of lights.
struct LightRename {
    int light = 0;
    std::string name;
    bool begun = false;  ///< its field has the keyboard
};

struct EditorState : PictureState {
    History history;
    Log log;
    std::string scene_name;                   ///< built-in key or path, as loaded
    std::string scene_input;                  ///< path being typed
    std::string preset_path = "preset.json";  ///< the file that is saved to
    GuideNote guide;                          ///< of the preset that was opened last
    std::string hidden_guide;                 ///< key of the note that is not to be shown
    std::string error_path = "error.json";    ///< that the error panel's Save writes
    FileDialog file_dialog;
    std::optional<Replacement> replace;
    bool between_steps = false;  ///< undo or redo waits for the scene of its step
    std::string search;
    bool only_changed = false;
    std::set<std::string, std::less<>> unfolded;  ///< groups of settings that show what is turned seldom, too
    std::optional<LightRename> light_rename;
    TunePanel tune;
    AdvicePanel advice;
    LabPanel lab;
    EditorLayout layout;
    std::optional<Panel> maximised;      ///< fills the window (F11)
    Panel hovered_panel = Panel::Scene;  ///< that the mouse was over last
    MapWindow map_window;
    bool exact_texels = false;                ///< the map viewer marks the texels that kernels fetch
    std::optional<MarkedTexel> marked_texel;  ///< that a finding of the panel Numbers stands at
    std::string map_path = "shadow-map.pfm";  ///< that the map viewer's Save writes
    std::optional<glm::ivec2> hovered_pixel;  ///< under the mouse in the scene picture, row 0 at the top
    std::optional<glm::ivec2> hovered_texel;  ///< under the mouse in the map viewer, y up
    Playback playback;
    SweepPanel sweep;
    std::optional<BottomTab> open_tab = BottomTab::Effects;  ///< brought to the front in the next frame
    /// Chosen by hand last: what else opens one leaves the picture in place.
    BottomTab fitted_tab = BottomTab::Effects;
    std::string object_search;
    bool only_lost = false;               ///< the object list shows lost casters only
    std::string selected_object;          ///< node path, of several the one chosen first; empty: none
    std::string sought_object;            ///< chosen elsewhere, and not yet brought into view in the list of objects
    int list_seeks = 0;                   ///< frames left in which that list scrolls to it
    std::set<std::string> also_selected;  ///< the others
    std::string hovered_object;           ///< node path of the row under the mouse; empty: none
    std::set<std::string> closed_nodes;   ///< of the list of objects, by path
    std::vector<double> object_ranks;     ///< that the list is sorted by; one a node of the scene `object_ranks_of`
    std::uint64_t object_ranks_of = 0;    ///< Scene::id
    std::string menu_object;              ///< node path that the scene's menu is about
    bool flew = false;                    ///< or pressed a key, while the right button was held
    bool show_welcome = false;
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
    bool select_probed = false;                         ///< the next probe of a click chooses the selected object
    std::optional<Flicker> flicker;                     ///< the other side is shown while its key is held
    bool probe_has_arrows = false;                      ///< the arrow keys move the probe, and no widget takes them
    bool took_navigation = false;                       ///< ImGui's navigation is off for it
    std::array<int, 2> page_keys{-1, -1};               ///< codes of PageUp and PageDown, once they are known
    bool fix_waits = false;                             ///< C was pressed before there was a verdict
    bool had_popup = false;                             ///< a menu was open at the end of the frame before
    glm::ivec2 wanted_picture{0};                       ///< size of the scene picture asked for last
    ArtefactTour artefact_tour;
    std::optional<Shot> shot_next;  ///< taken in the next frame, when what asked for it is gone from the picture
    ScreenRect scene_rect, map_rect, drawing_rect;  ///< where the pictures were drawn last
    SectionViews section_views;
    FrameTimes times;
};

/// A scene that is being read while the editor shows another.
struct LoadingFacts {
    std::string name;         ///< built-in key or path
    double progress = 0;      ///< 0..1
    double seconds_left = 0;  ///< estimated; 0: not known yet
};

/// The first picture of a scene while it is drawn.
struct DrawingFacts {
    std::string pass;     ///< under way
    double progress = 0;  ///< 0..1
};

/// What the last frame found out. Pointers may be null: the editor draws without them.
struct EditorFrame : ProbeShown, TuneShown, MapShown, PresetsShown, EffectsShown, AdviceShown, LabShown, HealthShown {
    const FrameResult* result = nullptr;
    const Scene* scene = nullptr;
    const DriverInfo* driver = nullptr;
    FixSearch fixes;
    const FloatImage* overlay_values = nullptr;  ///< of the active pane
    std::span<const LostCaster> lost_casters;    ///< of the shown light
    const ComparisonFacts* comparison = nullptr;
    std::string_view shader_log;
    std::string_view problem;   ///< why there is no picture
    bool driver_reset = false;  ///< the driver lost what was drawn: only another start of the program draws again
    std::optional<LoadingFacts> loading;
    std::optional<DrawingFacts> drawing;
    const SweepFacts* sweep = nullptr;
    std::optional<ReferenceFacts> reference;
    const LiveError* error = nullptr;  ///< of the frame shown; null: not known
    std::optional<AgainstFacts> against;
    const LoupeFacts* loupe = nullptr;         ///< of state.loupe_pixel; null: not known yet
    bool desktop_dialogs = false;              ///< the desktop's dialog for files can be asked for
    const ArtefactSpots* artefacts = nullptr;  ///< of the last wish that was fulfilled
};

struct EditorActions : MapActions,
                       ReferenceActions,
                       PresetActions,
                       SweepActions,
                       TuneActions,
                       FixActions,
                       EffectsActions,
                       AdviceActions,
                       LabActions,
                       HealthActions {
    int scene_width = 0, scene_height = 0;  ///< wanted size of the scene picture; 0: not shown
    bool want_overlay_values = false;       ///< a scene picture is hovered
    bool want_timing = false;
    bool copy_command_line = false;
    bool quit = false;
    std::optional<DesktopFileDialog> ask_desktop;
    bool welcomed = false;     ///< the welcome was shown
    bool hold_cursor = false;  ///< hide the mouse and let it move without end: the camera flies
    bool redraw = false;       ///< something still moves: draw another frame soon
    std::optional<ShotWish> shot;
    bool at_rest = false;  ///< nobody touches anything: the picture may be made smooth (view.smooth)
};

/// Of the window at scale 1 (a font of 15 pixels): in a smaller one the editor scrolls.
inline constexpr float kLeastWidth = 640, kLeastHeight = 360;

/// Draws one frame of the editor into the current ImGui frame; edits state.settings in place.
EditorActions draw_editor(EditorState& state, const EditorFrame& frame);

}  // namespace si
