// Time that optimisations save, in milliseconds: frames with and without each optimisation, drawn alternately.
//
//     SavedTimes saved = measure_saved_times(renderer, scene, settings, request, {Optimisation::DeadPasses});
//     saved.saved_ms(Optimisation::DeadPasses)->median        // ms, with the interval median_low ... median_high
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

/// Time that one optimisation saves: a frame without the optimisation minus a frame with it. Noise may make the
/// difference negative. If the confidence interval contains 0, no effect is shown.
struct SavedTime {
    Optimisation optimisation;
    Spread ms;  ///< milliseconds
};

/// Times that the optimisations of one frame save, each measured by itself, and the time of the whole frame.
struct SavedTimes {
    std::vector<SavedTime> optimisations;
    TimeMeasurement frame;  ///< frames with all optimisations, every pass drawn again
    int rounds = 0;         ///< pairs of frames per optimisation
    /// Time of the shadows alone: the frame minus the same frame without shadows, milliseconds.
    std::optional<Spread> shadow_ms = {};
    /// Time that the frame takes longer with all optimisations off, milliseconds.
    std::optional<Spread> forced_more_ms = {};

    /// Returns the measured time that an optimisation saves, in milliseconds; null when it was not measured.
    const Spread* saved_ms(Optimisation optimisation) const;
    /// Returns the time in milliseconds by which a frame is shorter because an effect (a piece of rendering work) was
    /// skipped or cached. For a skipped effect it is the time that its optimisation saves in all effects together. For
    /// a cached effect it is the time of its pass. Null when unknown.
    const Spread* saved_ms(const Effect& effect) const;
};

/// Times optimisations by frames with and without each one, drawn alternately by a callback.
/// @param rounds the number of pairs of frames per optimisation
/// @param draw_ms a function that draws a frame with the given optimisations switched off and returns its milliseconds
/// @param report receives the share done, 0..1
/// @param show receives the times of the rounds so far after each round, from the second on
std::vector<SavedTime> time_optimisations_alternating(
    std::span<const Optimisation> optimisations, int rounds, const std::function<double(OptimisationSet)>& draw_ms,
    const std::function<void(double)>& report = {},
    const std::function<void(const std::vector<SavedTime>&)>& show = {});

/// Default number of frame pairs per timed optimisation.
inline constexpr int kSavedTimeRounds = 15;

/// Measures the time that optimisations save in a frame. Draws every pass again, except for optimisations that depend
/// on earlier frames (StaticCasterCache, EarlyOut): these are timed in motion (CachedFrames). StaticCasterCache is left
/// out where no animation plays.
/// @param request frames to draw; `forced`, `force` and `timing` are set here
/// @param report receives the share done, 0..1
/// @param show receives the times so far, after each round of frames
/// @throws Error, Cancelled
SavedTimes measure_saved_times(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest request,
                               std::span<const Optimisation> optimisations, int rounds = kSavedTimeRounds,
                               const Workers& workers = {}, const std::function<void(double)>& report = {},
                               const std::function<void(const SavedTimes&)>& show = {});

/// Sequence of frames in motion, to time an optimisation that depends on results of earlier frames. For
/// Optimisation::StaticCasterCache the animation plays; for other optimisations the camera turns.
class CachedFrames {
public:
    /// Prepares the frames. @param optimisation the optimisation to time; StaticCasterCache needs an animated scene
    CachedFrames(const Scene& scene, const Settings& settings, const FrameRequest& request, Optimisation optimisation);
    /// Draws the next frame, and advances the motion at every second call. Call alternately with and without the timed
    /// optimisation in `forced`, so that each step of the motion is drawn both ways. Frames with an empty `forced` have
    /// a renderer of their own, so that they do not share caches with the others.
    /// @param forced the optimisations to switch off, so that all their work is drawn
    FrameResult draw(OptimisationSet forced);

private:
    Scene scene_;
    glm::dmat4 placement_;
    FrameRequest request_;
    std::vector<Settings> steps_;  ///< settings of the camera's motion, repeated; one entry when the animation plays
    bool advances_time_;
    Renderer optimised_, unoptimised_;  ///< renderers for an empty `forced` and for any other
    int drawn_ = 0;

    /// Advances the scene's animation by one frame of 1/30 s; does nothing when the camera moves instead.
    void advance_time();
};

/// Returns the optimisations that skip at least one of the effects (pieces of rendering work), each once.
std::vector<Optimisation> optimisations_of(std::span<const Effect> effects);

}  // namespace si
