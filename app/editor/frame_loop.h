// Draws the editor's frames: what changed, read back as far as it is shown, judged by the truth, held against another.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "app/editor/against.h"
#include "app/editor/frame_facts.h"
#include "app/editor/readings.h"
#include "app/editor/rehearsals.h"
#include "app/editor/truth.h"
#include "renderer/frame/effects.h"
#include "renderer/frame/renderer.h"
#include "ui/state/editor_ui.h"

namespace si {

/// What came of an update, besides the facts.
struct FrameNews {
    bool changed = false;             ///< the editor now shows something else
    std::vector<LogLine> remarks;     ///< for the log
    bool thaw = false;                ///< nothing can be drawn for the frozen camera
    std::vector<std::string> driver;  ///< what it complained of
    std::string unsound;              ///< which numbers of what was drawn are none, where they are searched for
};

/// Needs a current OpenGL context all its life, always the same.
class FrameLoop {
public:
    /// @param foresee programs that are likely to be asked for next are made in the background
    explicit FrameLoop(bool foresee) {
        if (foresee) rehearsals_ = std::make_unique<Rehearsals>();
    }

    /// Draws the scene when anything changed, and whatever follows from it. Errors are remarks.
    /// @param comparison what state.compare names; null: not known
    FrameNews update(const Scene& scene, const PictureState& state, const EditorActions& actions,
                     const ComparisonFacts* comparison);
    /// There is no scene.
    void clear();
    /// Nothing is drawn for a while.
    void rest() {
        reference_.rest();
        renderer_.give_back_memory();
    }
    FrameFacts facts() const;

    void save_map(const Scene& scene, const Settings& settings, const std::string& path);
    /// Whether shader files were saved since the last frame.
    bool poll_shaders() { return shaders_changed_ = renderer_.shaders_changed() || shaders_changed_; }

    /// The truth of the probed pixel was sought; the next update() has it.
    bool probe_moved() const { return readings_.has_news(); }
    void finish_probe() const { readings_.finish_tracing(); }
    /// Rays of the picture are being traced, or something is made of them; update() has news of it.
    bool tracing() const { return reference_.busy(); }
    bool tracing_moved() const { return reference_.moved(); }
    void finish_tracing() const { reference_.wait(); }
    /// Null: nothing is foreseen.
    const Rehearsals* rehearsals() const { return rehearsals_.get(); }

private:
    bool draw(const Scene& scene, const PictureState& state, const EditorActions& actions);
    /// One shading more of a view that rests. Returns whether there was one to add.
    bool smooth(const Scene& scene, const PictureState& state, const EditorActions& actions);
    void report(const std::string& error) { news_.remarks.push_back({.kind = LogKind::Error, .text = error}); }
    /// Of what the pass did in that frame, the shown one's effects tell.
    void tell_of_smoothing(const FrameResult& more);
    /// Of what is likely to be asked after what was just drawn, programs are made while nothing happens.
    void foresee_programs(const Scene& scene);
    bool follow_readings(const Scene& scene, const PictureState& state, const EditorActions& actions, bool drawn);
    /// Traces and compares what is shown.
    bool follow_reference(const Scene& scene, const PictureState& state, const EditorActions& actions, bool drawn,
                          const ComparisonFacts* comparison);
    /// Searches the frame's numbers while a panel shows what is found.
    bool follow_health();
    /// Searches the frame just drawn, and waits for it.
    void require_sound_numbers(const Scene& scene);
    /// Tells what the frame simulates while a panel shows it.
    bool follow_effects(const Scene& scene, const PictureState& state, const EditorActions& actions, bool drawn);

    Renderer renderer_;
    FrameRequest request_;
    Settings drawn_settings_;
    std::uint64_t drawn_scene_ = 0;
    std::shared_ptr<const Rig> drawn_rig_;
    bool drawn_ = false, shaders_changed_ = false, driver_reset_ = false;
    FrameResult result_;
    FrameNews news_;
    bool pinned_ = false;
    int smoothed_ = 0;  ///< shadings that the smooth picture of the frame drawn last is made of
    std::string problem_, shader_log_;
    EditorReadings readings_;
    EditorReference reference_;
    EditorAgainst against_;
    std::shared_ptr<const NumericHealth> health_;  ///< of the frame drawn last; null: not asked for, or not there yet
    ArtefactSpots artefacts_;                      ///< of the last wish that was fulfilled
    bool artefacts_found_ = false;                 ///< since the frame drawn last
    std::vector<Effect> frame_effects_;            ///< of the frame drawn last; empty: not asked for yet
    std::vector<Effect> effects_;                  ///< these, and what stands behind panels
    std::uint64_t posed_scene_ = 0;                ///< Scene::id of the frame before
    std::set<std::uint64_t> foreseen_;             ///< Renderer::programs_key() of frames whose followers are
    std::unique_ptr<Rehearsals> rehearsals_;
};

}  // namespace si
