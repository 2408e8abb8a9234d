// The scene advises: changes of settings that its facts call for, each measured with truth and clock before it is
// shown.
//
//     AdviceReport report = find_advice(renderer, scene, settings, 1280, 720, {}, cache);
//     report.holds.front().idea.sentence, report.holds.front().settings    // set them, measure: exactly so
#pragma once

#include "renderer/advise/advice_facts.h"
#include "renderer/measure/measure.h"

namespace si {

/// What an idea says of itself, and is held to.
enum class Claim {
    Same,   ///< nothing is lost, and there is less to do
    Right,  ///< fewer pixels are wrong
    Trade,  ///< time is saved, for so much error
};

struct AdviceIdea {
    std::string_view rule;  ///< key of its row
    Claim claim = Claim::Same;
    std::string sentence;  ///< why, with the numbers that say so
    Settings settings;     ///< with the change
    int light = 0;         ///< about which the error is judged
};

/// When something is worth trying, and what it changes.
struct AdviceRule {
    std::string_view key, label;
    std::string_view help;  ///< when; a sentence
    Claim claim = Claim::Same;
    using Offer = std::function<void(std::string sentence, Settings settings, int light)>;
    void (*look)(const Settings& settings, const AdviceFacts& facts, const Offer& offer) = nullptr;
};
std::span<const AdviceRule> advice_rules();

/// What the rules find. Ideas that change nothing, or the same as an earlier one of their claim, are left out. Pure.
std::vector<AdviceIdea> advice_ideas(const Settings& settings, const AdviceFacts& facts);

/// Settings as they were measured.
struct MeasuredSettings {
    double error = 0;  ///< shortfall() of the metric
    double noise = 0;  ///< of the truth
    WorkCost work;
    Camera camera;
};

/// What measures: the renderer's (find_advice()), or a test's own.
struct AdviceMeter {
    std::function<MeasuredSettings(const Settings&, int light)> judge;
    /// Milliseconds a frame that the second takes more than the first, by alternating rounds.
    std::function<CostChange(const Settings& before, const Settings& with)> time;
};

/// An idea that was measured.
struct TriedAdvice {
    AdviceIdea idea;
    std::vector<std::pair<std::string, std::string>> settings;  ///< key and value of what changes
    MeasuredSettings before, after;
    CostChange ms;        ///< after - before
    std::string why_not;  ///< why it does not hold; empty: it does
    double added_error() const { return after.error - before.error; }
    /// Error that it may add and still be called the same.
    double tolerance() const;
    long long more_bytes() const { return (long long)after.work.bytes_touched - (long long)before.work.bytes_touched; }
};

/// Error that counts as none, as a share of what there was, and of visibility.
inline constexpr double kSameErrorShare = 0.02, kSameError = 5e-5;

/// Measures each idea once (of those that change the same the first that holds is taken), and ranks: those that lose
/// nothing and save time by what they save, then by milliseconds saved per error added, then those that put pixels
/// right, then those that save memory alone; last what does not hold.
/// @param report hears of the share done and what is tried; may throw Cancelled
std::vector<TriedAdvice> measure_ideas(const Settings& settings, std::vector<AdviceIdea> ideas,
                                       const AdviceMeter& meter,
                                       const std::function<void(double, const std::string&)>& report = {});

enum class Severity { Error, Warning, Hint };
std::string_view severity_key(Severity severity);

/// What is wrong by rule, whether or not anybody advises on it.
struct Finding {
    Severity severity = Severity::Hint;
    std::string text;                                           ///< a sentence
    std::string fix;                                            ///< what helps; empty: nothing known
    std::vector<std::pair<std::string, std::string>> settings;  ///< that do
};
/// Returns remarks of the renderer, limits of the maps, and wrong pixels by cause, the worst first. A cause comes with
/// the fix that puts most of its pixels right, among fixes that put more pixels right in all than they break. Pure.
std::vector<Finding> list_findings(const AdviceFacts& facts, const FixTable& fixes);

struct AdviceOptions {
    const Metric* error = &metrics().front();  ///< one that has a better
    CostCase cost = kDefaultCost;
    bool fixes = true;  ///< findings come with cures, which are drawn and judged
};

struct AdviceReport {
    AdviceFacts facts;
    std::vector<TriedAdvice> holds, fails;  ///< ranked; fails: tried, does not hold
    std::vector<Finding> findings;
    AdviceOptions options;
    MeasuredSettings before;
    TimeMeasurement time;  ///< of the present settings
};

/// Measures as the renderer draws. Lives as long as what it is given.
AdviceMeter renderer_advice_meter(Renderer& renderer, const Scene& scene, int width, int height,
                                  const AdviceOptions& options, ReferenceCache& cache, const Workers& workers);

/// On the renderer's thread. @throws Cancelled; Error when there is no light to judge
AdviceReport find_advice(Renderer& renderer, const Scene& scene, const Settings& settings, int width, int height,
                         const AdviceOptions& options, ReferenceCache& cache, const Workers& workers = {},
                         const std::function<void(double, const std::string&)>& report = {});

}  // namespace si
