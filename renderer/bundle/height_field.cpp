#include "renderer/bundle/height_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "renderer/base/error.h"
#include "renderer/projection/view_of_matrix.h"

namespace si {
namespace {

constexpr int kMaxCells = 4096;              ///< along one side of the finest grid
constexpr double kFollowedTexels = 0.25;     ///< distance from the texels that is no error
constexpr double kJumpTexels = 4;            ///< least jump between two texels at which the surface is cut
constexpr double kJumpOverNeighbours = 3;    ///< and its least ratio to the steps before and behind it
constexpr double kSteepTexels = 60;          ///< jump at which the surface is cut in any case: 89 degrees
constexpr double kLargestCoarseness = 1024;  ///< times kFollowedTexels, before rows are left out

/// Texels of a map at every `stride`-th row and column.
class HeightGrid {
public:
    HeightGrid(const LightView& view, const FloatImage& depths, int stride, double depth_step)
        : stride_(stride),
          width_((depths.width - 1) / stride + 1),
          height_((depths.height - 1) / stride + 1),
          view_(view),
          size_(depths.width, depths.height) {
        const std::size_t count = std::size_t(width_) * std::size_t(height_);
        depth_.resize(count);
        metres_.resize(count, std::numeric_limits<float>::quiet_NaN());
        unit_.resize(count, 0);
        const auto far = float(view.curve.convention.far_depth());
        for (int y = 0; y < height_; ++y) {
            const double v = uv(0, y).y;
            const DepthCurve curve = view.curve.curve_at_row(v);
            const double reference = 0.5 * (curve.near + curve.far);
            const double texel = view.texel_size_at(view.position_ws({0.5, v}, reference), size_).longest;
            row_texels_.push_back(float(stride * (view.curve.perspective ? texel / reference : texel)));
            for (int x = 0; x < width_; ++x) {
                const float depth = depths.at(x * stride, y * stride);
                const std::size_t i = index(x, y);
                depth_[i] = depth;
                if (depth == far || !std::isfinite(depth)) continue;
                const double z = curve.distance(depth);
                if (!std::isfinite(z)) continue;
                metres_[i] = float(z);
                const double slope = curve.slope(z);
                unit_[i] = float(slope * (kFollowedTexels * texel_m(i) + depth_step / slope));
            }
        }
    }

    int width() const { return width_; }
    int height() const { return height_; }
    std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(width_) + std::size_t(x); }
    bool has(int x, int y) const {
        return x >= 0 && y >= 0 && x < width_ && y < height_ && !std::isnan(metres_[index(x, y)]);
    }
    glm::dvec2 uv(int x, int y) const {
        return {(x * stride_ + 0.5) / size_.width, 1 - (y * stride_ + 0.5) / size_.height};
    }
    glm::dvec3 position_ws(int x, int y) const { return view_.position_ws(uv(x, y), metres_[index(x, y)]); }
    /// Returns the distance of a texel from the middle of two others, in units of what need not be followed. Depth is
    /// linear over the map on flat surfaces.
    double error(int x, int y, int ax, int ay, int bx, int by) const {
        const double middle = 0.5 * (double(depth_[index(ax, ay)]) + depth_[index(bx, by)]);
        return std::abs(depth_[index(x, y)] - middle) / unit_[index(x, y)];
    }
    /// Returns true when the surface is cut between two neighbours. @param dx,dy 1, 0 or 0, 1
    bool jumps(int x, int y, int dx, int dy) const {
        const auto step = [&](int sx, int sy) {
            return has(sx, sy) && has(sx + dx, sy + dy)
                       ? double(metres_[index(sx + dx, sy + dy)]) - metres_[index(sx, sy)]
                       : 0.0;
        };
        const double own = step(x, y), before = step(x - dx, y - dy), behind = step(x + dx, y + dy);
        const double texel = texel_m(index(x, y));
        if (std::abs(own) <= kJumpTexels * texel) return false;
        // A steep surface goes on in the same direction.
        const double goes_on = std::max(before / own, behind / own);
        return std::abs(own) > kSteepTexels * texel || kJumpOverNeighbours * goes_on < 1;
    }

private:
    double texel_m(std::size_t i) const {
        const double across = row_texels_[i / std::size_t(width_)];
        return view_.curve.perspective ? across * metres_[i] : across;
    }

    int stride_, width_, height_;
    const LightView& view_;
    MapSize size_;
    std::vector<float> depth_, metres_, unit_, row_texels_;
};

/// Triangulation of a grid of 2^k + 1 points a side by halving right triangles at their longest side.
class HalvedTriangles {
public:
    explicit HalvedTriangles(const HeightGrid& grid)
        : grid_(grid), cells_(int(std::bit_ceil(unsigned(std::max({grid.width(), grid.height(), 2}) - 1)))) {
        find_edges();
        find_errors();
    }
    std::size_t cut() const { return cut_; }

    /// Calls `work` with the corners of each triangle that is not further than `coarseness` from the texels.
    template <typename Work>
    void for_each(double coarseness, const Work& work) const {
        const int n = cells_;
        visit(coarseness, {0, 0}, {n, n}, {n, 0}, work);
        visit(coarseness, {n, n}, {0, 0}, {0, n}, work);
    }

private:
    using Point = glm::ivec2;

    /// Marks texels beside a cut or a missing texel: the mesh has a vertex at each of them.
    void find_edges() {
        const int w = grid_.width(), h = grid_.height();
        edge_.resize(std::size_t(w) * std::size_t(h));
        right_cut_.resize(edge_.size());
        down_cut_.resize(edge_.size());
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                const bool has = grid_.has(x, y);
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx)
                        if (x + dx >= 0 && y + dy >= 0 && x + dx < w && y + dy < h && grid_.has(x + dx, y + dy) != has)
                            edge_[grid_.index(x, y)] = true;
                if (!has) continue;
                for (const int dx : {1, 0}) {
                    const int dy = 1 - dx;
                    if (!grid_.has(x + dx, y + dy) || !grid_.jumps(x, y, dx, dy)) continue;
                    (dx ? right_cut_ : down_cut_)[grid_.index(x, y)] = true;
                    edge_[grid_.index(x, y)] = edge_[grid_.index(x + dx, y + dy)] = true;
                    ++cut_;
                }
            }
    }

    /// Returns the error of leaving out the middle of a triangle's longest side.
    double own_error(Point m, Point a, Point b) const {
        const int w = grid_.width(), h = grid_.height();
        // The last row and column of texels are a side of the mesh.
        if (m.x >= w || m.y >= h) return 0;
        if (edge_[grid_.index(m.x, m.y)]) return std::numeric_limits<double>::infinity();
        const bool is_side = m.x == w - 1 || m.y == h - 1;
        if (!grid_.has(m.x, m.y)) return 0;
        if (is_side || !grid_.has(a.x, a.y) || !grid_.has(b.x, b.y)) return std::numeric_limits<double>::infinity();
        return grid_.error(m.x, m.y, a.x, a.y, b.x, b.y);
    }

    void find_errors() {
        const int n = cells_;
        const std::size_t across = std::size_t(n) + 1;
        error_.resize(across * across, 0);
        const auto at = [&](Point p) -> float& { return error_[std::size_t(p.y) * across + std::size_t(p.x)]; };
        const std::size_t all = std::size_t(n) * std::size_t(n) * 2 - 2;
        const std::size_t parents = all - std::size_t(n) * std::size_t(n);
        // Triangles are numbered by the turns on the way to them, the smallest last.
        for (std::size_t i = all; i-- > 0;) {
            std::size_t id = i + 2;
            const bool first = id & 1;
            Point a = first ? Point(0, 0) : Point(n, n);
            Point b = first ? Point(n, n) : Point(0, 0);
            Point c = first ? Point(n, 0) : Point(0, n);
            while ((id >>= 1) > 1) {
                const Point m = (a + b) / 2;
                if (id & 1) {
                    b = a;
                    a = c;
                } else {
                    a = b;
                    b = c;
                }
                c = m;
            }
            const Point m = (a + b) / 2;
            double error = std::max(double(at(m)), own_error(m, a, b));
            if (i < parents) error = std::max({error, double(at((a + c) / 2)), double(at((b + c) / 2))});
            at(m) = float(error);
        }
    }

    template <typename Work>
    void visit(double coarseness, Point a, Point b, Point c, const Work& work) const {
        const Point m = (a + b) / 2;
        const std::size_t across = std::size_t(cells_) + 1;
        if (std::abs(a.x - c.x) + std::abs(a.y - c.y) > 1 &&
            error_[std::size_t(m.y) * across + std::size_t(m.x)] > coarseness) {
            visit(coarseness, c, a, m, work);
            visit(coarseness, b, c, m, work);
            return;
        }
        for (const Point p : {a, b, c})
            if (!grid_.has(p.x, p.y)) return;
        if (is_cut(a, c) || is_cut(b, c)) return;
        work(a, b, c);
    }

    /// Returns true when the surface is cut between two neighbours along a row or column.
    bool is_cut(Point p, Point q) const {
        if (std::abs(p.x - q.x) + std::abs(p.y - q.y) != 1) return false;
        const Point first(std::min(p.x, q.x), std::min(p.y, q.y));
        return (p.y == q.y ? right_cut_ : down_cut_)[grid_.index(first.x, first.y)];
    }

    const HeightGrid& grid_;
    int cells_;
    std::vector<bool> edge_, right_cut_, down_cut_;
    std::vector<float> error_;
    std::size_t cut_ = 0;
};

}  // namespace

HeightField height_field(const LightView& view, const FloatImage& depths, const HeightFieldOptions& options) {
    HeightField out;
    const int longest = std::max(depths.width, depths.height);
    out.stride = std::max(1, (longest - 1 + kMaxCells - 1) / kMaxCells);
    for (;; out.stride *= 2) {
        const HeightGrid grid(view, depths, out.stride, options.depth_step);
        const HalvedTriangles triangles(grid);
        double coarseness = 1;
        const auto count = [&] {
            std::size_t n = 0;
            triangles.for_each(coarseness, [&](auto, auto, auto) { ++n; });
            return n;
        };
        std::size_t triangle_count = count();
        while (triangle_count > options.max_triangles && coarseness < kLargestCoarseness) {
            coarseness *= 2;
            triangle_count = count();
        }
        if (triangle_count > options.max_triangles && out.stride < longest) continue;
        if (triangle_count == 0)
            throw Error("the map shows no surface; check its depth range and its clear value, or give the scene");
        out.error_texels = kFollowedTexels * coarseness * out.stride;
        out.cut = triangles.cut();
        const bool mirrored = is_mirrored(view);
        std::vector<std::uint32_t> vertex(std::size_t(grid.width()) * std::size_t(grid.height()), ~0u);
        std::vector<glm::dvec3> positions;
        std::vector<std::uint32_t> indices;
        indices.reserve(3 * triangle_count);
        const auto add = [&](glm::ivec2 p) {
            std::uint32_t& own = vertex[grid.index(p.x, p.y)];
            if (own == ~0u) {
                own = std::uint32_t(positions.size());
                positions.push_back(grid.position_ws(p.x, p.y));
            }
            indices.push_back(own);
        };
        triangles.for_each(coarseness, [&](glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
            // Seen from the light, a, b, c turn counter-clockwise.
            add(a);
            add(mirrored ? c : b);
            add(mirrored ? b : c);
        });
        Bounds bounds;
        for (const glm::dvec3& p : positions) bounds.add(p);
        out.origin_ws = bounds.centre();
        std::vector<glm::vec3> relative;
        relative.reserve(positions.size());
        for (const glm::dvec3& p : positions) relative.emplace_back(p - out.origin_ws);
        out.mesh.name = "height field";
        out.mesh.positions = std::move(relative);
        out.mesh.indices = std::move(indices);
        return out;
    }
}

Scene height_field_scene(const LightView& view, const FloatImage& depths, const HeightFieldOptions& options) {
    HeightField field = height_field(view, depths, options);
    Scene scene;
    scene.about = fmt::format("Surface that a shadow map of {} × {} texels shows; what lies behind it is unknown",
                              depths.width, depths.height);
    scene.materials.push_back({.name = "surface", .double_sided = true});
    field.mesh.material = 0;
    scene.meshes.push_back(std::move(field.mesh));
    Node node;
    node.name = "Surface of the map";
    node.local[3] = glm::dvec4(field.origin_ws, 1);
    scene.nodes.push_back(std::move(node));
    scene.objects.push_back({});
    if (field.error_texels > kFollowedTexels)
        scene.warnings.push_back(
            fmt::format("the surface of the map is followed to {:.3g} texels, so that it has at most {} triangles",
                        field.error_texels, options.max_triangles));
    finalise(scene);
    return scene;
}

}  // namespace si
