#include "app/editor/kept_references.h"

#include <algorithm>
#include <utility>

namespace si {
namespace {

std::uint64_t bytes_of(const TracedReference& traced) {
    return traced.reference->held.bytes() + traced.receivers->held.bytes();
}

}  // namespace

void KeptReferences::add(std::shared_ptr<const ReferencePicture> picture) {
    std::erase_if(pictures_, [&](const auto& kept) {
        return kept->key == picture->key || kept->traced.scene != picture->traced.scene;
    });
    pictures_.push_front(std::move(picture));
    std::uint64_t bytes = 0;
    for (const auto& kept : pictures_) bytes += bytes_of(kept->traced);
    for (; bytes > max_bytes_ && pictures_.size() > 1; pictures_.pop_back())
        bytes -= bytes_of(pictures_.back()->traced);
}

std::shared_ptr<const ReferencePicture> KeptReferences::find(std::uint64_t key) {
    const auto found = std::ranges::find(pictures_, key, [](const auto& kept) { return kept->key; });
    if (found == pictures_.end()) return nullptr;
    pictures_.splice(pictures_.begin(), pictures_, found);
    return pictures_.front();
}

}  // namespace si
