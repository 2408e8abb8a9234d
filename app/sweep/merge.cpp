#include "app/sweep/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "renderer/base/error.h"

namespace si {
namespace {

constexpr std::size_t kMaxNamed = 5;  ///< number of contradicting cases that notes name

bool knows(const std::vector<RoundTimes>& turns, const RoundTimes& turn) {
    return std::any_of(turns.begin(), turns.end(),
                       [&](const RoundTimes& t) { return t.run == turn.run && t.round == turn.round; });
}

/// Names of the parts that the cases' numbers come from, by case number.
using Origins = std::map<std::size_t, std::string>;

void add_case(CaseState& to, const CaseState& from) {
    std::vector<RoundTimes> turns = std::move(to.turns);
    if ((from.is_measured() && !to.is_measured()) || (!to.finished && to.failed.empty())) to = from;
    for (const RoundTimes& turn : from.turns)
        if (!knows(turns, turn)) turns.push_back(turn);
    to.turns = std::move(turns);
    to.begun = 0;
}

}  // namespace

SweepState merge_sweeps(const std::vector<std::pair<std::string, SweepState>>& parts) {
    const auto& [first_name, first] = parts.front();
    SweepState merged;
    merged.spec = first.spec;
    merged.plan = first.plan;
    merged.spec["shard"] = "1/1";
    merged.case_count = first.case_count;
    Origins origins;
    std::size_t contradictions = 0;
    for (const auto& [name, part] : parts) {
        if (const std::string difference = spec_difference(first.spec, part.spec, false); !difference.empty())
            throw Error(fmt::format("{} and {} are of different sweeps: {} (first, then second)", first_name, name,
                                    difference));
        if (part.plan != first.plan)
            throw Error(fmt::format("{} and {} were made by versions of the program that order cases differently",
                                    first_name, name));
        for (const RunInfo& run : part.runs)
            if (!merged.run(run.id)) merged.runs.push_back(run);
        for (const RoundTimes& turn : part.base_turns)
            if (!knows(merged.base_turns, turn)) merged.base_turns.push_back(turn);
        merged.notes.insert(merged.notes.end(), part.notes.begin(), part.notes.end());
        for (const auto& [number, c] : part.cases) {
            CaseState& known = merged.cases[number];
            const std::string& of = origins.emplace(number, name).first->second;
            if (const std::string phrase = contradiction(known, c); !phrase.empty() && ++contradictions <= kMaxNamed)
                merged.notes.push_back(fmt::format("{} and {} contradict each other in case {}: {}; the first counts",
                                                   of, name, number, phrase));
            if (!known.is_measured()) origins[number] = name;
            add_case(known, c);
        }
    }
    if (contradictions > kMaxNamed)
        merged.notes.push_back(fmt::format("they contradict each other in {} more cases", contradictions - kMaxNamed));
    return merged;
}

std::vector<Json> missing_lines(const SweepState& known, const SweepState& more) {
    std::vector<Json> lines;
    for (const RunInfo& run : more.runs)
        if (!known.run(run.id)) lines.push_back(run_line(run));
    for (const RoundTimes& turn : more.base_turns)
        if (!knows(known.base_turns, turn)) lines.push_back(base_turn_line(turn));
    static const CaseState kNothing;
    for (const auto& [number, c] : more.cases) {
        const auto it = known.cases.find(number);
        const CaseState& have = it == known.cases.end() ? kNothing : it->second;
        const bool nothing = !have.finished && have.failed.empty();
        if (c.is_measured() && !have.is_measured()) lines.push_back(facts_line(number, c));
        if (!c.failed.empty() && nothing) lines.push_back(failure_line(number, c.failed));
        for (const RoundTimes& turn : c.turns)
            if (!knows(have.turns, turn)) lines.push_back(turn_line(number, turn));
    }
    return lines;
}

std::vector<std::size_t> missing_cases(const SweepState& state, const SweepPlan& plan) {
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < plan.cases.size(); ++i) {
        const auto c = state.cases.find(i);
        if (c == state.cases.end() || (!c->second.finished && c->second.failed.empty())) missing.push_back(i);
    }
    return missing;
}

}  // namespace si
