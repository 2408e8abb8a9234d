// Traced references of views that were shown before, so that a view that comes back needs no rays.
#pragma once

#include <cstdint>
#include <list>
#include <memory>

#include "renderer/reference/reference_picture.h"

namespace si {

/// Cache of ray-traced references of earlier views, by ReferencePicture::key: a view that is shown again needs no rays.
/// Drops the least recently used references beyond a memory limit.
class KeptReferences {
public:
    /// Makes an empty cache. @param max_bytes memory limit of all stored references; the latest one is kept in any case
    explicit KeptReferences(std::uint64_t max_bytes = std::uint64_t(512) << 20) : max_bytes_(max_bytes) {}

    /// Stores a ray-traced reference. Drops stored ones that were traced against other casters, because they are out of
    /// date.
    void add(std::shared_ptr<const ReferencePicture> picture);
    /// Returns the stored reference with this ReferencePicture::key, and marks it as recently used; null: none is
    /// stored.
    std::shared_ptr<const ReferencePicture> find(std::uint64_t key);
    /// Drops all stored references.
    void clear() { pictures_.clear(); }
    /// Returns the number of stored references.
    std::size_t size() const { return pictures_.size(); }

private:
    std::uint64_t max_bytes_;
    std::list<std::shared_ptr<const ReferencePicture>> pictures_;  ///< latest first
};

}  // namespace si
