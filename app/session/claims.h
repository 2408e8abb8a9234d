// Claims of a preset: what its sentence says, as numbers that a test measures. The program keeps them and does not
// measure them (tests/hard_cases/guided_presets_test.cpp does).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace si {

/// Drawing of a preset and the metric that is measured in it.
struct ClaimSubject {
    std::string metric;                  ///< name, or names whose values are added: "false_light + false_shadow"
    std::string preset;                  ///< key of a built-in preset; empty: the claim's own
    std::vector<std::string> set;        ///< changes of its settings, "KEY=VALUE"
    std::vector<std::string> receivers;  ///< node paths of surfaces that count; empty: all
    std::vector<std::string> casters;    ///< node paths of objects whose shadows count; empty: all
    std::vector<int> size = {160, 90};   ///< of the picture in pixels
};

/// A comparison: metric of `subject`, `op`, value + times * metric of `than`.
struct PresetClaim {
    ClaimSubject subject;
    std::string op;  ///< <, <=, ==, >= or >
    double value = 0;
    double times = 1;
    std::optional<ClaimSubject> than;  ///< has what it does not name from `subject`
    std::string why;                   ///< a few words for the message of a claim that fails
    std::string text;                  ///< the claim as JSON, as files hold it
};

/// Reads the member "claims" of a preset. @throws Error "claims[2].metric: what is wrong and what is allowed"
std::vector<PresetClaim> read_claims(const nlohmann::ordered_json& list);

}  // namespace si
