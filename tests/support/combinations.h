// Makes combinations of test parameters: all pairs of values by default, the full product where a run asks for it.
#pragma once

#include <cstdint>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/support/environment_number.h"

namespace si::test {

/// Row of a table of combinations: an index of a value per factor, from 0.
using Combination = std::vector<std::size_t>;

/// Returns a pairwise table, made greedily: each allowed pair of values of two factors is in at least one row.
/// @param sizes number of values of each factor
/// @param seed number that chooses among equally good rows
/// @param pair_allowed (factor a, value of a, factor b, value of b): false for a pair that no row may hold; empty: all
/// @param row_allowed false for a row that the table may not hold; empty: all
std::vector<Combination> pairwise_table(
    const std::vector<std::size_t>& sizes, std::uint32_t seed,
    const std::function<bool(std::size_t, std::size_t, std::size_t, std::size_t)>& pair_allowed = {},
    const std::function<bool(const Combination&)>& row_allowed = {});

/// Returns every combination of values, the last factor fastest.
/// @param sizes number of values of each factor
std::vector<Combination> full_product(const std::vector<std::size_t>& sizes);

/// Returns true in the run over full products (SI_FULL_PRODUCTS=1).
inline bool full_products() {
    return environment_number("SI_FULL_PRODUCTS", 0) != 0;
}

/// Returns the combinations of values of several factors that a test runs over: with SI_FULL_PRODUCTS=1 every
/// combination, otherwise a pairwise table. A test that uses it has the trait Product.
template <typename... Values>
std::vector<std::tuple<Values...>> combinations(const std::vector<Values>&... factors) {
    static_assert(sizeof...(Values) >= 2);  // one factor has no pairs
    const std::vector<std::size_t> sizes = {factors.size()...};
    const auto row_values = [&]<std::size_t... factor>(const Combination& row, std::index_sequence<factor...>) {
        return std::tuple<Values...>{factors[row[factor]]...};
    };
    std::vector<std::tuple<Values...>> out;
    for (const Combination& row : full_products() ? full_product(sizes) : pairwise_table(sizes, 1))
        out.push_back(row_values(row, std::index_sequence_for<Values...>{}));
    return out;
}

/// Returns a part of a list: every n-th element, beginning with number `first` modulo n. With SI_FULL_PRODUCTS=1
/// returns the whole list. A test that uses it has the trait Product.
template <typename Value>
std::vector<Value> portion(const std::vector<Value>& list, std::size_t n, std::size_t first = 0) {
    if (full_products()) return list;
    std::vector<Value> out;
    for (std::size_t i = first % n; i < list.size(); i += n) out.push_back(list[i]);
    return out;
}

}  // namespace si::test
