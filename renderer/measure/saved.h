// What savings are worth in milliseconds: frames that make them and frames that do the work after all, in turns.
//
//     SavedTimes saved = measure_saved(renderer, scene, settings, request, {Saving::Uncalled});
//     saved.of(Saving::Uncalled)->median                // ms; its interval: median_low ... median_high
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/frame/effects.h"
#include "renderer/frame/renderer.h"
#include "renderer/measure/time_sampler.h"
#include "renderer/reference/workers.h"

namespace si {

/// Differences of neighbours in time: a frame that does the work less the one that spares it, in milliseconds. Noise
/// may make them negative; an interval that holds 0 tells no saving.
struct SavedTime {
    Saving saving;
    Spread ms;
};

struct SavedTimes {
    std::vector<SavedTime> savings;
    TimeMeasurement frame;  ///< of frames that make all savings, every pass run
    int rounds = 0;

    const Spread* of(Saving saving) const;
    /// What an effect's being left out, kept or made cheaper saves: by its saving, which others may share, else the
    /// time of its pass where that was reused. Null where that is not known.
    const Spread* of(const Effect& effect) const;
};

/// What each saving is worth by frames that `draw_ms` draws and times.
/// @param draw_ms of one frame with these savings forced, milliseconds
/// @param report hears of the share done
std::vector<SavedTime> saved_in_turns(std::span<const Saving> savings, int rounds,
                                      const std::function<double(SavingSet)>& draw_ms,
                                      const std::function<void(double)>& report = {});

inline constexpr int kSavedRounds = 15;

/// Draws in turns, after frames that warm up. @param request of the frames; forced and timed here
/// @throws Error, Cancelled
SavedTimes measure_saved(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest request,
                         std::span<const Saving> savings, int rounds = kSavedRounds, const Workers& workers = {},
                         const std::function<void(double)>& report = {});

/// The savings that these effects name, each once.
std::vector<Saving> named_savings(std::span<const Effect> effects);

}  // namespace si
