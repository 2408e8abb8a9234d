#include "renderer/passes/page_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "renderer/frame/page_facts.h"
#include "renderer/view/cascades/clip_levels.h"
#include "shaders/shared/pages.h"

namespace si {
namespace {

using Place = std::pair<int, int>;           // y and x of a page in its grid
using Pages = std::vector<std::set<Place>>;  // by layer

/// Finds the page of the next coarser level that contains a page. Returns false if there is none.
bool coarser_page(const std::vector<PageGrid>& grids, int layer, glm::ivec2 page, int& coarser, glm::ivec2& of) {
    const PageGrid& grid = grids[std::size_t(layer)];
    coarser = grid.coarser;
    if (coarser < 0) return false;
    const PageGrid& next = grids[std::size_t(coarser)];
    const glm::i64vec2 at = grid.corner + glm::i64vec2(page);
    const glm::i64vec2 in = glm::i64vec2(floor_div(at.x, 2), floor_div(at.y, 2)) - next.corner;
    of = glm::ivec2(in);
    return in.x >= 0 && in.y >= 0 && in.x < next.side && in.y < next.side;
}

/// Drops pages of the finest levels until `most` are left. Pages that share a coarser page are dropped together.
void drop_finest_pages(const std::vector<PageGrid>& grids, Pages& pages, std::size_t most) {
    std::size_t total = 0;
    for (const auto& layer : pages) total += layer.size();
    // Levels of all lights are dropped together, the finest of each first.
    std::vector<int> depth(grids.size(), 0);  // number of finer levels
    int deepest = 0;
    for (std::size_t i = 0; i < grids.size(); ++i)
        if (grids[i].coarser >= 0) depth[std::size_t(grids[i].coarser)] = depth[i] + 1;
    for (const int d : depth) deepest = std::max(deepest, d);
    for (int level = 0; level <= deepest && total > most; ++level)
        for (std::size_t layer = 0; layer < grids.size() && total > most; ++layer) {
            if (depth[layer] != level || grids[layer].coarser < 0) continue;
            std::map<Place, std::vector<Place>> by_coarser;
            for (const Place& p : pages[layer]) {
                int coarser = 0;
                glm::ivec2 of;
                if (coarser_page(grids, int(layer), {p.second, p.first}, coarser, of))
                    by_coarser[{of.y, of.x}].push_back(p);
            }
            for (const auto& [of, parts] : by_coarser) {
                if (total <= most) break;
                for (const Place& p : parts) pages[layer].erase(p);
                total -= parts.size();
                total += pages[std::size_t(grids[layer].coarser)].insert(of).second;
            }
        }
}

}  // namespace

void PageCache::clear() {
    by_key_.clear();
    slots_.clear();
    side_ = 0;
}

void PageCache::resize_pool(int most, int needed) {
    const int pages = std::max(most, needed);
    if (most == most_ && pages <= room()) return;
    most_ = most;
    const int side = int(std::ceil(std::sqrt(double(pages))));
    if (side == side_) return;
    side_ = side;
    slots_.assign(std::size_t(side_) * std::size_t(side_), {});
    by_key_.clear();
}

PageChoice PageCache::choose_pages(const std::vector<PageGrid>& grids, const std::vector<std::uint8_t>& wanted,
                                   int table_side, int most,
                                   const std::function<std::uint64_t(int layer, glm::ivec2 page)>& key_of) {
    PageChoice out;
    out.table_side = table_side;
    out.table.assign(wanted.size(), {});
    out.wanted_by_layer.assign(grids.size(), 0);
    Pages pages(grids.size());
    for (int layer = 0; layer < int(grids.size()); ++layer)
        for (int y = 0; y < grids[std::size_t(layer)].side; ++y)
            for (int x = 0; x < grids[std::size_t(layer)].side; ++x)
                if (wanted[out.index(layer, {x, y})]) {
                    pages[std::size_t(layer)].insert({y, x});
                    ++out.wanted_by_layer[std::size_t(layer)];
                    ++out.wanted;
                }
    drop_finest_pages(grids, pages, std::size_t(std::max(most, 1)));

    std::size_t total = 0;
    for (const auto& layer : pages) total += layer.size();
    resize_pool(std::max(most, 1), int(total));
    ++frames_;
    for (int layer = 0; layer < int(grids.size()); ++layer)
        for (const auto& [y, x] : pages[std::size_t(layer)]) {
            PlacedPage page{layer, {x, y}, {}, 0, key_of(layer, {x, y})};
            if (const auto found = by_key_.find(page.key); found != by_key_.end())
                slots_[found->second].last_read = frames_;
            out.read.push_back(page);
        }
    // Least recently read pages are evicted first; the choice does not change any picture.
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < slots_.size(); ++i)
        if (slots_[i].last_read != frames_) free.push_back(i);
    std::stable_sort(free.begin(), free.end(),
                     [&](std::size_t a, std::size_t b) { return slots_[a].last_read < slots_[b].last_read; });
    std::size_t next = 0;
    std::set<std::size_t> drawn_slots;
    for (std::size_t i = 0; i < out.read.size(); ++i) {
        PlacedPage& page = out.read[i];
        if (const auto found = by_key_.find(page.key); found != by_key_.end()) {
            page.slot = found->second;  // kept, or the same as another that was just placed
        } else {
            page.slot = free[next++];
            Slot& slot = slots_[page.slot];
            if (slot.key) {
                by_key_.erase(slot.key);
                ++out.evicted;
            }
            slot = {page.key, frames_};
            by_key_[page.key] = page.slot;
            drawn_slots.insert(page.slot);
            out.drawn.push_back(i);
        }
        page.at = {int(page.slot) % side_, int(page.slot) / side_};
        PageEntry& entry = out.table[out.index(page.layer, page.page)];
        entry = {glm::u16vec2(page.at), {}, std::uint8_t(shared::PAGE_CACHED), 0};
        if (drawn_slots.contains(page.slot)) entry.state = std::uint8_t(shared::PAGE_DRAWN);
    }
    // Dropped pages are found in the coarser page that contains them.
    for (int layer = 0; layer < int(grids.size()); ++layer)
        for (int y = 0; y < grids[std::size_t(layer)].side; ++y)
            for (int x = 0; x < grids[std::size_t(layer)].side; ++x) {
                PageEntry& entry = out.table[out.index(layer, {x, y})];
                if (!wanted[out.index(layer, {x, y})] || entry.state != shared::PAGE_ABSENT) continue;
                int at_layer = layer, up = 0;
                glm::ivec2 at(x, y);
                const glm::i64vec2 grid_page = grids[std::size_t(layer)].corner + glm::i64vec2(x, y);
                while (coarser_page(grids, at_layer, at, at_layer, at)) {
                    ++up;
                    const PageEntry& coarser = out.table[out.index(at_layer, at)];
                    if (coarser.state == shared::PAGE_ABSENT || coarser.coarser != 0) continue;
                    const glm::i64 parts = glm::i64(1) << up;
                    entry = coarser;
                    entry.coarser = std::uint8_t(up);
                    entry.part = glm::u8vec2(glm::i64vec2(grid_page.x - floor_div(grid_page.x, parts) * parts,
                                                          grid_page.y - floor_div(grid_page.y, parts) * parts));
                    ++out.coarser;
                    break;
                }
            }
    return out;
}

std::string page_facts_text(const PageFacts& p) {
    std::string out = fmt::format("{} pages requested, {} drawn, {} cached", p.wanted, p.drawn, p.kept);
    if (p.coarser > 0) out += fmt::format(", {} replaced by coarser ones", p.coarser);
    if (p.evicted > 0) out += fmt::format(", {} evicted", p.evicted);
    return out + fmt::format("; {:.3g} M texels drawn, {:.3g} M read; an unpaged map of equal texel size has {:.4g} M",
                             1e-6 * double(p.drawn_texels()), 1e-6 * double(p.read_texels()),
                             1e-6 * p.fixed_map_texels);
}

}  // namespace si
