// One effect of a frame: something that it could draw, and whether it did.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "renderer/frame/optimisation_set.h"

namespace si {

enum class EffectState {
    Drawn,     ///< this frame computed it
    Cached,    ///< what an earlier frame computed still holds
    NotNeeded  ///< nothing that is looked at depends on it
};
/// "simulated", "reused", "not called for": also what files call it.
std::string_view effect_state_key(EffectState state);

struct Effect {
    std::string name;  ///< "map of light 0, cascade 2"
    EffectState state = EffectState::NotNeeded;
    std::string reason;                  ///< one sentence or more, with their ends
    std::optional<Optimisation> saving;  ///< that spares it, wholly or in part; forced, it is simulated
    std::string pass;                    ///< PassInfo::name of what does it; empty: no pass of the frame does
    bool part = false;                   ///< one of several things that the pass does: its time is not this one's alone
    bool operator==(const Effect&) const = default;
};

/// `text` with a full stop, and with a capital letter unless it begins with a setting's key. Empty stays so.
std::string sentence(std::string_view text);

}  // namespace si
