// Pass that draws each light's visibility into an image of its own.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

class LightMapPass;
class ShadowVolumePasses;

/// Draws the visibility of each light into a layer, by the light's source, with contact shadows.
class VisibilityPass : public FramePass {
public:
    /// Image that VisibilityPass draws and keeps between frames: the visibility of all lights, one layer each.
    struct Targets {
        gl::Target visibility;  ///< R32F, a layer for each light
        gl::Texture view;       ///< 2-D texture view of one layer
        int view_layer = -1;
    };

    VisibilityPass(const ShadowVolumePasses& volumes, const LightMapPass& light_maps)
        : volumes_(volumes), light_maps_(light_maps) {}
    void declare(FrameState& f) override;
    /// Returns one light's visibility layer as a 2-D texture, for showing and read-back.
    Image layer_image(int light);

private:
    /// Draws the visibility of all lights. Called when the plan runs the pass.
    /// @param[out] info draw counts
    void run(FrameState& f, PassInfo& info);
    /// Returns the shader file that evaluates a light's source. Empty: no drawing is needed, as the layer is fully lit
    /// or already uploaded.
    std::string_view source_file(const FrameState& f, std::size_t light) const;

    Targets targets_;
    const ShadowVolumePasses& volumes_;
    const LightMapPass& light_maps_;
};

/// Uploads a ray-traced visibility into a light's layer of a visibility image of the frame's size.
void upload_traced_visibility(const ReferencePicture& reference, const gl::Target& visibility, int light);

}  // namespace si
