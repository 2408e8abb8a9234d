#include "app/sweep/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/report/fixes_json.h"
#include "app/report/measure_json.h"
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
    results.x = first_with_numbers(results.rows, {"time.total_ms.median", "cost.bytes_touched"});
    results.y = first_with_numbers(results.rows, {"error.mae"});
    for (const FrontierView::Mark& mark : frontier_view(results.rows, nullptr, results.x, results.y).marks) {
        if (mark.on) results.frontier.push_back(results.rows[mark.of].number);
        if (mark.tied) results.tied.push_back(results.rows[mark.of].number);
    }
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
    json["failed"] = row.failed.empty() ? Json() : Json(row.failed);
    json["error"] = n.error ? error_json(n.error->metrics, n.error->noise) : Json();
    json["cost"] = n.cost ? cost_json(*n.cost) : Json();
    json["time"] = n.time ? time_json(*n.time) : Json();
    json["notes"] = row.notes;
    json["picture"] = row.failed.empty() ? Json(picture_path(row.number)) : Json();
    json["artefacts"] = row.failed.empty() ? Json(artefacts_path(row.number)) : Json();
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

RankedRounds rounds_like(const SweepState& state, const RunInfo& like) {
    std::map<std::pair<std::string, int>, std::set<std::size_t>> drawn;
    std::size_t live = 0;
    for (const auto& [number, c] : state.cases) {
        if (!c.is_measured()) continue;
        ++live;
        for (const Turn& turn : c.turns) drawn[{turn.run, turn.round}].insert(number);
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
    for (const Turn& turn : c.turns)
        if (rounds.contains({turn.run, turn.round})) samples.add(turn.samples);
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
                     .notes = c.notes};
        (c.failed.empty() ? out.finished : out.failed) += 1;
        put_drawn_resolution(row, c.map_resolution);
        if (c.failed.empty()) row.numbers = {.error = c.error, .cost = c.cost, .time = {}};
        if (const TimeSamples samples = ranked_samples(c, ranked); c.failed.empty() && !samples.total_ms.empty()) {
            row.numbers.time = summarise_times(samples);
            const RunInfo& run = *state.run(ranked.begin()->first);
            row.numbers.time->clock = out.clock = run.clock;
            row.numbers.time->cost = out.cost = run.cost;
        }
        out.rows.push_back(std::move(row));
    }
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
    json["frontier"] = {{"x", results.x}, {"y", results.y}, {"cases", results.frontier}, {"tied", results.tied}};
    json["rows"] = json_list(results.rows, row_json);
    return json;
}

std::string results_csv(const SweepResults& results) {
    std::vector<const Column*> used;
    for (const Column& column : columns())
        if (std::any_of(results.rows.begin(), results.rows.end(),
                        [&](const SweepRow& row) { return std::isfinite(column.value(row.numbers)); }))
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
