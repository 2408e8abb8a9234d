// The panes of the picture.
#pragma once

#include <array>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"
#include "renderer/passes/slabs.h"

namespace si {

/// Draws each overlay's values, the picture with the overlay over it, and texels of the map as quads over that.
class PanePasses : public FramePass {
public:
    using ShownPane = FrameState::ShownPane;

    /// What one pane draws into, and the range fitted to its values.
    struct Targets {
        gl::Target values, composed;
        ValueRange fitted;
        std::uint64_t fitted_key = 0;  ///< of the values that `fitted` was found in
    };

    explicit PanePasses(const PagePasses& pages) : slabs_(pages) {}
    void declare(FrameState& f) override;
    /// Returns the colour scale of a pane. A fitted one reads back the pane's values, once for each change of them.
    ValueRange range_of(const FrameState& f, const ShownPane& pane);

private:
    Pass values_pass(FrameState& f, const ShownPane& pane);
    Pass compose_pass(FrameState& f, const ShownPane& pane);
    Pass slabs_pass(FrameState& f, const ShownPane& pane);
    Targets& targets_of(const ShownPane& pane) { return slots_[std::size_t(pane.slot)]; }

    std::array<Targets, kMaxPanes> slots_;
    TexelSlabs slabs_;
};

}  // namespace si
