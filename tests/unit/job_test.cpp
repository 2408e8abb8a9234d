// Tests of background jobs, one at a time: reported results and suppressed ones. Threads meet by promises, never by the
// clock.
#include "app/base/job.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <string>
#include <vector>

namespace si {
namespace {

/// Work that reports its start and continues until released.
/// Declared before its job, which it must outlive.
struct Puppet {
    std::promise<void> begun, let;
    std::atomic<bool> stopped{false};  ///< set at its end

    Job<int>::Work work(int value, bool heeds = true) {
        return [this, value, heeds](const Workers& workers, const auto&) {
            begun.set_value();
            let.get_future().wait();
            stopped = workers.stop.stop_requested();
            if (stopped && heeds) throw Cancelled();
            return value;
        };
    }
    void wait_until_begun() { begun.get_future().wait(); }
};

TEST(Job, ReturnsItsValueOnce) {
    Puppet puppet;
    Job<int> job;
    EXPECT_FALSE(job.busy() || job.wanted() || job.has_news() || job.poll());
    job.wait();
    job.start(puppet.work(7));
    puppet.wait_until_begun();
    EXPECT_TRUE(job.busy() && job.wanted());
    EXPECT_FALSE(job.ended());
    puppet.let.set_value();
    job.wait();
    EXPECT_TRUE(job.ended() && job.has_news() && job.wanted() && job.busy());
    const auto outcome = job.poll();
    ASSERT_TRUE(outcome);
    EXPECT_EQ(outcome->value, 7);
    EXPECT_FALSE(outcome->cancelled || outcome->problem);
    EXPECT_FALSE(job.poll() || job.ended() || job.has_news() || job.wanted());
}

TEST(Job, NextJobStartsAfterTheCancelledOneAndOnlyItReports) {
    Puppet first, third;
    Job<int> job;
    job.start(first.work(1, false));
    first.wait_until_begun();
    bool second_ran = false;
    job.start([&](const Workers&, const auto&) { return second_ran = true, 2; });
    job.start(third.work(3), 0.25);
    EXPECT_EQ(job.progress(), 0.25);
    first.let.set_value();
    third.wait_until_begun();
    EXPECT_TRUE(first.stopped);
    EXPECT_FALSE(job.ended()) << "nobody asks for the first one's value any more";
    third.let.set_value();
    job.wait();
    EXPECT_EQ(job.poll()->value, 3);
    EXPECT_FALSE(second_ran) << "it was not wanted any more before it could begin";
    EXPECT_FALSE(third.stopped);
}

TEST(Job, CancelledJobStaysCancelledWhateverItsResult) {
    for (const bool heeds : {true, false}) {
        Puppet puppet;
        Job<int> job;
        job.start(puppet.work(7, heeds));
        puppet.wait_until_begun();
        job.cancel();
        EXPECT_FALSE(job.wanted());
        EXPECT_FALSE(job.progress());
        EXPECT_TRUE(job.busy());
        puppet.let.set_value();
        job.wait();
        const auto outcome = job.poll();
        ASSERT_TRUE(outcome);
        EXPECT_TRUE(outcome->cancelled);
        EXPECT_FALSE(outcome->value || outcome->problem);
    }
    Job<int> job;
    job.start([](const Workers&, const auto&) { return 7; });
    job.wait();
    job.cancel();
    EXPECT_TRUE(job.poll()->cancelled) << "ended just before";
}

TEST(Job, JobCancelledBeforeItsStartNeverStarts) {
    Puppet first;
    Job<int> job;
    bool ran = false;
    job.start(first.work(1));
    first.wait_until_begun();
    job.start([&](const Workers&, const auto&) { return ran = true, 2; });
    job.cancel();
    EXPECT_TRUE(job.poll()->cancelled);
    first.let.set_value();
    job.wait();
    EXPECT_FALSE(ran || job.poll());
}

TEST(Job, DroppedJobReportsNothing) {
    Puppet puppet;
    Job<int> job;
    job.start(puppet.work(7, false));
    puppet.wait_until_begun();
    job.drop();
    EXPECT_FALSE(job.has_news());
    puppet.let.set_value();
    job.wait();
    EXPECT_FALSE(job.poll());
    EXPECT_TRUE(puppet.stopped);
    job.start([](const Workers&, const auto&) { return 8; });
    job.wait();
    EXPECT_EQ(job.poll()->value, 8);
}

TEST(Job, ReportsWhyItFailed) {
    Job<int> job;
    job.start([](const Workers&, const auto&) -> int { throw Error("no such file"); });
    job.wait();
    const auto failed = job.poll();
    ASSERT_TRUE(failed && failed->problem);
    EXPECT_FALSE(failed->cancelled || failed->value);
    EXPECT_EQ(exception_message(failed->problem), "no such file");
    EXPECT_EQ(exception_message(nullptr), "");
}

TEST(Job, ReportsProgressOfTheCurrentJobOnly) {
    Puppet second;
    Job<int> job;
    std::promise<void> told, more, ended;
    job.start([&](const Workers& workers, const auto& report) {
        report(0.501);
        told.set_value();
        more.get_future().wait();
        workers.progress(0.509);  // the same percent
        ended.set_value();
        while (!workers.stop.stop_requested()) std::this_thread::yield();
        report(0.9);
        throw Cancelled();
        return 1;
    });
    told.get_future().wait();
    EXPECT_TRUE(job.has_news());
    EXPECT_EQ(job.progress(), 0.501);
    EXPECT_FALSE(job.has_news());
    more.set_value();
    ended.get_future().wait();
    EXPECT_FALSE(job.has_news()) << "nothing that is worth drawing";
    EXPECT_EQ(job.progress(), 0.509);
    job.start(second.work(2), 0.1);
    second.wait_until_begun();
    EXPECT_EQ(job.progress(), 0.1) << "the first one's 0.9 is nobody's";
    second.let.set_value();
}

TEST(Job, DestructionCancelsAndJoins) {
    std::atomic<bool> done{false};
    {
        Job<int> job;
        std::promise<void> begun;
        job.start([&](const Workers& workers, const auto&) {
            begun.set_value();
            while (!workers.stop.stop_requested()) std::this_thread::yield();
            done = true;
            return 1;
        });
        begun.get_future().wait();
    }
    EXPECT_TRUE(done);
}

}  // namespace
}  // namespace si
