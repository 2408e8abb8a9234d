// The editor as one function: state and the frame's facts go in, requests come out. Uses ImGui and the renderer's data
// types, no window and no OpenGL. The caller fulfils the requests before the next frame.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>

#include "renderer/frame/frame.h"
#include "renderer/inspect/lost_casters.h"
#include "renderer/render/renderer.h"
#include "ui/map_view/map_panel.h"
#include "ui/panels/artefact_tour.h"
#include "ui/panels/compare_panel.h"
#include "ui/panels/convert_dialog.h"
#include "ui/panels/effects_panel.h"
#include "ui/panels/engine_panel.h"
#include "ui/panels/fixes_table.h"
#include "ui/panels/frontier_panel.h"
#include "ui/panels/health_panel.h"
#include "ui/panels/import_dialog.h"
#include "ui/panels/imported_panel.h"
#include "ui/panels/improve_panel.h"
#include "ui/panels/lab_panel.h"
#include "ui/panels/light_strip.h"
#include "ui/panels/lights_panel.h"
#include "ui/panels/objects_panel.h"
#include "ui/panels/presets.h"
#include "ui/panels/probe_panel.h"
#include "ui/panels/reference.h"
#include "ui/panels/report_dialog.h"
#include "ui/panels/settings_panel.h"
#include "ui/panels/tune_controls.h"
#include "ui/scene_view/cameras.h"
#include "ui/scene_view/picture_comparison.h"
#include "ui/scene_view/probe_anchor.h"
#include "ui/scene_view/scene_panel.h"
#include "ui/state/files.h"
#include "ui/state/frame_times.h"
#include "ui/state/history.h"
#include "ui/state/log.h"
#include "ui/state/window_layout.h"
#include "ui/widgets/file_dialog.h"

namespace si {

/// Picture comparison to restore when the user releases the key that shows the picture of the pinned settings alone.
struct Flicker {
    PictureComparison picture_comparison;
    CompareWith compare;
};

/// Centre of the loupe (magnifier): the probed pixel, or the pixel under the mouse.
enum class LoupeMode { Probed, Mouse, Off };

/// Part of the editor's state that the drawn frame, and the numbers read back from it, depend on. The drawing thread
/// gets a copy.
struct PictureState {
    Settings settings;
    CompareWith compare;
    PictureComparison comparison;
    std::optional<PinnedSettings> pinned;
    /// Settings that a search proposes, shown beside the present ones until the user applies or dismisses them.
    struct Tried : PinnedSettings {
        PictureComparison comparison_before;  ///< the comparison that they replace
        CompareWith compare_before;
        Settings shown_beside;  ///< the present settings at that time
    };
    std::optional<Tried> tried;
    /// Errors that a search has measured for proposed settings which were then applied. The log compares them with the
    /// errors of the shown frame.
    struct Predicted {
        Settings settings;  ///< as measured: measured_settings()
        std::size_t wrong = 0;
        double mae = 0;
    };
    std::optional<Predicted> predicted;
    EffectsPanel effects;
    std::optional<glm::ivec2> probe_pixel;    ///< probed pixel of the scene picture, row 0 at the top
    std::optional<ProbeAnchor> probe_anchor;  ///< surface point that the probe follows, once it is known
    std::optional<glm::ivec2> loupe_pixel;    ///< centre of the loupe; none: it is hidden
    LoupeMode loupe = LoupeMode::Probed;
    ArtefactRequest artefacts;
    ImportedPicture imported_picture = ImportedPicture::Difference;
    ImportedLeftOut imported_left_out;
    int active_pane = 0;                   ///< pane under the mouse, or where a press began
    Page inspector_page = Page::Settings;  ///< page that the inspector shows
    std::optional<Page> strip_page;        ///< page that the strip below shows; none: the strip is closed
    std::optional<FrozenCamera> frozen;    ///< camera that maps are made for while another one moves

    /// Returns true while the inspector or the strip shows a page.
    bool shows(Page page) const { return inspector_page == page || strip_page == page; }
};

/// Whole state of the editor: the state of each panel, and the state that panels share.
struct EditorState : PictureState {
    History history;
    Log log;
    std::string scene_name;  ///< shown scene: key of a built-in scene, or path of a file
    FilesState files;
    bool between_steps = false;  ///< undo or redo waits for the scene of its step
    ObjectSelection selection;
    Playback playback;
    FrameTimes times;
    std::optional<Flicker> flicker;  ///< set while the key is held that shows A alone
    ArtefactTour artefact_tour;

    EditorLayout layout;
    WindowState window;
    KeyboardState keyboard;
    ShotState shots;

    ScenePanel viewport;
    MapPanel map;
    GalleryPanel gallery;
    SettingsPanel settings_panel;
    EnginePanel engine_panel;
    LightsPanel lights;
    ObjectsPanel objects;
    ProbePanel probe_panel;
    SweepPanel sweep;
    ImprovePanel improve;
    LabPanel lab;
    LightStripPanel light_strip;
    ReportDialog report;
    ImportDialog import_dialog;
    ConvertDialog convert;
};

/// Progress of loading a scene, for the progress bar over the scene picture.
struct LoadingFacts {
    std::string name;         ///< built-in key or path
    double progress = 0;      ///< 0..1
    double seconds_left = 0;  ///< estimated; 0: not known yet
};

/// Progress of drawing a scene's first picture, for the progress bar.
struct DrawingFacts {
    std::string pass;     ///< pass under way
    double progress = 0;  ///< 0..1
};

/// Data that panels show in one frame: the last drawn picture, the scene and results of background work. Pointers may
/// be null: the editor then draws without this data.
struct EditorFrame : ProbeFacts,
                     TunePanelFacts,
                     MapPanelFacts,
                     PresetsFacts,
                     EffectsFacts,
                     ImproveFacts,
                     LabFacts,
                     LightStripFacts,
                     HealthFacts,
                     ImportedFacts {
    const FrameResult* result = nullptr;
    const Settings* drawn = nullptr;  ///< settings of the last frame
    const Scene* scene = nullptr;
    const DriverInfo* driver = nullptr;
    FixSearch fixes;                             ///< of the picture
    FixSearch pixel_fixes;                       ///< of the probed pixel
    const FloatImage* overlay_values = nullptr;  ///< values of the active pane's overlay
    std::span<const LostCaster> lost_casters;    ///< casters that the shown light's map loses
    const ComparisonFacts* comparison = nullptr;
    std::string_view shader_log;
    std::string_view problem;   ///< why there is no picture
    bool driver_reset = false;  ///< the driver has lost the context; the program has to be started again
    std::optional<LoadingFacts> loading;
    std::optional<DrawingFacts> drawing;
    std::optional<ImportFacts> importing;      ///< frame of another engine that is being imported
    const ConvertFacts* conversion = nullptr;  ///< code for state.convert; null: its dialog is closed
    ReportFacts report;
    const SweepFacts* sweep = nullptr;
    std::optional<ReferenceFacts> reference;
    Image traced_so_far;  ///< pixels of the reference in work, alpha 0 where nothing is traced yet; empty: none
    const LiveError* error = nullptr;          ///< errors of the shown frame; null: not known
    const LiveError* earlier_error = nullptr;  ///< errors of the last frame of this scene and light that had them
    std::optional<PictureComparisonFacts> picture_comparison;
    const LoupeFacts* loupe = nullptr;         ///< pixels around state.loupe_pixel; null: not known yet
    bool desktop_dialogs = false;              ///< the desktop's file dialog can be requested
    const ArtefactSpots* artefacts = nullptr;  ///< clusters of the last fulfilled request
};

/// Actions that the panels request from the application in one frame, such as loading a scene. Members want_... name
/// data that a shown panel needs in the next frame.
struct EditorRequests : MapRequests,
                        ReferenceRequests,
                        PresetRequests,
                        SweepRequests,
                        TuneRequests,
                        FixRequests,
                        EffectsRequests,
                        ImproveRequests,
                        LabRequests,
                        LightStripRequests,
                        ReportRequests,
                        HealthRequests,
                        ImportRequests,
                        ConvertRequests,
                        ImportedRequests {
    int scene_width = 0;               ///< wanted width of the scene picture, pixels; 0: it is not shown
    int scene_height = 0;              ///< wanted height
    bool want_overlay_values = false;  ///< the mouse is over a scene picture
    bool want_timing = false;          ///< passes are to be timed
    bool copy_command_line = false;
    bool quit = false;
    std::optional<DesktopFileDialog> open_desktop_dialog;  ///< open the desktop's file dialog
    bool welcomed = false;                                 ///< the welcome was shown
    bool hold_cursor = false;  ///< hide the mouse and let it move without bounds, while the camera flies
    bool redraw = false;       ///< something still moves: draw the next frame soon
    std::optional<ShotRequest> shot;
    bool at_rest = false;  ///< no input: the static picture may get more samples per pixel (view.smooth)
};

/// Smallest size of the editor at scale 1 (a font of 15 pixels), pixels. A smaller window scrolls.
inline constexpr float kMinWindowWidth = 640;
inline constexpr float kMinWindowHeight = 360;

/// Draws the whole editor into the current ImGui frame, and edits state.settings in place. Returns the actions that
/// panels request, which the caller performs before the next frame.
EditorRequests draw_editor(EditorState& state, const EditorFrame& frame);

}  // namespace si
