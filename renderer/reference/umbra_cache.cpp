#include "renderer/reference/umbra_cache.h"

namespace si {

std::vector<UmbraCache::State> UmbraCache::find(std::uint64_t key, std::size_t pixels) const {
    const std::lock_guard guard(lock_);
    for (const Known& k : known_)
        if (k.key == key) return k.states;
    return std::vector<State>(pixels, State::Unknown);
}

void UmbraCache::store(std::uint64_t key, std::vector<State> states) {
    const std::lock_guard guard(lock_);
    std::erase_if(known_, [&](const Known& k) { return k.key == key; });
    known_.push_back({key, std::move(states)});
    if (known_.size() > kMaxReaches) known_.erase(known_.begin());
}

}  // namespace si
