// Which of a light's casters are taken to rest, so that they are drawn once into a map of their own, which is copied,
// and only what moves is drawn over it (Saving::Resting). No OpenGL: what is decided here is tested by itself.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/view/culling/map_cells.h"

namespace si {

/// A caster, by CasterContent. Several of one content lie in one place: depths of one are those of all.
struct StaticCandidate {
    std::uint64_t content = 0;
    std::uint64_t triangles = 0;  ///< of all that have it
    bool operator==(const StaticCandidate&) const = default;
};

/// Casters in the order of their content, each content once.
std::vector<StaticCandidate> group_by_content(std::span<const std::uint64_t> contents,
                                              std::span<const std::uint64_t> triangles);

/// What rests is kept apart where it has at least one in so many of all triangles. Beside 12 times as many that moved
/// all over the map it took 0.71 to 0.85 of drawing all on llvmpipe, 0.59 on zink (`bench
/// --benchmark_filter=moving_box`).
inline constexpr std::uint64_t kMaxTrianglesPerStatic = 16;

/// What one of a light's maps consists of.
struct StaticView {
    bool drawn = false;  ///< the map of what rests holds this view
    MapCells holds;      ///< what of it
    bool below = false;  ///< the light's map is a copy of it, with what moved drawn over it
    MapCells over;       ///< where that may lie
};

/// Of one light, from frame to frame.
class StaticCasters {
public:
    enum class Draws {
        All,    ///< nothing is kept apart
        Anew,   ///< what rests goes into the map of it, as it is not what that holds
        Moved,  ///< that map is kept
    };

    /// Says how a light's maps are drawn that hold these casters, and remembers them.
    /// @param of_views key of all that the maps depend on but their casters
    /// @param[out] reason a clause where all are drawn; empty: nothing has moved
    Draws choose(std::uint64_t of_views, std::vector<StaticCandidate> casters, std::string_view& reason);

    /// Whether a caster is in the map of what rests.
    bool rests(std::uint64_t content) const;
    /// Whether there is one for these views.
    bool keeps(std::uint64_t kept) const { return kept == views_ && !static_casters_.empty(); }
    void forget() { *this = {}; }

    std::vector<StaticView> views;  ///< by view of the light; none is drawn where resting casters were chosen anew

private:
    std::uint64_t views_ = 0;
    std::vector<StaticCandidate> last_;            ///< of the frame before
    std::vector<StaticCandidate> static_casters_;  ///< empty: there is no map of them
    /// Triangles that were drawn though they rested, as they moved when resting ones were chosen.
    std::uint64_t drawn_in_vain_ = 0;

    Draws choose_again(const std::vector<StaticCandidate>& rested, std::string_view& reason);
};

}  // namespace si
