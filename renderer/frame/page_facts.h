// Cost of virtual shadow maps in a frame, compared with an unpaged map of equal texel size.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace si {

/// Statistics of the pages of virtual shadow maps in one frame, over all lights: pages wanted, drawn, cached and
/// stored.
struct PageFacts {
    int page_texels = 0;          ///< texels along a page's side
    int wanted = 0;               ///< pages that look-ups may read
    int drawn = 0, kept = 0;      ///< pages in use: drawn for this frame, cached from earlier
    int coarser = 0;              ///< wanted pages replaced by coarser ones, as the pool is full
    int evicted = 0;              ///< cached pages dropped to make room
    int held = 0, pool = 0;       ///< pages stored in the pool; capacity of the pool
    std::vector<int> by_level;    ///< wanted pages per level, finest first, of the light with the most wanted pages
    double smallest_texel_m = 0;  ///< texel size of the finest level in use, metres; perspective: at the far plane
    /// Number of texels of unpaged maps with equal texel size. A light with clip levels has one map over the widest
    /// square of read pages, at its finest texel size. Other lights have the whole map of each view in use.
    double fixed_map_texels = 0;
    /// Returns the number of texels of all virtual shadow map pages in use.
    std::uint64_t read_texels() const { return texels(drawn + kept); }
    /// Returns the number of texels of the virtual shadow map pages drawn for this frame.
    std::uint64_t drawn_texels() const { return texels(drawn); }

private:
    /// Returns the number of texels in `pages` pages of a virtual shadow map.
    std::uint64_t texels(int pages) const { return std::uint64_t(pages) * std::uint64_t(page_texels) * page_texels; }
};

/// Returns one line about a frame's pages of virtual shadow maps: "214 pages requested, 12 drawn, 202 cached; ..."
std::string page_facts_text(const PageFacts& facts);

}  // namespace si
