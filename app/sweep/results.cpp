#include "app/sweep/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/report/fixes_json.h"
#include "app/report/measure_json.h"
#include "app/sweep/base_case.h"
#include "app/sweep/columns.h"
#include "app/sweep/measured_cases.h"

namespace si {

namespace {

/// Chooses the plot's first axes: the first column with numbers in order of preference.
std::string first_with_numbers(const std::vector<SweepRow>& rows, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
        for (const SweepRow& row : rows)
            if (std::isfinite(find_column(key)->value(row.numbers))) return key;
    return *keys.begin();
}

void find_frontier(SweepResults& results) {
    const char* shadow = results.cost == CostCase::Light    ? kMovingShadowColumn
                         : results.cost == CostCase::Camera ? kStillShadowColumn
                                                            : "time.total_ms.median";
    results.x = first_with_numbers(results.rows, {shadow, "time.total_ms.median", "cost.bytes_touched"});
    results.y = first_with_numbers(results.rows, {"error.mae"});
    for (const FrontierView::Mark& mark : frontier_view(results.rows, nullptr, results.x, results.y).marks) {
        if (mark.on) results.frontier.push_back(results.rows[mark.of].number);
        if (mark.tied) results.tied.push_back(results.rows[mark.of].number);
    }
}

/// Finds the shadow time of the base, and each case's multiple of it.
void find_base(SweepResults& results, const SweepState& state, const SweepPlan& plan, const RankedRounds& ranked,
               const RoundSlowness& slowness) {
    results.base_case = base_number(spec_from_json(state.spec).base, plan);
    if (results.base_case) {
        for (const SweepRow& row : results.rows)
            if (row.number == *results.base_case) results.base = row.numbers.shadow;
    } else if (const ShadowSamples shadow = ranked_shadow(state.base_turns, ranked, slowness);
               !shadow.moving_ms.empty()) {
        results.base = summarise_shadow(shadow);
    }
    if (!results.base) return;
    for (SweepRow& row : results.rows)
        if (row.numbers.shadow)
            row.numbers.shadow->of_base = time_ratio(row.numbers.shadow->moving_ms, results.base->moving_ms);
    results.base->of_base = time_ratio(results.base->moving_ms, results.base->moving_ms);
}

Json run_json(const RunInfo& run, int ranked_rounds) {
    return {{"id", run.id},
            {"started", run.started},
            {"renderer", run.renderer},
            {"version", run.version},
            {"clock", run.clock},
            {"cpu_rasteriser", run.software},
            {"load", run.load},
            {"timed", cost_row(run.cost).key},
            {"ranked_rounds", ranked_rounds}};
}

Json row_json(const SweepRow& row) {
    const CaseNumbers& n = row.numbers;
    Json json = {{"case", row.number}, {"settings", changes_json(row.settings)}};
    if (!row.starts.empty()) json["starts"] = changes_json(row.starts);
    if (!row.own_settings.empty()) json["own_settings"] = changes_json(row.own_settings);
    json["failed"] = row.failed.empty() ? Json() : Json(row.failed);
    json["error"] = n.error ? error_json(n.error->metrics, n.error->noise) : Json();
    json["cost"] = n.cost ? cost_json(*n.cost) : Json();
    json["time"] = n.time ? time_json(*n.time) : Json();
    json["shadow"] = n.shadow ? shadow_json(*n.shadow) : Json();
    json["notes"] = row.notes;
    json["picture"] = row.failed.empty() ? Json(picture_path(row.number)) : Json();
    json["artefacts"] = row.failed.empty() ? Json(artefacts_path(row.number)) : Json();
    return json;
}

/// Converts the readings of the frontier: knee, steps, best cases within multiples of the base's cost.
Json readings_json(const FrontierPlot& plot, const SweepResults& results) {
    const std::vector<Dot> dots = dots_of(plot);
    const std::vector<std::size_t> front = strict_front(dots);
    const auto number = [&](std::size_t i) { return results.rows[plot.cases[i].of].number; };
    const auto knee = knee_of(dots, front);
    Json json = {{"knee", knee ? Json(number(*knee)) : Json()}, {"sentence", knee_sentence(plot)}};
    json["steps"] = json_list(front_steps(dots, front), [&](const FrontStep& step) -> Json {
        const bool ratio =
            !plot.cases[step.from].bound && !plot.cases[step.to].bound && std::isfinite(step.cost_factor);
        return {{"from", number(step.from)},
                {"to", number(step.to)},
                {"cost_factor", ratio ? Json(step.cost_factor) : Json()},
                {"error_reduction", step.error_reduction}};
    });
    json["best"] = json_list(best_rows(plot), [&](const BestRow& row) -> Json {
        return {{"of_base", row.multiple}, {"case", row.best ? Json(number(*row.best)) : Json()}};
    });
    return json;
}

/// Replaces a varied resolution by the drawn one. The row's notes give the reason why it is smaller.
void put_drawn_resolution(SweepRow& row, int drawn) {
    for (auto& [key, value] : row.settings)
        if (drawn > 0 && key == "map.resolution") value = std::to_string(drawn);
}

std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

}  // namespace

namespace {
Json shadow_spread_json(const Spread& time) {
    Json json = spread_json(time);
    json["below_noise"] = below_noise(time);
    return json;
}

}  // namespace

Json shadow_json(const ShadowTime& time) {
    return {{"moving_ms", shadow_spread_json(time.moving_ms)},
            {"still_ms", shadow_spread_json(time.still_ms)},
            {"forced_ms", time.forced_ms ? shadow_spread_json(*time.forced_ms) : Json()},
            {"of_base", std::isfinite(time.of_base) ? Json(time.of_base) : Json()}};
}

RankedRounds rounds_like(const SweepState& state, const RunInfo& like) {
    std::map<std::pair<std::string, int>, std::set<std::size_t>> drawn;
    std::size_t live = 0;
    for (const auto& [number, c] : state.cases) {
        if (!c.is_measured()) continue;
        ++live;
        for (const RoundTimes& turn : c.turns) drawn[{turn.run, turn.round}].insert(number);
    }
    RankedRounds ranked;
    for (const auto& [round, cases] : drawn) {
        const RunInfo* run = state.run(round.first);
        if (run && run->comparable_with(like) && cases.size() == live) ranked.insert(round);
    }
    return ranked;
}

RankedRounds ranked_rounds(const SweepState& state) {
    RankedRounds best;
    std::optional<CostCase> cost;
    for (auto run = state.runs.rbegin(); run != state.runs.rend(); ++run) {  // latest run first
        if (cost && run->cost != *cost) continue;
        RankedRounds rounds = rounds_like(state, *run);
        if (rounds.empty()) continue;
        cost = run->cost;
        if (rounds.size() > best.size()) best = std::move(rounds);
    }
    return best;
}

TimeSamples ranked_samples(const CaseState& c, const RankedRounds& rounds) {
    TimeSamples samples;
    for (const RoundTimes& turn : c.turns)
        if (rounds.contains({turn.run, turn.round})) samples.add(turn.samples);
    return samples;
}

RoundSlowness round_slowness(const SweepState& state, const RankedRounds& rounds) {
    constexpr std::size_t kLeastCases = 8;
    if (rounds.size() < std::size_t(kMinBursts)) return {};
    const auto median = [](std::vector<double> values) { return lower_quantile(std::move(values), 0.5, 0); };
    std::map<RankedRounds::value_type, std::vector<double>> ratios;
    std::size_t cases = 0;
    for (const auto& [number, c] : state.cases) {
        std::map<RankedRounds::value_type, double> of_round;
        std::vector<double> all;
        for (const RoundTimes& turn : c.turns) {
            const RankedRounds::value_type round(turn.run, turn.round);
            if (!rounds.contains(round) || turn.shadow.moving_ms.empty()) continue;
            of_round[round] = median(turn.shadow.moving_ms);
            all.push_back(of_round[round]);
        }
        if (of_round.size() < rounds.size() || std::ranges::min(all) <= 0) continue;
        ++cases;
        const double usual_ms = median(std::move(all));
        for (const auto& [round, ms] : of_round) ratios[round].push_back(ms / usual_ms);
    }
    RoundSlowness slowness;
    if (cases < kLeastCases) return slowness;
    for (auto& [round, values] : ratios) slowness[round] = median(std::move(values));
    return slowness;
}

ShadowSamples ranked_shadow(const std::vector<RoundTimes>& turns, const RankedRounds& rounds,
                            const RoundSlowness& slowness) {
    ShadowSamples samples;
    for (const RoundTimes& turn : turns) {
        const RankedRounds::value_type round(turn.run, turn.round);
        if (!rounds.contains(round)) continue;
        const auto known = slowness.find(round);
        ShadowSamples adjusted = turn.shadow;
        for (std::vector<double>* times : {&adjusted.moving_ms, &adjusted.still_ms, &adjusted.forced_more_ms})
            for (double& ms : *times) ms /= known == slowness.end() ? 1 : known->second;
        samples.add(adjusted);
    }
    return samples;
}

std::string picture_path(std::size_t n) {
    return fmt::format("pictures/{:04}.jpg", n);
}
std::string artefacts_path(std::size_t n) {
    return fmt::format("pictures/{:04}-artefacts.png", n);
}

SweepResults sweep_results(const SweepState& state, const SweepPlan& plan) {
    const Shard shard = parse_shard(state.spec.at("shard").get<std::string>());
    const RankedRounds ranked = ranked_rounds(state);
    const RoundSlowness slowness = round_slowness(state, ranked);
    SweepResults out;
    out.spec = state.spec;
    out.combinations = plan.product;
    out.cases = plan.cases.size();
    for (std::size_t i = 0; i < plan.cases.size(); ++i) {
        if (!shard.contains(i)) continue;
        const auto known = state.cases.find(i);
        if (known == state.cases.end() || !(known->second.finished || !known->second.failed.empty())) continue;
        const CaseState& c = known->second;
        SweepRow row{.number = i,
                     .settings = plan.cases[i].values,
                     .starts = plan.cases[i].starts,
                     .failed = c.failed,
                     .numbers = {},
                     .notes = c.notes,
                     .own_settings = c.own_settings};
        (c.failed.empty() ? out.finished : out.failed) += 1;
        put_drawn_resolution(row, c.map_resolution);
        if (c.failed.empty()) row.numbers = {.error = c.error, .cost = c.cost, .time = {}};
        if (const TimeSamples samples = ranked_samples(c, ranked); c.failed.empty() && !samples.total_ms.empty()) {
            row.numbers.time = summarise_times(samples);
            const RunInfo& run = *state.run(ranked.begin()->first);
            row.numbers.time->clock = out.clock = run.clock;
            row.numbers.time->cost = out.cost = run.cost;
            if (const ShadowSamples shadow = ranked_shadow(c.turns, ranked, slowness); !shadow.moving_ms.empty())
                row.numbers.shadow = summarise_shadow(shadow);
        }
        out.rows.push_back(std::move(row));
    }
    find_base(out, state, plan, ranked, slowness);
    const RunInfo* run =
        ranked.empty() ? (state.runs.empty() ? nullptr : &state.runs.back()) : state.run(ranked.begin()->first);
    out.renderer = run ? run->renderer : "";
    out.software = run && run->software;
    out.rounds = ranked.size();
    for (const RunInfo& r : state.runs)
        out.runs.emplace_back(r, int(std::ranges::count(ranked, r.id, &RankedRounds::value_type::first)));
    find_frontier(out);
    return out;
}

Json results_json(const SweepResults& results) {
    Json json = {{"format", kResultsFormat}, {"version", kResultsVersion}};
    for (const char* key : {"scene", "picture", "truth", "settings", "axes", "shard"}) json[key] = results.spec.at(key);
    json["settings_version"] = kSettingsVersion;
    json["combinations"] = results.combinations;
    json["cases"] = results.cases;
    json["finished"] = results.finished;
    json["failed"] = results.failed;
    json["renderer"] = results.renderer;
    json["cpu_rasteriser"] = results.software;
    json["clock"] = results.clock;
    json["timed"] = cost_row(results.cost).key;
    json["rounds"] = results.rounds;
    json["runs"] = json_list(results.runs, [](const auto& run) { return run_json(run.first, run.second); });
    json["base"] = Json();
    if (results.base) {
        json["base"] = {{"settings", changes_json(base_case({}).values)}};
        json["base"]["case"] = results.base_case ? Json(*results.base_case) : Json();
        json["base"]["shadow"] = shadow_json(*results.base);
    }
    json["frontier"] = {{"x", results.x}, {"y", results.y}, {"cases", results.frontier}, {"tied", results.tied}};
    const FrontierPlot plot = frontier_plot(results);
    json["frontier"].update(readings_json(plot, results));
    json["rows"] = json_list(results.rows, row_json);
    return json;
}

std::string results_csv(const SweepResults& results) {
    std::vector<const Column*> used;
    // Ratios within the noise have no value. Their column stays, so that the header does not depend on the noise.
    const auto measured = [](const Column& column, const SweepRow& row) {
        return std::isfinite(column.value(row.numbers)) || (column.key == kOfBaseColumn && row.numbers.shadow);
    };
    for (const Column& column : columns())
        if (std::ranges::any_of(results.rows, [&](const SweepRow& row) { return measured(column, row); }))
            used.push_back(&column);
    std::string text = "case";
    const auto add = [&text](std::string_view cell) { text.append(1, ',').append(cell); };
    const Json& axes = results.spec.at("axes");
    for (const Json& axis : axes) add(csv_cell(axis.at("key").get<std::string>()));
    for (const Column* column : used) add(column->key);
    text += ",timed,on_frontier,failed,notes\n";
    for (const SweepRow& row : results.rows) {
        text += std::to_string(row.number);
        for (const auto& [key, value] : row.settings) add(csv_cell(value));
        for (const Column* column : used) {
            const double v = column->value(row.numbers);
            add(std::isfinite(v) ? fmt::format("{:.9g}", v) : "");
        }
        const auto& on = results.frontier;
        add(row.numbers.time ? cost_row(row.numbers.time->cost).key : "");
        add(std::find(on.begin(), on.end(), row.number) != on.end() ? "true" : "false");
        add(csv_cell(row.failed));
        add(csv_cell(fmt::format("{}", fmt::join(row.notes, "; "))));
        text += '\n';
    }
    return text;
}

}  // namespace si
