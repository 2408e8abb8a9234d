#include "app/sweep/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/report/measure_json.h"
#include "app/sweep/columns.h"
#include "app/sweep/measured_cases.h"

namespace si {

using Json = nlohmann::ordered_json;

namespace {

/// The axes of the plot to begin with: of several in order of preference the first that has numbers.
std::string first_with_numbers(const Json& rows, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
        for (const Json& row : rows)
            if (std::isfinite(number_at(row, key))) return key;
    return *keys.begin();
}

Json frontier_json(const Json& rows) {
    const std::string x = first_with_numbers(rows, {"time.total_ms.median", "cost.bytes_touched"});
    const std::string y = first_with_numbers(rows, {"error.mae"});
    Json json = {{"x", x}, {"y", y}, {"cases", Json::array()}, {"tied", Json::array()}};
    for (const FrontierView::Mark& mark : frontier_view(rows, {}, x, y).marks) {
        if (mark.on) json["cases"].push_back(rows[mark.of]["case"]);
        if (mark.tied) json["tied"].push_back(rows[mark.of]["case"]);
    }
    return json;
}

Json run_json(const RunInfo& run, const RankedRounds& ranked) {
    int rounds = 0;
    for (const auto& [id, unused] : ranked.rounds) rounds += id == run.id;
    return {{"id", run.id},           {"started", run.started}, {"renderer", run.renderer},
            {"version", run.version}, {"clock", run.clock},     {"cpu_rasteriser", run.software},
            {"load", run.load},       {"ranked_rounds", rounds}};
}

std::string csv_cell(const Json& value) {
    if (value.is_null()) return "";
    std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

}  // namespace

bool RankedRounds::holds(const Turn& turn) const {
    return std::find(rounds.begin(), rounds.end(), std::pair(turn.run, turn.round)) != rounds.end();
}

RankedRounds rounds_like(const SweepState& state, const RunInfo& like) {
    std::map<std::pair<std::string, int>, std::set<std::size_t>> drawn;
    std::size_t live = 0;
    for (const auto& [number, c] : state.cases) {
        if (!c.finished || !c.failed.empty()) continue;
        ++live;
        for (const Turn& turn : c.turns) drawn[{turn.run, turn.round}].insert(number);
    }
    RankedRounds ranked;
    for (const auto& [round, cases] : drawn) {
        const RunInfo* run = state.run(round.first);
        if (run && run->same_clock_as(like) && cases.size() == live) ranked.rounds.push_back(round);
    }
    return ranked;
}

RankedRounds ranked_rounds(const SweepState& state) {
    RankedRounds best;
    for (const RunInfo& run : state.runs) {  // in the order of time
        RankedRounds rounds = rounds_like(state, run);
        if (!rounds.rounds.empty() && rounds.rounds.size() >= best.rounds.size()) best = std::move(rounds);
    }
    return best;
}

TimeSamples ranked_samples(const CaseState& c, const RankedRounds& rounds) {
    TimeSamples samples;
    for (const Turn& turn : c.turns)
        if (rounds.holds(turn)) samples.add(turn.samples);
    return samples;
}

std::string picture_path(std::size_t n) {
    return fmt::format("pictures/{:04}.jpg", n);
}
std::string artefacts_path(std::size_t n) {
    return fmt::format("pictures/{:04}-artefacts.png", n);
}

Json results_json(const SweepState& state, const SweepPlan& plan) {
    const Shard shard = parse_shard(state.spec.at("shard").get<std::string>());
    const RankedRounds ranked = ranked_rounds(state);
    Json rows = Json::array();
    std::string clock;
    std::size_t finished = 0, failed = 0;
    for (std::size_t i = 0; i < plan.cases.size(); ++i) {
        if (!shard.holds(i)) continue;
        const auto known = state.cases.find(i);
        if (known == state.cases.end() || !(known->second.finished || !known->second.failed.empty())) continue;
        const CaseState& c = known->second;
        (c.failed.empty() ? finished : failed) += 1;
        Json row = {{"case", i}, {"settings", Json::object()}};
        for (const auto& [key, value] : plan.cases[i].values) row["settings"][key] = value;
        row["failed"] = c.failed.empty() ? Json() : Json(c.failed);
        row["error"] = c.failed.empty() ? c.error : Json();
        row["cost"] = c.failed.empty() ? c.cost : Json();
        row["time"] = nullptr;
        if (const TimeSamples samples = ranked_samples(c, ranked); c.failed.empty() && !samples.total_ms.empty()) {
            TimeMeasurement m = summary(samples);
            m.clock = clock = state.run(ranked.rounds.front().first)->clock;
            row["time"] = time_json(m);
        }
        row["notes"] = c.notes;
        row["picture"] = c.failed.empty() ? Json(picture_path(i)) : Json();
        row["artefacts"] = c.failed.empty() ? Json(artefacts_path(i)) : Json();
        rows.push_back(std::move(row));
    }
    const RunInfo* run = ranked.rounds.empty() ? (state.runs.empty() ? nullptr : &state.runs.back())
                                               : state.run(ranked.rounds.front().first);
    Json json = {{"format", kResultsFormat}, {"version", kResultsVersion}};
    for (const char* key : {"scene", "picture", "truth", "settings", "axes", "shard"}) json[key] = state.spec.at(key);
    json["settings_version"] = kSettingsVersion;
    json["combinations"] = plan.product;
    json["cases"] = plan.cases.size();
    json["finished"] = finished, json["failed"] = failed;
    json["renderer"] = run ? run->renderer : "";
    json["cpu_rasteriser"] = run && run->software;
    json["clock"] = clock;
    json["rounds"] = ranked.rounds.size();
    json["runs"] = Json::array();
    for (const RunInfo& r : state.runs) json["runs"].push_back(run_json(r, ranked));
    json["frontier"] = frontier_json(rows);
    json["rows"] = std::move(rows);
    return json;
}

std::string results_csv(const Json& results) {
    std::set<Json> on(results.at("frontier").at("cases").begin(), results["frontier"]["cases"].end());
    std::vector<const Column*> used;
    for (const Column& column : columns())
        if (std::any_of(results.at("rows").begin(), results["rows"].end(),
                        [&](const Json& row) { return std::isfinite(number_at(row, column.key)); }))
            used.push_back(&column);
    std::string text = "case";
    const auto add = [&text](std::string_view cell) { text.append(1, ',').append(cell); };
    for (const Json& axis : results.at("axes")) add(csv_cell(axis.at("key")));
    for (const Column* column : used) add(column->key);
    text += ",on_frontier,failed\n";
    for (const Json& row : results["rows"]) {
        text += row.at("case").dump();
        for (const Json& axis : results["axes"])
            add(csv_cell(row.at("settings").at(axis.at("key").get<std::string>())));
        for (const Column* column : used) {
            const double v = number_at(row, column->key);
            add(std::isfinite(v) ? fmt::format("{:.9g}", v) : "");
        }
        add(on.contains(row["case"]) ? "true" : "false");
        add(csv_cell(row.at("failed")));
        text += '\n';
    }
    return text;
}

}  // namespace si
