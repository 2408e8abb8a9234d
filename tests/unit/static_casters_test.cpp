// Tests of the choice of static casters, from frame to frame.
#include "renderer/optimisations/static_casters.h"

#include <gtest/gtest.h>

#include <numeric>

namespace si {
namespace {

using Draws = StaticCasters::Draws;

/// Makes casters of these contents, each of so many triangles.
std::vector<StaticCandidate> casters(std::vector<std::uint64_t> contents, std::uint64_t triangles = 10) {
    return group_by_content(contents, std::vector<std::uint64_t>(contents.size(), triangles));
}

TEST(StaticCasters, AreCastersInTwoFramesOfTheSameViews) {
    StaticCasters r;
    std::string_view reason;
    EXPECT_EQ(r.choose(1, casters({5, 3, 9}), reason), Draws::All);
    EXPECT_EQ(reason, "") << "nothing is known of what moved";
    EXPECT_EQ(r.choose(1, casters({5, 3, 8}), reason), Draws::StaticAndMoving);
    EXPECT_TRUE(r.is_static(5) && r.is_static(3));
    EXPECT_FALSE(r.is_static(8) || r.is_static(9));
    EXPECT_EQ(r.choose(1, casters({5, 7, 3}), reason), Draws::MovingOnly);
    EXPECT_EQ(r.choose(1, casters({5, 7, 3}), reason), Draws::MovingOnly) << "the same frame again";
    EXPECT_EQ(r.choose(1, casters({5, 6, 3, 11}), reason), Draws::MovingOnly) << "what is new moves";
    EXPECT_TRUE(r.has_cache_for(1));
    EXPECT_FALSE(r.has_cache_for(2));
    EXPECT_EQ(r.choose(1, casters({5, 4, 11}), reason), Draws::StaticAndMoving) << "3 is gone";
    EXPECT_TRUE(r.is_static(5));
    EXPECT_FALSE(r.is_static(3));
    EXPECT_FALSE(r.is_static(11)) << "it moved but now, and may do so again";
    EXPECT_EQ(r.choose(2, casters({5, 1, 11}), reason), Draws::All);
    EXPECT_FALSE(r.has_cache_for(2) || r.has_cache_for(1));
}

TEST(StaticCasters, EqualContentsAreOneCaster) {
    const std::vector<StaticCandidate> all = casters({4, 0, 2, 4}, 10);
    EXPECT_EQ(all, (std::vector<StaticCandidate>{{2, 10}, {4, 20}})) << "0 casts nothing";
    StaticCasters r;
    std::string_view reason;
    r.choose(1, casters({2, 4, 4}), reason);
    EXPECT_EQ(r.choose(1, casters({2, 4, 9}), reason), Draws::StaticAndMoving);
    EXPECT_TRUE(r.is_static(4)) << "one of them still is where both were";
}

TEST(StaticCasters, FewTrianglesGetNoCopy) {
    StaticCasters r;
    std::string_view reason;
    const auto one_of_many = [](std::uint64_t moved, std::uint64_t triangles) {
        return group_by_content(std::vector<std::uint64_t>{2, moved},
                                std::vector<std::uint64_t>{1, kMaxTrianglesPerStatic * triangles});
    };
    r.choose(1, one_of_many(9, 1), reason);
    EXPECT_EQ(r.choose(1, one_of_many(8, 1), reason), Draws::All);
    EXPECT_NE(reason.find("few triangles"), std::string_view::npos);
    EXPECT_EQ(r.choose(1, casters({7}), reason), Draws::All);
    EXPECT_NE(reason.find("all casters have moved"), std::string_view::npos);
}

TEST(StaticCasters, StoppedCastersAreAddedOnceTheirCostIsEqual) {
    StaticCasters r;
    std::string_view reason;
    std::vector<std::uint64_t> all(10);
    std::iota(all.begin(), all.end(), 100);
    r.choose(1, casters(all), reason);
    for (int i = 0; i < 5; ++i) all[std::size_t(i)] += 50;
    ASSERT_EQ(r.choose(1, casters(all), reason), Draws::StaticAndMoving);
    // The five are static from now on, of ten; another one moves.
    int moved = 0;
    for (;; ++moved) {
        ASSERT_LT(moved, 10);
        all.push_back(1000 + std::uint64_t(moved));
        const Draws draws = r.choose(1, casters(all), reason);
        all.pop_back();
        if (draws == Draws::StaticAndMoving) break;
        EXPECT_EQ(draws, Draws::MovingOnly);
    }
    EXPECT_EQ(moved, 2) << "three times five are more than ten";
    EXPECT_TRUE(r.is_static(150));
}

TEST(MapCells, CoverTexelsByFewRectangles) {
    MapCells cells;
    EXPECT_TRUE(cells.texel_rects(640).empty());
    cells.add({{0.5, 0.25}, {0.53, 0.27}}, false);
    EXPECT_EQ(cells.texel_rects(640), (std::vector<TexelRect>{{{320, 160}, {340, 180}}}));
    EXPECT_EQ(MapCells::whole().texel_rects(100), (std::vector<TexelRect>{{{0, 0}, {100, 100}}}));
    cells.add({{0.9, 0.26}, {1.2, 0.26}}, false);
    // Covers every texel of each held cell, also at sizes that cells do not divide.
    for (const int n : {1, 7, 64, 100, 511}) {
        const std::vector<TexelRect> rects = cells.texel_rects(n);
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const double u = (x + 0.5) / n, v = (y + 0.5) / n;
                const bool held = cells.overlaps({{double(x) / n, double(y) / n}, {u, v}});
                bool in = false;
                for (const TexelRect& r : rects) in |= x >= r.from.x && x < r.to.x && y >= r.from.y && y < r.to.y;
                ASSERT_TRUE(in || !held) << x << ", " << y << " of " << n;
            }
        for (const TexelRect& r : rects) {
            EXPECT_GE(glm::min(r.from.x, r.from.y), 0);
            EXPECT_LE(glm::max(r.to.x, r.to.y), n);
        }
    }
    MapCells more;
    more.add({{0, 0}, {0.01, 0.01}}, false);
    more.add(cells);
    EXPECT_TRUE(more.contains(cells));
}

}  // namespace
}  // namespace si
