// Texels of the shown light's map as quads in the scene.
#pragma once

#include <array>
#include <vector>

#include "renderer/frame/plan.h"
#include "renderer/frame/state.h"

namespace si {

class PagePasses;

/// Draws texels of the shown light's map as quads over a pane's picture. A part of PanePasses.
class TexelSlabs {
public:
    struct Targets {
        std::array<gl::Target, kMaxPanes> pictures;
        gl::VertexArray vao;
        gl::Buffer instances;
        int count = 0;
        std::vector<float> depths;  ///< stored depths of the region, bottom row first
        std::uint64_t depths_key = 0, instances_key = 0;
    };

    explicit TexelSlabs(const PagePasses& pages) : pages_(pages) {}
    /// Returns the pass of one pane, over its picture so far. The caller names it and what it reads and writes.
    Pass make_pass(FrameState& f, const FrameState::ShownPane& pane);

private:
    Targets targets_;
    const PagePasses& pages_;
};

}  // namespace si
