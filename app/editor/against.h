// What the editor's picture is held against: the true picture, or the same frame under a preset.
#pragma once

#include <memory>
#include <optional>

#include "renderer/frame/renderer.h"
#include "ui/state/editor_ui.h"

namespace si {

class EditorAgainst {
public:
    EditorAgainst();
    ~EditorAgainst();

    /// Draws what `state.against` asks for. `frame` is the picture shown, `drawn` whether it is a new one.
    /// @param comparison what state.compare names; null: not known. Returns whether the facts changed.
    /// @throws Error
    bool update(Renderer& renderer, const Scene& scene, const PictureState& state, const FrameRequest& request,
                const FrameResult& frame, bool drawn, const ComparisonFacts* comparison);
    void clear();
    const std::optional<AgainstFacts>& facts() const { return facts_; }

private:
    struct Texture;
    /// Nothing is compared, for now.
    void hide();
    void draw_other(const Scene& scene, const PictureState& state, const FrameRequest& request,
                    const ComparisonFacts* comparison);
    void find_difference(Renderer& renderer, const FrameResult& frame);

    std::optional<AgainstFacts> facts_;
    // A renderer of its own keeps the maps of both sides from frame to frame.
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
