// Numbers of the frame that panels show: the probe, values and statistics of the depth image, texel coordinates of
// pixels. Each is read back only while a panel shows it, once a drawn frame.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "app/editor/frame_facts.h"
#include "app/editor/pixel_diagnosis.h"
#include "renderer/inspect/probe.h"
#include "renderer/render/renderer.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Read-back of numbers from the GPU for the panels: probed pixel, loupe, map depths, overlay values. Each number is
/// read only while a panel shows it, once per drawn frame.
class EditorReadBack {
public:
    /// Reads back from the GPU the numbers that the panels request. Needs the renderer's OpenGL context. Returns true
    /// if numbers have changed.
    /// @param requests requests of the panels, which name the numbers
    /// @param request FrameRequest (size, outputs and others) that the shown frame was drawn for
    /// @param result the shown frame @param drawn true: the frame was drawn in this update
    /// @throws Error
    bool update(Renderer& renderer, const Scene& scene, const PictureState& state, const EditorRequests& requests,
                const FrameRequest& request, const FrameResult& result, bool drawn);
    /// Finds the map texels that pixels of the frozen camera read. Maps are fitted to the frozen camera while the user
    /// moves another one. Returns true if a frame was drawn for that purpose; the renderer may then no longer hold the
    /// last frame (Renderer::has_images_of()). @throws Error
    bool update_frozen(Renderer& renderer, const Scene& scene, const PictureState& state,
                       const EditorRequests& requests);
    /// Drops the numbers read back from the last frame (probe, loupe, map, overlay). Keeps those of the frozen camera,
    /// to which maps stay fitted while the user moves another one. Call when there is no drawn frame, for example
    /// without a scene.
    void clear();
    /// Returns true if the next update() will have the diagnosis of the probed pixel.
    bool has_news() const { return diagnosis_.ready(); }
    /// Waits until the next update() can diagnose the probed pixel.
    void finish_tracing() const { diagnosis_.wait(); }
    /// Returns all numbers read back so far, with the diagnoses of the probed pixel.
    ReadBackFacts facts() const;

private:
    /// Lists objects that should cast a shadow but leave nothing in the shown light's map (LostCaster), while the list
    /// of objects is shown. Returns true if a new list has objects.
    bool update_lost(const Scene& scene, const PictureState& state, const FrameResult& result);
    // The functions below return true if their numbers have changed.
    /// Probes the chosen pixel of the frame on the GPU: runs its shadow test again with all intermediate numbers.
    /// Returns true if the probe has changed.
    bool update_probe(Renderer& renderer, const Scene& scene, const PictureState& state, const FrameRequest& request,
                      const FrameResult& result);
    /// Reads back the pixels around the centre of the loupe (state.loupe_pixel). Returns true if they have changed.
    bool update_loupe(const PictureState& state, const FrameResult& result);
    /// Reads back the depths of the map viewer's image, and computes their statistics and histogram. Returns true if
    /// they have changed.
    bool update_map(Renderer& renderer, const PictureState& state, const EditorRequests& requests,
                    const FrameResult& result);
    /// Reads back the values of the overlay in the active pane of the scene picture. Returns true if they have changed.
    bool update_overlay(Renderer& renderer, const PictureState& state, const EditorRequests& requests,
                        const FrameResult& result);
    /// Reads back which map texels the kernels fetch (FrameResult::texels_read), and computes their share of the map
    /// (ReadBackFacts::exact_utilisation). Returns true if the share has changed.
    bool update_exact(Renderer& renderer, const EditorRequests& requests, const FrameResult& result);
    /// Reads back each pixel's place in the map, and finds the map texels that the picture reads. Used to link pixels
    /// and texels under the mouse. Returns true if the places have changed.
    bool update_links(Renderer& renderer, const PictureState& state, const EditorRequests& requests,
                      const FrameResult& result);

    /// Marks numbers as read from the present frame. Returns true if they were last read from another frame.
    /// @param of number of the frame that they were last read from
    bool is_due(std::uint64_t& of) const { return std::exchange(of, frame_) != frame_; }

    std::uint64_t frame_ = 0;  ///< number of the drawn frame
    // Numbers of the frames that the facts belong to.
    std::uint64_t probe_of_ = 0, map_of_ = 0, facts_of_ = 0, links_of_ = 0, exact_of_ = 0, overlay_of_ = 0,
                  lost_of_ = 0, loupe_of_ = 0;
    int overlay_pane_ = 0, loupe_pane_ = 0;
    ReadBackFacts facts_;  ///< without the diagnoses, which diagnosis_ has
    EditorPixelDiagnosis diagnosis_;
    std::optional<glm::ivec2> probed_pixel_;
    TrackedMemory held_;              ///< memory of the images read back
    Settings frozen_settings_;        ///< settings that the frozen camera's texels depend on, as last used
    std::uint64_t frozen_scene_ = 0;  ///< Scene::id
};

}  // namespace si
