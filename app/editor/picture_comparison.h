// The other side of the editor's picture comparison: the reference, or the same frame under other settings.
#pragma once

#include <memory>
#include <optional>

#include "renderer/render/renderer.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Draws the other picture and the difference of both.
class EditorPictureComparison {
public:
    EditorPictureComparison();
    ~EditorPictureComparison();

    /// Draws the other picture if it is needed and has changed. Returns true if the facts have changed.
    /// @param frame the picture that is shown @param drawn it is a new one
    /// @param comparison settings that state.compare names; null: not known @throws Error
    bool update(Renderer& renderer, const Scene& scene, const PictureState& state, const FrameRequest& request,
                const FrameResult& frame, bool drawn, const ComparisonFacts* comparison);
    /// Drops both pictures, when there is no frame.
    void clear();
    const std::optional<PictureComparisonFacts>& facts() const { return facts_; }

private:
    struct Texture;
    /// Drops the facts while nothing is compared. The other renderer keeps its maps.
    void hide();
    void draw_other(const Scene& scene, const PictureState& state, const FrameRequest& request,
                    const ComparisonFacts* comparison);
    void find_difference(Renderer& renderer, const FrameResult& frame);

    std::optional<PictureComparisonFacts> facts_;
    // A second renderer, so that the maps of both sides stay cached from frame to frame.
    std::unique_ptr<Renderer> other_;
    std::unique_ptr<Texture> difference_;
    Settings other_drawn_;
    std::uint64_t other_scene_ = 0;
    int other_width_ = 0, other_height_ = 0;
    std::shared_ptr<const ReferencePicture> other_reference_;
    std::vector<std::shared_ptr<const ReferencePicture>> other_traced_;
    std::vector<std::shared_ptr<const LightMap>> other_light_maps_;
    std::string other_problem_;  ///< why there is no other picture
};

}  // namespace si
