#include "renderer/optimisations/static_casters.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace si {
namespace {

bool comes_before(const StaticCandidate& a, const StaticCandidate& b) {
    return a.content < b.content;
}

std::uint64_t triangles_of(std::span<const StaticCandidate> casters) {
    std::uint64_t sum = 0;
    for (const StaticCandidate& c : casters) sum += c.triangles;
    return sum;
}

}  // namespace

std::vector<StaticCandidate> group_by_content(std::span<const std::uint64_t> contents,
                                              std::span<const std::uint64_t> triangles) {
    std::vector<StaticCandidate> all, out;
    for (std::size_t i = 0; i < contents.size(); ++i)
        if (contents[i] != 0) all.push_back({contents[i], triangles[i]});
    std::ranges::sort(all, comes_before);
    for (const StaticCandidate& c : all)
        if (!out.empty() && out.back().content == c.content)
            out.back().triangles += c.triangles;
        else
            out.push_back(c);
    return out;
}

bool StaticCasters::is_static(std::uint64_t content) const {
    return std::ranges::binary_search(static_casters_, StaticCandidate{content}, comes_before);
}

StaticCasters::Draws StaticCasters::choose(std::uint64_t of_views, std::vector<StaticCandidate> casters,
                                           std::string_view& reason) {
    const std::vector<StaticCandidate> before = std::exchange(last_, std::move(casters));
    if (of_views != views_) {
        static_casters_.clear();
        views.clear();
        views_ = of_views;
        return Draws::All;
    }
    const bool holds = !static_casters_.empty() && std::ranges::includes(last_, static_casters_, comes_before);
    std::vector<StaticCandidate> rested;
    std::ranges::set_intersection(last_, before, std::back_inserter(rested), comes_before);
    if (!holds) {
        // A caster that has just moved may move again, and so may others: one frame without motion does not make them
        // static.
        std::vector<StaticCandidate> still;
        std::ranges::set_intersection(rested, static_casters_, std::back_inserter(still), comes_before);
        return choose_again(2 * triangles_of(still) >= triangles_of(rested) ? still : rested, reason);
    }
    // Casters that stop are drawn with the moving ones until that has cost as much as refilling the cache.
    drawn_in_vain_ += triangles_of(rested) - std::min(triangles_of(rested), triangles_of(static_casters_));
    return drawn_in_vain_ > triangles_of(rested) ? choose_again(rested, reason) : Draws::MovingOnly;
}

StaticCasters::Draws StaticCasters::choose_again(const std::vector<StaticCandidate>& rested, std::string_view& reason) {
    const bool pays = !rested.empty() && kMaxTrianglesPerStatic * triangles_of(rested) >= triangles_of(last_);
    drawn_in_vain_ = 0;
    static_casters_ = pays ? rested : std::vector<StaticCandidate>();
    views.clear();
    if (!pays && !last_.empty())
        reason =
            rested.empty()
                ? "all casters have moved"
                : "static casters have few triangles compared with moving ones: drawing them takes as long as a copy";
    return pays ? Draws::StaticAndMoving : Draws::All;
}

}  // namespace si
