#include "renderer/measure/optimisation_times.h"

#include <algorithm>
#include <cmath>

#include "renderer/measure/frame_costs.h"
#include "renderer/measure/shadow_time.h"
#include "renderer/scene/animation.h"

namespace si {
const Spread* SavedTimes::saved_ms(Optimisation optimisation) const {
    for (const SavedTime& time : optimisations)
        if (time.optimisation == optimisation) return &time.ms;
    return nullptr;
}

const Spread* SavedTimes::saved_ms(const Effect& effect) const {
    if (effect.optimisation) return saved_ms(*effect.optimisation);
    if (effect.state != EffectState::Cached || effect.part) return nullptr;
    for (const PassTime& pass : frame.passes)
        if (pass.name == effect.pass) return &pass.gpu_ms;
    return nullptr;
}

std::vector<SavedTime> time_optimisations_alternating(std::span<const Optimisation> optimisations, int rounds,
                                                      const std::function<double(OptimisationSet)>& draw_ms,
                                                      const std::function<void(double)>& report,
                                                      const std::function<void(const std::vector<SavedTime>&)>& show) {
    std::vector<std::vector<double>> differences(optimisations.size());
    const auto so_far = [&] {
        std::vector<SavedTime> out;
        for (std::size_t i = 0; i < optimisations.size(); ++i)
            out.push_back({optimisations[i], spread_of_differences(differences[i])});
        return out;
    };
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < optimisations.size(); ++i) {
            // The first frame of a pair finds the caches of the frame before, so each kind is first every other time.
            double with = 0, without = 0;
            if (round % 2 == 0) with = draw_ms({});
            without = draw_ms({optimisations[i]});
            if (round % 2 != 0) with = draw_ms({});
            differences[i].push_back(without - with);
            if (report)
                report(double(round * int(optimisations.size()) + int(i) + 1) / (rounds * int(optimisations.size())));
        }
        if (show && round > 0) show(so_far());
    }
    return so_far();
}

CachedFrames::CachedFrames(const Scene& scene, const Settings& settings, const FrameRequest& request,
                           Optimisation optimisation)
    : scene_(scene),
      placement_(scene.placement),
      request_(request),
      advances_time_(optimisation == Optimisation::StaticCasterCache) {
    request_.force = false;
    const double aspect = double(request.width) / request.height;
    steps_ =
        advances_time_ ? std::vector<Settings>{settings} : scripted_frames(scene, settings, aspect, CostCase::Camera);
}

FrameResult CachedFrames::draw(OptimisationSet forced) {
    if (drawn_ % 2 == 0) advance_time();
    request_.forced = forced;
    return (forced.empty() ? optimised_ : unoptimised_)
        .render(scene_, steps_[std::size_t(drawn_++ / 2) % steps_.size()], request_);
}

void CachedFrames::advance_time() {
    if (!advances_time_) return;
    constexpr double kStep_s = 1.0 / 30;  // frame time of a playing animation
    SceneSettings& at = steps_.front().scene;
    at.time = std::fmod(at.time + kStep_s, scene_.rig->animations[std::size_t(at.animation)].duration_s);
    pose(scene_, at.animation, at.time);
    if (placement_ != scene_.placement) place(scene_, placement_);
}

SavedTimes measure_saved_times(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest request,
                               std::span<const Optimisation> optimisations, int rounds, const Workers& workers,
                               const std::function<void(double)>& report,
                               const std::function<void(const SavedTimes&)>& show) {
    request.force = request.timing = true;
    TimeSamples samples;
    const auto require_going_on = [&] {
        if (workers.stop.stop_requested()) throw Cancelled();
    };
    const auto draw = [&](OptimisationSet forced, bool counts) {
        require_going_on();
        request.forced = forced;
        const FrameResult frame = renderer.render(scene, settings, request);
        if (counts && forced.empty()) samples.add(frame);
        return drawn_ms(frame);
    };
    std::vector<Optimisation> again, kept;
    for (const Optimisation optimisation : optimisations)
        if (optimisation == Optimisation::StaticCasterCache || optimisation == Optimisation::EarlyOut)
            kept.push_back(optimisation);
        else
            again.push_back(optimisation);
    if (!is_animated(scene, settings.scene.animation)) std::erase(kept, Optimisation::StaticCasterCache);
    const double parts = double(again.size() + kept.size() + 1);
    const auto report_part = [&](double from, double count, double share) {
        if (report) report(parts > 0 ? (from + count * share) / parts : share);
    };
    draw({}, false);  // compiles programs and touches memory
    for (const Optimisation optimisation : again) draw({optimisation}, false);
    SavedTimes saved{.rounds = rounds};
    const auto show_so_far = [&](const std::vector<SavedTime>& more) {
        if (!show) return;
        SavedTimes so_far = saved;
        so_far.optimisations.insert(so_far.optimisations.end(), more.begin(), more.end());
        so_far.frame = summarise_times(samples);
        show(so_far);
    };
    saved.optimisations = time_optimisations_alternating(
        again, rounds, [&](OptimisationSet forced) { return draw(forced, true); },
        [&](double share) { report_part(0, double(again.size()), share); }, show_so_far);
    for (int i = 0; again.empty() && i < rounds; ++i) {
        draw({}, true);
        if (kept.empty()) report_part(0, 1, double(i + 1) / rounds);
    }
    for (std::size_t i = 0; i < kept.size(); ++i) {
        CachedFrames frames(scene, settings, request, kept[i]);
        const auto draw_moment = [&](OptimisationSet forced) {
            require_going_on();
            return drawn_ms(frames.draw(forced));
        };
        const Optimisation one[] = {kept[i]};
        time_optimisations_alternating(one, 4, draw_moment);  // fills the caches
        const auto report_one = [&](double share) { report_part(double(again.size() + i), 1, share); };
        saved.optimisations.push_back(
            time_optimisations_alternating(one, rounds, draw_moment, report_one, show_so_far).front());
    }
    const Settings plain = without_shadows(settings);
    const auto draw_kind = [&](int kind) {
        require_going_on();
        request.forced = kind == 1 ? OptimisationSet::all() : OptimisationSet{};
        return drawn_ms(renderer.render(scene, kind == 2 ? plain : settings, request));
    };
    for (int kind = 2; kind >= 0; --kind) draw_kind(kind);  // compiles programs and touches memory
    const auto kinds = time_rounds(rounds, 3, draw_kind);
    saved.forced_more_ms = spread_of_differences(differences(kinds[1], kinds[0]));
    saved.shadow_ms = spread_of_differences(differences(kinds[0], kinds[2]));
    report_part(parts - 1, 1, 1);
    saved.frame = summarise_times(samples);
    return saved;
}

std::vector<Optimisation> optimisations_of(std::span<const Effect> effects) {
    std::vector<Optimisation> out;
    for (const Effect& effect : effects)
        if (effect.optimisation && std::find(out.begin(), out.end(), *effect.optimisation) == out.end())
            out.push_back(*effect.optimisation);
    return out;
}

}  // namespace si
