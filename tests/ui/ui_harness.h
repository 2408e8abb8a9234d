// Harness that draws the editor's panels without OpenGL: a made-up frame, synthetic mouse and keys.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/advise/least_bias.h"
#include "renderer/inspect/effects.h"
#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/reference/live_error.h"
#include "tests/support/caller.h"
#include "tests/ui/drawn_text.h"
#include "ui/state/editor_ui.h"

struct ImGuiWindow;
struct ImRect;

namespace si::test {

/// Returns the FrameResult that the renderer would report for `scene` under `settings`. All pictures are one white
/// texture.
FrameResult made_up_frame(const Scene& scene, const Settings& settings);
/// Returns a probe of a pixel with every member filled, for so many lights.
Probe made_up_probe(int lights);

/// Editor panels over made-up facts. Tests set the public members, draw frames and read the drawn text.
class UiHarness {
public:
    /// Creates an ImGui context of a size in pixels. @param scale user interface scale
    UiHarness(int width, int height, float scale = 1);
    ~UiHarness();
    UiHarness(const UiHarness&) = delete;
    UiHarness& operator=(const UiHarness&) = delete;

    EditorState state;
    Scene scene;
    std::optional<LoadingFacts> loading;
    std::optional<DrawingFacts> drawing;
    std::optional<ImportFacts> importing;
    std::optional<Settings> frame_settings;  ///< settings of the last frame; nothing: the present settings
    std::optional<SweepFacts> sweep;
    std::vector<PresetEntry> presets, hard_cases;
    std::vector<std::string> recent_scenes, recent_presets;
    std::optional<ComparisonFacts> comparison;
    std::optional<LostFacts> lost;
    std::optional<ReferenceFacts> reference;
    std::optional<LiveError> error, earlier_error;
    std::optional<PictureComparisonFacts> picture_comparison;
    std::optional<MapPlots> map_facts;
    std::vector<LostCaster> lost_casters;
    std::vector<PixelDiagnosis> diagnoses;
    Sections sections;
    bool tracing_probe = false;
    bool verdict_follows = false;  ///< whether the probe belongs to an earlier picture
    std::optional<SearchProgress> tuning;
    FoundBias tuned;
    bool tuned_current = true;
    FixSearch fixes;
    EffectsFacts effects;  ///< effects to show; an empty list is replaced by the made-up frame's
    ImproveFacts advice;
    LabFacts lab;
    LightStripFacts light_strip;
    ReportFacts report;
    std::optional<ConvertFacts> conversion;
    const NumericHealth* health = nullptr;
    const MemoryReport* memory = nullptr;
    bool maps_imported = false;  ///< the lights' maps are imported, with an unknown bias
    ImportedFacts imported;      ///< comparison of the shown imported map
    bool scene_saved = false;    ///< another program has saved the scene
    bool driver_reset = false;
    bool desktop_dialogs = false;
    bool with_facts = true;  ///< false: no frame has been drawn yet

    double frame_seconds = 1.0 / 60;
    std::string probed_object = "Root/Box";  ///< object path that probes report

    /// Draws one frame, `frame_seconds` after the previous one, and returns the panels' requests. Fails the test if a
    /// letter is missing in the font.
    EditorRequests frame();
    /// Draws `count` frames and returns the requests of the last.
    EditorRequests frames(int count);
    /// Moves the mouse to a position in pixels. The next frame sees the move.
    void move(glm::vec2 to);
    /// Presses or releases a mouse button (0: left). The next frame sees the change.
    void press(bool down, int button = 0);
    /// Presses and releases a mouse button at a position in pixels, with frames between.
    void click(glm::vec2 at, int button = 0);
    /// Clicks a widget that find() returned. Fails the test at the caller's line if find() returned nothing.
    void click(std::optional<glm::vec2> widget, int button = 0, Caller caller = Caller::here());
    /// Presses and releases the left button at the mouse's position. Returns the requests of the frame of the release.
    EditorRequests click_here();
    /// Presses and releases a key, a frame each. Returns the requests of the frame with the pressed key.
    EditorRequests key(int code);
    /// Drags the mouse with a button from one position to another, pixels.
    void drag(glm::vec2 from, glm::vec2 to, int button = 0);
    /// Types a text and draws two frames.
    void type(const std::string& text);
    /// Returns a position in pixels at which the mouse hovers a widget. `window` is part of a window's name, `group`
    /// the widget's parent ID (empty: none), `label` its own ID. Returns nothing for a widget that is not on the
    /// screen.
    std::optional<glm::vec2> find(const std::string& window, const std::string& group, const std::string& label);
    /// Returns a position in pixels at which the mouse hovers a nested widget. `id` computes the widget's ID from the
    /// window's ID.
    std::optional<glm::vec2> find(const std::string& window, const std::function<unsigned(unsigned)>& id);
    /// Returns a position in pixels at which the mouse hovers a choice in the open list of item_combo(). Returns
    /// nothing for a choice that is not on the screen.
    std::optional<glm::vec2> find_choice(int value, const std::string& label);
    /// Returns the ID of the hovered widget; 0 for none.
    unsigned hovered() const;
    /// Returns the width of the screen, pixels.
    int width() const { return width_; }
    /// Returns the height of the screen, pixels.
    int height() const { return height_; }

    /// Returns the text of the last frame without spaces.
    std::u32string printed() const { return drawn_->read(); }
    /// Returns the ASCII text of the last frame without spaces, with a question mark for each other letter.
    std::string ascii() const;
    /// Finds parts that the last frame's text lacks, spaces aside.
    /// @returns the first missing part with the text; empty if the text has all parts
    std::string lacking(std::initializer_list<std::string_view> parts) const;
    /// Returns whether the last frame's text has a part, spaces aside.
    bool prints(std::string_view part) const { return lacking({part}).empty(); }
    /// Returns the first shown window whose name holds a text; null if none.
    static ImGuiWindow* window(std::string_view part_of_name);
    /// Returns the letters of the last frame with their boxes.
    std::vector<DrawnText::Letter> letters() const { return drawn_->letters(); }
    /// Returns the reader of the last frame's text.
    const DrawnText& drawn() const { return *drawn_; }

    EditorRequests last_requests;  ///< requests of the last frame that started or cancelled a search

private:
    /// Draws a frame that looks for a widget. Returns the widget's box; an empty box if the window lacks the widget.
    ImRect box_of(ImGuiWindow* window, unsigned id);

    int width_, height_;
    std::string sought_;  ///< names of the last widget that find() looked for
    FrameResult result_;
    std::vector<Effect> effects_;
    Probe probe_;
    DriverInfo driver_;
    std::optional<DrawnText> drawn_;
};

}  // namespace si::test
