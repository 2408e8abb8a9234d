// Names of what a frame leaves out or keeps without changing a byte of its picture, and sets of them.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace si {

/// In the order of savings() (renderer/optimisations/optimisations.h).
enum class Optimisation {
    DeadPasses,           ///< passes and look-ups that the scene does not call for
    BlockerSearch,        ///< searches for what casts a penumbra, where none can open
    EarlyOut,             ///< taps, where the depths about a look-up answer it
    BackFacingReceivers,  ///< look-ups whose light does not reach the picture
    DrawOrder,            ///< shading of what is hidden, by drawing what is near first and what is large last
    FrustumCulling,       ///< objects that no pixel of the picture can show
    FusedVisibility,      ///< visibility as a pass of its own, where nothing else reads it
    CasterBackFaces,      ///< of closed casters
    CasterCulling,        ///< of which nothing lies in a map
    UnreadViews,          ///< maps, and casters into them, of which no look-up of the picture reads anything
    StaticCasterCache,    ///< casters that did not move, where others did
    CasterFragments,      ///< work on fragments of casters that have no stray ones
    kCount
};
inline constexpr std::size_t kOptimisations = std::size_t(Optimisation::kCount);

/// Some of the optimisations.
class OptimisationSet {
public:
    OptimisationSet() = default;
    OptimisationSet(std::initializer_list<Optimisation> some) {
        for (const Optimisation s : some) add(s);
    }
    static OptimisationSet all() {
        OptimisationSet set;
        set.bits_.set();
        return set;
    }
    OptimisationSet& add(Optimisation s) {
        bits_.set(std::size_t(s));
        return *this;
    }
    bool contains(Optimisation s) const { return bits_.test(std::size_t(s)); }
    bool empty() const { return bits_.none(); }
    std::uint64_t value() const { return bits_.to_ullong(); }  ///< for keys
    bool operator==(const OptimisationSet&) const = default;

private:
    std::bitset<kOptimisations> bits_;
};

}  // namespace si
