#include "renderer/view/culling/draw_order.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <tuple>

namespace si {
namespace {

/// Largest numbers of box tests and of pairs found: some milliseconds of work.
constexpr std::size_t kMaxBoxTests = 1'000'000, kMaxPairs = 200'000;

/// Up to kMaxUnsteppedBoxes each box has a rank of its own; above, distances are quantised to kSteps.
constexpr std::size_t kMaxUnsteppedBoxes = 512, kSteps = 32;

Bounds upright(const SkewBox& box, double room_m) {
    glm::dvec3 half(room_m);
    for (int i = 0; i < 3; ++i) half += glm::abs(box.half[i]);
    return {box.centre - half, box.centre + half};
}

/// Returns the rank of each visible box by distance.
std::vector<std::uint32_t> steps_of(std::span<const SortedBox> boxes) {
    std::vector<std::uint32_t> seen;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        if (boxes[i].seen) seen.push_back(i);
    std::stable_sort(seen.begin(), seen.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return boxes[a].far_m < boxes[b].far_m; });
    std::vector<std::uint32_t> steps(boxes.size(), 0);
    const std::size_t a_step = seen.size() <= kMaxUnsteppedBoxes ? 1 : (seen.size() + kSteps - 1) / kSteps;
    for (std::size_t i = 0; i < seen.size(); ++i) steps[seen[i]] = std::uint32_t(i / a_step);
    return steps;
}

}  // namespace

std::optional<std::vector<BoxPair>> touching_boxes(std::span<const SkewBox> boxes, double room_m) {
    std::vector<Bounds> bounds;
    bounds.reserve(boxes.size());
    for (const SkewBox& box : boxes) bounds.push_back(upright(box, room_m));
    std::vector<std::uint32_t> by_start(boxes.size());
    std::iota(by_start.begin(), by_start.end(), 0u);
    std::sort(by_start.begin(), by_start.end(),
              [&](std::uint32_t a, std::uint32_t b) { return bounds[a].lo.x < bounds[b].lo.x; });
    std::vector<BoxPair> pairs;
    std::vector<std::uint32_t> open;  // boxes that start before the current one and have not ended
    std::size_t tests = 0;
    for (const std::uint32_t i : by_start) {
        const Bounds& b = bounds[i];
        tests += open.size() + 1;
        if (tests > kMaxBoxTests) return std::nullopt;
        std::erase_if(open, [&](std::uint32_t other) { return bounds[other].hi.x < b.lo.x; });
        for (const std::uint32_t other : open) {
            const Bounds& o = bounds[other];
            // Comparisons with NaN fail, so a box with NaN touches all.
            const bool apart = o.hi.y < b.lo.y || b.hi.y < o.lo.y || o.hi.z < b.lo.z || b.hi.z < o.lo.z;
            if (!apart) pairs.emplace_back(std::min(i, other), std::max(i, other));
        }
        if (pairs.size() > kMaxPairs) return std::nullopt;
        open.push_back(i);
    }
    return pairs;
}

std::vector<std::uint32_t> sort_front_to_back(std::span<const SortedBox> boxes, std::span<const BoxPair> touching) {
    const std::vector<std::uint32_t> steps = steps_of(boxes);
    // Lists of the later partner of each pair, by earlier partner, and the number of earlier partners that a box waits
    // for.
    std::vector<std::uint32_t> first(boxes.size() + 1, 0), later(touching.size()), waits(boxes.size(), 0);
    const auto counts = [&](const BoxPair& p) {
        return boxes[p.first].seen && boxes[p.second].seen && boxes[p.first].group == boxes[p.second].group;
    };
    for (const BoxPair& p : touching)
        if (counts(p)) ++first[p.first + 1], ++waits[p.second];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (const BoxPair& p : touching)
        if (counts(p)) later[next[p.first]++] = p.second;

    using Rank = std::tuple<int, std::uint32_t, std::uint32_t>;  // group, step, index
    std::priority_queue<Rank, std::vector<Rank>, std::greater<>> ready;
    const auto offer = [&](std::uint32_t i) { ready.emplace(boxes[i].group, steps[i], i); };
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        if (boxes[i].seen && waits[i] == 0) offer(i);
    std::vector<std::uint32_t> order;
    while (!ready.empty()) {
        const std::uint32_t i = std::get<2>(ready.top());
        ready.pop();
        order.push_back(i);
        for (std::uint32_t k = first[i]; k < first[i + 1]; ++k)
            if (--waits[later[k]] == 0) offer(later[k]);
    }
    return order;
}

}  // namespace si
