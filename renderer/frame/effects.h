// What a frame could simulate, and what it did of it: each effect with why, in sentences. Made from a frame's facts
// when somebody asks, so that who does not pays nothing.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/frame/frame.h"

namespace si {

enum class EffectState {
    Drawn,     ///< this frame computed it
    Cached,    ///< what an earlier frame computed still holds
    NotNeeded  ///< nothing that is looked at depends on it
};
/// "simulated", "reused", "not called for": also what files call it.
std::string_view state_name(EffectState state);

struct Effect {
    std::string name;  ///< "map of light 0, cascade 2"
    EffectState state = EffectState::NotNeeded;
    std::string reason;                  ///< one sentence or more, with their ends
    std::optional<Optimisation> saving;  ///< that spares it, wholly or in part; forced, it is simulated
    std::string pass;                    ///< PassInfo::name of what does it; empty: no pass of the frame does
    bool part = false;                   ///< one of several things that the pass does: its time is not this one's alone
    bool operator==(const Effect&) const = default;
};

/// All effects of a drawn frame in the order of its passes, each pass before its parts. Every pass is the `pass` of
/// one effect at least.
/// @param settings that it was drawn under, repaired or not
/// @param forced FrameRequest::forced of the frame
std::vector<Effect> frame_effects(const Scene& scene, const Settings& settings, const FrameResult& frame,
                                  OptimisationSet forced = {});

/// Moving the scene's nodes, skins and morph targets, which is done before a frame, by the CPU.
/// @param anew the scene was posed since the frame before
Effect posing_effect(const Scene& scene, const SceneSettings& settings, bool again);

/// How many of `effects`, one of which is `effect`, share its saving: what was measured of that is of all together.
std::size_t saved_together(std::span<const Effect> effects, const Effect& effect);

/// `text` with a full stop, and with a capital letter unless it begins with a setting's key. Empty stays so.
std::string sentence(std::string_view text);

}  // namespace si
