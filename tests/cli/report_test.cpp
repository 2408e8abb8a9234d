// Tests of a sweep's report in a headless browser: drawing, sorting, filtering, no external resources.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "app/base/output.h"
#include "app/sweep/html_report.h"
#include "renderer/base/base64.h"
#include "tests/support/fake_sweep.h"
#include "tests/support/missing_reason.h"
#include "tests/support/process.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Made-up times: hard is cheap and inaccurate, a wide kernel is expensive and smooth, 4096 texels fail.
struct PlausibleMeter : FakeMeter {
    DrawnCase facts(const SweepCase& c) override {
        DrawnCase f = FakeMeter::facts(c);
        const int n = c.settings.map.resolution;
        const double texels = c.settings.filter.kernel == 0 ? 0.243 : 0.112;
        ErrorMetrics& m = f.error.metrics;
        m.mae = texels * 20 / n;
        m.false_shadow = texels * 9 / n;
        m.iou = 1 - texels * 30 / n;
        m.signed_mean = -texels * 5 / n;
        return f;
    }
    CaseTimes time(const SweepCase& c, int frames, CostCase, ShadowFrames) override {
        timed.push_back(c.id);
        const double n = c.settings.map.resolution, ms = 30 + n * n * 4e-6 + 12 * c.settings.filter.kernel;
        TimeSamples s;
        for (int i = 0; i < frames; ++i) {
            s.total_ms.push_back(ms * (1 + 0.01 * i));
            s.maps_ms.push_back(ms * 0.3);
        }
        s.clock = "finished wall time (CPU rasteriser)";
        return {s};
    }
};

struct Page {
    fs::path file;
    Json results, seen;  ///< `seen`: findings of the page's self-test
    std::string console;
};

bool has_browser() {
    return std::system("command -v chromium >/dev/null 2>&1") == 0;
}

std::string quoted(const fs::path& path) {
    return "'" + path.string() + "'";
}

/// Returns the browser's DOM of the page after its scripts ran. `console` gets their messages.
std::string dump(const fs::path& folder, const std::string& url, std::string& console) {
    const std::string command =
        "timeout 120 chromium --headless --no-sandbox --disable-gpu --enable-logging=stderr --v=0 "
        "--user-data-dir=" +
        quoted(folder / "profile") + " --virtual-time-budget=4000 --dump-dom '" + url + "' >" +
        quoted(folder / "dom.html") + " 2>" + quoted(folder / "console.txt") + " </dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << file_bytes(folder / "console.txt");
    console = file_bytes(folder / "console.txt");
    return file_bytes(folder / "dom.html");
}

Page open_page(const std::string& scene, PlausibleMeter meter = {}) {
    Page page;
    FakeSweep sweep(fresh_test_folder());
    sweep.axes[0] = parse_axis("map.resolution=512:4096:*2");
    sweep.plan = plan_sweep(Settings{}, sweep.axes);
    sweep.spec.axes = sweep.axes;
    sweep.spec.scene = scene;
    meter.fails_at_resolution = 4096;
    sweep.run(meter);
    page.results = sweep.results();
    page.file = sweep.folder / "report.html";
    write_file(page.file, report_html(page.results, sweep.folder));
    if (!has_browser()) return page;
    const std::string dom = dump(sweep.folder, "file://" + page.file.string() + "#selftest", page.console);
    const std::string mark = "<pre id=\"selftest\" hidden=\"\">";
    const auto at = dom.find(mark);
    if (at == std::string::npos) return page;
    const auto end = dom.find("</pre>", at);
    std::string text = dom.substr(at + mark.size(), end - at - mark.size());
    for (const auto& [name, character] : {std::pair("&lt;", "<"), {"&gt;", ">"}, {"&amp;", "&"}})
        for (std::size_t p; (p = text.find(name)) != std::string::npos;) text.replace(p, std::strlen(name), character);
    page.seen = Json::parse(text, nullptr, false);
    return page;
}

std::vector<int> numbers(const Json& list) {
    return list.get<std::vector<int>>();
}

TEST(ReportPage, DrawsSortsAndFiltersInABrowser) {
    const Page page = open_page("stage");
    if (!has_browser()) GTEST_SKIP() << test::kMissingReason << "chromium";
    ASSERT_TRUE(page.seen.is_object()) << page.console;
    EXPECT_EQ(page.seen["dots"], 6) << "two of eight failed";
    EXPECT_EQ(page.seen["frontier"], page.results["frontier"]["cases"]);
    EXPECT_EQ(page.seen["tied"], page.results["frontier"]["tied"]);
    EXPECT_TRUE(page.seen["errors"].empty()) << page.seen["errors"];
    EXPECT_EQ(page.console.find("CONSOLE"), std::string::npos) << page.console;
    EXPECT_EQ(numbers(page.seen["order"]), (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
    // Order by error: pcf3 of 2048, hard of 2048, pcf3 of 1024, ...; failed cases come last both ways.
    EXPECT_EQ(numbers(page.seen["ascending"]), (std::vector<int>{5, 3, 4, 1, 2, 0, 6, 7}));
    EXPECT_EQ(numbers(page.seen["descending"]), (std::vector<int>{0, 2, 1, 4, 3, 5, 6, 7}));
    EXPECT_EQ(numbers(page.seen["filtered"]).size(), 2u) << "of map.resolution=512";
    EXPECT_EQ(page.seen["filtered_dots"], 2);
    EXPECT_EQ(page.seen["marks"], 16) << "series are told apart by their shapes alone";
    EXPECT_NE(page.seen["filter_note"].get<std::string>().find("nonsense"), std::string::npos);
    for (const char* axis : {"time.total_ms.median", "cost.bytes_touched", "setting:map.resolution"})
        EXPECT_EQ(page.seen["axes"][axis], 6) << axis;
    ASSERT_EQ(page.seen["slopes"].size(), 2u);
    for (const Json& line : page.seen["slopes"]) EXPECT_EQ(line[1], "\u22121.00");
    EXPECT_EQ(numbers(page.seen["gallery"]).size(), page.results["frontier"]["cases"].size());
}

TEST(ReportPage, StringsStayStrings) {
    const std::string scene = "x</script><script>document.title='broken'</script><b id=evil>&amp;\u2028.gltf";
    const Page page = open_page(scene);
    const std::string html = file_bytes(page.file);
    EXPECT_EQ(html.find("broken'</script>"), std::string::npos);
    EXPECT_EQ(html.find("<b id=evil"), std::string::npos);
    for (const char* outside : {"http:", "https:", "src=\"/", "url("}) {
        std::string rest = html;
        const auto svg = rest.find("http://www.w3.org/2000/svg");  // a name, not a place
        ASSERT_NE(svg, std::string::npos);
        rest.erase(svg, 26);
        EXPECT_EQ(rest.find(outside), std::string::npos) << outside;
    }
    if (!has_browser()) GTEST_SKIP() << test::kMissingReason << "chromium";
    ASSERT_TRUE(page.seen.is_object()) << page.console;
    EXPECT_TRUE(page.seen["errors"].empty());
    const std::string dom = file_bytes(page.file.parent_path() / "dom.html");
    EXPECT_NE(dom.find("x&lt;/script&gt;"), std::string::npos) << "the title shows the name as it is";
    EXPECT_EQ(dom.find("<b id="), std::string::npos);
}

TEST(ReportPage, PicturesStayWithinTheirLimit) {
    FakeSweep sweep(fresh_test_folder());
    FakeMeter meter;
    sweep.run(meter, 8);
    const std::string all = report_html(sweep.results(), sweep.folder),
                      none = report_html(sweep.results(), sweep.folder, {}, 10);
    EXPECT_NE(all.find("data:image/jpeg;base64,anBn"), std::string::npos);
    EXPECT_EQ(none.find("data:image/jpeg"), std::string::npos);
    fs::remove_all(sweep.folder / "pictures");
    EXPECT_EQ(report_html(sweep.results(), sweep.folder), none) << "without its pictures the page is whole";
}

TEST(ReportPage, Base64MatchesTheRfc) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace si
