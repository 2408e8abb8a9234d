// Tests of child processes that run parsers of foreign files: answers, failures, limits, confinement, cancellation.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <string>
#include <thread>

#include "renderer/base/error.h"
#include "renderer/foreign/sanitized.h"
#include "tests/support/error_text.h"
#include "tests/support/foreign_jobs.h"
#include "tests/support/process.h"

namespace si::test {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Runs a job on a text and returns its answer as a text.
std::string run(const char* job, std::string_view request, const ForeignLimits& limits = {},
                const std::filesystem::path* folder = nullptr, const std::function<bool(double)>& progress = {}) {
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(request.data()), request.size());
    const auto answer = run_foreign_job(foreign_job(job), bytes, limits, folder, progress);
    return {answer.begin(), answer.end()};
}

std::string failure(const char* job, std::string_view request = "", const ForeignLimits& limits = {}) {
    return error_text([&] { run(job, request, limits); });
}

TEST(ForeignChild, ReturnsWhatTheJobReturns) {
    EXPECT_EQ(run("echo", "words"), "words");
    EXPECT_EQ(run("echo", ""), "");
    std::string large(std::size_t{40} << 20, 'x');  // more than a socket holds, both ways
    large += "end";
    EXPECT_TRUE(run("echo", large) == large);
}

TEST(ForeignChild, ReportsProgress) {
    double last = -1;
    run("echo", "words", {}, nullptr, [&](double fraction) {
        last = fraction;
        return true;
    });
    EXPECT_TRUE(last == 0 || last == 0.5) << last;
}

TEST(ForeignChild, EachEndHasItsSentence) {
    EXPECT_EQ(failure("refuse", "accessor 3 is wrong"), "accessor 3 is wrong");
    EXPECT_EQ(failure("refuse", "two\nlines"), "two\\x0alines");
    EXPECT_EQ(failure("crash"), "the test job ended while it read the file (signal 11, Segmentation fault)");
    EXPECT_EQ(failure("abort"), "the test job ended while it read the file (signal 6, Aborted)");
    EXPECT_EQ(failure("quit"), "the test job ended without an answer");
    EXPECT_EQ(failure("zeros", "101", {.answer_bytes = 100}),
              "the test job returns 101 bytes, more than the limit of 100");
    EXPECT_EQ(run("zeros", "100", {.answer_bytes = 100}).size(), 100u);
}

TEST(ForeignChild, ProcessorTimeIsLimited) {
    EXPECT_EQ(failure("loop", "", {.processor_s = 1}), "the test job takes more than 1 s of processor time");
}

TEST(ForeignChild, MemoryIsLimited) {
    if (foreign::kSanitized) GTEST_SKIP() << "a sanitizer reserves terabytes";
    EXPECT_EQ(failure("memory", "", {.memory_bytes = std::size_t{200} << 20}),
              "the test job needs more memory than it may take");
}

TEST(ForeignChild, NothingButParsingIsAllowed) {
    EXPECT_EQ(run("forbidden", ""), "");
    const std::filesystem::path folder = fresh_test_folder();
    EXPECT_EQ(run("forbidden", "", {}, &folder), "");
}

TEST(ForeignChild, ReadsBelowTheFolderOnly) {
    const std::filesystem::path folder = fresh_test_folder();
    const std::filesystem::path inner = folder / "inner";
    std::filesystem::create_directories(inner);
    std::ofstream(inner / "file") << "content";
    std::ofstream(folder / "outside") << "secret";
    EXPECT_EQ(run("read", "file", {}, &inner), "content");
    EXPECT_EQ(error_text([&] { run("read", "../outside", {}, &inner); }), "the file cannot be opened");
    EXPECT_EQ(error_text([&] { run("read", "file"); }), "the file cannot be opened");
    const std::filesystem::path missing = folder / "missing";
    EXPECT_EQ(error_text([&] { run("read", "file", {}, &missing); }),
              "the file's folder cannot be opened (No such file or directory)");
}

TEST(ForeignChild, CancellationTakesAFractionOfASecond) {
    const auto start = Clock::now();
    int calls = 0;
    EXPECT_EQ(error_text([&] { run("loop", "", {}, nullptr, [&](double) { return ++calls < 3; }); }), "cancelled");
    EXPECT_LT(seconds_since(start), 2.0);
}

TEST(ForeignChild, SeveralRunAtOnce) {
    std::vector<std::thread> threads;
    std::atomic<int> right = 0;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([&right, i] { right += run("echo", std::to_string(i)) == std::to_string(i); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(right, 4);
}

/// Returns the children of a process; empty when it has none or is gone.
std::string children_of(pid_t process) {
    const std::string id = std::to_string(process);
    std::ifstream in("/proc/" + id + "/task/" + id + "/children");
    std::string out;
    std::getline(in, out);
    return out;
}

bool is_alive(const std::string& process) {
    std::ifstream in("/proc/" + process + "/stat");
    std::string id, name, state;
    return (in >> id >> name >> state) && state != "Z" && state != "X";
}

TEST(ForeignChild, EndsWithItsParent) {
    const pid_t parent = ::fork();
    ASSERT_GE(parent, 0);
    if (parent == 0) {
        error_text([] { run("loop", "", {.processor_s = 20}); });
        ::_exit(0);
    }
    std::string child;
    const auto start = Clock::now();
    while (child.empty() && seconds_since(start) < 10) child = children_of(parent);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // it begins to watch its parent
    child = child.substr(0, child.find(' '));
    ASSERT_FALSE(child.empty());
    EXPECT_TRUE(is_alive(child));
    ::kill(parent, SIGKILL);
    ::waitpid(parent, nullptr, 0);
    const auto killed = Clock::now();
    while (is_alive(child) && seconds_since(killed) < 5) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_FALSE(is_alive(child));
}

}  // namespace
}  // namespace si::test
