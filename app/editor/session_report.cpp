#include "app/editor/session_report.h"

#include "app/base/output.h"
#include "app/report/report.h"

namespace si {
namespace {

constexpr std::size_t kMaxMessages = 100;  ///< largest number of messages of a kind
constexpr std::size_t kMaxSamples = 200;   ///< beyond it every second sample is dropped, and the interval doubles

Json errors_json(const Log& log) {
    std::size_t count = 0;
    Json first = Json::array();
    for (const LogLine& line : log.lines()) {
        if (line.kind != LogKind::Error) continue;
        count += std::size_t(line.count);
        if (first.size() < kMaxMessages) first.push_back(line.text);
    }
    return {{"count", count}, {"first", first}};
}

}  // namespace

void SessionReport::note_driver(const std::string& message) {
    if (driver_.size() < kMaxMessages) driver_.push_back(message);
    ++driver_count_;
}

void SessionReport::sample(double now_s) {
    if (began_s_ < 0) began_s_ = now_s;
    samples_.push_back({now_s - began_s_, memory_report()});
    if (samples_.size() < kMaxSamples) return;
    std::vector<Sample> fewer;
    for (std::size_t i = 1; i < samples_.size(); i += 2) fewer.push_back(std::move(samples_[i]));
    samples_ = std::move(fewer);
    every_s_ *= 2;
}

void SessionReport::write_when_due(double now_s, const Log& log) {
    if (path_.empty() || now_s < due_s_) return;
    sample(now_s);
    due_s_ = now_s + every_s_;
    write(log);
}

void SessionReport::write(const Log& log) {
    if (path_.empty()) return;
    Json json = {{"format", "shadow-inspector-session"},
                 {"version", 1},
                 {"frames", frames_},
                 {"references", traces_},
                 {"driver_messages", {{"count", driver_count_}, {"first", driver_}}},
                 {"errors", errors_json(log)},
                 {"unsound", unsound_.empty() ? Json() : Json(unsound_)},
                 {"memory", memory_json(memory_report())},
                 {"memory_over_time", Json::array()}};
    for (const Sample& s : samples_) {
        Json row = {{"seconds", s.seconds}};
        row.update(memory_json(s.memory));
        json["memory_over_time"].push_back(std::move(row));
    }
    write_regular_file(path_, json_text(json));
}

}  // namespace si
