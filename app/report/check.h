// Limits on the errors of a picture, and whether it keeps them (command `check`).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/json_text.h"
#include "renderer/reference/metrics.h"

namespace si {

/// Unit of a limit on pixels.
enum class PixelUnit {
    Pixels,
    Percent,  ///< of the compared pixels
};

/// Limit on a number of pixels: 20, or 0.1 % of the compared pixels.
struct PixelLimit {
    double amount = 0;
    PixelUnit unit = PixelUnit::Pixels;
};

/// Parses a limit on pixels, "20" or "0.1%". @param option name of the option, for the message @throws UsageError
PixelLimit parse_pixel_limit(const std::string& text, std::string_view option);

/// Returns the largest number of pixels that a limit allows. @param compared pixels of the picture that are compared,
/// of which a limit in percent is a share
std::size_t allowed_pixels(const PixelLimit& limit, std::size_t compared);

/// Limits of one run of `check`. Numbers are those of `measure`.
struct CheckLimits {
    std::optional<PixelLimit> acne;       ///< pixels whose cause is acne
    std::optional<PixelLimit> wrong;      ///< pixels of false shadow and false light, whatever the cause
    std::optional<double> error;          ///< distance of `metric` from its best value
    const Metric* metric = nullptr;       ///< error of `error` and of the baseline
    std::optional<PixelLimit> tolerance;  ///< by which a baseline may be exceeded; none: 0, from the same driver only
};

/// Returns the keys of the errors that `check` can limit: those of 0 to 1.
std::vector<std::string_view> checked_errors();
/// Finds a metric that `check` can limit. @param key empty: the first one @throws UsageError listing the known keys
const Metric& checked_error(const std::string& key);

/// Numbers of a picture that `check` limits.
struct CheckedNumbers {
    std::size_t compared = 0;  ///< pixels
    std::size_t acne = 0;      ///< pixels whose cause is acne
    std::size_t wrong = 0;     ///< pixels of false shadow and false light
    double error = 0;          ///< distance of the metric from its best value
};

/// Returns the numbers that `check` limits. @throws Error where no pixel is compared, or the metric has no value
CheckedNumbers checked_numbers(const ErrorMetrics& error, const Metric& metric);

/// Circumstances of a picture, without which its numbers cannot be compared with others.
struct CheckedPicture {
    int width = 0, height = 0;  ///< pixels
    int light = 0;              ///< view.light
    bool area = false;          ///< the reference is of an area light
    std::string driver;         ///< vendor, renderer and version
    int meaning = 0;            ///< kErrorMeaning
};

/// Numbers of an earlier `check`, which a later one may not exceed.
struct CheckBaseline {
    std::string file;
    CheckedPicture picture;
    CheckedNumbers numbers;
};

/// Makes the file of a baseline. @param scene name of the scene, for people
nlohmann::ordered_json check_baseline_json(const std::string& scene, const CheckedPicture& picture,
                                           const ErrorMetrics& error, double noise);
/// Reads the file of a baseline. @throws Error "FILE: what is wrong; what to do"
CheckBaseline parse_check_baseline(std::string_view text, const std::string& file, const Metric& metric);

/// Compares the circumstances of a baseline with those of a picture. @param tolerant another driver and another meaning
/// are remarks @returns the remarks @throws Error naming the first difference that forbids a comparison
std::vector<std::string> compare_circumstances(const CheckBaseline& baseline, const CheckedPicture& picture,
                                               bool tolerant);

/// Limit of a run beside the number that was measured.
struct CheckFinding {
    std::string check;       ///< "max-acne", or "baseline-acne" for a limit by the baseline
    std::string_view field;  ///< of the number: "acne_px", "wrong_px" or the key of the error
    double value = 0;
    double limit = 0;
    bool passed = false;
    std::string text;  ///< one line for people
};

/// Compares a picture's shadow errors with all limits. @param baseline numbers of an earlier check, which are limits
/// too; null: none
std::vector<CheckFinding> check_findings(const ErrorMetrics& error, const CheckLimits& limits,
                                         const CheckBaseline* baseline);

/// Returns true when every limit is kept.
bool all_passed(const std::vector<CheckFinding>& findings);

/// Converts findings to JSON, an array with a member a limit.
nlohmann::ordered_json check_findings_json(const std::vector<CheckFinding>& findings);

/// Formats findings as a JUnit report of one suite, with a test case for each limit.
/// @param scene name of the suite @param driver for the properties of the suite @param seconds time of the run
std::string check_junit(const std::string& scene, const std::string& driver, const std::vector<CheckFinding>& findings,
                        double seconds);
/// Formats a JUnit report of a suite that could not be checked. @param message the reason
std::string check_junit_error(const std::string& scene, const std::string& message);
/// Returns true for the beginning of a report that check_junit() or check_junit_error() made.
bool is_check_junit(std::string_view text);

}  // namespace si
