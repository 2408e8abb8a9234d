// Static casters of a light, drawn once into a cached map. Each frame copies the cached map and draws moving casters
// over it (Optimisation::StaticCasterCache). No OpenGL, so the decision can be tested alone.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/view/culling/map_cells.h"

namespace si {

/// Group of shadow casters with equal content keys (CasterContent): same mesh, place and state, hence the same depths
/// in a map. If none of them moves, the group can be drawn once and cached.
struct StaticCandidate {
    std::uint64_t content = 0;    ///< CasterContent key
    std::uint64_t triangles = 0;  ///< number of triangles of all casters with this content
    bool operator==(const StaticCandidate&) const = default;
};

/// Groups shadow casters with equal content keys (CasterContent) and sorts the groups by key. Casters with key 0, which
/// never cast, are left out.
/// @param contents,triangles content key and triangle count by caster
std::vector<StaticCandidate> group_by_content(std::span<const std::uint64_t> contents,
                                              std::span<const std::uint64_t> triangles);

/// Largest ratio of all triangles to static triangles at which the static casters of a light are cached. With 12 times
/// as many moving triangles over the whole map, the cache reduced the time to 0.71 to 0.85 on llvmpipe. On zink it was
/// 0.59 (`bench --benchmark_filter=moving_box`).
inline constexpr std::uint64_t kMaxTrianglesPerStatic = 16;

/// State of one map view (cascade or cube face) of a light whose static casters are drawn once into a cached map.
struct StaticView {
    bool cached = false;    ///< static casters of the view are in the cached map
    MapCells cached_cells;  ///< cells drawn in the cached map
    bool is_copy = false;   ///< the light's map is a copy of the cached map with moving casters over it
    MapCells moving_cells;  ///< cells with moving casters
};

/// Decision, frame by frame, which shadow casters of one light are static, and whether their map is cached.
class StaticCasters {
public:
    /// Choice of the casters that a frame draws into a light's map: all, static and moving ones separately, or moving
    /// ones alone.
    enum class Draws {
        All,              ///< all casters; there is no cache
        StaticAndMoving,  ///< static casters into the cached map, moving ones over its copy
        MovingOnly,       ///< moving casters over a copy of the cached map
    };

    /// Decides which casters of a light this frame draws: all, or moving ones over a cached map of static ones.
    /// Remembers the casters for the decision of the next frame.
    /// @param of_views cache key of all inputs of the light's maps except casters
    /// @param casters casters of this frame, from group_by_content()
    /// @param[out] reason clause that explains why all casters are drawn; unchanged if the views are new
    Draws choose(std::uint64_t of_views, std::vector<StaticCandidate> casters, std::string_view& reason);

    /// Returns true when a caster is in the cached map of a light's static casters.
    /// @param content content key of the caster
    bool is_static(std::uint64_t content) const;
    /// Returns true when a cached map of static casters exists for a cache key of the light's views.
    bool has_cache_for(std::uint64_t of_views) const { return of_views == views_ && !static_casters_.empty(); }
    /// Drops the light's static casters and their cached map, so that the next frame draws all casters.
    void reset() { *this = {}; }

    std::vector<StaticView> views;  ///< state by view; none is cached after static casters were chosen again

private:
    std::uint64_t views_ = 0;                      ///< cache key of the last frame's views
    std::vector<StaticCandidate> last_;            ///< casters of the frame before
    std::vector<StaticCandidate> static_casters_;  ///< casters in the cached map; empty without one
    /// Sum of the triangles of stopped casters that were drawn with the moving ones since the last refill of the cache.
    /// Once the sum exceeds the triangles of a refill, the cache is refilled.
    std::uint64_t drawn_in_vain_ = 0;

    /// Chooses the static casters of a light again: those that did not move. If all casters together have over
    /// kMaxTrianglesPerStatic times as many triangles as these, none is static. Call when a caster in the cached map
    /// has moved. Call also when casters that have stopped, but are still drawn with the moving ones, have taken as
    /// many triangles as refilling the cache would. Returns which casters the frame draws into the light's map.
    /// @param rested casters with the same content key in the last two frames
    /// @param[out] reason reason why no cache is made
    Draws choose_again(const std::vector<StaticCandidate>& rested, std::string_view& reason);
};

}  // namespace si
