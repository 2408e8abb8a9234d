#include "renderer/reference/light_map_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "renderer/base/angles.h"
#include "renderer/base/directions.h"
#include "renderer/base/error.h"

namespace si {
namespace {

constexpr int kMaxSideTexels = 16384;
constexpr std::uint32_t kNone = LightMapLayout::kNoChart;
constexpr std::size_t kTriedDirections = 24;  ///< rotations of a chart that are tried
constexpr int kDensitySteps = 24;             ///< bisection steps of the density

/// Neighbours of each triangle across its edges 01, 12 and 20; kNone: none, or more than one.
using Neighbours = std::vector<std::array<std::uint32_t, 3>>;

/// Finds the neighbours of all triangles. Vertices with equal positions count as one, whatever their other attributes.
Neighbours neighbours_of(const ReferenceMesh& mesh) {
    std::vector<std::uint32_t> order(mesh.positions.size()), welded(mesh.positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto rank = [&](std::uint32_t i) {
        const glm::vec3 p = mesh.positions[i] + 0.f;  // -0 becomes 0
        return std::array{p.x, p.y, p.z};
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
    for (std::size_t i = 0; i < order.size(); ++i)
        welded[order[i]] = i > 0 && rank(order[i]) == rank(order[i - 1]) ? welded[order[i - 1]] : order[i];
    struct Edge {
        std::uint32_t lo, hi, triangle, number;
    };
    std::vector<Edge> edges;
    edges.reserve(mesh.indices.size());
    for (std::uint32_t t = 0; t < mesh.triangles(); ++t)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t a = welded[mesh.indices[3 * std::size_t(t) + k]];
            const std::uint32_t b = welded[mesh.indices[3 * std::size_t(t) + (k + 1) % 3]];
            edges.push_back({std::min(a, b), std::max(a, b), t, k});
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::tuple(a.lo, a.hi, a.triangle, a.number) < std::tuple(b.lo, b.hi, b.triangle, b.number);
    });
    Neighbours out(mesh.triangles(), {kNone, kNone, kNone});
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i;
        while (end < edges.size() && edges[end].lo == edges[i].lo && edges[end].hi == edges[i].hi) ++end;
        if (end == i + 2) {
            out[edges[i].triangle][edges[i].number] = edges[i + 1].triangle;
            out[edges[i + 1].triangle][edges[i + 1].number] = edges[i].triangle;
        }
        i = end;
    }
    return out;
}

class LayoutBuilder {
public:
    LayoutBuilder(const ReferenceGeometry& geometry, int side, const Workers& workers)
        : geometry_(geometry), workers_(workers) {
        out_.side = side;
        if (!geometry.bounds.empty()) out_.centre = geometry.bounds.centre();
        std::uint32_t first = 0;
        for (const ReferenceObject& object : geometry.objects) {
            const auto count = std::uint32_t(object.mesh->triangles());
            out_.objects.push_back({first, count});
            first += count;
        }
        flat_only_.assign(first, false);
    }

    LightMapLayout build() {
        for (;;) {
            grow_charts();
            find_borders();
            pack();
            if (!take_apart_folded()) return std::move(out_);
        }
    }

private:
    const ReferenceGeometry& geometry_;
    const Workers& workers_;
    LightMapLayout out_;
    std::vector<bool> flat_only_;  ///< one per triangle: true when its chart overlapped itself
    std::map<const ReferenceMesh*, Neighbours> neighbours_;

    void stop_if_asked() const {
        if (workers_.stop.stop_requested()) throw Cancelled();
    }
    const Neighbours& neighbours(std::uint32_t object) {
        const ReferenceMesh* mesh = geometry_.objects[object].mesh.get();
        auto found = neighbours_.find(mesh);
        if (found == neighbours_.end()) found = neighbours_.emplace(mesh, neighbours_of(*mesh)).first;
        return found->second;
    }

    void grow_charts() {
        out_.chart_of.assign(flat_only_.size(), kNone);
        out_.charts.clear();
        out_.triangles.clear();
        std::vector<glm::dvec3> normals;
        for (std::uint32_t object = 0; object < out_.objects.size(); ++object) {
            stop_if_asked();
            const auto [first, count] = out_.objects[object];
            normals.resize(count);
            for (std::uint32_t t = 0; t < count; ++t) {
                const auto [a, b, c] = geometry_.triangle(object, t);
                normals[t] = unit_normal(a, b, c);
            }
            for (std::uint32_t t = 0; t < count; ++t)
                if (out_.chart_of[first + t] == kNone && normals[t] != glm::dvec3(0)) grow(object, t, normals);
        }
    }

    void grow(std::uint32_t object, std::uint32_t seed, const std::vector<glm::dvec3>& normals) {
        const Neighbours& beside = neighbours(object);
        const std::uint32_t first = out_.objects[object].first;
        const auto number = std::uint32_t(out_.charts.size());
        // Tolerance for normals of one plane, given positions in single precision.
        constexpr double kFlat = 1e-10;
        const bool flat_only = flat_only_[first + seed];
        const double least = flat_only ? 1 - kFlat : std::cos(LightMapLayout::kMaxTiltDegrees * kDegree);
        LightMapChart chart;
        chart.object = object;
        chart.first = std::uint32_t(out_.triangles.size());
        out_.triangles.push_back(seed);
        out_.chart_of[first + seed] = number;
        for (std::size_t i = chart.first; i < out_.triangles.size(); ++i)
            for (const std::uint32_t t : beside[out_.triangles[i]]) {
                if (t == kNone || out_.chart_of[first + t] != kNone || flat_only_[first + t] != flat_only) continue;
                const double cosine = glm::dot(normals[t], normals[seed]);
                if (!(cosine >= least)) continue;
                chart.flat = chart.flat && cosine >= 1 - kFlat;
                out_.chart_of[first + t] = number;
                out_.triangles.push_back(t);
            }
        chart.count = std::uint32_t(out_.triangles.size()) - chart.first;
        turn(chart, normals[seed]);
        out_.charts.push_back(chart);
    }

    /// Rotates a chart to the edge direction with the smallest bounding rectangle, of those tried; the longer side is
    /// horizontal.
    void turn(LightMapChart& chart, const glm::dvec3& normal) const {
        std::vector<glm::dvec3> points;
        points.reserve(3 * std::size_t(chart.count));
        for (std::uint32_t i = 0; i < chart.count; ++i)
            for (const glm::dvec3& p : geometry_.triangle(chart.object, out_.triangles[chart.first + i]))
                points.push_back(p - out_.centre);
        double least = std::numeric_limits<double>::infinity();
        const std::size_t every = std::max<std::size_t>(points.size() / kTriedDirections, 1);
        for (std::size_t i = 0; i < points.size(); i += every) {
            const std::size_t next = i - i % 3 + (i + 1) % 3;
            glm::dvec3 along = points[next] - points[i];
            along -= glm::dot(along, normal) * normal;
            const double length = glm::length(along);
            if (!(length > 0)) continue;
            glm::dvec3 u = along / length, v = glm::cross(normal, u);
            Bounds2 across;
            for (const glm::dvec3& p : points) across.add({glm::dot(u, p), glm::dot(v, p)});
            auto [lo, hi] = across;
            if (hi.y - lo.y > hi.x - lo.x) {
                std::swap(u, v);
                std::swap(lo.x, lo.y);
                std::swap(hi.x, hi.y);
            }
            const glm::dvec2 extent = hi - lo;
            if (!(extent.x * extent.y < least)) continue;
            least = extent.x * extent.y;
            chart.u = u;
            chart.v = v;
            chart.lo = lo;
            chart.extent_m = extent;
        }
    }

    void find_borders() {
        out_.borders.assign(flat_only_.size(), 0);
        for (const LightMapChart& chart : out_.charts) {
            const Neighbours& beside = neighbours(chart.object);
            const std::uint32_t first = out_.objects[chart.object].first;
            for (std::uint32_t i = 0; i < chart.count; ++i) {
                const std::uint32_t t = out_.triangles[chart.first + i];
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint32_t other = beside[t][k];
                    if (other == kNone || out_.chart_of[first + other] != out_.chart_of[first + t])
                        out_.borders[first + t] |= std::uint8_t(1u << k);
                }
            }
        }
    }

    static glm::ivec2 size_of(const LightMapChart& chart, double texels_per_metre) {
        const glm::dvec2 texels = glm::max(glm::ceil(chart.extent_m * texels_per_metre - 1e-9), glm::dvec2(1));
        return glm::ivec2(glm::min(texels, glm::dvec2(2.0 * kMaxSideTexels))) + 2 * LightMapLayout::kGutter;
    }

    /// Packs all charts; returns false when they do not fit. @param order charts by decreasing height
    bool place_all(const std::vector<std::uint32_t>& order, int side, double texels_per_metre) {
        int x = 0, y = 0, shelf = 0;
        for (const std::uint32_t c : order) {
            LightMapChart& chart = out_.charts[c];
            const glm::ivec2 size = size_of(chart, texels_per_metre);
            if (x + size.x > side) {
                x = 0;
                y += shelf;
                shelf = 0;
            }
            shelf = std::max(shelf, size.y);
            if (size.x > side || y + size.y > side) return false;
            chart.rect = {x, y, size.x, size.y};
            chart.at = glm::dvec2(x, y) + double(LightMapLayout::kGutter) - chart.lo * texels_per_metre;
            x += size.x;
        }
        return true;
    }

    void pack() {
        std::vector<std::uint32_t> order(out_.charts.size());
        std::iota(order.begin(), order.end(), 0u);
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return out_.charts[a].extent_m.y > out_.charts[b].extent_m.y;
        });
        double area_m2 = 0, longest_m = 0;
        for (const LightMapChart& chart : out_.charts) {
            area_m2 += chart.extent_m.x * chart.extent_m.y;
            longest_m = std::max(longest_m, chart.extent_m.x);
        }
        if (out_.charts.empty() || !(longest_m > 0)) {
            out_.texels_per_metre = 1;
            return;
        }
        // Upper bound of the density, by the longest chart and by the area of all charts.
        const double side = out_.side;
        double hi = std::min(side / longest_m, side / std::sqrt(std::max(area_m2, 1e-300)));
        double lo = hi * 0x1p-20;
        if (!place_all(order, out_.side, lo)) refuse(order);
        for (int i = 0; i < kDensitySteps; ++i) {
            stop_if_asked();
            const double middle = std::sqrt(lo * hi);
            (place_all(order, out_.side, middle) ? lo : hi) = middle;
        }
        place_all(order, out_.side, lo);
        out_.texels_per_metre = lo;
    }

    [[noreturn]] void refuse(const std::vector<std::uint32_t>& order) {
        int least = int(std::bit_ceil(unsigned(std::max(out_.side, 1))));
        while (least <= kMaxSideTexels && !place_all(order, least, 0)) least *= 2;
        const std::string fix =
            least <= kMaxSideTexels
                ? fmt::format("set light_map.resolution to {} or more", least)
                : fmt::format("that is more than any atlas up to {}² holds; choose another light.source",
                              kMaxSideTexels);
        throw Error(
            fmt::format("light_map.resolution {}: the scene's {} triangles make {} charts, which do not fit "
                        "even at one texel each; {}",
                        out_.side, out_.chart_of.size(), out_.charts.size(), fix));
    }

    /// Marks charts that overlap themselves: two triangles far from each other share a texel. Returns true if any does.
    bool take_apart_folded() {
        bool any = false;
        std::vector<double> heights;
        for (const LightMapChart& chart : out_.charts) {
            if (chart.flat) continue;
            stop_if_asked();
            if (folds(chart, heights)) {
                any = true;
                const std::uint32_t first = out_.objects[chart.object].first;
                for (std::uint32_t i = 0; i < chart.count; ++i)
                    flat_only_[first + out_.triangles[chart.first + i]] = true;
            }
        }
        return any;
    }

    bool folds(const LightMapChart& chart, std::vector<double>& heights) const {
        constexpr double kInside = 1e-6;
        heights.assign(std::size_t(chart.rect.z) * std::size_t(chart.rect.w), std::numeric_limits<double>::quiet_NaN());
        const glm::dvec3 normal = glm::cross(chart.u, chart.v);
        for (std::uint32_t i = 0; i < chart.count; ++i) {
            const TriangleWs p = geometry_.triangle(chart.object, out_.triangles[chart.first + i]);
            std::array<glm::dvec2, 3> at;
            std::array<double, 3> height;
            for (std::size_t k = 0; k < 3; ++k) {
                at[k] = out_.atlas_position(chart, p[k]) - glm::dvec2(chart.rect.x, chart.rect.y);
                height[k] = glm::dot(normal, p[k] - out_.centre);
            }
            const glm::dvec2 e1 = at[1] - at[0], e2 = at[2] - at[0];
            const double area = e1.x * e2.y - e1.y * e2.x;
            if (area == 0) continue;
            const glm::dvec2 lo = glm::min(at[0], glm::min(at[1], at[2])), hi = glm::max(at[0], glm::max(at[1], at[2]));
            for (int y = std::max(int(lo.y), 0); y <= std::min(int(hi.y), chart.rect.w - 1); ++y)
                for (int x = std::max(int(lo.x), 0); x <= std::min(int(hi.x), chart.rect.z - 1); ++x) {
                    const glm::dvec2 s = glm::dvec2(x + 0.5, y + 0.5) - at[0];
                    const double b = (s.x * e2.y - s.y * e2.x) / area, c = (e1.x * s.y - e1.y * s.x) / area;
                    if (b < kInside || c < kInside || b + c > 1 - kInside) continue;
                    const double here = height[0] + b * (height[1] - height[0]) + c * (height[2] - height[0]);
                    double& known = heights[std::size_t(y) * std::size_t(chart.rect.z) + std::size_t(x)];
                    if (std::abs(known - here) * out_.texels_per_metre > 1) return true;
                    known = here;
                }
        }
        return false;
    }
};

}  // namespace

LightMapLayout light_map_layout(const ReferenceGeometry& geometry, int side, const Workers& workers) {
    return LayoutBuilder(geometry, side, workers).build();
}

}  // namespace si
