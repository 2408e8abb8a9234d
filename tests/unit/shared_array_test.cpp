// Tests of arrays that copies share until one changes.
#include "renderer/base/shared_array.h"

#include <gtest/gtest.h>

#include <thread>

namespace si {
namespace {

using Ints = SharedArray<int>;

TEST(SharedArray, CopiesShareMemoryUntilOneChanges) {
    Ints a = {1, 2, 3};
    const Ints b = a;
    EXPECT_TRUE(a.shares_storage_with(b));
    EXPECT_EQ(a.data(), b.data());
    a.edit()[1] = 7;
    EXPECT_FALSE(a.shares_storage_with(b));
    EXPECT_EQ(a, (std::vector<int>{1, 7, 3}));
    EXPECT_EQ(b, (std::vector<int>{1, 2, 3}));
    const int* alone = a.data();
    a.edit()[0] = 5;
    EXPECT_EQ(a.data(), alone) << "nobody shares it: it is changed where it is";
}

TEST(SharedArray, ChangesLeaveCopiesUntouched) {
    const Ints before = {1, 2, 3};
    const auto changed = [&](auto&& change) {
        Ints a = before;
        change(a);
        EXPECT_EQ(before, (std::vector<int>{1, 2, 3}));
        return a.all();
    };
    EXPECT_EQ(changed([](Ints& a) { a.push_back(4); }), (std::vector<int>{1, 2, 3, 4}));
    EXPECT_EQ(changed([](Ints& a) { a.emplace_back(4); }), (std::vector<int>{1, 2, 3, 4}));
    EXPECT_EQ(changed([](Ints& a) { a.append({4, 5}); }), (std::vector<int>{1, 2, 3, 4, 5}));
    EXPECT_EQ(changed([](Ints& a) { a.assign(2, 9); }), (std::vector<int>{9, 9}));
    EXPECT_EQ(changed([](Ints& a) { a.assign(std::vector<int>{8}); }), (std::vector<int>{8}));
    EXPECT_EQ(changed([](Ints& a) { a.resize(1); }), (std::vector<int>{1}));
    EXPECT_EQ(changed([](Ints& a) { a.clear(); }), (std::vector<int>{}));
    EXPECT_EQ(changed([](Ints& a) { a = Ints({6}); }), (std::vector<int>{6}));
}

TEST(SharedArray, MovedFromArrayIsEmptyAndUsable) {
    Ints a = {1, 2, 3};
    const Ints b = std::move(a);
    EXPECT_TRUE(a.empty());
    EXPECT_EQ(b.size(), 3u);
    a.push_back(4);
    EXPECT_EQ(a, (std::vector<int>{4}));
    EXPECT_TRUE(Ints().empty()) << "what is empty is nobody's own";
}

std::uint64_t reported_bytes() {
    for (const MemoryUse& h : memory_report().holders)
        if (h.holder == "tests' arrays") return h.bytes;
    return 0;
}

TEST(SharedArray, IsCountedOnceForAllCopies) {
    {
        Ints a = std::vector<int>(100, 1);
        a.track_memory("tests' arrays");
        EXPECT_EQ(reported_bytes(), 400u);
        Ints b = a;
        b.track_memory("tests' arrays");
        EXPECT_EQ(reported_bytes(), 400u);
        Ints first = std::vector<int>(10, 1), second = first;
        first.track_memory("tests' arrays");
        second.track_memory("tests' arrays");
        EXPECT_EQ(reported_bytes(), 440u) << "shared before it was told of";
        first.clear();
        second.clear();
        b.push_back(2);
        b.track_memory("tests' arrays");
        EXPECT_EQ(reported_bytes(), 804u);
        b.resize(10);
        b.track_memory("tests' arrays");
        EXPECT_EQ(reported_bytes(), 440u);
    }
    EXPECT_EQ(reported_bytes(), 0u);
}

TEST(SharedArray, ThreadsChangeOnlyTheirCopies) {
    const Ints all = std::vector<int>(1000, 1);
    std::vector<std::jthread> threads;
    std::vector<long> sums(4);
    for (std::size_t t = 0; t < sums.size(); ++t)
        threads.emplace_back([&, t, own = all]() mutable {
            for (int round = 0; round < 50; ++round) {
                Ints next = own;
                for (int& i : next.edit()) i += int(t);
                own = std::move(next);
            }
            for (const int i : own) sums[t] += i;
        });
    threads.clear();
    for (std::size_t t = 0; t < sums.size(); ++t) EXPECT_EQ(sums[t], 1000 * (1 + 50 * long(t)));
    for (const int i : all) EXPECT_EQ(i, 1);
}

}  // namespace
}  // namespace si
