// List of a frame's effects: the work that was drawn, cached or skipped, each with a reason in words. The list is made
// only on request, so that frames without it cost nothing.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/frame/frame.h"

namespace si {

/// State of an effect in one frame: drawn, cached or not needed.
enum class EffectState {
    Drawn,     ///< this frame computed the effect
    Cached,    ///< the result of an earlier frame is still valid
    NotNeeded  ///< nothing that the frame shows depends on the effect
};
/// Returns the name of an effect state in JSON files: "simulated", "reused" or "not called for".
std::string_view effect_state_key(EffectState state);
/// Returns the name of an effect state for people: "drawn", "cached" or "not needed".
std::string_view effect_state_label(EffectState state);

/// Piece of rendering work that a frame may draw, reuse or skip, such as the map of one cascade or a blocker search.
struct Effect {
    std::string name;  ///< "map of light 0, cascade 2"
    EffectState state = EffectState::NotNeeded;
    std::string reason;                        ///< one or more sentences, each with its full stop
    std::optional<Optimisation> optimisation;  ///< skips the effect or a part; forced off, the effect is drawn
    std::string pass;                          ///< PassInfo::name of the pass that draws it; empty: none
    bool part = false;                         ///< one of several effects in the pass, so the pass's time is shared
    bool operator==(const Effect&) const = default;
};

/// Formats a clause as a sentence: adds a full stop, and a capital letter unless the text begins with a setting key.
/// Empty text stays empty.
std::string as_sentence(std::string_view text);

/// Lists all effects of a drawn frame in the order of its passes, each pass before its parts. Every pass belongs to at
/// least one effect.
/// @param settings settings of the frame, sanitised or not
/// @param forced FrameRequest::forced of the frame
std::vector<Effect> frame_effects(const Scene& scene, const Settings& settings, const FrameResult& frame,
                                  OptimisationSet forced = {});

/// Makes the effect "posing": the CPU moves nodes, skins and morph targets of the scene before a frame.
/// @param again the scene was posed since the frame before
Effect posing_effect(const Scene& scene, const SceneSettings& settings, bool again);

/// Counts the effects that share the optimisation of one effect. The measured time of an optimisation belongs to all of
/// them together.
/// @param effects all effects of a frame, including `effect`
std::size_t sharing_optimisation_count(std::span<const Effect> effects, const Effect& effect);

}  // namespace si
