// Effect of a frame: a piece of rendering work, its state, and the reason for the state.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "renderer/frame/optimisation_set.h"

namespace si {

/// State of an effect (a piece of rendering work) in one frame: drawn, cached or not needed.
enum class EffectState {
    Drawn,     ///< this frame computed the effect
    Cached,    ///< the result of an earlier frame is still valid
    NotNeeded  ///< nothing that the frame shows depends on the effect
};
/// Returns the JSON name of the state of an effect (a piece of rendering work): "simulated", "reused" or "not called
/// for".
std::string_view effect_state_key(EffectState state);
/// Returns the state of an effect (a piece of rendering work) as a label for people: "drawn", "cached" or "not needed".
std::string_view effect_state_label(EffectState state);

/// Piece of rendering work, such as the map of one cascade or a blocker search, and whether a frame drew, cached or
/// skipped it. Reports list the effects of a frame, each with its reason.
struct Effect {
    std::string name;  ///< "map of light 0, cascade 2"
    EffectState state = EffectState::NotNeeded;
    std::string reason;                        ///< one or more sentences, each with its full stop
    std::optional<Optimisation> optimisation;  ///< optimisation that skips the effect or a part of it
    std::string pass;                          ///< PassInfo::name of the pass that does the work; empty: none
    bool part = false;                         ///< true: one of several parts of the pass, whose time it shares
    bool operator==(const Effect&) const = default;
};

/// Formats a clause as a sentence for a report. Adds a full stop, and a capital letter unless the text begins with a
/// setting key such as bias.constant. Empty text stays empty.
std::string as_sentence(std::string_view text);

}  // namespace si
