// Parts of effects: work within the passes that draw maps, moments, visibility and the picture.
#pragma once

#include <string>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/inspect/effect.h"
#include "renderer/settings/filters.h"

namespace si {

/// Input from which the effects of a frame are derived: scene, settings, the frame's passes, forced work.
struct EffectFacts {
    const Scene& scene;
    Settings settings;  ///< sanitised
    const FrameResult& frame;
    OptimisationSet forced;               ///< optimisations that are switched off
    int casters = 0, masked_casters = 0;  ///< numbers of objects

    /// Returns the row of the selected shadow filter.
    const Filter& filter() const { return filter_of(settings); }
    /// Returns the label of the selected shadow kernel.
    std::string kernel() const { return kernel_label(settings); }
};

using Effects = std::vector<Effect>;

/// Converts the state of a pass to the state of an effect.
constexpr EffectState state_of(PassState state) {
    return state == PassState::Drawn    ? EffectState::Drawn
           : state == PassState::Cached ? EffectState::Cached
                                        : EffectState::NotNeeded;
}

/// Appends the effects (pieces of rendering work) within the pass that draws a light's maps: its maps and the alpha
/// test.
/// @param out receives the effects
void map_parts(const EffectFacts& f, const PassInfo& pass, Effects& out);
/// Appends the effects (pieces of rendering work) within the pass that draws pages of virtual maps. @param out receives
/// the effects
void page_parts(const EffectFacts& f, const PassInfo& pass, Effects& out);
/// Appends the effects (pieces of rendering work) within the pass that filters moments: blur, mip levels, samples.
/// @param out receives the effects
void moment_parts(const EffectFacts& f, const PassInfo& pass, Effects& out);
/// Appends the effects (pieces of rendering work) within the pass that draws the visibility texture: look-ups of each
/// light, contact shadows.
/// @param out receives the effects
void visibility_parts(const EffectFacts& f, const PassInfo& pass, Effects& out);
/// Appends the effects (pieces of rendering work) within the shading pass: ground, sky, tone curve, and the look-ups of
/// each light unless a visibility texture has them.
/// @param out receives the effects
void shading_parts(const EffectFacts& f, const PassInfo& pass, Effects& out);

}  // namespace si
