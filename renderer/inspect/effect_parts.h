// Parts of effects: work within the passes that draw maps, moments, visibility and the picture.
#pragma once

#include <string>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/inspect/effect.h"
#include "renderer/settings/filters.h"

namespace si {

/// Input of the functions that list the effects (pieces of rendering work) of a frame: scene, settings, the frame's
/// passes, and the optimisations that are switched off.
struct EffectFacts {
    const Scene& scene;
    Settings settings;  ///< sanitised
    const FrameResult& frame;
    OptimisationSet forced;               ///< optimisations that are switched off
    int casters = 0, masked_casters = 0;  ///< number of casters, and of those with an alpha mask or blending

    /// Returns the row of the selected shadow filter.
    const Filter& filter() const { return filter_of(settings); }
    /// Returns the label of the selected shadow kernel.
    std::string kernel() const { return kernel_label(settings); }
};

using Effects = std::vector<Effect>;

/// Converts the state of a render pass to the state of an effect (a piece of rendering work).
constexpr EffectState state_of(PassState state) {
    return state == PassState::Drawn    ? EffectState::Drawn
           : state == PassState::Cached ? EffectState::Cached
                                        : EffectState::NotNeeded;
}

/// Appends the effects (pieces of rendering work) of the pass that draws a light's shadow maps: one for each map if the
/// light has several, and one for the alpha test. Used to report the work of a frame.
/// @param f input of the report @param out receives the effects
void map_parts(const EffectFacts& f, const PassInfo& pass, Effects& out);
/// Appends the effects (pieces of rendering work) of the pass that draws pages of virtual shadow maps: drawn pages,
/// kept pages, unread pages, and the alpha test. Used to report the work of a frame.
/// @param f input of the report @param out receives the effects
void page_parts(const EffectFacts& f, const PassInfo& pass, Effects& out);
/// Appends the effects (pieces of rendering work) of the pass that filters moment maps: blur, mip levels, and several
/// samples per texel. Used to report the work of a frame.
/// @param f input of the report @param out receives the effects
void moment_parts(const EffectFacts& f, const PassInfo& pass, Effects& out);
/// Appends the effects (pieces of rendering work) of the pass that draws the visibility texture: shadow look-ups of
/// each light, and contact shadows. Used to report the work of a frame.
/// @param f input of the report @param out receives the effects
void visibility_parts(const EffectFacts& f, const PassInfo& pass, Effects& out);
/// Appends the effects (pieces of rendering work) of the shading pass: ground, sky and tone curve. Without a separate
/// visibility texture, also the shadow look-ups of each light. Used to report the work of a frame.
/// @param f input of the report @param out receives the effects
void shading_parts(const EffectFacts& f, const PassInfo& pass, Effects& out);

}  // namespace si
