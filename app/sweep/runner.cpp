#include "app/sweep/runner.h"

#include <algorithm>
#include <new>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/sweep/files.h"
#include "app/sweep/results.h"
#include "renderer/base/error.h"

namespace si {
namespace {

/// Returns the message of a case's exception on one line. The sweep then continues with the next case.
/// @throws Cancelled, which is no failure of the case
template <typename Attempt>
std::string why_failed(const Attempt& attempt) {
    try {
        attempt();
        return {};
    } catch (const Cancelled&) {
        throw;
    } catch (const Error& e) {
        const std::string why = one_line(e.what());
        return why.empty() ? "failed without a reason" : why;
    } catch (const std::bad_alloc&) {
        return "out of memory";
    } catch (const std::exception&) {
        return "a library of the program failed; the same command with --retry tries it again";
    }
}

}  // namespace

SweepRunner::SweepRunner(const SweepPlan& plan, Shard shard, SweepTiming timing, bool retry_failed, CaseMeter& meter,
                         Journal& journal, std::filesystem::path folder)
    : plan_(plan), timing_(timing), meter_(meter), journal_(journal), folder_(std::move(folder)) {
    const auto& known = journal_.state().cases;
    const Settings common = spec_from_json(journal_.state().spec).base;
    base_ = base_case(common);
    times_base_ = !base_number(common, plan_);
    for (std::size_t i = 0; i < plan_.cases.size(); ++i) {
        if (!shard.contains(i)) continue;
        const auto c = known.find(i);
        const bool failed = c != known.end() && !c->second.failed.empty();
        if (c == known.end() || (failed ? retry_failed : !c->second.finished || lacks_pictures(folder_, i)))
            todo_.push_back(i);
    }
    progress_.total = todo_.size();
}

RunInfo SweepRunner::this_run() const {
    RunInfo run = meter_.run();
    run.cost = timing_.cost;
    return run;
}

void SweepRunner::record_run() {
    if (!run_.empty()) return;
    const RunInfo run = this_run();
    journal_.add(run_line(run));
    run_ = run.id;
}

bool SweepRunner::step() {
    const bool more = step_facts() || (timing_.on && step_timing());
    if (more) estimate();
    return more;
}

bool SweepRunner::step_facts() {
    if (next_ >= todo_.size()) return false;
    record_run();
    const std::size_t number = todo_[next_++];
    const SweepCase& c = plan_.cases[number];
    const auto start = Clock::now();
    progress_.current = c.id;
    const auto& known = journal_.state().cases;
    const auto it = known.find(number);
    std::string why;
    const bool again = it != known.end() && it->second.is_measured();
    if (it != known.end() && it->second.begun >= kMaxBegins) {
        why = "the program ended each time that it measured this case";
    } else {
        journal_.add(begin_line(number));
        DrawnCase facts;
        try {
            why = why_failed([&] { facts = meter_.facts(c); });
        } catch (const Cancelled&) {
            journal_.add(cancelled_line(number));
            throw;
        }
        if (why.empty()) {
            make_picture_folder(folder_);
            if (!facts.picture_jpg.empty()) write_regular_file(folder_ / picture_path(number), facts.picture_jpg);
            if (!facts.artefacts_png.empty()) write_regular_file(folder_ / artefacts_path(number), facts.artefacts_png);
            journal_.add(facts_line(number, facts));
        }
    }
    // Measured numbers stay if only the pictures cannot be drawn again.
    if (!why.empty() && !again) journal_.add(failure_line(number, why));
    facts_s_ += std::chrono::duration<double>(Clock::now() - start).count();
    progress_.done = next_;
    return true;
}

void SweepRunner::begin_round() {
    order_.clear();
    turn_ = 0;
    const SweepState& state = journal_.state();
    const RunInfo here = run_.empty() ? this_run() : *state.run(run_);
    const RankedRounds rounds = rounds_like(state, here);
    const RoundSlowness slowness = round_slowness(state, rounds);
    bool all_settled = true;
    for (const auto& [number, c] : state.cases) {
        if (!c.is_measured()) continue;
        order_.push_back(number);
        const TimeSamples samples = ranked_samples(c, rounds);
        const TimeMeasurement time = summarise_times(samples);
        const ShadowSamples shadow = ranked_shadow(c.turns, rounds, slowness);
        all_settled = all_settled && int(samples.total_ms.size()) >= timing_.min_frames && time.settled &&
                      (shadow.moving_ms.empty() || shadow_settled(shadow, time.total_ms.median));
    }
    if (times_base_ && !order_.empty()) order_.push_back(kBaseCase);
    // Rounds alternate their direction, so that a steady drift affects early and late cases equally.
    if (rounds.size() % 2) std::reverse(order_.begin(), order_.end());
    round_ = int(rounds.size());
    progress_ = {.timing = true, .done = 0, .total = order_.size(), .round = round_};
    if (all_settled || round_ >= timing_.rounds) order_.clear();
}

ShadowFrames SweepRunner::times_of_round() const {
    constexpr int kStillPairs = 10;
    const bool enough = round_ >= kMinBursts && round_ * std::max(timing_.frames, kLeastFrames) >= kStillPairs;
    return enough && timing_.cost == CostCase::Light ? ShadowFrames::MovingLight : ShadowFrames::All;
}

bool SweepRunner::step_timing() {
    if (turn_ >= order_.size()) begin_round();
    if (order_.empty()) return false;
    record_run();
    const std::size_t number = order_[turn_++];
    const bool is_base = number == kBaseCase;
    const SweepCase& c = is_base ? base_ : plan_.cases[number];
    const auto start = Clock::now();
    progress_.current = c.id;
    RoundTimes turn{round_, run_, {}};
    const std::string why = why_failed([&] {
        CaseTimes times = meter_.time(c, timing_.frames, timing_.cost, times_of_round());
        turn.samples = std::move(times.frames);
        turn.shadow = std::move(times.shadow);
    });
    if (is_base)
        why.empty() ? journal_.add(base_turn_line(turn)) : void(times_base_ = false);
    else
        journal_.add(why.empty() ? turn_line(number, turn) : failure_line(number, why));
    turns_s_ += std::chrono::duration<double>(Clock::now() - start).count();
    ++turns_;
    progress_.done = turn_;
    return true;
}

void SweepRunner::estimate() {
    double left = 0;
    if (next_ > 0) left += double(todo_.size() - next_) * facts_s_ / double(next_);
    if (turns_ > 0) {
        const std::size_t more_rounds = std::size_t(std::max(0, timing_.rounds - round_ - 1));
        left += double(order_.size() - turn_ + more_rounds * order_.size()) * turns_s_ / double(turns_);
    }
    progress_.seconds_left = left;
}

}  // namespace si
