#include "renderer/view/culling/map_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace si {
namespace {

constexpr std::uint64_t kFullRow = ~std::uint64_t(0);
static_assert(MapCells::kCells == 64, "a row of cells is one 64-bit word");

/// Range of cells that a rectangle overlaps.
struct CellRange {
    int first_row, last_row;
    std::uint64_t columns;
};

int cell_of(double u) {
    return int(std::clamp(std::floor(u * MapCells::kCells), 0.0, MapCells::kCells - 1.0));
}

CellRange cells_of(const Bounds2& rect) {
    const int from = cell_of(rect.lo.x), to = cell_of(rect.hi.x);
    const std::uint64_t columns = (kFullRow << from) & (kFullRow >> (MapCells::kCells - 1 - to));
    return {cell_of(rect.lo.y), cell_of(rect.hi.y), columns};
}

bool lies_beyond(const Bounds2& rect) {
    return rect.hi.x < 0 || rect.hi.y < 0 || rect.lo.x > 1 || rect.lo.y > 1;
}

}  // namespace

std::optional<Bounds2> projected_rect(const SkewBox& box, const glm::dmat4& uvd_from_relative, const glm::dvec3& origin,
                                      double min_w) {
    const glm::dvec4 centre = uvd_from_relative * glm::dvec4(box.centre - origin, 1);
    std::array<glm::dvec4, 3> half;
    for (int i = 0; i < 3; ++i) half[std::size_t(i)] = uvd_from_relative * glm::dvec4(box.half[i], 0);
    Bounds2 rect;
    for (unsigned corner = 0; corner < 8; ++corner) {
        glm::dvec4 h = centre;
        for (unsigned i = 0; i < 3; ++i) h += corner >> i & 1 ? half[i] : -half[i];
        if (!(h.w > min_w)) return std::nullopt;
        rect.add(glm::dvec2(h) / h.w);
    }
    return rect;
}

MapCells MapCells::whole() {
    MapCells all;
    all.rows_.fill(kFullRow);
    return all;
}

bool MapCells::empty() const {
    return std::ranges::all_of(rows_, [](std::uint64_t row) { return row == 0; });
}

bool MapCells::is_whole() const {
    return std::ranges::all_of(rows_, [](std::uint64_t row) { return row == kFullRow; });
}

bool MapCells::contains(const MapCells& other) const {
    for (std::size_t i = 0; i < rows_.size(); ++i)
        if (other.rows_[i] & ~rows_[i]) return false;
    return true;
}

bool MapCells::overlaps(const Bounds2& rect) const {
    if (lies_beyond(rect)) return false;
    const CellRange cells = cells_of(rect);
    for (int row = cells.first_row; row <= cells.last_row; ++row)
        if (rows_[std::size_t(row)] & cells.columns) return true;
    return false;
}

void MapCells::add(const Bounds2& rect, bool clamp) {
    if (lies_beyond(rect) && !clamp) return;
    const CellRange cells = cells_of(rect);
    for (int row = cells.first_row; row <= cells.last_row; ++row) rows_[std::size_t(row)] |= cells.columns;
}

void MapCells::add_border_cells() {
    rows_.front() = rows_.back() = kFullRow;
    for (std::uint64_t& row : rows_) row |= std::uint64_t(1) | std::uint64_t(1) << (kCells - 1);
}

void MapCells::add(const MapCells& other) {
    for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i] |= other.rows_[i];
}

std::vector<TexelRect> MapCells::texel_rects(MapSize size) const {
    const auto first = [](int cell, int side) { return int(std::int64_t(cell) * side / kCells); };
    const auto end = [](int cell, int side) { return int((std::int64_t(cell) * side + kCells - 1) / kCells); };
    std::vector<TexelRect> out;
    for (int row = 0, next; row < kCells; row = next) {
        std::uint64_t left = rows_[std::size_t(row)];
        for (next = row + 1; next < kCells && rows_[std::size_t(next)] == left;) ++next;
        while (left) {
            const int from = std::countr_zero(left), to = from + std::countr_one(left >> from);
            out.push_back(
                {{first(from, size.width), first(row, size.height)}, {end(to, size.width), end(next, size.height)}});
            left &= to < kCells ? kFullRow << to : 0;
        }
    }
    return out;
}

}  // namespace si
