// Passes that draw the panes of the split view.
#pragma once

#include <array>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"
#include "renderer/passes/slabs.h"

namespace si {

/// Passes that draw the panes of the split view. The first pass of a pane draws the values of its overlay. The second
/// colours these values and blends them over the picture. The third draws texels of the shown map as quads on top
/// (view.slabs).
class PanePasses : public FramePass {
public:
    using ShownPane = FrameState::ShownPane;

    /// Images that PanePasses draws and keeps between frames for one pane of the split view, and the colour scale
    /// fitted to the values of the pane's overlay.
    struct Targets {
        gl::Target values, composed;
        ValueRange fitted;
        std::uint64_t fitted_key = 0;  ///< cache key of the values to which `fitted` is fitted
    };

    explicit PanePasses(const PagePasses& pages) : slabs_(pages) {}
    void declare(FrameState& f) override;
    /// Returns the range of the colour scale with which a pane's overlay is shown. To fit the scale, reads the
    /// overlay's values back from the GPU, once after each change.
    ValueRange range_of(const FrameState& f, const ShownPane& pane);

private:
    /// Returns the pass that draws the values of a pane's overlay, before they are coloured.
    Pass values_pass(FrameState& f, const ShownPane& pane);
    /// Returns the pass that colours the values of a pane's overlay and blends them over the picture.
    Pass compose_pass(FrameState& f, const ShownPane& pane);
    /// Returns the pass that draws texels of the shown shadow map as quads over a pane's picture (view.slabs).
    Pass slabs_pass(FrameState& f, const ShownPane& pane);
    /// Returns the images kept for a pane. Panes with the same overlay share them.
    Targets& targets_of(const ShownPane& pane) { return slots_[std::size_t(pane.slot)]; }

    std::array<Targets, kMaxPanes> slots_;
    TexelSlabs slabs_;
};

}  // namespace si
