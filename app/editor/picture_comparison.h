// The other side of the editor's picture comparison: the reference, or the same frame under other settings.
#pragma once

#include <memory>
#include <optional>

#include "renderer/gl/handle.h"
#include "renderer/render/renderer.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Returns true if two requests have the same picture size, references and light maps.
bool same_inputs(const FrameRequest& a, const FrameRequest& b);

/// Painter of the other side of a picture comparison (reference, or other settings) and of the difference image.
class EditorPictureComparison {
public:
    /// Draws the other picture of the comparison if it is needed and has changed. Returns true if the facts have
    /// changed. @param frame shown frame @param drawn the frame is a new one
    /// @param comparison settings that state.compare names; null: not known @throws Error
    bool update(Renderer& renderer, const Scene& scene, const PictureState& state, const FrameRequest& request,
                const FrameResult& frame, bool drawn, const ComparisonFacts* comparison);
    /// Drops the other picture, the difference image and the second renderer. Call when no frame is shown.
    void clear();
    const std::optional<PictureComparisonFacts>& facts() const { return facts_; }

private:
    /// Drops the facts shown for the comparison, and the difference image. The second renderer stays, with its cached
    /// maps.
    void hide();
    /// Draws the other picture with the second renderer, if its settings, scene or size have changed.
    void draw_other(const Scene& scene, const PictureState& state, const FrameRequest& request,
                    const ComparisonFacts* comparison);
    /// Computes the difference image of both pictures and its mean.
    void find_difference(Renderer& renderer, const FrameResult& frame);

    std::optional<PictureComparisonFacts> facts_;
    // A second renderer, so that the maps of both sides stay cached from frame to frame.
    std::unique_ptr<Renderer> other_;
    gl::Texture difference_;
    Settings other_drawn_;
    std::uint64_t other_scene_ = 0;
    FrameRequest other_request_;
    std::string other_problem_;  ///< why there is no other picture
};

}  // namespace si
