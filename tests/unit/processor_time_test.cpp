// Tests of the processor time of threads.
#include "renderer/base/processor_time.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace si {
namespace {

TEST(ProcessorTime, OfAThreadIsReadByAnother) {
    std::atomic<ThreadId> id = 0;
    std::atomic<double> own = 0;
    std::atomic<bool> stop = false;
    {
        std::jthread busy([&] {
            id = gettid();
            while (own < 10) own = own_processor_ms();
            while (!stop) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        });
        while (own < 10) std::this_thread::yield();
        EXPECT_EQ(std::ranges::count(other_threads(), id.load()), 1);
        EXPECT_GE(processor_ms(id), 10);
        EXPECT_LE(processor_ms(id), own + 1000) << "milliseconds";
        stop = true;
    }
    EXPECT_EQ(std::ranges::count(other_threads(), id.load()), 0) << "it has ended";
    EXPECT_EQ(processor_ms(id), 0);
}

TEST(ProcessorTime, OfAThreadThatSleepsStands) {
    const double before = own_processor_ms();
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    EXPECT_LT(own_processor_ms() - before, 15);
    EXPECT_EQ(std::ranges::count(other_threads(), gettid()), 0);
}

}  // namespace
}  // namespace si
