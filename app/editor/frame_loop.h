// Draws the editor's frames when something has changed, reads back shown numbers, and compares with the reference.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "app/editor/frame_facts.h"
#include "app/editor/map_comparison.h"
#include "app/editor/picture_comparison.h"
#include "app/editor/read_back.h"
#include "app/editor/reference.h"
#include "app/editor/reference_preview.h"
#include "app/editor/shader_warmup.h"
#include "app/report/views.h"
#include "renderer/inspect/effects.h"
#include "renderer/render/renderer.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Outcome of one FrameLoop::update(): changes, remarks for the log, driver messages and invalid numbers.
struct FrameNews {
    bool changed = false;                ///< the editor has to be drawn again
    std::vector<LogLine> remarks;        ///< lines for the log
    bool release_frozen_camera = false;  ///< drawing for the frozen camera failed, so that the editor must unfreeze it
    std::vector<std::string> driver;     ///< messages of the OpenGL driver
    std::string unsound;  ///< faulty numbers (NaN, infinite, out of range) of the frame; empty: none, or not searched
};

/// Renderer of the editor's picture, with the data that panels derive from the picture: numbers read back, ray-traced
/// reference, comparisons. Draws only if something has changed. Needs one current OpenGL context all its life.
class FrameLoop {
public:
    /// Makes the editor's renderer. @param warm_up_shaders compile shaders of likely next frames in the background
    explicit FrameLoop(bool warm_up_shaders) {
        if (warm_up_shaders) warmup_ = std::make_unique<ShaderWarmup>();
    }

    /// Draws the scene if anything has changed, and updates the data (FrameFacts) that shown panels need. Returns what
    /// has changed, with lines for the log; an error becomes such a line. Call once a frame of the window.
    /// @param comparison settings to compare the picture with (state.compare); null: not loaded yet
    FrameNews update(const Scene& scene, const PictureState& state, const EditorRequests& requests,
                     const ComparisonFacts* comparison);
    /// Drops the last drawn frame, its data and its ray-traced references. Call while the editor shows no scene.
    void clear();
    /// Releases memory that only further drawing needs.
    void release_unused_memory() {
        reference_.release_unused_memory();
        renderer_.release_unused_memory();
    }
    /// Returns the data of the last drawn frame, for the panels.
    FrameFacts facts() const;

    /// Draws a view of the shown frame (the picture, or a depth map) into a file. @throws Error
    void save_view(const Scene& scene, const Settings& settings, const View& view, const std::string& path);
    /// Reads changed shader files again. Returns true if shader files have changed since the last drawn frame, so that
    /// the scene has to be drawn again.
    bool poll_shaders() { return shaders_changed_ = renderer_.reload_changed_shaders() || shaders_changed_; }

    /// Returns the numbers read back from the frames, with the diagnosis of the probed pixel.
    const EditorReadBack& read_back() const { return read_back_; }
    /// Returns the references and light maps that are traced in the background for the picture.
    const EditorReference& reference() const { return reference_; }
    /// Returns the background compilation of shaders; null: switched off.
    const ShaderWarmup* warmup() const { return warmup_.get(); }

private:
    /// Draws a frame if scene, settings or the requested outputs differ from those of the last frame. Returns true if a
    /// frame was drawn, or could not be drawn; errors go to the log.
    bool draw(const Scene& scene, const PictureState& state, const EditorRequests& requests);
    /// Adds one more anti-aliasing sample per pixel to the picture while nothing moves (view.smooth). Returns true if
    /// the picture or the log has changed. Returns false if the picture has all its samples, or needs none.
    bool add_sample(const Scene& scene, const PictureState& state, const EditorRequests& requests);
    /// Adds an error to the remarks for the log.
    void report(const std::string& error) { news_.remarks.push_back({.kind = LogKind::Error, .text = error}); }
    /// Updates state and reason of the smoothing pass in the shown frame's list of passes. This pass averages
    /// anti-aliasing samples.
    /// @param more result of the frame that has added a sample
    void report_smoothing(const FrameResult& more);
    /// Queues the shaders that a hover, a click or the map viewer would need next, for compilation in the background.
    /// The first hover or click then does not wait for the driver.
    void queue_likely_shaders(const Scene& scene);
    /// Reads back from the GPU the numbers that panels show. Returns true if they have changed. @param drawn true: the
    /// frame was drawn in this update
    bool follow_read_back(const Scene& scene, const PictureState& state, const EditorRequests& requests, bool drawn);
    /// Continues to trace the reference of the shown picture, and updates everything compared with the picture:
    /// reference, clusters of wrong pixels, other settings. Returns true if the editor has to be drawn again.
    /// @param drawn true: the frame was drawn in this update
    /// @param comparison settings to compare the picture with (state.compare); null: not loaded yet
    bool follow_reference(const Scene& scene, const PictureState& state, const EditorRequests& requests, bool drawn,
                          const ComparisonFacts* comparison);
    /// Compares the shown imported map (another engine's shadow map) with the map that this program draws from the same
    /// light, while a panel requests it. Returns true if the result has changed.
    bool follow_map_comparison(const Scene& scene, const PictureState& state, const EditorRequests& requests);
    /// Fetches the result of the search for invalid numbers (NaN, infinite, out of range) in the frame, while a panel
    /// requests the search. Returns true if the result has changed, or is not finished yet.
    bool follow_health();
    /// Searches the frame just drawn for invalid numbers (NaN, infinite, out of range), and waits for the result.
    /// Invalid numbers are reported in the log and in FrameNews::unsound. Used for the option --check-numeric.
    void require_sound_numbers(const Scene& scene);
    /// Lists the work of the frame (effects: each drawn, cached or skipped, with a reason) while the panel Effects is
    /// shown. Returns true if the list has changed. @param drawn true: the frame was drawn in this update
    bool follow_effects(const Scene& scene, const PictureState& state, const EditorRequests& requests, bool drawn);

    Renderer renderer_;
    Settings drawn_settings_;
    std::uint64_t drawn_scene_ = 0;
    std::shared_ptr<const Rig> drawn_rig_;
    bool drawn_ = false, shaders_changed_ = false;
    /// Facts of the last frame. facts() adds driver, readings, reference and comparison, and drops the result while
    /// nothing is drawn.
    FrameFacts facts_;
    FrameNews news_;
    bool pinned_ = false;
    int smoothed_ = 0;  ///< samples per pixel that the smooth picture of the last frame has
    EditorReadBack read_back_;
    EditorReference reference_;
    PreviewOfReference preview_;
    EditorPictureComparison picture_comparison_;
    EditorMapComparison map_comparison_;
    bool artefacts_found_ = false;             ///< wrong pixels were searched for clusters since the last drawn frame
    std::vector<Effect> frame_effects_;        ///< work of the last frame; empty: not requested yet
    std::uint64_t posed_scene_ = 0;            ///< Scene::id of the frame before
    std::set<std::uint64_t> warmed_programs_;  ///< Renderer::programs_key() of frames whose next shaders are queued
    std::unique_ptr<ShaderWarmup> warmup_;
};

}  // namespace si
