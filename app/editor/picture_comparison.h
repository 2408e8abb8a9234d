// Picture that the editor compares the shown frame with: the reference, or the same frame under other settings.
#pragma once

#include <memory>
#include <optional>

#include "renderer/gl/handle.h"
#include "renderer/render/renderer.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Returns true if two requests have the same picture size, references and light maps.
bool same_inputs(const FrameRequest& a, const FrameRequest& b);

/// Painter of the picture that the shown frame is compared with (the reference, or the frame under other settings), and
/// of the difference image.
class EditorPictureComparison {
public:
    /// Draws the picture that the shown frame is compared with, if it is needed and has changed. Returns true if the
    /// facts have changed. @param frame shown frame @param drawn the frame is a new one
    /// @param comparison settings that state.compare names; null: not known @throws Error
    bool update(Renderer& renderer, const Scene& scene, const PictureState& state, const FrameRequest& request,
                const FrameResult& frame, bool drawn, const ComparisonFacts* comparison);
    /// Drops the picture that the shown frame is compared with, the difference image and the second renderer. Call when
    /// no frame is shown.
    void clear();
    const std::optional<PictureComparisonFacts>& facts() const { return facts_; }

private:
    /// Drops the facts shown for the comparison, and the difference image. The second renderer stays, with its cached
    /// maps.
    void hide();
    /// Draws the picture under the settings that state.compare names, with the second renderer, if its settings, scene
    /// or size have changed.
    void draw_other(const Scene& scene, const PictureState& state, const FrameRequest& request,
                    const ComparisonFacts* comparison);
    /// Computes the difference image of the shown frame and the picture that it is compared with, and the mean of that
    /// image.
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
