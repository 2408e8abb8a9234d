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

/// Square grid of the pages of one layer (view) of a virtual shadow map, counted from the lower left.
struct PageGrid {
    int side = 0;      ///< pages along a side
    int coarser = -1;  ///< layer of the next coarser level of the same light; -1: none
    /// Position of the first page among all pages of its level; pages of the coarser level are twice as wide.
    glm::i64vec2 corner{0};
};

/// Entry of the page table of virtual shadow maps, which shaders read: place of a page in the pool, the texture of all
/// kept pages (shared/pages.h).
struct PageEntry {
    glm::u16vec2 at{0};        ///< place in the pool, in pages
    glm::u8vec2 part{0};       ///< position within a coarser page, in pages of this level
    std::uint8_t state = 0;    ///< one of the states in shared/pages.h
    std::uint8_t coarser = 0;  ///< number of levels up to the page that replaces this one
};
static_assert(sizeof(PageEntry) == 8);

/// Page of a virtual shadow map with its place in the pool (texture of all kept pages) and the cache key of its
/// contents.
struct PlacedPage {
    int layer = 0;
    glm::ivec2 page{0};  ///< position in the layer's grid
    glm::ivec2 at{0};    ///< place in the pool, in pages
    std::size_t slot = 0;
    std::uint64_t key = 0;
};

/// Choice of the virtual shadow map pages for one frame: pages that the frame reads, those among them to draw, and the
/// page table.
struct PageChoice {
    std::vector<PageEntry> table;  ///< layer by layer, each `table_side` rows and columns
    int table_side = 0;
    std::vector<PlacedPage> read;    ///< pages to read, once for each layer that uses them
    std::vector<std::size_t> drawn;  ///< indices in `read` of the pages to draw
    int wanted = 0, coarser = 0, evicted = 0;
    std::vector<int> wanted_by_layer;
    /// Returns the index of a virtual shadow map page in the page table.
    /// @param page column and row in the layer's grid
    std::size_t index(int layer, glm::ivec2 page) const {
        return (std::size_t(layer) * std::size_t(table_side) + std::size_t(page.y)) * std::size_t(table_side) +
               std::size_t(page.x);
    }
    /// Returns the page table's entry of a virtual shadow map page.
    const PageEntry& entry(int layer, glm::ivec2 page) const { return table[index(layer, page)]; }
};

/// Cache of virtual shadow map pages by content key (hash of all that a page's depths depend on). The least recently
/// read pages are evicted first.
class PageCache {
public:
    /// Assigns a place in the pool of virtual shadow map pages to every wanted page, and decides which pages to draw.
    /// If more than `most` pages are wanted, pages of the finest levels are replaced by the coarser pages that contain
    /// them. The coarsest level is always kept.
    /// @param grids grids of pages by layer
    /// @param wanted a byte for each page, laid out as PageChoice::table; 0: not wanted
    /// @param table_side rows and columns of a layer's table
    /// @param most largest number of pages to place
    /// @param key_of returns the hash of everything that a page's contents depend on; pages with equal keys are shared
    PageChoice choose_pages(const std::vector<PageGrid>& grids, const std::vector<std::uint8_t>& wanted, int table_side,
                            int most, const std::function<std::uint64_t(int layer, glm::ivec2 page)>& key_of);
    /// Returns the number of pages along one side of the pool of virtual shadow map pages. choose_pages() may resize
    /// the pool, which drops all pages.
    int side() const { return side_; }
    /// Returns the number of virtual shadow map pages that the pool holds now.
    int held() const { return int(by_key_.size()); }
    /// Returns the capacity of the pool of virtual shadow map pages, in pages.
    int room() const { return int(slots_.size()); }
    /// Drops all pages from the cache of virtual shadow map pages. The next call of choose_pages() chooses the size of
    /// the pool again.
    void clear();

private:
    /// Place for one page in the pool of virtual shadow map pages: key of the page, and number of the frame that read
    /// it last.
    struct Slot {
        std::uint64_t key = 0, last_read = 0;
    };
    /// Gives the pool of virtual shadow map pages a capacity. A new size drops all pages. While `most` stays, the pool
    /// never shrinks.
    /// @param most requested capacity in pages
    /// @param needed pages of this frame, which may be more
    void resize_pool(int most, int needed);
    int side_ = 0;
    int most_ = 0;  ///< requested capacity of the pool
    std::vector<Slot> slots_;
    std::unordered_map<std::uint64_t, std::size_t> by_key_;
    std::uint64_t frames_ = 0;
};

}  // namespace si
