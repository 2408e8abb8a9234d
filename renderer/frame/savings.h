// The table of what a frame leaves out or keeps without changing a byte of its picture. Each can be forced: two ways,
// one picture.
#pragma once

#include <bitset>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>

namespace si {

/// In the order of savings().
enum class Optimisation {
    Uncalled,   ///< passes and look-ups that the scene does not call for
    Blockers,   ///< searches for what casts a penumbra, where none can open
    EarlyOut,   ///< taps, where the depths about a look-up answer it
    Facing,     ///< look-ups whose light does not reach the picture
    Order,      ///< shading of what is hidden, by drawing what is near first and what is large last
    InSight,    ///< objects that no pixel of the picture can show
    Fused,      ///< visibility as a pass of its own, where nothing else reads it
    BackFaces,  ///< of closed casters
    Casters,    ///< of which nothing lies in a map
    Views,      ///< maps, and casters into them, of which no look-up of the picture reads anything
    Static,     ///< casters that did not move, where others did
    Fragments,  ///< work on fragments of casters that have no stray ones
    kCount
};
inline constexpr std::size_t kOptimisations = std::size_t(Optimisation::kCount);

struct OptimisationRow {
    std::string_view key, label;
    std::string_view help;  ///< what is left out, when, and why the picture cannot change; a sentence
};

std::span<const OptimisationRow> savings();
const OptimisationRow& row_of(Optimisation saving);
/// @throws Error naming the known keys
Optimisation parse_optimisation(std::string_view key);

/// Some of them.
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
