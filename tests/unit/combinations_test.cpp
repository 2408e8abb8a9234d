// Tests the tables of combinations that tests run over.
#include "tests/support/combinations.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace si::test {
namespace {

TEST(Combinations, PairwiseTablesHoldEachPairInFewerRowsThanTheProduct) {
    const std::vector<std::size_t> sizes = {4, 3, 6, 2};
    const std::vector<Combination> rows = pairwise_table(sizes, 1);
    for (std::size_t a = 0; a < sizes.size(); ++a)
        for (std::size_t b = a + 1; b < sizes.size(); ++b) {
            std::set<std::pair<std::size_t, std::size_t>> pairs;
            for (const Combination& row : rows) pairs.emplace(row[a], row[b]);
            EXPECT_EQ(pairs.size(), sizes[a] * sizes[b]) << a << " " << b;
        }
    EXPECT_LT(rows.size(), 40u);
    EXPECT_EQ(full_product(sizes).size(), 4u * 3 * 6 * 2);
}

TEST(Combinations, PairwiseTablesLeaveOutWhatIsNotAllowed) {
    const auto allowed = [](std::size_t, std::size_t i, std::size_t, std::size_t j) { return i != 1 || j != 2; };
    const std::vector<Combination> rows =
        pairwise_table({3, 3}, 1, allowed, [](const Combination& row) { return row[0] != 1 || row[1] != 2; });
    EXPECT_EQ(rows.size(), 8u);
    for (const Combination& row : rows) EXPECT_FALSE(row[0] == 1 && row[1] == 2);
}

TEST(Combinations, FullProductsHoldEveryCombinationOnce) {
    const std::vector<Combination> rows = full_product({2, 3});
    EXPECT_EQ(std::set<Combination>(rows.begin(), rows.end()).size(), 6u);
    EXPECT_EQ(rows.front(), (Combination{0, 0}));
    EXPECT_EQ(rows.back(), (Combination{1, 2}));
}

TEST(Combinations, HoldTheValuesOfTheFactors) {
    const std::vector<int> numbers = {1, 2, 3};
    const std::vector<std::string> words = {"a", "b"};
    std::set<std::tuple<int, std::string>> rows;
    for (const auto& row : combinations(numbers, words)) rows.insert(row);
    EXPECT_EQ(rows.size(), 6u);
    EXPECT_TRUE(rows.contains({3, "b"}));
}

}  // namespace
}  // namespace si::test
