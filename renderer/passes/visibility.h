// Visibility of each light as a texture of its own.
#pragma once

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

class LightMapPass;
class ShadowVolumePasses;

/// Draws the visibility of each light into a layer, by the light's source, with contact shadows.
class VisibilityPass : public FramePass {
public:
    struct Targets {
        gl::Target visibility;  ///< R32F, a layer a light
        gl::Texture view;       ///< one layer of it as a 2-D texture
        int view_layer = -1;
    };

    VisibilityPass(const ShadowVolumePasses& volumes, const LightMapPass& light_maps)
        : volumes_(volumes), light_maps_(light_maps) {}
    void declare(FrameState& f) override;
    /// Returns one light's layer as a plain texture.
    Image layer_image(int light);

private:
    void run(FrameState& f, PassInfo& info);
    /// Returns the file that is drawn to evaluate a light. Empty: its layer is all lit, or there already.
    std::string_view source_file(const FrameState& f, std::size_t light) const;

    Targets targets_;
    const ShadowVolumePasses& volumes_;
    const LightMapPass& light_maps_;
};

/// Writes what rays found into a light's layer of a visibility texture of the frame's size.
void upload_traced_visibility(const ReferencePicture& reference, const gl::Target& visibility, int light);

}  // namespace si
