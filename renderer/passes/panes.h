// Passes that draw the panes of the split view.
#pragma once

#include <array>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"
#include "renderer/passes/slabs.h"

namespace si {

/// Draws each pane: overlay values, the picture with the overlay over it, and texels of a map as quads on top.
class PanePasses : public FramePass {
public:
    using ShownPane = FrameState::ShownPane;

    /// Images that PanePasses draws and keeps between frames for one pane, and the colour scale fitted to the values of
    /// its overlay.
    struct Targets {
        gl::Target values, composed;
        ValueRange fitted;
        std::uint64_t fitted_key = 0;  ///< cache key of the values behind `fitted`
    };

    explicit PanePasses(const PagePasses& pages) : slabs_(pages) {}
    void declare(FrameState& f) override;
    /// Returns the colour scale of a pane's overlay. A fitted scale reads back the pane's values, once for each change
    /// of them.
    ValueRange range_of(const FrameState& f, const ShownPane& pane);

private:
    /// Returns the pass that draws a pane's overlay values.
    Pass values_pass(FrameState& f, const ShownPane& pane);
    /// Returns the pass that blends a pane's overlay over the picture.
    Pass compose_pass(FrameState& f, const ShownPane& pane);
    /// Returns the pass that draws texels of the shown map as quads over a pane's picture.
    Pass slabs_pass(FrameState& f, const ShownPane& pane);
    /// Returns the images of the pane's slot.
    Targets& targets_of(const ShownPane& pane) { return slots_[std::size_t(pane.slot)]; }

    std::array<Targets, kMaxPanes> slots_;
    TexelSlabs slabs_;
};

}  // namespace si
