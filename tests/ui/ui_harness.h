// Harness that draws the editor's panels without OpenGL: a made-up frame, synthetic mouse and keys.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/inspect/effects.h"
#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/reference/live_error.h"
#include "tests/ui/drawn_text.h"
#include "ui/state/editor_ui.h"

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
    std::optional<Settings> frame_settings;  ///< settings of the last frame; nothing: the present settings
    std::optional<SweepFacts> sweep;
    std::vector<PresetEntry> presets, hard_cases;
    std::vector<std::string> recent_scenes, recent_presets;
    std::optional<ComparisonFacts> comparison;
    std::optional<LostFacts> lost;
    std::optional<ReferenceFacts> reference;
    std::optional<LiveError> error;
    std::optional<PictureComparisonFacts> picture_comparison;
    std::optional<MapPlots> map_facts;
    std::vector<LostCaster> lost_casters;
    std::vector<PixelDiagnosis> diagnoses;
    Sections sections;
    bool tracing_probe = false;
    bool verdict_follows = false;  ///< whether the probe belongs to an earlier picture
    std::optional<SearchProgress> tuning;
    std::vector<TunedFamily> tuned;
    bool tuned_current = true;
    FixSearch fixes;
    EffectsFacts effects;  ///< effects to show; an empty list is replaced by the made-up frame's
    AdvicePanelFacts advice;
    LabFacts lab;
    const NumericHealth* health = nullptr;
    const MemoryReport* memory = nullptr;
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
    /// Drags the mouse with a button from one position to another, pixels.
    void drag(glm::vec2 from, glm::vec2 to, int button = 0);
    /// Types a text and draws two frames.
    void type(const std::string& text);
    /// Returns the centre in pixels of a widget, found by moving the mouse. `window` is part of a window's name,
    /// `group` the widget's parent ID (empty: none), `label` its own ID. Returns nothing for a widget that is not on
    /// the screen.
    std::optional<glm::vec2> find(const std::string& window, const std::string& group, const std::string& label);
    /// Returns the centre in pixels of a nested widget. `id` computes the widget's ID from the window's ID.
    std::optional<glm::vec2> find(const std::string& window, const std::function<unsigned(unsigned)>& id);
    /// Returns the ID of the hovered widget; 0 for none.
    unsigned hovered() const;
    /// Returns the width of the screen, pixels.
    int width() const { return width_; }
    /// Returns the height of the screen, pixels.
    int height() const { return height_; }

    /// Returns the text of the last frame without spaces.
    std::u32string printed() const { return drawn_->read(); }
    /// Returns the letters of the last frame with their boxes.
    std::vector<DrawnText::Letter> letters() const { return drawn_->letters(); }
    /// Returns the reader of the last frame's text.
    const DrawnText& drawn() const { return *drawn_; }

    EditorRequests last_requests;  ///< requests of the last frame that started or cancelled a search

private:
    int width_, height_;
    FrameResult result_;
    std::vector<Effect> effects_;
    Probe probe_;
    DriverInfo driver_;
    std::optional<DrawnText> drawn_;
};

}  // namespace si::test
