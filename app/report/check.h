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

/// Unit of a limit on wrong pixels: a number, or a percentage of the compared pixels.
enum class PixelUnit {
    Pixels,
    Percent,  ///< of the compared pixels
};

/// Upper limit on a number of wrong pixels for the command `check`, such as 20 pixels or 0.1 % of the compared pixels.
struct PixelLimit {
    double amount = 0;
    PixelUnit unit = PixelUnit::Pixels;
};

/// Parses an upper limit on wrong pixels, "20" or "0.1%". @param option name of the command-line option, for the error
/// message @throws UsageError
PixelLimit parse_pixel_limit(const std::string& text, std::string_view option);

/// Converts a limit to the largest allowed number of wrong pixels. @param compared number of pixels compared with the
/// reference; a limit in percent is a share of them
std::size_t allowed_pixels(const PixelLimit& limit, std::size_t compared);

/// Limits on shadow errors for one run of the command `check`, which measures errors as the command `measure` does.
struct CheckLimits {
    std::optional<PixelLimit> acne;       ///< pixels whose cause is acne
    std::optional<PixelLimit> wrong;      ///< pixels of false shadow and false light, whatever the cause
    std::optional<double> error;          ///< largest distance of `metric` from its best value
    const Metric* metric = nullptr;       ///< metric that `error` and the baseline limit
    std::optional<PixelLimit> tolerance;  ///< allowed excess over the baseline; none: 0, and for the same driver only
};

/// Returns the keys of the error metrics that the command `check` can limit: those whose distance from the best value
/// (0, or 1 where more is better) is at most 1.
std::vector<std::string_view> checked_errors();
/// Finds an error metric that the command `check` can limit. @param key key of the metric; empty: the first of
/// checked_errors() @throws UsageError listing the known keys
const Metric& checked_error(const std::string& key);

/// Shadow errors of one picture, as the command `check` compares them with limits.
struct CheckedNumbers {
    std::size_t compared = 0;  ///< pixels compared with the reference
    std::size_t acne = 0;      ///< pixels whose cause is acne
    std::size_t wrong = 0;     ///< pixels of false shadow and false light
    double error = 0;          ///< distance of the metric from its best value
};

/// Selects the errors of a picture that the command `check` compares with limits. @param metric metric whose distance
/// from its best value becomes CheckedNumbers::error @throws Error if no pixel could be compared, or the metric has no
/// value
CheckedNumbers checked_numbers(const ErrorMetrics& error, const Metric& metric);

/// Conditions under which a picture's shadow errors were measured: size, light, reference and driver. Errors measured
/// under different conditions cannot be compared.
struct CheckedPicture {
    int width = 0, height = 0;  ///< pixels
    int light = 0;              ///< view.light
    bool area = false;          ///< the reference is traced for an area light
    std::string driver;         ///< vendor, renderer and version
    int meaning = 0;            ///< version of the definitions of errors (kErrorMeaning)
};

/// Baseline of the command `check`: shadow errors of an earlier run, which a later run may not exceed.
struct CheckBaseline {
    std::string file;
    CheckedPicture picture;
    CheckedNumbers numbers;
};

/// Converts the shadow errors of a picture to the JSON of a baseline file. A later run of `check` with this file fails
/// if its errors are larger than those in the file.
/// @param scene name of the scene, for people @param noise noise of the ray-traced reference
nlohmann::ordered_json check_baseline_json(const std::string& scene, const CheckedPicture& picture,
                                           const ErrorMetrics& error, double noise);
/// Parses a baseline file: shadow errors of an earlier run, which a later run of `check` may not exceed.
/// @param file name of the file, for messages @param metric metric of CheckedNumbers::error
/// @throws Error "FILE: what is wrong; what to do"
CheckBaseline parse_check_baseline(std::string_view text, const std::string& file, const Metric& metric);

/// Checks that the conditions of a baseline (size, light, reference, driver) equal those of a picture, so that their
/// errors can be compared. Returns remarks for the user.
/// @param tolerant true: another driver or another version of the error definitions becomes a remark
/// @throws Error naming the first difference that forbids a comparison
std::vector<std::string> require_same_conditions(const CheckBaseline& baseline, const CheckedPicture& picture,
                                                 bool tolerant);

/// Result of one limit of the command `check`: the limit, the measured number, and whether the limit is kept.
struct CheckFinding {
    std::string check;       ///< "max-acne", or "baseline-acne" for a limit by the baseline
    std::string_view field;  ///< name of the number: "acne_px", "wrong_px" or the key of the error
    double value = 0;
    double limit = 0;
    bool passed = false;
    std::string text;  ///< one line for people
};

/// Compares the shadow errors of a picture with all limits of the command `check`. Returns one finding per limit.
/// @param baseline errors of an earlier run, which are limits too; null: none
std::vector<CheckFinding> check_findings(const ErrorMetrics& error, const CheckLimits& limits,
                                         const CheckBaseline* baseline);

/// Returns true when the picture keeps every limit of the command `check`.
bool all_passed(const std::vector<CheckFinding>& findings);

/// Converts the findings of the command `check` to a JSON array with one object per limit.
nlohmann::ordered_json check_findings_json(const std::vector<CheckFinding>& findings);

/// Formats the findings of the command `check` as a JUnit report (XML) for continuous integration. The report is one
/// suite with a test case per limit.
/// @param scene name of the suite @param driver OpenGL driver, a property of the suite @param seconds duration of the
/// run
std::string check_junit(const std::string& scene, const std::string& driver, const std::vector<CheckFinding>& findings,
                        double seconds);
/// Formats a JUnit report (XML) of a picture that the command `check` could not measure. @param scene name of the suite
/// @param message the reason
std::string check_junit_error(const std::string& scene, const std::string& message);
/// Returns true if a text begins like a JUnit report of check_junit() or check_junit_error(). Used before a file is
/// overwritten.
bool is_check_junit(std::string_view text);

}  // namespace si
