#include "app/editor/session_report.h"

#include "app/base/output.h"
#include "app/report/memory_json.h"
#include "app/report/report.h"

namespace si {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostTold = 100;     ///< messages of a kind
constexpr std::size_t kMostSamples = 200;  ///< then every second one goes, and they are taken half as often

void keep_one(std::vector<std::string>& told, std::size_t& count, const std::string& message) {
    if (told.size() < kMostTold) told.push_back(message);
    ++count;
}

}  // namespace

void SessionReport::note_driver(const std::string& message) {
    keep_one(driver_, driver_count_, message);
}

void SessionReport::note_error(const std::string& message) {
    keep_one(errors_, error_count_, message);
}

void SessionReport::sample(double now_s) {
    if (began_s_ < 0) began_s_ = now_s;
    samples_.push_back({now_s - began_s_, memory_facts()});
    if (samples_.size() < kMostSamples) return;
    std::vector<Sample> fewer;
    for (std::size_t i = 1; i < samples_.size(); i += 2) fewer.push_back(std::move(samples_[i]));
    samples_ = std::move(fewer);
    every_s_ *= 2;
}

void SessionReport::follow(double now_s) {
    if (path_.empty() || now_s < due_s_) return;
    sample(now_s);
    due_s_ = now_s + every_s_;
    write();
}

void SessionReport::write() {
    if (path_.empty()) return;
    Json json = {{"format", "shadow-inspector-session"},
                 {"version", 1},
                 {"frames", frames_},
                 {"driver_messages", {{"count", driver_count_}, {"first", driver_}}},
                 {"errors", {{"count", error_count_}, {"first", errors_}}},
                 {"unsound", unsound_.empty() ? Json() : Json(unsound_)},
                 {"memory", memory_json(memory_facts())},
                 {"memory_over_time", Json::array()}};
    for (const Sample& s : samples_) {
        Json row = {{"seconds", s.seconds}};
        row.update(memory_json(s.memory));
        json["memory_over_time"].push_back(std::move(row));
    }
    write_file(path_, json_text(json));
}

}  // namespace si
