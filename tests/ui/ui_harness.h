// The editor's panels without any GL: a made-up frame, synthetic mouse and keys, ImGui's own bookkeeping as the
// witness.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/frame/effects.h"
#include "renderer/inspect/dossier.h"
#include "renderer/reference/live_error.h"
#include "tests/ui/drawn_text.h"
#include "ui/state/editor_ui.h"

namespace si::test {

/// A frame of `scene` under `settings` as the renderer would report it, its pictures one white texture.
FrameResult made_up_frame(const Scene& scene, const Settings& settings);
/// A probe with every member filled.
Probe made_up_probe(int lights);

class UiHarness {
public:
    UiHarness(int width, int height, float scale = 1);
    ~UiHarness();
    UiHarness(const UiHarness&) = delete;
    UiHarness& operator=(const UiHarness&) = delete;

    EditorState state;
    Scene scene;
    std::optional<LoadingFacts> loading;
    std::optional<DrawingFacts> drawing;
    std::optional<Settings> frame_settings;  ///< that the last frame was drawn under; else the present ones
    std::optional<SweepFacts> sweep;
    std::vector<PresetEntry> presets, hard_cases;
    std::vector<std::string> recent_scenes, recent_presets;
    std::optional<ComparisonFacts> comparison;
    std::optional<LostFacts> lost;
    std::optional<ReferenceFacts> reference;
    std::optional<LiveError> error;
    std::optional<AgainstFacts> against;
    std::optional<MapFacts> map_facts;
    std::vector<LostCaster> lost_casters;
    std::vector<PixelDiagnosis> diagnoses;
    Sections sections;
    bool tracing_probe = false;
    bool verdict_follows = false;  ///< the probe is of an earlier picture
    std::optional<TuneFacts> tuning;
    std::vector<TunedFamily> tuned;
    bool tuned_current = true;
    FixSearch fixes;
    EffectsShown effects;  ///< where its list is empty, that of the made-up frame
    AdviceShown advice;
    LabShown lab;
    const NumericHealth* health = nullptr;
    const MemoryFacts* memory = nullptr;
    bool driver_reset = false;
    bool desktop_dialogs = false;
    bool with_facts = true;  ///< false: the editor knows no frame yet

    double frame_seconds = 1.0 / 60;
    std::string probed_object = "Root/Box";  ///< what probes find

    /// One frame, `frame_seconds` after the one before. What it prints must be text that its font has.
    EditorActions frame();
    EditorActions frames(int count);
    void move(glm::vec2 to);
    void press(bool down, int button = 0);
    /// Press and release with frames between.
    void click(glm::vec2 at, int button = 0);
    void drag(glm::vec2 from, glm::vec2 to, int button = 0);
    void type(const std::string& text);
    /// The middle of the widget called `label` below the ID `group` (empty: none) of a window whose name holds
    /// `window`; found by moving the mouse. Nothing when it is not on the screen.
    std::optional<glm::vec2> find(const std::string& window, const std::string& group, const std::string& label);
    /// Likewise of a widget deeper in a window: `id` makes its ID of the window's.
    std::optional<glm::vec2> find(const std::string& window, const std::function<unsigned(unsigned)>& id);
    /// The ID under the mouse, 0 for none.
    unsigned hovered() const;
    int width() const { return width_; }
    int height() const { return height_; }

    /// What the last frame printed.
    std::u32string printed() const { return drawn_->read(); }
    std::vector<DrawnText::Letter> letters() const { return drawn_->letters(); }
    const DrawnText& drawn() const { return *drawn_; }

    EditorActions last_wish;  ///< of the last frame that asked for a search or its end

private:
    int width_, height_;
    FrameResult result_;
    std::vector<Effect> effects_;
    Probe probe_;
    DriverInfo driver_;
    std::optional<DrawnText> drawn_;
};

}  // namespace si::test
