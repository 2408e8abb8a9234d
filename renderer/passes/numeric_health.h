// Pass that searches a frame's images for invalid numbers such as NaN, and read-back of its findings.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/numeric_health.h"
#include "renderer/frame/state.h"
#include "renderer/passes/page_cache.h"

namespace si {

class PagePasses;

/// Pages of one virtual shadow map that are searched for invalid numbers, and the name of the map for findings.
struct SearchedPages {
    NumberFinding place;
    std::vector<PlacedPage> pages;
};

/// Counts of invalid numbers in a pool of virtual shadow map pages, one tile for each page, as copied from the GPU.
struct PoolTiles {
    gl::Buffer read_back;  ///< copy of the tiles for the CPU
    glm::ivec2 tiles{0};   ///< columns and rows
    int page = 0;          ///< texels along a page's side
    std::vector<SearchedPages> layers;
};

/// Pass that searches the frame's shadow maps, moments, visibility, camera depth and matrices for NaN, infinity and
/// other invalid numbers.
class NumericHealthPass : public FramePass {
public:
    /// Deleter for smart pointers to OpenGL fences.
    struct DeleteSync {
        void operator()(GLsync sync) const { glDeleteSync(sync); }
    };
    /// Data of NumericHealthPass that stay between frames: GPU images and buffers of the search for invalid numbers,
    /// and its findings so far.
    struct Targets {
        gl::Target tiles, found;  ///< RGBA32UI, a layer for each kind of fault
        gl::Buffer read_back;     ///< copy of `found` for the CPU
        std::unique_ptr<__GLsync, DeleteSync> done;
        std::vector<NumberFinding> places;  ///< one for each column of `found`
        std::optional<PoolTiles> pool;
        NumericHealth so_far;  ///< findings of the CPU
        std::shared_ptr<const NumericHealth> health;
    };

    explicit NumericHealthPass(const PagePasses& pages) : pages_(pages) {}
    void declare(FrameState& f) override;
    /// Returns the invalid numbers that the last search found in a frame; null while the GPU has not finished the
    /// search, or before the first search.
    /// @param wait true: waits for the GPU, 60 s at most
    std::shared_ptr<const NumericHealth> read_result(bool wait);

private:
    Targets targets_;
    const PagePasses& pages_;
};

}  // namespace si
