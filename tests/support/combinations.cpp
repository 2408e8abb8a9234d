#include "tests/support/combinations.h"

#include <array>
#include <iterator>
#include <set>

#include "renderer/scenes/shapes.h"

namespace si::test {

std::vector<Combination> pairwise_table(
    const std::vector<std::size_t>& sizes, std::uint32_t seed,
    const std::function<bool(std::size_t, std::size_t, std::size_t, std::size_t)>& pair_allowed,
    const std::function<bool(const Combination&)>& row_allowed) {
    using Pair = std::array<std::size_t, 4>;
    const auto each_pair = [&](auto&& visit) {
        for (std::size_t a = 0; a < sizes.size(); ++a)
            for (std::size_t b = a + 1; b < sizes.size(); ++b) visit(a, b);
    };
    std::set<Pair> missing;
    each_pair([&](std::size_t a, std::size_t b) {
        for (std::size_t i = 0; i < sizes[a]; ++i)
            for (std::size_t j = 0; j < sizes[b]; ++j)
                if (!pair_allowed || pair_allowed(a, i, b, j)) missing.insert({a, i, b, j});
    });
    Random random(seed);
    std::vector<Combination> out;
    while (!missing.empty()) {
        Combination best;
        std::size_t most = 0;
        for (int trial = 0; trial < 60; ++trial) {
            Combination row(sizes.size());
            for (std::size_t i = 0; i < row.size(); ++i) row[i] = random.next() % sizes[i];
            // Each row takes a missing pair, so that it adds at least one.
            auto it = missing.begin();
            std::advance(it, std::ptrdiff_t(random.next() % missing.size()));
            row[(*it)[0]] = (*it)[1];
            row[(*it)[2]] = (*it)[3];
            if (row_allowed && !row_allowed(row)) continue;
            std::size_t gain = 0;
            each_pair([&](std::size_t a, std::size_t b) { gain += missing.contains({a, row[a], b, row[b]}); });
            if (gain <= most) continue;
            most = gain;
            best = row;
        }
        if (most == 0) continue;
        each_pair([&](std::size_t a, std::size_t b) { missing.erase({a, best[a], b, best[b]}); });
        out.push_back(best);
    }
    return out;
}

std::vector<Combination> full_product(const std::vector<std::size_t>& sizes) {
    std::vector<Combination> out = {{}};
    for (const std::size_t size : sizes) {
        std::vector<Combination> longer;
        for (const Combination& row : out)
            for (std::size_t value = 0; value < size; ++value) {
                longer.push_back(row);
                longer.back().push_back(value);
            }
        out = std::move(longer);
    }
    return out;
}

}  // namespace si::test
