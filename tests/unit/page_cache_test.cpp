// Tests of the page pool: requested pages are found, cached ones are not drawn again, and a full pool leaves no hole.
#include "renderer/passes/page_cache.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "renderer/base/key.h"
#include "renderer/view/cascades/clip_levels.h"
#include "shaders/shared/pages.h"

namespace si {
namespace {

constexpr int kSide = 16;

/// Makes three levels about one point, each with pages twice as wide.
std::vector<PageGrid> three_levels(glm::i64vec2 centre) {
    std::vector<PageGrid> grids;
    for (int i = 0; i < 3; ++i) {
        const glm::i64 wide = glm::i64(1) << i;
        grids.push_back({kSide,
                         i < 2 ? i + 1 : -1,
                         {floor_div(centre.x, wide) - kSide / 2, floor_div(centre.y, wide) - kSide / 2}});
    }
    return grids;
}

std::vector<std::uint8_t> random_pages(std::mt19937& engine, double share) {
    std::vector<std::uint8_t> wanted(3 * kSide * kSide);
    std::bernoulli_distribution is(share);
    // Pages near the middle, which coarser levels hold.
    for (int layer = 0; layer < 3; ++layer)
        for (int y = 2; y < kSide - 2; ++y)
            for (int x = 2; x < kSide - 2; ++x) wanted[std::size_t((layer * kSide + y) * kSide + x)] = is(engine);
    return wanted;
}

TEST(PageCache, RequestedPagesAreFoundWithoutHoles) {
    std::mt19937 engine(3);
    PageCache cache;
    // Content of each place of the pool, as a renderer would leave it.
    std::map<std::pair<int, int>, std::uint64_t> pool;
    std::size_t evicted = 0, coarser = 0, kept = 0;
    for (int frame = 0; frame < 200; ++frame) {
        const glm::i64vec2 centre(frame / 3 - 40, 17 - frame / 5);
        const std::vector<PageGrid> grids = three_levels(centre);
        const std::vector<std::uint8_t> wanted = random_pages(engine, frame % 7 == 0 ? 0.6 : 0.2);
        const auto key_of = [&](int layer, glm::ivec2 page) {
            const glm::i64vec2 at = grids[std::size_t(layer)].corner + glm::i64vec2(page);
            return Key().add(layer).add(at.x).add(at.y).add(frame / 50).value();
        };
        const PageChoice choice = cache.choose_pages(grids, wanted, kSide, 120, key_of);
        const int side = cache.side();
        pool.clear();
        EXPECT_LE(choice.read.size(), 120u);
        std::set<std::pair<int, int>> places;
        for (const PlacedPage& p : choice.read) {
            EXPECT_TRUE(places.emplace(p.at.x, p.at.y).second) << "two pages in one place";
            EXPECT_TRUE(p.at.x >= 0 && p.at.x < side && p.at.y >= 0 && p.at.y < side);
            pool[{p.at.x, p.at.y}] = p.key;
        }
        kept += choice.read.size() - choice.drawn.size();
        evicted += std::size_t(choice.evicted);
        coarser += std::size_t(choice.coarser);
        for (int layer = 0; layer < 3; ++layer)
            for (int y = 0; y < kSide; ++y)
                for (int x = 0; x < kSide; ++x) {
                    const PageEntry& e = choice.entry(layer, {x, y});
                    if (!wanted[std::size_t((layer * kSide + y) * kSide + x)]) continue;
                    ASSERT_NE(e.state, shared::PAGE_ABSENT) << "a hole";
                    // The found page is the requested one, by page numbers from the world's origin.
                    const int of = layer + e.coarser;
                    ASSERT_LT(of, 3);
                    const glm::i64 parts = glm::i64(1) << e.coarser;
                    const glm::i64vec2 at = grids[std::size_t(layer)].corner + glm::i64vec2(x, y);
                    const glm::i64vec2 coarse(floor_div(at.x, parts), floor_div(at.y, parts));
                    EXPECT_EQ((pool[{e.at.x, e.at.y}]), key_of(of, glm::ivec2(coarse - grids[std::size_t(of)].corner)));
                    EXPECT_EQ(glm::i64vec2(e.part), at - coarse * parts);
                }
    }
    EXPECT_GT(evicted, 100u);
    EXPECT_GT(coarser, 100u);
    EXPECT_GT(kept, 100u);
}

// Read pages depend only on the requests, not on the cache of earlier frames.
TEST(PageCache, PageChoiceIgnoresCachedPages) {
    std::mt19937 engine(5);
    PageCache used;
    for (int frame = 0; frame < 40; ++frame) {
        const std::vector<PageGrid> grids = three_levels({frame, -frame});
        const std::vector<std::uint8_t> wanted = random_pages(engine, 0.6);
        const auto key_of = [&](int layer, glm::ivec2 page) {
            return Key().add(layer).add(page).add(frame / 4).value();
        };
        PageCache fresh;
        const PageChoice a = used.choose_pages(grids, wanted, kSide, 90, key_of);
        const PageChoice b = fresh.choose_pages(grids, wanted, kSide, 90, key_of);
        ASSERT_EQ(a.read.size(), b.read.size());
        for (std::size_t i = 0; i < a.read.size(); ++i) EXPECT_EQ(a.read[i].key, b.read[i].key);
        EXPECT_EQ(b.drawn.size(), b.read.size());
        EXPECT_EQ(a.coarser, b.coarser);
    }
}

TEST(PageCache, DrawsOnlyChangedPages) {
    PageCache cache;
    std::vector<std::uint8_t> wanted(kSide * kSide, 1);
    int changed = -1;
    const auto key_of = [&](int, glm::ivec2 p) { return Key().add(p).add(p.x == changed).value(); };
    const std::vector<PageGrid> grids = {{kSide, -1, {0, 0}}};
    EXPECT_EQ(cache.choose_pages(grids, wanted, kSide, 300, key_of).drawn.size(), 256u);
    EXPECT_EQ(cache.choose_pages(grids, wanted, kSide, 300, key_of).drawn.size(), 0u);
    changed = 3;
    const PageChoice choice = cache.choose_pages(grids, wanted, kSide, 300, key_of);
    EXPECT_EQ(choice.drawn.size(), 16u);
    for (const std::size_t i : choice.drawn) EXPECT_EQ(choice.read[i].page.x, 3);
    // A single level gives no page up: the pool grows past its intended size.
    EXPECT_EQ(PageCache().choose_pages(grids, wanted, kSide, 8, key_of).read.size(), 256u);
}

TEST(PageCache, ThePoolTakesTheRequestedCapacity) {
    PageCache cache;
    const std::vector<std::uint8_t> all(kSide * kSide, 1);
    std::vector<std::uint8_t> two(kSide * kSide, 0);
    two[0] = 1;
    two[5] = 1;
    const auto key_of = [](int, glm::ivec2 p) { return Key().add(p).value(); };
    const std::vector<PageGrid> grids = {{kSide, -1, {0, 0}}};
    cache.choose_pages(grids, two, kSide, 300, key_of);
    EXPECT_EQ(cache.side(), 18);
    EXPECT_EQ(cache.choose_pages(grids, two, kSide, 10, key_of).drawn.size(), 2u) << "the smaller pool begins empty";
    EXPECT_EQ(cache.room(), 16);
    EXPECT_EQ(cache.choose_pages(grids, two, kSide, 16, key_of).drawn.size(), 0u) << "the size is the same";
    cache.choose_pages(grids, all, kSide, 16, key_of);
    EXPECT_EQ(cache.room(), 256);
    cache.choose_pages(grids, two, kSide, 16, key_of);
    EXPECT_EQ(cache.room(), 256) << "the next frame may need as many pages again";
    cache.clear();
    cache.choose_pages(grids, two, kSide, 16, key_of);
    EXPECT_EQ(cache.side(), 4);
}

}  // namespace
}  // namespace si
