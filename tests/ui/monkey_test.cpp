// Random test of the editor's window: seeded events. The editor survives, the driver reports no error, all numbers are
// finite, and the idle editor's memory is as before.
//
//     SI_MONKEY_EVENTS=20000 SI_MONKEY_SEED=7 build/release/tests/test_ui --gtest_filter='*Monkey*'
#include "tests/ui/monkey.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <thread>

#include "app/session/presets.h"
#include "tests/support/confinement.h"
#include "tests/support/environment_number.h"
#include "tests/support/missing_reason.h"
#include "tests/ui/window_fixture.h"
#include "tests/ui/xdnd.h"

namespace si::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Json = nlohmann::json;

constexpr int kUsualEvents = 90;
constexpr std::uint32_t kUsualSeed = 1;
constexpr int kStableReports = 3;   ///< successive reports with equal memory
constexpr int kMaxReports = 60;     ///< limit of reports until the editor is idle: a reference may take long
constexpr int kPrintedEvents = 40;  ///< printed events before an end
constexpr int kMaxPrograms = 150;   ///< limit for the editor's renderers: one keeps 64 programs, or all of its frame
constexpr auto kDropped = 20s;      ///< time limit of a drop: a modal loop of X may take none
/// Bytes by which idle editors may differ: a probe with texels (up to 32 MiB of this map), overlays (30 MiB), a
/// compared picture (15 MiB), the last reference with its surfaces (80 MiB).
constexpr std::uint64_t kLeftOver = 160u << 20;
constexpr int kEventsBetweenChecks = 2000;  ///< events between two checks of the idle editor
/// Limit of resident bytes of an idle editor: the program and its driver (some 250 MiB), 64 programs of 4 MiB each,
/// reported memory, and half as much again.
constexpr std::uint64_t kMaxResidentBytes = 1200u << 20;

class WindowMonkey : public Window {
protected:
    void SetUp() override {
        Window::SetUp();
        work_ = folder_ / "work";
        fs::create_directories(work_);
        files_ = monkey_files(work_ / "files");
        if (const char* more = std::getenv("SI_MONKEY_FILES"))
            for (const auto& entry : fs::recursive_directory_iterator(more)) files_.push_back(entry.path());
        confinement_ = Confinement::for_folder(folder_);
    }

    /// Returns whether the sandbox works, so that only the test's folder can be changed.
    bool is_confined() const {
        if (!confinement_) return false;
        const fs::path outside = fs::path(SI_TEST_OUTPUT_DIR) / "monkey_was_outside", inside = work_ / "inside";
        for (const fs::path& file : {outside, inside}) {
            Process touch({"touch", file.string()}, work_, "../touch.log", -1, &*confinement_);
            while (touch.running()) std::this_thread::sleep_for(10ms);
        }
        return fs::exists(inside) && !fs::exists(outside);
    }

    void begin() {
        const char* program = std::getenv("SI_MONKEY_PROGRAM");  // another build
        program_ = std::make_unique<Process>(
            std::vector<std::string>{program ? program : SI_PROGRAM, "edit", "boxes", "--size", "1280x720",
                                     "--check-numeric", "--report", report_file().string()},
            work_, "../program.log", -1, &*confinement_);
        ASSERT_TRUE(shows("boxes")) << log();
        window_ = std::strtoul(ask("search --name 'Shadow Inspector'").c_str(), nullptr, 10);
    }

    void play(const std::string& event) {
        const auto numbers = [&](std::size_t skipped) {
            std::istringstream in(event.substr(skipped));
            std::array<int, 3> n{};
            in >> n[0] >> n[1] >> n[2];
            return n;
        };
        if (event.starts_with("xdotool ")) {
            xdotool(event.substr(8));
        } else if (event.starts_with("size ")) {
            const auto n = numbers(5);
            xdotool(fmt::format("windowsize {} {} {}", window_, n[0], n[1]));
        } else if (event.starts_with("drop ")) {
            const auto n = numbers(5);
            drop_file(window_, files_[std::size_t(n[0]) % files_.size()], n[1], n[2], kDropped);
        } else if (event.starts_with("pause ")) {
            std::this_thread::sleep_for(std::chrono::milliseconds(numbers(6)[0]));
        } else {
            FAIL() << "no event: " << event;
        }
    }

    /// Brings the editor to a fixed state. Returns its report.
    Json idle_report() {
        for (const char* key : {"ctrl", "shift", "alt", "super"}) xdotool(fmt::format("keyup {}", key));
        for (const char* button : {"1", "2", "3"}) xdotool(fmt::format("mouseup {}", button));
        xdotool(fmt::format("windowsize {} 1280 720", window_));
        for (int i = 0; i < 4; ++i) xdotool("key Escape");
        // Written again: the monkey may have overwritten the file.
        save_preset({.title = "", .topic = "", .about = "", .scene = "boxes", .settings = {}}, folder_ / "rest.json");
        drop_file(window_, folder_ / "rest.json", 300, 300, 10min);
        shows("boxes");
        // The scene alone, and the pointer outside: no open panel and no hovered pixel requests anything.
        xdotool("mousemove 100 200");
        wait_until_idle();
        xdotool("key F11");
        wait_until_idle();
        xdotool("mousemove 1240 18");
        // The report is written every few seconds, also without frames. An idle editor's report does not change.
        Json report, last;
        auto written = fs::file_time_type::min();
        int alike = 0;
        for (int times = 0; times < kMaxReports; ++times) {
            std::error_code none;
            wait_until([&] { return fs::last_write_time(report_file(), none) > written; });
            written = fs::last_write_time(report_file(), none);
            last = std::exchange(report, json_of(report_file()));
            const Json::json_pointer held("/memory/held");
            const bool same = last.is_object() && report.is_object() && last.at(held) == report.at(held);
            alike = same ? alike + 1 : 0;
            if (alike >= kStableReports) break;
        }
        xdotool("key Escape");
        return report;
    }

    void expect_harmless(const Json& report) const {
        EXPECT_EQ(report.value("/driver_messages/count"_json_pointer, -1), 0) << report["driver_messages"];
        EXPECT_TRUE(report.contains("unsound") && report["unsound"].is_null()) << report["unsound"];
    }

    void expect_idle_memory(const Json& report) const {
        expect_harmless(report);
        EXPECT_LT(report["memory"]["resident"].get<std::uint64_t>(), kMaxResidentBytes) << report["memory"].dump(1);
    }

    static std::string memory_text(const Json& report) {
        const Json& m = report["memory"];
        const auto mib = [](const Json& bytes) { return double(bytes.get<std::uint64_t>()) / (1 << 20); };
        std::string text = fmt::format(
            "{:.0f} MiB resident, {:.0f} at most; heap {:.0f} and {:.0f} free; held {:.0f}:", mib(m["resident"]),
            mib(m["peak"]), mib(m["heap"]), mib(m["heap_free"]), mib(m["held"]));
        for (const Json& h : m["holders"])
            if (h["most"] > (1 << 20))
                text += fmt::format(" {} {:.1f} (at most {:.1f});", h["holder"].get<std::string>(), mib(h["bytes"]),
                                    mib(h["most"]));
        return text;
    }

    /// Returns a path that the file dialogs do not list, so that no saved file can replace it.
    fs::path report_file() const { return folder_ / "session.report"; }

    fs::path work_;
    std::vector<fs::path> files_;
    std::optional<Confinement> confinement_;
    unsigned long window_ = 0;
};

TEST_F(WindowMonkey, DoesNoHarm) {
    if (!is_confined())
        GTEST_SKIP() << test::kMissingReason << "Landlock in the kernel: nothing would keep it from a person's files";
    const std::uint32_t seed = environment_number("SI_MONKEY_SEED", kUsualSeed);
    const int count = int(environment_number("SI_MONKEY_EVENTS", kUsualEvents));
    std::vector<std::string> events;
    if (const char* replayed = std::getenv("SI_MONKEY_REPLAY")) {
        std::ifstream in(replayed);
        for (std::string line; std::getline(in, line);) events.push_back(line);
    } else {
        events = monkey_events(seed, count, files_.size());
    }
    const fs::path written = folder_ / "events.txt";
    std::cout << "monkey: seed " << seed << ", " << events.size() << " events, written to " << written.string()
              << "; SI_MONKEY_REPLAY=FILE plays such a file again" << std::endl;
    std::ofstream out(written);
    ASSERT_NO_FATAL_FAILURE(begin());
    const Json before = idle_report();
    std::cout << "before: " << memory_text(before) << std::endl;
    int ends = 0;
    Json after;
    for (std::size_t i = 0; i < events.size(); ++i) {
        out << events[i] << std::endl;
        ASSERT_NO_FATAL_FAILURE(play(events[i]));
        if (!program_->running()) {
            // The menu may have closed the editor.
            std::string last;
            for (std::size_t k = i + 1 - std::min<std::size_t>(i + 1, kPrintedEvents); k <= i; ++k)
                last += events[k] + "\n";
            ASSERT_EQ(program_->code(), 0) << "after event " << i << " of seed " << seed << ":\n" << last << log();
            expect_harmless(json_of(report_file()));
            ++ends;
            ASSERT_NO_FATAL_FAILURE(begin());
        }
        if ((i + 1) % kEventsBetweenChecks == 0) {
            const Json report = idle_report();
            std::cout << i + 1 << " events: " << memory_text(report) << std::endl;
            expect_idle_memory(report);
        }
    }
    after = idle_report();
    std::cout << "after, " << ends << " ends by the menu: " << memory_text(after) << std::endl;
    ASSERT_TRUE(program_->running()) << log();
    expect_idle_memory(after);
    for (const Json& h : after["memory"]["holders"])
        if (h["holder"] == "texts of shader programs") {
            EXPECT_LE(h["count"], kMaxPrograms);
        }
    EXPECT_LT(after["memory"]["held"].get<std::uint64_t>(), before["memory"]["held"].get<std::uint64_t>() + kLeftOver);
    quit();
    for (const char* word : {"Assertion", "terminate called", "Sanitizer", "runtime error"})
        EXPECT_EQ(log().find(word), std::string::npos) << log();
}

}  // namespace
}  // namespace si::test
