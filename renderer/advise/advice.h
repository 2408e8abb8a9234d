// Advice: setting changes that rules propose from facts of the scene, each measured for error and time before it is
// shown.
//
//     AdviceReport report = find_advice(renderer, scene, settings, 1280, 720, {}, cache);
//     report.holds.front().idea.sentence, report.holds.front().settings    // best change and its reason
#pragma once

#include "renderer/advise/advice_facts.h"
#include "renderer/measure/measure.h"

namespace si {

/// Benefit that an advice rule claims for a setting change. The measurement confirms or rejects the claim.
enum class Claim {
    Same,   ///< same error in less time, or with fewer bytes
    Right,  ///< fewer wrong pixels
    Trade,  ///< less time for a little more error
};

/// Setting change that an advice rule proposes, not yet measured.
struct AdviceIdea {
    std::string_view rule;  ///< AdviceRule::key
    Claim claim = Claim::Same;
    std::string sentence;  ///< reason for the change, with its numbers
    Settings settings;     ///< settings with the change
    int light = 0;         ///< light for which the error is measured, index of light.*
};

/// Row of the table of advice rules: the condition under which a setting change is proposed, and the change.
struct AdviceRule {
    std::string_view key, label;
    std::string_view help;  ///< condition; a sentence
    Claim claim = Claim::Same;
    /// Receives a proposed change: reason, changed settings, light.
    using Offer = std::function<void(std::string sentence, Settings settings, int light)>;
    /// Checks the rule's condition and offers its setting changes.
    void (*propose)(const Settings& settings, const AdviceFacts& facts, const Offer& offer) = nullptr;
};
/// Returns the table of advice rules.
std::span<const AdviceRule> advice_rules();

/// Collects the setting changes that all advice rules propose. Leaves out changes without effect and repetitions under
/// the same claim. Draws nothing.
std::vector<AdviceIdea> advice_ideas(const Settings& settings, const AdviceFacts& facts);

/// Measured error and work of one frame under given settings.
struct MeasuredSettings {
    double error = 0;  ///< distance_from_best() of the metric
    double noise = 0;  ///< noise of the reference
    WorkCost work;
    Camera camera;
};

/// Functions that measure settings for advice: by the renderer (renderer_advice_meter()), or by a test's model.
struct AdviceMeter {
    /// Draws a frame and measures the error of one light.
    std::function<MeasuredSettings(const Settings&, int light)> classify;
    /// Times frames of two settings alternately. Returns the milliseconds per frame that the second adds.
    std::function<CostChange(const Settings& before, const Settings& with)> time;
};

/// Proposed setting change with its measured error and time, and the verdict on its claim.
struct TriedAdvice {
    AdviceIdea idea;
    std::vector<std::pair<std::string, std::string>> settings;  ///< changed settings: key and new value
    MeasuredSettings before, after;
    CostChange ms;        ///< change of the frame time, after - before
    std::string why_not;  ///< reason why the claim fails; empty: confirmed
    /// Returns the error that the change adds; negative: the error falls.
    double added_error() const { return after.error - before.error; }
    /// Returns the largest added_error() at which the advised change still counts as leaving the error unchanged: a
    /// share of the error before the change (kSameErrorShare), at least kSameError and a tenth of the reference's
    /// noise.
    double tolerance() const;
    /// Returns the bytes of maps and look-ups that the change adds; negative: saves.
    long long more_bytes() const { return (long long)after.work.bytes_touched - (long long)before.work.bytes_touched; }
};

/// Largest error added by an advised change that counts as none: as a share of the error before the change, and
/// absolute.
inline constexpr double kSameErrorShare = 0.02, kSameError = 5e-5;

/// Measures proposed setting changes and ranks them. First come changes that save time without error, then those that
/// save time for error, then fewer wrong pixels, then less memory, last rejected ones. Ideas with equal settings are
/// measured once.
/// @param report receives the share done, 0..1, and the change being measured; may throw Cancelled
std::vector<TriedAdvice> measure_ideas(const Settings& settings, std::vector<AdviceIdea> ideas,
                                       const AdviceMeter& meter,
                                       const std::function<void(double, const std::string&)>& report = {});

/// Severity of a finding, the worst first.
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
/// Lists the problems of a frame, the worst first: warnings of the renderer, limits of the maps, wrong pixels by cause.
/// Each cause comes with the fix that cures most of its pixels, among fixes that cure more pixels than they break.
/// Draws nothing.
std::vector<Finding> list_findings(const AdviceFacts& facts, const FixTable& fixes);

/// Options of a search for advice: metric of the error, kind of timed frames, and whether fixes are measured.
struct AdviceOptions {
    const Metric* error = &metrics().front();  ///< metric to compare; not Better::Neither
    CostCase cost = kDefaultCost;              ///< kind of frames that are timed
    bool fixes = true;                         ///< draws and measures fixes for the findings
};

/// Result of a search for advice: measured setting changes, ranked, and problems found in the frame.
struct AdviceReport {
    AdviceFacts facts;
    std::vector<TriedAdvice> holds;  ///< changes with a confirmed claim, the best first
    std::vector<TriedAdvice> fails;  ///< changes with a rejected claim
    std::vector<Finding> findings;
    AdviceOptions options;
    MeasuredSettings before;  ///< present settings
    TimeMeasurement time;     ///< frame time of the present settings
};

/// Makes an advice meter that draws and times frames with a renderer. The arguments must outlive the meter.
/// @param width, height of the picture in pixels
AdviceMeter renderer_advice_meter(Renderer& renderer, const Scene& scene, int width, int height,
                                  const AdviceOptions& options, ReferenceCache& cache, const Workers& workers);

/// Searches for advice: takes measurements of the frame, lets the rules propose setting changes, measures and ranks
/// them, and lists problems with fixes. Call on the renderer's thread.
/// @param width, height of the picture in pixels
/// @param report receives the share done, 0..1, and the present step
/// @throws Cancelled; Error when there is no light to compare
AdviceReport find_advice(Renderer& renderer, const Scene& scene, const Settings& settings, int width, int height,
                         const AdviceOptions& options, ReferenceCache& cache, const Workers& workers = {},
                         const std::function<void(double, const std::string&)>& report = {});

}  // namespace si
