// Cache of virtual shadow map pages in a pool: placement, eviction, and choice of pages to draw. Has no OpenGL, for
// tests without a context.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/type_precision.hpp>
#include <unordered_map>
#include <vector>

namespace si {

/// Grid of pages of one layer of a virtual map: square, from the lower left.
struct PageGrid {
    int side = 0;      ///< pages along a side
    int coarser = -1;  ///< layer of the next coarser level of the same light; -1: none
    /// Position of the first page among all pages of its level; pages of the coarser level are twice as wide.
    glm::i64vec2 corner{0};
};

/// Entry of the page table that shaders read: place of a page in the pool (shared/pages.h).
struct PageEntry {
    glm::u16vec2 at{0};        ///< place in the pool, in pages
    glm::u8vec2 part{0};       ///< position within a coarser page, in pages of this level
    std::uint8_t state = 0;    ///< one of the states in shared/pages.h
    std::uint8_t coarser = 0;  ///< number of levels up to the page that replaces this one
};
static_assert(sizeof(PageEntry) == 8);

/// Page of a virtual map with its place in the pool and its content key.
struct PlacedPage {
    int layer = 0;
    glm::ivec2 page{0};  ///< position in the layer's grid
    glm::ivec2 at{0};    ///< place in the pool, in pages
    std::size_t slot = 0;
    std::uint64_t key = 0;
};

/// Pages of the pool that one frame reads, those to draw, and the page table.
struct PageChoice {
    std::vector<PageEntry> table;  ///< layer by layer, each `table_side` rows and columns
    int table_side = 0;
    std::vector<PlacedPage> read;    ///< pages to read, once for each layer that uses them
    std::vector<std::size_t> drawn;  ///< indices in `read` of the pages to draw
    int wanted = 0, coarser = 0, evicted = 0;
    std::vector<int> wanted_by_layer;
    /// Returns the index of a page in the table.
    /// @param page column and row in the layer's grid
    std::size_t index(int layer, glm::ivec2 page) const {
        return (std::size_t(layer) * std::size_t(table_side) + std::size_t(page.y)) * std::size_t(table_side) +
               std::size_t(page.x);
    }
    /// Returns the table entry of a page.
    const PageEntry& entry(int layer, glm::ivec2 page) const { return table[index(layer, page)]; }
};

/// Cache of virtual shadow map pages by content key, with least-recently-used eviction.
class PageCache {
public:
    /// Assigns a place in the pool to every wanted page. Where they are more than `most`, pages of the finest levels
    /// are replaced by the coarser pages that contain them. The coarsest level is always kept.
    /// @param wanted a byte for each page, laid out as PageChoice::table; 0: not wanted
    /// @param table_side rows and columns of a layer's table
    /// @param most the capacity in pages
    /// @param key_of hash of everything that a page's contents depend on; pages with equal keys are shared
    PageChoice choose_pages(const std::vector<PageGrid>& grids, const std::vector<std::uint8_t>& wanted, int table_side,
                            int most, const std::function<std::uint64_t(int layer, glm::ivec2 page)>& key_of);
    /// Returns the pages along the pool's side. choose_pages() may enlarge the pool, which drops all pages.
    int side() const { return side_; }
    /// Returns the number of pages in the pool.
    int held() const { return int(by_key_.size()); }
    /// Returns the capacity of the pool in pages.
    int room() const { return int(slots_.size()); }
    /// Drops all pages from the cache.
    void clear();

private:
    /// Place in the pool, with the key of its page and the frame that read it last.
    struct Slot {
        std::uint64_t key = 0, last_read = 0;
    };
    /// Enlarges the pool to hold this many pages, which drops all pages.
    void grow_pool(int pages);
    int side_ = 0;
    std::vector<Slot> slots_;
    std::unordered_map<std::uint64_t, std::size_t> by_key_;
    std::uint64_t frames_ = 0;
};

}  // namespace si
