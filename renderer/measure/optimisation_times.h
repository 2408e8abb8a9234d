// What savings are worth in milliseconds: frames that make them and frames that do the work after all, in turns.
//
//     SavedTimes saved = measure_saved_times(renderer, scene, settings, request, {Saving::Uncalled});
//     saved.of(Saving::Uncalled)->median                // ms; its interval: median_low ... median_high
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/base/workers.h"
#include "renderer/inspect/effects.h"
#include "renderer/measure/time_sampler.h"
#include "renderer/render/renderer.h"

namespace si {

/// Differences of neighbours in time: a frame that does the work less the one that spares it, in milliseconds. Noise
/// may make them negative; an interval that holds 0 tells no saving.
struct SavedTime {
    Optimisation saving;
    Spread ms;
};

struct SavedTimes {
    std::vector<SavedTime> savings;
    TimeMeasurement frame;  ///< of frames that make all savings, every pass run
    int rounds = 0;

    const Spread* of(Optimisation saving) const;
    /// What an effect's being left out, kept or made cheaper saves: by its saving, which others may share, else the
    /// time of its pass where that was reused. Null where that is not known.
    const Spread* of(const Effect& effect) const;
};

/// What each saving is worth by frames that `draw_ms` draws and times.
/// @param draw_ms of one frame with these savings forced, milliseconds
/// @param report hears of the share done
std::vector<SavedTime> saved_in_turns(std::span<const Optimisation> savings, int rounds,
                                      const std::function<double(OptimisationSet)>& draw_ms,
                                      const std::function<void(double)>& report = {});

inline constexpr int kSavedRounds = 15;

/// Draws in turns, after frames that warm up: every pass anew but for Saving::Resting, for which time goes on from
/// frame to frame and what did not change is kept. Where no animation moves anything, nothing is told of that one.
/// @param request of the frames; forced and timed here
/// @throws Error, Cancelled
SavedTimes measure_saved_times(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest request,
                               std::span<const Optimisation> savings, int rounds = kSavedRounds,
                               const Workers& workers = {}, const std::function<void(double)>& report = {});

/// Frames in each of which something has moved, for savings that live by what an earlier frame left: time goes on
/// where it is Saving::Resting, else the camera turns.
class KeptFrames {
public:
    /// @param saving Resting only of a scene that is_animated()
    KeptFrames(const Scene& scene, const Settings& settings, const FrameRequest& request, Optimisation saving);
    /// Each moment is drawn twice, one after the other. @param forced those that force nothing are one sequence of
    /// frames, by a renderer of its own, those that do are another
    FrameResult draw(OptimisationSet forced);

private:
    Scene scene_;
    glm::dmat4 placement_;
    FrameRequest request_;
    std::vector<Settings> moments_;  ///< one after the other, again and again; of time the first alone
    bool time_goes_on_;
    Renderer keeps_, draws_all_;
    int drawn_ = 0;

    void move_on();
};

/// The savings that these effects name, each once.
std::vector<Optimisation> named_optimisations(std::span<const Effect> effects);

}  // namespace si
