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

/// Events of one update of the frame loop: changes, remarks for the log, driver messages, faulty numbers.
struct FrameNews {
    bool changed = false;                ///< the editor now shows something else
    std::vector<LogLine> remarks;        ///< for the log
    bool release_frozen_camera = false;  ///< the frozen camera cannot be drawn and has to be given up
    std::vector<std::string> driver;     ///< messages of the OpenGL driver
    std::string unsound;  ///< faulty numbers (NaN, infinite, out of range) of the frame; empty: none, or not searched
};

/// Renderer of the editor with everything that is read back from its frames. Needs one current OpenGL context all its
/// life.
class FrameLoop {
public:
    /// Makes the editor's renderer. @param warm_up_shaders compile shaders of likely next frames in the background
    explicit FrameLoop(bool warm_up_shaders) {
        if (warm_up_shaders) warmup_ = std::make_unique<ShaderWarmup>();
    }

    /// Draws the scene if anything has changed, and updates the data (FrameFacts) that shown panels need. Returns what
    /// has changed, with lines for the log; an error becomes such a line.
    /// @param comparison the settings that state.compare names; null: not known
    FrameNews update(const Scene& scene, const PictureState& state, const EditorRequests& requests,
                     const ComparisonFacts* comparison);
    /// Drops the drawn frame and its facts. Call when there is no scene.
    void clear();
    /// Releases memory that only further drawing needs.
    void release_unused_memory() {
        reference_.release_unused_memory();
        renderer_.release_unused_memory();
    }
    /// Returns the facts about the last drawn frame.
    FrameFacts facts() const;

    /// Draws a view of the shown frame into a file. @throws Error
    void save_view(const Scene& scene, const Settings& settings, const View& view, const std::string& path);
    /// Returns true if shader files have been saved since the last frame.
    bool poll_shaders() { return shaders_changed_ = renderer_.shaders_changed() || shaders_changed_; }

    /// Returns the numbers read back from the frames, with the diagnosis of the probed pixel.
    const EditorReadBack& read_back() const { return read_back_; }
    /// Returns the references and light maps that are traced in the background for the picture.
    const EditorReference& reference() const { return reference_; }
    /// Returns the background compilation of shaders; null: switched off.
    const ShaderWarmup* warmup() const { return warmup_.get(); }

private:
    /// Draws a frame if scene, settings or the requested outputs differ from those of the last frame. Returns true if
    /// it has drawn.
    bool draw(const Scene& scene, const PictureState& state, const EditorRequests& requests);
    /// Adds one more sample per pixel to the picture of a static view (view.smooth). Returns true if the picture or the
    /// log has changed; false: the picture has all its samples, or needs none.
    bool add_sample(const Scene& scene, const PictureState& state, const EditorRequests& requests);
    /// Adds an error to the remarks for the log.
    void report(const std::string& error) { news_.remarks.push_back({.kind = LogKind::Error, .text = error}); }
    /// Copies state and reason of the smoothing pass into the report on the shown frame's passes.
    /// @param more result of the frame that has added a sample
    void report_smoothing(const FrameResult& more);
    /// Queues shaders for background compilation that a hover, a click or the map viewer would need next.
    void queue_likely_shaders(const Scene& scene);
    /// Reads back the numbers that panels show. Returns true if they have changed. @param drawn the frame is a new one
    bool follow_read_back(const Scene& scene, const PictureState& state, const EditorRequests& requests, bool drawn);
    /// Traces the ray-traced reference of the shown picture and compares the picture with it. Returns true if the facts
    /// have changed. @param drawn the frame is a new one @param comparison settings that state.compare names
    bool follow_reference(const Scene& scene, const PictureState& state, const EditorRequests& requests, bool drawn,
                          const ComparisonFacts* comparison);
    /// Compares the shown imported map with the drawn one while a panel shows that. Returns true if the facts have
    /// changed.
    bool follow_map_comparison(const Scene& scene, const PictureState& state, const EditorRequests& requests);
    /// Searches the frame for faulty numbers (NaN, infinite, out of range) while a panel shows them. Returns true if
    /// the result has changed.
    bool follow_health();
    /// Searches the frame just drawn for faulty numbers (--check-numeric), and waits for the result.
    void require_sound_numbers(const Scene& scene);
    /// Lists the frame's effects while a panel shows them. Returns true if the list has changed.
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
    bool artefacts_found_ = false;             ///< since the frame drawn last
    std::vector<Effect> frame_effects_;        ///< of the last frame; empty: not requested yet
    std::uint64_t posed_scene_ = 0;            ///< Scene::id of the frame before
    std::set<std::uint64_t> warmed_programs_;  ///< Renderer::programs_key() of frames whose next shaders are queued
    std::unique_ptr<ShaderWarmup> warmup_;
};

}  // namespace si
