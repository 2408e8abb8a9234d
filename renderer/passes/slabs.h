// Drawing of map texels as quads in the scene.
#pragma once

#include <array>
#include <vector>

#include "renderer/frame/plan.h"
#include "renderer/frame/state.h"

namespace si {

class PagePasses;

/// Draws texels of the shown light's map as quads over a pane's picture. Member of PanePasses.
class TexelSlabs {
public:
    /// Images and buffers that TexelSlabs keeps between frames: for each pane the picture with map texels drawn over it
    /// as quads; the instance data of the quads, and the stored depths they were made from.
    struct Targets {
        std::array<gl::Target, kMaxPanes> pictures;
        gl::VertexArray vao;
        gl::Buffer instances;
        int count = 0;
        std::vector<float> depths;  ///< stored depths of the region, bottom row first
        std::uint64_t depths_key = 0, instances_key = 0;
    };

    explicit TexelSlabs(const PagePasses& pages) : pages_(pages) {}
    /// Returns the pass that draws the quads over a pane's picture. The caller sets name, reads and writes.
    Pass make_pass(FrameState& f, const FrameState::ShownPane& pane);

private:
    Targets targets_;
    const PagePasses& pages_;
};

}  // namespace si
