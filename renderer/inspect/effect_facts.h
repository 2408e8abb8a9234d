// Facts from which the effects of a frame are derived, for the sources that derive them.
#pragma once

#include <string>
#include <string_view>
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

/// Makes an effect that is a part of a pass. Its state is the state of the pass, or NotNeeded without `needed`.
/// @param reason clause; the pass's own reason replaces it where the pass was skipped but the effect is needed
/// @param optimisation optimisation that skips the effect
Effect part_of(const PassInfo& pass, std::string name, bool needed, std::string_view reason,
               std::optional<Optimisation> optimisation = {});

/// Returns the key of a setting of one light, such as "light.2.size". @param light index of light.*
std::string light_setting_key(std::size_t light, std::string_view setting);

}  // namespace si
