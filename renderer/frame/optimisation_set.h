// Names of the optimisations that leave a picture's bytes unchanged, and sets of them.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace si {

/// Optimisation that skips or reuses work of a frame without changing a byte of the picture. Values follow the rows in
/// renderer/optimisations/optimisations.h.
enum class Optimisation {
    DeadPasses,           ///< passes and look-ups without effect in this scene
    BlockerSearch,        ///< blocker searches of PCSS-like kernels where no penumbra can open
    EarlyOut,             ///< kernel taps, where depth bounds around a look-up decide the result
    BackFacingReceivers,  ///< look-ups of surfaces that the light does not reach
    DepthOrder,           ///< shading of hidden surfaces: near objects are drawn first, large ones last
    FrustumCulling,       ///< objects outside the camera's frustum
    FusedVisibility,      ///< the separate visibility pass, where only shading reads it
    CasterBackFaces,      ///< back faces of closed casters
    CasterCulling,        ///< casters outside a map
    UnreadViews,          ///< maps and casters that no look-up of the picture reads
    StaticCasterCache,    ///< redrawing of static casters while others move
    CasterFragments,      ///< fragment shading of casters without edge-on sides
    kCount
};
/// Number of optimisations.
inline constexpr std::size_t kOptimisations = std::size_t(Optimisation::kCount);

/// Set of optimisations, for example those that a frame has to disable.
class OptimisationSet {
public:
    OptimisationSet() = default;
    OptimisationSet(std::initializer_list<Optimisation> some) {
        for (const Optimisation s : some) add(s);
    }
    /// Returns the set of all optimisations.
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
    /// Returns the set as bits, for cache keys.
    std::uint64_t value() const { return bits_.to_ullong(); }
    bool operator==(const OptimisationSet&) const = default;

private:
    std::bitset<kOptimisations> bits_;
};

}  // namespace si
