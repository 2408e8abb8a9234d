// Draws the editor's frames: what changed, read back as far as it is shown, judged by the truth, held against another.
#pragma once

#include <string>

#include "app/editor/against.h"
#include "app/editor/readings.h"
#include "app/editor/rehearsals.h"
#include "app/editor/truth.h"
#include "renderer/frame/effects.h"
#include "renderer/frame/renderer.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Needs a current OpenGL context all its life.
class FrameLoop {
public:
    /// @param state of the editor, which lives longer
    /// @param rehearse the last picture stays while programs of the next are made in the background
    FrameLoop(EditorState& state, bool rehearse) : state_(state) {
        if (rehearse) rehearsals_ = std::make_unique<Rehearsals>();
    }

    /// Draws the scene when anything changed, and whatever follows from it. Errors go to the log. Returns whether the
    /// editor now shows something else. @param comparison what state.compare names; null: not known
    bool update(const Scene& scene, const EditorActions& actions, const ComparisonFacts* comparison);
    /// There is no scene.
    void clear();
    void fill(EditorFrame& frame) const;
    /// Why there is no picture; empty: nothing is wrong.
    const std::string& problem() const { return problem_; }

    /// Size of the scene's picture, in pixels.
    glm::ivec2 size() const { return {request_.width, request_.height}; }
    /// Of the frame drawn last.
    const FrameRequest& request() const { return request_; }
    void save_map(const Scene& scene, const std::string& path);
    /// Whether shader files were saved since the last frame.
    bool poll_shaders() { return shaders_changed_ = renderer_.shaders_changed() || shaders_changed_; }

    std::span<const Dossier> dossiers() const { return readings_.dossiers(); }
    /// The truth of the probed pixel is being sought; the next update() has it.
    bool tracing_probe() const { return readings_.tracing(); }
    bool probe_moved() const { return readings_.has_news(); }
    void finish_probe() const { readings_.finish_tracing(); }
    /// Rays of the picture are being traced, or something is made of them; update() has news of it.
    bool tracing() const { return truth_.busy() || rehearsing(); }
    bool tracing_moved() const { return truth_.moved() || (rehearsals_ && rehearsals_->moved()); }
    void finish_tracing() const {
        if (rehearsals_) rehearsals_->wait();
        truth_.wait();
    }
    /// Programs are being made for a picture that takes the place of the one shown.
    bool rehearsing() const { return rehearsals_ && rehearsals_->busy(); }
    /// Null: every frame makes its own programs.
    const Rehearsals* rehearsals() const { return rehearsals_.get(); }

private:
    bool draw(const Scene& scene, const EditorActions& actions);
    /// Whether the picture shown stays, as programs of the wanted one are not there yet.
    bool waits_for_programs(const Scene& scene, const Settings& settings, const FrameRequest& wanted);
    /// What was just drawn has its programs; of what is likely to be asked next they are made while nothing happens.
    void learn_programs(const Scene& scene);
    bool follow_readings(const Scene& scene, const EditorActions& actions, bool drawn);
    /// Traces and compares what is shown.
    bool follow_truth(const Scene& scene, const EditorActions& actions, bool drawn, const ComparisonFacts* comparison);

    /// Tells what the frame simulates while a panel shows it.
    bool follow_effects(const Scene& scene, const EditorActions& actions, bool drawn);

    EditorState& state_;
    Renderer renderer_;
    FrameRequest request_;
    Settings drawn_settings_;
    std::uint64_t drawn_scene_ = 0;
    std::shared_ptr<const Rig> drawn_rig_;
    bool drawn_ = false, shaders_changed_ = false;
    FrameResult result_;
    std::string problem_, shader_log_;
    EditorReadings readings_;
    EditorTruth truth_;
    EditorAgainst against_;
    std::vector<Effect> frame_effects_;  ///< of the frame drawn last; empty: not asked for yet
    std::vector<Effect> effects_;        ///< these, and what stands behind panels
    std::uint64_t posed_scene_ = 0;      ///< Scene::id of the frame before
    std::uint64_t programs_ = 0;         ///< Renderer::programs_key() of what is to be drawn; 0: not asked for
    std::set<std::uint64_t> foreseen_;
    std::unique_ptr<Rehearsals> rehearsals_;
};

}  // namespace si
