// Pass that uploads baked light maps.
#pragma once

#include <vector>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Pass that uploads baked visibility for lights whose source is a light map. The atlas texture has a layer for each
/// light. Buffers map each triangle to its chart, the part of the atlas with the triangle's texels.
class LightMapPass : public FramePass {
public:
    /// Image and buffers that LightMapPass keeps between frames: the GPU copy of the baked light maps.
    struct Targets {
        gl::Target atlas;  ///< R8, a layer for each light with a light map
        gl::Sampler bilinear;
        gl::Buffer objects, triangles, charts;  ///< layout in sources/light_map.glsl
    };

    void declare(FrameState& f) override;
    /// Binds the storage buffers from which shaders compute the light map atlas coordinates of a surface point, and
    /// writes the frame's origin into them. Call before visibility is drawn for a light with a light map.
    void bind_buffers(const FrameState& f) const;

private:
    /// Uploads the baked light maps of a frame, one atlas layer each. Called when a frame draws this pass.
    /// @param maps the frame's light maps, not null, all with the same atlas layout
    /// @param[in,out] info report on the pass; sizes of the light maps are appended to its reason
    void run(const std::vector<const LightMap*>& maps, PassInfo& info);

    Targets targets_;
};

}  // namespace si
