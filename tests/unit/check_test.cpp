// Tests of the limits of `check`: parsing, decisions, baselines and JUnit reports.
#include "app/report/check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "app/report/measure_json.h"
#include "renderer/base/error.h"
#include "tests/support/error_text.h"
#include "tests/support/strict_xml.h"

namespace si {
namespace {

/// Makes the errors of a picture. @param acne, edges wrong pixels of these causes
ErrorMetrics checked_metrics(std::size_t counted, std::size_t acne, std::size_t edges, double mae) {
    ErrorMetrics m;
    m.counted = counted;
    m.pixels[std::size_t(PixelState::Counted)] = counted;
    m.artefacts[std::size_t(Artefact::Acne)] = acne;
    m.artefacts[std::size_t(Artefact::EdgeAliasing)] = edges;
    m.false_shadow = counted > 0 ? double(acne) / double(counted) : 0;
    m.false_light = counted > 0 ? double(edges) / double(counted) : 0;
    m.mae = mae;
    m.signed_mean = -mae;
    return m;
}

const Metric& checked_mae() {
    return checked_error("");
}

CheckedPicture checked_picture() {
    return {.width = 64, .height = 36, .driver = "a driver", .meaning = kErrorMeaning};
}

CheckBaseline checked_baseline(const ErrorMetrics& m) {
    return {.file = "base.json", .picture = checked_picture(), .numbers = checked_numbers(m, checked_mae())};
}

TEST(CheckLimits, PixelsAndPercentagesAreParsed) {
    const PixelLimit pixels = parse_pixel_limit("20", "--max-acne");
    EXPECT_EQ(pixels.unit, PixelUnit::Pixels);
    EXPECT_EQ(pixels.amount, 20);
    const PixelLimit percent = parse_pixel_limit("0.1%", "--max-acne");
    EXPECT_EQ(percent.unit, PixelUnit::Percent);
    EXPECT_EQ(percent.amount, 0.1);
    for (const char* good : {"0", "0%", "100%", "1e-3%", "999999999"})
        EXPECT_NO_THROW(parse_pixel_limit(good, "--max-acne")) << good;
    for (const char* bad : {"",
                            "%",
                            "-1",
                            "-1%",
                            "-0%",
                            "+1",
                            "1.5",
                            "100.1%",
                            "nan%",
                            "inf%",
                            "nan",
                            "0,1%",
                            "0.1 %",
                            " 1",
                            "1 ",
                            "1%%",
                            "0x10",
                            "ten",
                            "1e3",
                            "99999999999999999999",
                            "10000000000000",
                            "0.1%\n"})
        EXPECT_THROW(parse_pixel_limit(bad, "--max-acne"), UsageError) << bad;
}

TEST(CheckLimits, APercentageIsOfTheComparedPixels) {
    EXPECT_EQ(allowed_pixels({20, PixelUnit::Pixels}, 10), 20u);
    EXPECT_EQ(allowed_pixels({0, PixelUnit::Percent}, 1000), 0u);
    EXPECT_EQ(allowed_pixels({100, PixelUnit::Percent}, 1000), 1000u);
    EXPECT_EQ(allowed_pixels({0.1, PixelUnit::Percent}, 1999), 1u);
    // Whole shares of whole numbers, which products of doubles may miss by rounding.
    for (std::size_t tenths = 1; tenths <= 1000; ++tenths)
        for (const std::size_t compared : {1000u, 3000u, 230'000u})
            ASSERT_EQ(allowed_pixels({double(tenths) / 10, PixelUnit::Percent}, compared), tenths * compared / 1000)
                << tenths << " of " << compared;
}

TEST(CheckLimits, ALimitIsKeptUpToItsValue) {
    const ErrorMetrics m = checked_metrics(1000, 5, 7, 0.25);
    const auto passed = [&](const CheckLimits& limits) {
        const auto findings = check_findings(m, limits, nullptr);
        EXPECT_EQ(findings.size(), 1u);
        return findings.at(0).passed && all_passed(findings);
    };
    const Metric* mae = &checked_mae();
    EXPECT_TRUE(passed({.acne = PixelLimit{5}, .metric = mae}));
    EXPECT_FALSE(passed({.acne = PixelLimit{4}, .metric = mae}));
    EXPECT_TRUE(passed({.acne = PixelLimit{0.5, PixelUnit::Percent}, .metric = mae}));
    EXPECT_FALSE(passed({.acne = PixelLimit{0.49, PixelUnit::Percent}, .metric = mae}));
    EXPECT_TRUE(passed({.wrong = PixelLimit{12}, .metric = mae}));
    EXPECT_FALSE(passed({.wrong = PixelLimit{11}, .metric = mae}));
    EXPECT_TRUE(passed({.wrong = PixelLimit{1.2, PixelUnit::Percent}, .metric = mae}));
    EXPECT_TRUE(passed({.error = 0.25, .metric = mae}));
    EXPECT_FALSE(passed({.error = 0.2499, .metric = mae}));
    // The amount of a signed error, and the distance from 1 of one that is best at 1.
    EXPECT_FALSE(passed({.error = 0.2, .metric = &checked_error("signed_mean")}));
    EXPECT_TRUE(passed({.error = 0, .metric = &checked_error("iou")}));
}

TEST(CheckLimits, EveryErrorOfZeroToOneCanBeLimited) {
    EXPECT_EQ(checked_mae().key, "mae");
    for (const std::string_view key : checked_errors()) EXPECT_NE(find_metric(key)->unit, "px") << key;
    EXPECT_THROW(checked_error("boundary_px_max"), UsageError);
    EXPECT_THROW(checked_error("within_noise"), UsageError);
    EXPECT_THROW(checked_error("prettiness"), UsageError);
}

TEST(CheckLimits, APictureWithoutComparedPixelsPassesNothing) {
    EXPECT_THROW(checked_numbers(checked_metrics(0, 0, 0, 0), checked_mae()), Error);
    EXPECT_THROW(checked_numbers(checked_metrics(9, 0, 0, NAN), checked_mae()), Error);
    EXPECT_THROW(checked_numbers(checked_metrics(9, 0, 0, 0), checked_error("flip")), Error);
}

TEST(CheckBaselines, ReadBackAsTheyAreWritten) {
    ErrorMetrics m = checked_metrics(193'113, 17, 1234, 0.1 + 0.2);
    m.false_shadow = 17.0 / 193'113;
    CheckedPicture picture = checked_picture();
    picture.area = true;
    picture.light = 3;
    picture.driver = "Mesa, \"llvmpipe\" (\xc3\xa9), 4.5";
    const std::string text = check_baseline_json("boxes", picture, m, 0.001).dump(2);
    const CheckBaseline read = parse_check_baseline(text, "base.json", checked_mae());
    EXPECT_EQ(read.picture.width, 64);
    EXPECT_EQ(read.picture.height, 36);
    EXPECT_EQ(read.picture.light, 3);
    EXPECT_TRUE(read.picture.area);
    EXPECT_EQ(read.picture.driver, picture.driver);
    EXPECT_EQ(read.picture.meaning, kErrorMeaning);
    EXPECT_EQ(read.numbers.compared, 193'113u);
    EXPECT_EQ(read.numbers.acne, 17u);
    EXPECT_EQ(read.numbers.wrong, 1251u);
    EXPECT_EQ(read.numbers.error, 0.1 + 0.2);
    EXPECT_TRUE(require_same_conditions(read, picture, false).empty());
    EXPECT_TRUE(all_passed(check_findings(m, {.metric = &checked_mae()}, &read)));
}

TEST(CheckBaselines, BrokenOnesAreRefusedWithFileAndPlace) {
    const Json good = check_baseline_json("boxes", checked_picture(), checked_metrics(1000, 1, 2, 0.1), 0);
    const auto refused = [&](const std::function<void(Json&)>& change) {
        Json json = good;
        change(json);
        return test::error_text([&] { parse_check_baseline(json.dump(), "base.json", checked_mae()); });
    };
    EXPECT_EQ(refused([](Json&) {}), "");
    const std::string again = "; write the baseline again (--write-baseline)";
    EXPECT_EQ(refused([](Json& j) { j["format"] = "else"; }),
              "base.json: is no baseline of `check`; write one with --write-baseline");
    EXPECT_EQ(refused([](Json& j) { j = Json::array(); }),
              "base.json: is no baseline of `check`; write one with --write-baseline");
    EXPECT_EQ(refused([](Json& j) { j["version"] = 2; }),
              "base.json: has version 2, and this program reads version 1" + again);
    EXPECT_EQ(refused([](Json& j) { j.erase("driver"); }), "base.json: driver is missing" + again);
    EXPECT_EQ(refused([](Json& j) { j["driver"] = 4; }), "base.json: driver: 4 is not a text" + again);
    EXPECT_EQ(refused([](Json& j) { j["error"].erase("meaning"); }), "base.json: error.meaning is missing" + again);
    EXPECT_EQ(refused([](Json& j) { j["error"] = nullptr; }), "base.json: error: null is not an object" + again);
    EXPECT_EQ(refused([](Json& j) { j["width"] = -1; }),
              "base.json: width: -1 is not a number from 0 to 1.04858e+06" + again);
    EXPECT_EQ(refused([](Json& j) { j["width"] = 1.5; }), "base.json: width: 1.5 is not a whole number" + again);
    EXPECT_EQ(refused([](Json& j) { j["area"] = 1; }), "base.json: area: 1 is not true or false" + again);
    EXPECT_EQ(refused([](Json& j) { j["error"]["pixels"]["counted"] = 1e300; }),
              "base.json: error.pixels.counted: 1e+300 is not a number from 0 to 1e+12" + again);
    EXPECT_EQ(refused([](Json& j) { j["error"]["artefacts"]["acne"] = -5; }),
              "base.json: error.artefacts.acne: -5 is not a number from 0 to 1e+12" + again);
    EXPECT_EQ(refused([](Json& j) { j["error"]["mae"] = nullptr; }),
              "base.json: error.mae: null is not a number from -1 to 1" + again);
    EXPECT_EQ(refused([](Json& j) { j["error"]["false_light"] = 7; }),
              "base.json: error.false_light: 7 is not a number from 0 to 1" + again);
    EXPECT_NE(refused([](Json& j) { j["error"]["pixels"]["counted"] = 0; }).find("base.json: no pixel"),
              std::string::npos);
    for (const char* text : {"", "{", "null", "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[", "{} {}"})
        EXPECT_NE(test::error_text([&] { parse_check_baseline(text, "base.json", checked_mae()); }).find("base.json"),
                  std::string::npos)
            << text;
}

TEST(CheckBaselines, OtherCircumstancesForbidAComparison) {
    const CheckBaseline base = checked_baseline(checked_metrics(1000, 1, 2, 0.1));
    const auto compared = [&](const std::function<void(CheckedPicture&)>& change, bool tolerant) {
        CheckedPicture picture = checked_picture();
        change(picture);
        std::vector<std::string> remarks;
        const std::string error = test::error_text([&] { remarks = require_same_conditions(base, picture, tolerant); });
        return error.empty() ? std::to_string(remarks.size()) + " remarks" : error;
    };
    EXPECT_EQ(compared([](auto&) {}, false), "0 remarks");
    const auto driver = [](CheckedPicture& p) { p.driver = "another"; };
    const auto meaning = [](CheckedPicture& p) { p.meaning = 99; };
    EXPECT_NE(compared(driver, false)
                  .find("base.json: was measured with the driver \"a driver\", and this is "
                        "\"another\"; write a baseline with this driver"),
              std::string::npos);
    EXPECT_NE(compared(meaning, false).find("base.json: its errors have meaning 4, and this program's have 99"),
              std::string::npos);
    EXPECT_EQ(compared(driver, true), "1 remarks");
    EXPECT_EQ(compared(meaning, true), "1 remarks");
    for (const bool tolerant : {false, true}) {
        EXPECT_NE(compared([](auto& p) { p.width = 65; }, tolerant).find("pass --size 64x36"), std::string::npos);
        EXPECT_NE(compared([](auto& p) { p.light = 1; }, tolerant).find("view.light=0"), std::string::npos);
        EXPECT_NE(compared([](auto& p) { p.area = true; }, tolerant).find("leave out --area"), std::string::npos);
    }
}

TEST(CheckBaselines, AreExceededByMoreThanTheToleranceAlone) {
    const CheckBaseline base = checked_baseline(checked_metrics(1000, 5, 7, 0.1));
    const auto exceeded = [&](const ErrorMetrics& m, const CheckLimits& limits) {
        std::string out;
        for (const CheckFinding& f : check_findings(m, limits, &base))
            if (!f.passed) out += f.check + " ";
        return out;
    };
    const Metric* mae = &checked_mae();
    EXPECT_EQ(exceeded(checked_metrics(1000, 5, 7, 0.1), {.metric = mae}), "");
    EXPECT_EQ(exceeded(checked_metrics(1000, 0, 0, 0), {.metric = mae}), "");
    EXPECT_EQ(exceeded(checked_metrics(1000, 6, 6, 0.1), {.metric = mae}), "baseline-acne ");
    EXPECT_EQ(exceeded(checked_metrics(1000, 5, 8, 0.1), {.metric = mae}), "baseline-wrong ");
    EXPECT_EQ(exceeded(checked_metrics(1000, 5, 7, 0.1001), {.metric = mae}), "baseline-error ");
    const CheckLimits tolerant{.metric = mae, .tolerance = PixelLimit{0.2, PixelUnit::Percent}};
    EXPECT_EQ(exceeded(checked_metrics(1000, 7, 7, 0.1019), tolerant), "");
    EXPECT_EQ(exceeded(checked_metrics(1000, 8, 7, 0.1021), tolerant), "baseline-acne baseline-wrong baseline-error ");
}

TEST(CheckJunit, CountsCasesAndHoldsHostileNames) {
    const ErrorMetrics m = checked_metrics(1000, 5, 7, 0.25);
    const CheckLimits limits{.acne = PixelLimit{9}, .wrong = PixelLimit{9}, .error = 0.1, .metric = &checked_mae()};
    for (const std::string& scene :
         {std::string("boxes"), std::string("a\"/><failure>&amp;]]><!-- .glb"), std::string("b\x01\n\x7f\xff\xfe.glb"),
          std::string("c\xef\xbf\xbf\xe2\x80\xae.glb"), std::string("d\0e", 3)}) {
        const std::string xml = check_junit(scene, scene, check_findings(m, limits, nullptr), 1.5);
        EXPECT_EQ(test::xml_fault(xml), "") << xml;
        EXPECT_TRUE(is_check_junit(xml));
        EXPECT_NE(xml.find("tests=\"3\" failures=\"2\" errors=\"0\" time=\"1.500\""), std::string::npos) << xml;
        std::size_t failures = 0;
        for (std::size_t at = 0; (at = xml.find("<failure ", at)) != xml.npos; ++at) ++failures;
        EXPECT_EQ(failures, 2u) << xml;
        const std::string broken = check_junit_error(scene, "it \"cannot\" <be> opened\n" + scene);
        EXPECT_EQ(test::xml_fault(broken), "") << broken;
        EXPECT_TRUE(is_check_junit(broken));
        EXPECT_NE(broken.find("tests=\"1\" failures=\"0\" errors=\"1\""), std::string::npos) << broken;
    }
    EXPECT_FALSE(is_check_junit("{\"asset\": {}}"));
    EXPECT_FALSE(is_check_junit("<testsuites name=\"another\">"));
    EXPECT_FALSE(is_check_junit(""));
}

}  // namespace
}  // namespace si
