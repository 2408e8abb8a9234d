// Drawing of map texels as quads in the scene.
#pragma once

#include <array>
#include <vector>

#include "renderer/frame/plan.h"
#include "renderer/frame/state.h"

namespace si {

class PagePasses;

/// Helper of PanePasses that draws texels of the shown shadow map as quads over the picture of a pane (view.slabs).
class TexelSlabs {
public:
    /// Images and buffers that TexelSlabs keeps between frames: for each pane the picture with map texels drawn over it
    /// as quads, the instance data of the quads, and the stored depths from which the quads were made.
    struct Targets {
        std::array<gl::Target, kMaxPanes> pictures;
        gl::VertexArray vao;
        gl::Buffer instances;
        int count = 0;
        std::vector<float> depths;  ///< stored depths of the region, bottom row first
        std::uint64_t depths_key = 0, instances_key = 0;
    };

    explicit TexelSlabs(const PagePasses& pages) : pages_(pages) {}
    /// Returns the pass that draws texels of a shadow map as quads over a pane's picture. The caller sets the pass's
    /// name, reads and writes.
    Pass make_pass(FrameState& f, const FrameState::ShownPane& pane);

private:
    Targets targets_;
    const PagePasses& pages_;
};

}  // namespace si
