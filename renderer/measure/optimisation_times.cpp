#include "renderer/measure/optimisation_times.h"

#include <algorithm>
#include <cmath>

#include "renderer/measure/frame_costs.h"
#include "renderer/scene/animation.h"

namespace si {
namespace {

/// spread_of() of numbers of either sign, which it takes for times.
Spread spread_of_differences(std::vector<double> values) {
    if (values.empty()) return {};
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const double shift = 2 * (*most - *least) - *least;
    for (double& v : values) v += shift;
    Spread s = spread_of(std::move(values));
    for (double* v : {&s.median, &s.p95, &s.low, &s.high, &s.median_low, &s.median_high}) *v -= shift;
    return s;
}

double total_ms(const FrameResult& frame) {
    double total = 0;
    for (const PassInfo& pass : frame.passes)
        if (pass.state == PassState::Drawn) total += pass.gpu_ms;
    return total;
}

}  // namespace

const Spread* SavedTimes::of(Optimisation saving) const {
    for (const SavedTime& time : savings)
        if (time.saving == saving) return &time.ms;
    return nullptr;
}

const Spread* SavedTimes::of(const Effect& effect) const {
    if (effect.saving) return of(*effect.saving);
    if (effect.state != EffectState::Cached || effect.part) return nullptr;
    for (const PassTime& pass : frame.passes)
        if (pass.name == effect.pass) return &pass.gpu_ms;
    return nullptr;
}

std::vector<SavedTime> saved_in_turns(std::span<const Optimisation> savings, int rounds,
                                      const std::function<double(OptimisationSet)>& draw_ms,
                                      const std::function<void(double)>& report) {
    std::vector<std::vector<double>> differences(savings.size());
    for (int round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < savings.size(); ++i) {
            // Whichever comes first finds caches as the one before left them: each is first every other time.
            double with = 0, without = 0;
            if (round % 2 == 0) with = draw_ms({});
            without = draw_ms({savings[i]});
            if (round % 2 != 0) with = draw_ms({});
            differences[i].push_back(without - with);
            if (report) report(double(round * int(savings.size()) + int(i) + 1) / (rounds * int(savings.size())));
        }
    std::vector<SavedTime> out;
    for (std::size_t i = 0; i < savings.size(); ++i)
        out.push_back({savings[i], spread_of_differences(std::move(differences[i]))});
    return out;
}

KeptFrames::KeptFrames(const Scene& scene, const Settings& settings, const FrameRequest& request, Optimisation saving)
    : scene_(scene), placement_(scene.placement), request_(request), time_goes_on_(saving == Optimisation::Static) {
    request_.force = false;
    const double aspect = double(request.width) / request.height;
    moments_ =
        time_goes_on_ ? std::vector<Settings>{settings} : scripted_frames(scene, settings, aspect, CostCase::Camera);
}

FrameResult KeptFrames::draw(OptimisationSet forced) {
    if (drawn_ % 2 == 0) move_on();
    request_.forced = forced;
    return (forced.empty() ? keeps_ : draws_all_)
        .render(scene_, moments_[std::size_t(drawn_++ / 2) % moments_.size()], request_);
}

void KeptFrames::move_on() {
    if (!time_goes_on_) return;
    constexpr double kStep_s = 1.0 / 30;  // as an animation that is played
    SceneSettings& at = moments_.front().scene;
    at.time = std::fmod(at.time + kStep_s, scene_.rig->animations[std::size_t(at.animation)].duration_s);
    pose(scene_, at.animation, at.time);
    if (placement_ != scene_.placement) place(scene_, placement_);
}

SavedTimes measure_saved_times(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest request,
                               std::span<const Optimisation> savings, int rounds, const Workers& workers,
                               const std::function<void(double)>& report) {
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
        return total_ms(frame);
    };
    std::vector<Optimisation> again, kept;
    for (const Optimisation saving : savings)
        if (saving == Optimisation::Static || saving == Optimisation::EarlyOut)
            kept.push_back(saving);
        else
            again.push_back(saving);
    if (!is_animated(scene, settings.scene.animation)) std::erase(kept, Optimisation::Static);
    const double parts = double(again.size() + kept.size());
    const auto report_part = [&](double from, double count, double share) {
        if (report) report(parts > 0 ? (from + count * share) / parts : share);
    };
    draw({}, false);  // compiles programs and touches memory
    for (const Optimisation saving : again) draw({saving}, false);
    SavedTimes saved{.rounds = rounds};
    saved.savings = saved_in_turns(
        again, rounds, [&](OptimisationSet forced) { return draw(forced, true); },
        [&](double share) { report_part(0, double(again.size()), share); });
    for (int i = 0; again.empty() && i < rounds; ++i) {
        draw({}, true);
        if (kept.empty()) report_part(0, 1, double(i + 1) / rounds);
    }
    for (std::size_t i = 0; i < kept.size(); ++i) {
        KeptFrames frames(scene, settings, request, kept[i]);
        const auto draw_moment = [&](OptimisationSet forced) {
            require_going_on();
            return total_ms(frames.draw(forced));
        };
        const Optimisation one[] = {kept[i]};
        saved_in_turns(one, 4, draw_moment);  // until what is kept is there
        saved.savings.push_back(saved_in_turns(one, rounds, draw_moment, [&](double share) {
                                    report_part(double(again.size() + i), 1, share);
                                }).front());
    }
    saved.frame = summary(samples);
    return saved;
}

std::vector<Optimisation> named_optimisations(std::span<const Effect> effects) {
    std::vector<Optimisation> out;
    for (const Effect& effect : effects)
        if (effect.saving && std::find(out.begin(), out.end(), *effect.saving) == out.end())
            out.push_back(*effect.saving);
    return out;
}

}  // namespace si
