// What the effects of a frame are told from, for the files that tell them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/inspect/effect.h"
#include "renderer/settings/filters.h"

namespace si {

/// What effects are told from.
struct EffectFacts {
    const Scene& scene;
    Settings settings;  ///< repaired
    const FrameResult& frame;
    OptimisationSet forced;
    int casters = 0, masked_casters = 0;  ///< objects

    const Filter& filter() const { return filter_of(settings); }
    std::string kernel() const { return kernel_label(settings); }
};

using Effects = std::vector<Effect>;

constexpr EffectState state_of(PassState state) {
    return state == PassState::Drawn    ? EffectState::Drawn
           : state == PassState::Cached ? EffectState::Cached
                                        : EffectState::NotNeeded;
}

/// An effect that is a part of a pass: where the pass does its work and `reason` is empty, the pass's own state.
Effect part_of(const PassInfo& pass, std::string name, bool needed, std::string_view reason,
               std::optional<Optimisation> saving = {});

/// "light.2.size".
std::string light_setting_key(std::size_t light, std::string_view setting);

}  // namespace si
