// Which pages of virtual maps lie where in a pool, and what is to be drawn: no GL, so that it can be tested by itself.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/type_precision.hpp>
#include <unordered_map>
#include <vector>

namespace si {

/// The pages of one layer of the maps: a square grid, from the lower left.
struct PageGrid {
    int side = 0;      ///< in pages
    int coarser = -1;  ///< layer of the next coarser level of the same light; -1: none
    glm::i64vec2 corner{
        0};  ///< of its first page among its level's pages; those of the coarser level are twice as wide
};

struct PageEntry {
    glm::u16vec2 at{0};        ///< in the pool, in pages
    glm::u8vec2 part{0};       ///< of a coarser page, in pages of this level
    std::uint8_t state = 0;    ///< shared/pages.h
    std::uint8_t coarser = 0;  ///< how many levels
};
static_assert(sizeof(PageEntry) == 8);

struct PlacedPage {
    int layer = 0;
    glm::ivec2 page{0};  ///< of the layer's grid
    glm::ivec2 at{0};    ///< in the pool, in pages
    std::size_t slot = 0;
    std::uint64_t key = 0;
};

/// What one frame reads of the pool.
struct PageChoice {
    std::vector<PageEntry> table;  ///< layer by layer, `table_side` rows of as many
    int table_side = 0;
    std::vector<PlacedPage> read;    ///< each page of the pool that is read, once for each layer that it is of
    std::vector<std::size_t> drawn;  ///< of `read`, what is to be drawn
    int wanted = 0, coarser = 0, evicted = 0;
    std::vector<int> wanted_by_layer;
    const PageEntry& entry(int layer, glm::ivec2 page) const {
        return table[(std::size_t(layer) * std::size_t(table_side) + std::size_t(page.y)) * std::size_t(table_side) +
                     std::size_t(page.x)];
    }
};

class PageCache {
public:
    /// Finds a place for every page that is wanted, and for no more than `most` unless the coarsest levels alone are
    /// more: pages of the finest level give way to the coarser ones that hold them, whatever is kept.
    /// @param wanted a byte a page, laid out as PageChoice::table; not 0: it is
    /// @param key_of of all that a page's contents depend on; equal keys are one page
    PageChoice choose_pages(const std::vector<PageGrid>& grids, const std::vector<std::uint8_t>& wanted, int table_side,
                            int most, const std::function<std::uint64_t(int layer, glm::ivec2 page)>& key_of);
    /// Pages along the pool's side. Grows, which loses all pages, where choose_pages() needs it.
    int side() const { return side_; }
    int held() const { return int(by_key_.size()); }
    int room() const { return int(slots_.size()); }
    void clear();

private:
    struct Slot {
        std::uint64_t key = 0, last_read = 0;
    };
    void grow_pool(int pages);
    int side_ = 0;
    std::vector<Slot> slots_;
    std::unordered_map<std::uint64_t, std::size_t> by_key_;
    std::uint64_t frames_ = 0;
};

}  // namespace si
