// What look-ups in maps, and what is lit by them, consist of: a kernel's search for what stands before a pixel, the
// light's size, contact shadows, what is spared, and what touches no visibility.
#pragma once

#include "renderer/inspect/effect_facts.h"

namespace si {

/// Parts of the pass that makes visibility a texture of its own.
void visibility_parts(const EffectFacts& f, const PassInfo& pass, Effects& out);
/// Parts of the pass that shades, which looks visibility up itself where it is no texture.
void shading_parts(const EffectFacts& f, const PassInfo& pass, Effects& out);
/// What makes visibility a texture of its own, as far as the settings do: a clause.
std::string why_visibility(const EffectFacts& f, const PassInfo& pass);

}  // namespace si
