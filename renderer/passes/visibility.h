// Pass that draws each light's visibility into an image of its own.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

class LightMapPass;
class ShadowVolumePasses;

/// Pass that draws the visibility of lights into an image, one layer for each light: by shadow map, blobs, shadow
/// volumes, light map or traced rays (light.source), with contact shadows.
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
    /// Returns the visibility of one light as a 2-D texture, for showing and read-back.
    /// @param light light index
    Image layer_image(int light);

private:
    /// Draws the visibility of all lights, one image layer each. Called when a frame draws this pass.
    /// @param[out] info draw and triangle counts
    void run(FrameState& f, PassInfo& info);
    /// Returns the shader file for the method (light.source) by which a light's visibility is found. Empty when the
    /// light's image layer is not drawn: it is fully lit, or traced visibility is uploaded into it.
    /// @param light light index
    std::string_view source_file(const FrameState& f, std::size_t light) const;

    Targets targets_;
    const ShadowVolumePasses& volumes_;
    const LightMapPass& light_maps_;
};

/// Uploads ray-traced visibility into a light's layer of a visibility image.
/// @param visibility image of the frame's size
/// @param light index of the layer
void upload_traced_visibility(const ReferencePicture& reference, const gl::Target& visibility, int light);

}  // namespace si
