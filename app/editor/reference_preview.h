// Picture of a ray-traced reference while it is being traced.
#pragma once

#include <chrono>

#include "renderer/frame/frame.h"
#include "renderer/gl/handle.h"
#include "renderer/reference/traced_so_far.h"

namespace si {

/// Texture that shows the pixels of a ray-traced reference while it is being traced. Needs a current OpenGL context.
class PreviewOfReference {
public:
    /// Uploads the pixels traced since the last call to the texture, at most five times a second. Returns true if the
    /// picture has changed. @param so_far pixels to show; null: no reference is being traced, and the picture is
    /// dropped
    bool update(const TracedSoFar* so_far);
    /// Returns the picture of the ray-traced reference, RGBA8 with alpha 0 where nothing is traced yet; empty: there is
    /// none.
    Image image() const { return {texture_.id(), size_.x, size_.y}; }

private:
    gl::Texture texture_, before_;  ///< `before_`: the texture before, which panels may still draw
    glm::ivec2 size_{0};
    const TracedSoFar* of_ = nullptr;
    std::size_t tiles_ = 0;  ///< TracedSoFar::tiles() in the picture
    std::chrono::steady_clock::time_point uploaded_;
};

}  // namespace si
