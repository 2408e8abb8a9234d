#include "app/report/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "app/report/measure_json.h"
#include "app/report/xml_text.h"
#include "renderer/base/error.h"
#include "renderer/reference/artefact_picture.h"

namespace si {
namespace {

constexpr std::string_view kBaselineFormat = "shadow-inspector-check-baseline";
constexpr int kBaselineVersion = 1;
constexpr std::string_view kJunitBegin = "<testsuites name=\"shadow-inspector check\"";
/// Largest number of pixels that a baseline may state. Sums of two such counts are exact as double.
constexpr double kMaxBaselinePixels = 1e12;

/// Formats a share of pixels for people: "0.4132 %".
std::string percent(double part, std::size_t whole) {
    return fmt::format("{:.4f} %", 100 * part / double(whole));
}

/// Formats the causes of wrong pixels: " (acne 120, edge aliasing 7)"; empty: none is wrong.
std::string causes_text(const ErrorMetrics& error) {
    std::string out;
    for (const ArtefactStyle& style : artefact_styles())
        if (const std::size_t pixels = error.artefacts[std::size_t(style.artefact)]; pixels > 0)
            out += fmt::format("{}{} {}", out.empty() ? " (" : ", ", style.label, pixels);
    return out.empty() ? out : out + ")";
}

/// Formats a limit as it was given: "20 pixels", "0.1 % (193 pixels)".
std::string limit_text(const PixelLimit& limit, std::size_t compared) {
    const std::size_t pixels = allowed_pixels(limit, compared);
    return limit.unit == PixelUnit::Percent ? fmt::format("{} % ({} pixels)", limit.amount, pixels)
                                            : fmt::format("{} pixels", pixels);
}

CheckFinding pixel_finding(std::string check, std::string_view field, std::size_t value, std::size_t limit,
                           std::size_t compared, const std::string& causes, const std::string& at_most) {
    const bool passed = value <= limit;
    std::string text =
        fmt::format("{}: {} {}: {} pixels, {} of those compared; at most {}{}", passed ? "passed" : "exceeded", check,
                    field, value, percent(double(value), compared), at_most, causes);
    return {std::move(check), field, double(value), double(limit), passed, std::move(text)};
}

CheckFinding error_finding(std::string check, const Metric& metric, double value, double limit,
                           const std::string& at_most) {
    const bool passed = value <= limit;
    std::string text =
        fmt::format("{}: {} {}: {:.6f}; at most {}", passed ? "passed" : "exceeded", check, metric.key, value, at_most);
    return {std::move(check), metric.key, value, limit, passed, std::move(text)};
}

/// Reader of the members of a baseline. Each function throws an Error that names the file and the member.
class BaselineReader {
public:
    BaselineReader(const Json& json, const std::string& file, std::string prefix = {})
        : json_(json), file_(file), prefix_(std::move(prefix)) {}

    BaselineReader object(std::string_view name) const {
        const Json& value = member(name);
        if (!value.is_object()) fail(name, value, "an object");
        return {value, file_, prefix_ + std::string(name) + "."};
    }
    double number(std::string_view name, double min, double max) const {
        const Json& value = member(name);
        const double number = value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
        if (!(number >= min && number <= max)) fail(name, value, fmt::format("a number from {:g} to {:g}", min, max));
        return number;
    }
    double whole_number(std::string_view name, double max) const {
        const double value = number(name, 0, max);
        if (value != std::floor(value)) fail(name, member(name), "a whole number");
        return value;
    }
    bool boolean(std::string_view name) const {
        const Json& value = member(name);
        if (!value.is_boolean()) fail(name, value, "true or false");
        return value.get<bool>();
    }
    std::string text(std::string_view name) const {
        const Json& value = member(name);
        if (!value.is_string()) fail(name, value, "a text");
        return value.get<std::string>();
    }

private:
    const Json& json_;
    const std::string& file_;
    std::string prefix_;

    const Json& member(std::string_view name) const {
        const auto at = json_.find(name);
        if (at == json_.end())
            throw Error(
                fmt::format("{}: {}{} is missing; write the baseline again (--write-baseline)", file_, prefix_, name));
        return *at;
    }
    [[noreturn]] void fail(std::string_view name, const Json& value, const std::string& wanted) const {
        throw Error(fmt::format("{}: {}{}: {} is not {}; write the baseline again (--write-baseline)", file_, prefix_,
                                name, quoted(value), wanted));
    }
};

std::string junit_text(const std::string& scene, const std::string& driver, const std::string& cases, std::size_t tests,
                       std::size_t failures, std::size_t errors, double seconds) {
    const std::string counts =
        fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\"", tests, failures, errors, seconds);
    const std::string properties = driver.empty()
                                       ? ""
                                       : fmt::format(
                                             "    <properties>\n      <property name=\"driver\" value=\"{}\"/>\n"
                                             "    </properties>\n",
                                             xml_text(driver));
    return fmt::format("{0} {1}>\n  <testsuite name=\"{2}\" skipped=\"0\" {1}>\n{3}{4}  </testsuite>\n</testsuites>\n",
                       kJunitBegin, counts, xml_text(scene), properties, cases);
}

}  // namespace

PixelLimit parse_pixel_limit(const std::string& text, std::string_view option) {
    const bool percent = text.ends_with("%");
    const char* const begin = text.data();
    const char* const end = begin + text.size() - (percent ? 1 : 0);
    double share = 0;
    std::uint64_t pixels = 0;
    const auto read = percent ? std::from_chars(begin, end, share) : std::from_chars(begin, end, pixels);
    const bool whole = begin != end && read.ec == std::errc() && read.ptr == end;
    if (!whole || !(share >= 0 && share <= 100) || double(pixels) > kMaxBaselinePixels || std::signbit(share))
        throw UsageError(fmt::format(
            "{} \"{}\": must be a whole number of pixels, such as 20, or a percentage of the compared ones, such "
            "as 0.1%",
            option, text));
    return percent ? PixelLimit{share, PixelUnit::Percent} : PixelLimit{double(pixels), PixelUnit::Pixels};
}

std::size_t allowed_pixels(const PixelLimit& limit, std::size_t compared) {
    if (limit.unit == PixelUnit::Pixels) return std::size_t(limit.amount);
    // A product that is whole but for rounding counts as whole.
    return std::size_t(std::floor(limit.amount * double(compared) / 100 + 1e-6));
}

std::vector<std::string_view> checked_errors() {
    std::vector<std::string_view> keys;
    for (const Metric& metric : metrics())
        if (metric.member && metric.better != Better::Neither && metric.unit != "px") keys.push_back(metric.key);
    return keys;
}

const Metric& checked_error(const std::string& key) {
    const std::vector<std::string_view> keys = checked_errors();
    if (key.empty()) return *find_metric(keys.front());
    if (std::ranges::find(keys, key) != keys.end()) return *find_metric(key);
    throw UsageError(fmt::format("--error {}: it is one of {}", key, fmt::join(keys, ", ")));
}

CheckedNumbers checked_numbers(const ErrorMetrics& error, const Metric& metric) {
    if (error.counted == 0)
        throw Error(
            "no pixel can be compared with the reference: the camera sees no surface that faces view.light; choose "
            "another camera or light");
    const double distance = distance_from_best(metric.better, metric.value(error));
    if (!std::isfinite(distance))
        throw Error(fmt::format("the error {} has no value in this picture; choose another --error", metric.key));
    const double wrong = (error.false_shadow + error.false_light) * double(error.counted);
    return {error.counted, error.artefacts[std::size_t(Artefact::Acne)], std::size_t(std::llround(wrong)), distance};
}

Json check_baseline_json(const std::string& scene, const CheckedPicture& picture, const ErrorMetrics& error,
                         double noise) {
    return {{"format", kBaselineFormat}, {"version", kBaselineVersion}, {"scene", scene},
            {"width", picture.width},    {"height", picture.height},    {"light", picture.light},
            {"area", picture.area},      {"driver", picture.driver},    {"error", error_json(error, noise)}};
}

CheckBaseline parse_check_baseline(std::string_view text, const std::string& file, const Metric& metric) {
    const Json json = parse_json_text(text, file);
    if (!json.is_object() || json.value("format", Json()) != kBaselineFormat)
        throw Error(fmt::format("{}: is no baseline of `check`; write one with --write-baseline", file));
    const BaselineReader reader(json, file);
    if (const double version = reader.whole_number("version", 1e6); version != kBaselineVersion)
        throw Error(fmt::format(
            "{}: has version {}, and this program reads version {}; write the baseline again (--write-baseline)", file,
            version, kBaselineVersion));
    const BaselineReader error = reader.object("error");
    CheckBaseline out{.file = file};
    out.picture = {.width = int(reader.whole_number("width", 1 << 20)),
                   .height = int(reader.whole_number("height", 1 << 20)),
                   .light = int(reader.whole_number("light", 1 << 20)),
                   .area = reader.boolean("area"),
                   .driver = reader.text("driver"),
                   .meaning = int(error.whole_number("meaning", 1e6))};
    ErrorMetrics m;
    m.counted = std::size_t(error.object("pixels").whole_number("counted", kMaxBaselinePixels));
    m.artefacts[std::size_t(Artefact::Acne)] =
        std::size_t(error.object("artefacts").whole_number("acne", kMaxBaselinePixels));
    m.false_shadow = error.number("false_shadow", 0, 1);
    m.false_light = error.number("false_light", 0, 1);
    m.*metric.member = error.number(metric.key, -1, 1);
    try {
        out.numbers = checked_numbers(m, metric);
    } catch (const Error& e) {
        throw Error(fmt::format("{}: {}", file, e.what()));
    }
    return out;
}

std::vector<std::string> require_same_conditions(const CheckBaseline& baseline, const CheckedPicture& picture,
                                                 bool tolerant) {
    const std::string& file = baseline.file;
    const CheckedPicture& before = baseline.picture;
    if (before.width != picture.width || before.height != picture.height)
        throw Error(fmt::format("{}: is of a picture of {}x{}, and this one has {}x{}; pass --size {}x{}", file,
                                before.width, before.height, picture.width, picture.height, before.width,
                                before.height));
    if (before.light != picture.light)
        throw Error(fmt::format("{}: is of light {}, and this is light {}; pass --set view.light={}", file,
                                before.light, picture.light, before.light));
    if (before.area != picture.area)
        throw Error(fmt::format("{}: compares with {}, and this picture with {}; {}", file,
                                before.area ? "an area light" : "a hard reference",
                                picture.area ? "an area light" : "a hard reference",
                                before.area ? "pass --area" : "leave out --area"));
    std::vector<std::string> remarks;
    const auto differs = [&](const std::string& what, const std::string& other) {
        const std::string text = fmt::format("{}: {}", file, what);
        if (!tolerant) throw Error(fmt::format("{}; {}", text, other));
        remarks.push_back(text + "; compared within --tolerance");
    };
    if (before.meaning != picture.meaning)
        differs(fmt::format("its errors have meaning {}, and this program's have {}", before.meaning, picture.meaning),
                "write the baseline again (--write-baseline), or allow a difference (--tolerance 0.1%)");
    if (before.driver != picture.driver)
        differs(fmt::format("was measured with the driver \"{}\", and this is \"{}\"", before.driver, picture.driver),
                "write a baseline with this driver (--write-baseline), or allow a difference (--tolerance 0.1%)");
    return remarks;
}

std::vector<CheckFinding> check_findings(const ErrorMetrics& error, const CheckLimits& limits,
                                         const CheckBaseline* baseline) {
    const Metric& metric = *limits.metric;
    const CheckedNumbers now = checked_numbers(error, metric);
    const std::string causes = causes_text(error);
    std::vector<CheckFinding> out;
    const auto add_pixels = [&](const char* check, std::string_view field, std::size_t value,
                                const std::optional<PixelLimit>& limit, const std::string& remark) {
        if (limit)
            out.push_back(pixel_finding(check, field, value, allowed_pixels(*limit, now.compared), now.compared, remark,
                                        limit_text(*limit, now.compared)));
    };
    add_pixels("max-acne", "acne_px", now.acne, limits.acne, {});
    add_pixels("max-wrong", "wrong_px", now.wrong, limits.wrong, causes);
    if (limits.error)
        out.push_back(error_finding("max-error", metric, now.error, *limits.error, fmt::format("{}", *limits.error)));
    if (!baseline) return out;
    const CheckedNumbers& before = baseline->numbers;
    const std::size_t more = limits.tolerance ? allowed_pixels(*limits.tolerance, now.compared) : 0;
    const double more_error = limits.tolerance ? double(more) / double(now.compared) : 0;
    const std::string tolerated = more > 0 ? fmt::format(" and {} tolerated", more) : "";
    const auto add_baseline = [&](const char* check, std::string_view field, std::size_t value, std::size_t was,
                                  const std::string& remark) {
        out.push_back(pixel_finding(check, field, value, was + more, now.compared, remark,
                                    fmt::format("{} of the baseline{}", was, tolerated)));
    };
    add_baseline("baseline-acne", "acne_px", now.acne, before.acne, {});
    add_baseline("baseline-wrong", "wrong_px", now.wrong, before.wrong, causes);
    out.push_back(error_finding("baseline-error", metric, now.error, before.error + more_error,
                                fmt::format("{:.6f} of the baseline{}", before.error,
                                            more_error > 0 ? fmt::format(" and {:.6f} tolerated", more_error) : "")));
    return out;
}

bool all_passed(const std::vector<CheckFinding>& findings) {
    return std::ranges::all_of(findings, &CheckFinding::passed);
}

Json check_findings_json(const std::vector<CheckFinding>& findings) {
    return json_list(findings, [](const CheckFinding& f) -> Json {
        return {{"check", f.check}, {"field", f.field},   {"value", f.value},
                {"limit", f.limit}, {"passed", f.passed}, {"text", f.text}};
    });
}

std::string check_junit(const std::string& scene, const std::string& driver, const std::vector<CheckFinding>& findings,
                        double seconds) {
    std::string cases;
    std::size_t failures = 0;
    for (const CheckFinding& f : findings) {
        const std::string name =
            fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"0\"", xml_text(scene), xml_text(f.check));
        if (f.passed) {
            cases += name + "/>\n";
            continue;
        }
        ++failures;
        cases += fmt::format("{0}>\n      <failure type=\"limit\" message=\"{1}\">{1}</failure>\n    </testcase>\n",
                             name, xml_text(f.text));
    }
    return junit_text(scene, driver, cases, findings.size(), failures, 0, seconds);
}

std::string check_junit_error(const std::string& scene, const std::string& message) {
    const std::string cases = fmt::format(
        "    <testcase classname=\"{0}\" name=\"check\" time=\"0\">\n"
        "      <error type=\"not-checked\" message=\"{1}\">{1}</error>\n    </testcase>\n",
        xml_text(scene), xml_text(message));
    return junit_text(scene, {}, cases, 1, 0, 1, 0);
}

bool is_check_junit(std::string_view text) {
    return text.starts_with(kJunitBegin);
}

}  // namespace si
