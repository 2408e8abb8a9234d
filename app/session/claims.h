// Claims of a preset: statements of its description as comparisons of metrics. The program only reads them; a test
// measures them (tests/hard_cases/guided_presets_test.cpp).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace si {

/// One side of a comparison that a preset claims (PresetClaim): the metric to measure, and the preset, settings and
/// objects with which it is measured.
struct ClaimSubject {
    std::string metric;                  ///< name, or names whose values are added: "false_light + false_shadow"
    std::string preset;                  ///< key of a built-in preset; empty: the preset that makes the claim
    std::vector<std::string> set;        ///< changes of the preset's settings, "KEY=VALUE"
    std::vector<std::string> receivers;  ///< node paths of surfaces that count; empty: all
    std::vector<std::string> casters;    ///< node paths of objects whose shadows count; empty: all
    std::vector<int> size = {160, 90};   ///< picture size in pixels
};

/// Statement of a preset's description as a comparison that a test measures. It compares a metric of `subject` by `op`
/// with value + times * the metric of `than`. Without `than` it compares with the constant `value`. Both sides may be
/// one preset under different settings.
struct PresetClaim {
    ClaimSubject subject;
    std::string op;  ///< <, <=, ==, >= or >
    double value = 0;
    double times = 1;
    std::optional<ClaimSubject> than;  ///< other side; members that it does not name are those of `subject`
    std::string why;                   ///< a few words for the message of a claim that fails
    std::string text;                  ///< the claim as JSON, as files hold it
};

/// Parses the claims of a preset: statements of its description as comparisons of metrics, which a test measures.
/// @param list member "claims" of the preset's JSON @throws Error "claims[2].metric: what is wrong and what is allowed"
std::vector<PresetClaim> read_claims(const nlohmann::ordered_json& list);

}  // namespace si
