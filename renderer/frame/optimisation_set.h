// The optimisations of a frame, and sets of them. An optimisation skips or caches work without changing a byte of the
// picture.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace si {

/// Optimisation that skips or reuses work of a frame without changing a byte of the picture. Values follow the rows in
/// renderer/optimisations/optimisations.h.
enum class Optimisation {
    DeadPasses,           ///< skips passes and look-ups that nothing needs
    BlockerSearch,        ///< skips the blocker search where no penumbra can open
    EarlyOut,             ///< skips taps where depth bounds of the map decide
    BackFacingReceivers,  ///< skips look-ups on surfaces that receive no light
    DepthOrder,           ///< draws objects front to back
    FrustumCulling,       ///< skips objects outside the view frustum
    FusedVisibility,      ///< evaluates visibility in the shading pass
    CasterBackFaces,      ///< skips back faces of closed casters
    CasterCulling,        ///< skips casters outside a map
    UnreadViews,          ///< skips maps, and casters in them, that no look-up of the picture reads
    StaticCasterCache,    ///< caches casters that stand still while others move
    CasterFragments,      ///< skips the fragment shader of opaque casters
    kCount
};
/// Number of optimisations.
inline constexpr std::size_t kOptimisations = std::size_t(Optimisation::kCount);

/// Set of optimisations, such as those that a frame request switches off (FrameRequest::forced).
class OptimisationSet {
public:
    /// Makes an empty set of optimisations.
    OptimisationSet() = default;
    /// Makes a set of the listed optimisations.
    OptimisationSet(std::initializer_list<Optimisation> some) {
        for (const Optimisation s : some) add(s);
    }
    /// Returns the set of all optimisations.
    static OptimisationSet all() {
        OptimisationSet set;
        set.bits_.set();
        return set;
    }
    /// Adds an optimisation to the set, and returns the set for chaining.
    OptimisationSet& add(Optimisation s) {
        bits_.set(std::size_t(s));
        return *this;
    }
    /// Puts an optimisation into the set or takes it out.
    void set(Optimisation s, bool in) { bits_.set(std::size_t(s), in); }
    /// Returns true when an optimisation is in the set.
    bool contains(Optimisation s) const { return bits_.test(std::size_t(s)); }
    /// Returns true when the set holds no optimisation.
    bool empty() const { return bits_.none(); }
    /// Returns the set of optimisations as a number for cache keys, one bit each.
    std::uint64_t value() const { return bits_.to_ullong(); }
    bool operator==(const OptimisationSet&) const = default;

private:
    std::bitset<kOptimisations> bits_;
};

}  // namespace si
