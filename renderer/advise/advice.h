// Advice: setting changes that rules propose from facts of the scene, each measured for error and time before it is
// shown.
//
//     AdviceReport report = find_advice({renderer, scene, 1280, 720, cache}, settings, {});
//     report.holds.front().candidate.name, report.holds.front().changes    // reason of the best change, and the change
#pragma once

#include "renderer/advise/advice_facts.h"
#include "renderer/measure/measure.h"

namespace si {

/// Rule of the advice search: proposes changes of shadow settings when a condition on a measured frame is true. Row of
/// advice_rules().
struct AdviceRule {
    std::string_view key, label;
    std::string_view help;  ///< a sentence on the condition
    Claim claim = Claim::Same;
    /// Change of the settings that an advice rule proposes.
    using Change = std::function<void(Settings&)>;
    /// Callback through which an advice rule proposes setting changes, each with a sentence that gives the reason.
    struct Offer {
        std::function<void(std::string sentence, const Change& change, int light)> receive;
        /// Offers a setting change. @param light index of the light in the settings light.*; negative:
        /// AdviceFacts::light
        void operator()(std::string sentence, const Change& change, int light = -1) const {
            receive(std::move(sentence), change, light);
        }
    };
    /// Checks the condition of the advice rule and offers its setting changes.
    void (*propose)(const Settings& settings, const AdviceFacts& facts, const Offer& offer) = nullptr;
    bool reads_map = true;  ///< true: proposes nothing for a light that draws no map, or that no pixel faces
};
/// Returns the table of advice rules, which propose setting changes for a measured frame.
std::span<const AdviceRule> advice_rules();

/// Collects the setting changes that the advice rules propose for a frame with these settings and measurements. Leaves
/// out changes without effect. Also leaves out a change that an earlier rule proposes with the same claimed benefit
/// (Claim). Draws nothing: try_advice() measures the candidates.
std::vector<Candidate> advice_candidates(const Settings& settings, const AdviceFacts& facts);

/// Draws, times and ranks candidates (setting changes that advice rules propose), by means of `meter`. The order is:
/// lower error, less time at equal error, less time for more error, less memory, rejected changes. Candidates with
/// equal settings are drawn once. Differences within noise do not count.
/// @param shown receives the ranked trials so far, after each trial
/// @returns the trials so far when the report throws Cancelled after the first trial
std::vector<Trial> try_advice(const Settings& settings, std::vector<Candidate> candidates, const TrialMeter& meter,
                              const TrialReport& report = {},
                              const std::function<void(const std::vector<Trial>&)>& shown = {});

/// Severity of a finding (a problem found in a frame), the worst first.
enum class Severity { Error, Warning, Hint };
/// Returns the name of a severity in JSON and text: "error", "warning" or "hint".
std::string_view severity_key(Severity severity);

/// Problem found in a frame, such as a warning of the renderer or wrong pixels of one cause, with a fix if known.
struct Finding {
    Severity severity = Severity::Hint;
    std::string text;  ///< a sentence
    std::string fix;   ///< fix in words; empty: unknown
    std::vector<std::pair<std::string, std::string>>
        settings;  ///< changes of settings that fix the problem: setting keys and new values
};
/// Lists the problems of a frame, the worst first: warnings of the renderer, limits of the shadow maps, and wrong
/// pixels by cause. Each cause comes with the tried fix that puts most of its pixels right (FixTable::fix_of()). Draws
/// nothing: both arguments are measured before.
std::vector<Finding> list_findings(const AdviceFacts& facts, const FixTable& fixes);

/// Options of find_advice(): error metric to compare, kind of frames that are timed, and whether fixes are measured.
struct AdviceOptions {
    const Metric* error = &metrics().front();  ///< metric to compare; not Better::Neither
    CostCase cost = kDefaultCost;              ///< kind of frames that are timed
    bool fixes = true;                         ///< true: draws and measures fixes for the findings
};

/// Result of find_advice(): setting changes, ranked by measured error and frame time, and problems found in the frame.
struct AdviceReport {
    AdviceFacts facts;
    std::vector<Trial> holds;  ///< changes that are accepted, the best first
    std::vector<Trial> fails;  ///< changes that are rejected
    std::vector<Finding> findings;
    AdviceOptions options;
    MeasuredSettings before;  ///< present settings
    TimeMeasurement time;     ///< frame time of the present settings
    bool stopped = false;     ///< stopped before all changes were tried
    std::size_t refused = 0;  ///< number of changes that were not tried, since the engine lacks them
};

/// Searches for advice: takes measurements of the frame, lets the rules propose setting changes, measures and ranks the
/// changes, and lists problems with fixes.
/// @param shown receives the report so far
/// @throws Error when there is no light to compare; Cancelled before the first trial. Later the report so far is
/// returned
AdviceReport find_advice(const SearchTools& tools, const Settings& settings, const AdviceOptions& options,
                         const std::function<void(const AdviceReport&)>& shown = {});

}  // namespace si
