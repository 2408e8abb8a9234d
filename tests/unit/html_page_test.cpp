// Tests of pages without scripts: their policy names their style by its hash, and no text leaves its place.
#include "app/report/html_page.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/report/plot_svg.h"
#include "renderer/base/base64.h"
#include "renderer/base/sha256.h"

namespace si {
namespace {

std::string hex_of_sha256(std::string_view bytes) {
    std::string out;
    for (const std::uint8_t byte : sha256(bytes)) out += fmt::format("{:02x}", byte);
    return out;
}

// FIPS 180-2, appendix B, and the empty message.
TEST(HtmlPage, Sha256GivesThePublishedValues) {
    EXPECT_EQ(hex_of_sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(hex_of_sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(hex_of_sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(hex_of_sha256(std::string(1'000'000, 'a')),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(HtmlPage, ThePolicyNamesTheStyleThatThePageHas) {
    const std::string page = still_page("Title", "<p>text</p>");
    const auto begin = page.find("<style>") + 7, end = page.find("</style>");
    ASSERT_LT(begin, end);
    const auto hash = sha256(std::string_view(page).substr(begin, end - begin));
    const std::string named = base64({reinterpret_cast<const char*>(hash.data()), hash.size()});
    EXPECT_NE(page.find("default-src 'none'; img-src data:; style-src 'sha256-" + named + "';"), std::string::npos);
    EXPECT_EQ(page.find("unsafe"), std::string::npos);
    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_EQ(page.find('@' + std::string("BODY@")), std::string::npos);
}

TEST(HtmlPage, TitlesStayTitles) {
    const std::string page = still_page("</title><script>alert(1)</script>@BODY@@STYLE@@HASH@", "<p>only here</p>");
    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_NE(page.find("<title>&lt;/title&gt;&lt;script&gt;alert(1)&lt;/script&gt;@BODY@@STYLE@"), std::string::npos);
    EXPECT_EQ(page.find("<p>only here</p>"), page.rfind("<p>only here</p>"));
}

TEST(HtmlPage, TicksAreRoundAndCoverTheAxis) {
    EXPECT_EQ(axis_ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(axis_ticks(0, 1, 2), (std::vector<double>{0, 0.5, 1}));
    EXPECT_EQ(axis_ticks(4, 20, 4).front(), 5);
    EXPECT_TRUE(axis_ticks(1, 1, 4).empty());
}

TEST(HtmlPage, PlotsEscapeTheirTextsAndLeaveUnknownPointsOut) {
    Plot plot{.title = "<t>", .x_label = "a & b", .y_label = "\"y\"", .points = {}};
    plot.points = {{1, 2}, {2, std::nan("")}, {3, 1}};
    const std::string svg = plot_svg(plot);
    EXPECT_EQ(svg.find("<t>"), std::string::npos);
    EXPECT_NE(svg.find("a &amp; b"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    std::size_t dots = 0;
    for (std::size_t at = 0; (at = svg.find("<circle", at)) != std::string::npos; ++at) ++dots;
    EXPECT_EQ(dots, 2u);
}

TEST(HtmlPage, NamesEachStyleOfTheBodyByItsHash) {
    // printf %s 'p{}' | openssl dgst -sha256 -binary | base64
    const std::string page = still_page("t", "<style>p{}</style>", {"p{}"});
    EXPECT_NE(page.find("' 'sha256-gG2yISYereRMiG2lMXrbiUgi0Ubw9p7QCeWcroOvy9Y='"), std::string::npos);
}

}  // namespace
}  // namespace si
