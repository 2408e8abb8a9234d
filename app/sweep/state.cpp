#include "app/sweep/state.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <thread>

#include "app/report/fixes_json.h"
#include "app/report/measure_json.h"
#include "renderer/base/key.h"
#include "renderer/settings/param.h"

namespace si {

namespace {

std::string machine_key() {
    std::string id;
    std::ifstream("/etc/machine-id") >> id;
    std::array<char, 256> host{};
    ::gethostname(host.data(), host.size() - 1);
    return fmt::format("{:016x}", Key().add(std::string_view(id)).add(std::string_view(host.data())).value());
}

/// Rounds milliseconds to microseconds: finer digits are noise and would lengthen the journal.
Json milliseconds(const std::vector<double>& values) {
    return json_list(values, [](double v) { return std::round(v * 1e4) / 1e4; });
}

RoundTimes turn_of(const Json& line) {
    RoundTimes turn;
    turn.round = line.at("round").get<int>();
    turn.run = line.at("run").get<std::string>();
    turn.samples.total_ms = line.at("total_ms").get<std::vector<double>>();
    turn.samples.maps_ms = line.at("maps_ms").get<std::vector<double>>();
    for (const Json& pass : line.at("passes"))
        turn.samples.passes.push_back({pass.at("name").get<std::string>(), pass.at("gpu_ms").get<std::vector<double>>(),
                                       pass.at("cpu_ms").get<std::vector<double>>()});
    // Other clocks have no wall time of their own, and journals from before the list lack it.
    turn.samples.wall_ms = line.value("wall_ms", std::vector<double>());
    if (turn.samples.wall_ms.empty()) turn.samples.wall_ms.resize(turn.samples.total_ms.size());
    if (turn.samples.wall_ms.size() != turn.samples.total_ms.size()) throw Error("unequal numbers of frames");
    if (turn.samples.maps_ms.size() != turn.samples.total_ms.size()) throw Error("unequal numbers of frames");
    if (const auto shadow = line.find("shadow"); shadow != line.end()) {
        turn.shadow.moving_ms = shadow->at("moving_ms").get<std::vector<double>>();
        turn.shadow.still_ms = shadow->at("still_ms").get<std::vector<double>>();
        turn.shadow.forced_more_ms = shadow->value("forced_more_ms", std::vector<double>());
        // Later rounds time the moving light alone.
        const std::size_t still = turn.shadow.still_ms.size();
        if (still != 0 && still != turn.shadow.moving_ms.size()) throw Error("unequal numbers of frames");
    }
    return turn;
}

/// Checks that errors have this program's definition. @throws OtherMeaning
void require_known_meaning(const Json& error) {
    const int meaning = error.value("meaning", 1);  // the first version had no number
    if (meaning != kErrorMeaning)
        throw OtherMeaning(
            fmt::format("errors of meaning {}, which do not compare with this program's of meaning {} "
                        "(docs/accuracy.md, Errors): sweep again",
                        meaning, kErrorMeaning));
}

/// Rejects numbers that no picture can have, which would lead the Pareto front. @throws Error
void require_possible(const ErrorMetrics& m) {
    constexpr double kRounding = 1e-6, kMaxPixels = 1e6;
    for (const Metric& metric : metrics()) {
        if (!metric.member) continue;
        const bool share = metric.unit == kShareOfPixels || metric.unit == kOfVisibility;
        const double v = m.*metric.member, least = metric.better == Better::NearZero ? -1 : 0;
        const double most = share || metric.better == Better::More ? 1 : kMaxPixels;
        const bool unknown_share = std::isnan(v) && share && m.counted > 0;
        if (unknown_share || v < least - kRounding || v > most + kRounding)
            throw Error(fmt::format("its {} is {:.6g}, which none can be", metric.key, v));
    }
}

/// Reads settings {key: value}. @throws UsageError for an unknown key or a bad value
std::vector<std::pair<std::string, std::string>> settings_of(const Json& json) {
    std::vector<std::pair<std::string, std::string>> settings;
    for (const auto& [key, value] : json.items()) settings.emplace_back(key, value.get<std::string>());
    Settings trial;
    set_settings(trial, settings);
    return settings;
}

RunInfo run_of(const Json& line) {
    return {.id = line.at("id").get<std::string>(),
            .started = line.at("started").get<std::string>(),
            .machine = line.at("machine").get<std::string>(),
            .renderer = line.at("renderer").get<std::string>(),
            .version = line.at("version").get<std::string>(),
            .clock = line.at("clock").get<std::string>(),
            .software = line.at("software").get<bool>(),
            .load = line.at("load").get<double>(),
            .cost = parse_cost(line.value("cost", "forced"))};  // the first journals timed forced frames only
}

}  // namespace

bool RunInfo::comparable_with(const RunInfo& other) const {
    return machine == other.machine && renderer == other.renderer && version == other.version && clock == other.clock &&
           cost == other.cost;
}

RunInfo this_run() {
    RunInfo run;
    const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    run.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
    run.machine = machine_key();
    run.id = fmt::format("{}-{}-{}", run.started, run.machine.substr(0, 4), ::getpid());
    double load = 0;
    if (::getloadavg(&load, 1) == 1) run.load = load / std::max(1u, std::thread::hardware_concurrency());
    return run;
}

const RunInfo* SweepState::run(const std::string& id) const {
    const auto it = std::find_if(runs.begin(), runs.end(), [&](const RunInfo& r) { return r.id == id; });
    return it == runs.end() ? nullptr : &*it;
}

std::string contradiction(const CaseState& a, const CaseState& b) {
    if (!a.is_measured() || !b.is_measured()) return {};
    const auto first_difference = [](const Json& one, const Json& other) -> std::string {
        const Json flat = one.flatten(), other_flat = other.flatten();
        for (const auto& [path, value] : flat.items())
            if (const auto at = other_flat.find(path); at == other_flat.end() || *at != value)
                return fmt::format("{} {} and {}", path.substr(1), value.dump(),
                                   at == other_flat.end() ? "nothing" : at->dump());
        return {};
    };
    if (std::string error = first_difference(error_json(a.error.metrics), error_json(b.error.metrics)); !error.empty())
        return error;
    return first_difference(cost_json(a.cost), cost_json(b.cost));
}

void SweepState::apply(const Json& line) {
    if (line.contains("format")) {
        if (line["format"] != kJournalFormat) throw Error("this is no journal of a sweep");
        const Json& version = line.at("version");
        if (!version.is_number_integer() || version < oldest_settings_version() || version > kSettingsVersion)
            throw Error(
                fmt::format("version {} of the journal cannot be read, only {}", version.dump(), readable_versions()));
        spec = line.at("spec");
        // The line must be as this program writes it.
        if (version < kSettingsVersion) spec = spec_json(spec_from_json(spec, version.get<int>()));
        plan = line.at("plan").get<std::string>();
    } else if (line.contains("turn")) {
        RoundTimes turn = turn_of(line);
        case_of(line, "turn").turns.push_back(std::move(turn));
    } else if (line.contains("base_turn")) {
        base_turns.push_back(turn_of(line));
    } else if (line.contains("run")) {
        const RunInfo info = run_of(line["run"]);
        if (!run(info.id)) runs.push_back(info);
    } else if (line.contains("begin")) {
        ++case_of(line, "begin").begun;
    } else if (line.contains("cancelled")) {
        CaseState& c = case_of(line, "cancelled");
        c.begun = std::max(c.begun - 1, 0);
    } else if (line.contains("facts")) {
        require_known_meaning(line.at("error"));
        CaseState facts;
        facts.error = {error_from_json(line.at("error")), number_or_nan(line["error"], "noise")};
        require_possible(facts.error.metrics);
        facts.cost = cost_from_json(line.at("cost"));
        facts.notes = line.at("notes").get<std::vector<std::string>>();
        facts.map_resolution = line.value("map_resolution", 0);
        facts.own_settings = settings_of(line.value("own_settings", Json::object()));
        facts.finished = true;
        CaseState& c = case_of(line, "facts");
        if (const std::string phrase = contradiction(c, facts); !phrase.empty()) {
            notes.push_back(fmt::format("the journal contradicts itself in case {}: {}; the first counts",
                                        quoted(line["facts"]), phrase));
            c.begun = 0;
            return;
        }
        facts.turns = std::move(c.turns);
        c = std::move(facts);
    } else if (line.contains("failed")) {
        std::string why = line.at("why").get<std::string>();
        CaseState& c = case_of(line, "failed");
        c.failed = std::move(why);
        c.begun = 0;
    } else {
        throw Error("an unknown kind of line");
    }
}

CaseState& SweepState::case_of(const Json& line, const char* member) {
    const Json& number = line.at(member);
    if (!number.is_number_unsigned() || number.get<std::uint64_t>() >= case_count)
        throw Error(fmt::format("there is no case {}", quoted(number)));
    return cases[number.get<std::size_t>()];
}

Json header_line(const Json& spec, const std::string& plan) {
    return {{"format", kJournalFormat}, {"version", kSettingsVersion}, {"plan", plan}, {"spec", spec}};
}

Json run_line(const RunInfo& run) {
    return {{"run",
             {{"id", run.id},
              {"started", run.started},
              {"machine", run.machine},
              {"renderer", run.renderer},
              {"version", run.version},
              {"clock", run.clock},
              {"software", run.software},
              {"load", run.load},
              {"cost", cost_row(run.cost).key}}}};
}

Json begin_line(std::size_t case_number) {
    return {{"begin", case_number}};
}

Json cancelled_line(std::size_t case_number) {
    return {{"cancelled", case_number}};
}

Json facts_line(std::size_t case_number, const CaseErrorAndCost& facts) {
    Json line = {{"facts", case_number},
                 {"error", error_json(facts.error.metrics, facts.error.noise)},
                 {"cost", cost_json(facts.cost)},
                 {"map_resolution", facts.map_resolution},
                 {"notes", facts.notes}};
    if (!facts.own_settings.empty()) line["own_settings"] = changes_json(facts.own_settings);
    return line;
}

Json failure_line(std::size_t case_number, const std::string& why) {
    return {{"failed", case_number}, {"why", why}};
}

namespace {

/// Makes a line of timed frames. @param of member that tells whose they are @param number its value
Json turn_line_of(const char* of, const Json& number, const RoundTimes& turn) {
    const auto pass_json = [](const auto& pass) -> Json {
        return {{"name", pass.name}, {"gpu_ms", milliseconds(pass.gpu_ms)}, {"cpu_ms", milliseconds(pass.cpu_ms)}};
    };
    Json line = {{of, number},
                 {"round", turn.round},
                 {"run", turn.run},
                 {"total_ms", milliseconds(turn.samples.total_ms)},
                 {"maps_ms", milliseconds(turn.samples.maps_ms)},
                 {"wall_ms", milliseconds(turn.samples.wall_ms)}};
    if (!turn.shadow.moving_ms.empty())
        line["shadow"] = {{"moving_ms", milliseconds(turn.shadow.moving_ms)},
                          {"still_ms", milliseconds(turn.shadow.still_ms)},
                          {"forced_more_ms", milliseconds(turn.shadow.forced_more_ms)}};
    line["passes"] = json_list(turn.samples.passes, pass_json);
    return line;
}

}  // namespace

Json turn_line(std::size_t case_number, const RoundTimes& turn) {
    return turn_line_of("turn", case_number, turn);
}

Json base_turn_line(const RoundTimes& turn) {
    return turn_line_of("base_turn", true, turn);
}

}  // namespace si
