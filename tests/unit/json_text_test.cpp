// Tests of foreign JSON: bounded, unambiguous, and read in time that grows with its length.
#include "app/base/json_text.h"

#include <gtest/gtest.h>

#include "app/session/presets.h"
#include "renderer/base/error.h"
#include "tests/support/error_text.h"

namespace si {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string refusal_of_text(const std::string& text) {
    return test::error_text([&] { parse_json_text(text, "a.json"); });
}

std::string nested(int levels) {
    return std::string(std::size_t(levels), '[') + std::string(std::size_t(levels), ']');
}

TEST(JsonText, MatchesTheLibrary) {
    const std::string text =
        R"( {"b":[1,-2,3.5,1e3,true,false,null,"\u00e4\n",{},[]],"a":{"z":{"y":[{"x":18446744073709551615}]},"c":0}} )";
    EXPECT_EQ(parse_json_text(text, "").dump(), OrderedJson::parse(text).dump());
    for (const char* plain : {"1", "\"a\"", "null", "[]", "{}", "\xef\xbb\xbf{}"})
        EXPECT_EQ(parse_json_text(plain, "").dump(), OrderedJson::parse(plain).dump()) << plain;
}

TEST(JsonText, DepthIsBounded) {
    EXPECT_EQ(refusal_of_text(nested(kMaxJsonDepth)), "");
    EXPECT_EQ(refusal_of_text(nested(kMaxJsonDepth + 1)), "a.json: it nests 33 levels deep, at most 32 are read");
    EXPECT_EQ(refusal_of_text(nested(1'000'000)), "a.json: it nests 1000000 levels deep, at most 32 are read");
    EXPECT_EQ(refusal_of_text("\"" + nested(40) + "\\\"[[\""), "") << "brackets in a text nest nothing";
}

TEST(JsonText, NothingMayFollowTheEnd) {
    EXPECT_EQ(refusal_of_text(std::string("{}\0{\"a\":1}", 10)), "a.json: line 1, column 3: not JSON: a NUL character");
    EXPECT_EQ(refusal_of_text(std::string("{}\n\0", 4)), "a.json: line 2, column 1: not JSON: a NUL character");
    for (const char* more : {"{}{}", "{}x", "[] 1", "1 2"})
        EXPECT_NE(refusal_of_text(more).find("not JSON"), std::string::npos) << more;
    EXPECT_EQ(refusal_of_text("{} \n"), "");
}

TEST(JsonText, DuplicatesAreNamedAtEveryLevel) {
    EXPECT_EQ(refusal_of_text(R"({"a":{"b":1},"c":[{"b":1,"d":2,"b":3}]})"), "a.json: \"b\" occurs twice; keep one");
    EXPECT_EQ(refusal_of_text(R"([{"a":1},{"a":1}])"), "");
}

// An object that compares every new member with all earlier ones would take minutes.
TEST(JsonText, TwoHundredThousandMembersAreReadQuickly) {
    std::string text = "{", settings;
    for (int i = 0; i < 200'000; ++i) text += (i ? ",\"k" : "\"k") + std::to_string(i) + "\":{}";
    text += "}";
    EXPECT_EQ(parse_json_text(text, "").size(), 200'000u);
    for (int i = 0; i < 50'000; ++i)
        settings += (i ? ",\"object.n" : "\"object.n") + std::to_string(i) + ".cast\":false";
    const Preset preset =
        parse_preset("{\"format\":\"shadow-inspector-preset\",\"version\":2,\"settings\":{" + settings + "}}", "p");
    EXPECT_EQ(preset.settings.objects.size(), 50'000u);
}

TEST(JsonText, QuotesAreShort) {
    const std::string quote = quoted(OrderedJson(std::string(5000, 'a') + "\x1b"));
    EXPECT_TRUE(quote.starts_with("\"aaaa")) << quote;
    EXPECT_LT(quote.size(), 70u);
    EXPECT_EQ(quoted(OrderedJson("\x1b[31m\xff")).find('\x1b'), std::string::npos);
    const std::string long_text(5000, 'b');
    for (const std::string& settings : {"\"bias.slope\":\"" + long_text + "\"", "\"map.format\":\"" + long_text + "\"",
                                        "\"" + long_text + "\":1", "\"bias.slope\":[[[\"" + long_text + "\"]]]"}) {
        const std::string text = test::error_text([&] {
            parse_preset("{\"format\":\"shadow-inspector-preset\",\"version\":2,\"settings\":{" + settings + "}}", "p");
        });
        EXPECT_FALSE(text.empty());
        EXPECT_LT(text.size(), 400u) << text;
    }
}

}  // namespace
}  // namespace si
