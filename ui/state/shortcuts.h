// The table of shortcuts. It dispatches the keys; the overview (F1), menus and tooltips read their key texts from it.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace si {

struct EditorState;
struct EditorFrame;
struct EditorRequests;

/// Action of the editor that a keyboard shortcut triggers. Most have a menu item or a button, too.
enum class Command {
    MouseGesture,  ///< row without a key, for the overview only
    FlyForwards,
    FlyBackwards,
    FlyLeft,
    FlyRight,
    FlyUp,
    FlyDown,
    FrameSelection,
    ResetCamera,
    ToggleLights,
    ToggleLightCamera,
    ToggleFrozenCamera,
    MaximisePanel,
    NextPanel,
    PreviousPanel,
    FocusMenus,
    OpenTab,
    ToggleStrip,
    NextImprovement,
    RestorePanels,
    NextMapPlace,
    NextMapView,
    ForgetProbe,
    MoveProbe,
    ReleaseArrows,
    NextLoupeMode,
    NextWrongPixels,
    ApplyFix,
    RemoveBias,
    ToggleDepthQuads,
    ToggleOverlay,
    HideOverlay,
    NextComparison,
    MoveSwipeLeft,
    MoveSwipeRight,
    PinSettings,
    ShowPinned,
    CancelHandleDrag,
    NextLightType,
    RenameLight,
    HalveResolution,
    DoubleResolution,
    HideSelected,
    IsolateSelected,
    ShowAllObjects,
    TogglePlay,
    SearchSettings,
    OpenFile,
    ReloadScene,
    SavePreset,
    SavePresetAs,
    Export,
    RevertPreset,
    NextPreset,
    PreviousPreset,
    Undo,
    Redo,
    CopyCommandLine,
    SceneScreenshot,
    MapScreenshot,
    WindowScreenshot,
    Quit,
    ToggleOverview,
    CloseOverview,
};

/// Situation of the editor in which a shortcut acts.
enum class When {
    Always,           ///< whatever else takes the keys
    Ready,            ///< no text is typed, no menu or dialog is open, no camera flies, no handle is dragged
    OnePanel,         ///< Ready, while one panel fills the window
    AllPanels,        ///< Ready, while all panels are shown
    ProbeHasArrows,   ///< Ready, after a click has probed a pixel
    NoWidgetFocused,  ///< Ready, and no widget is chosen by the keyboard
    SwipeShown,       ///< Ready, while two pictures are compared by a swipe
    LightsListed,     ///< Ready, while the list of lights is on the screen
    PopupOpen,        ///< a menu or dialog is open; this and the following exclude Ready
    Flying,           ///< the right mouse button is held in the scene picture
    HandleDragged,    ///< a light's handle is being dragged
};

/// Returns true if two situations in which shortcuts act can occur at the same time. Used to check that no key press
/// triggers two shortcuts.
bool can_coincide(When a, When b);

/// State of a modifier key that a shortcut requires.
enum class Modifier { Up, Down, Any };

/// Key of a shortcut, or a range of keys with the same action, with modifiers.
struct Chord {
    const char* name = "";  ///< "F11", "1 to 9"
    bool mapped = false;    ///< the codes are ImGuiKey values; else codes of the window (GLFW), which equal ASCII
    int first = -1;         ///< code of the first key; -1: no key, a mouse gesture
    int last = -1;          ///< code of the last key of the range
    Modifier ctrl = Modifier::Up;
    Modifier shift = Modifier::Any;
    Modifier alt = Modifier::Any;
};

/// Arguments of a shortcut's action.
struct CommandContext {
    EditorState& state;
    const EditorFrame& frame;
    EditorRequests& requests;
    int key = 0;  ///< code of the pressed key, as in Chord::first
};

/// Row of the table of shortcuts: command, key, situation, label and action.
struct Shortcut {
    Command command = Command::MouseGesture;
    Chord chord;
    When when = When::Ready;
    const char* label = "";                           ///< effect of the key; empty: the label of the row before
    void (*action)(const CommandContext&) = nullptr;  ///< null: is_held() is polled, or a mouse gesture
    bool repeats = false;                             ///< acts again while the key is held
    bool joined = false;                              ///< shares its line of the overview with the row before
    const char* section = nullptr;                    ///< heading of the overview that begins with this row
};

/// Returns the table of all keyboard shortcuts, in the order of the overview (F1).
std::span<const Shortcut> shortcuts();

/// Formats the modifiers and the key of a shortcut: "Ctrl+Shift+S".
std::string chord_text(const Chord& chord);
/// Returns the text of the first key that triggers a command ("Ctrl+S"), for menus. The pointer stays valid.
const char* key_text(Command command);
/// Returns a tooltip with a command's key in parentheses added: "Writes preset.json (Ctrl+S)".
std::string with_key(std::string_view tooltip, Command command);

/// Returns true while the key of a command is held down. Ignores modifiers.
bool is_held(Command command);
/// Performs the action of a command as its key would, for menus and buttons.
void run_command(Command command, EditorState& state, const EditorFrame& frame, EditorRequests& requests);
/// Performs the actions of all shortcuts whose keys were pressed in this frame and whose situation (When) applies. Call
/// once a frame.
void dispatch_shortcuts(EditorState& state, const EditorFrame& frame, EditorRequests& requests);

/// Draws the window with the overview of mouse and keyboard, while it is open.
/// @param shown true: the window is open; becomes false when the user closes it
void draw_shortcuts(bool& shown);

/// Assigns the arrow keys to the pixel probe, which they then move, or to ImGui's keyboard navigation, from the next
/// frame on. KeyboardState::probe_has_arrows decides. Call once a frame.
void assign_arrow_keys(EditorState& state);
/// Hides Page up and Page down from ImGui, so that they do not scroll panels, except in menus and dialogs. Takes effect
/// in the next frame; call once a frame.
void assign_page_keys(EditorState& state);

}  // namespace si
