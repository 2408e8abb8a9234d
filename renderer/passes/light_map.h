// Baked light maps on the GPU.
#pragma once

#include <vector>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Uploads what was baked, for lights whose source is a light map: an atlas with a layer a light, and where in it each
/// triangle lies.
class LightMapPass : public FramePass {
public:
    struct Targets {
        gl::Target atlas;  ///< R8, a layer for each light that has one
        gl::Sampler bilinear;
        gl::Buffer objects, triangles, charts;  ///< as sources/light_map.glsl reads them
    };

    void declare(FrameState& f) override;
    /// Binds the buffers by which shaders find a surface in the atlas.
    void bind_buffers(const FrameState& f) const;

private:
    void run(const std::vector<const LightMap*>& maps, PassInfo& info);

    Targets targets_;
};

}  // namespace si
