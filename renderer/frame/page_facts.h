// What virtual shadow maps cost, beside a fixed map that is as sharp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace si {

/// Pages of all lights' maps in one frame.
struct PageFacts {
    int page_texels = 0;        ///< along a side
    int wanted = 0;             ///< pages that look-ups may read
    int drawn = 0, kept = 0;    ///< of those that the frame reads: drawn for it, drawn before
    int coarser = 0;            ///< wanted pages for which one of a coarser level stands, as the pool is full
    int evicted = 0;            ///< given up for those that were drawn
    int held = 0, pool = 0;     ///< pages in the pool, read or not; that it has room for
    std::vector<int> by_level;  ///< wanted, by view of the light that has most of them, finest first
    double finest_texel_m = 0;  ///< of the finest view that is read; of perspective views at their far planes
    /// Texels of one map a light with texels that fine, over the square that holds all that its look-ups read.
    double fixed_map_texels = 0;
    std::uint64_t read_texels() const { return texels(drawn + kept); }
    std::uint64_t drawn_texels() const { return texels(drawn); }

private:
    std::uint64_t texels(int pages) const { return std::uint64_t(pages) * std::uint64_t(page_texels) * page_texels; }
};

/// "214 pages requested, 12 drawn, 202 cached; ..."
std::string page_facts_text(const PageFacts& facts);

}  // namespace si
