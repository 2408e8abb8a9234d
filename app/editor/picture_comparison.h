// Picture that the editor compares the shown frame with: the reference, or the same frame under other settings.
#pragma once

#include <memory>
#include <optional>

#include "renderer/gl/handle.h"
#include "renderer/render/renderer.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Returns true if two frame requests have the same picture size, camera for fitting maps, ray-traced references and
/// light maps. FrameRequest::with_look, which turns view.look on, must be equal too. If not, the picture must be drawn
/// again.
bool same_inputs(const FrameRequest& a, const FrameRequest& b);

/// Comparison of the shown frame with its ray-traced reference, or with the frame under other settings. Draws the other
/// picture and the difference image.
class EditorPictureComparison {
public:
    /// Updates the picture that the shown frame is compared with, and the difference image, if they are shown and have
    /// changed. Returns true if the editor has to be drawn again.
    /// @param request request that the shown frame was drawn for
    /// @param frame the shown frame @param drawn true: the frame was drawn in this update
    /// @param comparison settings to compare the shown frame with (state.compare); null: not loaded yet
    /// @throws Error
    bool update(Renderer& renderer, const Scene& scene, const PictureState& state, const FrameRequest& request,
                const FrameResult& frame, bool drawn, const ComparisonFacts* comparison);
    /// Drops the picture that the shown frame is compared with, and the difference image. Drops the second renderer,
    /// too, which draws the frame under other settings. Call when no frame is shown.
    void clear();
    const std::optional<PictureComparisonFacts>& facts() const { return facts_; }

private:
    /// Drops the picture that the shown frame is compared with, and the difference image. The second renderer stays
    /// with its cached maps, so that the next comparison begins fast.
    void hide();
    /// Draws the frame under the settings that state.compare chooses, with a second renderer, if settings, scene or
    /// size have changed. @param comparison those settings; null: not loaded yet, so that nothing is drawn
    void draw_other(const Scene& scene, const PictureState& state, const FrameRequest& request,
                    const ComparisonFacts* comparison);
    /// Computes the difference image of the shown frame and the picture compared with it, and the mean absolute
    /// difference. Does nothing if the two pictures differ in size.
    void find_difference(Renderer& renderer, const FrameResult& frame);

    std::optional<PictureComparisonFacts> facts_;
    // A second renderer, so that the maps of both sides stay cached from frame to frame.
    std::unique_ptr<Renderer> other_;
    gl::Texture difference_;
    Settings other_drawn_;
    std::uint64_t other_scene_ = 0;
    FrameRequest other_request_;
    std::string other_problem_;  ///< reason why the second renderer has drawn no picture
};

}  // namespace si
