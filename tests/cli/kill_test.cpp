// Tests of killed commands: the file is the old or the new one, never half.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <thread>

#include "app/sweep/journal.h"
#include "tests/support/environment_number.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Returns the number of kills for presets, which are fastest; other files get a part. SI_KILLS=200 for a thorough run.
int kills() {
    return int(test::environment_number("SI_KILLS", 12));
}

class Killed : public testing::Test {
protected:
    const fs::path folder_ = fresh_test_folder();
    std::mt19937 random_{1};
    int killed_ = 0;
    std::chrono::duration<double> window_{};  ///< estimated time window of the write

    void TearDown() override { EXPECT_GT(killed_, 0) << "each had ended before"; }

    void run(const Words& words) {
        const ProcessResult r = run_program(words, folder_);
        EXPECT_EQ(r.code, 0) << r.err;
    }
    /// Runs the command twice, the second time with cached programs, and measures its duration.
    void time(const Words& first, const Words& second) {
        run(first);
        const auto begin = Clock::now();
        run(second);
        window_ = Clock::now() - begin;
    }
    /// Returns whether more attempts are needed; at least one kill must hit the write.
    bool wants_more(int attempts, int count) const {
        constexpr int kMaxAttempts = 40;
        return attempts < count || (killed_ == 0 && attempts < kMaxAttempts);
    }

    /// Starts the command and kills it about the time of its write; the delay shrinks if the command has ended before.
    void kill_within(const Words& words) {
        std::vector<char*> arguments{const_cast<char*>(SI_PROGRAM)};
        for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
        arguments.push_back(nullptr);
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            if (::chdir(folder_.c_str()) == 0 && ::freopen("/dev/null", "w", stdout) &&
                ::freopen("/dev/null", "w", stderr))
                ::execv(SI_PROGRAM, arguments.data());
            ::_exit(127);
        }
        std::this_thread::sleep_for(window_ * std::uniform_real_distribution<>(0.3, 1.05)(random_));
        ::kill(child, SIGKILL);
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        if (WIFSIGNALED(status))
            ++killed_;
        else
            window_ *= 0.7;
    }

    /// Expects that all other files in the folder are temporaries: a dot and the start of an expected name.
    void expect_alone(const std::set<std::string>& files) {
        for (const auto& entry : fs::directory_iterator(folder_)) {
            const std::string name = entry.path().filename().string();
            if (files.contains(name)) continue;
            const bool temporary =
                std::ranges::any_of(files, [&](const std::string& file) { return name.starts_with("." + file + "."); });
            EXPECT_TRUE(temporary) << name;
            if (temporary) fs::remove(entry.path());
        }
    }

    /// Lets `command(0)` and `command(1)` write `file` in turns.
    void expect_old_or_new(const std::string& file, int count, const std::function<Words(int)>& command) {
        run(command(1));
        const std::string one = file_bytes(folder_ / file);
        time(command(0), command(0));
        const std::string two = file_bytes(folder_ / file);
        ASSERT_NE(one, two);
        for (int i = 0; wants_more(i, count); ++i) {
            ASSERT_NO_FATAL_FAILURE(kill_within(command((i + 1) % 2)));
            const std::string left = file_bytes(folder_ / file);
            ASSERT_TRUE(left == one || left == two) << i << ": " << left.size() << " bytes";
            expect_alone({file});
        }
    }
};

TEST_F(Killed, SavingAPresetLeavesAWholeFile) {
    expect_old_or_new("a.json", kills(), [](int i) {
        return Words("preset save boxes -o a.json --set map.resolution=" + std::to_string(512 + i));
    });
}

TEST_F(Killed, DrawingAPictureLeavesAWholeFile) {
    expect_old_or_new("a.png", (kills() + 3) / 4, [](int i) {
        return Words("render boxes -o a.png --size 64x48 --set filter.kernel=hard --set map.resolution=" +
                     std::to_string(64 << i));
    });
}

SI_TEST_IS(Later, Killed, ReportIsWhole);
TEST_F(Killed, ReportIsWhole) {
    const Words words = "render boxes -o a.png --size 64x48 --report r.json --set map.resolution=64";
    time(words, words);
    for (int i = 0; wants_more(i, (kills() + 3) / 4); ++i) {
        ASSERT_NO_FATAL_FAILURE(kill_within(words));
        const auto report = nlohmann::json::parse(file_bytes(folder_ / "r.json"), nullptr, false);
        ASSERT_FALSE(report.is_discarded()) << i;
        EXPECT_TRUE(report.contains("passes"));
        expect_alone({"a.png", "r.json"});
    }
}

SI_TEST_IS(Later, Killed, BakedMapIsWholeOrMissing);
TEST_F(Killed, BakedMapIsWholeOrMissing) {
    const auto words = [](int i) {
        return "render boxes -o v.png --view visibility --size 32x24 --set light.source=light-map --set" +
               Words("light.azimuth=" + std::to_string(20 + ::getpid() % 10'000 * 1e-3 + 1e-5 * i));
    };
    time(words(0), words(1));
    for (int i = 2; wants_more(i - 2, (kills() + 3) / 4); ++i) {
        ASSERT_NO_FATAL_FAILURE(kill_within(words(i)));
        const ProcessResult again = run_program(words(i), folder_);
        EXPECT_EQ(again.code, 0);
        EXPECT_EQ(again.err, "") << "what a kill left is not read as a map";
    }
}

SI_TEST_IS(Later, Killed, ContinuedSweepReachesTheSameNumbers);
TEST_F(Killed, ContinuedSweepReachesTheSameNumbers) {
    const auto words = [](const char* folder) {
        return "sweep boxes --vary map.resolution=64,128 --size 24x16 --no-time -o" + Words{folder};
    };
    time(words("whole"), words("as long"));
    for (int i = 0; wants_more(i, (kills() + 5) / 6); ++i) {
        if (killed_ == 0) fs::remove_all(folder_ / "killed");  // a whole folder
        ASSERT_NO_FATAL_FAILURE(kill_within(words("killed")));
    }
    // A case that crashes three times is given up until requested again.
    run_program(words("killed"), folder_);
    run(words("killed") + "--retry");
    EXPECT_EQ(file_bytes(folder_ / "killed/results.csv"), file_bytes(folder_ / "whole/results.csv"));
    EXPECT_TRUE(read_journal(folder_ / "killed").notes.empty());
}

}  // namespace
}  // namespace si
