// Effects within map look-ups and shading: blocker search, light size, contact shadows, skipped look-ups, sky, tone
// curve.
#pragma once

#include "renderer/inspect/effect_facts.h"

namespace si {

/// Appends the effects within the pass that draws the visibility texture: look-ups of each light, contact shadows.
/// @param out receives the effects
void visibility_parts(const EffectFacts& f, const PassInfo& pass, Effects& out);
/// Appends the effects within the shading pass: ground, sky, tone curve, and the look-ups of each light unless a
/// visibility texture has them.
/// @param out receives the effects
void shading_parts(const EffectFacts& f, const PassInfo& pass, Effects& out);
/// Returns the reason why visibility is drawn into a texture of its own, as a clause.
std::string why_visibility(const EffectFacts& f, const PassInfo& pass);

}  // namespace si
