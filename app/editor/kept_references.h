// Traced references of views that were shown before, so that a view that comes back needs no rays.
#pragma once

#include <cstdint>
#include <list>
#include <memory>

#include "renderer/reference/reference_picture.h"

namespace si {

/// Traced references by their key, within a limit of memory. The least recently used ones are dropped first.
class KeptReferences {
public:
    /// Makes an empty store. @param max_bytes limit of the images and receivers of all references; the latest reference
    /// is kept in any case
    explicit KeptReferences(std::uint64_t max_bytes = std::uint64_t(512) << 20) : max_bytes_(max_bytes) {}

    /// Stores a reference. References of other rays are dropped: the casters have changed.
    void add(std::shared_ptr<const ReferencePicture> picture);
    /// Returns the reference with this ReferencePicture::key, and marks it as used; null: it is not kept.
    std::shared_ptr<const ReferencePicture> find(std::uint64_t key);
    /// Drops all references.
    void clear() { pictures_.clear(); }
    /// Returns the number of kept references.
    std::size_t size() const { return pictures_.size(); }

private:
    std::uint64_t max_bytes_;
    std::list<std::shared_ptr<const ReferencePicture>> pictures_;  ///< latest first
};

}  // namespace si
