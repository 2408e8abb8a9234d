// Visibility that is traced so far, for pictures of a reference while it is being traced.
#pragma once

#include <atomic>
#include <mutex>
#include <vector>

#include "renderer/base/float_image.h"
#include "renderer/frame/frame.h"
#include "renderer/reference/reference.h"

namespace si {

/// Visibility of all pixels that a running trace has finished so far, for showing the reference while it is traced.
/// Tracing threads add tiles while another thread reads. Under an area light, tiles are added again with less noise.
class TracedSoFar {
public:
    /// Adds the visibility of one tile's pixels from a reference that is still being traced. References of all calls
    /// must have equal sizes.
    /// @param first the tile's upper left pixel
    /// @param end the pixel after the tile's lower right one
    void add_tile(const Reference& reference, glm::ivec2 first, glm::ivec2 end);
    /// Returns the share of the reference's pixels that were traced at least once, 0 to 1.
    double share() const;
    /// Returns the number of tiles (squares of pixels) added so far, which grows with each change of the picture.
    std::size_t tiles() const { return tiles_; }
    /// Returns a picture of the visibility traced so far, in the sequential colour scale of the overlays, top row
    /// first. Pixels without a surface or not traced yet have alpha 0. Empty before the first tile.
    ByteImage picture() const;

private:
    mutable std::mutex lock_;
    int width_ = 0, height_ = 0;
    std::vector<std::uint8_t> pixels_;  ///< 0 not traced, 1 no surface, else 2 + 253 * visibility
    std::size_t known_ = 0;
    std::atomic<std::size_t> tiles_ = 0;
};

}  // namespace si
